"""Fixtures of several test modules."""

from cpp_builds import builds

__all__ = ["builds"]
