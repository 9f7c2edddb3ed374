"""Diagrams of executions and of the life cycle, laid out and drawn."""
