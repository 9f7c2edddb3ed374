"""Reads the IDL of a vendor: preprocessor, grammar, names and values."""
