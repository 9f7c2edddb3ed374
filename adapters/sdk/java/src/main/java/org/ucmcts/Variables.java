package org.ucmcts;

import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;

/** What the steps of a scenario bind and later steps use. A name has one value at a time, of one kind. */
final class Variables<C> {
    private static final String MANAGER = "manager";
    private static final String UNKNOWN = "unknown";
    private static final String NIL = "nil";

    private final Map<String, Integer> ids = new HashMap<>();
    private final Map<String, PortElement> references = new HashMap<>();
    private final Map<String, C> containers = new HashMap<>();
    private final Map<String, Object> links = new HashMap<>();
    private final Set<Integer> given = new HashSet<>();

    Variables(C manager) {
        containers.put(MANAGER, manager);
    }

    /** A step uses a variable that was never bound; the message is its name. */
    static final class Unbound extends Exception {
        private static final long serialVersionUID = 1;

        Unbound(String variable) {
            super(variable);
        }
    }

    /** {@code name} is a component or connection from now on. */
    synchronized void bindId(String name, int value) {
        forget(name);
        given.add(value);
        ids.put(name, value);
    }

    /** {@code name} is a reference, possibly null, from now on. */
    synchronized void bindReference(String name, PortElement reference) {
        forget(name);
        references.put(name, reference);
    }

    /** {@code name} is a container from now on. */
    synchronized void bindContainer(String name, C container) {
        forget(name);
        containers.put(name, container);
    }

    /** {@code name} is a connection with a connector from now on. */
    synchronized void bindLink(String name, Object link) {
        forget(name);
        links.put(name, link);
    }

    /** The framework has let these ids be known, so none of them can serve as unknown. */
    synchronized void saw(List<Integer> members) {
        given.addAll(members);
    }

    /** The component or connection {@code name}; {@code unknown} gives an integer the framework has not given out. */
    synchronized int id(String name) throws Unbound {
        if (name.equals(UNKNOWN)) {
            int candidate = Integer.MAX_VALUE;
            while (given.contains(candidate)) {
                candidate--;
            }
            return candidate;
        }
        return find(ids, name);
    }

    /** The reference {@code name}; {@code nil} gives the null reference. */
    synchronized PortElement reference(String name) throws Unbound {
        return name.equals(NIL) ? null : find(references, name);
    }

    /** The container {@code name}; {@code nil} gives the null container. */
    synchronized C container(String name) throws Unbound {
        return name.equals(NIL) ? null : find(containers, name);
    }

    /** The connection with a connector {@code name}. */
    synchronized Object link(String name) throws Unbound {
        return find(links, name);
    }

    private static <T> T find(Map<String, T> there, String name) throws Unbound {
        if (!there.containsKey(name)) {
            throw new Unbound(name);
        }
        return there.get(name);
    }

    private void forget(String name) {
        ids.remove(name);
        references.remove(name);
        containers.remove(name);
        links.remove(name);
    }
}
