"""Test purposes that are derived from tables, from combinations or from the run's seed."""
