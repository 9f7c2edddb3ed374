"""Rules about the callbacks of component bodies, Connectable bodies and fragments (11.2.1, 11.2.3)."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.trace import Enter, Raise, Reference, Return, Siblings
from ucm_cts.reference_models.adoption import received
from ucm_cts.reference_models.findings import Arrow
from ucm_cts.reference_models.ledger import Ledger, rule
from ucm_cts.reference_models.life_cycle import CallbackDuty, Outcome, Row
from ucm_cts.reference_models.rules_operations import listing_problem
from ucm_cts.reference_models.runtime import Member, Runtime, Window, lane
from ucm_cts.reference_models.situations import undone_by

LIFE_CYCLE_HOOKS = frozenset(("on_init", "on_startup", "on_shutdown", "on_remove", "on_connect", "on_disconnect"))
_CONNECTABLE_HOOKS = ("on_connect", "on_disconnect")

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

Token = tuple[str, bool]
"""A callback of an outcome's pattern, and whether it may be left out."""


def pattern(outcome: Outcome, window: Window, member: Member | None, connectable: bool) -> list[Token]:
    """The callbacks that ``outcome`` asks for, for this instance and its connections."""
    tokens: list[Token] = []
    for text in outcome.callbacks:
        hook = text.rstrip("?*")
        if hook in _CONNECTABLE_HOOKS and not connectable:
            continue
        count = len(undone_by(window, member)) if text.endswith("*") and member is not None else 1
        tokens.extend([(hook, text.endswith("?"))] * count)
    return tokens


def fits(tokens: Sequence[Token], observed: Sequence[str]) -> bool:
    """Is ``observed`` a sequence that ``tokens`` permits?"""
    if not tokens:
        return not observed
    hook, optional = tokens[0]
    if observed and observed[0] == hook and fits(tokens[1:], observed[1:]):
        return True
    return optional and fits(tokens[1:], observed)


def _duty(ledger: Ledger, hook: str, operation: str) -> CallbackDuty:
    return next(
        d for d in ledger.table.duties if d.callback == hook and (not d.operations or operation in d.operations)
    )


def _observed(window: Window, component: str, instance: int | None) -> list[Enter]:
    return [
        c
        for c in window.callbacks
        if c.component == component and c.instance == instance and c.hook in LIFE_CYCLE_HOOKS
    ]


@rule("ended", *_FROM_DUTIES)
def callbacks(ledger: Ledger, runtime: Runtime, window: Window, end: Return | Raise) -> None:
    """Each instance receives exactly the callbacks that the life-cycle table asks for, in its order."""
    answer = "return" if isinstance(end, Return) else end.error
    _others(ledger, runtime, window)
    if not window.judged:
        return
    if _manager_forgot_its_own(ledger, window, answer, end.n):
        return
    for member, row in window.roles:
        if isinstance(window.step, s.AddComponent):
            _instance(ledger, runtime, window, row, None, answer, end.n)
        elif member is not None:
            _instance(ledger, runtime, window, row, member, answer, end.n)
        else:
            _visited(ledger, row, [o for o in row.outcomes if answer in o.answer])


def _visited(ledger: Ledger, row: Row, fitting: list[Outcome]) -> None:
    tally = ledger.row(row)
    tally.exercised += 1
    if len(fitting) == 1 and fitting[0].reading:
        tally.readings.add(fitting[0].reading)


def _instance(
    ledger: Ledger, runtime: Runtime, window: Window, row: Row, member: Member | None, answer: str, end: int
) -> None:
    """Hold what one instance received against its row; a new instance has no ``member`` yet."""
    if member is not None:
        declaration, component, instance = member.declaration, member.component, member.instance
    else:
        assert isinstance(window.step, s.AddComponent)
        component = window.step.component
        declaration = runtime.scenario.components.get(component, s.Declaration())
        fresh = [c.instance for c in window.callbacks if c.component == component]
        instance = next((i for i in fresh if (component, i) not in runtime.bodies), None)
    events = _observed(window, component, instance)
    if row.operation == "start":  # a late on_init or on_connect is configuration_first's matter
        events = [e for e in events if e.hook not in ("on_init", "on_connect")]
    observed: list[str] = [e.hook for e in events]
    candidates = [o for o in row.outcomes if answer in o.answer]
    patterns = [pattern(o, window, member, declaration.connectable) for o in candidates]
    fitting = [(o, t) for o, t in zip(candidates, patterns, strict=True) if fits(t, observed)]
    if fitting:
        _visited(ledger, row, [o for o, _ in fitting])
        _kept(ledger, row, declaration, observed, fitting[0][1], answer)
        return
    tokens = min(
        patterns, key=lambda t: sum(_difference(t, observed)[0].values()) + sum(_difference(t, observed)[1].values())
    )
    missing, surplus = _difference(tokens, observed)
    who = member.lane if member else lane(component, instance or 1)
    if member is not None:
        member.suspended = True
    else:
        window.judged = False
    ledger.row(row).violated += 1
    if missing:
        hook = next(h for h, optional in tokens if not optional and h in missing)
        requirement = row.missing or _duty(ledger, hook, row.operation).missing
        if declaration.fragment and hook in ("on_init", "on_startup"):
            requirement = "R-11.2.1.4-01"
        cause, observation = f"{row.operation} without {hook}", f"{window.operation} ended without {hook} on {who}"
        offending: tuple[int, ...] = (end,)
    elif surplus:
        hook = next(h for h in observed if h in surplus)
        requirement = _duty(ledger, hook, row.operation).unexpected
        offending = tuple(e.n for e in events if e.hook == hook)
        times = f" {len(offending)} times" if len(offending) > 1 else ""
        cause, observation = (
            f"{hook} by {row.id}",
            f"{who} received {hook}{times} from {window.operation} while {row.state}",
        )
    else:
        requirement, cause = ledger.table.order, f"{row.operation} order"
        observation, offending = f"{who} received {', '.join(observed)}", tuple(e.n for e in events)
    wanted = [h for h, optional in tokens if not optional]
    ledger.violated(
        requirement,
        "callbacks",
        cause,
        f"{window.operation} brings {who} {', '.join(wanted) if wanted else 'no callback'} ({row.state}{', ' * bool(row.condition)}{row.condition})",
        observation,
        offending,
        window.step_number,
        tuple(Arrow(window.container.name, who, h) for h in wanted)
        or (Arrow(window.container.name, "test", f"{answer}, no callback"),),
    )


def _difference(tokens: Sequence[Token], observed: Sequence[str]) -> tuple[Counter[str], Counter[str]]:
    """Callbacks that should be there and are not, and those that are there and should not."""
    required = Counter(h for h, optional in tokens if not optional)
    permitted = Counter(h for h, _ in tokens)
    seen = Counter(observed)
    return required - seen, seen - permitted


def _kept(
    ledger: Ledger, row: Row, declaration: s.Declaration, observed: list[str], tokens: list[Token], answer: str
) -> None:
    for hook in set(observed):
        duty = _duty(ledger, hook, row.operation)
        if any(h == hook for h, _ in tokens):
            ledger.exercised(duty.missing)
            if declaration.fragment and hook in ("on_init", "on_startup"):
                ledger.exercised("R-11.2.1.4-01")
    if len(observed) > 1 and "on_remove" in observed and answer == "return":
        ledger.exercised(ledger.table.order)
    if row.operation == "connect" and declaration.connectable and not observed:
        ledger.exercised(_duty(ledger, "on_connect", "connect").unexpected)
    if row.state != "absent":
        for hook in ("on_init", "on_startup", "on_shutdown"):
            duty = _duty(ledger, hook, row.operation)
            if hook not in observed and duty.missing != duty.unexpected:
                ledger.exercised(duty.unexpected)


def _others(ledger: Ledger, runtime: Runtime, window: Window) -> None:
    """Instances the operation does not concern receive nothing."""
    concerned = {id(m) for m, _ in window.roles}
    told = {(c.component, c.instance) for c in window.callbacks if c.hook in LIFE_CYCLE_HOOKS}
    undisturbed_elsewhere = False
    for member in runtime.members.values():
        if id(member) in concerned or member.gone or member.suspended:
            continue
        elsewhere = member.container is not window.container
        if (member.component, member.instance) not in told:
            undisturbed_elsewhere = undisturbed_elsewhere or elsewhere
            continue
        events = _observed(window, member.component, member.instance)
        if elsewhere and window.container.name == s.MANAGER and window.operation in ("start", "stop"):
            continue
        hook = events[0].hook
        role = "elsewhere" if elsewhere else "bystander"
        member.suspended = True
        ledger.violated(
            _duty(ledger, hook, role).unexpected,
            "callbacks",
            f"{hook} by another's {window.operation}",
            f"{window.operation} on {'another container' if elsewhere else 'another instance'} leaves {member.lane} alone",
            f"{member.lane} received {hook} during {window.operation}",
            tuple(e.n for e in events),
            window.step_number,
            (Arrow(window.container.name, "test", f"no callback on {member.lane}"),),
        )
    if undisturbed_elsewhere and window.operation in ("start", "stop", "remove_container"):
        ledger.exercised("R-11.1.3-04")


def _manager_forgot_its_own(ledger: Ledger, window: Window, answer: str, end: int) -> bool:
    """A successful start or stop of the manager that reaches none of its own members (11.2.2.2)."""
    hook: s.Hook | None = {"start": "on_startup", "stop": "on_shutdown"}.get(window.operation)  # type: ignore[assignment]
    if hook is None or answer != "return" or window.container.name != s.MANAGER:
        return False
    due = [
        m
        for m, row in window.roles
        if m is not None
        and not row.missing
        and m.container is window.container
        and all(hook in o.callbacks for o in row.outcomes if "return" in o.answer)
    ]
    if not due:
        return False
    if any(received(window, m, hook) for m in due):
        ledger.exercised("R-11.2.2.2-01")
        return False
    for member in due:
        member.suspended = True
    ledger.violated(
        "R-11.2.2.2-01",
        "callbacks",
        f"manager without {hook}",
        f"{window.operation} of the manager brings its own members {hook}",
        f"{window.operation} returned and none of {', '.join(m.lane for m in due)} received {hook}",
        (window.call, end),
        window.step_number,
        tuple(Arrow(window.container.name, m.lane, hook) for m in due),
    )
    return True


@rule("entered", "R-11.1.1-01", "R-11.1.2-01")
def whole_life(ledger: Ledger, runtime: Runtime, window: Window | None, event: Enter, heard: Sequence[str]) -> None:
    """Life-cycle callbacks come during operations of the container; a whole life has them in order."""
    if event.hook not in LIFE_CYCLE_HOOKS:
        return
    declaration = runtime.scenario.components.get(event.component)
    requirement = "R-11.1.2-01" if declaration is not None and declaration.fragment else "R-11.1.1-01"
    member = runtime.member_of(event.component, event.instance)
    if window is None:
        if member is None or member.suspended or member.gone:
            return
        member.suspended = True
        ledger.violated(
            requirement,
            "whole_life",
            f"stray {event.hook}",
            f"{event.hook} comes during an operation of the container",
            f"{member.lane} received {event.hook} while no operation was in progress",
            (event.n,),
        )
    elif event.hook == "on_remove" and member is not None and not member.suspended:
        steps = [h for h in heard if h in LIFE_CYCLE_HOOKS and h not in _CONNECTABLE_HOOKS]
        if steps[:1] == ["on_init"] and steps[1:] and steps[1:] == ["on_startup", "on_shutdown"] * (len(steps) // 2):
            ledger.exercised(requirement)


@rule("entered", "R-11.2.1.2-01")
def nothing_outside_life(
    ledger: Ledger, runtime: Runtime, window: Window | None, event: Enter, heard: Sequence[str]
) -> None:
    """No callback before on_init or after on_remove."""
    if event.hook not in LIFE_CYCLE_HOOKS:
        return
    if event.hook == "on_remove" and heard[:1] == ["on_init"] and "on_remove" not in heard:
        ledger.exercised("R-11.2.1.2-01")
        return
    early = event.hook != "on_init" and "on_init" not in heard
    late = "on_remove" in heard
    if (
        late
        and window is not None
        and any(
            c.hook == "on_remove" and (c.component, c.instance) == (event.component, event.instance)
            for c in window.callbacks
        )
    ):
        return  # within the removal itself it is a matter of order
    member = runtime.member_of(event.component, event.instance)
    if not (early or late) or (member is not None and member.suspended):
        return
    if early and window is not None and not window.judged:
        return
    who = lane(event.component, event.instance)
    ledger.violated(
        "R-11.2.1.2-01",
        "nothing_outside_life",
        f"{event.hook} {'after on_remove' if late else 'before on_init'}",
        f"{who} hears nothing {'after on_remove' if late else 'before on_init'}",
        f"{who} received {event.hook}",
        (event.n,),
        window.step_number if window else None,
    )
    if member is not None:
        member.suspended = True


@rule("entered", "R-11.2.1.2-05")
def attributes_before_init(
    ledger: Ledger, runtime: Runtime, window: Window | None, event: Enter, heard: Sequence[str]
) -> None:
    """On entry to on_init the body holds the configured attribute values."""
    if event.hook != "on_init" or "on_init" in heard:
        return
    declaration = runtime.scenario.components.get(event.component)
    if declaration is None or not declaration.attributes:
        return
    held = event.attributes or {}
    wrong = [a for a, value in declaration.attributes.items() if held.get(a) != value]
    if not wrong:
        ledger.exercised("R-11.2.1.2-05")
        return
    ledger.violated(
        "R-11.2.1.2-05",
        "attributes_before_init",
        "missing" if all(a not in held for a in wrong) else "another value",
        "on_init finds " + ", ".join(f"{a}={declaration.attributes[a]}" for a in wrong),
        "on_init found " + ", ".join(f"{a}={held[a]}" if a in held else f"{a} unset" for a in wrong),
        (event.n,),
        window.step_number if window else None,
    )


@rule("ended", "R-11.2.1.2-08")
def configuration_first(ledger: Ledger, runtime: Runtime, window: Window, end: Return | Raise) -> None:
    """Once start has started a member, nothing of the container is initialised or connected any more."""
    if window.operation != "start" or not isinstance(end, Return):
        return
    own = [m for m in window.container.live_members() if m.instance is not None]
    late = [c for m in own for c in (*received(window, m, "on_init"), *received(window, m, "on_connect"))]
    if late:
        ledger.violated(
            "R-11.2.1.2-08",
            "configuration_first",
            late[0].hook,
            "when start is called, every member is initialised and connected",
            f"{late[0].component} received {late[0].hook} during start",
            tuple(c.n for c in late),
            window.step_number,
        )
    elif sum(bool(received(window, m, "on_startup")) for m in own) > 1:
        ledger.exercised("R-11.2.1.2-08")


@rule("entered", "R-11.2.1.3-04")
def connect_arguments(
    ledger: Ledger, runtime: Runtime, window: Window | None, event: Enter, heard: Sequence[str]
) -> None:
    """on_connect is given the port element's name and the reference that connect was given."""
    if event.hook != "on_connect" or window is None or not isinstance(window.step, s.Connect):
        return
    member = window.subject
    if member is None or member.suspended or (member.component, member.instance) != (event.component, event.instance):
        return
    reference, _ = runtime.reference(window.step.to)
    wrong = event.port != window.step.port
    wrong_reference = event.reference is None or (
        isinstance(event.reference, Reference) and isinstance(reference, Reference) and event.reference != reference
    )
    if not wrong and not wrong_reference:
        ledger.exercised("R-11.2.1.3-04")
        return
    ledger.violated(
        "R-11.2.1.3-04",
        "connect_arguments",
        "name" if wrong else "reference",
        f"on_connect({window.step.port}, {_show(reference)})",
        f"on_connect({event.port}, {_show(event.reference)})",
        (event.n,),
        window.step_number,
        (Arrow(window.container.name, member.lane, f"on_connect({window.step.port}, {_show(reference)})"),),
    )


@rule("entered", "R-11.2.1.3-06")
def disconnect_arguments(
    ledger: Ledger, runtime: Runtime, window: Window | None, event: Enter, heard: Sequence[str]
) -> None:
    """on_disconnect is given the name of the port element whose connection is undone."""
    if event.hook != "on_disconnect" or window is None:
        return
    member = runtime.member_of(event.component, event.instance)
    if member is None or member.suspended:
        return
    ports = {c.port for c in undone_by(window, member)}
    if isinstance(window.step, s.Connect) or not ports:
        return
    if event.port in ports:
        ledger.exercised("R-11.2.1.3-06")
        return
    wanted = " or ".join(sorted(ports))
    ledger.violated(
        "R-11.2.1.3-06",
        "disconnect_arguments",
        "name",
        f"on_disconnect({wanted})",
        f"on_disconnect({event.port})",
        (event.n,),
        window.step_number,
        (Arrow(window.container.name, member.lane, f"on_disconnect({wanted})"),),
    )


@rule("entered", "R-11.2.1.4-02")
def container_interface(
    ledger: Ledger, runtime: Runtime, window: Window | None, event: Enter, heard: Sequence[str]
) -> None:
    """A fragment gets its container's interface exactly once, before on_startup."""
    declaration = runtime.scenario.components.get(event.component)
    if declaration is None or not declaration.fragment:
        return
    given = sum(h == "set_container_interface" for h in heard)
    first_start = event.hook == "on_startup" and "on_startup" not in heard
    again = event.hook == "set_container_interface" and given > 0
    if first_start and given == 1:
        ledger.exercised("R-11.2.1.4-02")
    elif again or (first_start and given == 0):
        ledger.violated(
            "R-11.2.1.4-02",
            "container_interface",
            "twice" if again else "never",
            "set_container_interface comes once, before on_startup",
            "set_container_interface came again" if again else "on_startup came without set_container_interface",
            (event.n,),
            window.step_number if window else None,
            (Arrow(window.container.name if window else "manager", event.component, "set_container_interface"),),
        )


@rule("noted", "R-11.2.1.4-03")
def siblings(ledger: Ledger, runtime: Runtime, event: Siblings) -> None:
    """What a fragment learns of its container's members is what they are."""
    member = runtime.member_of(event.component, event.instance)
    if member is None or member.suspended or not member.operational:
        return
    problem = "the query failed" if event.raised else listing_problem(runtime, member.container, event.ids)
    if problem is None:
        ledger.exercised("R-11.2.1.4-03")
        return
    ledger.violated(
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
