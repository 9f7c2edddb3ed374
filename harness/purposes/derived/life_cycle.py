"""Scenarios derived from the life-cycle table: every row is reached in several ways, in the manager and below it.

For small sets of components the model's state space is searched breadth first; each step tried in each state visits
rows of the table, and the shortest ways to each row become the scenarios of that row's test purpose.
"""

from __future__ import annotations

from collections import Counter, deque
from collections.abc import Iterator

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import ContainerCall, Declaration, Scenario, Step
from ucm_cts.adapters.contract.traits import used_by
from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.catalogue.documents import read
from ucm_cts.harness.catalogue.requirements import SUITE
from ucm_cts.harness.purposes.scripts import TestPurpose
from ucm_cts.reference_models.model.life_cycle import LifeCycleTable, Row
from ucm_cts.reference_models.model.prediction import Prediction
from ucm_cts.reference_models.model.row_selection import RowSelection
from ucm_cts.reference_models.model.runtime import Member

WAYS_TO_A_ROW = 4
"""How many scenarios are kept for each row, set of components and kind of instance: the shortest ones."""

_DEEPEST = 9


class Configuration(Value, frozen=True):
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
    for configuration in read(SUITE / "life_cycle_configurations.yaml", list[Configuration]):
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
    queue: deque[tuple[tuple[ContainerCall, ...], Prediction]] = deque()
    queue.append(((), Prediction(RowSelection(table), configuration.components)))
    while queue:
        path, now = queue.popleft()
        if now.runtime.destroyed:
            continue
        for step in configuration.probes + configuration.moves:
            if not _bound(now, step):
                continue
            seen_now = {(row.id, _kind(now, member)) for member, row in now.begin(step).roles}
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
            then = now.fork()
            then.perform(step)
            key = _key(then)
            if key not in seen:
                seen.add(key)
                queue.append(((*path, step), then))


def _kind(now: Prediction, member: Member | None) -> tuple[bool, ...]:
    """The kind of an instance within one row: connected, used by others, started before."""
    if member is None:
        return ()
    return bool(member.live_connections()), any(now.runtime.clients_of([member])), member.startups > 0


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
