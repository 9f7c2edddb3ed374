import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Map;
import java.util.function.LongConsumer;
import org.ucmcts.Adapter;
import org.ucmcts.Body;
import org.ucmcts.DeclaredException;
import org.ucmcts.Host;
import org.ucmcts.Implementation;
import org.ucmcts.ObjectTimer;
import org.ucmcts.PortConnection;
import org.ucmcts.PortElement;
import org.ucmcts.Product;
import org.ucmcts.TimerHandler;
import org.ucmcts.TimerScheduler;

/**
 * A framework that gives its components schedulers of object timers (10.3.1), and lets the seconds of a time decide
 * what happens: it does what tests/support/scheduling.py does.
 */
public final class SchedulingAdapter extends Adapter<List<Implementation>> {
    private static final int TRIGGERS = 1;
    private static final int NULL = 2;
    private static final int FAILS = 3;
    private static final int DECLARED = 4;
    private static final int NULL_TIMER = 5;
    private static final int NULL_TIME = 6;
    private static final int LARGEST = 7;
    private static final int ODD_TIMER = 8;
    private static final int FRACTION = 9;
    private static final int CROWD = 10;
    private static final long LARGEST_ROUND = 0xFFFFFFFFL;

    public static void main(String[] arguments) {
        Host.serve(arguments, new Product("scheduling", "0"), SchedulingAdapter::new);
    }

    /** Its rounds are the first seconds that it was made with, as they are now. */
    private static class Timer implements ObjectTimer {
        final int number;
        private final List<? extends Number> time;
        private boolean cancelled;

        Timer(int number, List<? extends Number> time) {
            this.number = number;
            this.time = time;
        }

        @Override
        public long rounds() {
            return time.get(0).longValue();
        }

        @Override
        public String id() {
            return "timer " + number;
        }

        @Override
        public void cancel() {
            cancelled = true;
        }

        @Override
        public boolean isCancelled() {
            return cancelled;
        }
    }

    /** Some of its methods fail. */
    private static final class OddTimer extends Timer {
        OddTimer(int number, List<? extends Number> time) {
            super(number, time);
        }

        @Override
        public long rounds() {
            return LARGEST_ROUND;
        }

        @Override
        public String id() {
            return null;
        }

        @Override
        public void cancel() {
            throw new DeclaredException("late", List.of(number));
        }

        @Override
        public boolean isCancelled() {
            throw new IllegalStateException("no");
        }
    }

    /** Triggers at once, within the call. */
    private static final class Scheduler implements TimerScheduler {
        private int made;

        private Timer make(List<? extends Number> time) {
            made++;
            return time.get(0).intValue() == ODD_TIMER ? new OddTimer(made, time) : new Timer(made, time);
        }

        @Override
        public ObjectTimer schedulerTrigger(TimerHandler handler, List<? extends Number> delay) {
            Timer timer = make(delay);
            switch (delay.get(0).intValue()) {
                case TRIGGERS -> handler.onTrigger(timer, Arrays.asList(0, 7L), 0);
                case FAILS -> throw new IllegalStateException("no");
                case DECLARED -> throw new DeclaredException("refused", List.of("why", 1));
                case NULL_TIMER -> handler.onTrigger(null, List.of(0, 7), 0);
                case NULL_TIME -> handler.onTrigger(timer, null, 0);
                case LARGEST -> handler.onTrigger(timer, List.of(LARGEST_ROUND, 999_999L), LARGEST_ROUND);
                case FRACTION -> handler.onTrigger(timer, List.of(0.5, 7), 0);
                case CROWD -> crowd(number -> handler.onTrigger(timer, delay, number));
                default -> { }
            }
            return delay.get(0).intValue() == NULL ? null : timer;
        }

        @Override
        public ObjectTimer scheduleRepeatedTrigger(
                TimerHandler handler,
                List<? extends Number> startDelay,
                List<? extends Number> interval,
                long maxRounds) {
            Timer timer = make(startDelay);
            for (long number = 0; number < maxRounds; number++) {
                handler.onTrigger(timer, number == 0 ? startDelay : interval, number);
            }
            return startDelay.get(0).intValue() == NULL ? null : timer;
        }
    }

    private static void crowd(LongConsumer trigger) {
        List<Thread> threads = new ArrayList<>();
        for (int one = 0; one < 4; one++) {
            threads.add(new Thread(() -> {
                for (long number = 0; number < 20; number++) {
                    trigger.accept(number);
                }
            }));
        }
        threads.forEach(Thread::start);
        for (Thread one : threads) {
            try {
                one.join();
            } catch (InterruptedException error) {
                throw new IllegalStateException(error);
            }
        }
    }

    @Override
    public List<Implementation> createRuntime(List<Implementation> all) {
        return all;
    }

    @Override
    public void start(List<Implementation> all) {
        for (Implementation one : all) {
            Body body = one.create().get();
            body.onStartup(one.policies().stream()
                    .map(policy -> new PortConnection(policy.element(), List.of(new Scheduler())))
                    .toList());
            for (String port : one.provides()) {
                for (int value = 0; value >= -2; value--) {
                    body.getPortElement(port).exchange(value);
                }
            }
        }
    }

    @Override
    public int addComponent(List<Implementation> all, String name, Map<String, String> attributes) {
        return 1;
    }

    @Override
    public void removeComponent(List<Implementation> all, int component) {}

    @Override
    public PortElement getPortElement(List<Implementation> all, int component, String port) {
        return null;
    }

    @Override
    public int connect(List<Implementation> all, int component, String port, PortElement to) {
        return 1;
    }

    @Override
    public void disconnect(List<Implementation> all, int connection) {}

    @Override
    public void stop(List<Implementation> all) {}

    @Override
    public List<Integer> getComponents(List<Implementation> all) {
        return List.of();
    }

    @Override
    public List<Implementation> createContainer(List<Implementation> all) {
        return null;
    }

    @Override
    public void removeContainer(List<Implementation> all, List<Implementation> sub) {}

    @Override
    public void destroy(List<Implementation> all) {}
}
