"""The history of runs: keeps verdicts and costs of each run in a DuckDB file, and says how they changed."""
