"""Wrong and conformant frameworks that are derived from the Python reference framework.

``MUTANTS`` are wrong, ``VARIANTS`` are conformant, and ``CHEATS`` are adapters that hide defects. Each changes a few lines of the reference framework; the docstring names the defect, or the freedom that it uses.
``subjects`` has them all. ``ucm_cts.adapters.mutants.python:NAME`` names the adapter of one; a host that asks for it loads only the module that
registers it, because each trial of a mutant starts a host.
"""

from __future__ import annotations

import re
from importlib import import_module
from pathlib import Path

from ucm_cts.adapters.mutants.python.registry import adapter_of
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter


def __getattr__(name: str) -> type[ReferenceAdapter]:
    for module in () if name.startswith("_") else (*_modules_that_define(name), "subjects"):
        import_module(f"{__name__}.{module}")
        adapter = adapter_of(name)
        if adapter is not None:
            return adapter
    raise AttributeError(name)


def _modules_that_define(name: str) -> list[str]:
    """The modules of this package whose text has a function, a class or a row of a family called ``name``."""
    here = Path(__file__).parent
    definition = re.compile(rf'^(?:def|class) {name}\b|^ +"{name}": ', re.MULTILINE)
    found = (file for file in sorted(here.glob("*/*.py")) if definition.search(file.read_text("utf-8")))
    return [".".join(file.relative_to(here).with_suffix("").parts) for file in found]
