"""The vendor's statement as a report shows it, with the observed readings."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import msgspec

from ucm_cts.harness.catalogue.requirements import Capability, Interpretation, capabilities_for, declarable
from ucm_cts.harness.report.json_report import StatementEntry
from ucm_cts.harness.results.statement import IXIT, Quantity, Statement


@dataclass(frozen=True)
class Stated:
    """Everything of a statement that concerns one profile.

    ``parts``: each part of the platform, and whether it is claimed; of parts of another profile those that are claimed.
    ``options``: each option, its value, the values that were observed, and its interpretation.
    ``quantities``: each quantity of the IXIT, its value, and its definition.
    """

    parts: list[tuple[Capability, bool]]
    options: list[tuple[str, str, tuple[str, ...], Interpretation]]
    quantities: list[tuple[str, float, Quantity]]


def stated(statement: Statement, readings: Mapping[str, tuple[str, ...]], profiles: tuple[str, ...]) -> Stated:
    """What ``statement`` says as far as it concerns the ``profiles``, and the ``readings`` that were observed."""
    claims = {c: statement.capabilities.get(c.id, c.profile == "core") for c in capabilities_for(profiles)}
    return Stated(
        [(c, claimed) for c, claimed in claims.items() if claimed or c.profile in profiles],
        [
            (option, statement.readings.get(option, values[0]), readings.get(option, ()), entry)
            for entry in _decisions(profiles)
            for option, values in entry.options.items()
        ],
        [(name, statement.ixit.get(name, quantity.default), quantity) for name, quantity in _quantities(profiles)],
    )


def of_profile(statement: StatementEntry, profiles: tuple[str, ...]) -> StatementEntry:
    """``statement`` without the parts, options and quantities that do not concern the ``profiles``."""
    parts = {c.id for c in capabilities_for(profiles)}
    options = {option for entry in _decisions(profiles) for option in entry.options}
    quantities = {name for name, _ in _quantities(profiles)}
    return msgspec.structs.replace(
        statement,
        capabilities={part: claimed for part, claimed in statement.capabilities.items() if part in parts},
        readings={option: value for option, value in statement.readings.items() if option in options},
        ixit={name: value for name, value in statement.ixit.items() if name in quantities},
    )


def _decisions(profiles: tuple[str, ...]) -> list[Interpretation]:
    return [entry for entry in declarable() if entry.profile in profiles]


def _quantities(profiles: tuple[str, ...]) -> list[tuple[str, Quantity]]:
    return list(IXIT.items()) if "core" in profiles else []
