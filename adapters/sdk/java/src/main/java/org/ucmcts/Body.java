package org.ucmcts;

import java.util.List;

/** A component body (11.2.1.2), as a framework sees it. May also be {@link Connectable} and a {@link Fragment}. */
public interface Body {
    /** Called once, when the attributes have their configured values. */
    void onInit();

    /** Called when the operational phase begins, with the references of the required port elements. */
    void onStartup(List<PortConnection> dependencies);

    /** Called when the operational phase ends. */
    void onShutdown();

    /** Called when the instance is about to be removed. */
    void onRemove();

    /** The body's own object for the provided port element of that name, or null if it has none. */
    PortElement getPortElement(String provided);

    /**
     * The body's own object for the port element that its technical policy makes it provide, or null (12.8.5): of a
     * self-executing component its {@code run}.
     */
    Runnable getPolicyElement(String policy, String element);

    /**
     * The same, for a port element with an interface, as {@code timer_callback} of the index timers (10.3.2), whose
     * method is {@code on_timeout}.
     */
    default PortElement getPolicyPort(String policy, String element) {
        return null;
    }

    /** Sets a component attribute. */
    void setAttribute(String name, String value);
}
