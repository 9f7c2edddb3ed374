package org.ucmcts;

import java.lang.reflect.Proxy;
import java.util.Map;

/**
 * Shows on standard error where all threads are when the process gets SIGUSR1, as the harness sends it to hosts that
 * hang.
 */
final class Stacks {
    private Stacks() {}

    /** From now on; where the virtual machine has no such signals, never. */
    static void showOnRequest() {
        try { // by reflection: the compiler warns of these classes, and other virtual machines need not have them
            Class<?> signal = Class.forName("sun.misc.Signal");
            Class<?> handler = Class.forName("sun.misc.SignalHandler");
            Object show = Proxy.newProxyInstance(
                    Stacks.class.getClassLoader(), new Class<?>[] {handler}, (proxy, method, arguments) -> {
                        show();
                        return null;
                    });
            signal.getMethod("handle", signal, handler)
                    .invoke(null, signal.getConstructor(String.class).newInstance("USR1"), show);
        } catch (ReflectiveOperationException error) {
            return;
        }
    }

    private static void show() {
        StringBuilder text = new StringBuilder();
        for (Map.Entry<Thread, StackTraceElement[]> entry : Thread.getAllStackTraces().entrySet()) {
            Thread thread = entry.getKey();
            text.append("thread ").append(thread.getName()).append(": ").append(thread.getState()).append('\n');
            for (StackTraceElement frame : entry.getValue()) {
                text.append("    at ").append(frame).append('\n');
            }
        }
        System.err.print(text);
        System.err.flush();
    }
}
