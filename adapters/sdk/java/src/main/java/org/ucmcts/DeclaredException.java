package org.ucmcts;

import java.util.ArrayList;
import java.util.List;

/** An exception that the called method of a port element declares: its name and the values of its fields. */
public final class DeclaredException extends RuntimeException {
    private static final long serialVersionUID = 1;

    private final String name;
    private final transient List<Object> fields;

    public DeclaredException(String name, List<Object> fields) {
        super(name);
        this.name = name;
        this.fields = new ArrayList<>(fields);
    }

    /** Which of the declared exceptions. */
    public String name() {
        return name;
    }

    /** The values of its fields, in order. */
    public List<Object> fields() {
        return fields;
    }
}
