"""The models that test tool chains: hand-written cases, legal models, and what operators make of them."""
