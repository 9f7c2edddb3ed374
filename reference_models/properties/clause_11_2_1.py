"""Properties about what callbacks are given: attributes, names, references, the container's interface (11.2.1)."""

from __future__ import annotations

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_values import read_spelled, spell
from ucm_cts.adapters.contract.trace import Reference, Return, Siblings
from ucm_cts.reference_models.conclusions import Concluded, Conclusions
from ucm_cts.reference_models.findings import Arrow, Finding
from ucm_cts.reference_models.model.callback_history import Callback
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.operation import Ongoing, OperationInProgress
from ucm_cts.reference_models.model.runtime import lane
from ucm_cts.reference_models.properties.clause_11_2_2 import listing_problem
from ucm_cts.reference_models.properties.clause_11_2_3 import outside_life
from ucm_cts.reference_models.properties.declaration import Property, property_at

_BEFORE_INIT, _ATTRIBUTES, _DEFAULTS = "R-11.2.1.2-05", "R-10.1.1-06", "R-9.2.7.4-04"

_UNDOING = ("disconnect", "remove_component", "remove_container", "destroy")
_STARTING = {"on_startup"}
_LONGEST = 60
"""Characters of a value that a finding shows."""

_SHOWN = 3
"""The most attributes that a finding lists."""


@property_at("entered", _BEFORE_INIT, _ATTRIBUTES, at=("on_init",), feature="attributes")
def attributes_before_init(check: Property, runtime: ObservedRuntime, callback: Callback) -> Concluded:
    """On entry to on_init the body holds the configured attribute values."""
    declaration = runtime.scenario.components.get(callback.event.component)
    if callback.history.initialised or declaration is None:
        return ()
    configured = _values(declaration, callback)
    return _held_as_configured(check, configured, callback) if configured else ()


def _held_as_configured(check: Property, configured: dict[str, str], callback: Callback) -> Conclusions:
    held = callback.event.attributes or {}
    wrong = [a for a, value in configured.items() if not _is_configured(held.get(a), value)]
    if not wrong:
        yield check.kept()
    else:
        yield _holds_others(check, _BEFORE_INIT, configured, wrong, callback)
    typed = {a for a, value in configured.items() if read_spelled(value) is not None}
    if typed and not typed.intersection(wrong):
        yield check.kept(_ATTRIBUTES)
    elif typed:
        yield _holds_others(check, _ATTRIBUTES, configured, [a for a in wrong if a in typed], callback)


@property_at("entered", _DEFAULTS, at=("on_init",), feature="attributes")
def default_values(check: Property, runtime: ObservedRuntime, callback: Callback) -> Concluded:
    """On entry to on_init attributes that were not configured have their default values (attribute-defaults)."""
    declaration = runtime.scenario.components.get(callback.event.component)
    if callback.history.initialised or declaration is None or not declaration.defaults:
        return ()
    if runtime.ics.reading("attribute-defaults") != "set":
        return ()
    configured, held = _values(declaration, callback), callback.event.attributes or {}
    due = {name: value for name, value in declaration.defaults.items() if name not in configured}
    wrong = [name for name, value in due.items() if not _is_configured(held.get(name), value)]
    if not due:
        return ()
    return _holds_others(check, _DEFAULTS, due, wrong, callback) if wrong else check.kept()


def _given(callback: Callback) -> dict[str, str]:
    """The values that are given to the instance alone that ``callback`` enters."""
    step = callback.ongoing.step if callback.ongoing is not None else None
    if isinstance(step, s.AddComponent) and step.component == callback.event.component:
        return step.attributes
    return {}


def _values(declaration: s.Declaration, callback: Callback) -> dict[str, str]:
    """The values that configure the attributes of the instance that ``callback`` enters, whose type is ``declaration``."""
    given = _given(callback)
    if not given:
        return declaration.attributes
    known = {*declaration.attributes, *declaration.defaults}
    return {**declaration.attributes, **{name: value for name, value in given.items() if name in known}}


@property_at("entered", "R-11.2.3-19", at=("on_init",))
def own_attributes_only(check: Property, runtime: ObservedRuntime, callback: Callback) -> Concluded:
    """On entry to on_init the body holds no value of an attribute that nobody configured (attribute-init-order)."""
    event = callback.event
    declaration = runtime.scenario.components.get(event.component)
    if callback.history.initialised or declaration is None:
        return ()
    held = event.attributes
    if not held:
        return check.kept()
    asked = {*declaration.attributes, *declaration.defaults, *_given(callback)}
    extra = [name for name, value in held.items() if name not in asked and not _is_default(value)]
    if not extra:
        return check.kept()
    has = ", ".join(list(declaration.attributes)[:_SHOWN]) or "none"
    return check.fail(
        "extra",
        expected=f"'{callback.event.component}' is given attributes of its type only: {has}",
        observed=f"its attribute {extra[0]!r} was set to {_brief(held[extra[0]])!r}, which nobody configured",
        during=(callback.ongoing, event),
    )


def _is_default(value: str) -> bool:
    """May an attribute have this value although nobody configured it? A type's least value is no configuration."""
    return not value or read_spelled(value) in (0, False, "", [])


def _is_configured(held: str | None, configured: str) -> bool:
    """Is it what was configured? A value of a type may have been read, and spelled anew."""
    if held == configured:
        return True
    value, own = read_spelled(configured), read_spelled(held)
    return value is not None and own is not None and spell(value) == spell(own)


def _brief(value: str) -> str:
    """A value as findings show it: of a long one its beginning and its length."""
    return value if len(value) <= _LONGEST else f"{value[:_LONGEST]}… ({len(value)} characters)"


def _holds_others(
    check: Property, requirement: str, due: dict[str, str], wrong: list[str], callback: Callback
) -> Finding:
    held, some = callback.event.attributes or {}, wrong[:_SHOWN]
    return check.fail(
        "missing" if all(a not in held for a in wrong) else "another value",
        expected="on_init finds " + ", ".join(f"{a}={_brief(due[a])}" for a in some),
        observed="on_init found " + ", ".join(f"{a}={_brief(held[a])}" if a in held else f"{a} unset" for a in some),
        during=(callback.ongoing, callback.event),
        requirement=requirement,
    )


@property_at("ended", "R-11.2.1.2-08", at=("start",))
def configuration_first(check: Property, runtime: ObservedRuntime, ongoing: OperationInProgress) -> Concluded:
    """Once start has started a member, nothing of the container is initialised or connected any more."""
    if not isinstance(ongoing.end, Return) or not ongoing.callbacks:
        return ()
    if ongoing.hooks == _STARTING and len(ongoing.by_body) < 2 and not runtime.shares_bodies:
        return ()  # the common case
    own = [m for m in ongoing.container.live_members() if m.instance is not None]
    late = [c for m in own for c in (*ongoing.received(m, "on_init"), *ongoing.received(m, "on_connect"))]
    if late:
        return check.fail(
            late[0].hook,
            expected="when start is called, every member is initialised and connected",
            observed=f"{late[0].component} received {late[0].hook} during start",
            at=tuple(c.n for c in late),
            step=ongoing.step_number,
        )
    if sum(bool(ongoing.received(m, "on_startup")) for m in own) > 1:
        return check.kept()
    return ()


@property_at("entered", "R-11.2.1.3-04", at=("on_connect",))
def connect_arguments(check: Property, runtime: ObservedRuntime, callback: Callback) -> Concluded:
    """on_connect is given the port element's name and the reference that connect was given."""
    event, _, ongoing, _ = callback
    if ongoing is None or not isinstance(ongoing.step, s.Connect) or event.wrong:
        return ()
    member = ongoing.subject
    if member is None or member.suspended or outside_life(runtime, callback) or member.body != event.body:
        return ()
    reference, _ = runtime.reference(ongoing.step.to)
    wrong = event.port != ongoing.step.port
    wrong_reference = (event.reference is None and reference is not None) or (
        isinstance(event.reference, Reference) and isinstance(reference, Reference) and event.reference != reference
    )
    if not wrong and not wrong_reference:
        return check.kept()
    return check.fail(
        "name" if wrong else "reference",
        expected=f"{member.lane} is told on_connect({ongoing.step.port}, {_show(reference)})",
        observed=f"it was told on_connect({event.port}, {_show(event.reference)})",
        during=(ongoing, event),
        instead=(Arrow(ongoing.container.name, member.lane, f"on_connect({ongoing.step.port}, {_show(reference)})"),),
    )


@property_at("entered", "R-11.2.1.3-06", at=("on_disconnect",))
def disconnect_arguments(check: Property, runtime: ObservedRuntime, callback: Callback) -> Concluded:
    """on_disconnect is given the name of the port element whose connection is undone."""
    event, member, ongoing, _ = callback
    if ongoing is None or member is None or member.suspended or event.wrong or outside_life(runtime, callback):
        return ()
    if ongoing.operation not in _UNDOING:  # that it came at all is then the fault
        return ()
    undone = [ongoing.connection] if ongoing.connection is not None else member.connections
    ports = {c.port for c in undone if c.live is not False}
    if not ports:
        return ()
    if event.port in ports:
        return check.kept()
    wanted = " or ".join(sorted(ports))
    return check.fail(
        "name",
        expected=f"{member.lane} is told on_disconnect({wanted})",
        observed=f"it was told on_disconnect({event.port})",
        during=(ongoing, event),
        instead=(Arrow(ongoing.container.name, member.lane, f"on_disconnect({wanted})"),),
    )


@property_at("entered", "R-11.2.1.4-02", at=("on_startup", "set_container_interface"), feature="fragments")
def container_interface(check: Property, runtime: ObservedRuntime, callback: Callback) -> Concluded:
    """A fragment gets its container's interface before on_startup, and once unless declared otherwise."""
    event, _, ongoing, history = callback
    declaration = runtime.scenario.components.get(event.component)
    if declaration is None or not declaration.fragment:
        return ()
    given = history.interfaces
    first_start = event.hook == "on_startup" and not history.begun
    may_come_again = runtime.ics.reading("container-interface") == "repeated"
    again = event.hook == "set_container_interface" and given > 0 and not may_come_again
    if first_start and (given == 1 or (given and may_come_again)):
        return check.kept()
    if again or (first_start and given == 0):
        return check.fail(
            "twice" if again else "never",
            expected=f"set_container_interface of {lane(*event.body)} comes once, before on_startup",
            observed="set_container_interface came again"
            if again
            else "on_startup came without set_container_interface",
            at=(event.n,) if again else tuple(sorted({history.first_at or event.n, event.n})),
            step=ongoing.step_number if ongoing else None,
            instead=(
                Arrow(ongoing.container.name if ongoing else s.MANAGER, event.component, "set_container_interface"),
            ),
        )
    return ()


@property_at("noted", "R-11.2.1.4-03")
def siblings(check: Property, runtime: ObservedRuntime, ongoing: Ongoing, event: Siblings) -> Concluded:
    """A fragment gets the true list of its container's members, unless an operation is changing it."""
    member = runtime.bodies.get(event.body)
    if ongoing is not None or member is None or not member.declaration.fragment or event.wrong:
        return ()
    if member.suspended or not member.operational:
        return ()
    problem = "the query failed" if event.raised else listing_problem(runtime, member.container, event.ids)
    if problem is None:
        return check.kept()
    return check.fail(
        problem.split()[0],
        expected=f"fragment {member.lane} sees {[m.id for m in member.container.live_members()]}",
        observed=f"it sees {list(event.ids)}: {problem if event.raised else f'that {problem}'}",
        at=(event.n,),
    )


def _show(reference: object) -> str:
    if isinstance(reference, Reference):
        return f"{lane(reference.component, reference.instance)}.{reference.port}"
    return "nil" if reference is None else "an object of the framework's own"
