"""When an operation ends: how its answer and its callbacks fit the rows of the life-cycle table (11.2.3, 12.10)."""

from __future__ import annotations

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.trace import Enter, Return
from ucm_cts.reference_models.model import operation as op
from ucm_cts.reference_models.model.expected_callbacks import LIFE_CYCLE_HOOKS, ExpectedCallbacks, Listener
from ucm_cts.reference_models.model.row_selection import listener_of
from ucm_cts.reference_models.model.runtime import Member, Runtime, lane

OF_ALL_MEMBERS: dict[str, s.Hook] = {"start": "on_startup", "stop": "on_shutdown"}
"""The operations that call all members of a container, and what they call."""


def conclude(runtime: Runtime, ongoing: op.OperationInProgress, end: op.Result, expected: ExpectedCallbacks) -> None:
    """Compare the operation with its rows: sets its ``outcome``, and whether it can be ``judged`` and is ``lost``."""
    answer = "return" if isinstance(end, Return) else end.error
    ongoing.end, outcome = end, op.OperationEnd(answer)
    ongoing.outcome = outcome
    if answer != "return" and answer not in op.DECLARED_ERRORS[ongoing.operation]:
        ongoing.judged, ongoing.lost = False, True
    elif ongoing.judged:
        _compare_answer(ongoing, outcome, expected)
    if ongoing.judged and answer == "return" and isinstance(ongoing.step, s.AddComponent):
        _compare_body(runtime, ongoing, outcome, ongoing.step.component)
    if ongoing.callbacks or len(runtime.containers) > 1:
        _find_intrusions(runtime, ongoing, outcome, expected)
    if ongoing.judged:
        if answer == "return" and ongoing.container.name == s.MANAGER and ongoing.operation in OF_ALL_MEMBERS:
            _reach_own(ongoing, outcome, expected)
        if not outcome.not_reached:
            _compare_callbacks(runtime, ongoing, outcome, expected)


def _compare_answer(ongoing: op.OperationInProgress, outcome: op.OperationEnd, expected: ExpectedCallbacks) -> None:
    answer = outcome.answer
    if ongoing.forgiving and answer == "UCM_ERROR":
        ongoing.judged, ongoing.lost = False, True
        return
    outcome.permitting = permitting = []
    for member, row in ongoing.roles:
        permitted = expected.answers_to(row)
        if answer not in permitted:
            outcome.forbidding = member, row, permitted
            ongoing.judged, ongoing.lost = False, True
            return
        permitting.append(row)
    outcome.permitted = True


def _compare_body(runtime: Runtime, ongoing: op.OperationInProgress, outcome: op.OperationEnd, component: str) -> None:
    new = [c for c in ongoing.callbacks if c.hook == "on_init" and c.body not in runtime.bodies]
    if new:
        outcome.initialised = new
        instances = {c.instance for c in new if c.component == component}
        outcome.right_body = len(instances) == 1 and all(c.component == component for c in new)
        ongoing.judged = outcome.right_body


def _life_cycle_callbacks(ongoing: op.OperationInProgress, component: str, instance: int | None) -> list[Enter]:
    return [c for c in ongoing.by_body.get((component, instance), ()) if c.hook in LIFE_CYCLE_HOOKS]


def _find_intrusions(
    runtime: Runtime, ongoing: op.OperationInProgress, outcome: op.OperationEnd, expected: ExpectedCallbacks
) -> None:
    """Instances that the operation does not concern are to receive nothing."""
    concerned = {id(m) for m, _ in ongoing.roles}
    strangers = [(c, i) for c, i in ongoing.by_body if id(runtime.bodies.get((c, i or 0))) not in concerned]
    if not strangers and len(runtime.containers) == 1:
        return
    are_all_concerned = not strangers and not runtime.shares_bodies
    called = {c.body for c in ongoing.callbacks if c.hook in LIFE_CYCLE_HOOKS}
    removes = ongoing.operation in ("remove_component", "remove_container")
    for member in runtime.present:
        if id(member) in concerned or member.gone or member.suspended:
            continue
        if removes and any(c.live is None for c in member.connections):
            continue
        elsewhere = member.container is not ongoing.container
        if member.body not in called:
            if elsewhere:
                outcome.others_undisturbed = True
                outcome.is_plain = outcome.is_plain and ongoing.operation not in ("start", "stop", "remove_container")
                if are_all_concerned:
                    return
            continue
        if elsewhere and ongoing.container.name == s.MANAGER and ongoing.operation in OF_ALL_MEMBERS:
            continue
        events = _life_cycle_callbacks(ongoing, member.component, member.instance)
        role = "elsewhere" if elsewhere else "bystander"
        requirement = expected.of(events[0].hook, role).unexpected
        outcome.is_plain = False
        outcome.intrusions = [*outcome.intrusions, op.Intrusion(member, events, requirement, elsewhere)]


def _reach_own(ongoing: op.OperationInProgress, outcome: op.OperationEnd, expected: ExpectedCallbacks) -> None:
    """Does a successful start or stop of the manager reach its own members (11.2.2.2)?"""
    hook = OF_ALL_MEMBERS[ongoing.operation]
    own = [(m, row) for m, row in ongoing.roles if m is not None and m.container is ongoing.container]
    due = [m for m, row in own if not row.missing and expected.always_calls(row, hook)]
    outcome.reached_own = any(ongoing.received(m, hook) for m in due)
    outcome.is_plain = outcome.is_plain and not due
    if not outcome.reached_own:
        outcome.not_reached = due


def _compare_callbacks(
    runtime: Runtime, ongoing: op.OperationInProgress, outcome: op.OperationEnd, expected: ExpectedCallbacks
) -> None:
    fitted: list[op.Fitted] = []
    outcome.fitted = fitted
    for member, row in ongoing.roles:
        component, instance, listener = _listener(runtime, ongoing, member)
        events = _life_cycle_callbacks(ongoing, component, instance) if ongoing.callbacks else []
        own = member is not None and member.container is ongoing.container
        if events and own and row.operation == "start":  # a late on_init or on_connect is configuration_first's matter
            events = [e for e in events if e.hook not in ("on_init", "on_connect")]
        hooks = tuple([e.hook for e in events]) if events else ()
        fit = expected.fit(row, outcome.answer, listener, hooks)
        if fit is not None:
            fitted.append((member, row, fit))
            if fit.readings:
                outcome.has_choices = True
            continue
        outcome.is_plain = False
        deviation = expected.deviation(row, outcome.answer, listener, hooks)
        who = lane(component, instance or 1)
        outcome.deviating = [*outcome.deviating, op.Deviating(member, row, who, events, deviation)]
        if member is None:
            ongoing.judged = False


def _listener(
    runtime: Runtime, ongoing: op.OperationInProgress, member: Member | None
) -> tuple[str, int | None, Listener]:
    """The body that a role is about, and what decides which callbacks it gets; a new instance has no member yet."""
    if member is not None:
        return member.component, member.instance, listener_of(ongoing, member)
    if not isinstance(ongoing.step, s.AddComponent):
        return "", None, listener_of(ongoing, None)
    component = ongoing.step.component
    wanted = runtime.scenario.components.get(component)
    fresh = (c.instance for c in ongoing.callbacks if c.component == component)
    instance = next((i for i in fresh if (component, i) not in runtime.bodies), None)
    return (
        component,
        instance,
        Listener(wanted.connectable, wanted.fragment, 0) if wanted is not None else listener_of(ongoing, None),
    )
