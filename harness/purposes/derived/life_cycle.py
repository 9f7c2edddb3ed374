"""Scenarios derived from the life-cycle table: every row is reached in several ways, in the manager and below it.

For small sets of components the model's state space is searched breadth first; each step tried in each state visits
rows of the table, and the shortest ways to each row become the scenarios of that row's test purpose.
"""

from __future__ import annotations

from collections import Counter, deque
from collections.abc import Iterator
from dataclasses import dataclass

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import ContainerCall, Declaration, Scenario, Step
from ucm_cts.adapters.contract.traits import used_by
from ucm_cts.harness.purposes.scripts import TestPurpose
from ucm_cts.reference_models.model.life_cycle import LifeCycleTable, Row
from ucm_cts.reference_models.model.prediction import Prediction
from ucm_cts.reference_models.model.runtime import Member

WAYS_TO_A_ROW = 4
"""How many scenarios are kept for each row, set of components and kind of instance: the shortest ones."""

_DEEPEST = 9
_SERVER = Declaration(provides=("in.api",), connectable=True)
_CLIENT = Declaration(requires=("out.api",), connectable=True)
_FORK = Declaration(requires=("left.api", "right.api"), connectable=True)
_HERMIT = Declaration()


@dataclass(frozen=True)
class Configuration:
    """Components, and what is done with them.

    ``name``: for ids.
    ``components``: by name.
    ``moves``: steps that change the state.
    ``probes``: steps that only observe it.
    """

    name: str
    components: dict[str, Declaration]
    moves: tuple[ContainerCall, ...]
    probes: tuple[ContainerCall, ...] = ()


def generated_purposes(table: LifeCycleTable) -> list[TestPurpose]:
    """One test purpose for each row of ``table`` that any configuration can reach, in the table's order."""
    ways: dict[str, list[tuple[str, Scenario]]] = {}
    for configuration in _casts():
        for row_id, count, scenario in _explore(table, configuration):
            ways.setdefault(row_id, []).append((f"{row_id}/{configuration.name}/{count}", scenario))
    return [
        TestPurpose(row.id, _clause(row), describe(row), (row.requirement,), tuple(ways[row.id]))
        for row in table.rows
        if row.id in ways
    ]


def describe(row: Row) -> str:
    """A row of the table in words."""
    subject = "what does not exist" if row.state == "absent" else f"an instance that is {row.state}"
    return f"{row.operation} on {subject}" + (f": {row.condition}" if row.condition else "")


def _clause(row: Row) -> str:
    return row.requirement.split("-")[1]


def _explore(table: LifeCycleTable, configuration: Configuration) -> Iterator[tuple[str, int, Scenario]]:
    numbers: dict[str, int] = {}
    kept: Counter[tuple[str, tuple[bool, ...]]] = Counter()
    seen: set[object] = set()
    queue: deque[tuple[ContainerCall, ...]] = deque([()])
    while queue:
        path = queue.popleft()
        now = _replay(table, configuration, path)
        if now.runtime.destroyed:
            continue
        for step in configuration.probes + configuration.moves:
            if not _bound(now, step):
                continue
            seen_now = {(row.id, _kind(now, member)) for member, row in now.look(step).roles}
            wanted = {row_id for row_id, kind in seen_now if kept[row_id, kind] < WAYS_TO_A_ROW}
            kept.update(seen_now)
            for row_id in sorted(wanted):
                numbers[row_id] = numbers.get(row_id, 0) + 1
                yield row_id, numbers[row_id], Scenario(configuration.components, (*path, step, *_afterwards(step)))
        if len(path) == _DEEPEST:
            continue
        for step in configuration.moves:
            if not _bound(now, step) or _rebinds(now, step):
                continue
            then = _replay(table, configuration, (*path, step))
            key = _key(then)
            if key not in seen:
                seen.add(key)
                queue.append((*path, step))


def _kind(now: Prediction, member: Member | None) -> tuple[bool, ...]:
    """The kind of an instance within one row: connected, used by others, started before."""
    if member is None:
        return ()
    return bool(member.live_connections()), any(now.runtime.clients_of([member])), member.startups > 0


def _replay(table: LifeCycleTable, configuration: Configuration, path: tuple[ContainerCall, ...]) -> Prediction:
    prediction = Prediction(table, configuration.components)
    for step in path:
        prediction.perform(step)
    return prediction


def _afterwards(step: ContainerCall) -> tuple[Step, ...]:
    """Steps that show whether the framework still works."""
    container = getattr(step, "container", s.MANAGER)
    if isinstance(step, s.Destroy) or container == s.NIL:
        return ()
    if isinstance(step, s.RemoveContainer):
        return (s.GetComponents(),)
    return s.GetComponents(container), s.Start(container), s.Stop(container), s.GetComponents(container)


def _bound(now: Prediction, step: ContainerCall) -> bool:
    runtime = now.runtime
    known = {
        s.MANAGER,
        s.UNKNOWN,
        s.NIL,
        *runtime.containers,
        *runtime.members,
        *runtime.connections,
        *runtime.references,
    }
    return all(variable in known for variable in used_by(step))


def _rebinds(now: Prediction, step: ContainerCall) -> bool:
    """Steps whose variable is in use are tried as the last step only; it keeps the search small."""
    runtime = now.runtime
    match step:
        case s.AddComponent():
            return (step.bind or step.component) in runtime.members
        case s.Connect():
            connection = runtime.connections.get(step.bind)
            return connection is not None and connection.live is not False
        case s.CreateContainer():
            return step.bind in runtime.containers
        case s.GetPortElement():
            return step.bind in runtime.references
        case _:
            return False


def _key(prediction: Prediction) -> object:
    runtime = prediction.runtime
    return (
        tuple((c.name, c.started, c.removed) for c in runtime.containers.values()),
        tuple(sorted((m.name, m.state, m.startups > 0, m.suspended) for m in runtime.members.values())),
        tuple(sorted((c.name, c.live is None, bool(c.live)) for c in runtime.connections.values())),
        tuple(sorted(runtime.references)),
        runtime.destroyed,
    )


def _casts() -> Iterator[Configuration]:
    for container in (s.MANAGER, "box"):
        yield _pair(container)
    yield _fork()
    yield _kinds()
    yield _mirror()
    yield _used_relay()
    yield _loose_client()
    yield _containers()
    yield _across()
    yield _strangers()
    for hook in ("on_init", "on_startup", "on_shutdown", "on_remove"):
        yield _failing(hook)


def _within(container: str) -> tuple[ContainerCall, ...]:
    return () if container == s.MANAGER else (s.CreateContainer(container),)


def _pair(container: str) -> Configuration:
    moves: tuple[ContainerCall, ...] = (
        *_within(container),
        s.AddComponent("server", container),
        s.AddComponent("client", container),
        s.GetPortElement("server", "in.api", "api", container),
        s.Connect("client", "out.api", "api", "link", container),
        s.Disconnect("link", container),
        s.Start(container),
        s.Stop(container),
        s.RemoveComponent("client", container),
        s.RemoveComponent("server", container),
    )
    probes: tuple[ContainerCall, ...] = (
        s.AddComponent("nobody", container, "ghost"),
        s.AddComponent("server", container, "second"),
        s.AddComponent("client", container, "late"),
        s.RemoveComponent(s.UNKNOWN, container),
        s.GetPortElement(s.UNKNOWN, "in.api", "x", container),
        s.GetPortElement("server", "in.api", "x", container),
        s.GetPortElement("server", "else.where", "x", container),
        s.GetPortElement("client", "out.api", "x", container),
        s.GetPortElement("client", "else.where", "x", container),
        s.Connect(s.UNKNOWN, "out.api", "api", "x", container),
        s.Connect("client", "else.where", "api", "x", container),
        s.Connect("client", "out.api", s.NIL, "x", container),
        s.Connect("client", "out.api", "api", "x", container),
        s.Disconnect(s.UNKNOWN, container),
        s.GetComponents(container),
        s.Destroy(),
    )
    if container != s.MANAGER:
        probes = (*probes, s.RemoveContainer(container), s.RemoveContainer(s.NIL), s.Start(), s.Stop())
    return Configuration(
        "pair" if container == s.MANAGER else "pair-below", {"server": _SERVER, "client": _CLIENT}, moves, probes
    )


def _fork() -> Configuration:
    return Configuration(
        "fork",
        {"server": _SERVER, "client": _FORK},
        (
            s.AddComponent("server"),
            s.AddComponent("client"),
            s.GetPortElement("server", "in.api", "api"),
            s.Connect("client", "left.api", "api", "left"),
            s.Connect("client", "right.api", "api", "right"),
            s.Disconnect("left"),
            s.Start(),
            s.Stop(),
        ),
        (
            s.Connect("client", "left.api", "api", "second"),
            s.Connect("client", "left.api", s.NIL, "x"),
            s.RemoveComponent("client"),
            s.RemoveComponent("server"),
            s.Destroy(),
        ),
    )


def _mirror() -> Configuration:
    return Configuration(
        "mirror",
        {
            "mirror": Declaration(("in.api",), ("out.api",), {}, True),
            "facets": Declaration(("in.api",), ("left.api", "right.api"), {}, True),
        },
        (
            s.AddComponent("mirror"),
            s.AddComponent("facets"),
            s.GetPortElement("mirror", "in.api", "own"),
            s.GetPortElement("facets", "in.api", "self"),
            s.Connect("mirror", "out.api", "own", "link"),
            s.Connect("facets", "left.api", "self", "left"),
            s.Connect("facets", "right.api", "own", "right"),
        ),
        (s.Connect("mirror", "in.api", "self", "x"),),
    )


def _kinds() -> Configuration:
    relay = Declaration(("in.api",), ("out.api",), {}, True)
    return Configuration(
        "kinds",
        {"component": relay, "fragment": Declaration(("in.api",), (), {}, False, True), "plain": _HERMIT},
        (
            s.AddComponent("component"),
            s.AddComponent("fragment"),
            s.GetPortElement("fragment", "in.api", "to-fragment"),
            s.GetPortElement("component", "in.api", "to-component"),
            s.Connect("component", "out.api", "to-fragment", "link"),
            s.Start(),
            s.Stop(),
        ),
        (
            s.AddComponent("plain"),
            s.Connect("component", "in.api", "to-fragment", "x"),
            s.GetPortElement("component", "out.api", "x"),
            s.GetPortElement("component", "in.api", "x"),
            s.RemoveComponent("fragment"),
            s.RemoveComponent("component"),
        ),
    )


def _used_relay() -> Configuration:
    relay = Declaration(("in.api",), ("out.api",), {}, True)
    return Configuration(
        "used-relay",
        {"relay": relay, "client": _CLIENT},
        (
            s.AddComponent("relay"),
            s.AddComponent("client"),
            s.GetPortElement("relay", "in.api", "api"),
            s.Connect("client", "out.api", "api", "link"),
        ),
        (s.RemoveComponent("relay"), s.RemoveComponent("client"), s.Start(), s.Destroy()),
    )


def _loose_client() -> Configuration:
    return Configuration(
        "not-connectable",
        {"server": _SERVER, "client": Declaration(requires=("out.api",))},
        (
            s.AddComponent("server"),
            s.AddComponent("client"),
            s.GetPortElement("server", "in.api", "api"),
            s.Connect("client", "out.api", "api", "link"),
            s.Disconnect("link"),
            s.Start(),
            s.Stop(),
        ),
        (s.RemoveComponent("client"), s.Destroy()),
    )


def _containers() -> Configuration:
    return Configuration(
        "containers",
        {"here": _HERMIT, "there": _CLIENT, "top": _HERMIT},
        (
            s.CreateContainer("one"),
            s.CreateContainer("two"),
            s.AddComponent("here", "one"),
            s.AddComponent("top"),
            s.Start("one"),
            s.Stop("one"),
            s.RemoveContainer("one"),
        ),
        (
            s.AddComponent("there", "two"),
            s.Start(),
            s.Stop(),
            s.Start("two"),
            s.RemoveContainer("two"),
            s.Destroy(),
            s.GetComponents(),
        ),
    )


def _across() -> Configuration:
    return Configuration(
        "across",
        {"server": _SERVER, "client": _CLIENT},
        (
            s.CreateContainer("back"),
            s.AddComponent("server", "back"),
            s.AddComponent("client"),
            s.GetPortElement("server", "in.api", "api", "back"),
            s.Connect("client", "out.api", "api", "link"),
            s.Start("back"),
            s.Start(),
        ),
        (
            s.RemoveComponent("server", "back"),
            s.RemoveContainer("back"),
            s.Stop("back"),
            s.Stop(),
            s.Destroy(),
            s.RemoveComponent("client", "back"),
            s.Disconnect("link", "back"),
        ),
    )


def _strangers() -> Configuration:
    """Identifiers are used with a container that did not give them out."""
    return Configuration(
        "strangers",
        {"server": _SERVER, "client": Declaration(("in.api",), ("out.api",), {}, True)},
        (
            s.CreateContainer("one"),
            s.CreateContainer("two"),
            s.AddComponent("server", "one"),
            s.AddComponent("client", "two"),
            s.GetPortElement("server", "in.api", "api", "one"),
            s.Connect("client", "out.api", "api", "link", "two"),
            s.Start("one"),
            s.Start("two"),
        ),
        (
            s.RemoveComponent("client", "one"),
            s.GetPortElement("client", "in.api", "x", "one"),
            s.Connect("client", "out.api", "api", "x", "one"),
            s.Disconnect("link", "one"),
        ),
    )


def _failing(hook: s.Hook) -> Configuration:
    broken = Declaration(plan={hook: (s.RaiseError(),)})
    broken_client = Declaration(requires=("out.api",), plan={hook: (s.RaiseError(),)})
    return Configuration(
        f"failing-{hook}",
        {"raising": broken, "sound": _HERMIT, "raising-client": broken_client},
        (s.AddComponent("sound"), s.AddComponent("raising"), s.AddComponent("raising-client"), s.Start(), s.Stop()),
        (s.RemoveComponent("raising"), s.RemoveComponent("raising-client")),
    )
