"""Mutants and conformant variants of the reference tool chain, by name.

A derived tool chain is a function of the reference program. The mutants that leave out one rule are made here, one for each
rule; all others are registered by the modules of the folders ``models``, ``mappings`` and ``variants``, many of them from tables.
"""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from importlib import import_module
from pathlib import Path
from typing import Any

from ucm_cts.adapters.contract.metamodel.names import Scope
from ucm_cts.adapters.reference.toolchain.checking import Complaint, Rule
from ucm_cts.adapters.reference.toolchain.program import Program, reference

Derive = Callable[[Program], Program]

Holds = Callable[[Any, Any, Scope, str], bool]
"""Whether a complaint counts; its arguments are the wrong element, the checked element, its scope and the message."""


@dataclass(frozen=True)
class Mutant:
    """A tool chain with one defect.

    ``name``: its name; the names of mutants differ.
    ``breaks``: the requirements that the defect breaks.
    ``task``: the task that shows it.
    ``derive``: makes it from the reference tool chain.
    ``also``: requirements that the same defect may break besides.
    ``declares``: the readings (``option=value``) that it claims.
    ``claims``: the parts of 10.2 to 10.5 that it claims.
    """

    name: str
    breaks: tuple[str, ...]
    task: str
    derive: Derive
    also: tuple[str, ...] = ()
    declares: tuple[str, ...] = ()
    claims: tuple[str, ...] = ()


@dataclass(frozen=True)
class Variant:
    """A conformant tool chain that uses a freedom of the text; its fields are those of ``Mutant``."""

    name: str
    task: str
    derive: Derive
    declares: tuple[str, ...] = ()
    claims: tuple[str, ...] = ()


MUTANTS: dict[str, Mutant] = {}
VARIANTS: dict[str, Variant] = {}


def breaks(
    *requirements: str,
    task: str = "check",
    also: tuple[str, ...] = (),
    declares: tuple[str, ...] = (),
    claims: tuple[str, ...] = (),
) -> Callable[[Derive], Derive]:
    """Register a function as a mutant that breaks ``requirements``; its docstring says what it does wrong."""

    def register(derive: Derive) -> Derive:
        name = derive.__name__
        assert name not in MUTANTS, f"two mutants are called {name}"
        MUTANTS[name] = Mutant(name, requirements, task, derive, also, declares, claims)
        return derive

    return register


def variant(
    *, task: str = "check", declares: tuple[str, ...] = (), claims: tuple[str, ...] = ()
) -> Callable[[Derive], Derive]:
    """Register a function as a conformant variant; its docstring says which freedom it uses."""

    def register(derive: Derive) -> Derive:
        name = derive.__name__
        assert name not in VARIANTS, f"two variants are called {name}"
        VARIANTS[name] = Variant(name, task, derive, declares, claims)
        return derive

    return register


def named(derive: Derive, name: str, says: str | None = None) -> Derive:
    """``derive`` with the name ``name`` and the docstring ``says``."""
    derive.__name__, derive.__doc__ = name, says
    return derive


def replacing_rule(program: Program, name: str, complaints: Callable[..., object] | None) -> Program:
    """``program`` with another function for the rule ``name``, or without it if ``complaints`` is None."""
    assert name in program.rules, f"there is no rule {name}"
    rules = {n: r for n, r in program.rules.items() if n != name}
    if complaints is not None:
        known = program.rules[name]
        rules[name] = replace(known, complaints=complaints, judged_by=None)  # type: ignore[arg-type] # mutants need not be exact
    return replace(program, rules=rules)


def complaining_where(program: Program, name: str, holds: Holds) -> Program:
    """``program``, in which the complaints of rule ``name`` count only where ``holds``."""
    assert name in program.rules, f"there is no rule {name}"
    complaints = program.rules[name].complaints

    def half(element: Any, scope: Scope) -> Iterator[Complaint]:
        for wrong, message in complaints(element, scope):
            if holds(wrong, element, scope, message):
                yield wrong, message

    return replacing_rule(program, name, half)


@functools.cache
def _load() -> None:
    for path in sorted(Path(__file__).parent.glob("*/[!_]*.py")):
        import_module(f"ucm_cts.adapters.mutants.toolchain.{path.parent.name}.{path.stem}")


@functools.cache
def mutants() -> Mapping[str, Mutant]:
    """All of them."""
    _load()
    without = (_without(one) for one in reference().rules.values())
    return {mutant.name: mutant for mutant in without} | MUTANTS


def variants() -> Mapping[str, Variant]:
    """All of them."""
    _load()
    return VARIANTS


def derived(name: str) -> Program:
    """The mutant or variant ``name``. Raises ``KeyError`` if there is none."""
    known: Mapping[str, Mutant | Variant] = {**mutants(), **variants()}
    return known[name].derive(reference())


def _without(one: Rule) -> Mutant:
    def derive(program: Program) -> Program:
        return replacing_rule(program, one.name, None)

    declares = (one.under,) if one.under else ()
    return Mutant(f"without_{one.name}", (one.requirement,), "check", derive, one.also, declares)
