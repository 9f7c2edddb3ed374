"""What to run: scenarios of people, and those derived from tables, types and schedules."""
