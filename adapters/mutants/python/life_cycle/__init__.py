"""Mutants of clauses 11 and 12.10: containers, components, and their life cycle."""
