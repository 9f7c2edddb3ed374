package org.ucmcts;

import java.io.IOException;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.function.Consumer;
import java.util.function.Supplier;
import org.ucmcts.Messages.Declaration;
import org.ucmcts.Messages.Message;
import org.ucmcts.Shape.Misfit;

/** Answers wire messages by running scenarios, as docs/protocol.md says: one message in, one answer out, in order. */
final class Engine {
    private static final long PROTOCOL = 2;

    private final Product product;
    private final Supplier<? extends Adapter<?>> adapters;

    /** {@code adapters} makes one for each scenario. */
    Engine(Product product, Supplier<? extends Adapter<?>> adapters) {
        this.product = product;
        this.adapters = adapters;
    }

    /** One line with its newline. When threads are {@code stuck}, no more scenarios can be run in this process. */
    record Answer(byte[] line, boolean stuck) {}

    /**
     * The answer to one line of the wire protocol. Never throws for what the line says. {@code emit} receives the
     * lines that come before the answer of a streamed run.
     */
    Answer answer(byte[] line, Consumer<byte[]> emit) {
        Object read = null;
        Message message;
        try {
            read = Json.read(line);
            message = (Message) Messages.readMessage(read, "$");
            check(message);
        } catch (IOException | Misfit error) {
            Object id = read instanceof Map<?, ?> fields && "run".equals(fields.get("type")) ? fields.get("id") : null;
            Long number = id instanceof Integer || id instanceof Long ? ((Number) id).longValue() : null;
            return refusal("not a message of protocol " + PROTOCOL + ": " + error.getMessage(), number);
        }
        if (message.tag().equals("hello")) {
            return welcome(message.protocol());
        }
        try {
            return perform(adapters.get(), message, emit);
        } catch (Throwable error) { // a framework may throw anything
            return refusal(Details.described(error), message.id());
        }
    }

    // what the types cannot say
    private static void check(Message message) throws Misfit {
        if (message.tag().equals("run")) {
            for (Map.Entry<String, Declaration> one : message.scenario().components().entrySet()) {
                List<String> ports = new ArrayList<>(one.getValue().provides());
                ports.addAll(one.getValue().requires());
                if (ports.stream().distinct().count() < ports.size()) {
                    throw new Misfit("a port element is declared twice", "$.scenario.components." + one.getKey());
                }
            }
        }
    }

    private Answer welcome(long spoken) {
        if (spoken != PROTOCOL) {
            return refusal("the harness speaks protocol " + spoken + ", this host speaks " + PROTOCOL, null);
        }
        Map<String, Object> welcome = Json.object("type", "welcome", "protocol", PROTOCOL, "product",
                product.name(), "version", product.version(), "port_element_name", product.portElementName());
        return new Answer(Json.line(welcome), false);
    }

    private static <C> Answer perform(Adapter<C> adapter, Message run, Consumer<byte[]> emit) throws Exception {
        long id = run.id();
        Consumer<Map<String, Object>> sink =
                event -> emit.accept(Json.line(Json.object("type", "event", "id", id, "event", event)));
        Recorder recorder = new Recorder(run.stream() ? sink : null);
        Performance.Outcome outcome = null;
        try {
            outcome = new Performance<>(adapter, run.scenario(), recorder).run();
        } finally {
            if (outcome == null || outcome.stuck().isEmpty()) {
                adapter.close();
            }
        }
        boolean stuck = !outcome.stuck().isEmpty();
        if (recorder.complaint() != null) {
            return new Answer(refusal(recorder.complaint(), id).line(), stuck);
        }
        Map<String, Object> traced =
                Json.object("type", "trace", "id", id, "events", outcome.events(), "stuck", outcome.stuck());
        return new Answer(Json.line(traced), stuck);
    }

    private static Answer refusal(String reason, Long id) {
        return new Answer(Json.line(Json.object("type", "refused", "reason", reason, "id", id)), false);
    }
}
