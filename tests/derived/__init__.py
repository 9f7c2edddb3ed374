"""Frameworks derived from the Python reference framework: ``SUBJECTS`` are wrong, ``VARIANTS`` conformant.

Each is a few lines put in front of the reference framework; the docstring says how it lies, or which freedom it uses.
Every module of this package registers its own.
"""

import importlib
import pkgutil

from derived.registry import (
    CORE_SUBJECTS,
    CORE_VARIANTS,
    POLICY_READINGS,
    POLICY_SUBJECTS,
    POLICY_VARIANTS,
    SUBJECTS,
    VARIANT_CLAUSES,
    VARIANT_READINGS,
    VARIANTS,
    WrongSubject,
)

__all__ = [
    "CORE_SUBJECTS",
    "CORE_VARIANTS",
    "POLICY_READINGS",
    "POLICY_SUBJECTS",
    "POLICY_VARIANTS",
    "SUBJECTS",
    "VARIANTS",
    "VARIANT_CLAUSES",
    "VARIANT_READINGS",
    "WrongSubject",
]

for _module in pkgutil.iter_modules(__path__):
    importlib.import_module(f"{__name__}.{_module.name}")
