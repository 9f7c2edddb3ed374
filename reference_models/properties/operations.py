"""Properties about the operations of Container and ContainerManager: how they end and what they give (11.2.2, 12.10)."""

from __future__ import annotations

import itertools

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.trace import Raise, Reference, Return
from ucm_cts.reference_models.findings import Arrow
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.operation_effects import received
from ucm_cts.reference_models.model.runtime import Container, OperationInProgress
from ucm_cts.reference_models.properties.declaration import property_at
from ucm_cts.reference_models.verdicts import Verdicts

DECLARED = {
    "add_component": ("R-12.10-04", ("UCM_ERROR",)),
    "remove_component": ("R-12.10-05", ("NOT_FOUND", "UCM_ERROR")),
    "get_port_element": ("R-12.10-06", ("NOT_FOUND", "UCM_ERROR")),
    "connect": ("R-12.10-07", ("NOT_FOUND", "BAD_PARAMETER", "UCM_ERROR")),
    "disconnect": ("R-12.10-08", ("NOT_FOUND", "UCM_ERROR")),
    "start": ("R-12.10-09", ("UCM_ERROR",)),
    "stop": ("R-12.10-10", ("UCM_ERROR",)),
    "get_components": ("R-12.10-11", ("UCM_ERROR",)),
    "create_container": ("R-12.10-12", ("UCM_ERROR",)),
    "remove_container": ("R-12.10-13", ("NOT_FOUND", "UCM_ERROR")),
    "destroy": ("R-12.10-14", ("UCM_ERROR",)),
}
"""Each operation's requirement to end as declared, and the exceptions 12.10 declares for it."""

_SMALLEST, _LARGEST = -(2**31), 2**31 - 1

_FROM_TABLE = [
    "R-11.1.3-02",
    "R-11.1.3-03",
    "R-11.2.1.1-01",
    "R-11.2.1.3-01",
    "R-11.2.2.1-01",
    "R-11.2.2.1-05",
    "R-11.2.2.1-07",
    "R-11.2.2.1-08",
    "R-11.2.2.1-10",
    "R-11.2.2.2-02",
    "R-11.2.2.2-03",
    "R-11.2.2.2-06",
    "R-11.2.3-06",
    "R-11.2.3-07",
    "R-11.2.3-08",
    "R-11.2.3-10",
    "R-11.2.3-11",
    "R-11.2.3-13",
    "R-11.2.3-15",
    "R-12.10-15",
    "R-12.10-16",
    "R-12.10-17",
    "R-12.10-18",
    "R-12.10-19",
    "R-12.10-20",
    "R-12.10-21",
    "R-12.10-22",
    "R-12.10-23",
    "R-12.10-24",
    "R-12.10-26",
]


@property_at("ended", *(requirement for requirement, _ in DECLARED.values()))
def declared_errors(
    verdicts: Verdicts, runtime: ObservedRuntime, ongoing: OperationInProgress, end: Return | Raise
) -> None:
    """Nothing but the declared exceptions leaves an operation."""
    requirement, declared = DECLARED[ongoing.operation]
    if isinstance(end, Return) or end.error in declared:
        verdicts.exercised(requirement)
        return
    ongoing.lost = True
    ongoing.judged = False
    name = end.error if end.error != "UNDECLARED" else f"an undeclared exception ({end.detail})"
    verdicts.violated(
        requirement,
        "declared_errors",
        f"{ongoing.operation} {end.error}",
        f"{ongoing.operation} returns or raises {' or '.join(declared)}",
        f"{ongoing.operation} raised {name}",
        (ongoing.call, end.n),
        ongoing.step_number,
        (Arrow(ongoing.container.name, "test", f"return or {' or '.join(declared)}"),),
    )


@property_at("ended", *_FROM_TABLE)
def outcomes(verdicts: Verdicts, runtime: ObservedRuntime, ongoing: OperationInProgress, end: Return | Raise) -> None:
    """The operation ends in a way that the life-cycle table permits for every instance concerned."""
    answer = "return" if isinstance(end, Return) else end.error
    if not ongoing.judged or (answer != "return" and answer not in DECLARED[ongoing.operation][1]):
        return
    if ongoing.forgiving and answer == "UCM_ERROR":
        ongoing.judged = False
        ongoing.lost = True
        return
    for member, row in ongoing.roles:
        permitted = verdicts.expected.answers_to(row)
        if answer in permitted:
            verdicts.exercised(row.requirement)
            continue
        ongoing.judged = False
        ongoing.lost = True
        verdicts.broken(row)
        instance = f"{member.lane} is {row.state}" if member else ""
        situation = ", ".join(filter(None, (instance, row.condition)))
        expected = " or ".join(a if a != "return" else "a normal return" for a in sorted(permitted))
        verdicts.violated(
            row.requirement,
            "outcomes",
            f"{row.id} {answer}",
            f"{ongoing.operation} ends with {expected}{f' ({situation})' if situation else ''}",
            f"{ongoing.operation} {'returned' if answer == 'return' else f'raised {answer}'}",
            (ongoing.call, end.n),
            ongoing.step_number,
            (Arrow(ongoing.container.name, "test", " or ".join(sorted(permitted))),),
        )
        return


@property_at("ended", "R-11.2.2.1-03", "R-12.10-02", at=("add_component",))
def component_ids(
    verdicts: Verdicts, runtime: ObservedRuntime, ongoing: OperationInProgress, end: Return | Raise
) -> None:
    """Component ids are 32-bit, and distinct among the live members of a container."""
    if isinstance(end, Return):
        live = [m.id for m in ongoing.container.live_members() if not m.doubtful]
        _identifier(verdicts, ongoing, end, live, "component", "R-11.2.2.1-03", "R-12.10-02")


@property_at("ended", "R-11.2.2.1-09", "R-12.10-03", at=("connect",))
def connection_ids(
    verdicts: Verdicts, runtime: ObservedRuntime, ongoing: OperationInProgress, end: Return | Raise
) -> None:
    """Connection ids are 32-bit, and distinct among the live connections of a container."""
    if isinstance(end, Return) and ongoing.judged:
        assert isinstance(ongoing.step, s.Connect)
        replaced = (ongoing.subject, ongoing.step.port)  # what it takes the place of may lend it its id
        others = [c for c in runtime.all_connections() if c.live and (c.client, c.port) != replaced]
        live = [c.id for c in others if c.client.container is ongoing.container]
        _identifier(verdicts, ongoing, end, live, "connection", "R-11.2.2.1-09", "R-12.10-03")


def _identifier(
    verdicts: Verdicts,
    ongoing: OperationInProgress,
    end: Return,
    live: list[int],
    kind: str,
    unique: str,
    in_range: str,
) -> None:
    value = end.value
    rule_name = f"{kind}_ids"
    if not isinstance(value, int) or not _SMALLEST <= value <= _LARGEST:
        text = f"{ongoing.operation} returned {value!r}"
        verdicts.violated(
            in_range, rule_name, "range", f"a {kind} id that fits in 32 bits", text, (end.n,), ongoing.step_number
        )
        return
    verdicts.exercised(in_range)
    if value in live:
        text = f"{ongoing.operation} returned {value}, the id of another live {kind}"
        verdicts.violated(
            unique, rule_name, "in use", f"a {kind} id not in use", text, (ongoing.call, end.n), ongoing.step_number
        )
    elif live:
        verdicts.exercised(unique)


@property_at("ended", "R-11.2.2.1-06", at=("get_port_element",))
def port_element_identity(
    verdicts: Verdicts, runtime: ObservedRuntime, ongoing: OperationInProgress, end: Return | Raise
) -> None:
    """get_port_element gives the object that the designated body made for that name."""
    if not isinstance(ongoing.step, s.GetPortElement) or not isinstance(end, Return):
        return
    member, port = ongoing.subject, ongoing.step.port
    if member is None or member.suspended or not ongoing.judged or port not in member.declaration.provides:
        return
    if isinstance(end.value, Reference) or end.value is None:
        wanted = Reference(member.component, member.instance or 1, port)
        if end.value == wanted:
            verdicts.exercised("R-11.2.2.1-06")
            return
        got = f"{end.value.component}'s {end.value.port}" if isinstance(end.value, Reference) else "a null reference"
        verdicts.violated(
            "R-11.2.2.1-06",
            "port_element_identity",
            "null" if end.value is None else "another object",
            f"get_port_element returns {member.lane}'s own {port}",
            f"get_port_element returned {got}",
            (ongoing.call, end.n),
            ongoing.step_number,
            (Arrow(ongoing.container.name, "test", f"{member.lane}.{port}"),),
        )


@property_at("ended", "R-11.2.2.1-14", "R-12.10-22", at=("get_components",))
def membership(verdicts: Verdicts, runtime: ObservedRuntime, ongoing: OperationInProgress, end: Return | Raise) -> None:
    """get_components lists exactly the live members; a failed add has left nothing among them."""
    if not isinstance(end, Return) or not ongoing.judged:
        return
    listed = end.value if isinstance(end.value, tuple) else ()
    problem = listing_problem(runtime, ongoing.container, listed)
    requirement = "R-11.2.2.1-14"
    if ongoing.container.failed_adds and (problem is None or problem.startswith("holds")):
        requirement = "R-12.10-22"
    if problem is None:
        verdicts.exercised(requirement)
        verdicts.exercised("R-11.2.2.1-14")
        return
    members = ", ".join(f"{m.id} ({m.lane})" for m in ongoing.container.live_members()) or "none"
    verdicts.violated(
        requirement,
        "membership",
        problem.split()[0],
        f"get_components lists the members: {members}",
        f"get_components returned {list(listed)}: {problem}",
        (ongoing.call, end.n),
        ongoing.step_number,
    )


def listing_problem(runtime: ObservedRuntime, container: Container, listed: tuple[int, ...]) -> str | None:
    """What is wrong with ``listed`` as the members of ``container``; the manager may list sub-containers' members too."""
    if container.of_doubt:
        return None
    live = [m.id for m in container.live_members()]
    missing = [i for i in live if i not in listed]
    if missing:
        return f"lacks {missing}"
    reachable = list(live)
    if len(runtime.containers) > 1 and container is runtime.containers[s.MANAGER]:
        reachable += [m.id for c in runtime.containers.values() if c is not container for m in c.live_members()]
    surplus = [i for i in listed if i not in reachable]
    if surplus:
        return f"holds {surplus}, not members"
    if len(listed) > len(reachable) or (len(set(live)) == len(live) and len(set(listed)) < len(listed) == len(live)):
        return "repeats an id"
    return None


@property_at("ended", "R-11.2.2.1-02", at=("add_component",))
def right_body(verdicts: Verdicts, runtime: ObservedRuntime, ongoing: OperationInProgress, end: Return | Raise) -> None:
    """The one body initialised by add_component is of the implementation asked for."""
    if not isinstance(ongoing.step, s.AddComponent) or not isinstance(end, Return) or not ongoing.judged:
        return
    new = [c for c in ongoing.callbacks if c.hook == "on_init" and (c.component, c.instance) not in runtime.bodies]
    bodies = sorted({(c.component, c.instance) for c in new})
    if not bodies:
        return
    if len(bodies) == 1 and bodies[0][0] == ongoing.step.component:
        verdicts.exercised("R-11.2.2.1-02")
        return
    ongoing.judged = False
    verdicts.violated(
        "R-11.2.2.1-02",
        "right_body",
        "wrong body" if len(bodies) == 1 else "several bodies",
        f"add_component initialises one body of {ongoing.step.component}",
        f"add_component initialised {', '.join(f'{c}#{i}' for c, i in bodies)}",
        tuple(c.n for c in new),
        ongoing.step_number,
        (Arrow(ongoing.container.name, ongoing.step.component, "on_init"),),
    )


@property_at("ended", "R-11.2.2.1-13", at=("stop",))
def stop_order(verdicts: Verdicts, runtime: ObservedRuntime, ongoing: OperationInProgress, end: Return | Raise) -> None:
    """stop shuts members down in the reverse of the order they were started in, where they were not started at a time."""
    if not isinstance(end, Return) or verdicts.ics.reading("start-order") == "at-once":
        return
    started = [m for m in ongoing.container.startup_order if not m.gone and not m.suspended]
    when = {id(m): received(ongoing, m, "on_shutdown") for m in started}
    stopped = sorted((m for m in started if when[id(m)]), key=lambda m: when[id(m)][0].n)
    expected = [m for m in reversed(started) if m in stopped]
    if len(expected) < 2:
        return
    if not any(runtime.started_before(one, other) for one, other in itertools.combinations(stopped, 2)):
        if stopped == expected:
            verdicts.exercised("R-11.2.2.1-13")
        return
    verdicts.violated(
        "R-11.2.2.1-13",
        "stop_order",
        "order",
        f"stop shuts down {', '.join(m.lane for m in expected)}, the reverse of the start",
        f"stop shut down {', '.join(m.lane for m in stopped)}",
        tuple(when[id(m)][0].n for m in stopped),
        ongoing.step_number,
        tuple(Arrow(ongoing.container.name, m.lane, "on_shutdown") for m in expected),
    )
