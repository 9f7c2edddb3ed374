package org.ucmcts;

import java.util.List;
import java.util.Map;
import java.util.function.Supplier;

/**
 * A component implementation a framework can instantiate: what its model says, and how bodies are made.
 *
 * @param name what {@code addComponent} asks for
 * @param provides the provided port elements
 * @param requires the required port elements
 * @param attributes the names of its attributes
 * @param connectable are bodies {@link Connectable}?
 * @param fragment are bodies a {@link Fragment}?
 * @param create makes a body; call it once for each instance
 * @param policies the technical policies that the container has to apply (10.1.3, 10.1.4)
 * @param interfaces the interfaces of the port elements that have one; the others have {@code exchange}
 * @param defaults the default value of each attribute that has one (9.2.7.4)
 */
public record Implementation(
        String name,
        List<String> provides,
        List<String> requires,
        List<String> attributes,
        boolean connectable,
        boolean fragment,
        Supplier<Body> create,
        List<Policy> policies,
        Map<String, Node> interfaces,
        Map<String, String> defaults) {}
