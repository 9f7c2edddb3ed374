package org.ucmcts;

import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import org.ucmcts.Messages.Action;
import org.ucmcts.Messages.FromClock;

/** The actions of a probe's plan that call others, wait or ask. */
final class Actions {
    private final Probe probe;

    /** The references given for each required port element at {@code on_startup}, without null ones. */
    volatile Map<String, List<PortElement>> references = Map.of();

    /** What a fragment was given, or null. */
    volatile Fragment.ContainerInterface container;

    Actions(Probe probe) {
        this.probe = probe;
    }

    /** Carries {@code action} of the plan for {@code entry} out; kinds that are not listed have no effect. */
    void act(Action action, Memory.Entry entry) {
        switch (action.tag()) {
            case "call" -> referencesOf(action.port()).forEach(reference -> exchange(action, reference));
            case "call_method" -> {
                List<Object> given = arguments(action, entry);
                if (given != null) {
                    referencesOf(action.port()).forEach(
                            reference -> call(action.port(), action.method(), given, reference));
                }
            }
            case "burst" -> referencesOf(action.port()).forEach(reference -> push(action, reference));
            case "hold" -> {
                String gate = action.gate();
                probe.stage.gates.hold(gate, () -> probe.record("held", "gate", gate));
            }
            case "siblings" -> querySiblings();
            default -> { }
        }
    }

    private List<PortElement> referencesOf(String port) {
        return references.getOrDefault(port, List.of());
    }

    /**
     * What {@code action} calls with, null if it is not to call. The body's clock is read for an argument that is a
     * date.
     */
    private List<Object> arguments(Action action, Memory.Entry entry) {
        List<Object> given = probe.memory.arguments(action, entry);
        FromClock of = action.fromClock();
        if (given == null || of == null) {
            return given;
        }
        List<PortElement> clocks = referencesOf(of.port());
        return clocks.isEmpty()
                ? null
                : Timers.dateFrom(given, of.argument(), call(of.port(), of.method(), List.of(), clocks.get(0)));
    }

    private void exchange(Action action, PortElement reference) {
        String port = action.port();
        long value = action.value();
        probe.record("request", "port", port, "value", value);
        int result;
        try {
            result = reference.exchange((int) value);
        } catch (Throwable error) { // the callee may throw anything
            probe.record("reply", "port", port, "raised", true);
            return;
        }
        probe.record("reply", "port", port, "value", result);
    }

    /** Returns the results as recorded, nothing if it threw. */
    private List<Object> call(String port, String method, List<Object> given, PortElement reference) {
        List<Object> arguments = Data.copy(given);
        List<Object> answer = List.of();
        probe.record("request", "port", port, "method", method, "arguments", given);
        try {
            answer = reply(port, reference.call(method, arguments), null);
        } catch (DeclaredException error) {
            reply(port, error.fields(), error.name());
        } catch (Throwable error) { // the callee may throw anything
            probe.record("reply", "port", port, "raised", true);
        }
        Data.overwrite(arguments); // they are the caller's own
        return answer;
    }

    private List<Object> reply(String port, List<Object> results, String exception) {
        boolean isSound = Data.isData(results);
        List<Object> given = isSound ? Data.copy(results) : List.of();
        String wrong = isSound ? null : Data.inWords(results);
        probe.record("reply", "port", port, "results", given, "exception", exception, "wrong", wrong);
        return given;
    }

    private void push(Action action, PortElement reference) {
        Map<String, Long> answers = new TreeMap<>();
        long first = action.first();
        for (long value = first; value < first + action.count(); value++) {
            String code;
            try {
                List<Object> results = reference.call("push", new ArrayList<>(List.of(value)));
                code = results.isEmpty() ? "" : String.valueOf(results.get(0));
            } catch (Throwable error) { // the callee may throw anything
                code = "raised";
            }
            answers.merge(code, 1L, Long::sum);
        }
        probe.record("pushed", "port", action.port(), "first", first, "count", action.count(),
                "answers", answers);
    }

    private void querySiblings() {
        List<?> members;
        try {
            members = container.getComponents();
        } catch (Throwable error) { // thrown by the framework, or because it gave no container
            probe.record("siblings", "raised", true);
            return;
        }
        List<Object> ids = new ArrayList<>();
        String wrong = members == null ? Data.inWords(null) : null;
        try {
            for (Object member : members == null ? List.of() : members) {
                if (!(member instanceof Integer)) {
                    wrong = Data.inWords(members);
                } else if (ids.size() == Data.MOST) {
                    wrong = Data.tooMany("ids");
                }
                if (wrong != null) {
                    break;
                }
                ids.add(member);
            }
        } catch (RuntimeException error) { // the list is the framework's
            wrong = Data.inWords(members);
        }
        probe.record("siblings", "ids", wrong == null ? ids : List.of(), "wrong", wrong);
    }
}
