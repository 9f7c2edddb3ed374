"""Properties about the callbacks of component bodies, Connectable bodies and fragments (11.2.1, 11.2.3)."""

from __future__ import annotations

from collections.abc import Sequence

from ucm_cts.reference_models.conclusions import Broken, Concluded, Conclusions, Suspended
from ucm_cts.reference_models.findings import Arrow, Finding
from ucm_cts.reference_models.model import operation as op
from ucm_cts.reference_models.model.callback_history import Callback
from ucm_cts.reference_models.model.expected_callbacks import CONNECTABLE_HOOKS, LIFE_CYCLE_HOOKS
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.operation_end import OF_ALL_MEMBERS
from ucm_cts.reference_models.model.runtime import Member, lane, raises
from ucm_cts.reference_models.properties.declaration import Property, property_at, requirements

_READY_BY_START, _ENDED_BY_SHUTDOWN = "R-11.2.3-09", "R-11.2.1.2-10"

_ELSEWHERE, _OF_THE_MANAGER = "R-11.1.3-04", "R-11.2.2.2-01"
_FROM_TABLE = (
    _ELSEWHERE,
    _OF_THE_MANAGER,
    _READY_BY_START,
    _ENDED_BY_SHUTDOWN,
    *requirements("""
    R-11.2.1.2-04 R-11.2.1.2-06 R-11.2.1.3-02 R-11.2.1.3-03 R-11.2.1.3-05 R-11.2.1.4-01
    R-11.2.2.1-11 R-11.2.2.1-12 R-11.2.2.2-04 R-11.2.2.2-05 R-11.2.3-01 R-11.2.3-05 R-11.2.3-07
    R-11.2.3-12 R-11.2.3-15
"""),
)


@property_at("ended", *_FROM_TABLE, even_after_removal=True)
def callbacks(check: Property, runtime: ObservedRuntime, ongoing: op.OperationInProgress) -> Concluded:
    """Each instance receives exactly the callbacks that the life-cycle table asks for, in its order."""
    outcome = ongoing.outcome
    if outcome.is_plain and len(outcome.fitted) == 1:  # the common case
        return outcome.fitted[0][2]
    fits = [fit for _, _, fit in outcome.fitted]
    return fits if outcome.is_plain else (*fits, *_peculiarities(check, ongoing, outcome))


def _peculiarities(check: Property, ongoing: op.OperationInProgress, outcome: op.OperationEnd) -> Conclusions:
    for intrusion in outcome.intrusions:
        yield _intrudes(check, ongoing, intrusion)
        yield Suspended(intrusion.member)
    if outcome.others_undisturbed and ongoing.operation in ("start", "stop", "remove_container"):
        yield check.kept(_ELSEWHERE)
    if outcome.reached_own:
        yield check.kept(_OF_THE_MANAGER)
    elif outcome.not_reached:
        yield _reaches_no_member(check, ongoing, outcome.not_reached)
        yield from map(Suspended, outcome.not_reached)
    for role in outcome.deviating:
        yield Broken(role.row)
        yield _deviates(check, ongoing, role)
        if role.member is not None:
            yield Suspended(role.member)


def _deviates(check: Property, ongoing: op.OperationInProgress, role: op.Deviating) -> Finding:
    _, row, who, events, deviation = role
    hook, operation, container = deviation.hook, ongoing.operation, ongoing.container.name
    if deviation.missing:
        instead = [Arrow(container, who, hook)]
        offending = [ongoing.end.n]
        cause, observed = f"{row.operation} without {hook}", f"{operation} ended without {hook} on '{who}'"
    elif hook:
        instead = [Arrow(container, "test", f"return without {hook}")]
        offending = [e.n for e in events if e.hook == hook]
        times = f" {len(offending)} times" if len(offending) > 1 else ""
        cause, observed = f"{hook} by {row.id}", f"{operation} called {hook}{times} on '{who}', which was {row.state}"
    else:
        instead = [Arrow(container, who, h) for h in deviation.wanted]
        offending = [e.n for e in events]
        cause, observed = f"{row.operation} order", f"{operation} called {', '.join(e.hook for e in events)} on '{who}'"
    situation = f"{row.state}, {row.condition}" if row.condition else row.state
    return check.fail(
        cause,
        expected=f"{operation} calls {', '.join(deviation.wanted) or 'nothing'} on '{who}' ({situation})",
        observed=observed,
        at=tuple(offending),
        step=ongoing.step_number,
        instead=tuple(instead),
        requirement=deviation.requirement,
    )


def _intrudes(check: Property, ongoing: op.OperationInProgress, intrusion: op.Intrusion) -> Finding:
    operation, who, hook = ongoing.operation, intrusion.member.lane, intrusion.events[0].hook
    other = "another container" if intrusion.elsewhere else "another instance"
    return check.fail(
        f"{hook} by another's {operation}",
        expected=f"{operation} on {other} leaves {who} alone",
        observed=f"{who} received {hook} during {operation}",
        at=tuple(e.n for e in intrusion.events),
        step=ongoing.step_number,
        instead=(Arrow(ongoing.container.name, "test", f"no callback on {who}"),),
        requirement=intrusion.requirement,
    )


def _reaches_no_member(check: Property, ongoing: op.OperationInProgress, members: Sequence[Member]) -> Finding:
    """A successful start or stop of the manager reaches none of its own members (11.2.2.2)."""
    hook = OF_ALL_MEMBERS[ongoing.operation]
    return check.fail(
        f"manager without {hook}",
        expected=f"{ongoing.operation} of the manager calls {hook} on its own members",
        observed=f"{ongoing.operation} returned and none of {', '.join(m.lane for m in members)} received {hook}",
        ended=ongoing,
        instead=tuple(Arrow(ongoing.container.name, m.lane, hook) for m in members),
        requirement=_OF_THE_MANAGER,
    )


def _is_stray(runtime: ObservedRuntime, callback: Callback) -> bool:
    """Does a life-cycle callback come to an instance while no operation of the container is in progress?"""
    member = callback.member
    if callback.ongoing is not None or member is None or member.suspended or member.gone:
        return False
    # An instance that is just being joined by a connector is connected, too.
    return not (callback.event.hook in CONNECTABLE_HOOKS and runtime.interactions.is_joining)


@property_at("entered", "R-11.1.1-01", "R-11.1.2-01", at=LIFE_CYCLE_HOOKS)
def whole_life(check: Property, runtime: ObservedRuntime, callback: Callback) -> Concluded:
    """Life-cycle callbacks come during operations of the container; a whole life has them in order."""
    event, member, ongoing, history = callback
    if ongoing is not None and event.hook != "on_remove":
        return ()
    of_component, of_fragment = check.stands_for
    declaration = runtime.scenario.components.get(event.component)
    requirement = of_fragment if declaration is not None and declaration.fragment else of_component
    if member is None:
        return ()
    if _is_stray(runtime, callback):
        finding = check.fail(
            f"stray {event.hook}",
            expected=f"{event.hook} comes during an operation of the container",
            observed=f"{member.lane} received {event.hook} while no operation was in progress",
            at=(event.n,),
            requirement=requirement,
        )
        return finding, Suspended(member)
    if ongoing is not None and not member.suspended and history.is_whole_life:
        return check.kept(requirement)
    return ()


def outside_life(runtime: ObservedRuntime, callback: Callback) -> str:
    """When a callback comes that is not to come before on_init or after on_remove; empty if it may come."""
    event, member, ongoing, history = callback
    early, late = event.hook != "on_init" and not history.initialised, history.removed
    if not (early or late) or (early and ongoing is not None and not ongoing.judged):
        return ""
    removal = ongoing.by_body.get(event.body, ()) if late and ongoing is not None else ()
    if any(c.hook == "on_remove" for c in removal):
        return ""  # within the removal itself it is a matter of order
    if member is not None and (member.suspended or _is_stray(runtime, callback)):
        return ""
    return "after on_remove" if late else "before on_init"


@property_at("entered", "R-11.2.1.2-01", at=LIFE_CYCLE_HOOKS)
def nothing_outside_life(check: Property, runtime: ObservedRuntime, callback: Callback) -> Concluded:
    """No callback before on_init or after on_remove."""
    event, member, ongoing, history = callback
    if event.hook == "on_remove" and history.first == "on_init" and not history.removed:
        return check.kept()
    when = outside_life(runtime, callback)
    if not when:
        return ()
    who = lane(*event.body)
    finding = check.fail(
        f"{event.hook} {when}",
        expected=f"{who} receives no callback {when}",
        observed=f"{who} received {event.hook}",
        during=(ongoing, event),
    )
    return (finding, Suspended(member)) if member is not None else (finding,)


@property_at("unclear", _READY_BY_START, _ENDED_BY_SHUTDOWN, at=("on_startup", "on_shutdown"))
def alternation(check: Property, runtime: ObservedRuntime, callback: Callback) -> Concluded:
    """No second on_startup without on_shutdown between, no on_shutdown without on_startup before, even in an unclear state."""
    event, member, ongoing, history = callback
    if ongoing is None or member is None or not member.suspended:
        return ()  # the table's matter, or whole_life's
    declaration = runtime.scenario.components.get(event.component)
    if declaration is None or raises(declaration, "on_startup", "on_shutdown", "on_init"):
        return ()
    if history.in_operation == (event.hook == "on_shutdown"):
        return ()
    return check.fail(
        event.hook,
        expected=f"on_startup and on_shutdown of {member.lane} alternate",
        observed=f"{event.hook} came after {', '.join(history.phases) or 'neither'}",
        during=(ongoing, event),
        requirement=_READY_BY_START if event.hook == "on_startup" else _ENDED_BY_SHUTDOWN,
    )


@property_at("entered", "R-12.10-22", at=LIFE_CYCLE_HOOKS)
def discarded(check: Property, runtime: ObservedRuntime, callback: Callback) -> Concluded:
    """A body that a failed add_component made receives nothing more but its on_remove."""
    event = callback.event
    if event.body not in runtime.discarded or event.hook == "on_remove":
        return ()
    return check.fail(
        event.hook,
        expected=f"a failed add_component leaves nothing behind of {lane(*event.body)}",
        observed=f"its body received {event.hook} later",
        during=(callback.ongoing, event),
    )
