"""Mutants of clause 10.1.1: values of each type on their way."""
