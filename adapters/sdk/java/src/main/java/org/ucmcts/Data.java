package org.ucmcts;

import java.math.BigInteger;
import java.util.ArrayList;
import java.util.List;

/** Values of UCM types that pass through a probe, which copies them at once, since their owner may change them. */
final class Data {
    /** How many ids, records, connections or references a framework may hand over: far more than any scenario makes. */
    static final int MOST = 10_000;

    private static final int LONGEST = 200; // characters of a value that are shown
    private static final int SHOWN = 8; // elements of a list that are shown

    private Data() {}

    /** What is said of more than {@code MOST} of {@code what}. */
    static String tooMany(String what) {
        return "more than " + MOST + " " + what;
    }

    /** {@code value} and its type, for people; never throws. */
    static String inWords(Object value) {
        if (value == null) {
            return "nothing";
        }
        String text;
        try {
            List<?> first = value instanceof List<?> list ? list.subList(0, Math.min(list.size(), SHOWN)) : null;
            text = String.valueOf(first == null ? value : first);
        } catch (RuntimeException | StackOverflowError error) { // the object is the framework's
            text = "a value";
        }
        int most = Math.min(LONGEST, text.codePointCount(0, text.length()));
        return text.substring(0, text.offsetByCodePoints(0, most)) + " (" + value.getClass().getSimpleName() + ")";
    }

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

    /**
     * Overwrites the lists among {@code results}: a caller may do so with what it was given. Those that
     * cannot be changed stay.
     */
    static void overwriteParts(List<?> results) {
        try {
            for (Object value : results) {
                if (value instanceof List) {
                    overwrite(Node.listOf(value));
                }
            }
        } catch (RuntimeException error) {
            return; // the lists are the framework's
        }
    }

    private static Object other(Object value) {
        if (value instanceof Boolean flag) {
            return !flag;
        }
        return value instanceof String text ? text + "?" : Integer.valueOf(value.toString().equals("0") ? 1 : 0);
    }
}
