"""Finds and starts the host of an adapter, and gets an answer or an incident for each message."""
