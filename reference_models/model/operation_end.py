"""When an operation ends: how its answer and its callbacks fit the rows of the life-cycle table (11.2.3, 12.10)."""

from __future__ import annotations

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.trace import Enter, Return
from ucm_cts.reference_models.model import operation as op
from ucm_cts.reference_models.model.expected_callbacks import LIFE_CYCLE_HOOKS, ExpectedCallbacks, Listener, listener
from ucm_cts.reference_models.model.hindrance import is_forgiving
from ucm_cts.reference_models.model.row_selection import listener_of
from ucm_cts.reference_models.model.runtime import Member, Runtime, lane

OF_ALL_MEMBERS: dict[str, s.Hook] = {"start": "on_startup", "stop": "on_shutdown"}
"""The operations that call all members of a container, and what they call."""


def conclude(runtime: Runtime, ongoing: op.OperationInProgress, end: op.Result, expected: ExpectedCallbacks) -> None:
    """Compare the operation with its rows: sets its ``outcome``, and whether it can be ``judged`` and is ``lost``."""
    answer = "return" if type(end) is Return else end.error  # type: ignore[union-attr]
    outcome = op.OperationEnd(answer)
    ongoing.end, ongoing.outcome = end, outcome
    if answer != "return" and answer not in op.DECLARED_ERRORS[ongoing.operation]:
        ongoing.judged, ongoing.lost = False, True
    elif ongoing.judged:
        _compare_answer(runtime, ongoing, outcome, expected)
    if ongoing.judged and answer == "return" and ongoing.operation == "add_component":
        _compare_body(runtime, ongoing, outcome, ongoing.step.component)  # type: ignore[union-attr]
    if ongoing.callbacks or len(runtime.containers) > 1:
        _find_intrusions(runtime, ongoing, outcome, expected)
    if ongoing.judged:
        if answer == "return" and ongoing.operation in OF_ALL_MEMBERS and ongoing.container.name == s.MANAGER:
            _reach_own(ongoing, outcome, expected)
        if not outcome.not_reached:
            _compare_callbacks(runtime, ongoing, outcome, expected)


def _compare_answer(
    runtime: Runtime, ongoing: op.OperationInProgress, outcome: op.OperationEnd, expected: ExpectedCallbacks
) -> None:
    answer = outcome.answer
    if answer == "UCM_ERROR" and is_forgiving(runtime, ongoing):
        ongoing.judged, ongoing.lost = False, True
        return
    outcome.permitting = permitting = []
    for member, row in ongoing.roles:
        permitted = expected.answers[id(row)]
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


def _life_cycle_callbacks(ongoing: op.OperationInProgress, body: tuple[str, int]) -> list[Enter]:
    return [c for c in ongoing.by_body.get(body, ()) if c.hook in LIFE_CYCLE_HOOKS]


def _find_intrusions(
    runtime: Runtime, ongoing: op.OperationInProgress, outcome: op.OperationEnd, expected: ExpectedCallbacks
) -> None:
    """Instances that the operation does not concern are to receive nothing."""
    concerned = {id(member) for member, _ in ongoing.roles}
    are_all_concerned = not runtime.shares_bodies
    for body in ongoing.by_body:
        if id(runtime.bodies.get(body)) not in concerned:
            are_all_concerned = False
            break
    else:
        if len(runtime.containers) == 1:
            return
    removes = ongoing.operation in ("remove_component", "remove_container")
    if are_all_concerned:  # nobody else received anything: it matters only whether somebody is elsewhere
        for member in runtime.elsewhere(ongoing.container):
            if id(member) not in concerned and not _is_unclear(member, removes):
                _note_undisturbed(ongoing, outcome)
                return
        return
    called = {c.body for c in ongoing.callbacks if c.hook in LIFE_CYCLE_HOOKS}
    for member in runtime.present:
        if id(member) in concerned or member.gone or _is_unclear(member, removes):
            continue
        is_elsewhere = member.container is not ongoing.container
        if member.body not in called:
            if is_elsewhere:
                _note_undisturbed(ongoing, outcome)
            continue
        if is_elsewhere and ongoing.container.name == s.MANAGER and ongoing.operation in OF_ALL_MEMBERS:
            continue
        events = _life_cycle_callbacks(ongoing, member.body)
        role = "elsewhere" if is_elsewhere else "bystander"
        requirement = expected.of(events[0].hook, role).unexpected
        outcome.is_plain = False
        outcome.intrusions = [*outcome.intrusions, op.Intrusion(member, events, requirement, is_elsewhere)]


def _is_unclear(member: Member, removes: bool) -> bool:
    """Is it open whether callbacks are due to an instance that is not concerned, as when something is removed that it may be connected to?"""
    return member.suspended or (removes and any(c.live is None for c in member.connections))


def _note_undisturbed(ongoing: op.OperationInProgress, outcome: op.OperationEnd) -> None:
    outcome.others_undisturbed = True
    outcome.is_plain = outcome.is_plain and ongoing.operation not in ("start", "stop", "remove_container")


def _reach_own(ongoing: op.OperationInProgress, outcome: op.OperationEnd, expected: ExpectedCallbacks) -> None:
    """Does a successful start or stop of the manager reach its own members (11.2.2.2)?"""
    hook = OF_ALL_MEMBERS[ongoing.operation]
    due = [
        member
        for member, row in ongoing.roles
        if member is not None
        and member.container is ongoing.container
        and not row.missing
        and expected.always_calls(row, hook)
    ]
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
        if member is not None:
            body, heard = member.body, listener_of(ongoing, member)
        else:
            body, heard = _newcomer(runtime, ongoing)
        received = ongoing.by_body.get(body)
        hooks: tuple[str, ...] = ()
        due: tuple[str, ...] = LIFE_CYCLE_HOOKS
        if received is not None:
            if row.operation == "start" and member is not None and member.container is ongoing.container:
                due = _DUE_AT_START
            hooks = tuple([e.hook for e in received if e.hook in due])
        fit = expected.fit(row, outcome.answer, heard, hooks)
        if fit is not None:
            fitted.append((member, row, fit))
            if fit.readings:
                outcome.has_choices = True
            continue
        outcome.is_plain = False
        deviation = expected.deviation(row, outcome.answer, heard, hooks)
        who, events = lane(body[0], body[1] or 1), [e for e in received or () if e.hook in due]
        outcome.deviating = [*outcome.deviating, op.Deviating(member, row, who, events, deviation)]
        if member is None:
            ongoing.judged = False


def _newcomer(runtime: Runtime, ongoing: op.OperationInProgress) -> tuple[tuple[str, int], Listener]:
    """The body that a role without an instance is about, and what decides which callbacks it gets: the one that add_component has made, if any."""
    if not isinstance(ongoing.step, s.AddComponent):
        return _NOBODY, listener_of(ongoing, None)
    component = ongoing.step.component
    wanted = runtime.scenario.components.get(component)
    body = next((b for b in ongoing.by_body if b[0] == component and b not in runtime.bodies), (component, 0))
    return body, listener(wanted.connectable, wanted.fragment, 0) if wanted is not None else listener_of(ongoing, None)


_NOBODY = ("", 0)
_DUE_AT_START = tuple(hook for hook in LIFE_CYCLE_HOOKS if hook not in ("on_init", "on_connect"))
"""A late on_init or on_connect is configuration_first's matter."""
