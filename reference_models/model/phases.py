"""Finds in a trace the operational phases of a component."""

from __future__ import annotations

from collections.abc import Iterator

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.trace import Enter, Return
from ucm_cts.reference_models.model.method_calls import NEVER, Operation
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.operational_phase import Phase
from ucm_cts.reference_models.model.runtime import Member


def phases_of(runtime: ObservedRuntime, member: Member) -> Iterator[Phase]:
    """The phases of ``member``, in the order in which they began."""
    begun = [startup for startup in runtime.executions.startups[member.body] if startup[1] is not None]
    for number, (enter, exit_) in enumerate(begun):
        start = _start_around(runtime, enter)
        if start is None or exit_ is None:
            continue
        after = (o for o in runtime.interactions.changes if o.step.undoes == "phase" and o.begin.n > enter.n)
        ending = next((o.begin for o in after if _may_end(member, o)), None)
        until, ended_at = (ending.n, ending.t) if ending is not None else (NEVER, runtime.interactions.latest)
        yield Phase(member, number, start, enter, exit_, until, ended_at, end_of_phase(runtime, member, enter))


def is_outside(runtime: ObservedRuntime, member: Member, n: int) -> bool:
    """Is the event before the component's first on_startup has returned, or after an operation that ended its last phase?"""
    begun = [startup for startup in runtime.executions.startups[member.body] if startup[0].n < n]
    if not begun:
        return True
    enter, exit_ = begun[-1]
    if exit_ is None or exit_.n > n:
        return True
    return end_of_phase(runtime, member, enter) < n


def noticed(runtime: ObservedRuntime, due: int | None) -> tuple[int, ...]:
    """The first event after ``due`` at which something entered a body, or a step began or ended: by then a callback had not come."""
    if due is None:
        return ()
    entered = ((e.enter.t, e.enter.n) for m in runtime.bodies.values() for e in runtime.executions.of(m.body))
    steps = (event for o in runtime.interactions.operations for event in (o.begin, o.end) if event is not None)
    known = (*entered, *((e.t, e.n) for e in (*steps, *runtime.interactions.pauses)))
    return tuple(n for _, n in sorted(one for one in known if one[0] >= due)[:1])


def end_of_phase(runtime: ObservedRuntime, member: Member, startup: Enter) -> int:
    """The event by which the operation returned that ended the phase, or the next phase began; later than all if none did.

    An operation that raised may have ended it all the same.
    """
    again = min(
        (enter.n for enter, _ in runtime.executions.startups[member.body] if enter.n > startup.n), default=NEVER
    )
    for operation in runtime.interactions.changes:
        step, end = operation.step, operation.end
        if operation.begin.n < startup.n or not isinstance(end, Return) or end.n > again:
            continue
        of_container = isinstance(step, s.Stop | s.RemoveContainer) and operation.container is member.container
        of_member = isinstance(step, s.RemoveComponent) and operation.member is member
        if of_container or of_member or isinstance(step, s.Destroy):
            return end.n
    return again


def _start_around(runtime: ObservedRuntime, enter: Enter) -> Operation | None:
    """The start that led to this on_startup and returned."""
    for operation in runtime.interactions.operations:
        end = operation.end
        if isinstance(operation.step, s.Start) and isinstance(end, Return) and operation.begin.n < enter.n < end.n:
            return operation
    return None


def _may_end(member: Member, operation: Operation) -> bool:
    """May ``operation`` end the phase of ``member``? Stopping the manager may reach all containers."""
    step = operation.step
    if isinstance(step, s.Stop | s.RemoveContainer):
        return step.container == s.MANAGER or operation.container is member.container
    return not isinstance(step, s.RemoveComponent) or operation.member in (None, member)
