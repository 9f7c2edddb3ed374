"""Properties about the vendor's statement.

A part that the vendor claims exists. Where the text leaves a choice, the framework does what the vendor declares.
"""

from __future__ import annotations

from collections.abc import Sequence

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.trace import Raise, Return, Skip
from ucm_cts.reference_models.conclusions import Concluded, Conclusions, Taken, takes
from ucm_cts.reference_models.model.callback_history import Callback
from ucm_cts.reference_models.model.expected_callbacks import Fit
from ucm_cts.reference_models.model.ics import Ics
from ucm_cts.reference_models.model.life_cycle import Row
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.operation import Fitted, OperationInProgress, Result
from ucm_cts.reference_models.model.runtime import Member, lane
from ucm_cts.reference_models.properties.declaration import Property, property_at, requirements

_REVERSE_ORDER = "R-11.2.2.1-13"

_WITH_CHOICES = requirements("""
    R-11.2.2.1-08 R-11.2.2.2-02 R-11.2.2.2-03 R-11.2.3-06 R-11.2.3-07 R-11.2.3-10 R-11.2.3-11 R-11.2.3-13 R-11.2.3-15
    R-12.10-18 R-12.10-20 R-12.10-22 R-12.10-23 R-12.10-24
""")

_OF_ALL_AT_ONCE = ("double-start", "stop-when-stopped")
"""Options about a container as a whole."""


@property_at("ended", *_WITH_CHOICES)
def declared_choices(check: Property, runtime: ObservedRuntime, ongoing: OperationInProgress) -> Concluded:
    """Where the life-cycle table permits several ways, an instance goes the one that the vendor declares."""
    return _chosen(check, runtime, ongoing) if ongoing.outcome.has_choices else ()


def _chosen(check: Property, runtime: ObservedRuntime, ongoing: OperationInProgress) -> Conclusions:
    fitted = ongoing.outcome.fitted
    certain = _choices(ongoing, ongoing.end, fitted)
    for _, _, fit in certain:
        if len(fit.readings) == 1:
            yield Taken(*fit.readings[0].split("=", 1))
    undeclared = _undeclared(runtime.ics, ongoing.end, certain)
    if undeclared is None:
        return
    member, row, fit = undeclared
    declared = [f"{option} = {runtime.ics.reading(option)}" for option in dict.fromkeys(_options(fit))]
    taken = " or ".join(reading.replace("=", " = ") for reading in fit.readings)
    yield check.fail(
        f"{row.id} {taken}",
        expected=f"{ongoing.what} as declared: {', '.join(declared)}",
        observed=f"it went as with {taken}" + (f" ({member.lane}, {row.state})" if member is not None else ""),
        ended=ongoing,
        requirement=row.requirement,
    )


def _choices(ongoing: OperationInProgress, end: Result, fitted: Sequence[Fitted]) -> list[Fitted]:
    """The instances of which it is certain that they went one of several ways; none if others may be the reason."""
    certain = [one for one in fitted if one[2].readings and _is_choice(ongoing, end, *one)]
    return certain if len(certain) == len(ongoing.roles) or not _is_common(end, certain) else []


def _is_common(end: Result, certain: Sequence[Fitted]) -> bool:
    """Is it one choice for all instances of the operation?"""
    return isinstance(end, Raise) or any(_options(fit)[0] in _OF_ALL_AT_ONCE for _, _, fit in certain)


def undeclared_choice(ics: Ics, ongoing: OperationInProgress, end: Result, fitted: Sequence[Fitted]) -> Fitted | None:
    """The first instance that went a way which the vendor has ruled out; None if there is none."""
    return _undeclared(ics, end, _choices(ongoing, end, fitted))


def _undeclared(ics: Ics, end: Result, certain: Sequence[Fitted]) -> Fitted | None:
    undeclared = [one for one in certain if not any(ics.permits(*reading.split("=", 1)) for reading in one[2].readings)]
    return undeclared[0] if undeclared and (len(undeclared) == len(certain) or not _is_common(end, certain)) else None


def _is_choice(ongoing: OperationInProgress, end: Result, member: Member | None, row: Row, fit: Fit) -> bool:
    """Was the framework free to go another way, and is nothing but this choice the reason that it went this one?"""
    if row.operation == "remove_provider":  # it goes the way that the provider goes
        return True
    hidden = (*ongoing.open_options, *(ongoing.open_if_refused if isinstance(end, Raise) else ()))
    for option in _options(fit):
        if option in hidden:
            return False
        if option == "manager-start":  # what is no start or stop of the manager's own has nothing to reach
            return ongoing.container.started is (ongoing.operation == "stop")
        if option == "stop-when-stopped":
            return ongoing.container.started is False
    return isinstance(end, Return) or member is None or not _may_be_refused_anyway(ongoing, member, row)


def _may_be_refused_anyway(ongoing: OperationInProgress, member: Member, row: Row) -> bool:
    """Does another choice speak against it, too? Ports are connected already, or what is removed is itself connected."""
    if isinstance(ongoing.step, s.Connect):
        return row.condition != "already connected" and bool(member.live_connections(ongoing.step.port))
    is_of_connections = row.condition in ("connected", "attached")
    return ongoing.operation == "remove_component" and not is_of_connections and bool(member.live_connections())


def _options(fit: Fit) -> list[str]:
    return [reading.partition("=")[0] for reading in fit.readings]


@property_at("ended", "R-11.2.2.1-14", at=("get_components",))
def declared_listing(check: Property, runtime: ObservedRuntime, ongoing: OperationInProgress) -> Conclusions:
    """The manager lists members of its sub-containers if, and only if, the vendor declares so."""
    if ongoing.container.name != s.MANAGER or not ongoing.judged or not isinstance(ongoing.end, Return):
        return
    below = [m for c in runtime.containers.values() if c is not ongoing.container for m in c.live_members()]
    if not below or ongoing.container.of_doubt or any(m.doubtful for m in below):
        return
    listed = ongoing.end.value if isinstance(ongoing.end.value, tuple) else ()
    reading = "recursive" if len(listed) > len(ongoing.container.live_members()) else "own"
    if not (yield from takes(runtime, "manager-get-components", reading)):
        yield check.fail(
            reading,
            expected=f"the vendor declares manager-get-components = {runtime.ics.reading('manager-get-components')}",
            observed=f"get_components of the manager returned {list(listed)}, which is {reading}",
            ended=ongoing,
        )


@property_at("ended", "R-11.2.3-17", at=("stop",))
def declared_drain(check: Property, runtime: ObservedRuntime, ongoing: OperationInProgress) -> Concluded:
    """stop waits for calls in progress if the vendor declares so."""
    if not isinstance(ongoing.end, Return) or not ongoing.judged:
        return ()
    inside = {body for bodies in runtime.inside.values() for body in bodies}
    return _drained(check, runtime, ongoing, inside) if inside else ()


def _drained(
    check: Property, runtime: ObservedRuntime, ongoing: OperationInProgress, inside: set[tuple[str, int]]
) -> Conclusions:
    for member in ongoing.container.live_members():
        if not member.operational or ongoing.outcome.is_unknown(member) or member.body not in inside:
            continue
        if not (yield from takes(runtime, "stop-drain", "abandon")):
            yield check.fail(
                "abandoned",
                expected="the vendor declares stop-drain = wait: stop returns when the calls in progress have ended",
                observed=f"stop returned while {member.lane} was still carrying out a call",
                ended=ongoing,
            )
        return


@property_at("entered", _REVERSE_ORDER, at=("on_startup",))
def declared_order(check: Property, runtime: ObservedRuntime, callback: Callback) -> Concluded:
    """A framework declared to start members one by one does not start them at a time, by several threads."""
    if not runtime.starting_up or callback.member is None or not _is_started(callback):
        return ()
    return _one_by_one(check, runtime, callback, callback.member)


def _one_by_one(check: Property, runtime: ObservedRuntime, callback: Callback, member: Member) -> Conclusions:
    event, ongoing = callback.event, callback.ongoing
    beside = [body for body, thread in runtime.starting_up.items() if thread != event.thread]
    if beside and not (yield from takes(runtime, "start-order", "at-once")):
        yield check.fail(
            "at once",
            expected="the vendor declares start-order = one-by-one: one on_startup has returned before the next one comes",
            observed=f"{member.lane} received on_startup while {lane(*beside[0])} was still inside its own",
            during=(ongoing, event),
        )


@property_at("entered", _REVERSE_ORDER, at=("on_startup",), timed=True)
def declared_meeting(check: Property, runtime: ObservedRuntime, callback: Callback) -> Concluded:
    """A framework declared to start members at once lets none wait until another one's on_startup has ended.

    Another one whose on_startup has ended, although the gate it held at was to open when both had come to it, was inside as
    long as there is patience.
    """
    member = callback.member
    if member is None or not member.declaration.plan or not _is_started(callback):
        return ()
    meeting = _gates(member) - runtime.opened
    return _meeting(check, runtime, callback, member, meeting) if meeting else ()


def _meeting(
    check: Property, runtime: ObservedRuntime, callback: Callback, member: Member, meeting: set[str]
) -> Conclusions:
    event, ongoing = callback.event, callback.ongoing
    gone = [m for m in map(runtime.bodies.get, runtime.starting) if m is not None and m is not member]
    before = next((m for m in gone if m.container is member.container and _gates(m) & meeting), None)
    if before is None or (yield from takes(runtime, "start-order", "one-by-one")):
        return
    yield check.fail(
        "one by one",
        expected="the vendor declares start-order = at-once: several members are inside on_startup at a time",
        observed=f"{member.lane} was not started within {runtime.scenario.patience} ms while {before.lane} was inside",
        during=(ongoing, event),
    )


def _is_started(callback: Callback) -> bool:
    """Does the callback come from a start of the instance's own container?"""
    member, ongoing = callback.member, callback.ongoing
    return (
        member is not None
        and ongoing is not None
        and (ongoing.operation, ongoing.container) == ("start", member.container)
    )


def _gates(member: Member) -> set[str]:
    """The gates at which its on_startup waits."""
    actions = member.declaration.plan.get("on_startup", ())
    return {action.gate for action in actions if isinstance(action, s.HoldAtGate)}


_HOOKS = {"transport": "transport-fault", "inside": "connector-fault"}


@property_at("closed", "R-10.1-01")
def core_claimed(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """The vendor claims every part of 10.1, and no scenario that asks for what is claimed is refused for want of it."""
    denied: dict[str, Skip] = {}
    for event in runtime.not_offered:
        step = runtime.scenario.steps[event.step]
        if _is_claimed(runtime, step):
            denied.setdefault(_what(step), event)
    for what, event in denied.items():
        yield check.fail(
            f"no {what}",
            expected=f"the adapter offers what the vendor claims: {what}",
            observed="the adapter said that it does not offer this operation",
            at=(event.n,),
            step=event.step,
        )
    links = runtime.interactions.links
    if not denied and (links or runtime.with_policies):
        yield check.kept()


def _is_claimed(runtime: ObservedRuntime, step: s.Step) -> bool:
    """Connectors are always claimed where a scenario asks for them; what only tests need is the vendor's to offer."""
    if isinstance(step, s.Break):
        return runtime.ics.reading(_HOOKS[step.where]) == "hook"
    if isinstance(step, s.Mend):
        return "hook" in (runtime.ics.reading(option) for option in _HOOKS.values())
    if isinstance(step, s.ReadLog):
        return runtime.ics.reading("trace-sink") == "hook"
    if isinstance(step, s.Advance):
        return runtime.ics.reading("virtual-time") == "hook"
    return isinstance(step, s.ConnectorCall)


def _what(step: s.Step) -> str:
    match step:
        case s.Link():
            return step.connector
        case s.Break():
            return f"{_HOOKS[step.where]} = hook"
        case s.ReadLog():
            return "trace-sink = hook"
        case s.Advance():
            return "virtual-time = hook"
        case _:
            return s.operation(step)
