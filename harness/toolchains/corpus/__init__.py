"""Models that tool chains are asked about: hand-written cases, legal models, and what operators make of them."""
