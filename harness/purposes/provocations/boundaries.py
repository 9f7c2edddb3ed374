"""Boundaries: scenarios with no, one, few and many of each thing that a runtime holds or repeats (``suite/boundaries.yaml``)."""

from __future__ import annotations

import string
from collections.abc import Callable, Iterator
from itertools import chain

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Declaration, Scenario, Step
from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.catalogue.documents import read
from ucm_cts.harness.catalogue.requirements import SUITE
from ucm_cts.harness.purposes.scripts import TestPurpose

_DEEPEST = 16
"""The longest chain of calls: stacks end somewhere."""

_MOST_ATTRIBUTES = 8
"""Those of the component type in the probe models with most of them (suite/models/probes)."""

_PORTS = range(3, 9)
"""Numbers of port elements of one component: those of the probe models with more than the usual two."""

_SERVER = Declaration(("in.api",))
_CLIENT = Declaration(("in.api",), ("out.api",), connectable=True, plan={"exchange": (s.CallPort("out.api", 7),)})


class Boundaries(Value, frozen=True):
    """``suite/boundaries.yaml``.

    ``counts``: how many of each thing.
    ``sizes``: characters of attribute values.
    ``texts``: attribute values with characters that some formats treat in their own way.
    ``callers``: how many callers at once, beside the pairs and triples of every kind.
    ``durations``: milliseconds that a body stays in a callback.
    """

    counts: tuple[int, ...]
    sizes: tuple[int, ...]
    texts: tuple[str, ...]
    callers: tuple[int, ...]
    durations: tuple[int, ...]


def load_boundaries() -> Boundaries:
    """The boundaries of the suite."""
    return read(SUITE / "boundaries.yaml", Boundaries)


def boundary_purposes() -> list[TestPurpose]:
    """One purpose for each thing that is counted, and one for attribute values."""
    boundaries = load_boundaries()
    purposes = [
        TestPurpose(
            f"boundary/{what}",
            requirements[0].split("-")[1],
            f"There are {', '.join(map(str, boundaries.counts[:-1]))} and {boundaries.counts[-1]} {what}.",
            requirements,
            tuple((f"boundary/{count} {what}", _scenario(steps(count))) for count in boundaries.counts),
        )
        for what, (steps, requirements) in _COUNTED.items()
    ]
    sizes = tuple((f"boundary/attribute of {size} characters", _sized(size)) for size in boundaries.sizes)
    sizes += tuple((f"boundary/attribute {text!r}", _with_value(text)) for text in boundaries.texts)
    few = [count for count in boundaries.counts if count <= _MOST_ATTRIBUTES]
    sizes += tuple((f"boundary/{count} attributes", _with_attributes(count)) for count in few)
    text = "There are none, one and many attributes; the value of one has characters without number: none, one, and so many that buffers end."
    ports = [count for count in boundaries.counts if count in _PORTS]
    return [
        *purposes,
        TestPurpose("boundary/attribute values", "11.2.1.2", text, ("R-11.2.1.2-05",), sizes),
        TestPurpose(
            "boundary/port elements",
            "11.2.1.2",
            "A component has more required port elements than two, and another one as many provided ones.",
            ("R-11.2.1.2-09", "R-11.2.2.1-07"),
            tuple((f"boundary/{count} port elements", _with_ports(count)) for count in ports),
        ),
    ]


def _scenario(steps: Iterator[Step]) -> Scenario:
    return Scenario({"server": _SERVER, "client": _CLIENT}, tuple(steps))


def _components(count: int) -> Iterator[Step]:
    """All are added, looked up and used; then every second one is removed, and the others after it."""
    names = [f"server {number}" for number in range(count)]
    yield from (s.AddComponent("server", bind=name) for name in names)
    yield s.GetComponents()
    yield from _used(names)
    yield from (s.RemoveComponent(name) for name in names[::2])
    yield s.GetComponents()
    yield from _used(names[1::2])
    yield from (s.RemoveComponent(name) for name in names[1::2])
    yield s.GetComponents()


def _used(names: list[str]) -> Iterator[Step]:
    """Start, call each component, stop."""
    yield from (s.GetPortElement(name, "in.api", f"to {name}") for name in names)
    yield s.Start()
    yield from (s.Invoke(f"to {name}", number) for number, name in enumerate(names))
    yield s.Stop()


def _clients(count: int) -> Iterator[Step]:
    """So many clients of one server."""
    names = [f"client {number}" for number in range(count)]
    yield s.AddComponent("server")
    yield s.GetPortElement("server", "in.api", "to server")
    for name in names:
        yield s.AddComponent("client", bind=name)
        yield s.Connect(name, "out.api", "to server", f"link of {name}")
    yield from _used(names)
    yield from (s.Disconnect(f"link of {name}") for name in names)
    yield from (s.RemoveComponent(name) for name in ("server", *names))
    yield s.GetComponents()


def _containers(count: int) -> Iterator[Step]:
    """So many sub-containers with a component each; every second one is removed first."""
    boxes = [f"box {number}" for number in range(count)]
    for box in boxes:
        yield s.CreateContainer(box)
        yield s.AddComponent("server", box, f"in {box}")
        yield s.GetPortElement(f"in {box}", "in.api", f"to {box}", box)
    yield from map(s.Start, boxes)
    yield from (s.Invoke(f"to {box}", number) for number, box in enumerate(boxes))
    yield from map(s.Stop, boxes)
    yield from chain(map(s.RemoveContainer, boxes[::2]), map(s.GetComponents, boxes[1::2]))
    yield from map(s.RemoveContainer, boxes[1::2])
    yield s.GetComponents()


def _restarts(count: int) -> Iterator[Step]:
    """The application is started and stopped so many times, then used once more."""
    yield from _pair()
    for _ in range(count):
        yield s.Start()
        yield s.Stop()
    yield from _used(["client", "server"])


def _reconnections(count: int) -> Iterator[Step]:
    """A connection is undone and made so many times, then used."""
    yield from _pair()
    for number in range(count):
        yield s.Disconnect(_link(number))
        yield s.Connect("client", "out.api", "to server", _link(number + 1))
    yield from _used(["client", "server"])
    yield s.Disconnect(_link(count))


def _replacements(count: int) -> Iterator[Step]:
    """A component is removed and added so many times; then what is there is used."""
    yield s.AddComponent("server", bind="server 0")
    for number in range(count):
        yield s.RemoveComponent(f"server {number}")
        yield s.AddComponent("server", bind=f"server {number + 1}")
    yield s.GetComponents()
    yield from _used([f"server {count}"])


def _references(count: int) -> Iterator[Step]:
    """A port element is asked for so many times; each reference is used."""
    yield s.AddComponent("server")
    yield from (s.GetPortElement("server", "in.api", f"reference {number}") for number in range(count))
    yield s.Start()
    yield from (s.Invoke(f"reference {number}", number) for number in range(count))
    yield s.Stop()


def _ended(count: int) -> Iterator[Step]:
    """So many members of a sub-container are removed with it, and as many of the manager with the runtime, while they run."""
    yield s.CreateContainer("box")
    for container in ("box", s.MANAGER):
        yield from (s.AddComponent("server", container, f"{container} {number}") for number in range(count))
        yield s.Start(container)
    yield s.RemoveContainer("box")
    yield s.Destroy()


def _links_of_a_chain(count: int) -> Iterator[Step]:
    """So many components that call each the next one; the test calls the first."""
    names = [f"client {number}" for number in range(min(count, _DEEPEST))]
    yield s.AddComponent("server")
    yield s.GetPortElement("server", "in.api", "to next 0")
    for number, name in enumerate(names):
        yield s.AddComponent("client", bind=name)
        yield s.Connect(name, "out.api", f"to next {number}", f"link of {name}")
        yield s.GetPortElement(name, "in.api", f"to next {number + 1}")
    yield s.Start()
    yield s.Invoke(f"to next {len(names)}", 1)
    yield s.Stop()


def _calls(count: int) -> Iterator[Step]:
    """A component calls another one so many times."""
    yield from _pair()
    yield s.GetPortElement("client", "in.api", "to client")
    yield s.Start()
    yield from (s.Invoke("to client", number) for number in range(count))
    yield s.Stop()


def _pair() -> Iterator[Step]:
    yield from (s.AddComponent("server"), s.AddComponent("client"), s.GetPortElement("server", "in.api", "to server"))
    yield s.Connect("client", "out.api", "to server", _link(0))


def _link(number: int) -> str:
    return f"link {number}"


def _sized(size: int) -> Scenario:
    return _with_value((string.ascii_lowercase * (size // 26 + 1))[:size])


def _with_value(value: str) -> Scenario:
    server = Declaration(("in.api",), attributes={"label": value, "level": "low"})
    below = s.CreateContainer("box"), s.AddComponent("server", "box", "server below")
    return Scenario({"server": server}, (s.AddComponent("server"), *below, s.GetComponents()))


def _with_attributes(count: int) -> Scenario:
    attributes = {f"a{number}": f"value {number}" for number in range(count)}
    steps = (s.AddComponent("server"), s.AddComponent("server", bind="another one"), s.GetComponents())
    return Scenario({"server": Declaration(attributes=attributes)}, steps)


def _with_ports(count: int) -> Scenario:
    """Each required port element of one is connected to a provided one of the other, and all of them are used."""
    provided, required = ([f"{kind}{number}.api" for number in range(count)] for kind in ("in", "out"))
    calls = tuple(s.CallPort(port, number) for number, port in enumerate(required))
    components = {
        "server": Declaration(tuple(provided)),
        "client": Declaration(("in.api",), tuple(required), connectable=True, plan={"exchange": calls}),
    }
    steps: tuple[Step, ...] = (
        *map(s.AddComponent, components),
        s.GetPortElement("client", "in.api", "to client"),
        *(s.GetPortElement("server", port, f"to {port}") for port in provided),
        *(
            s.Connect("client", port, f"to {goal}", f"link of {port}")
            for port, goal in zip(required, provided, strict=True)
        ),
        s.Start(),
        s.Invoke("to client", 1),
        *(s.Invoke(f"to {port}", number) for number, port in enumerate(provided)),
        s.Stop(),
    )
    return Scenario(components, steps)


_COUNTED: dict[str, tuple[Callable[[int], Iterator[Step]], tuple[str, ...]]] = {
    "components": (_components, ("R-12.10-02", "R-12.10-05")),
    "clients": (_clients, ("R-11.1.3-01", "R-12.10-03")),
    "sub-containers": (_containers, ("R-12.10-13",)),
    "restarts": (_restarts, ("R-11.2.3-09", "R-11.2.3-10")),
    "new connections": (_reconnections, ("R-12.10-08",)),
    "replacements": (_replacements, ("R-12.10-05",)),
    "members at the end": (_ended, ("R-11.2.2.2-04", "R-11.2.2.2-05")),
    "components in a chain": (_links_of_a_chain, ("R-11.2.3-03", "R-11.1.3-01")),
    "calls of a component": (_calls, ("R-11.1.3-01",)),
    "references": (_references, ("R-12.10-06",)),
}
