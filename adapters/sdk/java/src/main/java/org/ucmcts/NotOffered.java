package org.ucmcts;

/** The adapter does not offer this optional operation. */
public final class NotOffered extends RuntimeException {
    private static final long serialVersionUID = 1;
}
