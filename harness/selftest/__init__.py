"""Tests of the suite: mutants must be killed for the right reason, conformant variants spared, cheats detected."""
