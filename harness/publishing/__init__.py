"""Publishes certificates: a static site of all that stand, and a line for each that does not."""
