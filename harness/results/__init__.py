"""The results of a run: executions, incidents, verdicts; the vendor's statement; known failures."""
