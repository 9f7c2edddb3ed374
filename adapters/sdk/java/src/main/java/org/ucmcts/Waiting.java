package org.ucmcts;

import java.util.concurrent.TimeUnit;
import java.util.function.BooleanSupplier;

/** Waiting on monitors until a condition holds, even if a framework interrupts the thread meanwhile. */
final class Waiting {
    private static final long LONGEST_PATIENCE = 24L * 60 * 60 * 1000;

    private Waiting() {}

    /** A scenario's patience in nanoseconds. */
    static long patience(long milliseconds) {
        return TimeUnit.MILLISECONDS.toNanos(Math.min(Math.max(milliseconds, 0), LONGEST_PATIENCE));
    }

    /**
     * Waits on {@code monitor}, which the caller holds, until {@code condition} holds or so many nanoseconds have
     * passed; returns whether it holds. An interrupt is kept for later.
     */
    static boolean until(Object monitor, long nanoseconds, BooleanSupplier condition) {
        long deadline = System.nanoTime() + nanoseconds;
        boolean interrupted = false;
        try {
            while (!condition.getAsBoolean()) {
                long rest = deadline - System.nanoTime();
                if (rest <= 0) {
                    return false;
                }
                try {
                    monitor.wait(rest / 1_000_000, (int) (rest % 1_000_000));
                } catch (InterruptedException error) {
                    interrupted = true;
                }
            }
            return true;
        } finally {
            if (interrupted) {
                Thread.currentThread().interrupt();
            }
        }
    }

    /** Lets so many nanoseconds pass. */
    static void pass(long nanoseconds) {
        Object monitor = new Object();
        synchronized (monitor) {
            until(monitor, nanoseconds, () -> false);
        }
    }
}
