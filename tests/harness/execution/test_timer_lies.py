"""Traces of object timers (10.3.1): each small edit that no truthful host can produce is a contradiction."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import msgspec
import pytest
import scheduling
from performing import answer
from scheduling import FIRST, SECOND, SchedulingAdapter, on_timer, repeated, scheduled

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract import trace as t
from ucm_cts.adapters.contract.messages import Traced
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter
from ucm_cts.harness.execution.disguise import Disguise
from ucm_cts.harness.execution.integrity import contradiction

SCENARIO = scheduling.started(
    scheduling.component(
        {
            "on_startup": (
                on_timer(s.CANCEL, s.SCHEDULE_ONCE, 1),
                scheduled(scheduling.TRIGGERS, SECOND),
                on_timer(s.CANCEL, s.SCHEDULE_ONCE, 1),
                repeated(scheduling.PLAIN, 0),
                scheduled(scheduling.FAILS),
            ),
            "method": (on_timer(s.TIMER_ID, s.ON_TRIGGER),),
        }
    )
)

Events = list[Any]
Edit = Callable[[Events], object]


def traced(asked: s.Scenario) -> Events:
    reply = answer(asked, SchedulingAdapter)
    assert isinstance(reply, Traced), reply
    return list(reply.events)


TRUTH = traced(SCENARIO)
ENTRY = next(n for n, event in enumerate(TRUTH) if isinstance(event, t.Enter) and event.timer)
EXIT = next(n for n, event in enumerate(TRUTH) if isinstance(event, t.Exit))
ID, ONCE, CANCEL, REPEATED, FAILING = (
    next(n for n, event in enumerate(TRUTH) if isinstance(event, t.Request) and n > after and event.method == method)
    for after, method in (
        (0, s.TIMER_ID),
        (0, s.SCHEDULE_ONCE),
        (0, s.CANCEL),
        (0, s.SCHEDULE_REPEATED),
        (ENTRY, s.SCHEDULE_ONCE),
    )
)
"""Where things are in the trace. But for ``ONCE`` a reply follows each request."""
GIVEN = CANCEL - 1


def change(index: int, **new: object) -> Edit:
    """An edit: that event says something else."""

    def edit(events: Events) -> None:
        events[index] = msgspec.structs.replace(events[index], **new)

    return edit


def drop(index: int) -> Edit:
    """An edit: that call did not happen."""

    def edit(events: Events) -> None:
        del events[index : index + 2]

    return edit


def again(index: int, to: int) -> Edit:
    """An edit: that call happened there, too."""

    def edit(events: Events) -> None:
        events[to:to] = events[index : index + 2]

    return edit


def renumbered(events: Events) -> Events:
    return [msgspec.structs.replace(e, n=n, t=n) for n, e in enumerate(events, 1)]


ACTED = "did not act in"
LIES: dict[str, tuple[Edit, str]] = {
    "a call of a timer that never came": (change(CANCEL, timer=9), "a request on timer 9 of 2"),
    "a call of timer 0": (change(CANCEL, timer=0), "a request on timer 0 of 2"),
    "a call of a timer that comes later": (change(CANCEL, timer=3), "a request on timer 3 of 2"),
    "a call of another timer": (change(CANCEL, timer=1), ACTED),
    "a call of no timer": (change(CANCEL, timer=None), ACTED),
    "another call of the timer": (change(CANCEL, method=s.IS_CANCELLED), ACTED),
    "a call of another timer in the handler": (again(CANCEL, ID), "a request on timer 2 of 1"),
    "a call that was left out": (drop(CANCEL), ACTED),
    "a call in the handler that was left out": (drop(ID), ACTED),
    "a call made twice": (again(CANCEL, CANCEL), ACTED),
    "a call before its timer came": (again(CANCEL, ONCE), "a request on timer 2 of 0"),
    "a number that is skipped at a handler": (change(ENTRY, timer=2), "timer 2 came after 0"),
    "a number that is skipped at a scheduler": (change(GIVEN, timer=3), "timer 3 came after 1"),
    "a number that came before": (change(GIVEN, timer=1), "timer 1 came after 1"),
    "another handler than planned": (change(ONCE, handler=FIRST), ACTED),
    "a handler that is not there": (change(ONCE, handler="third"), "a request with handler 'third'"),
    "no handler": (change(REPEATED, handler=None), "timer 3 comes back from schedule_repeated_trigger"),
    "a handler with a call of a timer": (change(CANCEL, handler=FIRST), ""),
    "an entry at no handler": (change(ENTRY, port="third"), "on_trigger with timer 1"),
    "an entry at another method": (change(ENTRY, method=s.ON_TIMEOUT), "on_timeout with timer 1"),
    "an entry without a timer": (change(ENTRY, timer=None), "on_trigger with timer None"),
    "an entry with a timer and something else": (
        change(ENTRY, wrong="nothing as the timer"),
        "on_trigger with timer 1",
    ),
    "an entry without arguments": (change(ENTRY, arguments=None), "method 'on_trigger' on 'second'"),
    "a timer at on_startup": (change(EXIT - 1, timer=1), ""),
    "a timer and a result": (change(GIVEN, results=(1,)), "gives (1,) for a timer"),
    "no timer from scheduler_trigger": (change(GIVEN, timer=None), "gives no timer"),
    "a timer and an exception": (change(FAILING + 1, timer=4), "timer 4 comes back from"),
    "a timer from a timer": (change(CANCEL + 1, timer=3), "timer 3 comes back from cancel"),
    "results of a handler": (change(EXIT, results=(1,)), "gave (1,)"),
}


@pytest.mark.parametrize(("edit", "problem"), LIES.values(), ids=LIES.keys())
def test_contradiction_is_found(edit: Edit, problem: str) -> None:
    events = list(TRUTH)
    edit(events)
    found = contradiction(SCENARIO, renumbered(events))
    assert found is not None
    assert problem in found


@pytest.mark.parametrize(
    "edit",
    [
        change(REPEATED + 1, timer=None),
        change(GIVEN - 1, results=()),
        change(ENTRY, port=FIRST),
        change(ENTRY, arguments=([5, 5], 77)),
    ],
    ids=["nothing from schedule_repeated_trigger", "nothing else", "the other handler", "another time"],
)
def test_what_only_a_framework_decides_is_no_contradiction(edit: Edit) -> None:
    events = list(TRUTH)
    edit(events)
    assert contradiction(SCENARIO, renumbered(events)) is None


def test_a_timer_that_came_while_the_body_acted_is_called_from_then_on() -> None:
    """The same call is in the plan before the timer came and after that."""
    call = on_timer(s.IS_CANCELLED, s.ON_TRIGGER, 1)
    timed = s.CallMethod(scheduling.SCHEDULER, s.SCHEDULE_ONCE, ([0, 1000],), handler=FIRST)
    asked = s.Scenario(
        {
            "C": scheduling.component(
                {"exchange": (call, timed, s.HoldAtGate("own"), call), "method": (s.HoldAtGate("handler"),)},
                provides=("go",),
            )
        },
        (
            s.AddComponent("C"),
            s.GetPortElement("C", "go", "go"),
            s.Start(),
            s.Invoke("go", 1, thread="w"),
            s.ReachGate("handler"),
            s.OpenGate("handler"),
            s.OpenGate("own"),
            s.Join("w"),
            s.Destroy(),
        ),
    )
    reply = answer(asked, ReferenceAdapter)
    assert isinstance(reply, Traced)
    assert contradiction(asked, reply.events) is None
    (made,) = [n for n, event in enumerate(reply.events) if isinstance(event, t.Request) and event.timer]
    twice = [*reply.events]
    again(made, made)(twice)
    assert ACTED in (contradiction(asked, renumbered(twice)) or "")


def test_disguised_bodies_have_the_same_timers() -> None:
    """Handlers are names, too."""
    disguise = Disguise(5, "{port}_{element}")
    revealed = [disguise.reveal(event) for event in traced(disguise.scenario(scheduling.ALL))]
    assert renumbered(revealed) == renumbered(traced(scheduling.ALL))
