"""The second set of mutants: drawn from the dimensions of provocations, not from scenarios."""
