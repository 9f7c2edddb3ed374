package org.ucmcts;

import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import org.ucmcts.Shape.Misfit;

/** The messages that a host receives. */
final class Protocol {
    static final long VERSION = 1;

    private Protocol() {}

    /** The message that {@code value} is. */
    static Messages.Message message(Object value) throws Misfit {
        Messages.Message message = (Messages.Message) Messages.readMessage(value, "$");
        if (message.tag().equals("run")) {
            for (Map.Entry<String, Messages.Declaration> one : message.scenario().components().entrySet()) {
                List<String> ports = new ArrayList<>(one.getValue().provides());
                ports.addAll(one.getValue().requires());
                if (ports.stream().distinct().count() < ports.size()) {
                    throw new Misfit("a port element is declared twice", "$.scenario.components." + one.getKey());
                }
            }
        }
        return message;
    }
}
