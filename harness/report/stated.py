"""The vendor's statement as a report shows it, with what the run observed beside it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ucm_cts.harness.catalogue.requirements import load_capabilities, load_interpretations
from ucm_cts.harness.results.statement import IXIT, Statement


@dataclass(frozen=True)
class Part:
    """A part of 10.1."""

    id: str
    claimed: bool
    clause: str
    text: str


@dataclass(frozen=True)
class Option:
    """A freedom the text leaves: the value that holds, and those that were ``seen``."""

    name: str
    declared: str
    seen: tuple[str, ...]
    interpretation: str
    clauses: tuple[str, ...]


@dataclass(frozen=True)
class Measure:
    """A quantity of the IXIT and the value that holds."""

    name: str
    value: float
    unit: str
    text: str


@dataclass(frozen=True)
class Stated:
    """Everything of a statement that concerns one profile."""

    parts: tuple[Part, ...]
    options: tuple[Option, ...]
    quantities: tuple[Measure, ...]


def stated(statement: Statement, readings: Mapping[str, tuple[str, ...]], profiles: tuple[str, ...]) -> Stated:
    """What ``statement`` says as far as it concerns the ``profiles``, and the ``readings`` that were observed."""
    core = "core" in profiles
    capabilities = load_capabilities().capabilities if core else ()
    return Stated(
        tuple(Part(c.id, statement.capabilities.get(c.id, True), c.clause, c.text) for c in capabilities),
        tuple(
            Option(option, statement.readings.get(option, values[0]), readings.get(option, ()), entry.id, entry.clauses)
            for entry in load_interpretations()
            if entry.profile in profiles
            for option, values in entry.options.items()
        ),
        tuple(Measure(name, statement.ixit.get(name, q.default), q.unit, q.text) for name, q in IXIT.items())
        if core
        else (),
    )
