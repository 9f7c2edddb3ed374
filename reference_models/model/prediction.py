"""Run a scenario on the reference model instead of a framework: the first permitted outcome of each operation happens.

Used to derive scenarios from the life-cycle table, never to find violations.
"""

from __future__ import annotations

import functools
from collections.abc import Iterator
from copy import copy
from typing import NamedTuple, get_args

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.trace import DeclaredError, Enter, Raise, Reference, Return
from ucm_cts.reference_models.model.expected_callbacks import Listener, pattern
from ucm_cts.reference_models.model.life_cycle import Row
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.operation import OperationInProgress
from ucm_cts.reference_models.model.operation_effects import apply
from ucm_cts.reference_models.model.row_selection import RowSelection, undone_by
from ucm_cts.reference_models.model.runtime import Connection, Container, Member


class Way(NamedTuple):
    """How an operation goes: its answer, and the callbacks for each role of its operation."""

    answer: str
    callbacks: tuple[tuple[str, ...], ...]


class Prediction:
    """A runtime of the model that carries out steps itself. Any number of them may share ``rows``."""

    def __init__(self, rows: RowSelection, components: dict[str, s.Declaration]) -> None:
        self._rows = rows
        self.runtime = ObservedRuntime(s.Scenario(components, ()))
        self._next_id = 0
        self._made: dict[str, int] = {}

    def fork(self) -> Prediction:
        """The same model once more, from here on on its own."""
        other = copy(self)
        other._made = dict(self._made)
        other.runtime = _copied(self.runtime)
        return other

    def begin(self, step: s.ContainerCall) -> OperationInProgress:
        """The operation in progress that ``step`` would begin now; nothing changes."""
        return self._rows.open(self.runtime, 0, step)

    def perform(self, step: s.ContainerCall) -> OperationInProgress:
        """Carry ``step`` out in the first way that suits every instance concerned."""
        ongoing = self.begin(step)
        return self._carry_out(ongoing, step, next(self.ways(ongoing)))

    def ways(self, ongoing: OperationInProgress) -> Iterator[Way]:
        """Ways to go that the table permits, the first one first: with each answer, each instance does each thing that it
        may do while the others do the first; what may be left out is left out by one way and not by another.
        """
        answers = [a for o in ongoing.roles[0][1].outcomes for a in o.answer] if ongoing.roles else ["return"]
        suiting = [a for a in answers if all(any(a in o.answer for o in row.outcomes) for _, row in ongoing.roles)]
        for answer in dict.fromkeys(suiting or answers[:1]):
            choices = [self._choices(ongoing, member, row, answer) for member, row in ongoing.roles]
            first = tuple(choice[0] for choice in choices)
            yield Way(answer, first)
            for index, choice in enumerate(choices):
                yield from (Way(answer, (*first[:index], other, *first[index + 1 :])) for other in choice[1:])

    def _choices(
        self, ongoing: OperationInProgress, member: Member | None, row: Row, answer: str
    ) -> tuple[tuple[str, ...], ...]:
        connectable = member.declaration.connectable if member else self._declares_connectable(ongoing.step)
        return _callbacks(row, answer, Listener(connectable, False, len(undone_by(ongoing, member)) if member else 0))

    def carry_out(self, step: s.ContainerCall, way: Way) -> OperationInProgress:
        """Carry ``step`` out in that ``way``, one of ``ways``."""
        return self._carry_out(self.begin(step), step, way)

    def _carry_out(self, ongoing: OperationInProgress, step: s.ContainerCall, way: Way) -> OperationInProgress:
        for (member, _), hooks in zip(ongoing.roles, way.callbacks, strict=True):
            component, instance = self._body(step, member)
            for hook in hooks if component else ():
                ongoing.add(Enter(0, 0, 0, component, instance, hook), (component, instance))  # type: ignore[arg-type]
        apply(self.runtime, ongoing, self._end(step, ongoing, way.answer))
        return ongoing

    def _end(self, step: s.ContainerCall, ongoing: OperationInProgress, answer: str) -> Return | Raise:
        if answer in get_args(DeclaredError):
            return Raise(0, 0, 0, 0, answer)  # type: ignore[arg-type]
        if isinstance(step, s.AddComponent | s.Connect):
            self._next_id += 1
            return Return(0, 0, 0, 0, self._next_id)
        if isinstance(step, s.GetPortElement) and ongoing.subject is not None:
            member: Member = ongoing.subject
            return Return(0, 0, 0, 0, Reference(member.component, member.instance or 1, step.port))
        return Return(0, 0, 0, 0)

    def _declares_connectable(self, step: s.Step) -> bool:
        declaration = self.runtime.scenario.components.get(step.component) if isinstance(step, s.AddComponent) else None
        return declaration is not None and declaration.connectable

    def _body(self, step: s.ContainerCall, member: Member | None) -> tuple[str, int]:
        if member is not None:
            return member.component, member.instance or 1
        if isinstance(step, s.AddComponent):
            self._made[step.component] = self._made.get(step.component, 0) + 1
            return step.component, self._made[step.component]
        return "", 0


@functools.cache
def _callbacks(row: Row, answer: str, listener: Listener) -> tuple[tuple[str, ...], ...]:
    """The sequences of callbacks that ``row`` permits with ``answer``, the shortest ones first."""
    outcomes = [o for o in row.outcomes if answer in o.answer] or row.outcomes[:1]
    patterns = [pattern(outcome, listener) for outcome in outcomes]
    least = [tuple(hook for hook, optional in tokens if not optional) for tokens in patterns]
    return tuple(dict.fromkeys((*least, *(tuple(hook for hook, _ in tokens) for tokens in patterns))))


def _copied(runtime: ObservedRuntime) -> ObservedRuntime:
    """As far as operations of containers change it."""
    containers: dict[int, Container] = {id(c): copy(c) for c in runtime.containers.values()}
    everyone = [m for c in runtime.containers.values() for m in c.members]
    members: dict[int, Member] = {id(m): copy(m) for m in everyone}
    remembered = [c for m in everyone for c in (*m.connections, *(m.handed_over or ()))]
    connections: dict[int, Connection] = {id(c): copy(c) for c in (*remembered, *runtime.connections.values())}
    for container in containers.values():
        container.replace([members[id(m)] for m in container.members])
        container.startup_order = {members[id(m)]: None for m in container.startup_order}
    for member in members.values():
        member.container = containers[id(member.container)]
        member.connections = [connections[id(c)] for c in member.connections]
        member.once_connected = set(member.once_connected)
        if member.handed_over is not None:
            member.handed_over = tuple(connections[id(c)] for c in member.handed_over)
    for connection in connections.values():
        connection.client = members[id(connection.client)]
        connection.provider = connection.provider and members[id(connection.provider)]
    other = copy(runtime)
    other.containers = {name: containers[id(c)] for name, c in runtime.containers.items()}
    other.members = {name: members[id(m)] for name, m in runtime.members.items()}
    other.inhabited = {containers[id(c)]: None for c in runtime.inhabited}
    other.present, other.behind = {members[id(m)]: None for m in runtime.present}, {}
    other.bodies = {body: members[id(m)] for body, m in runtime.bodies.items()}
    other.connections = {name: connections[id(c)] for name, c in runtime.connections.items()}
    other.references = {name: (r, m and members[id(m)]) for name, (r, m) in runtime.references.items()}
    other.remembered = runtime.remembered.copied(containers, members, connections)
    other.discarded, other.ports = set(runtime.discarded), dict(runtime.ports)
    other.startups, other.starting = dict(runtime.startups), set(runtime.starting)
    return other
