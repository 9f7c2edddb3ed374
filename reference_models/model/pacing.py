"""When an active component of 10.5 may be executed at the earliest and must be at the latest, under each reading of the text."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.reference_models.model.executions import BusinessCall
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.paced_events import MILLISECOND, Invocation, PacedExecution, PacedPhase
from ucm_cts.reference_models.model.paced_phases import granularity, lateness, paced_phases

READINGS = ("one-a-period", "all-a-period", "at-once-when-idle")
"""The readings of ``periodic-active``."""

_SLACK = 4
"""A least distance is measured between entries, which come a little after the framework has decided: by this part of a period."""


class Untimely(NamedTuple):
    """An execution that came ``by`` nanoseconds too early or too late, after the execution ``after`` if that is why.

    ``late_by``: by so much it came later than it may, if it is too early only for what follows, or ``after`` did, if that is why the
    two are too close; 0 if nothing was late.
    """

    execution: PacedExecution
    by: int
    after: PacedExecution | None = None
    late_by: int = 0


def groups(runtime: ObservedRuntime, phase: PacedPhase) -> list[list[PacedExecution]]:
    """The executions that share instants: all of the component, or those of each port element if that is declared."""
    if runtime.ics.reading("paced-by") != "port":
        return [phase.executions]
    ports = dict.fromkeys(e.enter.port for e in phase.executions)
    return [[e for e in phase.executions if e.enter.port == port] for port in ports]


def readings(runtime: ObservedRuntime) -> tuple[str, ...]:
    """The readings of ``periodic-active`` that the vendor's statement permits."""
    return tuple(reading for reading in READINGS if runtime.ics.permits("periodic-active", reading))


def too_early(
    runtime: ObservedRuntime, phase: PacedPhase, executions: Sequence[PacedExecution], reading: str
) -> Untimely | None:
    """The first of ``executions`` that a periodic component cannot have made yet under ``reading``.

    An execution belongs to an instant that is not longer ago than the declared lateness. While the component was executed it
    may have missed instants, which it serves afterwards.
    """
    if reading == "at-once-when-idle" or runtime.ics.reading("period-anchor") == "chained":
        return too_close(runtime, phase, executions) if reading != "all-a-period" else None
    number = -1
    before: PacedExecution | None = None
    for execution in executions:
        since = phase.busy_since(execution.t, lateness(runtime)) - lateness(runtime)
        latest = -((phase.first(latest=True) - since) // phase.period)
        free = number + (reading == "one-a-period")
        number = max(free, latest, 0)
        due = phase.first(latest=False) + number * phase.period - granularity(runtime)
        if execution.t < due:
            return Untimely(execution, due - execution.t, before, _late_for(runtime, phase, execution, free))
        before = execution
    return None


def too_close(runtime: ObservedRuntime, phase: PacedPhase, executions: Sequence[PacedExecution]) -> Untimely | None:
    """The first of ``executions`` that came too soon after those before it."""
    slack = phase.period // _SLACK + granularity(runtime)
    from_end = phase.policy.definition == s.SPORADIC_ACTIVE and runtime.ics.reading("sporadic-measure") == "end"
    for j, execution in enumerate(executions):
        for i in range(j):
            earlier = executions[i]
            since = earlier.left if from_end and i == j - 1 else earlier.t
            due = since + (j - i) * phase.period - slack
            if execution.t < due:
                before, by = executions[j - 1], due - execution.t
                since = executions[j - 2].t + phase.period if j > 1 else 0
                was_late = before.t - max(before.asked, since) >= by
                return Untimely(execution, by, before, by if was_late else 0)
    return None


def _late_for(runtime: ObservedRuntime, phase: PacedPhase, execution: PacedExecution, free: int) -> int:
    """By how much it is late for the instant before it, which is that or a later one than number ``free``; 0 if it is early for the next one."""
    number, passed = divmod(execution.t - phase.first(latest=False), phase.period)
    if number < max(free, 0) or passed >= phase.period - phase.period // _SLACK:
        return 0
    return max(0, passed - lateness(runtime))


def too_late(
    runtime: ObservedRuntime, phase: PacedPhase, executions: Sequence[PacedExecution]
) -> Iterator[tuple[PacedExecution, bool, int]]:
    """Each of ``executions``, whether it waited for others, and by how many nanoseconds it came later than it must (0 if not)."""
    late = lateness(runtime)
    is_sporadic = phase.policy.definition == s.SPORADIC_ACTIVE
    from_end = is_sporadic and runtime.ics.reading("sporadic-measure") == "end"
    shared = [  # instances of one implementation may share their instants
        one.t
        for other in paced_phases(runtime)
        if other is not phase and other.member.declaration is phase.member.declaration
        for one in other.executions
    ]
    for j, execution in enumerate(executions):
        asked = min(e.asked + _on_its_way(runtime, e) for e in executions[j:] if e.asked <= execution.t)
        free = max(asked, phase.first(latest=True), phase.busy_until(execution.t))
        waited = False
        if j:
            before = executions[j - 1]
            since = before.left if from_end else before.t
            waited = execution.asked < since + phase.period
            free = max(free, since + phase.period if is_sporadic else since)
        of_others = max((moment for moment in shared if moment < execution.t), default=0)
        free = max(free, of_others + phase.period if is_sporadic and of_others else of_others)
        due = free if is_sporadic else free + phase.period
        if phase.policy.definition == s.PERIODIC_ACTIVE and runtime.ics.reading("first-period") == "offset-plus-period":
            due += phase.period
        yield execution, waited, max(0, execution.t - due - late)


def _on_its_way(runtime: ObservedRuntime, execution: PacedExecution) -> int:
    """For how many nanoseconds the connector may have kept the message that asked for it; 0 of a call, and where push waits for receivers."""
    called = execution.invocation.message if execution.invocation is not None else None
    is_pushed = called is not None and called.link is not None and called.link.connector == s.MESSAGE_CONNECTOR
    may_be_kept = is_pushed and runtime.ics.reading("message-delivery") != "synchronous"
    return runtime.scenario.patience * MILLISECOND if may_be_kept else 0


def in_burst(executions: Iterable[PacedExecution], period: int) -> bool:
    """Were two of them asked for within one period?"""
    asked = sorted(e.asked for e in executions)
    return any(later - earlier < period for earlier, later in itertools.pairwise(asked))


def is_early(phase: PacedPhase, invocation: Invocation) -> bool:
    """Was it made before the least distance had passed since another invocation that was made or executed before it?"""
    moments = [e.t for e in phase.executions if e.enter.n < invocation.over]
    moments += [e.left for e in phase.executions if e.t <= invocation.t]
    moments += [i.t for i in phase.invocations if i is not invocation and i.n < invocation.n]
    return any(invocation.t - moment < phase.period + phase.period // 4 for moment in moments)


def may_be_turned_away(runtime: ObservedRuntime, call: BusinessCall) -> bool:
    """Did ``call`` come too early for a sporadic component, and may such a call be refused?"""
    if not runtime.ics.permits("early-invocation", "refused"):
        return False
    phases = paced_phases(runtime, s.SPORADIC_ACTIVE)
    return any(one.call is call and is_early(phase, one) for phase in phases for one in phase.invocations)
