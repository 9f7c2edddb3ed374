"""Scenarios of messages: emitters and receivers in all small numbers and places, one by one and at once (10.1.6).

Receivers pass an open gate at each arrival, so that a scenario waits for messages and never sleeps. To see that a message does
not come, the scenario waits for another one that was pushed later, on the same way.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass, field

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_types import Datum, Integer, Interface, String, Structure, message_interface
from ucm_cts.adapters.contract.data_types import Sequence as SequenceType
from ucm_cts.adapters.contract.scenario import Declaration, Scenario, Step
from ucm_cts.harness.purposes.connections import MESSAGE, provided_end, required_end
from ucm_cts.harness.purposes.scripts import TestPurpose

_CLAUSE = "10.1.6.1"
_MOST = 3
"""Emitters, and receivers, of one connection."""

_MESSAGES = 2
"""The numbers that an emitter pushes one after the other at each call."""

_MANY = 50
_BLOCK = 2**20
"""The size of the block of numbers that one burst uses."""

_NUMBER = Integer("ULONG")
_NOTE = Structure("note", {"number": _NUMBER, "text": String("CHAR8"), "others": SequenceType(_NUMBER)})

_NUMBERS, _NOTES = "numbers", "notes"
_INTERFACES = {_NUMBERS: message_interface(_NUMBER), _NOTES: message_interface(_NOTE)}


@dataclass
class _Configuration:
    """A scenario under construction: its components, the steps that set it up, and the container of each component."""

    is_spread: bool
    components: dict[str, Declaration] = field(default_factory=dict)
    steps: list[Step] = field(default_factory=list)
    places: dict[str, str] = field(default_factory=dict)
    interfaces: dict[str, Interface] = field(default_factory=dict)

    def link(self, name: str, interface: str) -> None:
        """A message connection."""
        self.interfaces[interface] = _INTERFACES[interface]
        self.steps.append(s.Link(MESSAGE, interface, name))

    def add(self, name: str, declaration: Declaration) -> None:
        """A component, in a container of its own if they are spread."""
        self.components[name] = declaration
        self.places[name] = f"place of {name}" if self.is_spread else s.MANAGER
        if self.is_spread:
            self.steps.append(s.CreateContainer(self.places[name]))
        self.steps.append(s.AddComponent(name, self.places[name]))

    def add_receiver(self, name: str, link: str, declaration: Declaration) -> None:
        """A receiver of ``link``."""
        self.add(name, declaration)
        self.steps.append(provided_end(MESSAGE, link, name, container=self.places[name]))

    def add_emitter(self, name: str, link: str, declaration: Declaration) -> None:
        """An emitter of ``link``; a call through the reference of its name makes it push."""
        self.add(name, declaration)
        self.steps.append(required_end(MESSAGE, link, name, container=self.places[name]))
        self.steps.append(s.GetPortElement(name, "in.api", f"tell {name}", self.places[name]))

    def scenario(self, calls: Sequence[Step], patience: int = 2000, may_stay: tuple[str, ...] = ()) -> Scenario:
        """Start all, receivers first, take ``calls``, stop all, emitters first. Workers in ``may_stay`` may be slow."""
        places = list(dict.fromkeys(self.places.values()))
        starts, stops = [s.Start(place) for place in places], [s.Stop(place) for place in reversed(places)]
        steps = (*self.steps, *starts, *calls, *stops, s.GetComponents())
        return Scenario(self.components, steps, patience, self.interfaces, may_stay)


def message_purposes() -> list[TestPurpose]:
    """Delivery: numbers of emitters and receivers, several connections, restarts, stops, bursts."""
    return [*_groups(), *_several_connections(), _stop_meanwhile(), *_bursts()]


def emitter(messages: Sequence[Datum], interface: str = _NUMBERS) -> Declaration:
    """Pushes ``messages`` each time it is called."""
    pushes = tuple(s.CallMethod("out.api", s.PUSH, (message,)) for message in messages)
    return Declaration(("in.api",), ("out.api",), plan={"exchange": pushes}, ports={"out.api": interface})


def receiver(gate: str, interface: str = _NUMBERS, overwrite: bool = False) -> Declaration:
    """Passes ``gate`` at each message and answers ok."""
    plan = (s.HoldAtGate(gate), s.Answer(s.PUSH, ("ok",), overwrite=overwrite))
    return Declaration(("in.api",), plan={"method": plan}, ports={"in.api": interface})


def _groups() -> list[TestPurpose]:
    """Every small number of emitters with every small number of receivers."""
    purposes = []
    for is_spread, at_once in itertools.product((False, True), repeat=2):
        where = "containers of their own" if is_spread else "one container"
        how = "at once" if at_once else "one by one"
        scenarios = tuple(
            (f"messages/{emitters} to {receivers}, {where}, {how}", _group(emitters, receivers, is_spread, at_once))
            for emitters, receivers in itertools.product(range(1, _MOST + 1), repeat=2)
            if emitters > 1 or not at_once
        )
        requirements = ("04", "03", "05", "06", "07", "10")
        text = f"Emitters and receivers in {where}; the emitters push {how}."
        purposes.append(_purpose(f"messages/{where}, {how}", text, requirements, scenarios))
    return purposes


def _group(emitters: int, receivers: int, is_spread: bool, at_once: bool) -> Scenario:
    configuration = _Configuration(is_spread)
    configuration.link("link", _NUMBERS)
    for number in range(receivers):
        configuration.add_receiver(f"receiver {number}", "link", receiver("got"))
    names = [f"emitter {number}" for number in range(emitters)]
    for number, name in enumerate(names):
        configuration.add_emitter(name, "link", emitter([10 * (number + 1) + k for k in range(_MESSAGES)]))
    due = emitters * _MESSAGES * receivers
    calls = [s.OpenGate("got"), *_pushes(names, at_once), s.ReachGate("got", total=due)]
    return configuration.scenario(
        [*calls, *_pushes(names[:1], False), s.ReachGate("got", total=due + _MESSAGES * receivers)]
    )


def _pushes(names: Sequence[str], at_once: bool) -> list[Step]:
    """Make each emitter push."""
    if not at_once:
        return [s.Invoke(f"tell {name}", number + 1) for number, name in enumerate(names)]
    calls: list[Step] = [s.Invoke(f"tell {name}", n + 1, thread=_worker_of(name)) for n, name in enumerate(names)]
    return [*calls, *(s.Join(_worker_of(name)) for name in names)]


def _worker_of(emitter: str) -> str:
    """The worker that makes it push, if all push at once."""
    return f"thread of {emitter}"


def _several_connections() -> list[TestPurpose]:
    """Two connections beside each other, of one type of messages and of two."""
    purposes = []
    for second, types in ((_NUMBERS, "one type"), (_NOTES, "two types")):
        kinds = itertools.product((1, 2), (False, True), (False, True))
        scenarios = [
            (
                f"connections of {types}/{count} to {count}{', spread' * spread}{', at once' * at_once}",
                _two_connections(second, count, spread, at_once),
            )
            for count, spread, at_once in kinds
        ]
        scenarios.append((f"connections of {types}/one receiver of both", _receiver_of_two(second)))
        text = f"Messages of {types} are pushed through two connections in one runtime."
        requirements = ("06", "05") if second == _NUMBERS else ("20", "06")
        purposes.append(_purpose(f"connections of {types}", text, requirements, tuple(scenarios)))
    return purposes


def _message(interface: str, number: int) -> Datum:
    return number if interface == _NUMBERS else [number, f"note {number}", [number, number + 1]]


def _two_connections(second: str, count: int, is_spread: bool, at_once: bool) -> Scenario:
    configuration = _Configuration(is_spread)
    names = []
    for link, interface in (("left", _NUMBERS), ("right", second)):
        configuration.link(link, interface)
        for number in range(count):
            configuration.add_receiver(f"{link} receiver {number}", link, receiver(f"got {link}", interface))
    for number, (link, interface) in itertools.product(range(count), (("left", _NUMBERS), ("right", second))):
        first = 10 * (number + 1) + 100 * (link == "right")
        names.append(f"{link} emitter {number}")
        pushed = [_message(interface, first + k) for k in range(_MESSAGES)]
        configuration.add_emitter(names[-1], link, emitter(pushed, interface))
    calls: list[Step] = [s.OpenGate("got left"), s.OpenGate("got right")]
    for round_ in (1, 2):  # a late message of the first round has arrived by the end of the second
        due = round_ * count * count * _MESSAGES
        calls += [*_pushes(names, at_once), s.ReachGate("got left", total=due), s.ReachGate("got right", total=due)]
    return configuration.scenario(calls)


def _receiver_of_two(second: str) -> Scenario:
    """One component receives from both, through two port elements; another one emits to both."""
    configuration = _Configuration(False)
    both = {"in.api": _NUMBERS, "aux.api": second}
    plan = (s.HoldAtGate("got"), s.Answer(s.PUSH, ("ok",)))
    configuration.link("left", _NUMBERS)
    configuration.link("right", second)
    configuration.add("receiver", Declaration(("in.api", "aux.api"), plan={"method": plan}, ports=both))
    pushes = (
        s.CallMethod("left.api", s.PUSH, (1,)),
        s.CallMethod("right.api", s.PUSH, (_message(second, 2),)),
    )
    ports = {"left.api": _NUMBERS, "right.api": second}
    declaration = Declaration(("in.api",), ("left.api", "right.api"), plan={"exchange": pushes}, ports=ports)
    configuration.add("emitter", declaration)
    for link, port in (("left", "in.api"), ("right", "aux.api")):
        configuration.steps.append(provided_end(MESSAGE, link, "receiver", port))
        configuration.steps.append(required_end(MESSAGE, link, "emitter", f"{link}.api"))
    configuration.steps.append(s.GetPortElement("emitter", "in.api", "tell emitter"))
    calls: list[Step] = [s.OpenGate("got")]
    for round_ in (1, 2):
        calls += [*_pushes(["emitter"], False), s.ReachGate("got", total=2 * round_)]
    return configuration.scenario(calls)


def _stop_meanwhile() -> TestPurpose:
    """A receiver is stopped and started again while its emitter goes on pushing; another one gets everything."""
    configuration = _Configuration(True)
    configuration.link("link", _NUMBERS)
    configuration.add_receiver("stopped", "link", receiver("got"))
    configuration.add_receiver("watch", "link", receiver("seen"))
    configuration.add_emitter("emitter", "link", emitter(range(1, _MANY + 1)))
    configuration.add_emitter("later", "link", emitter(range(101, 101 + _MANY)))
    place = configuration.places["stopped"]
    calls: list[Step] = [
        s.OpenGate("got"),
        s.OpenGate("seen"),
        s.Invoke("tell emitter", 1, thread="pushing"),
        s.ReachGate("got"),
        s.Stop(place),
        s.Join("pushing"),
        s.ReachGate("seen", total=_MANY),
        s.GetComponents(place),
        s.Start(place),
        s.Invoke("tell later", 2),
        s.ReachGate("got", total=_MANY + 1),
        s.ReachGate("seen", total=2 * _MANY),
    ]
    text = "A receiver is stopped and started again while its emitter goes on pushing."
    return _purpose(
        "messages/stop meanwhile",
        text,
        ("09", "04"),
        (("messages/stop meanwhile", configuration.scenario(calls, 1000)),),
    )


def _bursts() -> list[TestPurpose]:
    purposes = []
    for emitters, receivers, count in ((1, 1, 100_000), (2, 2, 25_000)):
        name = f"burst/{emitters} to {receivers}"
        text = f"{emitters} emitters push {count} messages each, as fast as they can, to {receivers} receivers."
        scenarios = ((name, _burst(emitters, receivers, count)),)
        further = ("R-10.1.6.1-03",) if emitters > 1 else ()
        requirements = ("R-10.1.2-10", "R-10.1.6.1-05", *further)
        purposes.append(TestPurpose(name, "10.1.2", text, requirements, scenarios))
    return purposes


def _burst(emitters: int, receivers: int, count: int) -> Scenario:
    configuration = _Configuration(False)
    configuration.link("link", _NUMBERS)
    counting = Declaration(("in.api",), plan={"method": (s.CountMessages(),)}, ports={"in.api": _NUMBERS})
    for number in range(receivers):
        configuration.add_receiver(f"receiver {number}", "link", counting)
    names = [f"emitter {number}" for number in range(emitters)]
    for number, name in enumerate(names):
        plan = {"exchange": (s.Burst("out.api", number * _BLOCK, count),)}
        burst = Declaration(("in.api",), ("out.api",), plan=plan, ports={"out.api": _NUMBERS})  # type: ignore[arg-type]
        configuration.add_emitter(name, "link", burst)
    waits: list[Step] = [s.AwaitMessages(f"receiver {number}", emitters * count) for number in range(receivers)]
    return configuration.scenario([*_pushes(names, True), *waits], 10_000, tuple(_worker_of(name) for name in names))


def _purpose(
    name: str, text: str, requirements: Sequence[str], scenarios: tuple[tuple[str, Scenario], ...]
) -> TestPurpose:
    return TestPurpose(name, _CLAUSE, text, tuple(f"R-10.1.6.1-{number}" for number in requirements), scenarios)
