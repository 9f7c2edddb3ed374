package org.ucmcts;

import java.util.HashMap;
import java.util.List;
import java.util.Map;

/** What the probes of one scenario share. */
final class Stage {
    final Recorder recorder;
    final Gates gates;
    final MessageCounts messages;
    private final Map<String, Integer> instances = new HashMap<>();
    private volatile Map<Probe, Occupancy> occupancies;

    /** {@code patience} is the longest wait of a probe, in nanoseconds. */
    Stage(Recorder recorder, long patience) {
        this.recorder = recorder;
        gates = new Gates(patience);
        messages = new MessageCounts(patience);
    }

    /**
     * The scenario's declarations as a framework sees them: implementations whose bodies are probes on this stage.
     */
    List<Implementation> implementations(Node scenario) {
        Node interfaces = scenario.node("interfaces");
        return scenario.node("components").fields().entrySet().stream()
                .map(entry -> implementation(entry.getKey(), (Node) entry.getValue(), interfaces))
                .toList();
    }

    /** Numbers the next body made for {@code component}, from 1, and records its creation. */
    synchronized int count(String component) {
        int instance = instances.merge(component, 1, Integer::sum);
        recorder.record("create", "component", component, "instance", instance);
        return instance;
    }

    /** What the trace calls {@code reference}: a probe's own port element is recognised, anything else is opaque. */
    Object recognise(PortElement reference) {
        if (reference == null) {
            return null;
        }
        boolean own = reference instanceof Probe.Port port && port.probe().stage == this;
        return own ? ((Probe.Port) reference).identity() : "opaque";
    }

    /** From now on probes record and do nothing, and count who meets whom. */
    void beginStress(Map<Probe, Occupancy> counts) {
        occupancies = counts;
    }

    /** Probes are themselves again. */
    void endStress() {
        occupancies = null;
    }

    /** Under stress: counts who is met in {@code probe}, and tells that there is nothing else to do. */
    boolean isStressed(Probe probe) {
        Map<Probe, Occupancy> counts = occupancies;
        if (counts == null) {
            return false;
        }
        counts.computeIfAbsent(probe, any -> new Occupancy()).visit();
        return true;
    }

    private Implementation implementation(String name, Node declaration, Node interfaces) {
        Map<String, Node> typed = new HashMap<>();
        declaration.node("ports").fields().forEach((port, type) -> {
            if (!interfaces.fields().containsKey(type)) {
                throw new IllegalArgumentException("there is no interface " + type);
            }
            typed.put(port, interfaces.node((String) type));
        });
        boolean connectable = declaration.flag("connectable");
        boolean fragment = declaration.flag("fragment");
        return new Implementation(
                name,
                declaration.texts("provides"),
                declaration.texts("requires"),
                List.copyOf(declaration.node("attributes").fields().keySet()),
                connectable,
                fragment,
                () -> Probe.make(this, name, declaration, connectable, fragment),
                declaration.nodes("policies").stream().map(Stage::policy).toList(),
                typed);
    }

    private static Policy policy(Node policy) {
        Map<String, String> parameters = new HashMap<>();
        policy.node("parameters").fields().forEach((name, value) -> parameters.put(name, (String) value));
        return new Policy(policy.text("definition"), policy.text("port"), parameters, policy.text("element"));
    }
}
