package org.ucmcts;

import java.util.List;

/** One required port element and the references connected to it (12.10); a reference may be null. */
public record PortConnection(String fromPort, List<? extends PortElement> toPort) {}
