package org.ucmcts;

import java.util.concurrent.atomic.AtomicLong;

/** Counts threads that meet inside one body while it is stressed. */
final class Occupancy {
    // In every other slot visitors stay for a moment, which finds locks that are missing now and then; in the others
    // they leave at once, which finds locks that are checked first and taken afterwards. In nanoseconds.
    private static final long SLOT = 10_000_000;

    private final AtomicLong overlaps = new AtomicLong();
    private volatile Object inside;

    /** Goes in, stays, checks whether another thread came, and leaves. */
    void visit() {
        Object own = new Object();
        boolean met = inside != null;
        inside = own;
        if (System.nanoTime() / SLOT % 2 == 0) {
            Thread.yield();
        } else {
            Thread.onSpinWait();
        }
        if (met || inside != own) {
            overlaps.incrementAndGet();
        }
        inside = null;
    }

    /** How often two threads met. */
    long overlaps() {
        return overlaps.get();
    }
}
