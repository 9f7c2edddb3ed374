"""Properties about the callbacks of component bodies, Connectable bodies and fragments (11.2.1, 11.2.3)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_values import read_spelled, spell
from ucm_cts.adapters.contract.trace import Enter, Reference, Return, Siblings
from ucm_cts.reference_models.conclusions import Broken, Conclusions, Suspended
from ucm_cts.reference_models.findings import Arrow, Finding
from ucm_cts.reference_models.model.callback_history import CallbackHistory
from ucm_cts.reference_models.model.expected_callbacks import CONNECTABLE_HOOKS, LIFE_CYCLE_HOOKS
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.operation import Deviating, Intrusion, OperationEnd, OperationInProgress, Result
from ucm_cts.reference_models.model.operation_end import OF_ALL_MEMBERS
from ucm_cts.reference_models.model.runtime import Member, lane, raises
from ucm_cts.reference_models.properties.declaration import Property, property_at
from ucm_cts.reference_models.properties.operations import listing_problem

_ELSEWHERE, _OF_THE_MANAGER = "R-11.1.3-04", "R-11.2.2.2-01"
_FROM_TABLE = [
    _ELSEWHERE,
    "R-11.2.1.2-04",
    "R-11.2.1.2-06",
    "R-11.2.1.2-10",
    "R-11.2.1.3-02",
    "R-11.2.1.3-03",
    "R-11.2.1.3-05",
    "R-11.2.1.4-01",
    "R-11.2.2.1-11",
    "R-11.2.2.1-12",
    _OF_THE_MANAGER,
    "R-11.2.2.2-04",
    "R-11.2.2.2-05",
    "R-11.2.3-01",
    "R-11.2.3-05",
    "R-11.2.3-09",
    "R-11.2.3-07",
    "R-11.2.3-12",
    "R-11.2.3-15",
]


@property_at("ended", *_FROM_TABLE)
def callbacks(check: Property, runtime: ObservedRuntime, ongoing: OperationInProgress, end: Result) -> Conclusions:
    """Each instance receives exactly the callbacks that the life-cycle table asks for, in its order."""
    outcome = ongoing.outcome
    fits = [fit for _, _, fit in outcome.fitted]
    return fits if outcome.is_plain else (*fits, *_peculiarities(check, ongoing, outcome, end))


def _peculiarities(check: Property, ongoing: OperationInProgress, outcome: OperationEnd, end: Result) -> Conclusions:
    for intrusion in outcome.intrusions:
        yield _intrudes(check, ongoing, intrusion)
        yield Suspended(intrusion.member)
    if outcome.others_undisturbed and ongoing.operation in ("start", "stop", "remove_container"):
        yield check.kept(_ELSEWHERE)
    if outcome.reached_own:
        yield check.kept(_OF_THE_MANAGER)
    elif outcome.not_reached:
        yield _reaches_nobody(check, ongoing, outcome.not_reached, end.n)
        yield from map(Suspended, outcome.not_reached)
    for role in outcome.deviating:
        yield Broken(role.row)
        yield _deviates(check, ongoing, role, end)
        if role.member is not None:
            yield Suspended(role.member)


def _deviates(check: Property, ongoing: OperationInProgress, role: Deviating, end: Result) -> Finding:
    _, row, who, events, deviation = role
    hook, operation, container = deviation.hook, ongoing.operation, ongoing.container.name
    if deviation.missing:
        instead = [Arrow(container, who, hook)]
        offending = [end.n]
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


def _intrudes(check: Property, ongoing: OperationInProgress, intrusion: Intrusion) -> Finding:
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


def _reaches_nobody(check: Property, ongoing: OperationInProgress, members: Sequence[Member], end: int) -> Finding:
    """A successful start or stop of the manager reaches none of its own members (11.2.2.2)."""
    hook = OF_ALL_MEMBERS[ongoing.operation]
    return check.fail(
        f"manager without {hook}",
        expected=f"{ongoing.operation} of the manager calls {hook} on its own members",
        observed=f"{ongoing.operation} returned and none of {', '.join(m.lane for m in members)} received {hook}",
        at=(ongoing.call, end),
        step=ongoing.step_number,
        instead=tuple(Arrow(ongoing.container.name, m.lane, hook) for m in members),
        requirement=_OF_THE_MANAGER,
    )


def _is_stray(runtime: ObservedRuntime, ongoing: OperationInProgress | None, event: Enter, member: Member) -> bool:
    """Does a life-cycle callback come while no operation of the container is in progress?"""
    if ongoing is not None or member.suspended or member.gone:
        return False  # whoever is joined by a connector is connected, too
    return not (event.hook in CONNECTABLE_HOOKS and runtime.interactions.is_joining)


@property_at("entered", "R-11.1.1-01", "R-11.1.2-01", at=LIFE_CYCLE_HOOKS)
def whole_life(
    check: Property,
    runtime: ObservedRuntime,
    ongoing: OperationInProgress | None,
    event: Enter,
    history: CallbackHistory,
) -> Conclusions:
    """Life-cycle callbacks come during operations of the container; a whole life has them in order."""
    if ongoing is not None and event.hook != "on_remove":
        return ()
    of_component, of_fragment = check.stands_for
    declaration = runtime.scenario.components.get(event.component)
    requirement = of_fragment if declaration is not None and declaration.fragment else of_component
    member = runtime.member_of(event.component, event.instance)
    if member is None:
        return ()
    if _is_stray(runtime, ongoing, event, member):
        finding = check.fail(
            f"stray {event.hook}",
            expected=f"{event.hook} comes during an operation of the container",
            observed=f"{member.lane} received {event.hook} while no operation was in progress",
            at=(event.n,),
            requirement=requirement,
        )
        return finding, Suspended(member)
    if ongoing is not None and not member.suspended and history.is_whole_life:
        return (check.kept(requirement),)
    return ()


def _outside_life(
    runtime: ObservedRuntime, ongoing: OperationInProgress | None, event: Enter, history: CallbackHistory
) -> str:
    """When a callback comes that is not to come before on_init or after on_remove; empty if it may come."""
    early, late = event.hook != "on_init" and not history.initialised, history.removed
    if not (early or late) or (early and ongoing is not None and not ongoing.judged):
        return ""
    body = event.component, event.instance
    removal = ongoing.by_body.get(body, ()) if late and ongoing is not None else ()
    if any(c.hook == "on_remove" for c in removal):
        return ""  # within the removal itself it is a matter of order
    member = runtime.member_of(*body)
    if member is not None and (member.suspended or _is_stray(runtime, ongoing, event, member)):
        return ""
    return "after on_remove" if late else "before on_init"


@property_at("entered", "R-11.2.1.2-01", at=LIFE_CYCLE_HOOKS)
def nothing_outside_life(
    check: Property,
    runtime: ObservedRuntime,
    ongoing: OperationInProgress | None,
    event: Enter,
    history: CallbackHistory,
) -> Conclusions:
    """No callback before on_init or after on_remove."""
    if event.hook == "on_remove" and history.first == "on_init" and not history.removed:
        return (check.kept(),)
    when = _outside_life(runtime, ongoing, event, history)
    if not when:
        return ()
    who, member = lane(event.component, event.instance), runtime.member_of(event.component, event.instance)
    finding = check.fail(
        f"{event.hook} {when}",
        expected=f"{who} hears nothing {when}",
        observed=f"{who} received {event.hook}",
        at=(event.n,),
        step=ongoing.step_number if ongoing else None,
    )
    return (finding, Suspended(member)) if member is not None else (finding,)


@property_at("unclear", "R-11.2.3-09", "R-11.2.1.2-10", at=("on_startup", "on_shutdown"))
def alternation(
    check: Property,
    runtime: ObservedRuntime,
    ongoing: OperationInProgress | None,
    event: Enter,
    history: CallbackHistory,
) -> Conclusions:
    """No second on_startup without on_shutdown between, no on_shutdown without on_startup before: whatever else is unclear."""
    started_again, not_started = check.stands_for
    member = runtime.member_of(event.component, event.instance)
    if ongoing is None or member is None or not member.suspended:
        return ()  # the table's matter, or whole_life's
    declaration = runtime.scenario.components.get(event.component)
    if declaration is None or raises(declaration, "on_startup", "on_shutdown", "on_init"):
        return ()
    if history.in_operation == (event.hook == "on_shutdown"):
        return ()
    return (
        check.fail(
            event.hook,
            expected="on_startup and on_shutdown alternate",
            observed=f"{event.hook} after {', '.join(history.phases) or 'neither'}",
            at=(event.n,),
            step=ongoing.step_number,
            requirement=started_again if event.hook == "on_startup" else not_started,
        ),
    )


@property_at("entered", "R-12.10-22", at=LIFE_CYCLE_HOOKS)
def discarded(
    check: Property,
    runtime: ObservedRuntime,
    ongoing: OperationInProgress | None,
    event: Enter,
    history: CallbackHistory,
) -> Conclusions:
    """What a failed add_component made hears nothing more but its on_remove."""
    if (event.component, event.instance) not in runtime.discarded or event.hook == "on_remove":
        return ()
    return (
        check.fail(
            event.hook,
            expected="a failed add_component leaves nothing behind",
            observed=f"its body received {event.hook} later",
            at=(event.n,),
            step=ongoing.step_number if ongoing else None,
        ),
    )


_UNDOING = ("disconnect", "remove_component", "remove_container", "destroy")
_SHOWN = 3
"""So many attributes are told of."""


@property_at("entered", "R-11.2.1.2-05", "R-10.1.1-06", at=("on_init",), feature="attributes")
def attributes_before_init(
    check: Property,
    runtime: ObservedRuntime,
    ongoing: OperationInProgress | None,
    event: Enter,
    history: CallbackHistory,
) -> Conclusions:
    """On entry to on_init the body holds the configured attribute values."""
    if history.initialised:
        return
    declaration = runtime.scenario.components.get(event.component)
    if declaration is None or not declaration.attributes:
        return
    held = event.attributes or {}
    wrong = [a for a, value in declaration.attributes.items() if not _is_configured(held.get(a), value)]
    if not wrong:
        yield check.kept("R-11.2.1.2-05")
    else:
        yield _holds_others(check, "R-11.2.1.2-05", declaration, wrong, held, event, ongoing)
    typed = {a for a, value in declaration.attributes.items() if read_spelled(value) is not None}
    if typed and not typed.intersection(wrong):
        yield check.kept("R-10.1.1-06")
    elif typed:
        yield _holds_others(check, "R-10.1.1-06", declaration, [a for a in wrong if a in typed], held, event, ongoing)


def _is_configured(held: str | None, configured: str) -> bool:
    """Is it what was configured? A value of a type may have been read, and spelled anew."""
    value, own = read_spelled(configured), read_spelled(held)
    return held == configured or (value is not None and own is not None and spell(value) == spell(own))


def _holds_others(
    check: Property,
    requirement: str,
    declaration: s.Declaration,
    wrong: list[str],
    held: Mapping[str, str],
    event: Enter,
    ongoing: OperationInProgress | None,
) -> Finding:
    some = wrong[:_SHOWN]
    return check.fail(
        "missing" if all(a not in held for a in wrong) else "another value",
        expected="on_init finds " + ", ".join(f"{a}={declaration.attributes[a]}" for a in some),
        observed="on_init found " + ", ".join(f"{a}={held[a]}" if a in held else f"{a} unset" for a in some),
        at=(event.n,),
        step=ongoing.step_number if ongoing else None,
        requirement=requirement,
    )


@property_at("ended", "R-11.2.1.2-08", at=("start",))
def configuration_first(
    check: Property, runtime: ObservedRuntime, ongoing: OperationInProgress, end: Result
) -> Conclusions:
    """Once start has started a member, nothing of the container is initialised or connected any more."""
    if not isinstance(end, Return):
        return ()
    own = [m for m in ongoing.container.live_members() if m.instance is not None] if ongoing.callbacks else []
    late = [c for m in own for c in (*ongoing.received(m, "on_init"), *ongoing.received(m, "on_connect"))]
    if late:
        return (
            check.fail(
                late[0].hook,
                expected="when start is called, every member is initialised and connected",
                observed=f"{late[0].component} received {late[0].hook} during start",
                at=tuple(c.n for c in late),
                step=ongoing.step_number,
            ),
        )
    if sum(bool(ongoing.received(m, "on_startup")) for m in own) > 1:
        return (check.kept(),)
    return ()


@property_at("entered", "R-11.2.1.3-04", at=("on_connect",))
def connect_arguments(
    check: Property,
    runtime: ObservedRuntime,
    ongoing: OperationInProgress | None,
    event: Enter,
    history: CallbackHistory,
) -> Conclusions:
    """on_connect is given the port element's name and the reference that connect was given."""
    if ongoing is None or not isinstance(ongoing.step, s.Connect):
        return ()
    member = ongoing.subject
    if (
        member is None
        or member.suspended
        or _outside_life(runtime, ongoing, event, history)
        or (member.component, member.instance) != (event.component, event.instance)
    ):
        return ()
    reference, _ = runtime.reference(ongoing.step.to)
    wrong = event.port != ongoing.step.port
    wrong_reference = event.reference is None or (
        isinstance(event.reference, Reference) and isinstance(reference, Reference) and event.reference != reference
    )
    if not wrong and not wrong_reference:
        return (check.kept(),)
    return (
        check.fail(
            "name" if wrong else "reference",
            expected=f"on_connect({ongoing.step.port}, {_show(reference)})",
            observed=f"on_connect({event.port}, {_show(event.reference)})",
            at=(event.n,),
            step=ongoing.step_number,
            instead=(
                Arrow(ongoing.container.name, member.lane, f"on_connect({ongoing.step.port}, {_show(reference)})"),
            ),
        ),
    )


@property_at("entered", "R-11.2.1.3-06", at=("on_disconnect",))
def disconnect_arguments(
    check: Property,
    runtime: ObservedRuntime,
    ongoing: OperationInProgress | None,
    event: Enter,
    history: CallbackHistory,
) -> Conclusions:
    """on_disconnect is given the name of the port element whose connection is undone."""
    if ongoing is None:
        return ()
    member = runtime.member_of(event.component, event.instance)
    if member is None or member.suspended or _outside_life(runtime, ongoing, event, history):
        return ()
    if ongoing.operation not in _UNDOING:  # that it came at all is then the fault
        return ()
    undone = [ongoing.connection] if ongoing.connection is not None else member.connections
    ports = {c.port for c in undone if c.live is not False}
    if not ports:
        return ()
    if event.port in ports:
        return (check.kept(),)
    wanted = " or ".join(sorted(ports))
    return (
        check.fail(
            "name",
            expected=f"on_disconnect({wanted})",
            observed=f"on_disconnect({event.port})",
            at=(event.n,),
            step=ongoing.step_number,
            instead=(Arrow(ongoing.container.name, member.lane, f"on_disconnect({wanted})"),),
        ),
    )


@property_at("entered", "R-11.2.1.4-02", at=("on_startup", "set_container_interface"), feature="fragments")
def container_interface(
    check: Property,
    runtime: ObservedRuntime,
    ongoing: OperationInProgress | None,
    event: Enter,
    history: CallbackHistory,
) -> Conclusions:
    """A fragment gets its container's interface exactly once, before on_startup."""
    declaration = runtime.scenario.components.get(event.component)
    if declaration is None or not declaration.fragment:
        return ()
    given = history.interfaces
    first_start = event.hook == "on_startup" and not history.begun
    again = event.hook == "set_container_interface" and given > 0
    if first_start and given == 1:
        return (check.kept(),)
    if again or (first_start and given == 0):
        return (
            check.fail(
                "twice" if again else "never",
                expected="set_container_interface comes once, before on_startup",
                observed="set_container_interface came again"
                if again
                else "on_startup came without set_container_interface",
                at=(event.n,) if again else tuple(sorted({history.first_at or event.n, event.n})),
                step=ongoing.step_number if ongoing else None,
                instead=(
                    Arrow(ongoing.container.name if ongoing else "manager", event.component, "set_container_interface"),
                ),
            ),
        )
    return ()


@property_at("noted", "R-11.2.1.4-03")
def siblings(
    check: Property, runtime: ObservedRuntime, ongoing: OperationInProgress | None, event: Siblings
) -> Conclusions:
    """What a fragment learns of its container's members is what they are, unless an operation is changing that."""
    member = runtime.member_of(event.component, event.instance)
    if ongoing is not None or member is None or not member.declaration.fragment:
        return ()
    if member.suspended or not member.operational:
        return ()
    problem = "the query failed" if event.raised else listing_problem(runtime, member.container, event.ids)
    if problem is None:
        return (check.kept(),)
    return (
        check.fail(
            problem.split()[0],
            expected=f"the fragment sees {[m.id for m in member.container.live_members()]}",
            observed=f"the fragment sees {list(event.ids)}: {problem}",
            at=(event.n,),
        ),
    )


def _show(reference: object) -> str:
    if isinstance(reference, Reference):
        return f"{lane(reference.component, reference.instance)}.{reference.port}"
    return "nil" if reference is None else str(reference)
