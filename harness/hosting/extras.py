"""Extras: libraries that only some commands need. A missing one is said in one line that names the extra.

The core (``pip install ucm-cts``) certifies frameworks behind adapters. Modules import the libraries below where they use them.
"""

from __future__ import annotations

import importlib.util
from collections.abc import Mapping

from ucm_cts.harness.hosting.locate import WrongUse

EXTRAS: Mapping[str, tuple[str, ...]] = {
    "toolchain": ("clang", "lark", "re2"),
    "certificates": ("cryptography", "securesystemslib", "zstandard"),
    "history": ("duckdb",),
    "campaigns": ("bokeh", "cryptography", "distributed"),
}
"""The top-level modules that each extra of ``pyproject.toml`` brings."""


def need(extra: str, purpose: str) -> None:
    """Raise ``WrongUse`` if a module of ``extra`` is missing, which ``purpose`` ("certifying a tool chain") takes."""
    missing = [module for module in EXTRAS[extra] if importlib.util.find_spec(module) is None]
    if missing:
        raise WrongUse(f"{purpose} takes {', '.join(missing)}, which this environment lacks: {_remedy(extra)}")


def remedy_for(error: ImportError) -> str:
    """The line for a module that could not be imported; empty if no extra has it."""
    top = (error.name or "").partition(".")[0]
    extra = next((extra for extra, modules in EXTRAS.items() if top in modules), "")
    return f"this takes {top}, which cannot be imported ({error}): {_remedy(extra)}" if extra else ""


def _remedy(extra: str) -> str:
    return f"pip install 'ucm-cts[{extra}]', or '.[{extra}]' in its sources"
