"""Test purposes: scenarios from scripts, and scenarios derived from tables, types and schedules."""
