"""The reference model: what a trace has shown so far, and what may happen next."""
