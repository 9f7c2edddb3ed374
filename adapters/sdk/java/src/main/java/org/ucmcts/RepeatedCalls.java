package org.ucmcts;

import java.util.List;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicLong;

/** Calls from several threads, as many as possible within a time. */
final class RepeatedCalls {
    private final List<Runnable> visits;
    private final long nanoseconds;
    private final CountDownLatch missing;
    private final AtomicLong calls = new AtomicLong();
    private final AtomicLong failed = new AtomicLong();

    RepeatedCalls(List<Runnable> visits, long milliseconds) {
        this.visits = visits;
        nanoseconds = TimeUnit.MILLISECONDS.toNanos(Math.max(milliseconds, 0));
        missing = new CountDownLatch(visits.size());
    }

    /** Repeats each visit on a worker of its own, named after {@code name}; all begin at the same time. */
    void run(Workers workers, String name) {
        for (int index = 0; index < visits.size(); index++) {
            Runnable visit = visits.get(index);
            workers.queue(name + " " + index, () -> keepVisiting(visit));
        }
        for (int index = 0; index < visits.size(); index++) {
            workers.join(name + " " + index);
        }
    }

    /** How many calls came back. */
    long calls() {
        return calls.get();
    }

    /** How many threw. */
    long failed() {
        return failed.get();
    }

    private void keepVisiting(Runnable visit) {
        missing.countDown();
        while (missing.getCount() > 0) {
            Thread.onSpinWait();
        }
        long end = System.nanoTime() + nanoseconds;
        while (System.nanoTime() < end) {
            try {
                visit.run();
                calls.incrementAndGet();
            } catch (Throwable error) { // the framework may throw anything
                failed.incrementAndGet();
            }
        }
    }
}
