package org.ucmcts;

/** The exceptions that 12.10 declares. */
public abstract sealed class UcmException extends RuntimeException {
    private static final long serialVersionUID = 1;

    private UcmException(String message, Throwable cause) {
        super(message, cause);
    }

    /** How it is spelled in 12.10 and on the wire. */
    abstract String spelling();

    /** NOT_FOUND of 12.10. */
    public static final class NotFound extends UcmException {
        private static final long serialVersionUID = 1;

        public NotFound(String message) {
            super(message, null);
        }

        public NotFound(Throwable cause) {
            super(cause.toString(), cause);
        }

        @Override
        String spelling() {
            return "NOT_FOUND";
        }
    }

    /** BAD_PARAMETER of 12.10. */
    public static final class BadParameter extends UcmException {
        private static final long serialVersionUID = 1;

        public BadParameter(String message) {
            super(message, null);
        }

        public BadParameter(Throwable cause) {
            super(cause.toString(), cause);
        }

        @Override
        String spelling() {
            return "BAD_PARAMETER";
        }
    }

    /** UCM_ERROR of 12.10. */
    public static final class UcmError extends UcmException {
        private static final long serialVersionUID = 1;

        public UcmError(String message) {
            super(message, null);
        }

        public UcmError(Throwable cause) {
            super(cause.toString(), cause);
        }

        @Override
        String spelling() {
            return "UCM_ERROR";
        }
    }
}
