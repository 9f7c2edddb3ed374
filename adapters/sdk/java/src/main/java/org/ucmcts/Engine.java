package org.ucmcts;

import java.io.IOException;
import java.util.Map;
import java.util.function.Consumer;
import java.util.function.Supplier;
import org.ucmcts.Shape.Misfit;

/** Answers wire messages by running scenarios, as docs/protocol.md says: one message in, one answer out, in order. */
final class Engine {
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
        Node message;
        try {
            read = Json.read(line);
            message = Protocol.message(read);
        } catch (IOException | Misfit error) {
            Object id = read instanceof Map<?, ?> fields && "run".equals(fields.get("type")) ? fields.get("id") : null;
            Long number = id instanceof Integer || id instanceof Long ? ((Number) id).longValue() : null;
            return refusal("not a message of protocol " + Protocol.VERSION + ": " + error.getMessage(), number);
        }
        if (message.text("type").equals("hello")) {
            return welcome(message.number("protocol"));
        }
        try {
            return perform(adapters.get(), message, emit);
        } catch (Throwable error) { // a framework may throw anything
            return refusal(Details.described(error), message.number("id"));
        }
    }

    private Answer welcome(long spoken) {
        if (spoken != Protocol.VERSION) {
            return refusal(
                    "the harness speaks protocol " + spoken + ", this host speaks " + Protocol.VERSION, null);
        }
        Map<String, Object> welcome = Json.object("type", "welcome", "protocol", Protocol.VERSION, "product",
                product.name(), "version", product.version(), "port_element_name", product.portElementName());
        return new Answer(Json.line(welcome), false);
    }

    private static <C> Answer perform(Adapter<C> adapter, Node run, Consumer<byte[]> emit) throws Exception {
        long id = run.number("id");
        Consumer<Map<String, Object>> sink =
                event -> emit.accept(Json.line(Json.object("type", "event", "id", id, "event", event)));
        Recorder recorder = new Recorder(run.flag("stream") ? sink : null);
        Performance.Outcome outcome = null;
        try {
            outcome = new Performance<>(adapter, run.node("scenario"), recorder).run();
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
