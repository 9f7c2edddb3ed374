package org.ucmcts;

import java.util.List;

/** What a body passes to a {@link TimerScheduler}, and the timer calls (10.3.1). */
@FunctionalInterface
public interface TimerHandler {
    /**
     * {@code on_trigger}. Let what it throws out.
     *
     * @param timer the timer that triggers, as the framework gives it to components
     * @param deltaTime seconds and microseconds, as Integer or Long
     * @param round from 0 to 2^32 - 1
     */
    void onTrigger(ObjectTimer timer, List<? extends Number> deltaTime, long round);
}
