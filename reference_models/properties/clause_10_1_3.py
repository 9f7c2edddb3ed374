"""Properties about which execution policy a component has, and about what is left to the framework (10.1.3)."""

from __future__ import annotations

from collections.abc import Collection

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Declaration
from ucm_cts.adapters.contract.trace import Raise, Return, Stressed, Timeout
from ucm_cts.reference_models.conclusions import Concluded, Conclusions, Measured, takes
from ucm_cts.reference_models.model import execution_policies as policies
from ucm_cts.reference_models.model import executions as ex
from ucm_cts.reference_models.model.links import is_misfit
from ucm_cts.reference_models.model.method_calls import MethodCall
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.operation import OperationInProgress
from ucm_cts.reference_models.model.runtime import Container, Member, has_meaningless_values, lane, raises
from ucm_cts.reference_models.properties.declaration import Property, property_at

_RUN_IS_CALLED = "R-10.1.3.2-01"

_MILLISECOND = 1_000_000


_TREATMENTS = {
    "missing-execution-policy": ("which has no execution policy", "given a default one"),
    "second-active-policy": ("of which two ports are active", "allowed"),
}
"""Of options: the components concerned, and what happens to those that are not refused."""


@property_at("ended", "R-10.1.3-02", at=("add_component", "start"), feature="policies")
def execution_policy_given(check: Property, runtime: ObservedRuntime, ongoing: OperationInProgress) -> Concluded:
    """A component that says nothing of its execution is refused, or is given a policy by the framework."""
    option = "missing-execution-policy"
    declarations = runtime.scenario.components
    if not runtime.knows_policies:
        return ()
    if isinstance(ongoing.step, s.AddComponent):
        declaration = declarations.get(ongoing.step.component)
        if declaration is None or has_meaningless_values(declaration, ongoing.step):
            return ()
        is_open = not policies.protection_of(declaration) and not declaration.plan
        if is_open and ongoing.container.started is False and isinstance(ongoing.end, Raise):
            return _treated(check, runtime, ongoing, option, "refuse", ongoing.step.component)
        return ()
    without = ex.without_policy(runtime, ongoing.container)
    if without and isinstance(ongoing.end, Return) and ongoing.judged:
        return _treated(check, runtime, ongoing, option, "default", without[0].lane)
    if without and isinstance(ongoing.end, Raise) and _only_they_are_wrong((), runtime, ongoing.container):
        return _treated(check, runtime, ongoing, option, "refuse", without[0].lane)
    return ()


def _only_they_are_wrong(they: Collection[Member], runtime: ObservedRuntime, container: Container) -> bool:
    """May a start of ``container`` be refused for nothing but the policies that ``they`` have, or that members lack? Nobody is elsewhere, all others
    have at most one policy, all policies are of 10.1.3, and connections have equal ends.
    """
    members = container.live_members()
    elsewhere = any(c.live_members() for c in runtime.containers.values() if c is not container)
    if container.started is not False or elsewhere:
        return False
    is_plain = all((m in they or m.declaration.policies[1:] == ()) and not m.suspended for m in members)
    is_plain = is_plain and all(p.definition in policies.OF_THE_CORE for m in members for p in m.declaration.policies)
    differs = any(is_misfit(c) for m in members for c in m.connections if c.live is not False)
    return is_plain and not differs and not runtime.interactions.improper()


@property_at("ended", "R-9.4.3.2-06", at=("add_component", "start"), feature="policies")
def unknown_policy_refused(check: Property, runtime: ObservedRuntime, ongoing: OperationInProgress) -> Conclusions:
    """A component with a policy that the framework does not know is refused, at the latest when it is to be started."""
    if runtime.ics.reading("unknown-policy") != "refused":
        return
    if isinstance(ongoing.step, s.AddComponent):
        declaration = runtime.scenario.components.get(ongoing.step.component)
        if declaration is not None and policies.has_unknown_policy(declaration) and isinstance(ongoing.end, Raise):
            yield check.kept()
        return
    members = [m for m in ongoing.container.live_members() if policies.has_unknown_policy(m.declaration)]
    if members and isinstance(ongoing.end, Raise):
        yield check.kept()
    elif members:
        yield check.fail(
            "started",
            expected=f"'{members[0].lane}', which has a policy that no framework knows, is not started",
            observed="start returned",
            event=ongoing.end,
        )


def _treated(
    check: Property, runtime: ObservedRuntime, ongoing: OperationInProgress, option: str, reading: str, who: str
) -> Conclusions:
    """The framework treats component ``who`` by a ``reading`` of ``option``."""
    if not (yield from takes(runtime, option, reading)):
        what, accepted = _TREATMENTS[option]
        refused = reading == "refuse"
        yield check.fail(
            reading,
            expected=f"'{who}', {what}, is {accepted if refused else 'refused'}, as declared",
            observed=f"it was {'refused' if refused else 'started'}",
            event=ongoing.end,
        )
    elif option == "missing-execution-policy":
        yield check.kept()


@property_at("ended", "R-10.1.3-03", at=("add_component", "start"), feature="policies")
def active_policies(check: Property, runtime: ObservedRuntime, ongoing: OperationInProgress) -> Concluded:
    """A component with the active policy on several ports is refused, or started, as declared."""
    option = "second-active-policy"
    if isinstance(ongoing.step, s.AddComponent):
        declaration = runtime.scenario.components.get(ongoing.step.component)
        is_open = declaration is not None and _is_active_twice(declaration) and ongoing.container.started is False
        if is_open and isinstance(ongoing.end, Raise):
            return _treated(check, runtime, ongoing, option, "refuse", ongoing.step.component)
        return ()
    twice = [m for m in ongoing.container.live_members() if _is_active_twice(m.declaration)]
    if twice and ongoing.judged and isinstance(ongoing.end, Return):
        return _treated(check, runtime, ongoing, option, "allow", twice[0].lane)
    if twice and isinstance(ongoing.end, Raise) and _only_they_are_wrong(twice, runtime, ongoing.container):
        return _treated(check, runtime, ongoing, option, "refuse", twice[0].lane)
    return ()


def _is_active_twice(declaration: Declaration) -> bool:
    """Has it nothing beside the active policy on several ports, and no callback that fails?"""
    is_active = all(p.definition == s.ACTIVE and p.port is not None for p in declaration.policies)
    fails = raises(declaration, "on_init", "set_container_interface")
    return is_active and not fails and len(policies.managed_ports(declaration)) > 1


@property_at("began", _RUN_IS_CALLED)
def runs_again(check: Property, runtime: ObservedRuntime, execution: ex.Execution) -> Conclusions:
    """run is called more than once a start, unless the vendor declares that it is called once."""
    enter = execution.enter
    is_extended = policies.extended_policy(runtime.scenario.components[enter.component]) is not None
    if execution.way != "run" or execution.met or is_extended:
        return
    since = runtime.executions.runs_since_start(enter.body)
    if len(since) > 1 and not (yield from takes(runtime, "run-trigger", "repeated")):
        yield check.fail(
            "repeated",
            expected=f"run of '{lane(*enter.body)}' is called once a start, as declared",
            observed="it was called again",
            at=(since[0].enter.n, enter.n),
        )


@property_at("waited", _RUN_IS_CALLED, timed=True)
def runs_no_more(check: Property, runtime: ObservedRuntime, event: Timeout) -> Conclusions:
    """run was called once and not again within most of the scenario's patience, although it returned."""
    step = runtime.scenario.steps[event.step]
    patience = runtime.scenario.patience
    if not isinstance(step, s.ReachGate):
        return
    for member in runtime.present:
        runs = runtime.executions.runs_since_start(member.body)
        plan = member.declaration.plan.get("run", ())
        if not member.serving or len(runs) != 1 or s.HoldAtGate(step.gate) not in plan or s.RaiseError() in plan:
            continue
        if policies.extended_policy(member.declaration) is not None:
            continue
        is_long_over = runs[0].over and event.t - runs[0].left > patience * _MILLISECOND / 2
        if is_long_over and not (yield from takes(runtime, "run-trigger", "once")):
            yield check.fail(
                "once",
                expected=f"run of '{member.lane}' is called again and again, as declared",
                observed=f"it was called once, and not again within {patience} ms",
                at=(runs[0].enter.n, event.n),
                step=event.step,
            )


@property_at("began", *policies.CALL_EXCLUSIONS)
def circle_entered(check: Property, runtime: ObservedRuntime, execution: ex.Execution) -> Concluded:
    """A call came back to the component whose execution waits for it, and was let in, which is the framework's choice."""
    if execution.call is None:
        return ()
    if runtime.executions.is_alone(execution) and not runtime.interactions.calls:
        return ()  # who waits for a call is inside; a message may come to a body that has pushed it and gone on
    body = execution.enter.body
    waiting = [c for c in execution.call.callers(execution.enter.n) if c.enter.body == body]
    member = runtime.bodies.get(body)
    if waiting and member is not None:
        return _returned_to(
            check, runtime, member, waiting[0], execution.way, "enter", (waiting[0].enter.n, execution.enter.n)
        )
    return ()


@property_at("completed", *policies.CALL_EXCLUSIONS)
def circle_refused(check: Property, runtime: ObservedRuntime, call: MethodCall) -> Concluded:
    """A call came back to the component whose execution waits for it, and was refused."""
    reply = call.reply
    if reply is not None and reply.raised and not call.deliveries:
        return _returned(check, runtime, call.business, "refuse", (call.business.n, reply.n))
    return ()


@property_at("closed", *policies.CALL_EXCLUSIONS)
def circle_waits(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """A call came back to the component whose execution waits for it, and both were still waiting in the end."""
    for call in runtime.executions.pending:
        yield from _returned(check, runtime, call, "wait", (call.n,))


def _returned(
    check: Property, runtime: ObservedRuntime, call: ex.BusinessCall, reading: str, events: tuple[int, ...]
) -> Conclusions:
    callers = list(call.callers())
    for member, port in ex.goals_of(runtime, call):
        body = member.body
        for caller in callers:
            if caller.enter.body == body:
                yield from _returned_to(check, runtime, member, caller, port, reading, events)
                return


def _returned_to(
    check: Property,
    runtime: ObservedRuntime,
    member: Member,
    waiting: ex.Execution,
    port: str,
    reading: str,
    events: tuple[int, ...],
) -> Conclusions:
    requirement = policies.exclusion(member.declaration, runtime.ics, waiting.way, port)
    if not ex.is_guarded(runtime.ics, waiting):
        return
    if requirement and not (yield from takes(runtime, "protected-recursion", reading)):
        yield check.fail(
            reading,
            expected=f"what is declared of calls that come back to '{member.lane}' while it waits for them: "
            f"protected-recursion = {runtime.ics.reading('protected-recursion')}",
            observed={"enter": "one was let in", "refuse": "one was refused", "wait": "one waited for ever"}[reading],
            at=events,
            requirement=requirement,
        )


@property_at("stressed", *policies.CALL_EXCLUSIONS)
def no_overlap_under_stress(check: Property, runtime: ObservedRuntime, event: Stressed) -> Conclusions:
    """Callers that stress a protected component never meet inside."""
    step = runtime.scenario.steps[event.step]
    assert isinstance(step, s.Stress)
    members = {runtime.reference(ref)[1] for ref in step.refs}
    member = members.pop() if len(members) == 1 else None
    if member is None or not member.serving:
        return
    ports = [runtime.ports[ref] for ref in step.refs]
    requirement = policies.exclusion(member.declaration, runtime.ics, ports[0], ports[-1])
    if not ex.guards_direct_calls(runtime.ics):
        return
    if not requirement:
        if event.overlaps and policies.protection_of(member.declaration) == "unprotected":
            yield check.kept("R-10.1.3.2-20")
        return
    yield Measured("calls stressed", event.calls)
    if event.overlaps:
        yield check.fail(
            "tiny hole",
            expected=f"callers of {' and '.join(dict.fromkeys(ports))} are never in '{member.lane}' at a time",
            observed=f"they met there {event.overlaps} times in {event.calls} calls",
            event=event,
            requirement=requirement,
        )
    elif event.control_overlaps and event.calls:
        yield check.kept(requirement)
        yield Measured("calls stressed beside a control that was found out", event.calls)
