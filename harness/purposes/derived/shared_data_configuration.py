"""Builds scenarios of shared data: connections, writers and readers, and what they do one after the other."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Final, Literal

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_types import AnyType, Datum, Integer
from ucm_cts.adapters.contract.platform_interfaces import (
    CANCEL,
    FREEZE,
    NOTIFY,
    PUBLISH,
    READ,
    RELEASE,
    SHARED,
    SHARED_DATA,
    WRITE,
    named_interfaces,
)
from ucm_cts.adapters.contract.scenario import Action, Declaration, Policy, Scenario, Step
from ucm_cts.harness.purposes.derived.connection_steps import ConnectionSteps
from ucm_cts.harness.purposes.scripts import TestPurpose

_CLAUSE = "10.4.2"

BRIEF = 600
"""Milliseconds of patience where something is waited for in vain."""

QUIET = 50
"""Milliseconds in which nothing is to come."""

ELSEWHERE = "elsewhere"
"""Another container than the manager."""

INSIDE = "inside"
"""A gate that is closed until it is opened."""

_TYPES = "shared"
_NOWHERE = "nowhere"
_OUT, _IN = "set", "get"
"""The ports of writers and of readers."""

_ORDERS: Final = {PUBLISH: 11, CANCEL: 12, FREEZE: 13, RELEASE: 14, READ: 15}
"""What a component is called with to call that method, through its first port of that kind; ten more for the next port."""

_FIRST_WRITE = 100
"""To write its first value, a writer is called with this number, and with following ones for following values."""


@dataclass
class _Part:
    """A component under construction."""

    place: str
    policies: tuple[Policy, ...]
    calls: list[Action] = field(default_factory=list)
    entered: list[Action] = field(default_factory=list)
    held: bool = False
    provides: list[str] = field(default_factory=lambda: ["in.api"])
    requires: list[str] = field(default_factory=list)
    ports: dict[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Port:
    """A port of a writer or of a reader.

    ``of``: the name of its component. ``number``: from 0, among the ports of that kind that the component has.
    ``told``: the gate that the component passes when it is notified.
    """

    of: str
    port: str
    number: int
    told: str = ""

    def order(self, method: str) -> int:
        """What its component is called with to call ``method`` through it."""
        return _ORDERS[method] + 10 * self.number

    def call(self, method: str) -> Action:
        """The call of ``method`` through it, upon that order."""
        element = "writer_p" if self.port.startswith(_OUT) else "reader_p"
        return s.CallMethod(f"{self.port}.{element}", method, given=self.order(method))


@dataclass
class Configuration(ConnectionSteps):
    """A scenario under construction. Writers and readers have numbers, from 0, in the order in which they were added.

    ``of``, ``values``: the type that is shared, and what is written, one after the other; without values they are numbers.
    ``patience``: that of the scenario.
    """

    of: AnyType = field(default_factory=lambda: Integer("LONG"))
    values: tuple[Datum, ...] = ()
    patience: int = 2000
    steps: list[Step] = field(default_factory=list)
    parts: dict[str, _Part] = field(default_factory=dict)
    writers: list[Port] = field(default_factory=list)
    readers: list[Port] = field(default_factory=list)
    told: Counter[str] = field(default_factory=Counter)
    written: int = 0
    link: str = ""
    is_running: bool = False

    # the configuration

    def connection(self, name: str = "first") -> Configuration:
        """A further connection, which writers and readers that follow belong to."""
        self.link = name
        self.steps.append(s.Link(SHARED_DATA, _TYPES, name))
        return self

    def container(self) -> Configuration:
        """Another container, ``ELSEWHERE``."""
        self.steps.append(s.CreateContainer(ELSEWHERE))
        return self

    def writer(self, place: str = s.MANAGER, of_writer: int | None = None) -> Configuration:
        """A writer, or a further port of one."""
        name = f"writer {len(self.writers)}" if of_writer is None else self.writers[of_writer].of
        if of_writer is None:
            self._component(name, place)
        number = sum(other.of == name for other in self.writers)
        port = Port(name, f"{_OUT}{number or ''}", number)
        self._port(port, "sd_writer", {"writer_p": ("data_writer", False)})
        self.writers.append(port)
        self.parts[name].calls += map(port.call, (PUBLISH, CANCEL))
        return self

    def reader(
        self,
        place: str = s.MANAGER,
        policies: tuple[Policy, ...] = (),
        of_writer: int | None = None,
        of_reader: int | None = None,
        reads_inside: bool = False,
        held: bool = False,
    ) -> Configuration:
        """A reader, or a further port of a writer or of a reader, which is told with it. ``reads_inside``: it reads in each notification, too;
        ``held``: it is held inside ``exchange``, after what it does there.
        """
        name, told = f"reader {len(self.readers)}", f"told {len(self.readers)}"
        if of_reader is not None:
            name, told = self.readers[of_reader].of, self.readers[of_reader].told
        elif of_writer is not None:
            name = self.writers[of_writer].of
        else:
            self._component(name, place, policies)
        number = sum(other.of == name for other in self.readers)
        port = Port(name, f"{_IN}{number or ''}", number, told)
        elements = {"reader_p": ("data_reader", False), "notification_p": ("data_notification", True)}
        self._port(port, "sd_reader", elements)
        self.readers.append(port)
        part = self.parts[name]
        part.held = held
        part.calls += map(port.call, (FREEZE, RELEASE, READ))
        if of_reader is None:
            reads: list[Action] = [s.CallMethod(f"{port.port}.reader_p", READ)] if reads_inside else []
            part.entered += [*reads, s.HoldAtGate(told), s.Answer(NOTIFY, ())]
        return self

    def place_of(self, port: Port) -> str:
        """The container of a writer or a reader."""
        return self.parts[port.of].place

    def calls_inside(self, reader: int, method: str) -> Configuration:
        """A reader calls ``method`` in each notification, after what it calls there already."""
        port = self.readers[reader]
        entered = self.parts[port.of].entered
        calls = [action for action in entered if isinstance(action, s.CallMethod)]
        entered.insert(len(calls), s.CallMethod(f"{port.port}.reader_p", method))
        return self

    # what happens

    def start(self, *places: str) -> Configuration:
        """Start all, or these containers; the first time gates open that bodies only pass."""
        if not self.is_running:
            self.steps += map(s.OpenGate, dict.fromkeys(reader.told for reader in self.readers))
        self.is_running = True
        self.steps += map(s.Start, places or self._places())
        return self

    def stop(self, *places: str) -> Configuration:
        """Stop all, or these containers."""
        self.steps += map(s.Stop, places or reversed(self._places()))
        return self

    def write(self, writer: int = 0, times: int = 1) -> Configuration:
        """A writer sets a value, several times another one."""
        port = self.writers[writer]
        for _ in range(times):
            value = self.values[self.written] if self.values else 1000 * (writer + 1) + self.written
            order = _FIRST_WRITE + self.written
            self.parts[port.of].calls.append(s.CallMethod(f"{port.port}.writer_p", WRITE, (value,), given=order))
            self.written += 1
            self.steps.append(s.Invoke(f"tell {port.of}", order))
        return self

    def publish(self, writer: int = 0) -> Configuration:
        """A writer publishes."""
        return self._order(self.writers[writer], PUBLISH)

    def cancel(self, writer: int = 0) -> Configuration:
        """A writer cancels."""
        return self._order(self.writers[writer], CANCEL)

    def update(self, writer: int = 0, but: tuple[int, ...] = (), of: tuple[int, ...] | None = None) -> Configuration:
        """A writer sets a value and publishes it; wait until all readers are told, or those ``of``, ``but`` some of them."""
        self.write(writer).publish(writer)
        waiting = range(len(self.readers)) if of is None else of
        return self.await_told(*(reader for reader in waiting if reader not in but))

    def read(self, *readers: int) -> Configuration:
        """These readers read, or all."""
        for reader in readers or range(len(self.readers)):
            self._order(self.readers[reader], READ)
        return self

    def freeze(self, *readers: int) -> Configuration:
        """These readers freeze the value, or all."""
        for reader in readers or range(len(self.readers)):
            self._order(self.readers[reader], FREEZE)
        return self

    def release(self, *readers: int) -> Configuration:
        """These readers release it, or all."""
        for reader in readers or range(len(self.readers)):
            self._order(self.readers[reader], RELEASE)
        return self

    def await_told(self, *readers: int, times: int = 1) -> Configuration:
        """Wait until each of these readers has been notified so many times more."""
        for reader in readers:
            gate = self.readers[reader].told
            self.told[gate] += times
            self.steps.append(s.ReachGate(gate, total=self.told[gate]))
        return self

    def listen(self, reader: int) -> Configuration:
        """Wait for a further notification that may come or not."""
        gate = self.readers[reader].told
        self.steps.append(s.ReachGate(gate, total=self.told[gate] + 1))
        return self

    def wait_in_vain(self) -> Configuration:
        """Wait until patience has run out. A reader that has not got what it is owed by then never gets it."""
        self.steps.append(s.ReachGate(_NOWHERE))
        return self

    def apart(self, *orders: tuple[Literal["write", "publish", "read"], int]) -> Configuration:
        """Writers or readers do this at once, each on a thread of its own; wait for all of them."""
        threads = []
        for what, number in orders:
            port = (self.readers if what == "read" else self.writers)[number]
            threads.append(f"{what} {number}")
            order = port.order(READ if what == "read" else PUBLISH)
            self.steps.append(s.Invoke(f"tell {port.of}", order, thread=threads[-1]))
        self.steps += map(s.Join, threads)
        return self

    def enter(self, reader: int) -> Configuration:
        """A reader that is held inside is called, on a thread of its own."""
        port = self.readers[reader]
        inside = s.Invoke(f"tell {port.of}", port.order(READ), thread=f"inside {port.of}")
        self.steps += [inside, s.ReachGate(INSIDE, total=1)]
        return self

    def leave(self, reader: int) -> Configuration:
        """It is let go."""
        self.steps += [s.OpenGate(INSIDE), s.Join(f"inside {self.readers[reader].of}")]
        return self

    def remove(self, reader: int) -> Configuration:
        """Detach and remove a reader; all are stopped."""
        port = self.readers[reader]
        self.steps += [s.Detach(self.link, port.of, port.port), s.RemoveComponent(port.of)]
        return self

    def end(self) -> Scenario:
        """The scenario: everything is stopped."""
        stops = [s.Stop(place) for place in reversed(self._places())]
        types = {SHARED: self.of}
        return Scenario(
            {name: self._declared(part) for name, part in self.parts.items()},
            (*self.steps, *stops, s.GetComponents()),
            patience=self.patience,
            interfaces=named_interfaces(_TYPES, types),
            types={_TYPES: types},
        )

    def _declared(self, part: _Part) -> Declaration:
        held = [s.HoldAtGate(INSIDE)] if part.held else []
        plan = {"exchange": (*part.calls, *held), **({"method": tuple(part.entered)} if part.entered else {})}
        return Declaration(
            tuple(part.provides),
            tuple(part.requires),
            plan=plan,  # type: ignore[arg-type]
            policies=part.policies,
            ports=part.ports,
        )

    def _component(self, name: str, place: str, policies: tuple[Policy, ...] = ()) -> None:
        """A component with a port by which the test calls it."""
        self.parts[name] = _Part(place, policies)
        self.steps += [s.AddComponent(name, place), s.GetPortElement(name, "in.api", f"tell {name}", place)]

    def _port(self, port: Port, role: str, elements: dict[str, tuple[str, bool]]) -> None:
        part = self.parts[port.of]
        for element, (interface, provided) in elements.items():
            (part.provides if provided else part.requires).append(f"{port.port}.{element}")
            part.ports[f"{port.port}.{element}"] = f"{_TYPES}.{interface}"
        self.steps.append(s.Attach(self.link, role, port.of, port.port, part.place))  # type: ignore[arg-type]

    def _order(self, port: Port, method: str) -> Configuration:
        self.steps.append(s.Invoke(f"tell {port.of}", port.order(method)))
        return self

    def _places(self) -> list[str]:
        has_another = any(isinstance(step, s.CreateContainer) for step in self.steps)
        return [ELSEWHERE, s.MANAGER] if has_another else [s.MANAGER]


def purpose_about(name: str, text: str, requirements: str, scenarios: Sequence[tuple[str, Scenario]]) -> TestPurpose:
    """The test purpose of that name. ``requirements`` are identifiers without their beginning: ``2-06`` is R-10.4.2.2-06, ``.2-06`` is R-10.4.2-06
    and ``-04`` is R-10.4-04.
    """
    ids = tuple(f"R-10.4{one}" if one.startswith((".", "-")) else f"R-10.4.2.{one}" for one in requirements.split())
    cases = tuple((f"shared data/{n}", one) for n, one in scenarios)
    return TestPurpose(f"shared data/{name}", _CLAUSE, text, ids, cases)


def joined(writers: int, readers: int, elsewhere: bool = False, patience: int = 0) -> Configuration:
    """A connection with so many writers and readers; ``elsewhere``: every second reader is in another container."""
    made = Configuration(patience=patience) if patience else Configuration()
    if elsewhere:
        made.container()
    made.connection()
    for _ in range(writers):
        made.writer()
    for number in range(readers):
        made.reader(ELSEWHERE if elsewhere and number % 2 == 0 else s.MANAGER)
    return made
