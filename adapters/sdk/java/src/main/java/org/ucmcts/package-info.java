/**
 * The Java SDK of UCM-CTS: extend {@link org.ucmcts.Adapter} and give it to {@link org.ucmcts.Host}.
 *
 * <p>An adapter implements {@code Adapter} and handles what frameworks see of the suite's component bodies: {@code
 * Body}, {@code Connectable}, {@code Fragment}, {@code PortElement}, {@code PortConnection}, {@code Implementation},
 * and {@code TimerScheduler}, {@code ObjectTimer} and {@code TimerHandler}, if the framework has object timers.
 * Everything else carries out scenarios as docs/protocol.md says.
 */
package org.ucmcts;
