import java.util.Collections;
import java.util.List;
import java.util.Map;
import org.ucmcts.Adapter;
import org.ucmcts.Body;
import org.ucmcts.Fragment;
import org.ucmcts.Host;
import org.ucmcts.Implementation;
import org.ucmcts.ObjectTimer;
import org.ucmcts.PortConnection;
import org.ucmcts.PortElement;
import org.ucmcts.Product;
import org.ucmcts.TimerHandler;
import org.ucmcts.TimerScheduler;
import org.ucmcts.UcmException.BadParameter;
import org.ucmcts.UcmException.NotFound;
import org.ucmcts.UcmException.UcmError;

/** Does something bad, which the name of the component to add chooses. */
public final class RudeAdapter extends Adapter<String> {
    private static final int TOO_MANY = 10_001;

    private List<Implementation> all;
    private boolean isFlooding;

    public static void main(String[] arguments) {
        Host.serve(arguments, new Product("rude", "0", "{port}.{element}"), RudeAdapter::new);
    }

    @Override
    public String createRuntime(List<Implementation> implementations) {
        all = implementations;
        if (!all.isEmpty() && all.get(0).name().equals("refuse")) {
            throw new IllegalStateException("no licence");
        }
        return "root";
    }

    @Override
    public int addComponent(String container, String what, Map<String, String> attributes) throws Exception {
        switch (what) {
            case "print" -> System.out.println("{\"type\":\"welcome\"}");
            case "exit" -> System.exit(3);
            case "halt" -> Runtime.getRuntime().halt(4);
            case "hang" -> new java.util.concurrent.CountDownLatch(1).await();
            case "spin" -> {
                while (true) {
                    Thread.onSpinWait();
                }
            }
            case "interrupt" -> Thread.currentThread().interrupt();
            case "throw long" -> throw new java.io.IOException("x".repeat(300));
            case "throw error" -> throw new StackOverflowError();
            case "throw text" -> throw new NotFound("\"quoted\" ä \ud800");
            default -> { }
        }
        isFlooding = what.equals("many");
        return Integer.MAX_VALUE;
    }

    @Override
    public void removeComponent(String container, int id) {
        throw new BadParameter(String.valueOf(id));
    }

    @Override
    public PortElement getPortElement(String container, int id, String port) {
        return port.equals("none") ? null : value -> Math.toIntExact(1L << 40);
    }

    @Override
    public int connect(String container, int id, String port, PortElement toPort) {
        return 0;
    }

    @Override
    public void disconnect(String container, int connection) {}

    @Override
    public void start(String container) {
        all.stream().filter(one -> one.name().equals("timed")).forEach(RudeAdapter::serveTimers);
        all.stream().filter(one -> !one.name().equals("timed")).forEach(one -> one.policies().forEach(policy -> {
            Runnable run = one.create().get().getPolicyElement(policy.definition(), "self-execution_api");
            if (run != null) {
                run.run();
            }
        }));
        all.stream().filter(one -> one.name().equals("flooded")).forEach(one -> {
            Body body = one.create().get();
            ((Fragment) body).setContainerInterface(() -> Collections.nCopies(TOO_MANY, 1));
            body.onStartup(Collections.nCopies(TOO_MANY, new PortConnection("out", List.of())));
        });
    }

    /** Has a body use object timers, and calls its callback of index timers. */
    private static void serveTimers(Implementation implementation) {
        Body body = implementation.create().get();
        body.onStartup(implementation.policies().stream()
                .filter(policy -> policy.definition().equals("ott_timer"))
                .map(policy -> new PortConnection(policy.element(), List.of(new Scheduler())))
                .toList());
        PortElement callback = body.getPolicyPort("itt_timer", "timer_callback");
        callback.call("on_timeout", List.of(List.of(5, "RELATIVE_TIME"), 7));
    }

    /** Triggers inside the calls. The second method returns no timer. */
    private static final class Scheduler implements TimerScheduler {
        @Override
        public ObjectTimer schedulerTrigger(TimerHandler handler, List<? extends Number> delay) {
            handler.onTrigger(new Timer(), delay, 0);
            return new Timer();
        }

        @Override
        public ObjectTimer scheduleRepeatedTrigger(
                TimerHandler handler,
                List<? extends Number> startDelay,
                List<? extends Number> interval,
                long maxRounds) {
            handler.onTrigger(new Timer(), interval, maxRounds);
            return null;
        }
    }

    private static final class Timer implements ObjectTimer {
        @Override
        public long rounds() {
            return 3;
        }

        @Override
        public String id() {
            return "t";
        }

        @Override
        public void cancel() {
            throw new UcmError("too late");
        }

        @Override
        public boolean isCancelled() {
            return false;
        }
    }

    @Override
    public void stop(String container) {
        all.get(0).create().get().onStartup(null);
    }

    @Override
    public List<Integer> getComponents(String container) {
        List<Integer> ids = Collections.nCopies(isFlooding ? TOO_MANY : 1, Integer.MAX_VALUE - 1);
        return container.equals("sub") ? null : ids;
    }

    @Override
    public String createContainer(String manager) {
        return "sub";
    }

    @Override
    public void removeContainer(String manager, String container) {}

    @Override
    public void advance(String manager, int milliseconds) {
        throw new BadParameter(String.valueOf(milliseconds));
    }

    @Override
    public void destroy(String manager) {
        throw new UcmError("never");
    }
}
