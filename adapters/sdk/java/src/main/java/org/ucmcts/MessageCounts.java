package org.ucmcts;

import java.util.HashMap;
import java.util.HashSet;
import java.util.Map;
import java.util.NavigableSet;
import java.util.Set;
import java.util.TreeSet;

/** What bodies count instead of recording: the messages of bursts. */
final class MessageCounts {
    private static final long BLOCK = 1L << 20; // messages of one emitter lie within a block of so many numbers

    private final long patience;
    private final Map<String, Count> counts = new HashMap<>();

    /** {@code patience} is the longest wait in nanoseconds. */
    MessageCounts(long patience) {
        this.patience = patience;
    }

    /** A message has been pushed to that body. */
    synchronized void add(String component, long instance, long value) {
        Count count = of(component, instance);
        count.add(value);
        notifyAll();
    }

    /** Waits until the body has counted so many; what it has counted then, as fields of the event. */
    synchronized Object[] await(String component, long instance, long messages) {
        Count count = of(component, instance);
        Waiting.until(this, patience, () -> count.received >= messages);
        NavigableSet<Long> seen = new TreeSet<>(count.seen);
        return new Object[] {
            "component", component,
            "instance", instance,
            "received", count.received,
            "distinct", seen.size(),
            "disordered", count.disordered,
            "least", seen.isEmpty() ? 0L : seen.first(),
            "greatest", seen.isEmpty() ? 0L : seen.last()
        };
    }

    private Count of(String component, long instance) {
        return counts.computeIfAbsent(component + " " + instance, any -> new Count());
    }

    private static final class Count {
        private long received;
        private long disordered;
        private final Set<Long> seen = new HashSet<>();
        private final Map<Long, Long> greatest = new HashMap<>();

        private void add(long value) {
            long block = Math.floorDiv(value, BLOCK);
            received++;
            seen.add(value);
            if (value < greatest.getOrDefault(block, value)) {
                disordered++;
            } else {
                greatest.put(block, value);
            }
        }
    }
}
