package org.ucmcts;

import java.math.BigInteger;
import java.util.ArrayList;
import java.util.List;

/** Values of UCM types that pass through a probe, which copies them at once, since their owner may change them. */
final class Data {
    private Data() {}

    /** Can it stand for a list of values of UCM types? */
    static boolean isData(Object value) {
        return value instanceof List<?> list && list.stream().allMatch(Data::isDatum);
    }

    private static boolean isDatum(Object value) {
        return value instanceof Boolean
                || value instanceof Integer
                || value instanceof Long
                || value instanceof BigInteger
                || value instanceof String
                || isData(value);
    }

    /** {@code values} as they are now, in lists of their own. */
    static List<Object> copy(List<?> values) {
        List<Object> copied = new ArrayList<>();
        values.forEach(value -> copied.add(value instanceof List<?> list ? copy(list) : value));
        return copied;
    }

    /** Changes every part of {@code values}, as the owner of a buffer may; unchangeable lists stay. */
    static void overwrite(List<Object> values) {
        try {
            for (int index = 0; index < values.size(); index++) {
                Object value = values.get(index);
                if (value instanceof List) {
                    List<Object> inner = Node.listOf(value);
                    overwrite(inner);
                    inner.add(0);
                } else {
                    values.set(index, other(value));
                }
            }
        } catch (UnsupportedOperationException error) {
            return; // as the Python SDK leaves tuples alone
        }
    }

    private static Object other(Object value) {
        if (value instanceof Boolean flag) {
            return !flag;
        }
        return value instanceof String text ? text + "?" : Integer.valueOf(value.toString().equals("0") ? 1 : 0);
    }
}
