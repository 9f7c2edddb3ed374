"""Subjects whose verdict is known: mutants, conformant variants and cheats."""
