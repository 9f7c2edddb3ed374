package org.ucmcts;

import java.util.ArrayList;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.function.Consumer;
import java.util.function.LongConsumer;
import org.ucmcts.Messages.Action;
import org.ucmcts.Messages.Remembered;
import org.ucmcts.Messages.TimerFrom;

/** What a body was given before, for the plans that name it: arguments of methods, and all object timers. */
final class Memory {
    /**
     * A body was entered at {@code method} with these {@code arguments} and the object timer of number {@code timer},
     * or at {@code exchange} with {@code value}; what is not there is null.
     */
    record Entry(String method, List<Object> arguments, Long value, Long timer) {}

    /** An object timer (10.3.1) that came to the body by {@code method}. */
    record Timer(String method, long number, ObjectTimer timer) {}

    private final Set<String> methods = new HashSet<>();
    private final Object lock = new Object();
    private final List<Entry> seen = new ArrayList<>();
    private final List<Timer> timers = new ArrayList<>();

    Memory(Map<String, List<Action>> plan) {
        plan.values().forEach(actions -> actions.stream()
                .filter(action -> action.tag().equals("call_method"))
                .forEach(action -> action.remembered().forEach(one -> methods.add(one.method()))));
    }

    /**
     * Records and remembers an entry, and the object timer that came with it, in one and the same order.
     *
     * @param timer may be null
     */
    Entry enter(String method, List<Object> arguments, ObjectTimer timer, Consumer<Entry> record) {
        boolean isRemembered = methods.contains(method);
        if (timer == null && !isRemembered) {
            Entry entry = new Entry(method, arguments, null, null);
            record.accept(entry);
            return entry;
        }
        synchronized (lock) {
            Entry entry = new Entry(method, arguments, null, timer == null ? null : number(method, timer));
            record.accept(entry);
            if (isRemembered) {
                seen.add(entry);
            }
            return entry;
        }
    }

    /** Numbers an object timer that came back from {@code method}, and records that, in one and the same order. */
    void takeTimer(String method, ObjectTimer timer, LongConsumer record) {
        synchronized (lock) {
            record.accept(number(method, timer));
        }
    }

    private long number(String method, ObjectTimer timer) {
        timers.add(new Timer(method, timers.size() + 1, timer));
        return timers.size();
    }

    /** An object timer that the body was given; null if it was not given it yet. */
    Timer timer(TimerFrom of, Entry entry) {
        synchronized (lock) {
            if (of.nth() == 0) {
                boolean isOwn = entry.timer() != null && entry.method().equals(of.method());
                return isOwn ? timers.get(entry.timer().intValue() - 1) : null;
            }
            List<Timer> matching = timers.stream().filter(each -> each.method().equals(of.method())).toList();
            return of.nth() >= 1 && of.nth() <= matching.size() ? matching.get((int) of.nth() - 1) : null;
        }
    }

    /**
     * The arguments of {@code call}, made in {@code entry}; null if it is not to be made: the body was entered with
     * another value, or was not given one of them yet.
     */
    List<Object> arguments(Action call, Entry entry) {
        if (call.given() != null && !call.given().equals(entry.value())) {
            return null;
        }
        List<Object> made = new ArrayList<>(call.arguments());
        for (Remembered one : call.remembered()) {
            Entry found = find(one, entry);
            if (found == null || one.position() < 0 || one.position() >= found.arguments().size()
                    || one.argument() < 0 || one.argument() >= made.size()) {
                return null;
            }
            made.set((int) one.argument(), found.arguments().get((int) one.position()));
        }
        return made;
    }

    private Entry find(Remembered one, Entry entry) {
        if (one.nth() == 0) {
            return entry.method().equals(one.method()) ? entry : null;
        }
        synchronized (lock) {
            List<Entry> matching = seen.stream().filter(each -> each.method().equals(one.method())).toList();
            return one.nth() <= matching.size() ? matching.get((int) one.nth() - 1) : null;
        }
    }
}
