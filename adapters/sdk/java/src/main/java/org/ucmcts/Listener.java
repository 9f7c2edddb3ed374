package org.ucmcts;

import java.io.IOException;
import java.io.InputStream;
import java.io.OutputStream;
import java.lang.management.ManagementFactory;
import java.net.InetSocketAddress;
import java.net.StandardProtocolFamily;
import java.net.StandardSocketOptions;
import java.net.URI;
import java.net.URISyntaxException;
import java.net.UnixDomainSocketAddress;
import java.nio.ByteBuffer;
import java.nio.channels.ServerSocketChannel;
import java.nio.channels.SocketChannel;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.TimeUnit;

/** Serves connections, each by a process of its own, so that a crash ends one connection only. */
final class Listener {
    private static final int CHUNK = 1 << 16;
    private static final long GRACE = 30; // seconds a host may work on after the other end of its connection has gone
    private static final Set<Process> HOSTS = ConcurrentHashMap.newKeySet();

    private Listener() {}

    /** Accepts for ever at {@code address}, {@code tcp://HOST:PORT} or {@code unix:PATH}. */
    static void listen(String address) throws IOException {
        try (ServerSocketChannel server = open(address)) {
            Runtime.getRuntime().addShutdownHook(new Thread(() -> HOSTS.forEach(Process::destroyForcibly)));
            while (true) {
                SocketChannel connection = server.accept();
                background("connection", () -> serve(connection));
            }
        }
    }

    private static ServerSocketChannel open(String address) throws IOException {
        ServerSocketChannel server;
        String shown = address;
        if (address.startsWith("unix:")) {
            Path path = Path.of(address.substring("unix:".length()));
            if (Files.exists(path) && !Files.isRegularFile(path) && !Files.isDirectory(path)) {
                Files.delete(path); // left behind by an earlier host
            }
            server = ServerSocketChannel.open(StandardProtocolFamily.UNIX);
            server.bind(UnixDomainSocketAddress.of(path));
        } else {
            URI place = place(address);
            server = ServerSocketChannel.open();
            server.setOption(StandardSocketOptions.SO_REUSEADDR, true);
            String host = place.getHost().replaceAll("^\\[|]$", "");
            server.bind(new InetSocketAddress(host, place.getPort()));
            shown = "tcp://" + place.getHost() + ":" + ((InetSocketAddress) server.getLocalAddress()).getPort();
        }
        System.out.println("listening on " + shown);
        System.out.flush();
        return server;
    }

    private static URI place(String address) throws IOException {
        try {
            URI place = new URI(address);
            if ("tcp".equals(place.getScheme()) && place.getHost() != null && place.getPort() >= 0) {
                return place;
            }
        } catch (URISyntaxException error) {
            // said below
        }
        throw new IOException("cannot listen on " + address + "; write tcp://HOST:PORT or unix:PATH");
    }

    private static void serve(SocketChannel connection) throws IOException, InterruptedException {
        try (connection) {
            if (connection.getLocalAddress() instanceof InetSocketAddress) {
                connection.setOption(StandardSocketOptions.TCP_NODELAY, true);
            }
            Process host = new ProcessBuilder(command()).redirectError(ProcessBuilder.Redirect.INHERIT).start();
            HOSTS.add(host);
            try {
                background("to host", () -> {
                    try (OutputStream target = host.getOutputStream()) {
                        forward(connection, target);
                    } finally {
                        if (!host.waitFor(GRACE, TimeUnit.SECONDS)) {
                            host.destroyForcibly();
                        }
                    }
                });
                forward(host.getInputStream(), connection);
            } finally {
                host.destroyForcibly();
                host.waitFor();
                HOSTS.remove(host);
            }
        }
    }

    // the same program once more, without arguments
    private static List<String> command() {
        List<String> command = new ArrayList<>();
        command.add(Path.of(System.getProperty("java.home"), "bin", "java").toString());
        command.addAll(ManagementFactory.getRuntimeMXBean().getInputArguments());
        command.add("-cp");
        command.add(System.getProperty("java.class.path"));
        command.add(System.getProperty("sun.java.command").split(" ")[0]);
        return command;
    }

    // not by the streams of Channels: reading from one keeps others from writing to the same connection

    private static void forward(SocketChannel source, OutputStream target) throws IOException {
        ByteBuffer chunk = ByteBuffer.allocate(CHUNK);
        while (source.read(chunk.clear()) >= 0) {
            target.write(chunk.array(), 0, chunk.position());
            target.flush();
        }
    }

    private static void forward(InputStream source, SocketChannel target) throws IOException {
        byte[] chunk = new byte[CHUNK];
        for (int size = source.read(chunk); size >= 0; size = source.read(chunk)) {
            ByteBuffer rest = ByteBuffer.wrap(chunk, 0, size);
            while (rest.hasRemaining()) {
                target.write(rest);
            }
        }
    }

    @FunctionalInterface
    private interface Task {
        void run() throws IOException, InterruptedException;
    }

    private static void background(String name, Task task) {
        Thread thread = new Thread(() -> {
            try {
                task.run();
            } catch (IOException | InterruptedException error) {
                return; // one end has gone
            }
        }, name);
        thread.setDaemon(true);
        thread.start();
    }
}
