"""Generates IDL from models (clause 12)."""
