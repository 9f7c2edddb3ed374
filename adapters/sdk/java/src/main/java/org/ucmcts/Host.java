package org.ucmcts;

import java.io.ByteArrayOutputStream;
import java.io.FileDescriptor;
import java.io.FileInputStream;
import java.io.FileOutputStream;
import java.io.IOException;
import java.io.InputStream;
import java.io.OutputStream;
import java.io.UncheckedIOException;
import java.util.function.Supplier;

/**
 * The process around an adapter. Give {@link #serve} the arguments of {@code main}: without any it answers the
 * harness on its standard streams; {@code --listen tcp://HOST:PORT} and {@code --listen unix:PATH} have each
 * connection answered by a process of its own.
 */
public final class Host {
    private static final int CHUNK = 1 << 16;

    private Host() {}

    /** Serves adapters that {@code adapters} makes, one for each scenario, and ends the process. */
    public static void serve(String[] arguments, Product product, Supplier<? extends Adapter<?>> adapters) {
        int status = 0;
        try {
            if (arguments.length == 0) {
                answer(new Engine(product, adapters));
            } else if (arguments.length == 2 && arguments[0].equals("--listen")) {
                Listener.listen(arguments[1]);
            } else {
                System.err.println(product.name() + ": an adapter for UCM-CTS; give it no arguments, or --listen with"
                        + " tcp://HOST:PORT or unix:PATH");
                status = 2;
            }
        } catch (IOException | UncheckedIOException error) {
            System.err.println(product.name() + ": " + error.getMessage());
            status = 1;
        }
        System.err.flush();
        Runtime.getRuntime().halt(status); // not exit: what a framework has left running must not hold it up
    }

    private static void answer(Engine engine) throws IOException {
        OutputStream target = new FileOutputStream(FileDescriptor.out);
        System.setOut(System.err); // for the framework's output
        Stacks.showOnRequest();
        InputStream source = new FileInputStream(FileDescriptor.in);
        System.setIn(InputStream.nullInputStream());
        ByteArrayOutputStream line = new ByteArrayOutputStream();
        byte[] chunk = new byte[CHUNK];
        for (int size = source.read(chunk); size >= 0; size = source.read(chunk)) {
            int begin = 0;
            for (int end = 0; end < size; end++) {
                if (chunk[end] != '\n') {
                    continue;
                }
                line.write(chunk, begin, end - begin);
                begin = end + 1;
                if (line.size() > 0 && !answer(engine, line.toByteArray(), target)) {
                    return;
                }
                line.reset();
            }
            line.write(chunk, begin, size - begin);
        }
    }

    private static boolean answer(Engine engine, byte[] line, OutputStream target) {
        Engine.Answer answer = engine.answer(line, ahead -> write(target, ahead));
        write(target, answer.line());
        return !answer.stuck();
    }

    private static void write(OutputStream target, byte[] line) {
        try {
            target.write(line);
        } catch (IOException error) { // the harness has gone
            Runtime.getRuntime().halt(0);
        }
    }
}
