package org.ucmcts;

import java.util.HashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import org.ucmcts.Messages.Declaration;
import org.ucmcts.Messages.Scenario;

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

    /** The scenario's declarations as a framework sees them: implementations whose bodies are probes on this stage. */
    List<Implementation> implementations(Scenario scenario) {
        return scenario.components().entrySet().stream()
                .map(entry -> implementation(entry.getKey(), entry.getValue(), scenario.interfaces()))
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

    /** From now on probes record and do nothing; they count overlaps. */
    void beginStress(Map<Probe, Occupancy> counts) {
        occupancies = counts;
    }

    /** Probes follow their plans again. */
    void endStress() {
        occupancies = null;
    }

    /** Under stress: counts overlaps in {@code probe}; true, as the probe does nothing else then. */
    boolean isStressed(Probe probe) {
        Map<Probe, Occupancy> counts = occupancies;
        if (counts == null) {
            return false;
        }
        counts.computeIfAbsent(probe, any -> new Occupancy()).visit();
        return true;
    }

    private Implementation implementation(
            String name, Declaration declaration, Map<String, Messages.Interface> interfaces) {
        Map<String, Node> typed = new HashMap<>();
        declaration.ports().forEach((port, type) -> {
            if (!interfaces.containsKey(type)) {
                throw new IllegalArgumentException("there is no interface " + type);
            }
            typed.put(port, interfaces.get(type));
        });
        Set<String> attributes = new LinkedHashSet<>(declaration.attributes().keySet());
        attributes.addAll(declaration.defaults().keySet());
        return new Implementation(
                name,
                declaration.provides(),
                declaration.requires(),
                List.copyOf(attributes),
                declaration.connectable(),
                declaration.fragment(),
                () -> Probe.make(this, name, declaration),
                declaration.policies().stream()
                        .map(own -> new Policy(own.definition(), own.port(), own.parameters(), own.element()))
                        .toList(),
                typed,
                declaration.defaults());
    }
}
