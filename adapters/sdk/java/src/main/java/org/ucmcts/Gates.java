package org.ucmcts;

import java.util.HashMap;
import java.util.HashSet;
import java.util.Map;
import java.util.Set;

/** The gates of one scenario, by name: where probes wait until the scenario lets them go on. */
final class Gates {
    private final long patience;
    private final Map<String, Long> arrivals = new HashMap<>();
    private final Set<String> opened = new HashSet<>();
    private final Map<Thread, String> holding = new HashMap<>();
    private boolean allOpen;

    /** {@code patience} is the longest wait in nanoseconds. */
    Gates(long patience) {
        this.patience = patience;
    }

    /**
     * A probe arrives and waits until the gate is open. {@code record} is run before any thread can learn of the
     * arrival.
     */
    synchronized void hold(String gate, Runnable record) {
        record.run();
        arrivals.merge(gate, 1L, Long::sum);
        holding.put(Thread.currentThread(), gate);
        notifyAll();
        Waiting.until(this, patience, () -> isOpen(gate));
        holding.remove(Thread.currentThread());
    }

    /** Is {@code thread} in a probe that waits at a closed gate? */
    synchronized boolean isHeld(Thread thread) {
        String gate = holding.get(thread);
        return gate != null && !isOpen(gate);
    }

    /**
     * Waits until a probe has arrived at the gate, or {@code more} have from now on, or {@code total} in all; false
     * when patience runs out.
     */
    synchronized boolean reach(String gate, long more, long total) {
        long enough = Math.max(more > 0 ? arrived(gate) + more : 1, total);
        return Waiting.until(this, patience, () -> arrived(gate) >= enough);
    }

    /** Opens the gate for good. {@code record} is run before any probe goes on. */
    synchronized void open(String gate, Runnable record) {
        record.run();
        opened.add(gate);
        notifyAll();
    }

    /** Opens every gate, known or not, for good. */
    synchronized void openAll() {
        allOpen = true;
        notifyAll();
    }

    private long arrived(String gate) {
        return arrivals.getOrDefault(gate, 0L);
    }

    private boolean isOpen(String gate) {
        return allOpen || opened.contains(gate);
    }
}
