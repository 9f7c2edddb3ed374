"""What a run says: executions, incidents, verdicts, the vendor's statement, known failures."""
