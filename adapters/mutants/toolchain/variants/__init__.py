"""Conformant variants of the reference tool chain."""
