"""Properties about the operations of Container and ContainerManager: how they end and what they give (11.2.2, 12.10)."""

from __future__ import annotations

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_values import printed
from ucm_cts.adapters.contract.trace import Reference, Return
from ucm_cts.reference_models.conclusions import Broken, Concluded, Conclusions
from ucm_cts.reference_models.findings import Arrow
from ucm_cts.reference_models.model.life_cycle import Row
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.operation import DECLARED_ERRORS, OperationInProgress
from ucm_cts.reference_models.model.runtime import Connection, Container, Member
from ucm_cts.reference_models.model.start_effects import is_stopped_late
from ucm_cts.reference_models.properties.declaration import Property, property_at, requirements

_FAILED_INIT = "R-12.10-22"

DECLARED = {
    "add_component": "R-12.10-04",
    "remove_component": "R-12.10-05",
    "get_port_element": "R-12.10-06",
    "connect": "R-12.10-07",
    "disconnect": "R-12.10-08",
    "start": "R-12.10-09",
    "stop": "R-12.10-10",
    "get_components": "R-12.10-11",
    "create_container": "R-12.10-12",
    "remove_container": "R-12.10-13",
    "destroy": "R-12.10-14",
}
"""Each operation's requirement to end as declared."""

_SMALLEST, _LARGEST = -(2**31), 2**31 - 1

_FROM_TABLE = (
    _FAILED_INIT,
    *requirements("""
    R-11.1.3-02 R-11.1.3-03 R-11.2.1.1-01 R-11.2.1.3-01 R-11.2.2.1-01 R-11.2.2.1-05 R-11.2.2.1-07 R-11.2.2.1-08
    R-11.2.2.1-10 R-11.2.2.2-02 R-11.2.2.2-03 R-11.2.2.2-06 R-11.2.3-06 R-11.2.3-07 R-11.2.3-08 R-11.2.3-10
    R-11.2.3-11 R-11.2.3-13 R-11.2.3-15 R-12.10-15 R-12.10-16 R-12.10-17 R-12.10-18 R-12.10-19 R-12.10-20
    R-12.10-21 R-12.10-23 R-12.10-24 R-12.10-26
"""),
)


@property_at("ended", *DECLARED.values(), even_after_removal=True)
def declared_errors(check: Property, runtime: ObservedRuntime, ongoing: OperationInProgress) -> Concluded:
    """Nothing but the declared exceptions leaves an operation."""
    if runtime.destroyed:  # there is no runtime any more that could answer
        return ()
    requirement, declared, end = DECLARED[ongoing.operation], DECLARED_ERRORS[ongoing.operation], ongoing.end
    if isinstance(end, Return) or end.error in declared:
        return requirement
    name = end.error if end.error != "UNDECLARED" else f"an undeclared exception ({end.detail})"
    return check.fail(
        f"{ongoing.operation} {end.error}",
        expected=f"{ongoing.what} returns or raises {' or '.join(declared)}",
        observed=f"{ongoing.what} raised {name}",
        ended=ongoing,
        instead=(Arrow(ongoing.container.name, "test", f"return or {' or '.join(declared)}"),),
        requirement=requirement,
    )


@property_at("ended", *_FROM_TABLE)
def outcomes(check: Property, runtime: ObservedRuntime, ongoing: OperationInProgress) -> Concluded:
    """The operation ends in a way that the life-cycle table permits for every instance concerned."""
    outcome = ongoing.outcome
    if outcome.forbidding is None and len(outcome.permitting) == 1:  # the common case
        return outcome.permitting[0].requirement
    kept = [check.kept(row.requirement) for row in outcome.permitting]
    return kept if outcome.forbidding is None else (*kept, *_forbidden(check, ongoing, outcome.forbidding))


def _forbidden(
    check: Property, ongoing: OperationInProgress, forbidding: tuple[Member | None, Row, frozenset[str]]
) -> Conclusions:
    member, row, permitted = forbidding
    answer = ongoing.outcome.answer
    yield Broken(row)
    instance = f"{member.lane} is {row.state}" if member else ""
    situation = ", ".join(filter(None, (instance, row.condition)))
    expected = " or ".join(a if a != "return" else "a normal return" for a in sorted(permitted))
    yield check.fail(
        f"{row.id} {answer}",
        expected=f"{ongoing.what} ends with {expected}{f' ({situation})' if situation else ''}",
        observed=f"{ongoing.what} {'returned' if answer == 'return' else f'raised {answer}'}",
        ended=ongoing,
        instead=(Arrow(ongoing.container.name, "test", " or ".join(sorted(permitted))),),
        requirement=row.requirement,
    )


@property_at("ended", "R-11.2.2.1-03", "R-12.10-02", at=("add_component",))
def component_ids(check: Property, runtime: ObservedRuntime, ongoing: OperationInProgress) -> Concluded:
    """Component ids are 32-bit, and distinct among the live members of a container."""
    end, container = ongoing.end, ongoing.container
    if not isinstance(end, Return):
        return ()
    if not isinstance(end.value, int) or not _SMALLEST <= end.value <= _LARGEST:
        return _out_of_range(check, ongoing, end, "component")
    is_used = any(not member.doubtful for member in container.present.with_id(end.value))
    return _in_range(check, ongoing, end, "component", is_used, is_used or container.has_certain_member())


@property_at("ended", "R-11.2.2.1-09", "R-12.10-03", at=("connect",))
def connection_ids(check: Property, runtime: ObservedRuntime, ongoing: OperationInProgress) -> Concluded:
    """Connection ids are 32-bit, and distinct among the live connections of a container."""
    end, step, container = ongoing.end, ongoing.step, ongoing.container
    if not isinstance(end, Return) or not ongoing.outcome.permitted:
        return ()
    assert isinstance(step, s.Connect)
    if not isinstance(end.value, int) or not _SMALLEST <= end.value <= _LARGEST:
        return _out_of_range(check, ongoing, end, "connection")

    def counts(connection: Connection) -> bool:
        """Does it stand beside the new one, which may have the id of what it takes the place of?"""
        client = connection.client
        is_replaced = client is ongoing.subject and connection.port == step.port
        return bool(connection.live) and not is_replaced and client.container is container

    is_used = any(map(counts, runtime.remembered.with_id(end.value)))
    has_others = is_used or any(map(counts, runtime.remembered.newest_in(container)))
    return _in_range(check, ongoing, end, "connection", is_used, has_others)


def _out_of_range(check: Property, ongoing: OperationInProgress, end: Return, kind: str) -> Concluded:
    text = f"{ongoing.what} returned {printed(end.value)}"
    expected = f"a {kind} id that fits in 32 bits"
    return check.fail("range", expected=expected, observed=text, event=end, requirement=check.stands_for[1])


def _in_range(
    check: Property, ongoing: OperationInProgress, end: Return, kind: str, is_used: bool, has_others: bool
) -> Concluded:
    """The id fits; ``is_used``: another live one has it; ``has_others``: there are other live ones, which could have it."""
    unique, in_range = check.stands_for
    if is_used:
        text = f"{ongoing.what} returned {end.value}, the id of another live {kind}"
        return in_range, check.fail(
            "in use", expected=f"a {kind} id not in use", observed=text, ended=ongoing, requirement=unique
        )
    return (in_range, unique) if has_others else in_range


@property_at("ended", "R-11.2.2.1-06", at=("get_port_element",))
def port_element_identity(check: Property, runtime: ObservedRuntime, ongoing: OperationInProgress) -> Concluded:
    """get_port_element gives the object that the designated body made for that name."""
    end = ongoing.end
    if not isinstance(ongoing.step, s.GetPortElement) or not isinstance(end, Return):
        return ()
    member, port = ongoing.subject, ongoing.step.port
    if member is None or member.suspended or not ongoing.outcome.permitted or port not in member.declaration.provides:
        return ()
    if isinstance(end.value, Reference) or end.value is None:
        wanted = Reference(member.component, member.instance or 1, port)
        if end.value == wanted:
            return check.kept()
        got = f"{end.value.component}'s {end.value.port}" if isinstance(end.value, Reference) else "a null reference"
        return check.fail(
            "null" if end.value is None else "another object",
            expected=f"get_port_element returns {member.lane}'s own {port}",
            observed=f"get_port_element returned {got}",
            ended=ongoing,
            instead=(Arrow(ongoing.container.name, "test", f"{member.lane}.{port}"),),
        )
    return ()


@property_at("ended", "R-11.2.2.1-14", _FAILED_INIT, at=("get_components",))
def membership(check: Property, runtime: ObservedRuntime, ongoing: OperationInProgress) -> Concluded:
    """get_components lists exactly the live members; a failed add has left nothing among them."""
    if not isinstance(ongoing.end, Return) or not ongoing.outcome.permitted:
        return ()
    listed = ongoing.end.value if isinstance(ongoing.end.value, tuple) else ()
    problem = listing_problem(runtime, ongoing.container, listed)
    after_failure = ongoing.container.failed_adds and (problem is None or problem.startswith("holds"))
    requirement = _FAILED_INIT if after_failure else check.stands_for[0]
    if problem is None:
        return (check.kept(requirement), check.kept())
    members = ", ".join(f"{m.id} ({m.lane})" for m in ongoing.container.live_members()) or "none"
    return check.fail(
        problem.split()[0],
        expected=f"{ongoing.what} lists the members: {members}",
        observed=f"{ongoing.what} returned {list(listed)}: it {problem}",
        ended=ongoing,
        requirement=requirement,
    )


def listing_problem(runtime: ObservedRuntime, container: Container, listed: tuple[int, ...]) -> str | None:
    """What is wrong with ``listed`` as the members of ``container``; the manager may list sub-containers' members too."""
    if container.of_doubt:
        return None
    live = [m.id for m in container.live_members()]
    known = set(listed)
    missing = [i for i in live if i not in known]
    if missing:
        return f"lacks {missing}"
    reachable = list(live)
    if len(runtime.containers) > 1 and container is runtime.containers[s.MANAGER]:
        reachable += [m.id for c in runtime.containers.values() if c is not container for m in c.live_members()]
    there = set(reachable)
    surplus = [i for i in listed if i not in there]
    if surplus:
        return f"holds {surplus}, which are no members"
    if len(listed) > len(reachable) or (len(set(live)) == len(live) and len(known) < len(listed) == len(live)):
        return "repeats an id"
    return None


@property_at("ended", "R-11.2.2.1-02", at=("add_component",))
def right_body(check: Property, runtime: ObservedRuntime, ongoing: OperationInProgress) -> Concluded:
    """The one body initialised by add_component is of the implementation asked for."""
    new = ongoing.outcome.initialised
    if not new or not isinstance(ongoing.step, s.AddComponent):
        return ()
    if ongoing.outcome.right_body:
        return check.kept()
    bodies = sorted({c.body for c in new})
    return check.fail(
        "wrong body" if len(bodies) == 1 else "several bodies",
        expected=f"add_component initialises one body of {ongoing.step.component}",
        observed=f"add_component initialised {', '.join(f'{c}#{i}' for c, i in bodies)}",
        at=tuple(c.n for c in new),
        step=ongoing.step_number,
        instead=(Arrow(ongoing.container.name, ongoing.step.component, "on_init"),),
    )


@property_at("ended", "R-11.2.2.1-13", at=("stop",))
def stop_order(check: Property, runtime: ObservedRuntime, ongoing: OperationInProgress) -> Concluded:
    """stop shuts members down in the reverse of the order they were started in, where they were not started at a time."""
    if not isinstance(ongoing.end, Return) or runtime.ics.reading("start-order") == "at-once":
        return ()
    if len(ongoing.container.startup_order) < 2:
        return ()
    started = [m for m in ongoing.container.startup_order if not m.gone and not m.suspended]
    when = {m: received[0].n for m in started if (received := ongoing.received(m, "on_shutdown"))}
    expected = list(reversed(when))
    if len(expected) < 2:
        return ()
    stopped = sorted(when, key=when.__getitem__)
    if not is_stopped_late(runtime, stopped):
        if stopped == expected:
            return check.kept()
        return ()
    return check.fail(
        "order",
        expected=f"stop shuts down {', '.join(m.lane for m in expected)}, the reverse of the start",
        observed=f"stop shut down {', '.join(m.lane for m in stopped)}",
        at=tuple(when[m] for m in stopped),
        step=ongoing.step_number,
        instead=tuple(Arrow(ongoing.container.name, m.lane, "on_shutdown") for m in expected),
    )
