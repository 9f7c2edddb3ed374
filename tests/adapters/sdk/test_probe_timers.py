"""Python probes with object timers (10.3.1): what comes to a body is numbered, remembered and called as its plan says."""

from __future__ import annotations

from typing import Any

import pytest
import scheduling
from performing import answer, line_of
from scheduling import FIRST, SCHEDULER, SECOND, SchedulingAdapter, on_timer, repeated, scheduled

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract import trace as t
from ucm_cts.adapters.contract.messages import Traced
from ucm_cts.adapters.sdk.python import calls
from ucm_cts.adapters.sdk.python.data import overwrite
from ucm_cts.harness.execution.integrity import contradiction


def traced(asked: s.Scenario) -> list[t.Event]:
    reply = answer(asked, SchedulingAdapter)
    assert isinstance(reply, Traced), reply
    assert contradiction(asked, reply.events) is None
    return list(reply.events)


def told(*on_startup: s.Action, method: tuple[s.Action, ...] = ()) -> list[str]:
    """What a body does and sees in on_startup, in short."""
    trace = traced(scheduling.started(scheduling.component({"on_startup": on_startup, "method": method})))
    lines = [line_of(event).replace("C1#1 ", "").replace(f"port={SCHEDULER} ", "") for event in trace]
    return lines[3:-2]


def test_the_timer_that_comes_back_is_numbered() -> None:
    assert told(scheduled(scheduling.PLAIN), repeated(scheduling.PLAIN, 0, SECOND)) == [
        "request method=scheduler_trigger arguments=[[0, 7]] handler=first",
        "reply results=[] timer=1",
        "request method=schedule_repeated_trigger arguments=[[0, 7], [1, 8], 0] handler=second",
        "reply results=[] timer=2",
    ]


def test_a_trigger_hands_over_a_timer_before_the_call_gives_it() -> None:
    lines = told(
        scheduled(scheduling.TRIGGERS, SECOND),
        on_timer(s.TIMER_ID, s.SCHEDULE_ONCE, 1),
        method=(on_timer(s.TIMER_ID, s.ON_TRIGGER), on_timer(s.TIMER_ID, s.SCHEDULE_ONCE, 1)),
    )
    assert lines[1:] == [
        "enter hook=method port=second method=on_trigger arguments=[[0, 7], 0] timer=1",
        "request method=id arguments=[] timer=1",
        "reply results=[timer 1]",
        "exit hook=method results=[]",
        "reply results=[] timer=2",
        "request method=id arguments=[] timer=2",
        "reply results=[timer 1]",
    ]


@pytest.mark.parametrize(
    ("seconds", "reply"),
    [
        (scheduling.NULL, "reply results=[] wrong=nothing as the timer"),
        (scheduling.FAILS, "reply raised=True"),
        (scheduling.DECLARED, "reply results=[why, 1] exception=refused"),
    ],
)
def test_a_scheduler_that_gives_no_timer(seconds: int, reply: str) -> None:
    assert told(scheduled(seconds), on_timer(s.CANCEL, s.SCHEDULE_ONCE, 1))[1:] == [reply]


def test_a_repeated_trigger_may_give_nothing() -> None:
    assert told(repeated(scheduling.NULL, 0))[1:] == ["reply results=[]"]


@pytest.mark.parametrize(
    ("seconds", "wrong"),
    [
        (scheduling.NULL_TIMER, "nothing as the timer"),
        (scheduling.NULL_TIME, "[None, 0] (list)"),
        (scheduling.FRACTION, "[[0.5, 7], 0] (list)"),
    ],
)
def test_what_is_handed_over_in_place_of_a_timer_or_a_time(seconds: int, wrong: str) -> None:
    """The handler has no timer then."""
    lines = told(scheduled(seconds), method=(on_timer(s.CANCEL, s.ON_TRIGGER), on_timer(s.CANCEL, s.ON_TRIGGER, 1)))
    assert lines[1:] == [
        f"enter hook=method port=first method=on_trigger arguments=[] wrong={wrong}",
        "exit hook=method results=[]",
        "reply results=[] timer=1",
    ]


def test_only_what_has_all_methods_is_a_timer() -> None:
    class Half:
        def cancel(self) -> None: ...

        rounds = id = cancel

    class Whole(Half):
        is_cancelled = Half.cancel

    class Fails(Whole):
        @property
        def cancel(self) -> Any:
            raise RuntimeError("no")

    assert [calls.is_timer(one) for one in (None, 5, Half(), Whole(), Fails())] == [False, False, False, True, False]


def test_arguments_at_handlers_are_remembered() -> None:
    """The call is made as soon as there is what it needs."""
    remembered = (s.Remembered(0, s.ON_TRIGGER, 0, 1),)
    later = s.CallMethod(SCHEDULER, s.SCHEDULE_ONCE, ([9, 9],), remembered, handler=FIRST)
    assert told(later, repeated(scheduling.PLAIN, 2), later)[-2:] == [
        "request method=scheduler_trigger arguments=[[0, 7]] handler=first",
        "reply results=[] timer=4",
    ]


def test_a_handler_gives_no_results_whatever_its_plan_answers() -> None:
    answers = (s.Answer(s.ON_TRIGGER), s.Answer(s.ON_TRIGGER, (1,), "problem"))
    assert told(scheduled(scheduling.TRIGGERS), method=answers)[2] == "exit hook=method results=[]"


def test_a_handler_fails_as_planned() -> None:
    lines = told(scheduled(scheduling.TRIGGERS), method=(s.RaiseError(),))
    assert lines[2:] == ["exit hook=method raised=True", "reply raised=True"]


def test_a_handler_that_was_not_declared_is_none() -> None:
    """The scheduler is called all the same; the scenario is at fault."""
    asked = scheduling.started(
        scheduling.component({"on_startup": (scheduled(scheduling.TRIGGERS, "third"), scheduled(scheduling.PLAIN))})
    )
    reply = answer(asked, SchedulingAdapter)
    assert isinstance(reply, Traced)
    replies = [event for event in reply.events if isinstance(event, t.Reply)]
    assert [(event.raised, event.timer) for event in replies] == [(True, None), (False, 1)]
    assert "a request with handler 'third'" in (contradiction(asked, reply.events) or "")


def test_timers_are_numbered_in_the_order_of_the_trace() -> None:
    """Four threads trigger at the same time."""
    for _ in range(3):
        trace = traced(scheduling.CROWDED)
        assert [event.timer for event in trace if isinstance(event, t.Enter) and event.timer] == [*range(1, 81)]


def test_all_of_it_is_as_planned() -> None:
    trace = traced(scheduling.ALL)
    numbers = [event.timer for event in trace if isinstance(event, t.Enter | t.Reply) and event.timer is not None]
    assert numbers == [*range(1, 17), 1, 2], "each body has numbers of its own"


def test_parts_of_buffers_that_cannot_be_changed_stay() -> None:
    values: list[Any] = [(1, 2), [3, (4,)], "x"]
    overwrite(values)
    assert values == [(1, 2), [0, (4,), 0], "x?"]
