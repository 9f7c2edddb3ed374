package org.ucmcts;

import java.util.ArrayList;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import org.ucmcts.Messages.Action;
import org.ucmcts.Messages.Remembered;

/** What a body was given before, for the plans that name it. */
final class Memory {
    /**
     * A body was entered at {@code method} with these {@code arguments}, or at {@code exchange} with {@code value},
     * which is null elsewhere.
     */
    record Entry(String method, List<Object> arguments, Long value) {}

    private final Set<String> methods = new HashSet<>();
    private final List<Entry> seen = new ArrayList<>();

    Memory(Map<String, List<Action>> plan) {
        plan.values().forEach(actions -> actions.stream()
                .filter(action -> action.tag().equals("call_method"))
                .forEach(action -> action.remembered().forEach(one -> methods.add(one.method()))));
    }

    /** Records and remembers {@code entry}, in one and the same order. */
    void enter(Entry entry, Runnable record) {
        if (!methods.contains(entry.method())) {
            record.run();
            return;
        }
        synchronized (seen) {
            record.run();
            seen.add(entry);
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
        synchronized (seen) {
            List<Entry> matching = seen.stream().filter(each -> each.method().equals(one.method())).toList();
            return one.nth() <= matching.size() ? matching.get((int) one.nth() - 1) : null;
        }
    }
}
