package org.ucmcts;

/** The exceptions that 12.10 declares. */
public abstract sealed class UcmException extends RuntimeException {
    private static final long serialVersionUID = 1;
    private final String spelling;

    private UcmException(String spelling, String message, Throwable cause) {
        super(message, cause);
        this.spelling = spelling;
    }

    /** How it is spelled in 12.10 and on the wire. */
    final String spelling() {
        return spelling;
    }

    /** NOT_FOUND of 12.10. */
    public static final class NotFound extends UcmException {
        private static final long serialVersionUID = 1;

        public NotFound(String message) {
            super("NOT_FOUND", message, null);
        }

        public NotFound(Throwable cause) {
            super("NOT_FOUND", cause.toString(), cause);
        }
    }

    /** BAD_PARAMETER of 12.10. */
    public static final class BadParameter extends UcmException {
        private static final long serialVersionUID = 1;

        public BadParameter(String message) {
            super("BAD_PARAMETER", message, null);
        }

        public BadParameter(Throwable cause) {
            super("BAD_PARAMETER", cause.toString(), cause);
        }
    }

    /** UCM_ERROR of 12.10. */
    public static final class UcmError extends UcmException {
        private static final long serialVersionUID = 1;

        public UcmError(String message) {
            super("UCM_ERROR", message, null);
        }

        public UcmError(Throwable cause) {
            super("UCM_ERROR", cause.toString(), cause);
        }
    }
}
