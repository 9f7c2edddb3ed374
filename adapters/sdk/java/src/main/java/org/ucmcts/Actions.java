package org.ucmcts;

import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;

/** What a probe does on its own account when its plan says so. */
final class Actions {
    private final Probe probe;

    /** The references given for each required port element at {@code on_startup}, without null ones. */
    volatile Map<String, List<PortElement>> references = Map.of();

    /** What a fragment was given, or null. */
    volatile Fragment.ContainerInterface container;

    Actions(Probe probe) {
        this.probe = probe;
    }

    /** Carries {@code action} out; what is not done here means nothing at this hook. */
    void act(Node action) {
        switch (action.text("do")) {
            case "call" -> referencesOf(action).forEach(reference -> exchange(action, reference));
            case "call_method" -> referencesOf(action).forEach(reference -> call(action, reference));
            case "burst" -> referencesOf(action).forEach(reference -> push(action, reference));
            case "hold" -> {
                String gate = action.text("gate");
                probe.stage.gates.hold(gate, () -> probe.record("held", "gate", gate));
            }
            case "siblings" -> querySiblings();
            default -> { }
        }
    }

    private List<PortElement> referencesOf(Node action) {
        return references.getOrDefault(action.text("port"), List.of());
    }

    private void exchange(Node action, PortElement reference) {
        String port = action.text("port");
        long value = action.number("value");
        probe.record("request", "port", port, "value", value);
        int result;
        try {
            result = reference.exchange((int) value);
        } catch (Throwable error) { // whatever the callee threw
            probe.record("reply", "port", port, "raised", true);
            return;
        }
        probe.record("reply", "port", port, "value", result);
    }

    private void call(Node action, PortElement reference) {
        String port = action.text("port");
        String method = action.text("method");
        List<Object> arguments = Data.copy(action.list("arguments"));
        probe.record("request", "port", port, "method", method, "arguments", action.list("arguments"));
        try {
            reply(action, reference.call(method, arguments), null);
        } catch (DeclaredException error) {
            reply(action, error.fields(), error.name());
        } catch (Throwable error) { // whatever the callee threw
            probe.record("reply", "port", port, "raised", true);
        }
        Data.overwrite(arguments); // they are the caller's own
    }

    private void reply(Node action, List<Object> results, String exception) {
        if (!Data.isData(results)) {
            probe.stage.recorder.complain(
                    action.text("method") + " gave " + results + " to a probe, which are no values");
            return;
        }
        probe.record("reply", "port", action.text("port"), "results", Data.copy(results), "exception", exception);
    }

    private void push(Node action, PortElement reference) {
        Map<String, Long> answers = new TreeMap<>();
        long first = action.number("first");
        for (long value = first; value < first + action.number("count"); value++) {
            String code;
            try {
                List<Object> results = reference.call("push", new ArrayList<>(List.of(value)));
                code = results.isEmpty() ? "" : String.valueOf(results.get(0));
            } catch (Throwable error) { // whatever the callee threw
                code = "raised";
            }
            answers.merge(code, 1L, Long::sum);
        }
        probe.record("pushed", "port", action.text("port"), "first", first, "count", action.number("count"),
                "answers", answers);
    }

    private void querySiblings() {
        List<Integer> members;
        try {
            members = List.copyOf(container.getComponents());
        } catch (Throwable error) { // whatever the framework threw, and what comes of having been given nothing
            probe.record("siblings", "raised", true);
            return;
        }
        probe.record("siblings", "ids", members);
    }
}
