"""Mutants of clause 10.1.3: execution policies."""
