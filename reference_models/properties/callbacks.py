"""Properties about the callbacks of component bodies, Connectable bodies and fragments (11.2.1, 11.2.3)."""

from __future__ import annotations

from collections.abc import Mapping

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_values import read_spelled, spell
from ucm_cts.adapters.contract.trace import Enter, Raise, Reference, Return, Siblings
from ucm_cts.reference_models.findings import Arrow
from ucm_cts.reference_models.model.callback_history import CallbackHistory
from ucm_cts.reference_models.model.expected_callbacks import CONNECTABLE_HOOKS, LIFE_CYCLE_HOOKS, Deviation, Listener
from ucm_cts.reference_models.model.life_cycle import Row
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.operation_effects import received
from ucm_cts.reference_models.model.row_selection import undone_by
from ucm_cts.reference_models.model.runtime import Member, OperationInProgress, lane, raises
from ucm_cts.reference_models.properties.declaration import property_at
from ucm_cts.reference_models.properties.operations import listing_problem
from ucm_cts.reference_models.verdicts import Verdicts

_FROM_DUTIES = [
    "R-11.1.3-04",
    "R-11.2.1.2-04",
    "R-11.2.1.2-06",
    "R-11.2.1.2-10",
    "R-11.2.1.3-02",
    "R-11.2.1.3-03",
    "R-11.2.1.3-05",
    "R-11.2.1.4-01",
    "R-11.2.2.1-11",
    "R-11.2.2.1-12",
    "R-11.2.2.2-01",
    "R-11.2.2.2-04",
    "R-11.2.2.2-05",
    "R-11.2.3-01",
    "R-11.2.3-05",
    "R-11.2.3-09",
    "R-11.2.3-07",
    "R-11.2.3-12",
    "R-11.2.3-15",
]


def _observed(ongoing: OperationInProgress, component: str, instance: int | None) -> list[Enter]:
    return [c for c in ongoing.by_body.get((component, instance), ()) if c.hook in LIFE_CYCLE_HOOKS]


@property_at("ended", *_FROM_DUTIES)
def callbacks(verdicts: Verdicts, runtime: ObservedRuntime, ongoing: OperationInProgress, end: Return | Raise) -> None:
    """Each instance receives exactly the callbacks that the life-cycle table asks for, in its order."""
    answer = "return" if isinstance(end, Return) else end.error
    if ongoing.callbacks or len(runtime.containers) > 1:
        _others(verdicts, runtime, ongoing)
    if not ongoing.judged or (
        ongoing.operation in _OF_ALL and _manager_forgot_its_own(verdicts, ongoing, answer, end.n)
    ):
        return
    for member, row in ongoing.roles:
        component, instance, listener = _listener(runtime, ongoing, member)
        events = _observed(ongoing, component, instance) if ongoing.callbacks else []
        own = member is not None and member.container is ongoing.container
        if events and own and row.operation == "start":  # a late on_init or on_connect is configuration_first's matter
            events = [e for e in events if e.hook not in ("on_init", "on_connect")]
        hooks = tuple([e.hook for e in events]) if events else ()
        fit = verdicts.expected.fit(row, answer, listener, hooks)
        if fit is None:
            verdicts.broken(row)
            who = lane(component, instance or 1)
            _deviates(
                verdicts, ongoing, row, who, verdicts.expected.deviation(row, answer, listener, hooks), events, end
            )
            if member is not None:
                member.suspended = True
            else:
                ongoing.judged = False
            continue
        verdicts.fitted(fit)
        ongoing.fitted.append((member, row, fit))


_OF_ALL: dict[str, s.Hook] = {"start": "on_startup", "stop": "on_shutdown"}
_UNDOING = ("disconnect", "remove_component", "remove_container", "destroy")
_NOBODY = Listener(False, False, 0)
_LISTENERS = {
    (connectable, fragment, undone): Listener(connectable, fragment, undone)
    for connectable in (False, True)
    for fragment in (False, True)
    for undone in range(3)
}


def _listener(
    runtime: ObservedRuntime, ongoing: OperationInProgress, member: Member | None
) -> tuple[str, int | None, Listener]:
    """The body that a role is about, and what decides which callbacks it gets; a new instance has no member yet."""
    if member is not None:
        undone = len(undone_by(ongoing, member)) if member.connections else 0
        declaration = member.declaration
        listener = _LISTENERS.get((declaration.connectable, declaration.fragment, undone))
        if listener is None:
            listener = Listener(declaration.connectable, declaration.fragment, undone)
        return member.component, member.instance, listener
    if not isinstance(ongoing.step, s.AddComponent):
        return "", None, _NOBODY
    component = ongoing.step.component
    wanted = runtime.scenario.components.get(component)
    fresh = (c.instance for c in ongoing.callbacks if c.component == component)
    instance = next((i for i in fresh if (component, i) not in runtime.bodies), None)
    return component, instance, Listener(wanted.connectable, wanted.fragment, 0) if wanted is not None else _NOBODY


def _deviates(
    verdicts: Verdicts,
    ongoing: OperationInProgress,
    row: Row,
    who: str,
    deviation: Deviation,
    events: list[Enter],
    end: Return | Raise,
) -> None:
    hook, operation, container = deviation.hook, ongoing.operation, ongoing.container.name
    if deviation.missing:
        instead = [Arrow(container, who, hook)]
        cause, observed, offending = (
            f"{row.operation} without {hook}",
            f"{operation} ended without {hook} on '{who}'",
            [end.n],
        )
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
    verdicts.violated(
        deviation.requirement,
        "callbacks",
        cause,
        f"{operation} calls {', '.join(deviation.wanted) or 'nothing'} on '{who}' ({situation})",
        observed,
        tuple(offending),
        ongoing.step_number,
        tuple(instead),
    )


def _others(verdicts: Verdicts, runtime: ObservedRuntime, ongoing: OperationInProgress) -> None:
    """Instances the operation does not concern receive nothing."""
    concerned = {id(m) for m, _ in ongoing.roles}
    strangers = [(c, i) for c, i in ongoing.by_body if id(runtime.bodies.get((c, i or 0))) not in concerned]
    if not strangers and len(runtime.containers) == 1:
        return
    told = {(c.component, c.instance) for c in ongoing.callbacks if c.hook in LIFE_CYCLE_HOOKS}
    undisturbed_elsewhere = False
    for member in runtime.present:
        if id(member) in concerned or member.gone or member.suspended:
            continue
        if any(c.live is None for c in member.connections) and ongoing.operation in (
            "remove_component",
            "remove_container",
        ):
            continue
        elsewhere = member.container is not ongoing.container
        if (member.component, member.instance) not in told:
            undisturbed_elsewhere = undisturbed_elsewhere or elsewhere
            continue
        events = _observed(ongoing, member.component, member.instance)
        if elsewhere and ongoing.container.name == s.MANAGER and ongoing.operation in ("start", "stop"):
            continue
        hook = events[0].hook
        role = "elsewhere" if elsewhere else "bystander"
        member.suspended = True
        verdicts.violated(
            verdicts.expected.of(hook, role).unexpected,
            "callbacks",
            f"{hook} by another's {ongoing.operation}",
            f"{ongoing.operation} on {'another container' if elsewhere else 'another instance'} leaves {member.lane} alone",
            f"{member.lane} received {hook} during {ongoing.operation}",
            tuple(e.n for e in events),
            ongoing.step_number,
            (Arrow(ongoing.container.name, "test", f"no callback on {member.lane}"),),
        )
    if undisturbed_elsewhere and ongoing.operation in ("start", "stop", "remove_container"):
        verdicts.exercised("R-11.1.3-04")


def _manager_forgot_its_own(verdicts: Verdicts, ongoing: OperationInProgress, answer: str, end: int) -> bool:
    """A successful start or stop of the manager that reaches none of its own members (11.2.2.2)."""
    hook = _OF_ALL[ongoing.operation]
    if answer != "return" or ongoing.container.name != s.MANAGER:
        return False
    due = [
        m
        for m, row in ongoing.roles
        if m is not None
        and not row.missing
        and m.container is ongoing.container
        and verdicts.expected.always_calls(row, hook)
    ]
    if not due:
        return False
    if any(received(ongoing, m, hook) for m in due):
        verdicts.exercised("R-11.2.2.2-01")
        return False
    for member in due:
        member.suspended = True
    verdicts.violated(
        "R-11.2.2.2-01",
        "callbacks",
        f"manager without {hook}",
        f"{ongoing.operation} of the manager calls {hook} on its own members",
        f"{ongoing.operation} returned and none of {', '.join(m.lane for m in due)} received {hook}",
        (ongoing.call, end),
        ongoing.step_number,
        tuple(Arrow(ongoing.container.name, m.lane, hook) for m in due),
    )
    return True


@property_at("entered", "R-11.1.1-01", "R-11.1.2-01", at=LIFE_CYCLE_HOOKS)
def whole_life(
    verdicts: Verdicts,
    runtime: ObservedRuntime,
    ongoing: OperationInProgress | None,
    event: Enter,
    history: CallbackHistory,
) -> None:
    """Life-cycle callbacks come during operations of the container; a whole life has them in order."""
    if ongoing is not None and event.hook != "on_remove":
        return
    declaration = runtime.scenario.components.get(event.component)
    requirement = "R-11.1.2-01" if declaration is not None and declaration.fragment else "R-11.1.1-01"
    member = runtime.member_of(event.component, event.instance)
    if ongoing is None:
        if member is None or member.suspended or member.gone:
            return
        if event.hook in CONNECTABLE_HOOKS and runtime.interactions.is_joining:
            return  # whoever is joined by a connector is connected, too
        member.suspended = True
        verdicts.violated(
            requirement,
            "whole_life",
            f"stray {event.hook}",
            f"{event.hook} comes during an operation of the container",
            f"{member.lane} received {event.hook} while no operation was in progress",
            (event.n,),
        )
    elif member is not None and not member.suspended and history.is_whole_life:
        verdicts.exercised(requirement)


@property_at("entered", "R-11.2.1.2-01", at=LIFE_CYCLE_HOOKS)
def nothing_outside_life(
    verdicts: Verdicts,
    runtime: ObservedRuntime,
    ongoing: OperationInProgress | None,
    event: Enter,
    history: CallbackHistory,
) -> None:
    """No callback before on_init or after on_remove."""
    if event.hook == "on_remove" and history.first == "on_init" and not history.removed:
        verdicts.exercised("R-11.2.1.2-01")
        return
    early = event.hook != "on_init" and not history.initialised
    late = history.removed
    if not (early or late):
        return
    if (
        late
        and ongoing is not None
        and any(
            c.hook == "on_remove" and (c.component, c.instance) == (event.component, event.instance)
            for c in ongoing.callbacks
        )
    ):
        return  # within the removal itself it is a matter of order
    member = runtime.member_of(event.component, event.instance)
    if member is not None and member.suspended:
        return
    if early and ongoing is not None and not ongoing.judged:
        return
    who = lane(event.component, event.instance)
    verdicts.violated(
        "R-11.2.1.2-01",
        "nothing_outside_life",
        f"{event.hook} {'after on_remove' if late else 'before on_init'}",
        f"{who} hears nothing {'after on_remove' if late else 'before on_init'}",
        f"{who} received {event.hook}",
        (event.n,),
        ongoing.step_number if ongoing else None,
    )
    if member is not None:
        member.suspended = True


@property_at("entered", "R-11.2.3-09", "R-11.2.1.2-10", at=("on_startup", "on_shutdown"))
def alternation(
    verdicts: Verdicts,
    runtime: ObservedRuntime,
    ongoing: OperationInProgress | None,
    event: Enter,
    history: CallbackHistory,
) -> None:
    """No second on_startup without on_shutdown between, no on_shutdown without on_startup before: whatever else is unclear."""
    member = runtime.member_of(event.component, event.instance)
    if verdicts.findings or ongoing is None or member is None or not member.suspended:
        return  # the table's matter, or whole_life's
    declaration = runtime.scenario.components.get(event.component)
    if declaration is None or raises(declaration, "on_startup", "on_shutdown", "on_init"):
        return
    if history.in_operation == (event.hook == "on_shutdown"):
        return
    verdicts.violated(
        "R-11.2.3-09" if event.hook == "on_startup" else "R-11.2.1.2-10",
        "alternation",
        event.hook,
        "on_startup and on_shutdown alternate",
        f"{event.hook} after {', '.join(history.phases) or 'neither'}",
        (event.n,),
        ongoing.step_number if ongoing else None,
    )


@property_at("entered", "R-12.10-22", at=LIFE_CYCLE_HOOKS)
def discarded(
    verdicts: Verdicts,
    runtime: ObservedRuntime,
    ongoing: OperationInProgress | None,
    event: Enter,
    history: CallbackHistory,
) -> None:
    """What a failed add_component made hears nothing more but its on_remove."""
    if runtime.discarded and (event.component, event.instance) in runtime.discarded and event.hook != "on_remove":
        verdicts.violated(
            "R-12.10-22",
            "discarded",
            event.hook,
            "a failed add_component leaves nothing behind",
            f"its body received {event.hook} later",
            (event.n,),
            ongoing.step_number if ongoing else None,
        )


_SHOWN = 3
"""So many attributes are told of."""


@property_at("entered", "R-11.2.1.2-05", "R-10.1.1-06", at=("on_init",), feature="attributes")
def attributes_before_init(
    verdicts: Verdicts,
    runtime: ObservedRuntime,
    ongoing: OperationInProgress | None,
    event: Enter,
    history: CallbackHistory,
) -> None:
    """On entry to on_init the body holds the configured attribute values."""
    if history.initialised:
        return
    declaration = runtime.scenario.components.get(event.component)
    if declaration is None or not declaration.attributes:
        return
    held = event.attributes or {}
    wrong = [a for a, value in declaration.attributes.items() if not _is_configured(held.get(a), value)]
    if not wrong:
        verdicts.exercised("R-11.2.1.2-05")
    else:
        _holds_others(verdicts, "R-11.2.1.2-05", declaration, wrong, held, event, ongoing)
    typed = {a for a, value in declaration.attributes.items() if read_spelled(value) is not None}
    if typed and not typed.intersection(wrong):
        verdicts.exercised("R-10.1.1-06")
    elif typed:
        _holds_others(verdicts, "R-10.1.1-06", declaration, [a for a in wrong if a in typed], held, event, ongoing)


def _is_configured(held: str | None, configured: str) -> bool:
    """Is it what was configured? A value of a type may have been read, and spelled anew."""
    value, own = read_spelled(configured), read_spelled(held)
    return held == configured or (value is not None and own is not None and spell(value) == spell(own))


def _holds_others(
    verdicts: Verdicts,
    requirement: str,
    declaration: s.Declaration,
    wrong: list[str],
    held: Mapping[str, str],
    event: Enter,
    ongoing: OperationInProgress | None,
) -> None:
    some = wrong[:_SHOWN]
    verdicts.violated(
        requirement,
        "attributes_before_init",
        "missing" if all(a not in held for a in wrong) else "another value",
        "on_init finds " + ", ".join(f"{a}={declaration.attributes[a]}" for a in some),
        "on_init found " + ", ".join(f"{a}={held[a]}" if a in held else f"{a} unset" for a in some),
        (event.n,),
        ongoing.step_number if ongoing else None,
    )


@property_at("ended", "R-11.2.1.2-08", at=("start",))
def configuration_first(
    verdicts: Verdicts, runtime: ObservedRuntime, ongoing: OperationInProgress, end: Return | Raise
) -> None:
    """Once start has started a member, nothing of the container is initialised or connected any more."""
    if not isinstance(end, Return):
        return
    own = [m for m in ongoing.container.live_members() if m.instance is not None] if ongoing.callbacks else []
    late = [c for m in own for c in (*received(ongoing, m, "on_init"), *received(ongoing, m, "on_connect"))]
    if late:
        verdicts.violated(
            "R-11.2.1.2-08",
            "configuration_first",
            late[0].hook,
            "when start is called, every member is initialised and connected",
            f"{late[0].component} received {late[0].hook} during start",
            tuple(c.n for c in late),
            ongoing.step_number,
        )
    elif sum(bool(received(ongoing, m, "on_startup")) for m in own) > 1:
        verdicts.exercised("R-11.2.1.2-08")


@property_at("entered", "R-11.2.1.3-04", at=("on_connect",))
def connect_arguments(
    verdicts: Verdicts,
    runtime: ObservedRuntime,
    ongoing: OperationInProgress | None,
    event: Enter,
    history: CallbackHistory,
) -> None:
    """on_connect is given the port element's name and the reference that connect was given."""
    if ongoing is None or not isinstance(ongoing.step, s.Connect):
        return
    member = ongoing.subject
    if member is None or member.suspended or (member.component, member.instance) != (event.component, event.instance):
        return
    reference, _ = runtime.reference(ongoing.step.to)
    wrong = event.port != ongoing.step.port
    wrong_reference = event.reference is None or (
        isinstance(event.reference, Reference) and isinstance(reference, Reference) and event.reference != reference
    )
    if not wrong and not wrong_reference:
        verdicts.exercised("R-11.2.1.3-04")
        return
    verdicts.violated(
        "R-11.2.1.3-04",
        "connect_arguments",
        "name" if wrong else "reference",
        f"on_connect({ongoing.step.port}, {_show(reference)})",
        f"on_connect({event.port}, {_show(event.reference)})",
        (event.n,),
        ongoing.step_number,
        (Arrow(ongoing.container.name, member.lane, f"on_connect({ongoing.step.port}, {_show(reference)})"),),
    )


@property_at("entered", "R-11.2.1.3-06", at=("on_disconnect",))
def disconnect_arguments(
    verdicts: Verdicts,
    runtime: ObservedRuntime,
    ongoing: OperationInProgress | None,
    event: Enter,
    history: CallbackHistory,
) -> None:
    """on_disconnect is given the name of the port element whose connection is undone."""
    if ongoing is None:
        return
    member = runtime.member_of(event.component, event.instance)
    if member is None or member.suspended:
        return
    if ongoing.operation not in _UNDOING:  # that it came at all is then the fault
        return
    undone = [ongoing.connection] if ongoing.connection is not None else member.connections
    ports = {c.port for c in undone if c.live is not False}
    if not ports:
        return
    if event.port in ports:
        verdicts.exercised("R-11.2.1.3-06")
        return
    wanted = " or ".join(sorted(ports))
    verdicts.violated(
        "R-11.2.1.3-06",
        "disconnect_arguments",
        "name",
        f"on_disconnect({wanted})",
        f"on_disconnect({event.port})",
        (event.n,),
        ongoing.step_number,
        (Arrow(ongoing.container.name, member.lane, f"on_disconnect({wanted})"),),
    )


@property_at("entered", "R-11.2.1.4-02", at=("on_startup", "set_container_interface"), feature="fragments")
def container_interface(
    verdicts: Verdicts,
    runtime: ObservedRuntime,
    ongoing: OperationInProgress | None,
    event: Enter,
    history: CallbackHistory,
) -> None:
    """A fragment gets its container's interface exactly once, before on_startup."""
    declaration = runtime.scenario.components.get(event.component)
    if declaration is None or not declaration.fragment:
        return
    given = history.interfaces
    first_start = event.hook == "on_startup" and not history.begun
    again = event.hook == "set_container_interface" and given > 0
    if first_start and given == 1:
        verdicts.exercised("R-11.2.1.4-02")
    elif again or (first_start and given == 0):
        verdicts.violated(
            "R-11.2.1.4-02",
            "container_interface",
            "twice" if again else "never",
            "set_container_interface comes once, before on_startup",
            "set_container_interface came again" if again else "on_startup came without set_container_interface",
            (event.n,)
            if again
            else tuple(sorted({history.first_at or event.n, event.n})),  # from its first callback on
            ongoing.step_number if ongoing else None,
            (Arrow(ongoing.container.name if ongoing else "manager", event.component, "set_container_interface"),),
        )


@property_at("noted", "R-11.2.1.4-03")
def siblings(
    verdicts: Verdicts, runtime: ObservedRuntime, ongoing: OperationInProgress | None, event: Siblings
) -> None:
    """What a fragment learns of its container's members is what they are, unless an operation is changing that."""
    member = runtime.member_of(event.component, event.instance)
    if ongoing is not None or member is None or not member.declaration.fragment:
        return
    if member.suspended or not member.operational:
        return
    problem = "the query failed" if event.raised else listing_problem(runtime, member.container, event.ids)
    if problem is None:
        verdicts.exercised("R-11.2.1.4-03")
        return
    verdicts.violated(
        "R-11.2.1.4-03",
        "siblings",
        problem.split()[0],
        f"the fragment sees {[m.id for m in member.container.live_members()]}",
        f"the fragment sees {list(event.ids)}: {problem}",
        (event.n,),
    )


def _show(reference: object) -> str:
    if isinstance(reference, Reference):
        return f"{lane(reference.component, reference.instance)}.{reference.port}"
    return "nil" if reference is None else str(reference)
