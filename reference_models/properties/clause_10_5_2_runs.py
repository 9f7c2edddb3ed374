"""Properties about when self-executing components of 10.5 run: every period, or once in the background (10.5.2)."""

from __future__ import annotations

from collections.abc import Sequence

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.trace import Return
from ucm_cts.reference_models.conclusions import Conclusions
from ucm_cts.reference_models.findings import Finding
from ucm_cts.reference_models.model.execution_policies import extended_policy
from ucm_cts.reference_models.model.executions import Execution
from ucm_cts.reference_models.model.messages import PUNCTUALITY
from ucm_cts.reference_models.model.method_calls import NEVER, Operation
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.paced_events import MILLISECOND, PacedExecution, PacedPhase
from ucm_cts.reference_models.model.paced_phases import granularity, lateness, paced_phases, shown
from ucm_cts.reference_models.model.phases import noticed
from ucm_cts.reference_models.model.runtime import Member
from ucm_cts.reference_models.properties.clause_10_5_2 import of_phase
from ucm_cts.reference_models.properties.declaration import Property, property_at

_REPEATS, _FIRST, _NOT_MORE_OFTEN, _GOES_ON = "R-10.5.2-01", "R-10.5.2-02", "R-10.5.2-03", "R-10.5.2-04"
_ONCE, _BACKGROUND_LATE, _BESIDE_OTHERS = "R-10.5.2-05", "R-10.5.2-06", "R-10.5.2-07"
_RESTARTS = "R-10.5.2-21"

_MANY = 20
"""So many runs show whether a rate is kept."""

_LONG_AGO = 40_000_000
"""Nanoseconds after which a second run in the background would have shown itself."""


def _shift(runtime: ObservedRuntime, phase: PacedPhase) -> int:
    """How much later than the offset the first run is due."""
    return phase.period if runtime.ics.reading("first-period") == "offset-plus-period" else 0


@property_at("closed", _NOT_MORE_OFTEN, _RESTARTS, feature="paced", timed=True)
def runs_not_more_often(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """Run k is not entered before k periods have passed after the offset."""
    chained = runtime.ics.reading("period-anchor") == "chained"
    for phase in paced_phases(runtime, s.PERIODIC_SELF_EXECUTING):
        first = phase.first(latest=False) + _shift(runtime, phase)
        for k, run in enumerate(phase.executions):
            due = first + k * phase.period
            if chained and k:
                due = max(due, phase.executions[k - 1].t + phase.period - phase.period // 4)
            if run.t < due - granularity(runtime):
                yield check.fail(
                    "early",
                    expected=f"run {k} of '{phase.member.lane}', counted from 0, begins no earlier than its offset and period of {shown(phase.period)} permit",
                    observed=f"it began {shown(due - run.t)} too early",
                    at=(phase.executions[0].enter.n, run.enter.n),
                    requirement=of_phase(phase, _NOT_MORE_OFTEN),
                )
                break
        else:
            if len(phase.executions) > 1:
                yield check.kept()
            if phase.number and phase.executions:
                yield check.kept(_RESTARTS)


@property_at("closed", _REPEATS, feature="paced", timed=True)
def runs_at_the_rate(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """The mean distance of many runs is the period, but for what the last of them may be late."""
    chained = runtime.ics.reading("period-anchor") == "chained"
    for phase in paced_phases(runtime, s.PERIODIC_SELF_EXECUTING):
        runs = phase.executions[: phase.overrun]
        if len(runs) < _MANY or phase.may_catch_up:
            continue
        mean = (runs[-1].t - runs[0].t) / (len(runs) - 1)
        fine = granularity(runtime)
        rounded = fine if fine and phase.period % fine else 0  # each period may be rounded to what the clock can tell
        one = (lateness(runtime) + fine) / (len(runs) - 1) + rounded
        if -one <= mean - phase.period <= (lateness(runtime) if chained else one):
            yield check.kept()
            continue
        yield check.fail(
            "another rate",
            expected=f"'{phase.member.lane}' runs each {shown(phase.period)}",
            observed=f"the mean distance of {len(runs)} runs was {shown(mean)}",
            at=(runs[0].enter.n, runs[-1].enter.n),
            late_by=_late_among(runtime, phase, runs, mean),
        )


def _late_among(runtime: ObservedRuntime, phase: PacedPhase, runs: Sequence[PacedExecution], mean: float) -> int:
    """By how much the last of ``runs`` came later than it may, or the first one if that makes their mean distance too short; 0 if none did."""
    off = round((mean - phase.period) * (len(runs) - 1))
    if off >= 0:
        return max(0, off - lateness(runtime))
    too_short = -off - lateness(runtime)
    return too_short if runs[0].t - _latest(runtime, phase, 0) >= too_short else 0


@property_at("closed", _FIRST, _REPEATS, _GOES_ON, _RESTARTS, feature="paced", timed=True)
def runs_in_time(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """The first run comes when the offset has passed, and each further one when its period has."""
    for phase in paced_phases(runtime, s.PERIODIC_SELF_EXECUTING):
        runs, late = phase.executions, lateness(runtime)
        if runs and runs[0].t > _latest(runtime, phase, 0) + late:
            yield _late(check, runtime, phase, 0, of_phase(phase, _FIRST))
            continue
        if runs:
            yield check.kept(_FIRST)
        elif _latest(runtime, phase, 0) + late < phase.ended_at:
            yield _missing(check, runtime, phase, 0, of_phase(phase, _FIRST))
            continue
        for k, run in enumerate(runs[1:], 1):
            if run.t > _latest(runtime, phase, k) + late:
                on_grid = k <= phase.overrun
                yield _late(check, runtime, phase, k, of_phase(phase, _REPEATS if on_grid else _GOES_ON))
                break
        else:
            raised = phase.member.raises("run")  # whether a run follows one that raised is not judged
            is_over = bool(runs) and runs[-1].execution.over and not raised
            if is_over and _latest(runtime, phase, len(runs)) + late < phase.ended_at:
                yield _missing(check, runtime, phase, len(runs), of_phase(phase, _GOES_ON))
            elif len(runs) > 1:
                yield check.kept(_GOES_ON)


def _latest(runtime: ObservedRuntime, phase: PacedPhase, k: int) -> int:
    """When run ``k`` is due at the latest: on the grid until a run lasted too long, afterwards within a period.

    One thread may run all components: while a run of another one lasts for a period, none is due.
    """
    grid = phase.first(latest=True) + _shift(runtime, phase) + k * phase.period
    moment = phase.executions[k].t if k < len(phase.executions) else phase.ended_at
    elsewhere = [
        min(run.left, moment)
        for other in paced_phases(runtime, s.PERIODIC_SELF_EXECUTING)
        for run in other.executions
        if other is not phase and run.t < moment and run.left - run.t >= phase.period
    ]
    free = max([phase.busy_until(moment), *elsewhere])
    if k == 0:
        return max(grid, free)
    before = phase.executions[k - 1]
    if k > phase.overrun or phase.others or elsewhere or runtime.ics.reading("period-anchor") == "chained":
        return max(before.left + phase.period, free)
    return max(grid, before.left)


def _late(check: Property, runtime: ObservedRuntime, phase: PacedPhase, k: int, requirement: str) -> Finding:
    run = phase.executions[k]
    return check.fail(
        "late",
        expected=f"run {k} of '{phase.member.lane}' begins when offset and period say, or as much later as declared",
        observed=f"it began {shown(run.t - phase.first(latest=True))} after the first instant, and the period is {shown(phase.period)}",
        at=(phase.begin, run.enter.n),
        requirement=requirement,
        late_by=run.t - _latest(runtime, phase, k) - lateness(runtime),
    )


def _missing(check: Property, runtime: ObservedRuntime, phase: PacedPhase, k: int, requirement: str) -> Finding:
    last = (phase.executions[-1].enter.n,) if phase.executions else ()
    return check.fail(
        "never",
        expected=f"'{phase.member.lane}' runs each {shown(phase.period)} as long as it is operational",
        observed=f"it ran {k} times and no more" if k else "it did not run",
        at=(phase.begin, *last, *noticed(runtime, _latest(runtime, phase, k))),
        requirement=requirement,
    )


@property_at("closed", _GOES_ON, feature="paced", timed=True)
def missed_runs(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """What follows a run that lasted for several periods is as declared."""
    reading = runtime.ics.reading("period-overrun")
    for phase in paced_phases(runtime, s.PERIODIC_SELF_EXECUTING):
        k = phase.overrun
        if k + 1 >= len(phase.executions) or reading not in ("queued", "skipped", "merged"):
            continue
        held, following = phase.executions[k], phase.executions[k + 1 :]
        lasting = next((n for n, run in enumerate(following, 1) if run.left - run.t >= phase.period), None)
        following = following[:lasting]  # it keeps the others out anew
        missed = (held.left - held.t) // phase.period
        late = held.left + lateness(runtime)
        at_once = sum(run.t <= late for run in following)
        next_tick = _tick_after(phase, held.left) - granularity(runtime)
        if reading == "queued":
            is_right = at_once >= min(missed, len(following))
        else:
            on_grid = following[1:] if reading == "merged" else following
            is_right = not on_grid or on_grid[0].t >= next_tick
        if is_right:
            yield check.kept()
            continue
        yield check.fail(
            "missed ones",
            expected=f"the runs of '{phase.member.lane}' that a long one kept out are {reading}, as declared",
            observed=f"{missed} periods passed, and {at_once} runs followed at once",
            at=(held.enter.n, following[0].enter.n),
        )


def _tick_after(phase: PacedPhase, moment: int) -> int:
    """The earliest instant of the grid that may follow ``moment``.

    A grid may begin with its thread, after the first instant. No run comes before its place in the grid, so the grid began no
    later than the run with the smallest delay shows.
    """
    first = phase.first(latest=True)
    behind = min(max(0, run.t - first) % phase.period for run in phase.executions[: phase.overrun + 1])
    number = -((first + behind - moment) // phase.period)
    return phase.first(latest=False) + max(0, number) * phase.period


@property_at("closed", _ONCE, _BACKGROUND_LATE, _RESTARTS, feature="paced", timed=True)
def background_runs_once(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """A background component runs once after each start, or once at all if that is declared, when the offset has passed."""
    once_a_life = runtime.ics.reading("background-again") == "once-a-life"
    ran = set[tuple[str, int]]()
    for phase in paced_phases(runtime, s.BACKGROUND):
        runs = [*phase.executions, *phase.at_its_end]
        due = 0 if once_a_life and phase.member.body in ran else 1
        if runs:
            ran.add(phase.member.body)
        if len(runs) > due:
            yield check.fail(
                "again",
                expected=f"run of '{phase.member.lane}' is called {'once' if due else 'no more after its first phase'}",
                observed=f"it was called {len(runs)} times",
                at=tuple(run.enter.n for run in runs[-2:]),
                requirement=of_phase(phase, _ONCE) if due else _ONCE,
            )
            continue
        latest = max(phase.first(latest=True), phase.busy_until(runs[0].t if runs else phase.ended_at))
        came = runs[0].t if runs else phase.ended_at
        if due and came > latest + lateness(runtime):
            yield check.fail(
                "late" if runs else "never",
                expected=f"run of '{phase.member.lane}' is called when its offset of {shown(phase.offset)} has passed",
                observed=f"it came {shown(came - latest)} later" if runs else "it was not",
                at=(phase.begin, *(run.enter.n for run in runs)),
                requirement=of_phase(phase, _BACKGROUND_LATE),
                late_by=came - latest - lateness(runtime) if runs else 0,
            )
            continue
        if runs:
            yield check.kept(_BACKGROUND_LATE)
        if runs and runs[0].execution.over and phase.ended_at - runs[0].left >= _LONG_AGO:
            yield check.kept()
        if phase.number and runs:
            yield check.kept(_RESTARTS)


@property_at("closed", _BESIDE_OTHERS, feature="paced", timed=True)
def background_lets_others_go_on(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """While a background run does not return, start does, and calls of other components are executed."""
    for member in list(runtime.bodies.values()):
        policy = extended_policy(member.declaration)
        if policy is None or policy.definition != s.BACKGROUND or member.suspended:
            continue
        for run in runtime.executions.of(member.body):
            if run.way == "run":
                yield from _beside(check, runtime, member, run)


def _beside(check: Property, runtime: ObservedRuntime, member: Member, run: Execution) -> Conclusions:
    """The calls of start and of other components that were made before a run ended, and returned while it went on, or only afterwards."""
    left, left_at = (run.end, run.left) if run.over else (NEVER, runtime.interactions.latest)
    patience = PUNCTUALITY * runtime.scenario.patience * MILLISECOND
    for operation in runtime.interactions.operations:
        is_start = isinstance(operation.step, s.Start)
        if not is_start and not isinstance(operation.step, s.Invoke):
            continue
        if not operation.overlaps(run.enter.n, left) or _concerns(runtime, operation, member.body):
            continue
        end = operation.end.n if operation.end is not None else NEVER
        if run.enter.n < end < left and isinstance(operation.end, Return):
            yield check.kept()
        elif end > left and left_at - max(operation.begin.t, run.enter.t) >= patience:
            what = "start returns" if is_start else "another component is executed"
            yield check.fail(
                "start" if is_start else "others",
                expected=f"{what} while the background run of '{member.lane}' goes on",
                observed="it did not",
                at=(operation.begin.n, run.enter.n, *((left,) if run.over else ())),
            )


def _concerns(runtime: ObservedRuntime, operation: Operation, body: tuple[str, int]) -> bool:
    """Does the test call that component itself, or one that executes something else meanwhile, which may keep the call out?"""
    step = operation.step
    if not isinstance(step, s.Invoke):
        return False
    _, callee = runtime.reference(step.ref)
    if callee is None or callee.body == body:
        return True
    end = operation.end.n if operation.end is not None else NEVER
    others = (e for e in runtime.executions.of(callee.body) if e.call is None or e.call.n != operation.begin.n)
    return any(e.enter.n < end and (not e.over or e.end > operation.begin.n) for e in others)
