"""Adapters that hide what a framework does."""
