package org.ucmcts;

import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.function.Consumer;

/**
 * Puts what happens during one scenario into one total order. The thread that makes the recorder is number 0, others
 * are numbered at their first event.
 */
final class Recorder {
    private final Consumer<Map<String, Object>> sink;
    private final ThreadLocal<Integer> numbers = new ThreadLocal<>();
    private final List<Map<String, Object>> events = new ArrayList<>();
    private int threads = 1;
    private boolean recording = true;
    private String complaint;

    /** {@code sink} receives each event as it happens, in order; it may be null. */
    Recorder(Consumer<Map<String, Object>> sink) {
        this.sink = sink;
        numbers.set(0);
    }

    /** Adds an event; {@code fields} are names and values by turns, and those that are null are left out. */
    synchronized void record(String kind, Object... fields) {
        if (!recording) {
            return;
        }
        if (numbers.get() == null) {
            numbers.set(threads++);
        }
        Map<String, Object> event =
                Json.object("kind", kind, "n", events.size() + 1, "t", System.nanoTime(), "thread", numbers.get());
        event.putAll(Json.object(fields));
        events.add(event);
        if (sink != null) {
            sink.accept(event);
        }
    }

    /** The adapter broke the contract, so the trace does not count; the first problem is reported. */
    synchronized void complain(String problem) {
        if (recording && complaint == null) {
            complaint = problem;
        }
    }

    /** How the adapter broke the contract; null if it did not. */
    synchronized String complaint() {
        return complaint;
    }

    synchronized boolean isRecording() {
        return recording;
    }

    /** Ends the recording and returns all events. */
    synchronized List<Map<String, Object>> stop() {
        recording = false;
        return List.copyOf(events);
    }
}
