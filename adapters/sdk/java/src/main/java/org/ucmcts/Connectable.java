package org.ucmcts;

/** Bodies that are called at each connection (11.2.1.3). */
public interface Connectable {
    /** The required port element {@code portName} has been connected to {@code required}. */
    void onConnect(String portName, PortElement required);

    /** The required port element {@code portName} has been disconnected. */
    void onDisconnect(String portName);
}
