"""Object timers (10.3.1) of the C++ reference framework: how it reads what the text leaves open."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import pytest
from cpp_builds import Builds
from cpp_timers import EXECUTIONS, TELL, check_times, ended, first, replies, traced, while_called

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract import trace as t
from ucm_cts.adapters.contract.data_types import Datum

pytestmark = pytest.mark.native

TIMERS = "timer.timer_scheduler"
POLICY = s.Policy(s.OBJECT_TIMERS, element=TIMERS)
MICROSECONDS = 1_000_000


def milliseconds(number: int) -> list[Datum]:
    return [*divmod(number * 1000, MICROSECONDS)]


def once(delay: int, handler: str = "h", given: int | None = None) -> s.CallMethod:
    return s.CallMethod(TIMERS, s.SCHEDULE_ONCE, (milliseconds(delay),), handler=handler, given=given)


def repeated(delay: int, interval: int, rounds: int, handler: str = "h") -> s.CallMethod:
    times = (milliseconds(delay), milliseconds(interval))
    return s.CallMethod(TIMERS, s.SCHEDULE_REPEATED, (*times, rounds), handler=handler)


def call(method: str, of: str = s.ON_TRIGGER, nth: int = 0, given: int | None = None) -> s.CallMethod:
    """By default, of the timer that triggers."""
    return s.CallMethod(TIMERS, method, on=s.TimerFrom(of, nth), given=given)


def timed(
    *exchange: s.Action,
    trigger: tuple[s.Action, ...] = (),
    startup: tuple[s.Action, ...] = (),
    shutdown: tuple[s.Action, ...] = (),
    policies: tuple[s.Policy, ...] = (),
) -> s.Declaration:
    plan: dict[s.Hook, tuple[s.Action, ...]] = {
        "exchange": exchange,
        "method": trigger,
        "on_startup": startup,
        "on_shutdown": shutdown,
    }
    return s.Declaration(("in",), plan=plan, policies=(*policies, POLICY), handlers=("h", "k"))


def triggers(trace: Sequence[t.Event], handler: str = "h") -> list[t.Enter]:
    return [e for e in trace if isinstance(e, t.Enter) and e.port == handler]


def rounds(trace: Sequence[t.Event], handler: str = "h") -> list[Any]:
    return [(e.arguments or ())[1] for e in triggers(trace, handler)]


def answers(trace: Sequence[t.Event], method: str) -> list[tuple[int | None, Any]]:
    """What ``method`` of timers gave: the timer's number, and the result, or none."""
    asked = [e for e in trace if isinstance(e, t.Request) and e.method == method]
    back = [next(r for r in trace if isinstance(r, t.Reply) and r.thread == e.thread and r.n > e.n) for e in asked]
    return [(e.timer, *(r.results or (None,))) for e, r in zip(asked, back, strict=True)]


def test_triggers_come_in_time_and_tell_timer_time_and_round(builds: Builds) -> None:
    ask = tuple(call(s.TIMER_ID, *timer, given=2) for timer in ((s.SCHEDULE_ONCE, 1), (s.SCHEDULE_ONCE, 2)))
    repeating = call(s.TIMER_ID, s.SCHEDULE_REPEATED, 1, given=2)
    orders = (once(250, given=1), once(0, given=1), *ask, repeating)
    component = timed(*orders, startup=(repeated(100, 200, 3, "k"),), trigger=(call(s.TIMER_ID), call(s.TIMER_ROUNDS)))
    trace = traced(builds, component, TELL, s.Pause(900), s.Invoke("tell", 2), s.Stop())
    check_times(triggers(trace), first(trace, s.SCHEDULE_ONCE).t, [0, 0.25])
    check_times(triggers(trace, "k"), first(trace, s.SCHEDULE_REPEATED).t, [0.1, 0.3, 0.5])
    assert (rounds(trace), rounds(trace, "k")) == ([1, 1], [1, 2, 3])
    assert {e.thread for e in triggers(trace) + triggers(trace, "k")} == {1}, "one thread makes all of them"

    ids = dict(answers(trace, s.TIMER_ID))
    assert len({ids[number] for number in (1, 2, 3)}) == 3
    for entered, given in zip(triggers(trace) + triggers(trace, "k"), (3, 2, 1, 1, 1), strict=True):
        assert entered.timer is not None
        assert ids[entered.timer] == ids[given]
        assert dict(answers(trace, s.TIMER_ROUNDS))[entered.timer] == rounds([entered], entered.port or "")[0]


def test_triggers_tell_the_time_since_their_timer_was_asked_for(builds: Builds) -> None:
    trace = traced(builds, timed(repeated(50, 150, 3)), TELL, s.Pause(700), s.Stop())
    begin = first(trace, s.SCHEDULE_REPEATED).t
    told: list[Any] = [(e.arguments or ())[0] for e in triggers(trace)]
    for entered, (seconds, micros), due in zip(triggers(trace), told, (0.05, 0.2, 0.35), strict=True):
        assert 0 <= micros < MICROSECONDS
        assert due <= seconds + micros / MICROSECONDS <= (entered.t - begin) / 1e9


def test_a_timer_that_is_cancelled_triggers_no_more(builds: Builds) -> None:
    def ask(given: int) -> tuple[s.Action, ...]:
        return tuple(call(s.IS_CANCELLED, s.SCHEDULE_ONCE, nth, given) for nth in (1, 2))

    two = (once(250, given=1), once(250, "k", given=1))
    orders = (*two, *ask(1), call(s.CANCEL, s.SCHEDULE_ONCE, 1, given=1), *ask(1))
    trace = traced(builds, timed(*orders, *ask(2)), TELL, s.Pause(600), s.Invoke("tell", 2), s.Stop())
    assert (rounds(trace), rounds(trace, "k")) == ([], [1])
    told = answers(trace, s.IS_CANCELLED)
    assert [one for one in told if one[0] == 1] == [(1, False), (1, True), (1, True)]
    assert [one for one in told if one[0] == 2] == [(2, False), (2, False), (2, True)], "it waits no longer"


def test_a_trigger_may_cancel_its_timer_and_make_others(builds: Builds) -> None:
    in_trigger = (call(s.CANCEL), call(s.IS_CANCELLED), call(s.IS_CANCELLED, s.SCHEDULE_REPEATED, 1), once(10**6))
    component = timed(repeated(100, 100, 5), startup=(once(300, "k"),), trigger=in_trigger)
    trace = traced(builds, component, TELL, s.Pause(700), s.Stop())
    assert (rounds(trace), rounds(trace, "k")) == ([1], [1])
    assert [told for _, told in answers(trace, s.CANCEL)] == [None, None]
    assert [told for _, told in answers(trace, s.IS_CANCELLED)] == [True] * 4


def test_no_rounds_are_none_and_other_values_are_refused(builds: Builds) -> None:
    def scheduled(method: str, *arguments: Datum) -> s.CallMethod:
        return s.CallMethod(TIMERS, method, arguments, handler="h")

    refused = (
        repeated(0, 0, 3),
        repeated(0, 100, 2**32),
        repeated(0, 100, -1),
        scheduled(s.SCHEDULE_ONCE, [0, MICROSECONDS]),
        scheduled(s.SCHEDULE_ONCE, [0, -1]),
        scheduled(s.SCHEDULE_ONCE, [-1, 0]),
        scheduled(s.SCHEDULE_ONCE, 1),
        scheduled(s.SCHEDULE_ONCE),
        scheduled(s.ON_TRIGGER, [0, 0]),
        s.CallMethod(TIMERS, s.SCHEDULE_ONCE, ([0, 0],)),
    )
    never = (scheduled(s.SCHEDULE_ONCE, [2**32 - 1, MICROSECONDS - 1]), call(s.IS_CANCELLED, s.SCHEDULE_ONCE, 1))
    none = (repeated(0, 100, 0), *(call(m, s.SCHEDULE_REPEATED, 1) for m in (s.IS_CANCELLED, s.TIMER_ROUNDS)))
    trace = traced(builds, timed(*refused, *never, *none), TELL, s.Pause(200), s.Stop())
    raised = [e.raised for e in trace if isinstance(e, t.Reply)]
    assert raised == [True] * len(refused) + [False] * len((*never, *none))
    assert answers(trace, s.IS_CANCELLED) == [(1, False), (2, True)]
    assert answers(trace, s.TIMER_ROUNDS) == [(2, 0)]
    assert not triggers(trace)


def test_missed_rounds_are_merged_and_the_grid_goes_on(builds: Builds) -> None:
    held = timed(repeated(100, 200, 4), trigger=(s.HoldAtGate("g"),))
    trace = traced(builds, held, TELL, s.ReachGate("g"), s.Pause(500), s.OpenGate("g"), s.Pause(900), s.Stop())
    assert rounds(trace) == [1, 2, 3, 4]
    check_times(triggers(trace), first(trace, s.SCHEDULE_REPEATED).t, [0.1, 0.6, 0.7, 0.9])


def test_timers_live_from_start_to_stop(builds: Builds) -> None:
    methods = (s.CANCEL, s.IS_CANCELLED, s.TIMER_ROUNDS, s.TIMER_ID)
    old = tuple(call(method, s.SCHEDULE_ONCE, 1, given=2) for method in methods)
    component = timed(
        *old,
        call(s.TIMER_ID, s.SCHEDULE_ONCE, 2, given=2),
        startup=(once(700), repeated(0, 50, 2, "k")),
        shutdown=(once(0),),
    )
    phase = (s.Pause(300), s.Stop(), s.Pause(600))
    trace = traced(builds, component, *phase, s.Start(), s.Invoke("tell", 2), *phase, s.RemoveComponent("A"))
    assert (rounds(trace), rounds(trace, "k")) == ([], [1, 2, 1, 2])
    operational = ["on_startup", "method", "method", "on_shutdown"]
    hooks = [e.hook for e in trace if isinstance(e, t.Exit) and e.hook != "exchange"]
    assert hooks == ["on_init", *operational, *operational, "on_remove"]
    assert sum(e.raised for e in trace if isinstance(e, t.Reply)) == 2, "on_shutdown is too late"
    assert answers(trace, s.CANCEL) == [(1, None)]
    assert answers(trace, s.IS_CANCELLED) == [(1, True)]
    assert answers(trace, s.TIMER_ROUNDS) == [(1, 0)]
    (_, before), (_, after) = answers(trace, s.TIMER_ID)
    assert before != after, "identifiers are never given again"


def test_exceptions_of_triggers_are_dropped(builds: Builds) -> None:
    trace = traced(builds, timed(repeated(0, 50, 3), trigger=(s.RaiseError(),)), TELL, s.Pause(400), s.Stop())
    assert rounds(trace) == [1, 2, 3]


@pytest.mark.parametrize("execution", EXECUTIONS.values(), ids=EXECUTIONS)
@pytest.mark.parametrize("options", ["", "executor=component", "executor=shared"])
def test_a_protected_component_is_not_entered_meanwhile(
    builds: Builds, execution: tuple[s.Policy, ...], options: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("UCM_CTS_LWUCM_OPTIONS", options)
    component = timed(once(0), s.HoldAtGate("g"), policies=execution)
    trace, left = while_called(builds, component)
    (entered,) = triggers(trace)
    assert left.n < entered.n


def test_a_cancel_from_inside_a_protected_component_leaves_no_trigger(builds: Builds) -> None:
    cancels = (once(0), s.HoldAtGate("g"), call(s.CANCEL, s.SCHEDULE_ONCE, 1))
    component = timed(*cancels, policies=EXECUTIONS["passive"])
    trace, _ = while_called(builds, component)
    assert not triggers(trace)


@pytest.mark.parametrize("end", [s.Stop(thread="z"), s.Destroy(thread="z")], ids=["stop", "destroy"])
def test_the_end_waits_for_a_trigger(builds: Builds, end: s.Step) -> None:
    component = timed(once(0), once(0), trigger=(s.HoldAtGate("g"),))
    trace = ended(builds, component, end)
    assert rounds(trace) == [1]


def test_a_component_has_both_kinds_of_timers(builds: Builds) -> None:
    by_number = [
        s.CallMethod("timer.timer_service", s.START_SPORADIC, (number, [0, s.RELATIVE_TIME])) for number in (1, 2)
    ]
    policy = s.Policy(s.INDEX_TIMERS, element="timer.timer_service")
    component = timed(once(200), *by_number, call(s.CANCEL, s.SCHEDULE_ONCE, 1), once(200), policies=(policy,))
    trace = traced(builds, component, TELL, s.Pause(500), s.Stop())
    assert rounds(trace) == [1]
    assert rounds(trace, s.TIMER_CALLBACK) == [1, 2], "numbers"
    assert replies(trace, "timer.timer_service") == [(), ()]
