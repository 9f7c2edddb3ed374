"""Index timers (10.3.2) of the C++ reference framework: how it reads what the text leaves open."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import pytest
from cpp_builds import Builds, events
from cpp_timers import EXECUTIONS, TELL, check_times, ended, first, replies, traced, while_called

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract import trace as t
from ucm_cts.adapters.contract.data_types import Datum

pytestmark = pytest.mark.native

TIMERS, CLOCK = "timer.timer_service", "clock.clock_api"
POLICIES = (s.Policy(s.INDEX_TIMERS, element=TIMERS), s.Policy(s.CLOCK, element=CLOCK))


def relative(seconds: int) -> list[Datum]:
    return [seconds, s.RELATIVE_TIME]


def sporadic(number: int, time: list[Datum], given: int | None = None, dated: bool = False) -> s.CallMethod:
    clock = s.FromClock(1, CLOCK, "get_local_time") if dated else None
    return s.CallMethod(TIMERS, s.START_SPORADIC, (number, time), given=given, from_clock=clock)


def periodic(number: int, delay: int, rate: list[Datum], given: int | None = None) -> s.CallMethod:
    return s.CallMethod(TIMERS, s.START_PERIODIC, (number, relative(delay), rate), given=given)


def cancel(number: int, given: int | None = None) -> s.CallMethod:
    return s.CallMethod(TIMERS, s.CANCEL_TIMER, (number,), given=given)


def ask(number: int, given: int | None = None) -> s.CallMethod:
    return s.CallMethod(TIMERS, s.IS_CANCELED, (number,), given=given)


def timed(
    *exchange: s.Action,
    callback: tuple[s.Action, ...] = (),
    startup: tuple[s.Action, ...] = (),
    shutdown: tuple[s.Action, ...] = (),
    execution: tuple[s.Policy, ...] = (),
) -> s.Declaration:
    plan: dict[s.Hook, tuple[s.Action, ...]] = {
        "exchange": exchange,
        "method": callback,
        "on_startup": startup,
        "on_shutdown": shutdown,
    }
    return s.Declaration(("in",), plan=plan, policies=(*execution, *POLICIES))


def callbacks(trace: Sequence[t.Event]) -> list[t.Enter]:
    return [e for e in trace if isinstance(e, t.Enter) and e.port == s.TIMER_CALLBACK]


def numbers(trace: Sequence[t.Event]) -> list[Any]:
    return [(e.arguments or ())[1] for e in callbacks(trace)]


def dates(trace: Sequence[t.Event]) -> list[int]:
    """What the callbacks told, which are dates."""
    told: list[Any] = [(e.arguments or ())[0] for e in callbacks(trace)]
    assert {flag for _, flag in told} <= {s.ABSOLUTE_TIME}
    return [seconds for seconds, _ in told]


def of_number(trace: Sequence[t.Event], number: int) -> list[t.Enter]:
    return [e for e, n in zip(callbacks(trace), numbers(trace), strict=True) if n == number]


def test_callbacks_come_in_time_and_tell_the_date_when_they_were_due(builds: Builds) -> None:
    orders = (
        sporadic(5, relative(1)),
        sporadic(2**32 - 1, [2, s.ABSOLUTE_TIME], dated=True),
        periodic(300, 1, [1, "ABSOLUTE_TIME"]),
    )
    read = s.CallMethod(CLOCK, "get_local_time")
    trace = traced(builds, timed(*orders, callback=(read,)), TELL, s.Pause(2600), s.Stop(), s.Pause(1100))
    begin = first(trace, s.START_SPORADIC)
    ((asked, micros),), *shown = replies(trace, CLOCK)
    dated = 2 - micros / 1e6 - 0.001  # the clock was read when the first call was over
    for number, due in {5: [1], 300: [1, 2], 2**32 - 1: [dated]}.items():
        check_times(of_number(trace, number), begin.t, due)
    for told, ((now, _),) in zip(dates(trace), shown, strict=True):
        assert told <= now <= told + 1
    assert asked + 2 in dates(trace)
    assert {e.thread for e in callbacks(trace)} == {1}, "one thread calls all of them back"


def test_a_number_that_waits_stays_and_one_that_does_not_is_canceled(builds: Builds) -> None:
    orders = (
        sporadic(1, relative(1), given=1),
        sporadic(1, relative(0), given=1),
        ask(1, given=1),
        cancel(9, given=1),
        ask(9, given=1),
        periodic(2, 1, relative(1), given=1),
        cancel(2, given=2),
        ask(2, given=2),
        ask(1, given=2),
        sporadic(1, relative(0), given=2),
    )
    trace = traced(builds, timed(*orders), TELL, s.Pause(1500), s.Invoke("tell", 2), s.Pause(1200), s.Stop())
    answers = [results for results in replies(trace, TIMERS) if results]
    assert answers == [(False,), (True,), (True,), (True,)]
    assert numbers(trace) == [1, 2, 1]
    check_times(callbacks(trace), first(trace, s.START_SPORADIC).t, [1, 1, 1.5])


def test_what_is_due_already_expires_at_once(builds: Builds) -> None:
    orders = (
        sporadic(1, relative(0)),
        sporadic(2, [0, s.ABSOLUTE_TIME]),
        sporadic(3, [-5, s.ABSOLUTE_TIME], dated=True),
        sporadic(4, [2**32 - 1, s.ABSOLUTE_TIME]),
        sporadic(5, relative(2**32 - 1)),
    )
    trace = traced(builds, timed(*orders), TELL, s.Pause(300), s.Stop())
    assert sorted(numbers(trace)) == [1, 2, 3]
    check_times(callbacks(trace), first(trace, s.START_SPORADIC).t, [0, 0, 0])
    assert max(dates(trace)) - min(dates(trace)) <= 1, "a date that has passed is now"


def test_missed_expiries_are_merged_and_the_grid_goes_on(builds: Builds) -> None:
    held = timed(periodic(1, 1, relative(1)), callback=(s.HoldAtGate("g"),))
    trace = traced(builds, held, TELL, s.ReachGate("g"), s.Pause(2500), s.OpenGate("g"), s.Pause(1000), s.Stop())
    check_times(callbacks(trace), first(trace, s.START_PERIODIC).t, [1, 3.5, 4])
    begin = dates(trace)[0]
    assert [date - begin for date in dates(trace)] == [0, 1, 3], "the first of those that were missed is told"


def test_values_that_are_none_are_refused(builds: Builds) -> None:
    orders = (
        sporadic(1, [-1, s.RELATIVE_TIME]),
        sporadic(1, [0, "NEVER"]),
        sporadic(2**32, relative(0)),
        sporadic(-1, relative(0)),
        periodic(1, 0, relative(0)),
        s.CallMethod(TIMERS, s.CANCEL_TIMER),
        s.CallMethod(TIMERS, s.ON_TIMEOUT, (relative(0), 1)),
    )
    trace = traced(builds, timed(*orders), TELL, s.Pause(100), s.Stop())
    assert [e.raised for e in trace if isinstance(e, t.Reply)] == [True] * len(orders)
    assert not callbacks(trace)


def test_timers_live_from_start_to_stop(builds: Builds) -> None:
    component = timed(
        startup=(sporadic(1, relative(0)), periodic(2, 1, relative(1))),
        shutdown=(ask(2), cancel(2), sporadic(3, relative(0))),
    )
    again = (s.Pause(1300), s.Stop(), s.Pause(1200), s.Start(), s.Pause(300), s.Stop(), s.RemoveComponent("A"))
    trace = traced(builds, component, *again)
    assert numbers(trace) == [1, 2, 1]
    phases = [e.hook for e in trace if isinstance(e, t.Exit) or e in callbacks(trace)]
    assert phases == [
        *("on_init", "on_startup", "method", "method", "method", "method", "on_shutdown"),
        *("on_startup", "method", "method", "on_shutdown", "on_remove"),
    ]
    assert [results for results in replies(trace, TIMERS) if results] == [(True,), (True,)], (
        "dropped before on_shutdown"
    )


def test_a_callback_may_set_and_cancel_timers(builds: Builds) -> None:
    orders = (sporadic(1, relative(0)), periodic(2, 1, relative(1)))
    component = timed(*orders, callback=(sporadic(1, relative(1)), cancel(2), ask(2)))
    trace = traced(builds, component, TELL, s.Pause(1300), s.Stop())
    assert numbers(trace) == [1, 1]
    check_times(callbacks(trace), first(trace, s.START_SPORADIC).t, [0, 1])


def test_exceptions_of_callbacks_are_dropped(builds: Builds) -> None:
    trace = traced(
        builds, timed(periodic(1, 0, relative(1)), callback=(s.RaiseError(),)), TELL, s.Pause(1300), s.Stop()
    )
    assert numbers(trace) == [1, 1]


@pytest.mark.parametrize("execution", EXECUTIONS.values(), ids=EXECUTIONS)
@pytest.mark.parametrize("options", ["", "executor=component", "executor=shared"])
def test_a_protected_component_is_not_entered_meanwhile(
    builds: Builds, execution: tuple[s.Policy, ...], options: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("UCM_CTS_LWUCM_OPTIONS", options)
    component = timed(sporadic(1, relative(0)), s.HoldAtGate("g"), execution=execution)
    trace, left = while_called(builds, component)
    (entered,) = callbacks(trace)
    assert left.n < entered.n


def test_an_unprotected_component_is_entered_at_any_time(builds: Builds) -> None:
    component = timed(sporadic(1, relative(0)), s.HoldAtGate("g"), execution=(s.Policy(s.UNPROTECTED_PASSIVE),))
    trace, left = while_called(builds, component)
    (entered,) = callbacks(trace)
    assert entered.n < left.n


@pytest.mark.parametrize("end", [s.Stop(thread="z"), s.Destroy(thread="z")], ids=["stop", "destroy"])
def test_the_end_waits_for_a_callback(builds: Builds, end: s.Step) -> None:
    component = timed(sporadic(1, relative(0)), sporadic(2, relative(0)), callback=(s.HoldAtGate("g"),))
    trace = ended(builds, component, end)
    assert numbers(trace) == [1]


@pytest.mark.parametrize("definition", [s.INDEX_TIMERS, s.OBJECT_TIMERS])
@pytest.mark.parametrize("wrong", ["two", "of a port", "with a parameter"])
def test_policies_that_are_refused(builds: Builds, definition: str, wrong: str) -> None:
    policies = {
        "two": (s.Policy(definition, element="a"), s.Policy(definition, element="b")),
        "of a port": (s.Policy(definition, "in", element="a"),),
        "with a parameter": (s.Policy(definition, element="a", parameters={"rate": "1"}),),
    }[wrong]
    scenario = s.Scenario({"A": s.Declaration(("in",), policies=policies)}, (s.AddComponent("A"),))
    assert [e.error for e in events(builds.reference, scenario) if isinstance(e, t.Raise)] == ["UCM_ERROR"]
