package org.ucmcts;

import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Objects;
import org.ucmcts.Messages.Declaration;
import org.ucmcts.Messages.Scenario;
import org.ucmcts.Messages.Step;
import org.ucmcts.Variables.Unbound;

/** The steps that are calls of the framework. */
final class Operations<C> {
    private static final long BETWEEN_READINGS = 1_000_000; // nanoseconds

    private final Adapter<C> adapter;
    private final Scenario scenario;
    private final Stage stage;
    private final Variables<C> variables;
    private final C manager;
    private final long patience;
    private volatile boolean destroyed;

    Operations(Adapter<C> adapter, Scenario scenario, Stage stage, Variables<C> variables, C manager, long patience) {
        this.adapter = adapter;
        this.scenario = scenario;
        this.stage = stage;
        this.variables = variables;
        this.manager = manager;
        this.patience = patience;
    }

    /** The runtime has been destroyed by a step. */
    boolean isDestroyed() {
        return destroyed;
    }

    /** The references {@code names} that are not null. */
    List<PortElement> references(List<String> names) throws Unbound {
        List<PortElement> found = new ArrayList<>();
        for (String name : names) {
            PortElement reference = variables.reference(name);
            if (reference != null) {
                found.add(reference);
            }
        }
        return found;
    }

    /** A call of the framework; the trace records what it returns. */
    @FunctionalInterface
    private interface Operation {
        Object call() throws Exception;
    }

    /** A call of the framework whose result, if there is one, is not recorded. */
    @FunctionalInterface
    private interface Silent {
        void call() throws Exception;
    }

    /** The adapter returned what its contract does not allow. */
    private static final class ContractBroken extends Exception {
        private static final long serialVersionUID = 1;

        private ContractBroken(String problem) {
            super(problem);
        }
    }

    /** Makes the call of {@code step} and records what comes of it. */
    void perform(int number, Step step) {
        Recorder recorder = stage.recorder;
        String name = step.tag();
        Operation operation;
        synchronized (variables) { // in one turn, so that the trace has a variable bound before it has it used
            try {
                operation = prepare(step);
            } catch (Unbound missing) {
                recorder.record("skip", "step", number, "variable", missing.getMessage());
                return;
            }
            recorder.record("call", "step", number);
        }
        try {
            Object result = operation.call();
            synchronized (variables) {
                Object value = bind(step, result);
                recorder.record("return", "step", number, name.equals("read_log") ? "records" : "value", value);
            }
        } catch (NotOffered error) {
            recorder.record("skip", "step", number, "variable", name);
        } catch (ContractBroken error) {
            recorder.complain(name + " " + error.getMessage());
            recorder.record("return", "step", number);
        } catch (UcmException error) {
            recorder.record("raise", "step", number, "error", error.spelling(), "detail", Details.text(error));
        } catch (Throwable error) { // a framework may throw anything
            recorder.record("raise", "step", number, "error", "UNDECLARED", "detail", Details.described(error));
        }
    }

    // binds what the call returned to the variable of the step, if it has one; gives what the trace records of it
    @SuppressWarnings("unchecked") // the calls of these steps return nothing else
    private Object bind(Step step, Object result) {
        switch (step.tag()) {
            case "add_component" -> variables.bindId(
                    step.bind().isEmpty() ? step.component() : step.bind(), (Integer) result);
            case "connect" -> variables.bindId(step.bind(), (Integer) result);
            case "get_components" -> variables.saw((List<Integer>) result);
            case "get_port_element" -> {
                variables.bindReference(step.bind(), (PortElement) result);
                return stage.recognise((PortElement) result);
            }
            case "create_container" -> {
                variables.bindContainer(step.bind(), (C) result);
                return null;
            }
            case "link" -> {
                variables.bindLink(step.bind(), result);
                return null;
            }
            default -> {}
        }
        return result;
    }

    // looks up what the step needs, and gives the call that is then made and recorded
    private Operation prepare(Step step) throws Unbound {
        return switch (step.tag()) {
            case "add_component" -> addComponent(step);
            case "remove_component" -> {
                C container = container(step);
                int member = variables.id(step.id());
                yield silent(() -> adapter.removeComponent(container, member));
            }
            case "get_port_element" -> getPortElement(step);
            case "connect" -> connect(step);
            case "disconnect" -> {
                C container = container(step);
                int connection = variables.id(step.connection());
                yield silent(() -> adapter.disconnect(container, connection));
            }
            case "start" -> {
                C container = container(step);
                yield silent(() -> adapter.start(container));
            }
            case "stop" -> {
                C container = container(step);
                yield silent(() -> adapter.stop(container));
            }
            case "get_components" -> getComponents(step);
            case "create_container" -> () -> adapter.createContainer(manager);
            case "remove_container" -> {
                C container = container(step);
                yield silent(() -> adapter.removeContainer(manager, container));
            }
            case "destroy" -> silent(() -> {
                adapter.destroy(manager);
                destroyed = true;
            });
            case "invoke" -> invoke(step);
            default -> prepareOptional(step);
        };
    }

    private Operation prepareOptional(Step step) throws Unbound {
        switch (step.tag()) {
            case "link" -> {
                Object types = scenario.types().get(step.interface_());
                Node type = types == null ? scenario.interfaces().get(step.interface_()) : (Node) types;
                return () -> types == null
                        ? adapter.link(manager, step.connector(), type)
                        : adapter.linkWithTypes(manager, step.connector(), type);
            }
            case "attach", "detach" -> {
                Object link = variables.link(step.link());
                C container = container(step);
                int member = variables.id(step.id());
                String port = step.port();
                return step.tag().equals("attach")
                        ? silent(() -> adapter.attach(link, step.role(), container, member, port))
                        : silent(() -> adapter.detach(link, container, member, port));
            }
            case "break" -> {
                Object link = variables.link(step.link());
                return silent(() -> adapter.breakLink(link, step.where()));
            }
            case "mend" -> {
                Object link = variables.link(step.link());
                return silent(() -> adapter.mendLink(link));
            }
            case "read_log" -> {
                return () -> readLog(step.records());
            }
            case "advance" -> {
                int milliseconds = (int) step.milliseconds();
                return silent(() -> adapter.advance(manager, milliseconds));
            }
            default -> throw new IllegalArgumentException(step.tag());
        }
    }

    private static Operation silent(Silent call) {
        return () -> {
            call.call();
            return null;
        };
    }

    private C container(Step step) throws Unbound {
        return variables.container(step.container());
    }

    private Operation addComponent(Step step) throws Unbound {
        C container = container(step);
        String component = step.component();
        Declaration declaration = scenario.components().get(component);
        Map<String, String> attributes = new LinkedHashMap<>(step.attributes());
        if (declaration != null) {
            declaration.attributes().forEach(attributes::putIfAbsent);
        }
        return () -> adapter.addComponent(container, component, attributes);
    }

    private Operation getPortElement(Step step) throws Unbound {
        C container = container(step);
        int member = variables.id(step.id());
        return () -> adapter.getPortElement(container, member, step.port());
    }

    private Operation connect(Step step) throws Unbound {
        C container = container(step);
        int member = variables.id(step.id());
        PortElement reference = variables.reference(step.to());
        return () -> adapter.connect(container, member, step.port(), reference);
    }

    private Operation getComponents(Step step) throws Unbound {
        C container = container(step);
        return () -> {
            List<Integer> members = adapter.getComponents(container);
            if (members == null || members.stream().anyMatch(Objects::isNull)) {
                throw new ContractBroken("returned " + Data.inWords(members) + "; it returns a list of integers");
            }
            if (members.size() > Data.MOST) {
                throw new ContractBroken("returned " + Data.tooMany("ids") + ", which no scenario can have led to");
            }
            return List.copyOf(members);
        };
    }

    private Operation invoke(Step step) throws Unbound {
        PortElement reference = variables.reference(step.ref());
        if (reference == null) { // nothing can be called through a null reference
            throw new Unbound(step.ref());
        }
        return () -> reference.exchange((int) step.value());
    }

    private Object readLog(long records) throws Exception {
        long deadline = System.nanoTime() + patience;
        while (true) {
            List<Adapter.LogRecord> read = adapter.readLog(manager);
            if (read == null || read.stream().anyMatch(Objects::isNull)) {
                throw new ContractBroken("returned " + Data.inWords(read) + "; it returns a list of records");
            }
            if (read.size() > Data.MOST) {
                throw new ContractBroken("returned " + Data.tooMany("records") + ", which no scenario can have led to");
            }
            if (read.size() >= records || System.nanoTime() - deadline >= 0) {
                return read.stream()
                        .map(one -> Map.of("severity", one.severity(), "message", one.message()))
                        .toList();
            }
            Waiting.pass(BETWEEN_READINGS);
        }
    }
}
