"""Frameworks derived from the Python reference framework: ``MUTANTS`` are wrong, ``VARIANTS`` conformant.

Each is a few lines put in front of the reference framework; the docstring says how it lies, or which freedom it uses.
Every module of this package registers its own. ``ucm_cts.adapters.derived:NAME`` names the adapter of one.
"""

from __future__ import annotations

import importlib
import pkgutil

from ucm_cts.adapters.derived.registry import (
    CONTAINER,
    CORE,
    MUTANTS,
    POLICIES,
    VARIANTS,
    Mutant,
    Variant,
    mutants_of,
    variants_of,
)
from ucm_cts.adapters.reference_py.adapter import ReferenceAdapter

__all__ = ["CONTAINER", "CORE", "MUTANTS", "POLICIES", "VARIANTS", "Mutant", "Variant", "mutants_of", "variants_of"]

for _module in pkgutil.iter_modules(__path__):
    importlib.import_module(f"{__name__}.{_module.name}")


def __getattr__(name: str) -> type[ReferenceAdapter]:
    try:
        return (MUTANTS[name] if name in MUTANTS else VARIANTS[name]).adapter
    except KeyError:
        raise AttributeError(name) from None
