"""The results of a run for each row and each transition of the life-cycle table."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, get_args

from ucm_cts.harness.results.values import TransitionResult, Verdict
from ucm_cts.reference_models.model.life_cycle import LifeCycleTable, Outcome, Row, State

STATES: tuple[State, ...] = get_args(State)

Seen = Literal["pass", "fail", "inconclusive"]

_WORST: tuple[Verdict, ...] = ("fail", "inconclusive", "pass")


@dataclass(frozen=True)
class RowSeen:
    """One row of the table with its results."""

    row: Row
    exercised: int
    violated: int
    readings: tuple[str, ...]

    @property
    def verdict(self) -> Seen:
        """``fail`` once violated, ``pass`` if exercised and never violated, else ``inconclusive``."""
        return "fail" if self.violated else "pass" if self.exercised else "inconclusive"


@dataclass(frozen=True)
class Transition:
    """All outcomes by which ``operation`` leads from ``state`` to ``next``.

    ``chosen`` is False when every row that leads here was exercised, and the framework always took another permitted
    way.
    """

    state: State
    next: State
    operation: str
    verdict: Seen
    exercised: int
    chosen: bool = True


def rows_seen(table: LifeCycleTable, results: Sequence[TransitionResult]) -> tuple[RowSeen, ...]:
    """Every row of the table, in its order."""
    known = {result.row: result for result in results}
    empty = TransitionResult("", 0, 0)
    found = ((row, known.get(row.id, empty)) for row in table.rows)
    return tuple(RowSeen(row, result.exercised, result.violated, result.readings) for row, result in found)


def transitions(rows: Sequence[RowSeen]) -> tuple[Transition, ...]:
    """The rows' outcomes grouped by state, next state and operation."""
    groups: dict[tuple[State, State, str], list[tuple[RowSeen, Outcome]]] = {}
    for seen in rows:
        for outcome in seen.row.outcomes:
            groups.setdefault((seen.row.state, outcome.next, seen.row.operation), []).append((seen, outcome))
    return tuple(_transition(*key, group) for key, group in groups.items())


@dataclass(frozen=True)
class Choice:
    """One option: the readings that the table permits, and those that were observed."""

    option: str
    permitted: tuple[str, ...]
    observed: tuple[str, ...]


def choices(rows: Sequence[RowSeen]) -> tuple[Choice, ...]:
    """The observed readings of each option, in the table's order; readings are written as ``option=reading``."""
    permitted: dict[str, dict[str, bool]] = {}
    for seen in rows:
        for outcome in seen.row.outcomes:
            option, _, reading = outcome.reading.partition("=")
            if reading:
                known = permitted.setdefault(option, {})
                known[reading] = known.get(reading, False) or outcome.reading in seen.readings
    return tuple(
        Choice(option, tuple(known), tuple(reading for reading, observed in known.items() if observed))
        for option, known in permitted.items()
    )


def worst(verdicts: Sequence[Seen]) -> Seen:
    """``fail`` before ``inconclusive`` before ``pass``."""
    return min(verdicts, key=_WORST.index)


def _transition(state: State, after: State, operation: str, group: list[tuple[RowSeen, Outcome]]) -> Transition:
    taken = [seen for seen, outcome in group if _taken(seen, outcome)]
    exercised = sum(seen.exercised for seen in {id(seen): seen for seen in taken}.values())
    if any(seen.violated for seen, _ in group):
        return Transition(state, after, operation, "fail", exercised)
    chosen = bool(taken) or not all(seen.exercised for seen, _ in group)
    return Transition(state, after, operation, "pass" if taken else "inconclusive", exercised, chosen)


def _taken(seen: RowSeen, outcome: Outcome) -> bool:
    """Whether the row was exercised and this outcome may be the one that was observed."""
    if not seen.exercised:
        return False
    return not outcome.reading or not seen.readings or outcome.reading in seen.readings
