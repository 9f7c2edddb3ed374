"""Properties about when active components of 10.5 are executed: every period, or with a least distance, when they are called (10.5.2)."""

from __future__ import annotations

from collections.abc import Sequence

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.trace import Raise, Return
from ucm_cts.reference_models.conclusions import Conclusions, takes
from ucm_cts.reference_models.findings import Finding
from ucm_cts.reference_models.model import pacing
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.paced_events import Invocation, PacedExecution, PacedPhase
from ucm_cts.reference_models.model.paced_phases import lateness, paced_phases, shown
from ucm_cts.reference_models.properties.clause_10_5_2 import of_phase
from ucm_cts.reference_models.properties.declaration import Property, property_at

_TRIGGERED = {s.PERIODIC_ACTIVE: "R-10.5.2-08", s.SPORADIC_ACTIVE: "R-10.5.2-13"}
_ONCE = {s.PERIODIC_ACTIVE: "R-10.5.2-09", s.SPORADIC_ACTIVE: "R-10.5.2-14"}
_EVERY_PERIOD, _NOT_MORE_OFTEN, _IN_THE_END = "R-10.5.2-10", "R-10.5.2-11", "R-10.5.2-12"
_APART, _AT_ONCE, _NO_SUM = "R-10.5.2-15", "R-10.5.2-16", "R-10.5.2-17"
_PHASES, _RESTARTS = "R-10.5.2-20", "R-10.5.2-21"
_ACTIVE = (s.PERIODIC_ACTIVE, s.SPORADIC_ACTIVE)


@property_at("closed", *_TRIGGERED.values(), feature="paced")
def invoked_when_executed(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """An active component is executed because a managed port element of it is called, or gets a message."""
    for phase in paced_phases(runtime, *_ACTIVE):
        requirement = _TRIGGERED[phase.policy.definition]
        for execution in phase.executions:
            if execution.invocation is not None:
                yield check.kept(requirement)
                continue
            yield check.fail(
                "no caller",
                expected=f"'{phase.member.lane}' is executed because it is called",
                observed=f"its {execution.enter.port} was entered without a call",
                at=(execution.enter.n,),
                requirement=requirement,
            )
            break


@property_at("closed", *_ONCE.values(), _PHASES, feature="paced")
def executed_once(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """Each call enters once, with its own value and result; an early one of a sporadic component may be refused."""
    for phase in paced_phases(runtime, *_ACTIVE):
        requirement = _ONCE[phase.policy.definition]
        for invocation in phase.invocations:
            executions = [e for e in invocation.executions if e.enter.body == phase.member.body]
            if any(e.enter.n > invocation.over for e in executions) and isinstance(_end_of(runtime, invocation), Raise):
                yield _other_times(check, phase, invocation, 2, requirement)
            elif len(executions) > 1:
                yield _other_times(check, phase, invocation, len(executions), requirement)
            elif invocation.over < phase.until and invocation.n > phase.begin and invocation.call.possible:
                yield from _carried_out(check, runtime, phase, invocation, requirement)
            elif phase.until < invocation.over and not invocation.executions:
                yield from _left_waiting(check, runtime, phase, invocation, requirement)


def _carried_out(
    check: Property, runtime: ObservedRuntime, phase: PacedPhase, invocation: Invocation, requirement: str
) -> Conclusions:
    end = _end_of(runtime, invocation)
    if not invocation.executions:
        if isinstance(end, Return):
            yield _other_times(check, phase, invocation, 0, requirement)
        elif isinstance(end, Raise) and not phase.member.raises("exchange"):
            is_early = phase.policy.definition == s.SPORADIC_ACTIVE and pacing.is_early(phase, invocation)
            if not is_early or not (yield from takes(runtime, "early-invocation", "refused")):
                yield _other_times(check, phase, invocation, 0, requirement)
        return
    execution = invocation.executions[0]
    exit_ = next((x for e, x in invocation.call.entries if e is execution.enter), None)
    if (
        isinstance(end, Return)
        and exit_ is not None
        and (end.value, execution.enter.value)
        != (
            exit_.value,
            invocation.call.value,
        )
    ):
        yield check.fail(
            "otherwise",
            expected=f"exchange({invocation.call.value}) executes '{phase.member.lane}' with that value and brings back its result",
            observed=f"it was entered with {execution.enter.value}, and {end.value} came back",
            at=(invocation.n, execution.enter.n, end.n),
            requirement=requirement,
        )
        return
    yield check.kept(requirement)


def _left_waiting(
    check: Property, runtime: ObservedRuntime, phase: PacedPhase, invocation: Invocation, requirement: str
) -> Conclusions:
    """It waited when the phase ended: it was too early to be executed, and it comes back, with an exception.

    It may wait on while the component executes a call of a port that the policy does not manage.
    """
    if invocation.message is not None or invocation.call.step is None:
        return
    end = _end_of(runtime, invocation)
    if isinstance(end, Return):
        yield _other_times(check, phase, invocation, 0, requirement)
        return
    ahead = sum(1 for i in phase.invocations if i is not invocation)
    busy = sum(e.left - e.t for e in phase.executions) + sum(e.left - e.enter.t for e in phase.others if e.over)
    limit = max(invocation.t, phase.first(latest=True)) + (ahead + 2) * phase.period + busy + lateness(runtime)
    if limit < phase.ended_at and all(one.over for one in phase.others):
        yield check.fail(
            "never",
            expected=f"the call through {invocation.port} executes '{phase.member.lane}', after {ahead} others at most",
            observed="it still waited when the component was stopped",
            at=(invocation.n, phase.until),
            requirement=requirement,
        )
        return
    for wait in runtime.interactions.waits:
        is_for_it = isinstance(wait.step, s.Join) and wait.step.worker == invocation.call.step.thread
        if (
            is_for_it
            and phase.closed < wait.timeout.n < invocation.over
            and not _executed_in(runtime, phase, wait.timeout.n)
        ):
            yield check.fail(
                "left waiting",
                expected=f"a call that waits when '{phase.member.lane}' is stopped comes back",
                observed="it did not",
                at=(invocation.n, wait.timeout.n),
                requirement=_PHASES,
            )
            return


def _executed_in(runtime: ObservedRuntime, phase: PacedPhase, until: int) -> bool:
    """Did the component execute anything after the stop that ended ``phase``, before event ``until``?"""
    executions = runtime.executions.of(phase.member.body)
    return any(one.enter.n < until and (not one.over or one.end > phase.closed) for one in executions)


def _end_of(runtime: ObservedRuntime, invocation: Invocation) -> Return | Raise | None:
    """How a call of the test came back; None if it did not."""
    return next((o.end for o in runtime.interactions.operations if o.begin.n == invocation.n), None)


def _other_times(check: Property, phase: PacedPhase, invocation: Invocation, times: int, requirement: str) -> Finding:
    return check.fail(
        "not executed" if not times else "more than once",
        expected=f"the call through {invocation.port} executes '{phase.member.lane}' once",
        observed=f"it executed it {times} times" if times else "it came back and had not executed it",
        at=(invocation.n, *(e.enter.n for e in invocation.executions)),
        requirement=requirement,
    )


@property_at("closed", _EVERY_PERIOD, _NOT_MORE_OFTEN, _RESTARTS, feature="paced", timed=True)
def executed_every_period(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """A periodic active component is executed at the instants of offset and period, under one reading of the text."""
    readings = pacing.readings(runtime)
    for phase in paced_phases(runtime, s.PERIODIC_ACTIVE):
        for executions in pacing.groups(runtime, phase):
            found = [pacing.too_early(runtime, phase, executions, reading) for reading in readings]
            if not executions:
                continue
            worst = max((one for one in found if one is not None), key=lambda one: one.execution.t, default=None)
            if worst is None or None in found:
                yield check.kept()
                if pacing.in_burst(executions, phase.period):
                    yield check.kept(_NOT_MORE_OFTEN)
                if phase.number:
                    yield check.kept(_RESTARTS)
                continue
            is_close = worst.after is not None and worst.execution.t - worst.after.t < phase.period * 3 // 4
            yield _untimely(check, phase, worst, of_phase(phase, _NOT_MORE_OFTEN if is_close else _EVERY_PERIOD))


def _untimely(check: Property, phase: PacedPhase, worst: pacing.Untimely, requirement: str) -> Finding:
    before = (worst.after.enter.n,) if worst.after is not None else ()
    return check.fail(
        "early",
        expected=f"'{phase.member.lane}' is executed each {shown(phase.period)}",
        observed=f"it was executed {shown(worst.by)} too early, under every reading that may hold",
        at=(*before, worst.execution.enter.n),
        requirement=requirement,
        late_by=worst.late_by,
    )


@property_at("closed", _EVERY_PERIOD, _IN_THE_END, _RESTARTS, feature="paced", timed=True)
def executed_in_the_end(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """A call is executed at the next instant, or at one of the next if others came before it."""
    yield from _in_time(check, runtime, s.PERIODIC_ACTIVE, (_EVERY_PERIOD, _IN_THE_END))


@property_at("closed", _APART, _RESTARTS, feature="paced", timed=True)
def sporadic_apart(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """Executions of a sporadic component are a least distance apart."""
    for phase in paced_phases(runtime, s.SPORADIC_ACTIVE):
        for executions in pacing.groups(runtime, phase):
            close = pacing.too_close(runtime, phase, executions)
            if close is None:
                if pacing.in_burst(executions, phase.period) or _has_turned_away(runtime, phase, executions):
                    yield check.kept()
                if phase.number and executions:
                    yield check.kept(_RESTARTS)
                continue
            yield check.fail(
                "close",
                expected=f"executions of '{phase.member.lane}' are {shown(phase.period)} apart, each from those before it",
                observed=f"one came {shown(close.by)} too early",
                at=(*((close.after.enter.n,) if close.after is not None else ()), close.execution.enter.n),
                requirement=of_phase(phase, _APART),
                late_by=close.late_by,
            )


def _has_turned_away(runtime: ObservedRuntime, phase: PacedPhase, executions: Sequence[PacedExecution]) -> bool:
    """Was a call that came too early refused or dropped, as is declared?"""
    if not executions or runtime.ics.reading("early-invocation") not in ("refused", "dropped"):
        return False
    return any(
        not one.executions and pacing.is_early(phase, one) for one in phase.invocations if one.over < phase.until
    )


@property_at("closed", _AT_ONCE, _NO_SUM, _RESTARTS, feature="paced", timed=True)
def sporadic_in_time(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """A call of a sporadic component is executed at once, or when the least distance has passed, and no later."""
    yield from _in_time(check, runtime, s.SPORADIC_ACTIVE, (_AT_ONCE, _NO_SUM))


def _in_time(check: Property, runtime: ObservedRuntime, definition: str, requirements: tuple[str, str]) -> Conclusions:
    """Is nothing executed too late? ``requirements``: of executions that need not wait for others, and of those that must."""
    for phase in paced_phases(runtime, definition):
        for executions in pacing.groups(runtime, phase):
            for execution, waited, late in pacing.too_late(runtime, phase, executions):
                if late:
                    yield _late(check, phase, execution, late, of_phase(phase, requirements[waited]))
                    break
                yield check.kept(requirements[waited])


def _late(check: Property, phase: PacedPhase, execution: PacedExecution, late: int, requirement: str) -> Finding:
    asked = (execution.invocation.n,) if execution.invocation is not None else ()
    return check.fail(
        "late",
        expected=f"a call of '{phase.member.lane}' is executed when its policy permits it, or as much later as timer-lateness says",
        observed=f"it was executed {shown(late)} later than timer-lateness permits",
        at=(*asked, execution.enter.n),
        requirement=requirement,
        late_by=late,
    )
