package org.ucmcts;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.function.Supplier;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

/**
 * Watches one thread. It is blocked when several checks in a row find that both the virtual machine and the operating
 * system have it waiting and that it has not been awake in between: a thread that only waits for the machine to go on
 * is not. Elsewhere than on Linux no thread is ever found to be blocked.
 */
final class SleepWatch {
    /** Nanoseconds between two checks. */
    static final long PAUSE = 500_000;

    private static final int CHECKS = 5;
    private static final Pattern SLEEPS =
            Pattern.compile("^State:\\s+S.*^voluntary_ctxt_switches:\\s+(\\d+)", Pattern.MULTILINE | Pattern.DOTALL);

    private final Thread thread;
    private final Supplier<Path> status;
    private String before;
    private int checks;

    /** Watches {@code thread}; {@code status} gives its file in /proc, null if there is none, or not yet. */
    SleepWatch(Thread thread, Supplier<Path> status) {
        this.thread = thread;
        this.status = status;
    }

    /** The file of the operating system on the calling thread; null if there is none. */
    static Path statusOfThisThread() {
        try {
            Path own = Files.readSymbolicLink(Path.of("/proc/thread-self")); // PID/task/NUMBER
            return Path.of("/proc/self/task").resolve(own.getFileName()).resolve("status");
        } catch (IOException error) {
            return null;
        }
    }

    /** Checks once more: is the thread blocked? */
    boolean isBlocked() {
        String sleeps = sleeps();
        checks = sleeps != null && sleeps.equals(before) ? checks + 1 : 1;
        before = sleeps;
        return sleeps != null && checks >= CHECKS;
    }

    // how often it has gone to sleep, as text, if it sleeps now
    private String sleeps() {
        boolean waits = switch (thread.getState()) {
            case BLOCKED, WAITING, TIMED_WAITING -> true;
            default -> false;
        };
        Path file = status.get();
        if (file == null || !waits) {
            return null;
        }
        try {
            Matcher found = SLEEPS.matcher(Files.readString(file));
            return found.find() ? found.group(1) : null;
        } catch (IOException error) {
            return null;
        }
    }
}
