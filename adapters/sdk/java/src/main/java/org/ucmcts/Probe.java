package org.ucmcts;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.Collections;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;
import org.ucmcts.Messages.Action;
import org.ucmcts.Messages.Declaration;

/**
 * A component body that records what a framework does to it and acts as its plan says. Silent, and without a plan,
 * once the recording has stopped.
 */
class Probe implements Body {
    private static final Set<String> SELF_EXECUTING = Set.of(
            "protected_self-executing_component",
            "periodic_self-executing_component",
            "background_self-executing_component");
    private static final String SELF_EXECUTION_API = "self-execution_api";

    final Stage stage;
    private final String component;
    private final int instance;
    private final Map<String, List<Action>> plan;
    private final Map<String, Port> ports = new HashMap<>();
    private final Runnable execution;
    private final Port timerCallback;
    private final Map<String, String> attributes = Collections.synchronizedMap(new LinkedHashMap<>());
    private final Actions actions;
    final Memory memory;
    final Map<String, TimerHandler> handlers = new HashMap<>();

    private Probe(Stage stage, String component, Declaration declaration) {
        this.stage = stage;
        this.component = component;
        instance = stage.count(component);
        plan = declaration.plan();
        memory = new Memory(plan);
        actions = new Actions(this);
        for (String port : declaration.provides()) {
            ports.put(port, new Port(this, port));
        }
        boolean executesItself =
                declaration.policies().stream().anyMatch(p -> SELF_EXECUTING.contains(p.definition()));
        execution = executesItself ? this::run : null;
        boolean hasTimers = declaration.policies().stream().anyMatch(p -> Timers.POLICY.equals(p.definition()));
        timerCallback = hasTimers ? new Port(this, Timers.CALLBACK) : null;
        for (String name : declaration.handlers()) {
            handlers.put(name, (timer, deltaTime, round) -> onTrigger(name, timer, deltaTime, round));
        }
    }

    /** The next body for {@code component}. */
    static Probe make(Stage stage, String component, Declaration declaration) {
        if (declaration.connectable()) {
            return declaration.fragment()
                    ? new ConnectableFragment(stage, component, declaration)
                    : new ConnectableOnly(stage, component, declaration);
        }
        return declaration.fragment()
                ? new FragmentOnly(stage, component, declaration)
                : new Probe(stage, component, declaration);
    }

    /** A provided port element of a probe. */
    record Port(Probe probe, String name) implements PortElement {
        @Override
        public int exchange(int value) {
            return probe.exchange(name, value);
        }

        @Override
        public List<Object> call(String method, List<Object> arguments) {
            return probe.call(name, method, arguments);
        }

        @Override
        public boolean equals(Object other) {
            return this == other;
        }

        @Override
        public int hashCode() {
            return System.identityHashCode(this);
        }

        /** What the trace calls it. */
        Map<String, Object> identity() {
            return Map.of("component", probe.component, "instance", probe.instance, "port", name);
        }
    }

    /** What a probe throws when its plan says {@code raise}: an exception no interface declares. */
    static final class PlannedFailure extends RuntimeException {
        private static final long serialVersionUID = 1;

        private PlannedFailure(String component, String hook) {
            super(component + " fails in " + hook + ", as planned");
        }
    }

    @Override
    public void setAttribute(String name, String value) {
        if (name != null) {
            attributes.put(name, value == null ? Data.inWords(null) : value);
        }
    }

    @Override
    public void onInit() {
        synchronized (attributes) {
            visit("on_init", null, null, "attributes", Map.copyOf(attributes));
        }
    }

    @Override
    public void onStartup(List<PortConnection> dependencies) {
        List<Object> recorded = new ArrayList<>();
        Map<String, List<PortElement>> references = new HashMap<>();
        String wrong = wrongIn(dependencies);
        for (PortConnection connection : wrong == null ? dependencies : List.<PortConnection>of()) {
            List<Object> recognised = new ArrayList<>();
            for (PortElement reference : connection.toPort()) {
                recognised.add(stage.recognise(reference));
                if (reference != null) {
                    references.computeIfAbsent(connection.fromPort(), any -> new ArrayList<>()).add(reference);
                }
            }
            recorded.add(Map.of("port", connection.fromPort(), "references", recognised));
        }
        actions.references = references;
        visit("on_startup", null, null, "dependencies", recorded, "wrong", wrong);
    }

    /** What of the connections is of a wrong type or too much, for people; null if nothing is. */
    private static String wrongIn(List<PortConnection> dependencies) {
        if (dependencies == null) {
            return Data.inWords(null) + " as its connections";
        }
        if (dependencies.size() > Data.MOST) {
            return Data.tooMany("connections");
        }
        for (PortConnection connection : dependencies) {
            if (connection == null || connection.fromPort() == null) {
                String what = connection == null ? " as a connection" : " as the name of a port element";
                return Data.inWords(null) + what;
            }
            if (connection.toPort() == null) {
                return Data.inWords(null) + " as the references of " + connection.fromPort();
            }
            if (connection.toPort().size() > Data.MOST) {
                return Data.tooMany("references of " + connection.fromPort());
            }
        }
        return null;
    }

    @Override
    public void onShutdown() {
        try {
            visit("on_shutdown", null, null);
        } finally {
            actions.references = Map.of();
        }
    }

    @Override
    public void onRemove() {
        try {
            visit("on_remove", null, null);
        } finally {
            actions.container = null;
        }
    }

    @Override
    public PortElement getPortElement(String provided) {
        return ports.get(provided);
    }

    @Override
    public Runnable getPolicyElement(String policy, String element) {
        boolean executed = policy != null && SELF_EXECUTING.contains(policy);
        return executed && SELF_EXECUTION_API.equals(element) ? execution : null;
    }

    @Override
    public PortElement getPolicyPort(String policy, String element) {
        return Timers.POLICY.equals(policy) && Timers.CALLBACK.equals(element) ? timerCallback : null;
    }

    private void run() {
        if (!stage.isStressed(this)) {
            visit("run", null, null);
        }
    }

    private int exchange(String port, int value) {
        return stage.isStressed(this) ? ~value : visit("exchange", ~value, (long) value, "port", port, "value", value);
    }

    private List<Object> call(String port, String method, List<Object> arguments) {
        if (!stage.recorder.isRecording()) {
            return List.of();
        }
        boolean isSound = Data.isData(arguments);
        boolean counts = actions("method").stream().anyMatch(action -> action.tag().equals("count"));
        if (isSound && counts && !arguments.isEmpty() && arguments.get(0) instanceof Number number) {
            stage.messages.add(component, instance, number.longValue());
            return List.of("ok");
        }
        List<Object> given = isSound ? Data.copy(arguments) : List.of();
        String wrong = isSound && !counts ? null : Data.inWords(arguments);
        Action answer = follow(method, enter(port, method, given, wrong, null));
        List<Object> results = answer == null ? List.of() : answer.results();
        results = Data.copy(results == null ? given : results);
        String exception = answer == null ? null : answer.exception();
        record("exit", "hook", "method", "results", Data.copy(results), "exception", exception);
        if (answer != null && answer.overwrite() && arguments != null) {
            Data.overwrite(arguments);
        }
        if (exception != null) {
            throw new DeclaredException(exception, results);
        }
        return results;
    }

    /** The method of a handler of object timers, which gives no results. */
    private void onTrigger(String handler, ObjectTimer timer, List<? extends Number> deltaTime, long round) {
        if (!stage.recorder.isRecording()) {
            return;
        }
        List<Object> arguments = Arrays.asList(deltaTime, round);
        String wrong = Data.isData(arguments) ? null : Data.inWords(arguments);
        if (timer == null) {
            wrong = Data.inWords(null) + " as the timer";
        }
        List<Object> given = wrong == null ? Data.copy(arguments) : List.of();
        follow(ObjectTimers.ON_TRIGGER,
                enter(handler, ObjectTimers.ON_TRIGGER, given, wrong, wrong == null ? timer : null));
        record("exit", "hook", "method", "results", List.of());
    }

    /** Records an entry at a method, with the object timer that came with it, or null. */
    private Memory.Entry enter(String port, String method, List<Object> given, String wrong, ObjectTimer timer) {
        return memory.enter(method, given, timer, entry -> record(
                "enter", "hook", "method", "port", port, "method", method, "arguments", given, "wrong", wrong,
                "timer", entry.timer()));
    }

    /** Carries out the plan for an entry at {@code method}; returns its answer, null if it has none. */
    private Action follow(String method, Memory.Entry entry) {
        Action answer = null;
        for (Action action : actions("method")) {
            if (action.tag().equals("raise")) {
                record("exit", "hook", "method", "raised", true);
                throw new PlannedFailure(component, method);
            }
            if (!action.tag().equals("answer")) {
                actions.act(action, entry);
            } else if (action.method().equals(method)) {
                answer = action;
            }
        }
        return answer;
    }

    /**
     * Records {@code enter}, carries out the plan, records {@code exit}; returns what the hook returns.
     *
     * @param given the argument of {@code exchange}, or null
     */
    private Integer visit(String hook, Integer result, Long given, Object... arguments) {
        if (!stage.recorder.isRecording()) {
            return result;
        }
        List<Object> entered = new ArrayList<>(List.of("hook", hook));
        Collections.addAll(entered, arguments);
        record("enter", entered.toArray());
        Integer returned = result;
        Memory.Entry entry = new Memory.Entry("", List.of(), given, null);
        for (Action action : actions(hook)) {
            switch (action.tag()) {
                case "raise" -> {
                    record("exit", "hook", hook, "raised", true);
                    throw new PlannedFailure(component, hook);
                }
                case "return" -> {
                    if (hook.equals("exchange")) {
                        returned = (int) action.value();
                    }
                }
                default -> actions.act(action, entry);
            }
        }
        record("exit", "hook", hook, "value", returned);
        return returned;
    }

    private List<Action> actions(String hook) {
        return plan.getOrDefault(hook, List.of());
    }

    /** Records an event inside this body. */
    final void record(String kind, Object... fields) {
        List<Object> all = new ArrayList<>(List.of("component", component, "instance", instance));
        Collections.addAll(all, fields);
        stage.recorder.record(kind, all.toArray());
    }

    private static String wrongIn(String portName) {
        return portName == null ? Data.inWords(null) : null;
    }

    /** For those that are {@link Connectable}. */
    public final void onConnect(String portName, PortElement required) {
        Object reference = stage.recognise(required);
        visit("on_connect", null, null, "port", portName, "reference", reference, "wrong", wrongIn(portName));
    }

    /** For those that are {@link Connectable}. */
    public final void onDisconnect(String portName) {
        visit("on_disconnect", null, null, "port", portName, "wrong", wrongIn(portName));
    }

    /** For those that are {@link Fragment}. */
    public final void setContainerInterface(Fragment.ContainerInterface container) {
        actions.container = container;
        visit("set_container_interface", null, null);
    }

    private static final class ConnectableOnly extends Probe implements Connectable {
        private ConnectableOnly(Stage stage, String component, Declaration declaration) {
            super(stage, component, declaration);
        }
    }

    private static final class FragmentOnly extends Probe implements Fragment {
        private FragmentOnly(Stage stage, String component, Declaration declaration) {
            super(stage, component, declaration);
        }
    }

    private static final class ConnectableFragment extends Probe implements Connectable, Fragment {
        private ConnectableFragment(Stage stage, String component, Declaration declaration) {
            super(stage, component, declaration);
        }
    }
}
