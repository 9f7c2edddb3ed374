"""Frameworks derived from the Python reference framework: ``MUTANTS`` are wrong, ``VARIANTS`` conformant,
and ``CHEATS`` are adapters that hide what is wrong.

Each is a few lines put in front of the reference framework; the docstring says how it lies, or which freedom it uses.
Every module of this package registers its own. ``ucm_cts.adapters.mutants.python:NAME`` names the adapter of one.
"""

from __future__ import annotations

import importlib
import pkgutil

from ucm_cts.adapters.mutants.python.registry import (
    CHEATS,
    CONTAINER,
    CORE,
    MUTANTS,
    POLICIES,
    UNSEEN,
    VARIANTS,
    Cheat,
    Mutant,
    Variant,
    mutants_of,
    variants_of,
)
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter

__all__ = [
    "CHEATS",
    "CONTAINER",
    "CORE",
    "MUTANTS",
    "POLICIES",
    "UNSEEN",
    "VARIANTS",
    "Cheat",
    "Mutant",
    "Variant",
    "mutants_of",
    "variants_of",
]

for _module in pkgutil.iter_modules(__path__):
    importlib.import_module(f"{__name__}.{_module.name}")


def __getattr__(name: str) -> type[ReferenceAdapter]:
    for known in (MUTANTS, VARIANTS, CHEATS, UNSEEN):
        if name in known and (adapter := known[name].adapter) is not None:
            return adapter
    raise AttributeError(name)
