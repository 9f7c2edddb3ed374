package org.ucmcts;

import com.fasterxml.jackson.core.JsonParser;
import com.fasterxml.jackson.jr.ob.JSON;
import java.io.IOException;
import java.nio.ByteBuffer;
import java.nio.charset.StandardCharsets;
import java.util.LinkedHashMap;
import java.util.Map;

/** JSON to maps, lists, texts and numbers, and back. */
final class Json {
    private static final JSON LENIENT_ABOUT_DUPLICATES = JSON.std.without(JSON.Feature.FAIL_ON_DUPLICATE_MAP_KEYS);

    private Json() {}

    /** The one value that the UTF-8 text {@code line} is. */
    static Object read(byte[] line) throws IOException {
        String text = StandardCharsets.UTF_8.newDecoder().decode(ByteBuffer.wrap(line)).toString();
        try (JsonParser parser = LENIENT_ABOUT_DUPLICATES.createParser(text)) {
            Object value = LENIENT_ABOUT_DUPLICATES.anyFrom(parser);
            if (parser.nextToken() != null) {
                throw new IOException("something follows after the message");
            }
            return value;
        }
    }

    /** An object; {@code fields} are names and values by turns, and those that are null are left out. */
    static Map<String, Object> object(Object... fields) {
        Map<String, Object> object = new LinkedHashMap<>();
        for (int index = 0; index < fields.length; index += 2) {
            if (fields[index + 1] != null) {
                object.put((String) fields[index], fields[index + 1]);
            }
        }
        return object;
    }

    /** One line, with its newline. */
    static byte[] line(Object value) {
        try {
            return (JSON.std.asString(value) + "\n").getBytes(StandardCharsets.UTF_8);
        } catch (IOException error) {
            throw new IllegalArgumentException(error);
        }
    }
}
