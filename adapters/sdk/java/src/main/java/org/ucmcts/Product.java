package org.ucmcts;

/**
 * Who is tested, as it stands in the report.
 *
 * @param name the framework's name
 * @param version the framework's version
 * @param portElementName how the framework spells the name of a port element at its API
 */
public record Product(String name, String version, String portElementName) {
    public Product(String name, String version) {
        this(name, version, "{port}_{element}");
    }
}
