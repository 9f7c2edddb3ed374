import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Collections;
import java.util.Deque;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import org.ucmcts.Adapter;
import org.ucmcts.Body;
import org.ucmcts.Connectable;
import org.ucmcts.Fragment;
import org.ucmcts.Host;
import org.ucmcts.Implementation;
import org.ucmcts.PortConnection;
import org.ucmcts.PortElement;
import org.ucmcts.Product;
import org.ucmcts.UcmException.BadParameter;
import org.ucmcts.UcmException.NotFound;
import org.ucmcts.UcmException.UcmError;

/**
 * A UCM framework that does what the Python reference framework does, as far as profile container asks. The same
 * scenarios have to make the same traces behind both SDKs.
 */
public final class StrictAdapter extends Adapter<StrictAdapter.Container> {
    private final Map<String, Implementation> implementations = new HashMap<>();
    private final List<Container> containers = new ArrayList<>();
    private final Map<Integer, Connection> connections = new LinkedHashMap<>();
    private Container root;
    private int last;
    private Thread busy;

    static final class Container {
        private final Map<Integer, Member> members = new LinkedHashMap<>();
        private final Deque<Member> started = new ArrayDeque<>();
        private boolean isStarted;
        private boolean isRemoved;
    }

    private record Member(Implementation implementation, Body body) {}

    private record Connection(Container container, Member client, String port, PortElement target) {}

    public static void main(String[] arguments) {
        Host.serve(arguments, new Product("strict", "1"), StrictAdapter::new);
    }

    @Override
    public Container createRuntime(List<Implementation> all) {
        all.forEach(one -> implementations.put(one.name(), one));
        root = new Container();
        return root;
    }

    @Override
    public int addComponent(Container container, String name, Map<String, String> attributes) throws Exception {
        int[] number = new int[1];
        operate(container, () -> {
            checkConfiguring(container);
            Implementation implementation = implementations.get(name);
            if (implementation == null) {
                throw new UcmError("no implementation " + name);
            }
            if (!implementation.attributes().containsAll(attributes.keySet())) {
                throw new UcmError(name + " lacks an attribute of " + attributes.keySet());
            }
            number[0] = ++last;
            Body body = implementation.create().get();
            Failures failures = new Failures();
            failures.attempt(() -> {
                Map<String, String> values = new LinkedHashMap<>(implementation.defaults());
                values.putAll(attributes);
                values.forEach(body::setAttribute);
                if (body instanceof Fragment fragment) {
                    fragment.setContainerInterface(() -> getComponents(container));
                }
                body.onInit();
            });
            failures.report();
            container.members.put(number[0], new Member(implementation, body));
        });
        return number[0];
    }

    @Override
    public void removeComponent(Container container, int number) throws Exception {
        operate(container, () -> {
            Member member = find(container, number);
            if (container.started.contains(member)) {
                throw new UcmError("it is ready");
            }
            if (connections.values().stream().anyMatch(c -> c.client() != member && leadsTo(member, c))) {
                throw new UcmError("another component is connected to it");
            }
            Failures failures = new Failures();
            new ArrayList<>(connections.keySet()).forEach(one -> {
                if (connections.get(one).client() == member) {
                    undo(one, failures);
                }
            });
            remove(container, number, failures);
            failures.report();
        });
    }

    @Override
    public PortElement getPortElement(Container container, int number, String port) {
        checkAlive(container);
        Member member = find(container, number);
        if (!member.implementation().provides().contains(port)) {
            throw new NotFound("no provided port element " + port);
        }
        return member.body().getPortElement(port);
    }

    @Override
    public int connect(Container container, int number, String port, PortElement toPort) throws Exception {
        int[] connection = new int[1];
        operate(container, () -> {
            Member member = find(container, number);
            if (!member.implementation().requires().contains(port) || toPort == null) {
                throw new BadParameter(toPort == null ? "the reference is null" : "no required port element " + port);
            }
            checkConfiguring(container);
            if (isConnected(member, port)) {
                throw new UcmError(port + " is connected already");
            }
            connection[0] = ++last;
            if (member.body() instanceof Connectable connectable) {
                Failures failures = new Failures();
                failures.attempt(() -> connectable.onConnect(port, toPort));
                failures.report();
            }
            connections.put(connection[0], new Connection(container, member, port, toPort));
        });
        return connection[0];
    }

    @Override
    public void disconnect(Container container, int number) throws Exception {
        operate(container, () -> {
            Connection found = connections.get(number);
            if (found == null || found.container() != container) {
                throw new NotFound("no connection " + number);
            }
            checkConfiguring(container);
            Failures failures = new Failures();
            undo(number, failures);
            failures.report();
        });
    }

    @Override
    public void start(Container container) throws Exception {
        operate(container, () -> {
            if (container.isStarted) {
                return;
            }
            for (Member member : container.members.values()) {
                if (!member.implementation().requires().stream().allMatch(port -> isConnected(member, port))) {
                    throw new UcmError("not connected");
                }
            }
            Failures failures = new Failures();
            for (Member member : container.members.values()) {
                List<PortConnection> dependencies = connections.values().stream()
                        .filter(c -> c.client() == member)
                        .map(c -> new PortConnection(c.port(), List.of(c.target())))
                        .toList();
                if (!failures.attempt(() -> member.body().onStartup(dependencies))) {
                    shutDown(container, failures);
                    failures.report();
                }
                container.started.push(member);
            }
            container.isStarted = true;
        });
    }

    @Override
    public void stop(Container container) throws Exception {
        operate(container, () -> {
            Failures failures = new Failures();
            shutDown(container, failures);
            failures.report();
        });
    }

    @Override
    public List<Integer> getComponents(Container container) {
        checkAlive(container);
        return List.copyOf(container.members.keySet());
    }

    @Override
    public Container createContainer(Container manager) throws Exception {
        Container container = new Container();
        operate(manager, () -> containers.add(container));
        return container;
    }

    @Override
    public void removeContainer(Container manager, Container container) throws Exception {
        operate(manager, () -> {
            if (!containers.contains(container)) {
                throw new NotFound("no such container");
            }
            Failures failures = new Failures();
            takeDown(List.of(container), failures);
            containers.remove(container);
            failures.report();
        });
    }

    @Override
    public void destroy(Container manager) throws Exception {
        List<Container> all = new ArrayList<>(containers);
        all.add(manager);
        operate(manager, () -> {
            Failures failures = new Failures();
            takeDown(all, failures);
            failures.report();
        });
    }

    private void takeDown(List<Container> all, Failures failures) {
        all.forEach(container -> shutDown(container, failures));
        for (Container container : all) {
            List<Integer> touched = new ArrayList<>(connections.keySet().stream()
                    .filter(one -> container.members.values().stream().anyMatch(member ->
                            connections.get(one).client() == member || leadsTo(member, connections.get(one))))
                    .toList());
            Collections.reverse(touched);
            touched.forEach(one -> undo(one, failures));
        }
        for (Container container : all) {
            List<Integer> numbers = new ArrayList<>(container.members.keySet());
            Collections.reverse(numbers);
            numbers.forEach(number -> remove(container, number, failures));
            container.isRemoved = true;
        }
    }

    private void shutDown(Container container, Failures failures) {
        while (!container.started.isEmpty()) {
            Member member = container.started.pop();
            failures.attempt(member.body()::onShutdown);
        }
        container.isStarted = false;
    }

    private void undo(int number, Failures failures) {
        Connection connection = connections.remove(number);
        if (connection.client().body() instanceof Connectable connectable) {
            failures.attempt(() -> connectable.onDisconnect(connection.port()));
        }
    }

    private static void remove(Container container, int number, Failures failures) {
        failures.attempt(container.members.get(number).body()::onRemove);
        container.members.remove(number);
    }

    private boolean isConnected(Member member, String port) {
        return connections.values().stream().anyMatch(c -> c.client() == member && c.port().equals(port));
    }

    private static boolean leadsTo(Member member, Connection connection) {
        return member.implementation().provides().stream()
                .anyMatch(port -> member.body().getPortElement(port) == connection.target());
    }

    private static Member find(Container container, int number) {
        Member member = container.members.get(number);
        if (member == null) {
            throw new NotFound("no component " + number);
        }
        return member;
    }

    private void checkAlive(Container container) {
        if (root.isRemoved || container.isRemoved) {
            throw new UcmError("the container has been removed");
        }
    }

    private static void checkConfiguring(Container container) {
        if (container.isStarted) {
            throw new UcmError("the container has been started");
        }
    }

    private void operate(Container container, Runnable operation) {
        if (busy == Thread.currentThread()) {
            throw new UcmError("the runtime is in the middle of an operation");
        }
        synchronized (this) {
            busy = Thread.currentThread();
            try {
                checkAlive(container);
                operation.run();
            } finally {
                busy = null;
            }
        }
    }

    /** Carries on when a body throws, and remembers that it did. */
    private static final class Failures {
        private RuntimeException first;

        private boolean attempt(Runnable callback) {
            try {
                callback.run();
                return true;
            } catch (RuntimeException error) {
                first = first == null ? error : first;
                return false;
            }
        }

        private void report() {
            if (first != null) {
                throw new UcmError(first);
            }
        }
    }
}
