package org.ucmcts;

import java.io.BufferedReader;
import java.io.InputStreamReader;
import java.nio.charset.StandardCharsets;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;

/** Reads each line as a message to a host and writes it again. */
public final class RoundTrip {
    private RoundTrip() {}

    public static void main(String[] arguments) throws Exception {
        BufferedReader lines = new BufferedReader(new InputStreamReader(System.in, StandardCharsets.UTF_8));
        for (String line = lines.readLine(); line != null; line = lines.readLine()) {
            Object read = Json.read(line.getBytes(StandardCharsets.UTF_8));
            System.out.write(Json.line(plain(Messages.readMessage(read, "$"))));
        }
        System.out.flush();
    }

    private static Object plain(Object value) {
        if (value instanceof Node node) {
            Map<String, Object> fields = new LinkedHashMap<>();
            node.fields().forEach((name, field) -> fields.put(name, plain(field)));
            return fields;
        }
        return value instanceof List<?> list ? list.stream().map(RoundTrip::plain).toList() : value;
    }
}
