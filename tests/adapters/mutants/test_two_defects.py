"""A framework with two defects fails what one of them breaks; whatever else fails stands under its cause."""

from __future__ import annotations

import random
from collections.abc import Iterator

import pytest
from performing import answer
from pipeline import TakesTooLong, bounded

from ucm_cts.adapters.contract.messages import Traced
from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.adapters.mutants.python.registry import bind
from ucm_cts.adapters.mutants.python.subjects import CONTAINER, Mutant, mutants_of
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter
from ucm_cts.harness.catalogue.requirements import load_life_cycle
from ucm_cts.harness.execution.integrity import contradiction
from ucm_cts.harness.execution.leftovers import FREED
from ucm_cts.harness.purposes.payloads import Payloads
from ucm_cts.harness.purposes.selection import load_purposes
from ucm_cts.reference_models.findings import Finding
from ucm_cts.reference_models.monitor import Monitor

pytestmark = pytest.mark.slow

SEED = 15
PAIRS = 8
EACH = 5
"""Of the scenarios one of so many is run."""

Pair = tuple[Mutant, Mutant]


def both(pair: Pair) -> type[ReferenceAdapter] | None:
    """A framework with the defects of a ``pair``; none if they exclude each other."""
    name = " and ".join(mutant.name for mutant in pair)
    parts = [mutant.adapter.manager_class.__mro__[1] for mutant in pair]
    try:
        return bind(name, type(name, tuple(parts), {}))
    except TypeError:  # their classes have no common order
        return None


def drawn() -> Iterator[Pair]:
    """Pairs that can be one framework, drawn by chance."""
    known = [m for m in mutants_of(CONTAINER).values() if not m.readings and FREED not in m.requirements]
    chance = random.Random(SEED)
    while True:
        one, other = chance.sample(known, 2)
        if both((one, other)) is not None:
            yield one, other


def findings(adapter: type[ReferenceAdapter], asked: Scenario) -> list[Finding]:
    """What is wrong with it in one scenario; nothing if that is an incident."""
    with bounded(asked):
        reply = answer(asked, adapter)
    if not isinstance(reply, Traced) or contradiction(asked, reply.events, reply.stuck) is not None:
        return []
    return list(Monitor(load_life_cycle()).judge(asked, reply.events).findings)


def scenarios() -> Iterator[tuple[str, Scenario]]:
    """Some of the container profile's, of each kind."""
    written = [case for p in load_purposes("container") if not p.of_dimensions for case in p.scenarios]
    payloads = Payloads(SEED)
    return ((name, payloads.deal(plain)) for name, plain in written[::EACH])


PAIRED = [pair for pair, _ in zip(drawn(), range(PAIRS), strict=False)]


@pytest.mark.parametrize("pair", PAIRED, ids=lambda pair: "-".join(mutant.name for mutant in pair))
def test_each_failure_belongs_to_a_defect_or_stands_under_its_cause(pair: Pair) -> None:
    adapter = both(pair)
    assert adapter is not None
    declared = {requirement for mutant in pair for requirement in (*mutant.requirements, *mutant.also)}
    spills: dict[str, str] = {}
    for name, asked in scenarios():
        try:
            for finding in findings(adapter, asked):
                if not declared.isdisjoint((finding.requirement, finding.caused_by)):
                    continue
                alone = {one.requirement for mutant in pair for one in findings(mutant.adapter, asked)}
                if alone.isdisjoint((finding.requirement, finding.caused_by)):
                    spills.setdefault(finding.requirement, f"{name}: {finding}")
        except TakesTooLong:
            break
    assert spills == {}
