package org.ucmcts;

import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.function.Function;
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
            case "call_method" -> callMethod(action, entry);
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

    /** Makes the calls of {@code action}, if what they need is there. */
    private void callMethod(Action action, Memory.Entry entry) {
        List<Object> given = arguments(action, entry);
        if (given == null) {
            return;
        }
        String method = action.method();
        if (action.on() != null) {
            Memory.Timer of = probe.memory.timer(action.on(), entry);
            if (of != null) {
                call(new Callee(action.port(), method, action.handler(), of.number()), given,
                        arguments -> ObjectTimers.call(of.timer(), method, arguments));
            }
            return;
        }
        Callee callee = new Callee(action.port(), method, action.handler(), null);
        TimerHandler handler = probe.handlers.get(action.handler());
        referencesOf(action.port()).forEach(reference -> call(callee, given, action.handler() == null
                ? arguments -> reference.call(method, arguments)
                : arguments -> ObjectTimers.schedule(reference, method, handler, arguments)));
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
        if (clocks.isEmpty()) {
            return null;
        }
        List<Object> time = call(new Callee(of.port(), of.method(), null, null), List.of(),
                arguments -> clocks.get(0).call(of.method(), arguments));
        return Timers.dateFrom(given, of.argument(), time);
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

    /**
     * What a call is recorded with: the name of the {@code handler} that is passed, the number of the object {@code
     * timer} that is called; null if there is none.
     */
    private record Callee(String port, String method, String handler, Long timer) {}

    /** Makes a call: takes arguments, gives results. Returns the results as recorded, nothing if it threw. */
    private List<Object> call(Callee callee, List<Object> given, Function<List<Object>, List<?>> calling) {
        String port = callee.port();
        List<Object> arguments = Data.copy(given);
        List<Object> answer = List.of();
        probe.record("request", "port", port, "method", callee.method(), "arguments", given,
                "handler", callee.handler(), "timer", callee.timer());
        try {
            List<?> results = calling.apply(arguments);
            if (callee.handler() == null) {
                answer = reply(port, results, null);
            } else {
                replyWithTimer(callee, results);
            }
        } catch (DeclaredException error) {
            reply(port, error.fields(), error.name());
        } catch (Throwable error) { // the callee may throw anything
            probe.record("reply", "port", port, "raised", true);
        }
        Data.overwrite(arguments); // they are the caller's own
        return answer;
    }

    private List<Object> reply(String port, List<?> results, String exception) {
        boolean isSound = Data.isData(results);
        List<Object> given = isSound ? Data.copy(results) : List.of();
        String wrong = isSound ? null : Data.inWords(results);
        probe.record("reply", "port", port, "results", given, "exception", exception, "wrong", wrong);
        if (isSound) {
            Data.overwriteParts(results); // they are the caller's own
        }
        return given;
    }

    /** A scheduler has returned: a timer, nothing, or null where a timer is due. */
    private void replyWithTimer(Callee callee, List<?> results) {
        String port = callee.port();
        if (results.isEmpty()) {
            probe.record("reply", "port", port, "results", List.of());
        } else if (results.get(0) instanceof ObjectTimer timer) {
            probe.memory.takeTimer(callee.method(), timer,
                    number -> probe.record("reply", "port", port, "results", List.of(), "timer", number));
        } else {
            String wrong = Data.inWords(results.get(0)) + " as the timer";
            probe.record("reply", "port", port, "results", List.of(), "wrong", wrong);
        }
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
