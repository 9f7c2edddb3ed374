"""The mapping of clause 12: the declarations that it asks for, with their requirements."""
