"""Rules about what the vendor states: what is claimed is there, and where the text leaves a choice, the framework does
what its vendor declares.
"""

from __future__ import annotations

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.trace import Enter, Raise, Return, Skip
from ucm_cts.reference_models.model.callback_history import Heard
from ucm_cts.reference_models.model.expected_callbacks import Fit
from ucm_cts.reference_models.model.life_cycle import Row
from ucm_cts.reference_models.model.runtime import Member, Runtime, Window, lane
from ucm_cts.reference_models.verdicts import Ledger, rule

_WITH_CHOICES = (
    "R-11.2.2.1-08",
    "R-11.2.2.2-02",
    "R-11.2.3-06",
    "R-11.2.3-07",
    "R-11.2.3-10",
    "R-11.2.3-11",
    "R-11.2.3-13",
    "R-11.2.3-15",
    "R-12.10-22",
    "R-12.10-23",
    "R-12.10-24",
)

_OF_ALL_AT_ONCE = ("double-start", "stop-when-stopped")
"""Options about a container as a whole."""


@rule("ended", *_WITH_CHOICES)
def declared_choices(ledger: Ledger, runtime: Runtime, window: Window, end: Return | Raise) -> None:
    """Where the life-cycle table permits several ways, an instance goes the one that the vendor declares."""
    fitted = [told for told in window.fitted if told[2].readings]
    telling = [told for told in fitted if _is_choice(window, end, *told)] if fitted else fitted
    if not telling:
        return
    together = isinstance(end, Raise) or any(_options(fit)[0] in _OF_ALL_AT_ONCE for _, _, fit in telling)
    if together and len(telling) < len(window.roles):
        return  # somebody else may be the reason
    undeclared = [told for told in telling if not _is_declared(ledger, told[2])]
    if undeclared and (not together or len(undeclared) == len(telling)):
        _belied(ledger, window, end, *undeclared[0])


def _is_choice(window: Window, end: Return | Raise, member: Member | None, row: Row, fit: Fit) -> bool:
    """Was the framework free to go another way, and is nothing but this choice the reason that it went this one?"""
    if row.operation == "remove_provider":  # whoever removes a container takes its members along, in use or not
        return window.operation == "remove_component"
    for option in _options(fit):
        if option == "manager-start":  # what is no start or stop of the manager's own has nothing to reach
            return window.container.started is (window.operation == "stop")
        if option == "stop-when-stopped":
            return window.container.started is False
    return isinstance(end, Return) or member is None or not _may_be_refused_anyway(window, member, row)


def _may_be_refused_anyway(window: Window, member: Member, row: Row) -> bool:
    """Does another choice speak against it, too? Ports are connected already, or what is removed is itself connected."""
    if isinstance(window.step, s.Connect):
        return row.condition != "already connected" and bool(member.live_connections(window.step.port))
    return window.operation == "remove_component" and row.condition != "connected" and bool(member.live_connections())


def _options(fit: Fit) -> list[str]:
    return [reading.partition("=")[0] for reading in fit.readings]


def _is_declared(ledger: Ledger, fit: Fit) -> bool:
    taken = [reading.partition("=")[::2] for reading in fit.readings]
    if len(taken) == 1:
        return ledger.observed(*taken[0])
    return any(ledger.claims.permits(option, value) for option, value in taken)


def _belied(ledger: Ledger, window: Window, end: Return | Raise, member: Member | None, row: Row, fit: Fit) -> None:
    declared = [f"{option} = {ledger.claims.reading(option)}" for option in dict.fromkeys(_options(fit))]
    taken = " or ".join(reading.replace("=", " = ") for reading in fit.readings)
    ledger.violated(
        row.requirement,
        "declared_choices",
        f"{row.id} {taken}",
        f"{window.operation} goes as the vendor declares: {', '.join(declared)}",
        f"it went the way of {taken}" + (f" ({member.lane}, {row.state})" if member is not None else ""),
        (window.call, end.n),
        window.step_number,
    )


@rule("ended", "R-11.2.2.1-14", at=("get_components",))
def declared_listing(ledger: Ledger, runtime: Runtime, window: Window, end: Return | Raise) -> None:
    """The manager lists members of its sub-containers if, and only if, the vendor declares so."""
    if window.container.name != s.MANAGER or not window.judged or not isinstance(end, Return):
        return
    below = [m for c in runtime.containers.values() if c is not window.container for m in c.live_members()]
    if not below or window.container.of_doubt or any(m.doubtful for m in below):
        return
    listed = end.value if isinstance(end.value, tuple) else ()
    reading = "recursive" if len(listed) > len(window.container.live_members()) else "own"
    if not ledger.observed("manager-get-components", reading):
        ledger.violated(
            "R-11.2.2.1-14",
            "declared_listing",
            reading,
            f"the vendor declares manager-get-components = {ledger.claims.reading('manager-get-components')}",
            f"get_components of the manager returned {list(listed)}, which is {reading}",
            (window.call, end.n),
            window.step_number,
        )


@rule("ended", "R-11.2.3-17", at=("stop",))
def declared_drain(ledger: Ledger, runtime: Runtime, window: Window, end: Return | Raise) -> None:
    """stop waits for calls in progress if the vendor declares so."""
    if not isinstance(end, Return) or not window.judged:
        return
    inside = {body for bodies in runtime.inside.values() for body in bodies}
    for member in window.container.live_members():
        if not member.operational or member.suspended or (member.component, member.instance) not in inside:
            continue
        if not ledger.observed("stop-drain", "abandon"):
            ledger.violated(
                "R-11.2.3-17",
                "declared_drain",
                "abandoned",
                "the vendor declares stop-drain = wait: stop returns when the calls in progress have ended",
                f"stop returned while {member.lane} was still carrying out a call",
                (window.call, end.n),
                window.step_number,
            )
        return


@rule("entered", "R-11.2.2.1-13", at=("on_startup",))
def declared_order(ledger: Ledger, runtime: Runtime, window: Window | None, event: Enter, heard: Heard) -> None:
    """Who declares that members are started one by one does not start them at a time, by several threads."""
    member = runtime.member_of(event.component, event.instance)
    if member is None or window is None or window.operation != "start" or member.container is not window.container:
        return
    beside = [body for body, thread in runtime.starting_up.items() if thread != event.thread]
    if beside and not ledger.observed("start-order", "at-once"):
        ledger.violated(
            "R-11.2.2.1-13",
            "declared_order",
            "at once",
            "the vendor declares start-order = one-by-one: one on_startup has returned before the next one comes",
            f"{member.lane} received on_startup while {lane(*beside[0])} was still inside its own",
            (event.n,),
            window.step_number,
        )


@rule("entered", "R-11.2.2.1-13", at=("on_startup",), timed=True)
def declared_meeting(ledger: Ledger, runtime: Runtime, window: Window | None, event: Enter, heard: Heard) -> None:
    """Who declares that members are started at once does not let one wait until another one's on_startup has ended.

    Another one whose on_startup has ended, although the gate it held at was to open when both had come to it, was inside as
    long as there is patience.
    """
    member = runtime.member_of(event.component, event.instance)
    if member is None or window is None or window.operation != "start" or member.container is not window.container:
        return
    meeting = _gates(member) - runtime.opened
    gone = [m for m in map(runtime.bodies.get, runtime.starting) if m is not None and m is not member]
    before = next((m for m in gone if m.container is member.container and _gates(m) & meeting), None)
    if before is None or ledger.observed("start-order", "one-by-one"):
        return
    ledger.violated(
        "R-11.2.2.1-13",
        "declared_meeting",
        "one by one",
        "the vendor declares start-order = at-once: several members are inside on_startup at a time",
        f"{member.lane} was not started within {runtime.scenario.patience} ms while {before.lane} was inside",
        (event.n,),
        window.step_number,
    )


def _gates(member: Member) -> set[str]:
    """The gates at which its on_startup waits."""
    actions = member.declaration.plan.get("on_startup", ())
    return {action.gate for action in actions if isinstance(action, s.HoldAtGate)}


_HOOKS = {"transport": "transport-fault", "inside": "connector-fault"}


@rule("closed", "R-10.1-01")
def core_claimed(ledger: Ledger, runtime: Runtime) -> None:
    """The vendor claims every part of 10.1, and no scenario that asks for what is claimed is refused for want of it."""
    denied: dict[str, Skip] = {}
    for event in runtime.not_offered:
        step = runtime.scenario.steps[event.step]
        if _is_claimed(ledger, step):
            denied.setdefault(_what(step), event)
    for what, event in denied.items():
        ledger.violated(
            "R-10.1-01",
            "core_claimed",
            f"no {what}",
            f"the adapter offers what the vendor claims: {what}",
            "the adapter said that it does not offer this operation",
            (event.n,),
            event.step,
        )
    links = runtime.interactions.links if runtime.interactions is not None else {}
    if not denied and (links or runtime.with_policies):
        ledger.exercised("R-10.1-01")


def _is_claimed(ledger: Ledger, step: s.Step) -> bool:
    """Connectors are always claimed where a scenario asks for them; what only tests need is the vendor's to offer."""
    if isinstance(step, s.Break):
        return ledger.claims.reading(_HOOKS[step.where]) == "hook"
    if isinstance(step, s.Mend):
        return "hook" in (ledger.claims.reading(option) for option in _HOOKS.values())
    if isinstance(step, s.ReadLog):
        return ledger.claims.reading("trace-sink") == "hook"
    return isinstance(step, s.ConnectorCall)


def _what(step: s.Step) -> str:
    match step:
        case s.Link():
            return step.connector
        case s.Break():
            return f"{_HOOKS[step.where]} = hook"
        case s.ReadLog():
            return "trace-sink = hook"
        case _:
            return s.operation(step)
