"""Mutants that judge models wrongly (clause 9)."""
