"""Adapters of frameworks that others have made."""
