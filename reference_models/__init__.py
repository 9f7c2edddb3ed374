"""Executable reference models. Pure: no I/O, no thread, no clock; imports the event vocabulary only."""
