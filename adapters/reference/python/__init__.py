"""A small UCM framework in Python and its adapter: the first thing to read when writing an adapter or a framework."""

from __future__ import annotations

from pathlib import Path

STATEMENT = Path(__file__).parent / "ics.toml"
"""What is stated of it."""
