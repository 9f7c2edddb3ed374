"""Compares the models that a framework ships with 10.1, without a host."""
