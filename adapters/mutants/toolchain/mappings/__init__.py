"""Mutants that generate wrong IDL or C++ (clauses 12 to 14)."""
