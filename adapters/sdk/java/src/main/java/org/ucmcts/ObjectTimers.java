package org.ucmcts;

import java.util.Collections;
import java.util.List;

/** Calls of schedulers and object timers (10.3.1) by the names of their methods. */
final class ObjectTimers {
    static final String ON_TRIGGER = "on_trigger";
    private static final String ONCE = "scheduler_trigger";
    private static final String REPEATED = "schedule_repeated_trigger";

    private ObjectTimers() {}

    /**
     * Calls {@code method} of {@code scheduler} with the arguments behind the handler. Gives the timer, or nothing if
     * the method returns none.
     */
    static List<?> schedule(PortElement scheduler, String method, TimerHandler handler, List<Object> arguments) {
        TimerScheduler called = (TimerScheduler) scheduler;
        switch (method) {
            case ONCE -> {
                check(method, arguments, 1);
                return Collections.singletonList(called.schedulerTrigger(handler, time(arguments.get(0))));
            }
            case REPEATED -> {
                check(method, arguments, 3);
                long rounds = ((Number) arguments.get(2)).longValue();
                ObjectTimer timer = called.scheduleRepeatedTrigger(
                        handler, time(arguments.get(0)), time(arguments.get(1)), rounds);
                return timer == null ? List.of() : List.of(timer);
            }
            default -> throw new UnsupportedOperationException(method);
        }
    }

    /** Calls {@code method} of {@code timer}; gives its result, nothing for {@code cancel}. */
    static List<?> call(ObjectTimer timer, String method, List<Object> arguments) {
        check(method, arguments, 0);
        switch (method) {
            case "cancel" -> {
                timer.cancel();
                return List.of();
            }
            case "is_cancelled" -> {
                return List.of(timer.isCancelled());
            }
            case "rounds" -> {
                return List.of(timer.rounds());
            }
            case "id" -> {
                return Collections.singletonList(timer.id());
            }
            default -> throw new UnsupportedOperationException(method);
        }
    }

    private static void check(String method, List<Object> arguments, int due) {
        if (arguments.size() != due) {
            throw new IllegalArgumentException(method + " takes other arguments");
        }
    }

    @SuppressWarnings("unchecked") // the numbers are the framework's to check
    private static List<? extends Number> time(Object value) {
        return (List<? extends Number>) value;
    }
}
