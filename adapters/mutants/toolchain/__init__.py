"""Tool chains derived from the reference one: mutants, each with one thing wrong, and conformant variants."""
