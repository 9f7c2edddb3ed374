package org.ucmcts;

import com.fasterxml.jackson.core.JsonParser;
import com.fasterxml.jackson.jr.ob.JSON;
import java.io.IOException;
import java.nio.ByteBuffer;
import java.nio.charset.StandardCharsets;

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

    /** One line, with its newline. */
    static byte[] line(Object value) {
        try {
            return (JSON.std.asString(value) + "\n").getBytes(StandardCharsets.UTF_8);
        } catch (IOException error) {
            throw new IllegalArgumentException(error);
        }
    }
}
