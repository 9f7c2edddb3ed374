"""The properties that every trace is checked against."""
