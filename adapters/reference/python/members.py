"""Members of containers and the connections between them (11.2), which all other parts of a container use."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from enum import Enum

from ucm_cts.adapters.contract import programming_model as pm
from ucm_cts.adapters.reference.python.execution import Execution
from ucm_cts.adapters.reference.python.timers import Timers


class State(Enum):
    """Where a member is in the life cycle of 11.2.3; initialized and configured differ only in its connections."""

    CONFIGURING = "initialized or configured"
    READY = "ready"


class Member:
    """A component or fragment in a container: its body, its implementation and its state."""

    def __init__(
        self, number: int, implementation: pm.Implementation, body: pm.ComponentObject, container: HasMembers
    ) -> None:
        self.id = number
        self.implementation = implementation
        self.body = body
        self.container = container
        self.state = State.CONFIGURING
        self.execution = Execution(implementation.policies)
        self.traced: dict[str, pm.PortElementObject] = {}
        self.timers: Timers | None = None
        self.schedulers: list[Timers] = []


@dataclass(frozen=True)
class Connection:
    """Required port element ``port`` of ``client``, connected to ``target``."""

    id: int
    client: Member
    port: str
    target: pm.PortElementObject


class Failures:
    """Carries on when a body raises, and remembers that it did."""

    def __init__(self) -> None:
        self.first = ""

    def attempt(self, callback: Callable[..., None], *arguments: object) -> bool:
        """Call a body; False if it raised."""
        try:
            callback(*arguments)
        except Exception as error:  # noqa: BLE001 - a body may raise anything
            self.first = self.first or f"{callback.__name__} raised {type(error).__name__}: {error}"
            return False
        return True

    def report(self) -> None:
        """Raise ``UcmError`` if any call failed."""
        if self.first:
            raise pm.UcmError(self.first)


class HasMembers:
    """The part of a container that knows its members and their connections. One concern each, for variants to override."""

    manager: HasMembers
    members: dict[int, Member]
    started: list[Member]
    is_started: bool
    is_removed: bool

    # what the manager keeps for all containers of the runtime

    connections: dict[int, Connection]
    numbers: Iterator[int]
    lock: threading.Lock
    busy_thread: int | None

    @contextmanager
    def _operation(self) -> Iterator[None]:
        """Carry out one operation at a time. A body that calls its container meanwhile gets ``UcmError``."""
        if self.manager.busy_thread == threading.get_ident():
            raise pm.UcmError("the runtime is in the middle of an operation")
        with self.manager.lock:
            self.manager.busy_thread = threading.get_ident()
            try:
                self._check_alive()
                yield
            finally:
                self.manager.busy_thread = None

    def _find_member(self, number: int) -> Member:
        if number not in self.members:
            raise pm.NotFound(f"no component {number}")
        return self.members[number]

    def _check_alive(self) -> None:
        if self.manager.is_removed or self.is_removed:
            raise pm.UcmError("the container has been removed")

    def _check_configuring(self) -> None:
        """Members and their connections change in the configuration phase only (11.2.3)."""
        if self.is_started:
            raise pm.UcmError("the container has been started")

    def _new_id(self) -> int:
        """A number that no component or connection of the runtime has, had or will have."""
        return next(self.manager.numbers)

    def _is_connected(self, member: Member, port: str) -> bool:
        return any(connection.port == port for connection in self._connections_from(member))

    def _connections_from(self, member: Member) -> list[Connection]:
        return [c for c in self.manager.connections.values() if c.client is member]

    def _reference_to(self, member: Member, port: str) -> pm.PortElementObject | None:
        """The reference to a provided port element: always the same object."""
        return member.body.get_portElement(port)

    def _connect_to(self, member: Member, port: str, target: pm.PortElementObject) -> int:
        connection = Connection(self._new_id(), member, port, target)
        self._connect(connection)
        return connection.id

    def _undo(self, connection: Connection) -> None:
        failures = Failures()
        self._disconnect(connection, failures)
        failures.report()

    def _connect(self, connection: Connection) -> None:
        body = connection.client.body
        if isinstance(body, pm.Connectable):
            failures = Failures()
            failures.attempt(body.on_connect, connection.port, connection.target)
            failures.report()
        self.manager.connections[connection.id] = connection

    def _disconnect(self, connection: Connection, failures: Failures) -> None:
        del self.manager.connections[connection.id]
        body = connection.client.body
        if isinstance(body, pm.Connectable):
            failures.attempt(body.on_disconnect, connection.port)
