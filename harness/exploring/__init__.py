"""Exploration: generates scenarios, and varies those that showed something new."""
