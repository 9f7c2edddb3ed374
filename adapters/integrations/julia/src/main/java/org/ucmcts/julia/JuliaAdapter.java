package org.ucmcts.julia;

import java.util.*;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.function.Function;
import org.objectweb.fractal.api.*;
import org.objectweb.fractal.api.control.*;
import org.objectweb.fractal.api.factory.InstantiationException;
import org.objectweb.fractal.api.type.InterfaceType;
import org.objectweb.fractal.api.type.TypeFactory;
import org.objectweb.fractal.util.Fractal;
import org.ucmcts.*;
import org.ucmcts.UcmException.NotFound;
import org.ucmcts.UcmException.UcmError;

/**
 * Binds Fractal's reference framework Julia. A container is a composite, a component a primitive in it named by its id.
 * A provided port element is a server interface, a required one a mandatory client interface, a connection a binding.
 * Starting and stopping a composite starts and stops its contents; (un)binding calls {@code on_(dis)connect}. What
 * Fractal does not have is done here: {@code on_init} when attributes are set, {@code on_remove} when a composite lets
 * go, taking containers down step by step. All are in a composite for the runtime that is never started.
 */
public final class JuliaAdapter extends Adapter<Component> {
    private static Component bootstrap; // the classes that Julia has generated serve all runtimes

    private final AtomicInteger last = new AtomicInteger();
    private final Map<Integer, Connection> connections = new ConcurrentHashMap<>();
    private final Map<Integer, Body> bodies = new ConcurrentHashMap<>();
    private final Map<String, Implementation> implementations = new HashMap<>();
    private Component runtime;

    private record Connection(int client, String port) {}

    public static void main(String[] arguments) {
        Host.serve(arguments, new Product("Fractal Julia", "2.5.2"), JuliaAdapter::new);
    }

    @Override
    public Component createRuntime(List<Implementation> all) throws Exception {
        bootstrap = bootstrap == null ? Fractal.getBootstrapComponent() : bootstrap;
        runtime = make("composite", null, List.of());
        all.forEach(one -> implementations.put(one.name(), one));
        return createContainer(null);
    }

    @Override
    public int addComponent(Component container, String name, Map<String, String> attributes) throws Exception {
        Component component = implementations.containsKey(name)
                ? primitive(implementations.get(name))
                : make("primitive", name, List.of()); // no class has such a name
        Body body = Content.LAST.get();
        ((Attributes) Fractal.getAttributeController(component)).setValues(attributes);
        if (body instanceof Fragment fragment) {
            tell(() -> fragment.setContainerInterface(() -> getComponents(container)), UcmError::new);
        }
        tell(body::onInit, UcmError::new);
        int number = last.incrementAndGet();
        bodies.put(number, body);
        Fractal.getNameController(component).setFcName(String.valueOf(number));
        fractal(() -> Fractal.getContentController(container).addFcSubComponent(component));
        return number;
    }

    @Override
    public void removeComponent(Component container, int number) throws Exception {
        Component member = member(container, number);
        fractal(() -> Fractal.getContentController(container).removeFcSubComponent(member));
        tell(bodies.remove(number)::onRemove, UcmError::new);
    }

    @Override
    public PortElement getPortElement(Component container, int number, String port) throws Exception {
        for (Object one : member(container, number).getFcInterfaces()) {
            InterfaceType type = (InterfaceType) ((Interface) one).getFcItfType();
            if (one instanceof Exchange && !type.isFcClientItf() && type.getFcItfName().equals(port)) {
                return new Reference(one);
            }
        }
        throw new NotFound("no server interface " + port);
    }

    @Override
    public int connect(Component container, int number, String port, PortElement toPort) throws Exception {
        BindingController client = Fractal.getBindingController(member(container, number));
        fractal(() -> client.bindFc(port, toPort == null ? null : ((Reference) toPort).target()));
        int connection = last.incrementAndGet();
        connections.put(connection, new Connection(number, port));
        return connection;
    }

    @Override
    public void disconnect(Component container, int number) throws Exception {
        Connection connection = connections.getOrDefault(number, new Connection(0, "")); // number 0 is unused
        BindingController client = Fractal.getBindingController(member(container, connection.client()));
        fractal(() -> client.unbindFc(connection.port()));
        connections.remove(number);
    }

    @Override
    public void start(Component container) throws Exception {
        fractal(() -> Fractal.getLifeCycleController(container).startFc());
    }

    @Override
    public void stop(Component container) throws Exception {
        fractal(() -> Fractal.getLifeCycleController(container).stopFc());
    }

    @Override
    public List<Integer> getComponents(Component container) throws NoSuchInterfaceException {
        List<Integer> numbers = new ArrayList<>();
        for (Component member : Fractal.getContentController(container).getFcSubComponents()) {
            numbers.add(Integer.valueOf(Fractal.getNameController(member).getFcName()));
        }
        return numbers;
    }

    @Override
    public Component createContainer(Component manager) throws Exception {
        Component container = make("composite", null, List.of());
        fractal(() -> Fractal.getContentController(runtime).addFcSubComponent(container));
        return container;
    }

    @Override
    public void removeContainer(Component manager, Component container) throws Exception {
        ContentController content = Fractal.getContentController(runtime);
        if (container != null && !Arrays.asList(content.getFcSubComponents()).contains(container)) {
            throw new NotFound("no such sub-container");
        }
        stop(container);
        List<Integer> members = getComponents(container);
        for (Map.Entry<Integer, Connection> one : connections.entrySet()) {
            if (members.contains(one.getValue().client())) {
                disconnect(container, one.getKey());
            }
        }
        for (int member : members) {
            removeComponent(container, member);
        }
        fractal(() -> content.removeFcSubComponent(container));
    }

    @Override
    public void destroy(Component manager) throws Exception {
        for (Component container : Fractal.getContentController(runtime).getFcSubComponents()) {
            removeContainer(manager, container);
        }
    }

    private static Component member(Component container, int number) throws NoSuchInterfaceException {
        for (Component member : Fractal.getContentController(container).getFcSubComponents()) {
            if (Fractal.getNameController(member).getFcName().equals(String.valueOf(number))) {
                return member;
            }
        }
        throw new NotFound("no component " + number);
    }

    private static Component primitive(Implementation implementation) throws Exception {
        Content.NEXT.set(implementation);
        List<InterfaceType> interfaces = new ArrayList<>();
        interfaces.add(type("attribute-controller", Attributes.class, false));
        for (String port : implementation.provides()) {
            interfaces.add(type(port, Exchange.class, false));
        }
        for (String port : implementation.requires()) {
            interfaces.add(type(port, Exchange.class, true));
        }
        return make("parametricPrimitive", Content.class.getName(), interfaces);
    }

    private static InterfaceType type(String name, Class<?> signature, boolean isClient) throws Exception {
        return Fractal.getTypeFactory(bootstrap)
                .createFcItfType(name, signature.getName(), isClient, TypeFactory.MANDATORY, TypeFactory.SINGLE);
    }

    private static Component make(String kind, String content, List<InterfaceType> interfaces) throws Exception {
        Type type = Fractal.getTypeFactory(bootstrap).createFcType(interfaces.toArray(InterfaceType[]::new));
        try {
            return Fractal.getGenericFactory(bootstrap).newFcInstance(type, kind, content);
        } catch (InstantiationException error) {
            throw new UcmError(error);
        }
    }

    private interface Operation {
        void call() throws Exception;
    }

    /** What Fractal declares, in the words of 12.10; its surprises pass. */
    private static void fractal(Operation operation) throws Exception {
        try {
            operation.call();
        } catch (NoSuchInterfaceException error) {
            throw new NotFound(error);
        } catch (IllegalBindingException | IllegalContentException | IllegalLifeCycleException error) {
            throw new UcmError(error);
        }
    }

    /** What a body throws, in the words that are asked for. */
    private static <E extends Exception> void tell(Runnable callback, Function<String, E> refusal) throws E {
        try {
            callback.run();
        } catch (RuntimeException error) {
            throw refusal.apply(error.toString());
        }
    }

    /** The business interface of all ports. There is one content whichever is called, so callers name the port. */
    public interface Exchange {
        int exchange(String port, int value);
    }

    /** The attribute controller of all components that have attributes. */
    public interface Attributes extends AttributeController {
        default Map<String, String> getValues() {
            throw new UnsupportedOperationException(); // Julia only wants it to be there
        }

        void setValues(Map<String, String> values);
    }

    private record Reference(Object target) implements PortElement {
        @Override
        public int exchange(int value) {
            return ((Exchange) target).exchange(((Interface) target).getFcItfName(), value);
        }
    }

    /** The content of a primitive: a body behind what Fractal asks of contents, which Julia makes without arguments. */
    public static final class Content implements Exchange, Attributes, BindingController, LifeCycleController {
        private static final ThreadLocal<Implementation> NEXT = new ThreadLocal<>();
        private static final ThreadLocal<Body> LAST = new ThreadLocal<>();
        private final List<String> required = NEXT.get().requires();
        private final Map<String, Object> bindings = new LinkedHashMap<>();
        private final Body body = NEXT.get().create().get();

        public Content() {
            LAST.set(body);
        }

        @Override
        public int exchange(String port, int value) {
            return body.getPortElement(port).exchange(value);
        }

        @Override
        public void setValues(Map<String, String> values) {
            values.forEach(body::setAttribute);
        }

        @Override
        public String[] listFc() {
            return required.toArray(String[]::new);
        }

        @Override
        public Object lookupFc(String port) {
            return bindings.get(port);
        }

        @Override
        public void bindFc(String port, Object server) throws IllegalBindingException {
            if (required.contains(port)) { // and not "component", the reference to itself that contents are given
                bindings.put(port, server);
                if (body instanceof Connectable connectable) {
                    tell(() -> connectable.onConnect(port, new Reference(server)), IllegalBindingException::new);
                }
            }
        }

        @Override
        public void unbindFc(String port) throws IllegalBindingException {
            bindings.remove(port);
            if (body instanceof Connectable connectable) {
                tell(() -> connectable.onDisconnect(port), IllegalBindingException::new);
            }
        }

        @Override
        public String getFcState() {
            return null; // Julia keeps it
        }

        @Override
        public void startFc() throws IllegalLifeCycleException {
            List<PortConnection> dependencies = new ArrayList<>();
            bindings.forEach((port, to) -> dependencies.add(new PortConnection(port, List.of(new Reference(to)))));
            tell(() -> body.onStartup(dependencies), IllegalLifeCycleException::new);
        }

        @Override
        public void stopFc() throws IllegalLifeCycleException {
            tell(body::onShutdown, IllegalLifeCycleException::new);
        }
    }
}
