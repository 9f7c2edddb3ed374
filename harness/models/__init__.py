"""Compares the models that a framework ships with clause 10, without a host."""
