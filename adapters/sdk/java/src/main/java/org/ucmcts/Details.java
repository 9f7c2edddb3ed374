package org.ucmcts;

/** What is told of exceptions, for people. */
final class Details {
    private static final int LONGEST = 200;

    private Details() {}

    /** The kind and the text of {@code error}. */
    static String described(Throwable error) {
        String text = text(error);
        return text.isEmpty() ? error.getClass().getName() : error.getClass().getName() + ": " + text;
    }

    /** Its text alone, as far as it can be told. */
    static String text(Throwable error) {
        String text;
        try {
            text = error.getMessage();
        } catch (RuntimeException unspeakable) { // the exception is the framework's
            return "";
        }
        if (text == null) {
            return "";
        }
        StringBuilder told = new StringBuilder();
        text.codePoints().limit(LONGEST).forEach(point -> {
            boolean alone = point >= Character.MIN_SURROGATE && point <= Character.MAX_SURROGATE;
            told.appendCodePoint(alone ? 0xFFFD : point);
        });
        return told.toString();
    }
}
