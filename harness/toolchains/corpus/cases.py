"""Hand-written cases of profile pim: a small legal model, and the one edit that breaks it, or does not (``suite/models/cases``)."""

from __future__ import annotations

import functools
from pathlib import Path

from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.catalogue.documents import DocumentError, convert, read_lines
from ucm_cts.harness.catalogue.requirements import SUITE

CASES = SUITE / "models" / "cases"


class Variant(Value, frozen=True):
    """The legal model with one thing changed: ``swap`` (or each of ``swaps``) is text that is there once, and what replaces
    it. ``because`` says why that is wrong, or why it is not. ``requirement`` is the case's if it is empty; ``under`` are readings
    (``option=value``) that must be declared.
    """

    because: str
    swap: tuple[str, str] | None = None
    swaps: tuple[tuple[str, str], ...] = ()
    requirement: str = ""
    under: tuple[str, ...] = ()


class Case(Value, frozen=True):
    """A legal model and its variants. Refusing ``legal`` breaks ``accepts``, which is ``requirement`` if it is empty."""

    name: str
    requirement: str
    legal: str
    accepts: str = ""
    broken: tuple[Variant, ...] = ()
    also_legal: tuple[Variant, ...] = ()
    under: tuple[str, ...] = ()


@functools.cache
def load_cases() -> tuple[Case, ...]:
    """All cases, clause by clause. Raises ``DocumentError``."""
    paths = sorted(CASES.glob("*.yaml"), key=lambda path: (int(path.name.partition("_")[0]), path.name))
    return tuple(case for path in paths for case in read_cases(path))


def read_cases(path: Path) -> list[Case]:
    """The cases in the file at ``path``. Raises ``DocumentError``."""
    value, lines = read_lines(path)
    cases = convert(path, value, list[Case], lines)
    for number, case in enumerate(cases):
        for kind, variants in (("broken", case.broken), ("also_legal", case.also_legal)):
            for at, variant in enumerate(variants):
                problem = _problem(case, variant)
                if problem:
                    raise DocumentError(path, lines.get(f"$[{number}].{kind}[{at}]"), f"{case.name}: {problem}")
    return cases


def changed(case: Case, variant: Variant) -> str:
    """The model of ``variant``."""
    text = case.legal
    for old, new in _swaps(variant):
        text = text.replace(old, new)
    return text


def _swaps(variant: Variant) -> tuple[tuple[str, str], ...]:
    return (*((variant.swap,) if variant.swap is not None else ()), *variant.swaps)


def _problem(case: Case, variant: Variant) -> str:
    """What keeps ``variant`` from being one; nothing if it is fine."""
    text = case.legal
    if not _swaps(variant):
        return "a variant needs 'swap' or 'swaps'"
    for old, new in _swaps(variant):
        if text.count(old) != 1:
            return f"'{old}' is there {text.count(old)} times; name more of what is around it"
        text = text.replace(old, new)
    return "" if text != case.legal else "nothing is changed"
