"""Finds the host of an adapter, starts it and gets an answer to each message, whatever the host does."""
