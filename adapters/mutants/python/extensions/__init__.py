"""Mutants of clauses 10.1.2, 10.1.5 and 10.1.6: service and message connectors."""
