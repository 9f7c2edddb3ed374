"""The C++ reference framework behind the C++ door, as a stand-alone executable."""

from __future__ import annotations

from pathlib import Path

COMMAND = Path(__file__).parent.parent / "bin" / "reference-cpp"
"""The stand-alone adapter; an installed ucm-cts has it."""

STATEMENT = Path(__file__).parent / "ics.toml"
"""What is stated of the framework."""
