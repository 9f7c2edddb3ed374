package org.ucmcts;

import java.math.BigInteger;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.function.Function;

/**
 * The form that a JSON value must have. Reading one gives it back with objects as {@link Node} and defaults filled in.
 */
@FunctionalInterface
interface Shape {
    /** {@code value}, which stands at {@code place} of the message. */
    Object read(Object value, String place) throws Misfit;

    /** A value that has another shape; the message says where. */
    final class Misfit extends Exception {
        private static final long serialVersionUID = 1;

        Misfit(String problem, String place) {
            super(problem + " - at `" + place + "`");
        }
    }

    Shape TEXT = (value, place) -> expect(value, String.class, "str", place);
    Shape FLAG = (value, place) -> expect(value, Boolean.class, "bool", place);
    Shape INT32 = integer(Integer.MIN_VALUE, Integer.MAX_VALUE);
    Shape INT64 = integer(Long.MIN_VALUE, Long.MAX_VALUE);
    Shape ANY_INTEGER = (value, place) -> isInteger(value) ? value : wrong(value, "int", place);

    /** A value of a UCM type as it travels; what is in a list is not checked. */
    Shape DATUM = (value, place) -> {
        boolean plain = value instanceof String || value instanceof Boolean || isInteger(value);
        return plain || value instanceof List ? value : wrong(value, "bool | int | str | array", place);
    };

    private static Shape integer(long least, long greatest) {
        return (value, place) -> {
            if (!isInteger(value)) {
                return wrong(value, "int", place);
            }
            boolean fits = !(value instanceof BigInteger)
                    && ((Number) value).longValue() >= least
                    && ((Number) value).longValue() <= greatest;
            if (!fits) {
                throw new Misfit("Expected `int` between " + least + " and " + greatest, place);
            }
            return ((Number) value).longValue();
        };
    }

    static Shape choice(String... words) {
        return (value, place) -> {
            Object word = TEXT.read(value, place);
            if (!Arrays.asList(words).contains(word)) {
                throw new Misfit("Invalid enum value '" + word + "'", place);
            }
            return word;
        };
    }

    static Shape list(Shape of) {
        return (value, place) -> {
            expect(value, List.class, "array", place);
            List<Object> read = new ArrayList<>();
            for (Object element : (List<?>) value) {
                read.add(of.read(element, place + "[" + read.size() + "]"));
            }
            return read;
        };
    }

    static Shape orNull(Shape of) {
        return (value, place) -> value == null ? null : of.read(value, place);
    }

    /** An object whose field names are free, or of the shape {@code keys}. */
    static Shape map(Shape keys, Shape values) {
        return (value, place) -> {
            expect(value, Map.class, "object", place);
            Map<String, Object> read = new LinkedHashMap<>();
            for (Map.Entry<?, ?> field : ((Map<?, ?>) value).entrySet()) {
                String name = (String) keys.read(field.getKey(), place);
                read.put(name, values.read(field.getValue(), place + "." + name));
            }
            return new Node(read);
        };
    }

    /** One field of an object: {@code preset} is its value where it is left out and not {@code required}. */
    record Field(String name, Shape shape, boolean required, Object preset) {}

    static Field needs(String name, Shape shape) {
        return new Field(name, shape, true, null);
    }

    static Field may(String name, Shape shape, Object preset) {
        return new Field(name, shape, false, preset);
    }

    /** An object with these fields and no others; {@code make} gives the object that has them. */
    static Shape object(Function<Map<String, Object>, ? extends Node> make, Field... fields) {
        Set<String> known = Set.copyOf(Arrays.stream(fields).map(Field::name).toList());
        return (value, place) -> {
            expect(value, Map.class, "object", place);
            Map<?, ?> given = (Map<?, ?>) value;
            for (Object name : given.keySet()) {
                if (!known.contains(name)) {
                    throw new Misfit("Object contains unknown field `" + name + "`", place);
                }
            }
            Map<String, Object> read = new LinkedHashMap<>();
            for (Field field : fields) {
                if (given.containsKey(field.name())) {
                    read.put(field.name(), field.shape().read(given.get(field.name()), place + "." + field.name()));
                } else if (field.required()) {
                    throw new Misfit("Object missing required field `" + field.name() + "`", place);
                } else {
                    read.put(field.name(), field.preset());
                }
            }
            return make.apply(read);
        };
    }

    /**
     * One of several kinds of objects: those that have {@code tag} in their tag field, and these fields beside it.
     */
    record Kind(String tag, Field... fields) {}

    /** An object whose field {@code name} says which of {@code kinds} it is. */
    static Shape tagged(String name, Function<Map<String, Object>, ? extends Node> make, Kind... kinds) {
        Map<String, Shape> shapes = new HashMap<>();
        for (Kind kind : kinds) {
            Field[] fields = Arrays.copyOf(kind.fields(), kind.fields().length + 1);
            fields[kind.fields().length] = needs(name, TEXT);
            shapes.put(kind.tag(), object(make, fields));
        }
        return (value, place) -> {
            expect(value, Map.class, "object", place);
            Map<?, ?> given = (Map<?, ?>) value;
            if (!given.containsKey(name)) {
                throw new Misfit("Object missing required field `" + name + "`", place);
            }
            Object tag = TEXT.read(given.get(name), place + "." + name);
            if (!shapes.containsKey(tag)) {
                throw new Misfit("Invalid value '" + tag + "'", place + "." + name);
            }
            return shapes.get(tag).read(value, place);
        };
    }

    private static boolean isInteger(Object value) {
        return value instanceof Integer || value instanceof Long || value instanceof BigInteger;
    }

    private static Object expect(Object value, Class<?> type, String expected, String place) throws Misfit {
        return type.isInstance(value) ? value : wrong(value, expected, place);
    }

    private static Object wrong(Object value, String expected, String place) throws Misfit {
        String got = value == null ? "null"
                : value instanceof Map ? "object"
                : value instanceof List ? "array"
                : value instanceof String ? "str"
                : value instanceof Boolean ? "bool"
                : isInteger(value) ? "int"
                : "float";
        throw new Misfit("Expected `" + expected + "`, got `" + got + "`", place);
    }
}
