"""Scenarios derived from dimensions: what provokes a framework, thinned by covering arrays."""
