package org.ucmcts;

import java.util.List;
import java.util.Map;

/** A JSON object of the protocol whose fields have been checked; what was left out has its default. */
public class Node {
    private final Map<String, Object> fields;

    /** The object that has {@code fields}. */
    public Node(Map<String, Object> fields) {
        this.fields = fields;
    }

    /** All fields by name. */
    public Map<String, Object> fields() {
        return fields;
    }

    /** The field {@code name}, or null. */
    public Object get(String name) {
        return fields.get(name);
    }

    /** The field {@code name} as text, or null. */
    public String text(String name) {
        return (String) fields.get(name);
    }

    /** The field {@code name} as a number. */
    public long number(String name) {
        return ((Number) fields.get(name)).longValue();
    }

    /** The field {@code name} as a number, or null. */
    public Long numberOrNull(String name) {
        return fields.get(name) == null ? null : number(name);
    }

    /** The field {@code name} as a truth value. */
    public boolean flag(String name) {
        return (Boolean) fields.get(name);
    }

    /** The object in field {@code name}. */
    public Node node(String name) {
        return (Node) fields.get(name);
    }

    /** The list in field {@code name}, or null. */
    public List<Object> list(String name) {
        return listOf(fields.get(name));
    }

    /** The texts in field {@code name}. */
    public List<String> texts(String name) {
        return list(name).stream().map(String.class::cast).toList();
    }

    /** The objects in field {@code name}. */
    public List<Node> nodes(String name) {
        return list(name).stream().map(Node.class::cast).toList();
    }

    static List<Object> listOf(Object value) {
        return as(value);
    }

    @SuppressWarnings("unchecked") // Shape lets nothing else through
    static <T> T as(Object value) {
        return (T) value;
    }
}
