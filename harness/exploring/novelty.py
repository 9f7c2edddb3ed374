"""Novelty: selects the scenario with the rarest transitions, and finds traces that show something new."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from itertools import pairwise

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.adapters.contract.trace import Call, Event, Raise, Return, Trace
from ucm_cts.harness.exploring.predicted_coverage import Transition, transitions
from ucm_cts.reference_models.model.life_cycle import LifeCycleTable
from ucm_cts.reference_models.model.row_selection import RowSelection

Kind = tuple[str, ...]
"""The features of an event: its type, the operation or hook, how it ended."""


class Guide:
    """Prefers scenarios with transitions that few before them took."""

    def __init__(self, table: LifeCycleTable) -> None:
        self._rows = RowSelection(table)
        self._taken: Counter[Transition] = Counter()

    @property
    def transitions(self) -> int:
        """How many transitions have been chosen so far."""
        return len(self._taken)

    def choose(self, candidates: Sequence[Scenario]) -> Scenario:
        """The one with the most new transitions for its length; they count as taken from now on."""
        foreseen = [transitions(self._rows, candidate) for candidate in candidates]
        worth = [self._worth(f, c) for f, c in zip(foreseen, candidates, strict=True)]
        best = worth.index(max(worth))
        self._taken.update(foreseen[best])
        return candidates[best]

    def _worth(self, foreseen: frozenset[Transition], scenario: Scenario) -> float:
        return sum(1 / (1 + self._taken[one]) for one in foreseen) / math.sqrt(5 + len(scenario.steps))


class Events:
    """Which kinds of events have been seen to follow each other."""

    def __init__(self) -> None:
        self._seen: set[tuple[Kind, Kind]] = set()

    def __len__(self) -> int:
        return len(self._seen)

    def are_new(self, scenario: Scenario, trace: Trace) -> bool:
        """Does ``trace`` of ``scenario`` show two events in an order not seen before? From now on they are known."""
        pairs = set(pairwise(_kind(scenario, event) for event in trace)) - self._seen
        self._seen |= pairs
        return bool(pairs)


def _kind(scenario: Scenario, event: Event) -> Kind:
    features = [type(event).__name__]
    if isinstance(event, Call | Return | Raise):
        features.append(s.operation(scenario.steps[event.step]))
    features += [str(getattr(event, field, "")) for field in ("hook", "error", "raised", "exception")]
    return tuple(features)
