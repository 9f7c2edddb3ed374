package org.ucmcts;

import java.util.List;

/**
 * The port element {@code timer_scheduler} that a component requires by the policy {@code ott_timer} (10.3.1). It
 * comes to the body in a {@link PortConnection} with the name {@link Policy#element()}, at {@code onStartup}. Times
 * are seconds and microseconds, Integer or Long; their lists are the caller's own. The methods throw what the
 * framework throws where it refuses a call.
 */
public interface TimerScheduler extends PortElement {
    /** {@code scheduler_trigger}: makes a timer that triggers {@code handler} once, after {@code delay}. */
    ObjectTimer schedulerTrigger(TimerHandler handler, List<? extends Number> delay);

    /**
     * {@code schedule_repeated_trigger}: makes a timer that triggers {@code handler} {@code maxRounds} times. Returns
     * it if {@code repeated-result=timer} is declared, else null.
     */
    ObjectTimer scheduleRepeatedTrigger(
            TimerHandler handler,
            List<? extends Number> startDelay,
            List<? extends Number> interval,
            long maxRounds);

    /** A scheduler has no such method. */
    @Override
    default int exchange(int value) {
        throw new UnsupportedOperationException("exchange");
    }
}
