"""Is the suite itself right? Mutants must be found out, for the right reason, and conformant variants spared."""
