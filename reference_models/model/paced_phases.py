"""Finds in a trace when components with a policy of 10.5 were executed."""

from __future__ import annotations

from collections.abc import Iterator

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.trace import Exit
from ucm_cts.reference_models.model.execution_policies import extended_policy, managed_ports
from ucm_cts.reference_models.model.executions import (
    BusinessCall,
    Execution,
    goals_of,
    guards_direct_calls,
    is_guarded,
)
from ucm_cts.reference_models.model.method_calls import NEVER, Operation
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.operational_phase import Phase
from ucm_cts.reference_models.model.paced_events import MILLISECOND, Invocation, PacedExecution, PacedPhase
from ucm_cts.reference_models.model.phases import phases_of
from ucm_cts.reference_models.model.runtime import Member


def paced_phases(runtime: ObservedRuntime, *definitions: str) -> list[PacedPhase]:
    """All phases of components with one of the policies ``definitions``, or any of 10.5, in the order in which they began."""
    if runtime.paced_phases is None:
        runtime.paced_phases = list(_phases(runtime))
    return [p for p in runtime.paced_phases if not definitions or p.policy.definition in definitions]


def granularity(runtime: ObservedRuntime) -> int:
    """By how many nanoseconds an execution may be early."""
    return int(runtime.ics.tolerance("timer-granularity") * MILLISECOND)


def lateness(runtime: ObservedRuntime) -> int:
    """By how many nanoseconds an execution may be late."""
    return int(runtime.ics.tolerance("timer-lateness") * MILLISECOND)


def shown(nanoseconds: float) -> str:
    """A time as findings show it."""
    return (
        f"{nanoseconds / MILLISECOND:g} ms" if nanoseconds % MILLISECOND == 0 else f"{nanoseconds / MILLISECOND:.1f} ms"
    )


def _phases(runtime: ObservedRuntime) -> Iterator[PacedPhase]:
    invocations = list(_invocations(runtime))
    for member in runtime.bodies.values():
        policy = extended_policy(member.declaration)
        if policy is None or member.suspended:
            continue
        for phase in phases_of(runtime, member):
            yield _phase(runtime, phase, policy, invocations)


def _phase(runtime: ObservedRuntime, of: Phase, policy: s.Policy, invocations: list[Invocation]) -> PacedPhase:
    member, enter, until, ended_at, closed = of.member, of.startup, of.until, of.ended_at, of.closed
    origins = _origins(runtime, of.start, of.started, of.number)
    phase = PacedPhase(member, policy, of.number, origins, enter.n, until, ended_at, closed)
    phase.invocations = [i for i in invocations if i.n < until and _is_for(runtime, i, member) and _lasts(i, enter.n)]
    by_execution = {id(e): i for i in phase.invocations for e in i.executions}
    managed = managed_ports(member.declaration)
    for execution in runtime.executions.of(member.body):
        if not enter.n < execution.enter.n < closed:
            continue
        is_paced = execution.way == "run" or execution.way in managed
        if is_paced and not _leads_back(execution) and is_guarded(runtime.ics, execution):
            left = execution.left if execution.over else max(ended_at, execution.enter.t)
            found = phase.executions if execution.enter.n < until else phase.at_its_end
            found.append(PacedExecution(execution, left, by_execution.get(id(execution))))
        elif execution.enter.n < until:
            phase.others.append(execution)
    return phase


def _origins(runtime: ObservedRuntime, start: Operation, startup: Exit, number: int) -> tuple[int, int]:
    """Between which instants the one lies from which the offset counts."""
    assert start.end is not None
    called, returned = start.begin.t, start.end.t
    reading = runtime.ics.reading("offset-origin")
    if reading == "start-call":
        return called, startup.t
    if reading == "startup":
        return startup.t, returned
    if reading == "start-return":
        return startup.t, returned  # the return is recorded some time after it
    if reading == "system" and number == 0:
        starts = [o for o in runtime.interactions.operations if isinstance(o.step, s.Start)]
        return starts[0].begin.t, returned
    return called, returned


def _invocations(runtime: ObservedRuntime) -> Iterator[Invocation]:
    """All calls and messages through port elements that are known."""
    called_at = {o.begin.n: o for o in runtime.interactions.operations if isinstance(o.step, s.Invoke)}
    messages = {id(call.business): call for call in runtime.interactions.calls}
    entered = dict[int, list[Execution]]()
    for member in runtime.bodies.values():
        for execution in runtime.executions.of(member.body):
            if execution.call is not None:
                entered.setdefault(id(execution.call), []).append(execution)
    for call in runtime.executions.calls:
        executions = entered.get(id(call), [])
        operation = called_at.get(call.n)
        if call.request is not None:
            method = messages.get(id(call))
            moment = call.request.t
            over = method.over if method is not None else _over(call)
        elif operation is not None:
            method, moment = None, operation.begin.t
            over = operation.end.n if operation.end is not None else NEVER
        else:
            continue
        if call.by == "test" and not guards_direct_calls(runtime.ics):
            continue
        port = executions[0].enter.port or "" if executions else call.port or ""
        yield Invocation(call.n, moment, port, call, method, over, executions)


def _over(call: BusinessCall) -> int:
    ends = [exit_.n for _, exit_ in call.entries if exit_ is not None]
    return max(ends, default=NEVER)


def _is_for(runtime: ObservedRuntime, invocation: Invocation, member: Member) -> bool:
    """Is it meant for a managed port element of ``member``?"""
    managed = managed_ports(member.declaration)
    if any(e.enter.body == member.body for e in invocation.executions):
        return any(e.enter.body == member.body and e.way in managed for e in invocation.executions)
    if invocation.message is not None:
        return any(end.member is member and end.port in managed for end, _ in invocation.message.targets)
    return any(goal is member and port in managed for goal, port in goals_of(runtime, invocation.call))


def _lasts(invocation: Invocation, begin: int) -> bool:
    """Was it still asked for when the phase began, or later?"""
    entered = max((e.enter.n for e in invocation.executions), default=invocation.over)
    return entered > begin


def _leads_back(execution: Execution) -> bool:
    """Did an execution of the component itself make the call?"""
    callers = execution.call.callers() if execution.call is not None else ()
    return any(caller.enter.body == execution.enter.body for caller in callers)
