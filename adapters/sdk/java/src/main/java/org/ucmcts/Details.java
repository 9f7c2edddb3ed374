package org.ucmcts;

/** Texts of exceptions, for people. */
final class Details {
    private static final int LONGEST = 200;

    private Details() {}

    /** The kind and the text of {@code error}. */
    static String described(Throwable error) {
        String text = text(error);
        return text.isEmpty() ? error.getClass().getName() : error.getClass().getName() + ": " + text;
    }

    /** The text of {@code error} alone; empty if it has none, or asking for it fails. */
    static String text(Throwable error) {
        String text;
        try {
            text = error.getMessage();
        } catch (RuntimeException failure) { // the exception is the framework's
            return "";
        }
        if (text == null) {
            return "";
        }
        StringBuilder shortened = new StringBuilder();
        text.codePoints().limit(LONGEST).forEach(point -> {
            boolean alone = point >= Character.MIN_SURROGATE && point <= Character.MAX_SURROGATE;
            shortened.appendCodePoint(alone ? 0xFFFD : point);
        });
        return shortened.toString();
    }
}
