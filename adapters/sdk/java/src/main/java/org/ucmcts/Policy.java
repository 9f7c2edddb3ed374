package org.ucmcts;

import java.util.Map;

/**
 * A technical policy of a component implementation (9.5.4.3).
 *
 * @param definition its name in clause 10.1
 * @param port the port element it applies to, or null
 * @param parameters its parameters
 * @param element the name under which the component gets the port element that it requires by the policy, or null
 */
public record Policy(String definition, String port, Map<String, String> parameters, String element) {}
