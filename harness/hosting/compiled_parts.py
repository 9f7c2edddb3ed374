"""The compiled parts of this installation."""

from __future__ import annotations

from pathlib import Path

COMPILED = Path(__file__).parents[2] / "adapters" / "bin"
"""Where they are, if there was a compiler."""

HOW_TO_COMPILE = "install a C++ compiler, cmake and nlohmann-json3-dev, then ucm-cts again, with UCM_CTS_COMPILED=1 to see what is missing"
"""The remedy where they are missing."""
