"""Test purposes about data types and their values (10.1.1)."""
