"""Executable reference models. Pure: no I/O, no thread, no clock; imports only the adapter contract."""
