package org.ucmcts;

import java.util.ArrayList;
import java.util.List;

/** The policy of index timers (10.3.2), the port element that it makes a body provide, and dates of its time-outs. */
final class Timers {
    static final String POLICY = "itt_timer";
    static final String CALLBACK = "timer_callback";
    private static final long LARGEST_SECONDS = 0xFFFFFFFFL;

    private Timers() {}

    /**
     * {@code arguments} whose time-out at {@code position} counts from the seconds of {@code time}, what a method of a
     * clock gave; null if it gave no time, no time-out is there, or no clock shows such a date.
     */
    static List<Object> dateFrom(List<Object> arguments, long position, List<Object> time) {
        if (time.size() != 1 || position < 0 || position >= arguments.size()) {
            return null;
        }
        List<Object> now = pair(time.get(0));
        List<Object> timeout = pair(arguments.get((int) position));
        if (now == null || timeout == null || !isNumber(now.get(1))) {
            return null;
        }
        long shown = first(now);
        long more = first(timeout);
        if (shown < 0 || shown > LARGEST_SECONDS || more < -shown || more > LARGEST_SECONDS - shown) {
            return null; // no clock shows such a time
        }
        List<Object> dated = new ArrayList<>(arguments);
        dated.set((int) position, List.of(shown + more, timeout.get(1)));
        return dated;
    }

    /** The two elements of {@code value}, the first of which is a number; null if it is anything else. */
    private static List<Object> pair(Object value) {
        List<Object> elements = value instanceof List ? Node.listOf(value) : List.of();
        return elements.size() == 2 && isNumber(elements.get(0)) ? elements : null;
    }

    private static boolean isNumber(Object value) {
        return value instanceof Integer || value instanceof Long;
    }

    private static long first(List<Object> pair) {
        return ((Number) pair.get(0)).longValue();
    }
}
