package org.ucmcts;

import java.nio.file.Path;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Deque;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.function.Predicate;

/** Threads by name, each made when its first task is queued, each doing its tasks in order. Tasks must not throw. */
final class Workers {
    /**
     * Nanoseconds that workers have at least to end, in all: on a busy machine a thread may need longer than a short
     * patience.
     */
    private static final long FAREWELL = 400_000_000L;

    private final long patience;
    private final Map<String, Worker> workers = new LinkedHashMap<>();

    /** {@code patience} is the longest wait in nanoseconds. */
    Workers(long patience) {
        this.patience = patience;
    }

    /** Gives worker {@code name} one more task; returns at once. */
    void queue(String name, Runnable task) {
        Worker worker;
        synchronized (workers) {
            worker = workers.computeIfAbsent(name, Worker::new);
        }
        worker.queue(task);
    }

    /** Waits until worker {@code name}, if there is one, has done all it was given; false when patience runs out. */
    boolean join(String name) {
        Worker worker = find(name);
        return worker == null || worker.waitUntilIdle(patience);
    }

    /**
     * Waits until worker {@code name} is {@code done}, {@code held} at a gate or {@code blocked} by the operating
     * system; {@code running} when patience runs out.
     */
    String settle(String name, Predicate<Thread> isHeld) {
        Worker worker = find(name);
        long deadline = System.nanoTime() + patience;
        SleepWatch watch = worker == null ? null : new SleepWatch(worker.thread, () -> worker.status);
        while (worker != null && !worker.waitUntilIdle(0)) {
            if (isHeld.test(worker.thread)) {
                return "held";
            }
            if (watch.isBlocked()) {
                return "blocked";
            }
            if (System.nanoTime() >= deadline) {
                return "running";
            }
            worker.waitUntilIdle(SleepWatch.PAUSE);
        }
        return "done";
    }

    /** Ends all workers; returns the names of those that do not come back in time. Queue nothing afterwards. */
    List<String> finish() {
        List<String> stuck = new ArrayList<>();
        Map<String, Worker> all;
        synchronized (workers) { // not held below: a worker may yet want to join another
            all = new LinkedHashMap<>(workers);
        }
        long deadline = System.nanoTime() + Math.max(patience, FAREWELL);
        all.forEach((name, worker) -> {
            worker.quit();
            if (!worker.waitUntilIdle(deadline - System.nanoTime())) {
                stuck.add(name);
            }
        });
        return stuck;
    }

    private Worker find(String name) {
        synchronized (workers) {
            return workers.get(name);
        }
    }

    private static final class Worker {
        private final Deque<Runnable> tasks = new ArrayDeque<>();
        private final Thread thread;
        private volatile Path status;
        private boolean busy;
        private boolean quitting;

        private Worker(String name) {
            thread = new Thread(this::work, "worker " + name);
            thread.setDaemon(true);
            thread.start();
        }

        private void work() {
            status = SleepWatch.statusOfThisThread();
            while (true) {
                Runnable task;
                synchronized (this) {
                    Waiting.until(this, Long.MAX_VALUE, () -> quitting || !tasks.isEmpty());
                    if (tasks.isEmpty()) {
                        return;
                    }
                    task = tasks.remove();
                    busy = true;
                }
                task.run();
                synchronized (this) {
                    busy = false;
                    notifyAll();
                }
            }
        }

        private synchronized void queue(Runnable task) {
            tasks.add(task);
            notifyAll();
        }

        private synchronized boolean waitUntilIdle(long nanoseconds) {
            return Waiting.until(this, nanoseconds, () -> tasks.isEmpty() && !busy);
        }

        private synchronized void quit() {
            quitting = true;
            notifyAll();
        }
    }
}
