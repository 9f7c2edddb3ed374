"""Properties about the clock service: order, rate, agreement and range of the times that bodies get (10.1.4)."""

from __future__ import annotations

from collections.abc import Iterator

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_values import printed
from ucm_cts.adapters.contract.trace import Raise
from ucm_cts.reference_models.conclusions import Concluded, Conclusions
from ucm_cts.reference_models.findings import Finding
from ucm_cts.reference_models.model import clock_readings as clocks
from ucm_cts.reference_models.model.clock_reading import ClockReading
from ucm_cts.reference_models.model.method_calls import MethodCall
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.operation import OperationInProgress
from ucm_cts.reference_models.model.runtime import has_meaningless_values, lane
from ucm_cts.reference_models.model.service_policies import has_several_clocks, only_service, policies_of
from ucm_cts.reference_models.properties.declaration import Property, property_at

_REAL_TIME, _SYSTEM_TIME = "R-10.1.4.1-09", "R-10.1.4.1-10"

_LARGEST_MICROSECONDS = 999_999
_LARGEST_SECONDS = 2**32 - 1
_LONG_ENOUGH = 3
"""So many tolerances must lie between two readings; less would not show a clock that stands still or runs double."""


@property_at("completed", "R-10.1.4.1-06")
def clock_answers(check: Property, runtime: ObservedRuntime, call: MethodCall) -> Concluded:
    """Both methods of the clock return, from on_startup to on_shutdown."""
    method, caller, reply = clocks.clock_call(runtime, call), call.caller, call.reply
    if not method or reply is None or caller is None or caller.suspended:
        return ()
    if clocks.time_given(call) is not None:
        if _has_given(runtime, call, *(other for other in clocks.CLOCK_METHODS if other != method)):
            return check.kept()
        return ()
    return check.fail(
        f"{method} {'raises' if reply.failed else 'no time'}",
        expected=f"{method} tells '{caller.lane}' the time",
        observed="it raised" if reply.failed else f"it gave {printed(reply.results or ())}",
        at=(call.request.n, reply.n),
    )


def _has_given(runtime: ObservedRuntime, call: MethodCall, *methods: str) -> bool:
    """Have other methods given this caller the time, too?"""
    calls = runtime.interactions.calls
    own = (c for c in reversed(calls) if c.caller is call.caller and clocks.time_given(c) is not None)
    return any(clocks.clock_call(runtime, c) in methods for c in own)


@property_at("completed", "R-10.1.4.2-14")
def time_range(check: Property, runtime: ObservedRuntime, call: MethodCall) -> Concluded:
    """The microseconds of a time are those of one second, and its seconds have 32 bits without sign."""
    given = clocks.time_given(call) if clocks.clock_call(runtime, call) else None
    if given is None or call.reply is None:
        return ()
    seconds, microseconds = given
    if 0 <= microseconds <= _LARGEST_MICROSECONDS and 0 <= seconds <= _LARGEST_SECONDS:
        return check.kept()
    part, value = ("seconds", seconds) if not 0 <= seconds <= _LARGEST_SECONDS else ("microseconds", microseconds)
    return check.fail(
        f"negative {part}" if value < 0 else f"too many {part}",
        expected=f"seconds from 0 to {_LARGEST_SECONDS}, microseconds from 0 to {_LARGEST_MICROSECONDS}",
        observed=f"{call.request.method} gave {seconds} s and {microseconds} µs",
        at=(call.request.n, call.reply.n),
    )


@property_at("ended", "R-10.1.4.1-02", at=("add_component", "start"), feature="policies")
def one_clock(check: Property, runtime: ObservedRuntime, ongoing: OperationInProgress) -> Conclusions:
    """A component without clock and one with a clock are started, one with two is refused when it is to start at latest."""
    if isinstance(ongoing.step, s.AddComponent):
        declaration = runtime.scenario.components.get(ongoing.step.component)
        if declaration is None or ongoing.container.started is not False or not isinstance(ongoing.end, Raise):
            return
        if has_several_clocks(declaration):
            yield check.kept()
        elif only_service(declaration, s.CLOCK) and not has_meaningless_values(declaration, ongoing.step):
            yield check.refused("add_component", ongoing.end, expected="a component with one clock is added")
        return
    members = [m for m in ongoing.container.live_members() if has_several_clocks(m.declaration)]
    if isinstance(ongoing.end, Raise):
        if members:
            yield check.kept()
        return
    for member in members:
        yield check.fail(
            "started",
            expected=f"'{member.lane}', which has two clocks, is not started",
            observed="start returned",
            event=ongoing.end,
        )
    for member in ongoing.container.live_members() if ongoing.judged and not members else ():
        if policies_of(member.declaration, s.CLOCK) and member.body in ongoing.by_body:
            yield check.kept()


@property_at("closed", "R-10.1.4.1-08")
def local_time_order(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """Of two readings of local time in one container, one after the other, the later one is not earlier, unless the clock
    may have been set. Another container may be on another node.
    """
    tolerance = runtime.ics.tolerance("clock-tolerance") * clocks.MILLISECOND
    for earlier, later, drift in _pairs(runtime, clocks.LOCAL, _is_never_set(runtime)):
        if earlier.container is None or earlier.container is not later.container:
            continue
        went = clocks.passed(earlier.time, later.time)
        if went >= 0:
            if drift <= tolerance:
                yield check.kept()
        elif later.asked - earlier.answered - went > drift:
            yield _went_back(check, earlier, later, 0.0)
            return


@property_at("closed", _SYSTEM_TIME)
def synchronized_time_agrees(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """Of two readings of synchronized time, wherever, the later one is not earlier by more than the tolerance."""
    tolerance = runtime.ics.tolerance("synchronization-tolerance")
    for earlier, later, drift in _pairs(runtime, clocks.SYNCHRONIZED):
        if clocks.passed(earlier.time, later.time) < -tolerance * clocks.MILLISECOND - drift:
            yield _went_back(check, earlier, later, tolerance)
            return
        if earlier.body != later.body and drift <= tolerance * clocks.MILLISECOND:
            yield check.kept()


@property_at("closed", _SYSTEM_TIME, timed=True)
def synchronized_time_passes(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """Between two readings of one body synchronized time went on, by half of the real time at least."""
    tolerance = runtime.ics.tolerance("synchronization-tolerance") * clocks.MILLISECOND
    for earlier, later, drift in _pairs(runtime, clocks.SYNCHRONIZED):
        least = (later.asked - earlier.answered) // 2 + later.advanced - earlier.advanced
        went = clocks.passed(earlier.time, later.time)
        if earlier.body != later.body or went >= least - tolerance - drift:
            continue
        expected = f"synchronized time goes on by {_milliseconds(least - int(tolerance))} ms at least"
        yield _paced(check, earlier, later, "too slow", expected)
        return


@property_at("closed", _REAL_TIME, timed=True)
def local_time_rate(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """Between two readings of one body as much local time passed as on the host's monotonic clock, and virtual time."""
    tolerance = runtime.ics.tolerance("clock-tolerance") * clocks.MILLISECOND
    rate = runtime.ics.tolerance("clock-rate") / 100
    for earlier, later, drift in _pairs(runtime, clocks.LOCAL, _is_never_set(runtime)):
        if earlier.body != later.body or _width(earlier) + _width(later) > tolerance:
            continue
        virtual = later.advanced - earlier.advanced
        least, most = later.asked - earlier.answered + virtual, later.answered - earlier.asked + virtual
        went, slack = clocks.passed(earlier.time, later.time), tolerance + drift + 2 * clocks.MICROSECOND
        if least * (1 - rate) - slack <= went <= most * (1 + rate) + slack:
            if least >= _LONG_ENOUGH * tolerance and drift <= tolerance:
                yield check.kept()
            continue
        expected = f"local time goes on by {_milliseconds(least)} to {_milliseconds(most)} ms, more or less"
        yield _paced(check, earlier, later, "too slow" if went < least else "too fast", expected)
        return


@property_at("closed", _REAL_TIME, timed=True)
def local_time_epoch(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """Local time is the host's calendar time, within the tolerance, where the vendor says that it begins like Unix time."""
    if runtime.ics.reading("clock-epoch") != "unix":
        return
    tolerance = runtime.ics.tolerance("epoch-tolerance") * clocks.MILLISECOND
    for reading in clocks.readings_of(runtime, clocks.LOCAL):
        calendar = clocks.calendar_at(runtime.interactions.pauses, reading.asked, reading.answered)
        if calendar is None:
            continue
        away = clocks.passed(calendar[0] + reading.advanced, reading.time)
        slack = tolerance + calendar[1]
        if -slack <= away <= slack + _width(reading):
            yield check.kept()
            continue
        yield check.fail(
            "not unix",
            expected=f"local time is the calendar's, about {calendar[0] // clocks.SECOND} s, as declared",
            observed=f"'{_who(reading)}' read {reading.time // clocks.SECOND} s",
            at=(reading.begin, reading.end),
        )
        return


def _is_never_set(runtime: ObservedRuntime) -> bool:
    return runtime.ics.reading("local-clock") == "monotonic"


def _pairs(
    runtime: ObservedRuntime, method: str, is_never_set: bool = False
) -> Iterator[tuple[ClockReading, ClockReading, int]]:
    """Two readings, one after the other, and by how many nanoseconds the clock may have been set in between.

    Pairs for which that is open are left out.
    """
    readings = clocks.readings_of(runtime, method)
    pauses = runtime.interactions.pauses
    for later in readings:
        for earlier in (r for r in readings if r.end < later.begin):
            calendar = (0, 0) if is_never_set else clocks.calendar_at(pauses, earlier.asked, later.answered)
            if calendar is not None:
                yield earlier, later, calendar[1]


def _went_back(check: Property, earlier: ClockReading, later: ClockReading, tolerance: float) -> Finding:
    back = _milliseconds(-clocks.passed(earlier.time, later.time))
    return check.fail(
        "one component" if earlier.body == later.body else "two components",
        expected=f"'{_who(later)}' reads no earlier time than '{_who(earlier)}' before it"
        + (f", give or take {tolerance:g} ms" if tolerance else ""),
        observed=f"it read one that is {back} ms earlier",
        at=(earlier.begin, earlier.end, later.begin, later.end),
    )


def _paced(check: Property, earlier: ClockReading, later: ClockReading, cause: str, expected: str) -> Finding:
    went = _milliseconds(clocks.passed(earlier.time, later.time))
    observed = f"'{_who(later)}' saw it go on by {went} ms"
    return check.fail(cause, expected=expected, observed=observed, at=(earlier.end, later.end))


def _width(reading: ClockReading) -> int:
    return reading.answered - reading.asked


def _who(reading: ClockReading) -> str:
    return lane(*reading.body)


def _milliseconds(nanoseconds: int) -> str:
    return f"{nanoseconds / clocks.MILLISECOND:.3f}"
