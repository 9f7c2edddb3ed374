package org.ucmcts;

import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Objects;
import org.ucmcts.Variables.Unbound;

/** The steps that are calls of the framework. */
final class Operations<C> {
    private static final long BETWEEN_READINGS = 1_000_000; // nanoseconds; nobody tells when a record has been written

    private final Adapter<C> adapter;
    private final Node scenario;
    private final Stage stage;
    private final Variables<C> variables;
    private final C manager;
    private final long patience;
    private volatile boolean destroyed;

    Operations(Adapter<C> adapter, Node scenario, Stage stage, Variables<C> variables, C manager, long patience) {
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

    /** A call of the framework; what it returns is what the trace tells. */
    @FunctionalInterface
    private interface Operation {
        Object call() throws Exception;
    }

    /** A call of the framework whose result, if there is one, is not told. */
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
    void perform(int number, Node step) {
        Recorder recorder = stage.recorder;
        String name = step.text("op");
        Operation operation;
        try {
            operation = prepare(step);
        } catch (Unbound missing) {
            recorder.record("skip", "step", number, "variable", missing.getMessage());
            return;
        }
        recorder.record("call", "step", number);
        try {
            Object value = operation.call();
            recorder.record("return", "step", number, name.equals("read_log") ? "records" : "value", value);
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

    // looks up what the step needs, and gives the call that is then made and recorded
    private Operation prepare(Node step) throws Unbound {
        return switch (step.text("op")) {
            case "add_component" -> addComponent(step);
            case "remove_component" -> {
                C container = container(step);
                int member = variables.id(step.text("id"));
                yield silent(() -> adapter.removeComponent(container, member));
            }
            case "get_port_element" -> getPortElement(step);
            case "connect" -> connect(step);
            case "disconnect" -> {
                C container = container(step);
                int connection = variables.id(step.text("connection"));
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
            case "create_container" -> silent(
                    () -> variables.bindContainer(step.text("bind"), adapter.createContainer(manager)));
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

    private Operation prepareOptional(Node step) throws Unbound {
        switch (step.text("op")) {
            case "link" -> {
                Node type = scenario.node("interfaces").node(step.text("interface"));
                return silent(() -> variables.bindLink(
                        step.text("bind"), adapter.link(manager, step.text("connector"), type)));
            }
            case "attach", "detach" -> {
                Object link = variables.link(step.text("link"));
                C container = container(step);
                int member = variables.id(step.text("id"));
                String port = step.text("port");
                return step.text("op").equals("attach")
                        ? silent(() -> adapter.attach(link, step.text("role"), container, member, port))
                        : silent(() -> adapter.detach(link, container, member, port));
            }
            case "break" -> {
                Object link = variables.link(step.text("link"));
                return silent(() -> adapter.breakLink(link, step.text("where")));
            }
            case "mend" -> {
                Object link = variables.link(step.text("link"));
                return silent(() -> adapter.mendLink(link));
            }
            case "read_log" -> {
                return () -> readLog(step.number("records"));
            }
            case "advance" -> {
                int milliseconds = (int) step.number("milliseconds");
                return silent(() -> adapter.advance(manager, milliseconds));
            }
            default -> throw new IllegalArgumentException(step.text("op"));
        }
    }

    private static Operation silent(Silent call) {
        return () -> {
            call.call();
            return null;
        };
    }

    private C container(Node step) throws Unbound {
        return variables.container(step.text("container"));
    }

    private Operation addComponent(Node step) throws Unbound {
        C container = container(step);
        String component = step.text("component");
        Map<String, String> attributes = new LinkedHashMap<>();
        if (scenario.node("components").get(component) instanceof Node declaration) {
            declaration.node("attributes").fields().forEach((name, value) -> attributes.put(name, (String) value));
        }
        return () -> {
            int given = adapter.addComponent(container, component, attributes);
            variables.bindId(step.text("bind").isEmpty() ? component : step.text("bind"), given);
            return given;
        };
    }

    private Operation getPortElement(Node step) throws Unbound {
        C container = container(step);
        int member = variables.id(step.text("id"));
        return () -> {
            PortElement reference = adapter.getPortElement(container, member, step.text("port"));
            variables.bindReference(step.text("bind"), reference);
            return stage.recognise(reference);
        };
    }

    private Operation connect(Node step) throws Unbound {
        C container = container(step);
        int member = variables.id(step.text("id"));
        PortElement reference = variables.reference(step.text("to"));
        return () -> {
            int given = adapter.connect(container, member, step.text("port"), reference);
            variables.bindId(step.text("bind"), given);
            return given;
        };
    }

    private Operation getComponents(Node step) throws Unbound {
        C container = container(step);
        return () -> {
            List<Integer> members = adapter.getComponents(container);
            if (members == null || members.stream().anyMatch(Objects::isNull)) {
                throw new ContractBroken("returned " + members + "; it returns a list of integers");
            }
            List<Integer> ids = List.copyOf(members);
            variables.saw(ids);
            return ids;
        };
    }

    private Operation invoke(Node step) throws Unbound {
        PortElement reference = variables.reference(step.text("ref"));
        if (reference == null) { // nothing can be called through a null reference
            throw new Unbound(step.text("ref"));
        }
        return () -> reference.exchange((int) step.number("value"));
    }

    private Object readLog(long records) throws Exception {
        long deadline = System.nanoTime() + patience;
        while (true) {
            List<Adapter.LogRecord> read = adapter.readLog(manager);
            if (read == null || read.stream().anyMatch(Objects::isNull)) {
                throw new ContractBroken("returned " + read + "; it returns a list of records");
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
