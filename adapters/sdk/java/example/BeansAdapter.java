import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.function.IntUnaryOperator;
import org.ucmcts.Adapter;
import org.ucmcts.Body;
import org.ucmcts.Host;
import org.ucmcts.Implementation;
import org.ucmcts.PortConnection;
import org.ucmcts.PortElement;
import org.ucmcts.Product;
import org.ucmcts.UcmException.BadParameter;
import org.ucmcts.UcmException.NotFound;
import org.ucmcts.UcmException.UcmError;

/** What the suite uses for a container is up to you: here, Beans. */
public final class BeansAdapter extends Adapter<Beans> {
    private final Map<Integer, String[]> wires = new HashMap<>(); // 12.10 wants integers, Beans has texts
    private int last;

    public static void main(String[] arguments) {
        Host.serve(arguments, new Product("Beans", "1.0"), BeansAdapter::new);
    }

    @Override
    public Beans createRuntime(List<Implementation> implementations) {
        Beans beans = new Beans();
        implementations.forEach(one -> beans.define(one.name(), () -> new ProbeBean(one.create().get())));
        return beans;
    }

    @Override
    public int addComponent(Beans beans, String implementation, Map<String, String> attributes) {
        try {
            beans.plant(String.valueOf(++last), implementation);
            return last;
        } catch (Beans.Trouble error) {
            throw new UcmError(error);
        }
    }

    @Override
    public void removeComponent(Beans beans, int component) {
        said(() -> beans.pull(String.valueOf(component)));
    }

    @Override
    public PortElement getPortElement(Beans beans, int component, String port) {
        IntUnaryOperator[] found = new IntUnaryOperator[1];
        said(() -> found[0] = beans.bean(String.valueOf(component)).service(port));
        if (found[0] == null) {
            throw new NotFound(port);
        }
        return new Service(found[0]);
    }

    @Override
    public int connect(Beans beans, int component, String port, PortElement toPort) {
        if (toPort == null) {
            throw new BadParameter("Beans has no null services");
        }
        said(() -> beans.wire(String.valueOf(component), port, ((Service) toPort).function()));
        wires.put(++last, new String[] {String.valueOf(component), port});
        return last;
    }

    @Override
    public void disconnect(Beans beans, int connection) {
        String[] wire = wires.getOrDefault(connection, new String[] {"", ""});
        said(() -> beans.unwire(wire[0], wire[1]));
    }

    @Override
    public void start(Beans beans) {
        beans.wake();
    }

    @Override
    public void stop(Beans beans) {
        beans.sleep();
    }

    @Override
    public List<Integer> getComponents(Beans beans) {
        throw new UcmError("Beans cannot list beans");
    }

    @Override
    public Beans createContainer(Beans manager) {
        throw new UcmError("Beans has no pods");
    }

    @Override
    public void removeContainer(Beans manager, Beans subContainer) {
        throw new NotFound("Beans has no pods");
    }

    @Override
    public void destroy(Beans manager) {
        manager.sleep();
    }

    private record Service(IntUnaryOperator function) implements PortElement {
        @Override
        public int exchange(int value) {
            return function.applyAsInt(value);
        }
    }

    /** A body of the suite, as Beans wants its beans. */
    private record ProbeBean(Body body) implements Beans.Bean {
        @Override
        public void prepare() {
            body.onInit();
        }

        @Override
        public void wake(Map<String, IntUnaryOperator> wires) {
            List<PortConnection> dependencies = new ArrayList<>();
            wires.forEach((port, to) -> dependencies.add(new PortConnection(port, List.of(new Service(to)))));
            body.onStartup(dependencies);
        }

        @Override
        public void sleep() {
            body.onShutdown();
        }

        @Override
        public void dispose() {
            body.onRemove();
        }

        @Override
        public IntUnaryOperator service(String name) {
            PortElement element = body.getPortElement(name);
            return element == null ? null : element::exchange;
        }
    }

    private interface Operation {
        void call() throws Beans.Missing;
    }

    /** The framework's errors, in the words of 12.10. Everything else passes: the report shall show it. */
    private static void said(Operation operation) {
        try {
            operation.call();
        } catch (Beans.Missing error) {
            throw new NotFound(error);
        }
    }
}
