"""Certifies tool chains: which models they accept, and what they generate from them (docs/toolchain-design.md)."""
