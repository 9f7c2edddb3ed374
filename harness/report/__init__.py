"""Writes reports: HTML, JSON, JUnit, and a summary for the terminal.

All text of a framework passes through ``foreign`` first.
"""
