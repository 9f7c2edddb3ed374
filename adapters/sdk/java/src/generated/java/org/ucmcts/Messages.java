// made by python -m ucm_cts.adapters.contract.generating from protocol.schema.json: do not edit
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

import java.util.List;
import java.util.Map;
import org.ucmcts.Shape.Kind;
import org.ucmcts.Shape.Misfit;

/** What a host reads: a class for each kind of object, and the shape that the object must have. */
final class Messages {
    private Messages() {}

    private static final Shape REMEMBERED = object(Remembered::new,
            needs("argument", INT32),
            needs("method", TEXT),
            needs("position", INT32),
            may("nth", INT32, 0L));

    /**
     * An argument that a body was given before, in place of one that a plan spells.
     *
     * `argument`: the argument in whose place it stands, from 0.
     * `method`: the method that the body was entered at.
     * `position`: its argument there, from 0.
     * `nth`: the number of that entry among those at `method`, from 1; 0 is the entry in which the body acts.
     */
    static final class Remembered extends Node {
        private Remembered(Map<String, Object> fields) {
            super(fields);
        }

        long argument() {
            return number("argument");
        }

        String method() {
            return text("method");
        }

        long position() {
            return number("position");
        }

        long nth() {
            return number("nth");
        }
    }

    static Object readRemembered(Object value, String place) throws Misfit {
        return REMEMBERED.read(value, place);
    }

    private static final Shape FROMCLOCK = object(FromClock::new,
            needs("argument", INT32),
            needs("port", TEXT),
            needs("method", TEXT));

    /**
     * A time-out of 10.3.2 whose seconds count from what a clock of the body shows. The body reads the clock just
     * before its call, and adds the seconds that the clock gave to those of the time-out.
     *
     * `argument`: the time-out among the arguments, from 0.
     * `port`: the port element of the clock.
     * `method`: the method of the clock.
     */
    static final class FromClock extends Node {
        private FromClock(Map<String, Object> fields) {
            super(fields);
        }

        long argument() {
            return number("argument");
        }

        String port() {
            return text("port");
        }

        String method() {
            return text("method");
        }
    }

    static Object readFromClock(Object value, String place) throws Misfit {
        return FROMCLOCK.read(value, place);
    }

    private static final Shape TIMERFROM = object(TimerFrom::new,
            needs("method", TEXT),
            may("nth", INT32, 0L));

    /**
     * An object timer of 10.3.1 that a body was given before.
     *
     * `method`: a method of the scheduler that returned it to the body, or `on_trigger`, which handed it over.
     * `nth`: its number among the timers that came so, from 1; 0 is that of the entry in which the body acts.
     */
    static final class TimerFrom extends Node {
        private TimerFrom(Map<String, Object> fields) {
            super(fields);
        }

        String method() {
            return text("method");
        }

        long nth() {
            return number("nth");
        }
    }

    static Object readTimerFrom(Object value, String place) throws Misfit {
        return TIMERFROM.read(value, place);
    }

    private static final Shape ACTION = tagged("do", Action::new,
            new Kind("raise"),
            new Kind("return",
                    needs("value", INT32)),
            new Kind("call",
                    needs("port", TEXT),
                    needs("value", INT32)),
            new Kind("hold",
                    needs("gate", TEXT)),
            new Kind("siblings"),
            new Kind("call_method",
                    needs("port", TEXT),
                    needs("method", TEXT),
                    may("arguments", list(DATUM), List.of()),
                    may("remembered", list(Messages::readRemembered), List.of()),
                    may("given", orNull(INT32), null),
                    may("from_clock", orNull(Messages::readFromClock), null),
                    may("handler", orNull(TEXT), null),
                    may("on", orNull(Messages::readTimerFrom), null)),
            new Kind("answer",
                    needs("method", TEXT),
                    may("results", orNull(list(DATUM)), null),
                    may("exception", orNull(TEXT), null),
                    may("overwrite", FLAG, false)),
            new Kind("burst",
                    needs("port", TEXT),
                    needs("first", INT64),
                    needs("count", INT64)),
            new Kind("count"));

    /** One of 9 kinds of objects; each method says which kinds have the field. */
    static final class Action extends Node {
        private Action(Map<String, Object> fields) {
            super(fields);
        }

        /** Which kind it is. */
        String tag() {
            return text("do");
        }

        /** Of return, call. */
        long value() {
            return number("value");
        }

        /** Of call, call_method, burst. */
        String port() {
            return text("port");
        }

        /** Of hold. */
        String gate() {
            return text("gate");
        }

        /** Of call_method, answer. */
        String method() {
            return text("method");
        }

        /** Of call_method. */
        List<Object> arguments() {
            return as(get("arguments"));
        }

        /** Of call_method. */
        List<Remembered> remembered() {
            return as(get("remembered"));
        }

        /** Of call_method. */
        Long given() {
            return numberOrNull("given");
        }

        /** Of call_method. */
        FromClock fromClock() {
            return as(get("from_clock"));
        }

        /** Of call_method. */
        String handler() {
            return text("handler");
        }

        /** Of call_method. */
        TimerFrom on() {
            return as(get("on"));
        }

        /** Of answer. */
        List<Object> results() {
            return as(get("results"));
        }

        /** Of answer. */
        String exception() {
            return text("exception");
        }

        /** Of answer. */
        boolean overwrite() {
            return flag("overwrite");
        }

        /** Of burst. */
        long first() {
            return number("first");
        }

        /** Of burst. */
        long count() {
            return number("count");
        }
    }

    static Object readAction(Object value, String place) throws Misfit {
        return ACTION.read(value, place);
    }

    private static final Shape HOOK = choice(
            "on_init", "on_startup", "on_shutdown", "on_remove", "on_connect", "on_disconnect",
            "set_container_interface", "exchange", "run", "method");

    private static final Shape POLICY = object(Policy::new,
            needs("definition", TEXT),
            may("port", orNull(TEXT), null),
            may("parameters", map(TEXT, TEXT), new Node(Map.of())),
            may("element", orNull(TEXT), null),
            may("settings", map(TEXT, INT64), new Node(Map.of())));

    /**
     * A technical policy of a component implementation (9.5.4.3).
     *
     * `definition`: name of the policy definition.
     * `port`: the port element that it applies to; none if it applies to the component.
     * `parameters`: values by parameter name.
     * `element`: name of the port element that the component requires by the policy (`REQUIRED_ELEMENTS`):
     * `policy.element`.
     * `settings`: the parameters of a policy of 10.5 (`PERIOD`, `OFFSET`, `PRIORITY`), times in microseconds.
     */
    static final class Policy extends Node {
        private Policy(Map<String, Object> fields) {
            super(fields);
        }

        String definition() {
            return text("definition");
        }

        String port() {
            return text("port");
        }

        Map<String, String> parameters() {
            return as(node("parameters").fields());
        }

        String element() {
            return text("element");
        }

        Map<String, Long> settings() {
            return as(node("settings").fields());
        }
    }

    static Object readPolicy(Object value, String place) throws Misfit {
        return POLICY.read(value, place);
    }

    private static final Shape DECLARATION = object(Declaration::new,
            may("provides", list(TEXT), List.of()),
            may("requires", list(TEXT), List.of()),
            may("attributes", map(TEXT, TEXT), new Node(Map.of())),
            may("connectable", FLAG, false),
            may("fragment", FLAG, false),
            may("plan", map(HOOK, list(Messages::readAction)), new Node(Map.of())),
            may("policies", list(Messages::readPolicy), List.of()),
            may("ports", map(TEXT, TEXT), new Node(Map.of())),
            may("defaults", map(TEXT, TEXT), new Node(Map.of())),
            may("handlers", list(TEXT), List.of()));

    /**
     * A component implementation that the framework must be able to instantiate: a probe body and its plan.
     *
     * `provides`: provided port elements.
     * `requires`: required port elements; none may be provided too.
     * `attributes`: configured values by attribute name.
     * `connectable`: the body implements Connectable (11.2.1.3).
     * `fragment`: the body implements FragmentObject (11.2.1.4).
     * `plan`: the actions of the probe in each hook, each time it is entered there.
     * `policies`: technical policies.
     * `ports`: the interface of each port element that has one, by name.
     * `defaults`: default values (9.2.7.4) by attribute name; they hold for attributes that are not configured.
     * `handlers`: the body's own handlers of object timers (10.3.1). Each is entered at `method`, with its name as the
     * port element.
     */
    static final class Declaration extends Node {
        private Declaration(Map<String, Object> fields) {
            super(fields);
        }

        List<String> provides() {
            return as(get("provides"));
        }

        List<String> requires() {
            return as(get("requires"));
        }

        Map<String, String> attributes() {
            return as(node("attributes").fields());
        }

        boolean connectable() {
            return flag("connectable");
        }

        boolean fragment() {
            return flag("fragment");
        }

        Map<String, List<Action>> plan() {
            return as(node("plan").fields());
        }

        List<Policy> policies() {
            return as(get("policies"));
        }

        Map<String, String> ports() {
            return as(node("ports").fields());
        }

        Map<String, String> defaults() {
            return as(node("defaults").fields());
        }

        List<String> handlers() {
            return as(get("handlers"));
        }
    }

    static Object readDeclaration(Object value, String place) throws Misfit {
        return DECLARATION.read(value, place);
    }

    private static final Shape STEP = tagged("op", Step::new,
            new Kind("add_component",
                    needs("component", TEXT),
                    may("container", TEXT, "manager"),
                    may("bind", TEXT, ""),
                    may("attributes", map(TEXT, TEXT), new Node(Map.of())),
                    may("thread", orNull(TEXT), null)),
            new Kind("remove_component",
                    needs("id", TEXT),
                    may("container", TEXT, "manager"),
                    may("thread", orNull(TEXT), null)),
            new Kind("get_port_element",
                    needs("id", TEXT),
                    needs("port", TEXT),
                    needs("bind", TEXT),
                    may("container", TEXT, "manager"),
                    may("thread", orNull(TEXT), null)),
            new Kind("connect",
                    needs("id", TEXT),
                    needs("port", TEXT),
                    needs("to", TEXT),
                    needs("bind", TEXT),
                    may("container", TEXT, "manager"),
                    may("thread", orNull(TEXT), null)),
            new Kind("disconnect",
                    needs("connection", TEXT),
                    may("container", TEXT, "manager"),
                    may("thread", orNull(TEXT), null)),
            new Kind("start",
                    may("container", TEXT, "manager"),
                    may("thread", orNull(TEXT), null)),
            new Kind("stop",
                    may("container", TEXT, "manager"),
                    may("thread", orNull(TEXT), null)),
            new Kind("get_components",
                    may("container", TEXT, "manager"),
                    may("thread", orNull(TEXT), null)),
            new Kind("create_container",
                    needs("bind", TEXT),
                    may("thread", orNull(TEXT), null)),
            new Kind("remove_container",
                    needs("container", TEXT),
                    may("thread", orNull(TEXT), null)),
            new Kind("destroy",
                    may("thread", orNull(TEXT), null)),
            new Kind("invoke",
                    needs("ref", TEXT),
                    needs("value", INT32),
                    may("thread", orNull(TEXT), null)),
            new Kind("open",
                    needs("gate", TEXT),
                    may("thread", orNull(TEXT), null)),
            new Kind("reach",
                    needs("gate", TEXT),
                    may("more", INT32, 0L),
                    may("total", INT32, 0L),
                    may("thread", orNull(TEXT), null)),
            new Kind("settle",
                    needs("worker", TEXT),
                    may("thread", orNull(TEXT), null)),
            new Kind("join",
                    needs("worker", TEXT),
                    may("thread", orNull(TEXT), null)),
            new Kind("link",
                    needs("connector", choice(
                            "request-response_connector", "shared-data_connector", "simple_message_connector",
                            "simple_service_connector")),
                    needs("interface", TEXT),
                    needs("bind", TEXT),
                    may("thread", orNull(TEXT), null)),
            new Kind("attach",
                    needs("link", TEXT),
                    needs("role", choice(
                            "client", "emitter", "receiver", "rr_asynchronous_client", "rr_asynchronous_server",
                            "rr_synchronous_client", "rr_synchronous_server", "sd_reader", "sd_writer", "server")),
                    needs("id", TEXT),
                    needs("port", TEXT),
                    may("container", TEXT, "manager"),
                    may("thread", orNull(TEXT), null)),
            new Kind("detach",
                    needs("link", TEXT),
                    needs("id", TEXT),
                    needs("port", TEXT),
                    may("container", TEXT, "manager"),
                    may("thread", orNull(TEXT), null)),
            new Kind("break",
                    needs("link", TEXT),
                    may("where", choice("inside", "transport"), "transport"),
                    may("thread", orNull(TEXT), null)),
            new Kind("mend",
                    needs("link", TEXT),
                    may("thread", orNull(TEXT), null)),
            new Kind("read_log",
                    may("records", INT32, 0L),
                    may("thread", orNull(TEXT), null)),
            new Kind("pause",
                    needs("milliseconds", INT32),
                    may("thread", orNull(TEXT), null)),
            new Kind("await_messages",
                    needs("component", TEXT),
                    needs("count", INT64),
                    may("instance", INT64, 1L),
                    may("thread", orNull(TEXT), null)),
            new Kind("stress",
                    needs("refs", list(TEXT)),
                    may("milliseconds", INT32, 100L),
                    may("thread", orNull(TEXT), null)),
            new Kind("advance",
                    needs("milliseconds", INT32),
                    may("thread", orNull(TEXT), null)));

    /** One of 26 kinds of objects; each method says which kinds have the field. */
    static final class Step extends Node {
        private Step(Map<String, Object> fields) {
            super(fields);
        }

        /** Which kind it is. */
        String tag() {
            return text("op");
        }

        /** Of add_component, await_messages. */
        String component() {
            return text("component");
        }

        /**
         * /** Of add_component, remove_component, get_port_element, connect, disconnect, start, stop, get_components,
         * remove_container, attach, detach
         */
        String container() {
            return text("container");
        }

        /** Of add_component, get_port_element, connect, create_container, link. */
        String bind() {
            return text("bind");
        }

        /** Of add_component. */
        Map<String, String> attributes() {
            return as(node("attributes").fields());
        }

        /** Of all. */
        String thread() {
            return text("thread");
        }

        /** Of remove_component, get_port_element, connect, attach, detach. */
        String id() {
            return text("id");
        }

        /** Of get_port_element, connect, attach, detach. */
        String port() {
            return text("port");
        }

        /** Of connect. */
        String to() {
            return text("to");
        }

        /** Of disconnect. */
        String connection() {
            return text("connection");
        }

        /** Of invoke. */
        String ref() {
            return text("ref");
        }

        /** Of invoke. */
        long value() {
            return number("value");
        }

        /** Of open, reach. */
        String gate() {
            return text("gate");
        }

        /** Of reach. */
        long more() {
            return number("more");
        }

        /** Of reach. */
        long total() {
            return number("total");
        }

        /** Of settle, join. */
        String worker() {
            return text("worker");
        }

        /** Of link. */
        String connector() {
            return text("connector");
        }

        /** Of link. */
        String interface_() {
            return text("interface");
        }

        /** Of attach, detach, break, mend. */
        String link() {
            return text("link");
        }

        /** Of attach. */
        String role() {
            return text("role");
        }

        /** Of break. */
        String where() {
            return text("where");
        }

        /** Of read_log. */
        long records() {
            return number("records");
        }

        /** Of pause, stress, advance. */
        long milliseconds() {
            return number("milliseconds");
        }

        /** Of await_messages. */
        long count() {
            return number("count");
        }

        /** Of await_messages. */
        long instance() {
            return number("instance");
        }

        /** Of stress. */
        List<String> refs() {
            return as(get("refs"));
        }
    }

    static Object readStep(Object value, String place) throws Misfit {
        return STEP.read(value, place);
    }

    private static final Shape DIRECTION = choice(
            "IN", "OUT", "INOUT", "RETURN");

    private static final Shape UNIONCASE = object(UnionCase::new,
            needs("name", TEXT),
            needs("of", Messages::readAnyType),
            may("selectors", list(TEXT), List.of()),
            may("default", FLAG, false));

    /**
     * An alternative of a union.
     *
     * `name`: its name.
     * `of`: type of its value.
     * `selectors`: the enumerators that select it.
     * `default`: it is selected by every enumerator that no other case names.
     */
    static final class UnionCase extends Node {
        private UnionCase(Map<String, Object> fields) {
            super(fields);
        }

        String name() {
            return text("name");
        }

        AnyType of() {
            return as(get("of"));
        }

        List<String> selectors() {
            return as(get("selectors"));
        }

        boolean default_() {
            return flag("default");
        }
    }

    static Object readUnionCase(Object value, String place) throws Misfit {
        return UNIONCASE.read(value, place);
    }

    private static final Shape ANYTYPE = tagged("type", AnyType::new,
            new Kind("integer",
                    needs("kind", choice(
                            "BYTE", "LONG", "LONGLONG", "SHORT", "UBYTE", "ULONG", "ULONGLONG", "USHORT"))),
            new Kind("float",
                    needs("kind", choice("DOUBLE", "FLOAT"))),
            new Kind("char",
                    needs("kind", choice("CHAR32", "CHAR8"))),
            new Kind("boolean"),
            new Kind("string",
                    needs("base", choice("CHAR32", "CHAR8")),
                    may("size", ANY_INTEGER, -1L)),
            new Kind("enumeration",
                    needs("name", TEXT),
                    needs("index", choice(
                            "BYTE", "LONG", "LONGLONG", "SHORT", "UBYTE", "ULONG", "ULONGLONG", "USHORT")),
                    needs("values", map(TEXT, ANY_INTEGER))),
            new Kind("structure",
                    needs("name", TEXT),
                    needs("fields", map(TEXT, Messages::readAnyType))),
            new Kind("union",
                    needs("name", TEXT),
                    needs("selector", Messages::readEnumeration),
                    needs("cases", list(Messages::readUnionCase))),
            new Kind("array",
                    needs("of", Messages::readAnyType),
                    needs("sizes", list(ANY_INTEGER))),
            new Kind("sequence",
                    needs("of", Messages::readAnyType),
                    may("size", ANY_INTEGER, -1L)),
            new Kind("alias",
                    needs("name", TEXT),
                    needs("of", Messages::readAnyType)));

    /** One of 11 kinds of objects; each method says which kinds have the field. */
    static final class AnyType extends Node {
        private AnyType(Map<String, Object> fields) {
            super(fields);
        }

        /** Which kind it is. */
        String tag() {
            return text("type");
        }

        /** Of integer, float, char. */
        String kind() {
            return text("kind");
        }

        /** Of string. */
        String base() {
            return text("base");
        }

        /** Of string, sequence. */
        Object size() {
            return get("size");
        }

        /** Of enumeration, structure, union, alias. */
        String name() {
            return text("name");
        }

        /** Of enumeration. */
        String index() {
            return text("index");
        }

        /** Of enumeration. */
        Map<String, Object> values() {
            return as(node("values").fields());
        }

        /** Of structure. */
        Map<String, AnyType> fields_() {
            return as(node("fields").fields());
        }

        /** Of union. */
        AnyType selector() {
            return as(get("selector"));
        }

        /** Of union. */
        List<UnionCase> cases() {
            return as(get("cases"));
        }

        /** Of array, sequence, alias. */
        AnyType of() {
            return as(get("of"));
        }

        /** Of array. */
        List<Object> sizes() {
            return as(get("sizes"));
        }
    }

    private static final Shape ENUMERATION = object(AnyType::new,
            may("type", choice("enumeration"), "enumeration"),
            needs("name", TEXT),
            needs("index", choice(
                            "BYTE", "LONG", "LONGLONG", "SHORT", "UBYTE", "ULONG", "ULONGLONG", "USHORT")),
            needs("values", map(TEXT, ANY_INTEGER)));

    private static Object readEnumeration(Object value, String place) throws Misfit {
        return ENUMERATION.read(value, place);
    }

    private static final Shape STRUCTURE = object(AnyType::new,
            may("type", choice("structure"), "structure"),
            needs("name", TEXT),
            needs("fields", map(TEXT, Messages::readAnyType)));

    private static Object readStructure(Object value, String place) throws Misfit {
        return STRUCTURE.read(value, place);
    }

    static Object readAnyType(Object value, String place) throws Misfit {
        return ANYTYPE.read(value, place);
    }

    private static final Shape PARAMETER = object(Parameter::new,
            needs("name", TEXT),
            needs("direction", DIRECTION),
            needs("of", Messages::readAnyType));

    /**
     * A parameter of a method.
     *
     * `name`: its name.
     * `direction`: which way its value goes.
     * `of`: its type.
     */
    static final class Parameter extends Node {
        private Parameter(Map<String, Object> fields) {
            super(fields);
        }

        String name() {
            return text("name");
        }

        String direction() {
            return text("direction");
        }

        AnyType of() {
            return as(get("of"));
        }
    }

    static Object readParameter(Object value, String place) throws Misfit {
        return PARAMETER.read(value, place);
    }

    private static final Shape METHOD = object(Method::new,
            may("parameters", list(Messages::readParameter), List.of()),
            may("raises", list(Messages::readStructure), List.of()));

    /**
     * A method of an interface.
     *
     * `parameters`: in order.
     * `raises`: the exceptions that it may raise.
     */
    static final class Method extends Node {
        private Method(Map<String, Object> fields) {
            super(fields);
        }

        List<Parameter> parameters() {
            return as(get("parameters"));
        }

        List<AnyType> raises() {
            return as(get("raises"));
        }
    }

    static Object readMethod(Object value, String place) throws Misfit {
        return METHOD.read(value, place);
    }

    private static final Shape INTERFACE = object(Interface::new,
            needs("methods", map(TEXT, Messages::readMethod)),
            may("inherited", list(TEXT), List.of()));

    /**
     * An interface (9.2.7).
     *
     * `methods`: its own and inherited methods, by name.
     * `inherited`: names of the interfaces that it inherits (9.2.7.2).
     */
    static final class Interface extends Node {
        private Interface(Map<String, Object> fields) {
            super(fields);
        }

        Map<String, Method> methods() {
            return as(node("methods").fields());
        }

        List<String> inherited() {
            return as(get("inherited"));
        }
    }

    static Object readInterface(Object value, String place) throws Misfit {
        return INTERFACE.read(value, place);
    }

    private static final Shape SCENARIO = object(Scenario::new,
            needs("components", map(TEXT, Messages::readDeclaration)),
            needs("steps", list(Messages::readStep)),
            may("patience", INT64, 2000L),
            may("interfaces", map(TEXT, Messages::readInterface), new Node(Map.of())),
            may("may_stay", list(TEXT), List.of()),
            may("types", map(TEXT, map(TEXT, Messages::readAnyType)), new Node(Map.of())));

    /**
     * A scenario.
     *
     * `components`: declarations by name.
     * `steps`: in order.
     * `patience`: how long a wait step may wait, in milliseconds.
     * `interfaces`: by name.
     * `may_stay`: workers that need not return; hosts ignore it.
     * `types`: by name, what a connector of 10.4 is bound to: data types by template parameter. The interfaces that
     * follow from it are among `interfaces`, as `platform_interfaces.named_interfaces` has them.
     */
    static final class Scenario extends Node {
        private Scenario(Map<String, Object> fields) {
            super(fields);
        }

        Map<String, Declaration> components() {
            return as(node("components").fields());
        }

        List<Step> steps() {
            return as(get("steps"));
        }

        long patience() {
            return number("patience");
        }

        Map<String, Interface> interfaces() {
            return as(node("interfaces").fields());
        }

        List<String> mayStay() {
            return as(get("may_stay"));
        }

        Map<String, Map<String, AnyType>> types() {
            return as(node("types").fields());
        }
    }

    static Object readScenario(Object value, String place) throws Misfit {
        return SCENARIO.read(value, place);
    }

    private static final Shape TO_HOST = tagged("type", Message::new,
            new Kind("hello",
                    needs("protocol", INT64)),
            new Kind("run",
                    needs("id", INT64),
                    needs("scenario", Messages::readScenario),
                    may("stream", FLAG, false)));

    /** One of 2 kinds of objects; each method says which kinds have the field. */
    static final class Message extends Node {
        private Message(Map<String, Object> fields) {
            super(fields);
        }

        /** Which kind it is. */
        String tag() {
            return text("type");
        }

        /** Of hello. */
        long protocol() {
            return number("protocol");
        }

        /** Of run. */
        long id() {
            return number("id");
        }

        /** Of run. */
        Scenario scenario() {
            return as(get("scenario"));
        }

        /** Of run. */
        boolean stream() {
            return flag("stream");
        }
    }

    static Object readMessage(Object value, String place) throws Misfit {
        return TO_HOST.read(value, place);
    }
}
