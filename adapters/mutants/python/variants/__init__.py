"""Conformant variants of the Python reference framework."""
