"""The systematic suites as test purposes: every transition of small machines, with a guarantee (docs/systematic.md)."""

from __future__ import annotations

import functools
from collections.abc import Iterator, Mapping

from ucm_cts.harness.catalogue.requirements import load_life_cycle
from ucm_cts.harness.purposes.scripts import TestPurpose
from ucm_cts.harness.purposes.systematic.derivation import derive
from ucm_cts.harness.purposes.systematic.identification import reduced
from ucm_cts.harness.purposes.systematic.machine import Machine
from ucm_cts.harness.purposes.systematic.settings import NAMES, Setting, relays, setting
from ucm_cts.harness.purposes.systematic.suites import Suite, hsi, tour
from ucm_cts.harness.purposes.systematic.wording import scenario_of

CLAUSE = "11.2.3"

MOST_EXTRA = 2
"""The greatest number of extra states that a run can ask for."""

_REQUIREMENTS = ("R-11.2.3-01",)


def systematic_purposes(readings: Mapping[str, str], extra: int = 0) -> tuple[TestPurpose, ...]:
    """For each setting an HSI suite for ``extra`` extra states, derived for a vendor who declares ``readings``; with extra
    states also a tour of three components connected to each other.
    """
    declared = {outcome.reading.partition("=")[0] for row in load_life_cycle().rows for outcome in row.outcomes}
    return _purposes(tuple(sorted((o, value) for o, value in readings.items() if o in declared)), extra)


@functools.cache
def _purposes(readings: tuple[tuple[str, str], ...], extra: int) -> tuple[TestPurpose, ...]:
    return tuple(_all(dict(readings), extra))


def _all(readings: Mapping[str, str], extra: int) -> Iterator[TestPurpose]:
    for known in map(setting, NAMES):
        machine = reduced(derive(load_life_cycle(), known, readings))
        text = f"Every transition of {known.text}, and every state identified, with {extra} extra states (HSI)."
        yield _purpose(known, machine, hsi(machine, extra), text)
    if extra:
        three = relays(3)
        machine = derive(load_life_cycle(), three, readings)
        yield _purpose(three, machine, tour(machine), f"Every transition of {three.text} (a tour).")


def _purpose(of: Setting, machine: Machine, suite: Suite, text: str) -> TestPurpose:
    name = f"systematic/{of.name}"
    scenarios = ((f"{name}/{n}", scenario_of(of, machine, word)) for n, word in enumerate(suite, 1))
    return TestPurpose(name, CLAUSE, text, _REQUIREMENTS, tuple(scenarios))
