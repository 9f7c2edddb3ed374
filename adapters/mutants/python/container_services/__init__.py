"""Mutants of clause 10.1.4: clocks and traces."""
