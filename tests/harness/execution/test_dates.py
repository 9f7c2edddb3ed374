"""A body that makes a date from its clock says in its trace what the clock gave, and keeps to it."""

from __future__ import annotations

import msgspec
import pytest
from performing import answer

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.messages import Traced
from ucm_cts.adapters.contract.trace import Event, Reply, Request
from ucm_cts.harness.execution.integrity import contradiction
from ucm_cts.harness.purposes.container_services import CLOCK
from ucm_cts.harness.purposes.derived.timer_steps import WITH_CLOCK, alone, dated, tell, timed
from ucm_cts.reference_models.model.clock_readings import LOCAL

TWICE = alone(
    timed(s.CallMethod(CLOCK, LOCAL), dated(5, 3600, 1), dated(6, 7200, 1), policies=WITH_CLOCK), tell(1), tell(2)
)
"""Two dates in one call, after a reading of the clock that is for none of them."""


@pytest.fixture(scope="module")
def trace() -> tuple[Event, ...]:
    traced = answer(TWICE)
    assert isinstance(traced, Traced)
    return tuple(traced.events)


def changed(trace: tuple[Event, ...], event: Event, **fields: object) -> tuple[Event, ...]:
    return tuple(msgspec.structs.replace(one, **fields) if one is event else one for one in trace)


def started(trace: tuple[Event, ...]) -> list[Request]:
    return [e for e in trace if isinstance(e, Request) and e.method == s.START_SPORADIC]


def test_two_dates_from_two_readings_are_as_planned(trace: tuple[Event, ...]) -> None:
    assert len(started(trace)) == 2
    assert contradiction(TWICE, trace) is None


@pytest.mark.parametrize("which", [0, 1])
def test_another_date_than_the_clock_gave_is_a_contradiction(trace: tuple[Event, ...], which: int) -> None:
    request = started(trace)[which]
    number, (seconds, flag) = request.arguments or ()  # type: ignore[misc]
    other = changed(trace, request, arguments=(number, [seconds + 1, flag]))  # type: ignore[has-type]
    assert "did not act in exchange as its plan says" in (contradiction(TWICE, other) or "")


def test_a_clock_that_gives_no_time_leads_to_no_call(trace: tuple[Event, ...]) -> None:
    """A call all the same is a contradiction."""
    request = started(trace)[0]
    reading = next(e for e in reversed(trace[: request.n - 1]) if isinstance(e, Reply))
    silent = changed(trace, reading, results=())
    assert "did not act in exchange as its plan says" in (contradiction(TWICE, silent) or "")


@pytest.mark.parametrize(
    ("time", "due"),
    [
        ([[100, 5]], [110, s.ABSOLUTE_TIME]),
        ([[2**32 - 11, 0]], [2**32 - 1, s.ABSOLUTE_TIME]),
        ([[2**32 - 10, 0]], None),
        ([[-1, 0]], None),
        ([[True, 0]], None),
        ([["100", 0]], None),
        ([[100]], None),
        ([], None),
    ],
)
def test_a_date_is_the_clocks_seconds_and_those_asked_for(time: list[list[int]], due: object) -> None:
    arguments = (5, [10, s.ABSOLUTE_TIME])
    made = s.date_from(arguments, 1, time)  # type: ignore[arg-type]
    assert made == (None if due is None else (5, due))
