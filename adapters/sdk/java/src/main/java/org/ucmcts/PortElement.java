package org.ucmcts;

import java.util.List;

/** A provided port element (11.2.1.1). One without interface has one business method, {@code exchange}. */
public interface PortElement {
    /** The business method of the probe models' only interface: a signed 32-bit value in, one out. */
    int exchange(int value);

    /**
     * Any method of an interface, by name: takes IN and INOUT values, returns those of OUT, INOUT and RETURN, each in
     * the order of declaration. Values are as adapters/contract/data_types.py says: Boolean, Integer, Long,
     * BigInteger, String and lists of such; lists are the caller's own.
     *
     * @throws DeclaredException an exception that the method declares
     */
    default List<Object> call(String method, List<Object> arguments) {
        throw new UnsupportedOperationException(method);
    }
}
