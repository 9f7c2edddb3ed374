package org.ucmcts;

import static org.ucmcts.Shape.ANY_INTEGER;
import static org.ucmcts.Shape.DATUM;
import static org.ucmcts.Shape.FLAG;
import static org.ucmcts.Shape.INT32;
import static org.ucmcts.Shape.INT64;
import static org.ucmcts.Shape.TEXT;
import static org.ucmcts.Shape.choice;
import static org.ucmcts.Shape.list;
import static org.ucmcts.Shape.map;
import static org.ucmcts.Shape.may;
import static org.ucmcts.Shape.needs;
import static org.ucmcts.Shape.object;
import static org.ucmcts.Shape.orNull;
import static org.ucmcts.Shape.tagged;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Map;
import org.ucmcts.Shape.Field;
import org.ucmcts.Shape.Kind;
import org.ucmcts.Shape.Misfit;

/** The shapes of the messages that a host receives, as adapters/contract/protocol.schema.json has them. */
final class Protocol {
    static final long VERSION = 1;

    private static final List<Object> NONE = List.of();
    private static final Node NOTHING = new Node(Map.of());
    private static final Field CONTAINER = may("container", TEXT, "manager");

    private static final Shape INTEGER_KIND =
            choice("BYTE", "SHORT", "LONG", "LONGLONG", "UBYTE", "USHORT", "ULONG", "ULONGLONG");
    private static final Shape TYPE = Protocol::anyType;
    private static final Shape ENUMERATION_TAG = choice("enumeration");
    private static final Shape ENUMERATION = object(
            may("type", ENUMERATION_TAG, "enumeration"),
            needs("name", TEXT),
            needs("index", INTEGER_KIND),
            needs("values", map(TEXT, ANY_INTEGER)));
    private static final Shape STRUCTURE = object(
            may("type", choice("structure"), "structure"), needs("name", TEXT), needs("fields", map(TEXT, TYPE)));
    private static final Shape CASE = object(
            needs("name", TEXT), needs("of", TYPE), may("selectors", list(TEXT), NONE), may("default", FLAG, false));
    private static final Shape TYPES = tagged("type",
            kind("integer", needs("kind", INTEGER_KIND)),
            kind("float", needs("kind", choice("FLOAT", "DOUBLE"))),
            kind("char", needs("kind", choice("CHAR8", "CHAR32"))),
            kind("boolean"),
            kind("string", needs("base", choice("CHAR8", "CHAR32")), may("size", ANY_INTEGER, -1)),
            kind("enumeration", needs("name", TEXT), needs("index", INTEGER_KIND),
                    needs("values", map(TEXT, ANY_INTEGER))),
            kind("structure", needs("name", TEXT), needs("fields", map(TEXT, TYPE))),
            kind("union", needs("name", TEXT), needs("selector", ENUMERATION), needs("cases", list(CASE))),
            kind("array", needs("of", TYPE), needs("sizes", list(ANY_INTEGER))),
            kind("sequence", needs("of", TYPE), may("size", ANY_INTEGER, -1)),
            kind("alias", needs("name", TEXT), needs("of", TYPE)));

    private static final Shape PARAMETER = object(
            needs("name", TEXT), needs("direction", choice("IN", "OUT", "INOUT", "RETURN")), needs("of", TYPE));
    private static final Shape METHOD =
            object(may("parameters", list(PARAMETER), NONE), may("raises", list(STRUCTURE), NONE));
    private static final Shape INTERFACE =
            object(needs("methods", map(TEXT, METHOD)), may("inherited", list(TEXT), NONE));

    private static final Shape ACTION = tagged("do",
            kind("raise"),
            kind("return", needs("value", INT32)),
            kind("call", needs("port", TEXT), needs("value", INT32)),
            kind("hold", needs("gate", TEXT)),
            kind("siblings"),
            kind("call_method", needs("port", TEXT), needs("method", TEXT), may("arguments", list(DATUM), NONE)),
            kind("answer", needs("method", TEXT), may("results", orNull(list(DATUM)), null),
                    may("exception", orNull(TEXT), null), may("overwrite", FLAG, false)),
            kind("burst", needs("port", TEXT), needs("first", INT64), needs("count", INT64)),
            kind("count"));
    private static final Shape HOOK = choice("on_init", "on_startup", "on_shutdown", "on_remove", "on_connect",
            "on_disconnect", "set_container_interface", "exchange", "run", "method");
    private static final Shape POLICY = object(
            needs("definition", TEXT),
            may("port", orNull(TEXT), null),
            may("parameters", map(TEXT, TEXT), NOTHING),
            may("element", orNull(TEXT), null));
    private static final Shape DECLARED = object(
            may("provides", list(TEXT), NONE),
            may("requires", list(TEXT), NONE),
            may("attributes", map(TEXT, TEXT), NOTHING),
            may("connectable", FLAG, false),
            may("fragment", FLAG, false),
            may("plan", map(HOOK, list(ACTION)), NOTHING),
            may("policies", list(POLICY), NONE),
            may("ports", map(TEXT, TEXT), NOTHING));

    private static final Shape STEP = tagged("op",
            step("add_component", needs("component", TEXT), CONTAINER, may("bind", TEXT, "")),
            step("remove_component", needs("id", TEXT), CONTAINER),
            step("get_port_element", needs("id", TEXT), needs("port", TEXT), needs("bind", TEXT), CONTAINER),
            step("connect", needs("id", TEXT), needs("port", TEXT), needs("to", TEXT), needs("bind", TEXT), CONTAINER),
            step("disconnect", needs("connection", TEXT), CONTAINER),
            step("start", CONTAINER),
            step("stop", CONTAINER),
            step("get_components", CONTAINER),
            step("create_container", needs("bind", TEXT)),
            step("remove_container", needs("container", TEXT)),
            step("destroy"),
            step("invoke", needs("ref", TEXT), needs("value", INT32)),
            step("open", needs("gate", TEXT)),
            step("reach", needs("gate", TEXT), may("more", INT32, 0L), may("total", INT32, 0L)),
            step("settle", needs("worker", TEXT)),
            step("join", needs("worker", TEXT)),
            step("link", needs("connector", choice("simple_service_connector", "simple_message_connector")),
                    needs("interface", TEXT), needs("bind", TEXT)),
            step("attach", needs("link", TEXT), needs("role", choice("client", "server", "emitter", "receiver")),
                    needs("id", TEXT), needs("port", TEXT), CONTAINER),
            step("detach", needs("link", TEXT), needs("id", TEXT), needs("port", TEXT), CONTAINER),
            step("break", needs("link", TEXT), may("where", choice("transport", "inside"), "transport")),
            step("mend", needs("link", TEXT)),
            step("read_log", may("records", INT32, 0L)),
            step("pause", needs("milliseconds", INT32)),
            step("await_messages", needs("component", TEXT), needs("count", INT64), may("instance", INT64, 1L)),
            step("stress", needs("refs", list(TEXT)), may("milliseconds", INT32, 100L)));
    private static final Shape SCENARIO = object(
            needs("components", map(TEXT, Protocol::declaration)),
            needs("steps", list(STEP)),
            may("patience", INT64, 2000L),
            may("interfaces", map(TEXT, INTERFACE), NOTHING),
            may("may_stay", list(TEXT), NONE));
    private static final Shape MESSAGE = tagged("type",
            kind("hello", needs("protocol", INT64)),
            kind("run", needs("id", INT64), needs("scenario", SCENARIO), may("stream", FLAG, false)));

    private Protocol() {}

    /** The message that {@code value} is. */
    static Node message(Object value) throws Misfit {
        return (Node) MESSAGE.read(value, "$");
    }

    private static Object anyType(Object value, String place) throws Misfit {
        return TYPES.read(value, place); // types contain types
    }

    private static Object declaration(Object value, String place) throws Misfit {
        Node declared = (Node) DECLARED.read(value, place);
        List<String> ports = new ArrayList<>(declared.texts("provides"));
        ports.addAll(declared.texts("requires"));
        if (ports.stream().distinct().count() < ports.size()) {
            throw new Misfit("a port element is declared twice", place);
        }
        return declared;
    }

    private static Kind kind(String tag, Field... fields) {
        return new Kind(tag, fields);
    }

    private static Kind step(String operation, Field... fields) {
        Field[] all = Arrays.copyOf(fields, fields.length + 1);
        all[fields.length] = may("thread", orNull(TEXT), null);
        return new Kind(operation, all);
    }
}
