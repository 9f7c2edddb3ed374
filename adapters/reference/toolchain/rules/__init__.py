"""The rules of a well-formed model, in modules by clause 9.1 to 9.5."""
