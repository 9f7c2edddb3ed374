"""Properties about execution policies: exclusion where overlap was provoked, run, and calls that had to wait (10.1.3)."""

from __future__ import annotations

import itertools
import statistics

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Declaration, HoldAtGate
from ucm_cts.adapters.contract.trace import Enter, Raise, Return, Timeout
from ucm_cts.reference_models.conclusions import Concluded, Conclusions, Measured, Taken, takes
from ucm_cts.reference_models.model import execution_policies as policies
from ucm_cts.reference_models.model import executions as ex
from ucm_cts.reference_models.model.method_calls import NEVER, Delivery
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.operation import Ongoing, OperationInProgress, Result
from ucm_cts.reference_models.model.runtime import has_meaningless_values, lane, raises
from ucm_cts.reference_models.model.service_policies import BESIDE_EXECUTION, policies_of
from ucm_cts.reference_models.properties.declaration import Property, property_at

_REENTERED, _RUN_IS_CALLED, _RUN_PHASE = "R-10.1.3.2-20", "R-10.1.3.2-01", "R-10.1.3.2-02"
_RUN_ALONE = "R-10.1.3.2-05"
_UNPROMPTED = "R-10.1.3.2-03"
_ONE_POLICY, _ONE_EXTENDED = "R-10.1.3-03", "R-10.5.1-23"

_SUPPORT = {
    "self-executing": "R-10.1.3.1-12",
    "active": "R-10.1.3.1-13",
    "passive": "R-10.1.3.1-14",
    "unprotected": "R-10.1.3.1-15",
}
_BY_ITSELF = {"passive": "R-10.1.3.2-14", "unprotected": "R-10.1.3.2-19", "active": "R-10.1.3.2-24"}

_INTERVALS = 3
"""So many usual intervals a run must be held inside, and so many are needed to know what is usual."""

_BEYOND = 300_000_000
"""A run that is held for this many nanoseconds beyond the usual interval is held long enough, too."""


@property_at("began", *policies.EXCLUSIONS)
def no_reentry(check: Property, runtime: ObservedRuntime, execution: ex.Execution) -> Conclusions:
    """A protected component is not entered while it is executed, unless the execution's own calls lead back into it."""
    enter = execution.enter
    declaration = runtime.scenario.components[enter.component]
    for other in execution.met:
        requirement = policies.exclusion(declaration, runtime.ics, execution.way, other.way)
        if requirement and ex.is_guarded(runtime.ics, execution, other):
            yield check.fail(
                f"{other.way} {execution.way}",
                expected=f"nothing else executes '{lane(*enter.body)}' while its {other.way} is executed",
                observed=f"its {execution.way} was entered by another thread meanwhile",
                at=(other.enter.n, enter.n),
                requirement=requirement,
            )
            return


@property_at("began", _REENTERED)
def overlap_possible(check: Property, runtime: ObservedRuntime, execution: ex.Execution) -> Concluded:
    """Two callers may be inside an unprotected passive component, which is reported and not required."""
    if (
        execution.met
        and policies.protection_of(runtime.scenario.components[execution.enter.component]) == "unprotected"
    ):
        return (Taken("unprotected-concurrency", "concurrent"), check.kept(), Measured("overlaps provoked"))
    return ()


@property_at("over", *policies.EXCLUSIONS)
def kept_out(check: Property, runtime: ObservedRuntime, execution: ex.Execution, end: int) -> Conclusions:
    """An execution was held, a call that was to execute the same body had been made, and did not until the first ended."""
    enter = execution.enter
    for call in execution.waited:
        for member, port in ex.goals_of(runtime, call):
            own = member.body == enter.body
            requirement = policies.exclusion(member.declaration, runtime.ics, execution.way, port) if own else ""
            inside = any(e.body == enter.body for e, _ in call.entries)
            if requirement and not inside:
                yield check.kept(requirement)
                yield Measured("exclusions proved")


@property_at("delivered", *policies.CALL_EXCLUSIONS)
def message_kept_out(check: Property, runtime: ObservedRuntime, delivery: Delivery) -> Conclusions:
    """A message was pushed while its receiver was executed, time passed, and it came in when the execution had ended."""
    call, receiver = delivery.call, delivery.receiver
    if call is None or receiver is None or not call.is_message:
        return
    enter = delivery.enter
    for execution in runtime.executions.past.get(enter.body, ()):
        was_there = execution.enter.n < call.request.n
        if was_there and _time_passed(runtime, call.request.n, execution.end) and enter.port is not None:
            requirement = policies.exclusion(receiver.declaration, runtime.ics, execution.way, enter.port)
            if requirement:
                yield check.kept(requirement)
                yield Measured("exclusions proved")


def _time_passed(runtime: ObservedRuntime, begin: int, end: int) -> bool:
    """Did the scenario let time pass between these events?"""
    return any(begin < pause.n < end for pause in runtime.interactions.pauses)


@property_at("over", _REENTERED)
def callers_meet(check: Property, runtime: ObservedRuntime, execution: ex.Execution, end: int) -> Conclusions:
    """A call that waits while an unprotected component is executed is kept out, which is wrong if callers are declared to meet."""
    enter = execution.enter
    body = enter.body
    if policies.protection_of(runtime.scenario.components[enter.component]) != "unprotected":
        return
    for call in execution.waited:
        inside = any(e.body == body for e, _ in call.entries)
        if inside or not _time_passed(runtime, call.n, end):
            continue
        if not (yield from takes(runtime, "unprotected-concurrency", "may-serialise")):
            yield check.fail(
                "kept out",
                expected=f"callers of '{lane(*body)}', which is not protected, meet inside, as declared",
                observed="one waited while another one was held there",
                at=(enter.n, call.n, end),
            )


@property_at("began", _RUN_ALONE, "R-10.5.2-18")
def run_kept_out(check: Property, runtime: ObservedRuntime, execution: ex.Execution) -> Concluded:
    """A run was held inside for several of the intervals at which run is called, and no other execution began."""
    runs = [run for run in execution.earlier if run.over]
    if execution.way != "run" or execution.met or len(runs) < _INTERVALS:
        return ()
    begun = [run.enter.t for run in (*runs, execution)]
    usual = statistics.median(later - earlier for earlier, later in itertools.pairwise(begun))
    enough = min(_INTERVALS * usual, usual + _BEYOND)
    if any(run.left - run.enter.t >= enough for run in runs):
        declaration = runtime.scenario.components[execution.enter.component]
        return check.kept(policies.exclusion(declaration, runtime.ics, "run", "run"))
    return ()


@property_at("over", _RUN_ALONE)
def single_run_kept_out(check: Property, runtime: ObservedRuntime, execution: ex.Execution, end: int) -> Concluded:
    """Where run is declared to be called once a start: it was held inside while the scenario let time pass, and no other execution began."""
    once = execution.way == "run" and runtime.ics.reading("run-trigger") == "once"
    if not once or execution.met or not _time_passed(runtime, execution.enter.n, end):
        return ()
    declaration = runtime.scenario.components[execution.enter.component]
    if policies.extended_policy(declaration) is not None:
        return ()
    return check.kept(policies.exclusion(declaration, runtime.ics, "run", "run"))


@property_at("served", "R-10.1.3.2-17", timed=True)
def waiting_calls_served(
    check: Property, runtime: ObservedRuntime, call: ex.BusinessCall, waited: ex.Execution, end: int
) -> Concluded:
    """A call that had to wait for an execution is served when it has ended; ``end`` is 0 if the call never came back."""
    enter = waited.enter
    declaration = runtime.scenario.components[enter.component]
    protection = policies.protection_of(declaration)
    if protection in ("", "unprotected") or (protection == "active" and policies.extended_policy(declaration)):
        return ()  # an active component of 10.5 may refuse calls that come early
    if end and any(e.body == enter.body for e, _ in call.entries):
        return check.kept()
    ending = runtime.interactions.ends_phases(call.n, end or NEVER)
    if ending or not all(member.serving for member, _ in ex.goals_of(runtime, call)):
        return ()  # a component that is being stopped serves no call
    return check.fail(
        "refused" if end else "never",
        expected=f"the call that waits while '{lane(*enter.body)}' is executed is carried out afterwards",
        observed="it ended without having been carried out" if end else "it did not end",
        at=(enter.n, call.n, *((end,) if end else ())),
    )


@property_at("answered", "R-10.1.3.2-07", "R-10.1.3.2-08", "R-10.1.3.2-15", "R-10.1.3.2-21", feature="policies")
def calls_carried_out(check: Property, runtime: ObservedRuntime, call: ex.BusinessCall, end: Result) -> Conclusions:
    """A call through a port that the policy speaks of enters the body once, there, with the value sent; its result comes back."""
    member, port = call.callee, call.port
    if member is None or port is None or not call.possible or not member.serving or member.raises("exchange"):
        return
    guaranteed = policies.call_guarantees(member.declaration, port)
    own = [(e, x) for e, x in call.entries if e.body == member.body]
    if not guaranteed or (call.waited and not own):  # a call that waits in vain is the matter of waiting_calls_served
        return
    right = [x for e, x in own if e.port == port and e.value == call.value and x is not None]
    if len(own) == len(right) == 1 and isinstance(end, Return) and end.value == right[0].value:
        for requirement in guaranteed:
            yield check.kept(requirement)
        return
    if not own and isinstance(end, Raise) and runtime.is_being_ended(member):
        return  # a component that is being stopped serves no call
    entered = ", ".join(f"{e.port} with {e.value}" for e, _ in own) or "nothing"
    came_back = end.value if isinstance(end, Return) else end.error
    yield check.fail(
        "not served" if not own else "otherwise",
        expected=f"exchange({call.value}) through {port} executes '{member.lane}' there, once, and brings back its result",
        observed=f"it executed {entered}, and brought back {came_back}",
        at=(call.n, end.n),
        requirement=guaranteed[0],
    )


@property_at("called", *_BY_ITSELF.values(), feature="policies")
def no_self_execution(
    check: Property, runtime: ObservedRuntime, ongoing: Ongoing, event: Enter, call: ex.BusinessCall | None
) -> Concluded:
    """A passive or active component is executed only when it is called."""
    member = runtime.bodies.get(event.body)
    requirement = _BY_ITSELF.get(policies.protection_of(member.declaration), "") if member is not None else ""
    if member is None or not requirement or member.suspended or policies.extended_policy(member.declaration):
        return ()
    if call is not None:
        return check.kept(requirement)
    return check.fail(
        "no caller",
        expected=f"'{member.lane}' is executed because it is called",
        observed=f"its {event.port} was entered with {event.value} without a call",
        at=(event.n,),
        requirement=requirement,
    )


@property_at("ended", *_SUPPORT.values(), at=("add_component", "start"), feature="policies")
def policy_supported(check: Property, runtime: ObservedRuntime, ongoing: OperationInProgress) -> Conclusions:
    """A component with an execution policy is added and started like any other."""
    if isinstance(ongoing.step, s.AddComponent):
        declaration = runtime.scenario.components.get(ongoing.step.component)
        may_be_added = ongoing.container.started is False
        if not isinstance(ongoing.end, Raise) or declaration is None or not may_be_added:
            return
        if not has_meaningless_values(declaration, ongoing.step):
            yield from _refused(check, declaration, ongoing.end)
        return
    if not isinstance(ongoing.end, Return) or not ongoing.judged:
        return
    for member in ongoing.container.live_members():
        hooks = [c.hook for c in ongoing.by_body.get(member.body, ())]
        requirement = _support(member.declaration)
        if requirement and "on_startup" in hooks:
            yield check.kept(requirement)


def _support(declaration: Declaration) -> str:
    """The requirement by which a policy of 10.1.3 is supported; empty for those of 10.5."""
    extended = policies.extended_policy(declaration)
    return "" if extended is not None else _SUPPORT.get(policies.protection_of(declaration), "")


def _refused(check: Property, declaration: Declaration, end: Raise) -> Conclusions:
    requirement = _support(declaration)
    active = sum(policy.definition == s.ACTIVE for policy in declaration.policies)
    excused = policies.is_contradictory(declaration) or active > 1  # may count as two policies
    excused = excused or bool(policies_of(declaration, *BESIDE_EXECUTION)) or policies.has_unknown_policy(declaration)
    if requirement and not excused and not raises(declaration, "on_init", "set_container_interface"):
        expected = f"a component with the policy {declaration.policies[0].definition} is added"
        yield check.refused("add_component", end, expected=expected, requirement=requirement)


@property_at("ended", _ONE_POLICY, _ONE_EXTENDED, at=("add_component", "start"), feature="policies")
def one_execution_policy(check: Property, runtime: ObservedRuntime, ongoing: OperationInProgress) -> Conclusions:
    """A component with two execution policies is refused when it is added, or at the latest when it is to be started."""
    if isinstance(ongoing.step, s.AddComponent):
        declaration = runtime.scenario.components.get(ongoing.step.component)
        if declaration is not None and policies.is_contradictory(declaration) and isinstance(ongoing.end, Raise):
            yield check.kept(_one_policy(declaration))
        return
    members = [m for m in ongoing.container.live_members() if policies.is_contradictory(m.declaration)]
    if members and isinstance(ongoing.end, Raise):
        yield check.kept(_one_policy(members[0].declaration))
    for member in members if isinstance(ongoing.end, Return) else ():
        yield check.fail(
            "started",
            expected=f"'{member.lane}', which has two execution policies, is not started",
            observed="start returned",
            event=ongoing.end,
            requirement=_one_policy(member.declaration),
        )


def _one_policy(declaration: Declaration) -> str:
    return _ONE_POLICY if policies.extended_policy(declaration) is None else _ONE_EXTENDED


@property_at("began", _RUN_IS_CALLED, _RUN_PHASE, _UNPROMPTED)
def run_phases(check: Property, runtime: ObservedRuntime, execution: ex.Execution) -> Conclusions:
    """run is called on an operational component, and needs neither connections nor callers."""
    enter = execution.enter
    member = runtime.bodies.get(enter.body)
    declaration = runtime.scenario.components[enter.component]
    if enter.hook != "run" or (member is not None and member.suspended) or policies.extended_policy(declaration):
        return
    if member is not None and runtime.may_run(member):
        yield check.kept()
        yield check.kept(_RUN_PHASE)
        if not member.connections and not member.served:
            yield check.kept(_UNPROMPTED)
        return
    who = lane(*enter.body)
    yield check.fail(
        "not operational",
        expected=f"run of '{who}' begins after its on_startup returned and before stop returned",
        observed="run began outside the operational phase",
        at=(enter.n,),
        requirement=_RUN_PHASE,
    )


@property_at("waited", _RUN_IS_CALLED, _UNPROMPTED, timed=True)
def run_triggered(check: Property, runtime: ObservedRuntime, event: Timeout) -> Conclusions:
    """Once started, a self-executing component is executed within the scenario's patience."""
    step = runtime.scenario.steps[event.step]
    if not isinstance(step, s.ReachGate):
        return
    for member in runtime.present:
        if policies.extended_policy(member.declaration) is not None:
            continue
        runs = runtime.executions.runs_since_start(member.body)
        if member.serving and not runs and HoldAtGate(step.gate) in member.declaration.plan.get("run", ()):
            unprompted = not member.connections and not member.served
            for requirement in (_RUN_IS_CALLED, *((_UNPROMPTED,) if unprompted else ())):
                yield check.fail(
                    "never",
                    expected=f"run of '{member.lane}', which is ready, is called",
                    observed=f"it was not within {runtime.scenario.patience} ms",
                    event=event,
                    requirement=requirement,
                )
            return
