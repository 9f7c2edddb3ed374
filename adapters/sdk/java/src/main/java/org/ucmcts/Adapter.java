package org.ucmcts;

import java.util.List;
import java.util.Map;

/**
 * Binds one framework. One instance is made for each scenario and serves one runtime; operations and callbacks may
 * come from several threads at once.
 *
 * <p>An adapter forwards each operation of the Container API (12.10) one to one and translates errors. It adds no
 * state checks of its own: they would hide what is being measured. Operations end by returning or by throwing {@link
 * UcmException.NotFound}, {@link UcmException.BadParameter} or {@link UcmException.UcmError}; anything else is
 * reported as undeclared, which 12.10 forbids, so let the framework's other exceptions pass.
 *
 * @param <C> the type that the framework, or the adapter, uses for a container
 */
public abstract class Adapter<C> {
    /** Makes an empty runtime that can instantiate {@code implementations}; returns its root container (11.2.2.2). */
    public abstract C createRuntime(List<Implementation> implementations) throws Exception;

    /**
     * {@code add_component} with the configuration values that select {@code implementation} and set {@code
     * attributes}. The adapter knows how the framework wants that said; clause 12.10 only fixes name and value pairs.
     */
    public abstract int addComponent(C container, String implementation, Map<String, String> attributes)
            throws Exception;

    /** {@code remove_component}. */
    public abstract void removeComponent(C container, int component) throws Exception;

    /** {@code get_port_element}. */
    public abstract PortElement getPortElement(C container, int component, String port) throws Exception;

    /** {@code connect}; returns the connection id. {@code toPort} may be null. */
    public abstract int connect(C container, int component, String port, PortElement toPort) throws Exception;

    /** {@code disconnect}. */
    public abstract void disconnect(C container, int connection) throws Exception;

    /** {@code start}. */
    public abstract void start(C container) throws Exception;

    /** {@code stop}. */
    public abstract void stop(C container) throws Exception;

    /** {@code get_components}. */
    public abstract List<Integer> getComponents(C container) throws Exception;

    /** {@code create_container} on the root container. */
    public abstract C createContainer(C manager) throws Exception;

    /** {@code remove_container} on the root container; {@code subContainer} may be null. */
    public abstract void removeContainer(C manager, C subContainer) throws Exception;

    /** {@code destroy} the runtime. Also called after a scenario that has not done so, with any outcome ignored. */
    public abstract void destroy(C manager) throws Exception;

    // What profiles core and extensions need beside; what an adapter does not override stays untested.

    /** Makes a connection without ends (9.5.5.4) with a {@code connector} of 10.1, bound to {@code type}. */
    public Object link(C manager, String connector, Node type) throws Exception {
        throw new NotOffered();
    }

    /**
     * Makes a connection without ends with a {@code connector} of 10.4, bound to data {@code types} by template
     * parameter.
     */
    public Object linkWithTypes(C manager, String connector, Node types) throws Exception {
        throw new NotOffered();
    }

    /**
     * Makes the port element an end of {@code link}, in the {@code role} of client, server, emitter or receiver. If
     * {@code role} is a connector port of 10.4, {@code port} is the name of a port, with all its port elements.
     */
    public void attach(Object link, String role, C container, int component, String port) throws Exception {
        throw new NotOffered();
    }

    /** The port element is no longer an end of {@code link}. */
    public void detach(Object link, C container, int component, String port) throws Exception {
        throw new NotOffered();
    }

    /** Breaks the {@code transport} of {@code link}, or its connector {@code inside}, until it is mended (10.1.2). */
    public void breakLink(Object link, String where) throws Exception {
        throw new NotOffered();
    }

    /** Mends what was broken. */
    public void mendLink(Object link) throws Exception {
        throw new NotOffered();
    }

    /** All records of the trace (10.1.4.2) so far, oldest first. */
    public List<LogRecord> readLog(C manager) throws Exception {
        throw new NotOffered();
    }

    /** Lets so much virtual time pass for all components at once. */
    public void advance(C manager, int milliseconds) throws Exception {
        throw new NotOffered();
    }

    /** Frees what the adapter itself holds; called last, unless threads are stuck. */
    public void close() throws Exception {}

    /** One record of the trace (10.1.4.2); {@code severity} is an enumerator of log_severity_t. */
    public record LogRecord(String severity, String message) {}
}
