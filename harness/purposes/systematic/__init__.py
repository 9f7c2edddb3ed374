"""Suites with a guarantee: finite machines derived from the life-cycle table, and test suites derived from machines."""
