"""Checks generated C++ headers against clause 13: with a compiler, and with libclang for what a compiler cannot show."""
