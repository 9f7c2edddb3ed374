package org.ucmcts;

/**
 * The tested product, as the report names it.
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
