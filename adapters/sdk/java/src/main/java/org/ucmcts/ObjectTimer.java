package org.ucmcts;

/** A timer of 10.3.1, which a {@link TimerScheduler} gives out. */
public interface ObjectTimer {
    /** The getter of its attribute {@code rounds}, from 0 to 2^32 - 1. */
    long rounds();

    /** The getter of its attribute {@code id}. */
    String id();

    /** {@code cancel}: it triggers no more. */
    void cancel();

    /** {@code is_cancelled}: was it cancelled? */
    boolean isCancelled();
}
