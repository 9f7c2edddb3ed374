"""The C++ reference framework by the C++ SDK, as a stand-alone executable."""

from __future__ import annotations

from pathlib import Path

COMMAND = Path(__file__).parents[2] / "bin" / "reference-cpp"
"""The stand-alone adapter; an installed ucm-cts has it."""

STATEMENT = Path(__file__).parent / "ics.toml"
"""What is stated of the framework."""

TYPED_COMMAND = COMMAND.with_name("reference-cpp-typed")
"""The same with typed component bodies (13.9)."""

TYPED_STATEMENT = STATEMENT.with_name("ics_typed.toml")
"""What is stated of that."""
