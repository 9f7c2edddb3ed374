"""Contention for containers: several workers add, connect and remove components at once (``suite/contention.yaml``).

Only who declares that this is possible is asked (operations-at-once).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Declaration, Scenario, Step
from ucm_cts.harness.purposes.provocations.contention import load_contention
from ucm_cts.harness.purposes.scripts import TestPurpose

_COMPONENTS = {
    "server": Declaration(("in.api",)),
    "client": Declaration(("in.api",), ("out.api",), connectable=True),
    "slow": Declaration(("in.api",), plan={"on_init": (s.HoldAtGate("inside"),), "on_remove": (s.HoldAtGate("last"),)}),
}
_BOX = "box"


def container_contention_purposes() -> list[TestPurpose]:
    """One purpose for each kind of operation, with so many workers as the table says, in the manager and below."""
    table = load_contention()
    return [
        TestPurpose(
            f"contention/{name}",
            requirements[0].split("-")[1],
            f"Several threads do this at once: {name}.",
            requirements,
            tuple(
                (f"contention/{name}/{count} workers, {home}", _scenario(home, steps(home, count, table.uses)))
                for count in table.callers
                for home in (s.MANAGER, _BOX)
            ),
            under=("container-operations=at-once",),
        )
        for name, (steps, requirements) in _KINDS.items()
    ]


def _scenario(home: str, steps: Iterator[Step]) -> Scenario:
    created = () if home == s.MANAGER else (s.CreateContainer(home),)
    return Scenario(_COMPONENTS, (*created, *steps, s.GetComponents(home)))


def _each(count: int, uses: int) -> Iterator[tuple[str, str]]:
    """A worker and the name of what it works on, by turns."""
    for use in range(uses):
        yield from ((f"worker {number}", f"{number} {use}") for number in range(count))


def _joined(count: int) -> Iterator[Step]:
    yield from (s.Join(f"worker {number}") for number in range(count))


def _additions(home: str, count: int, uses: int) -> Iterator[Step]:
    """Each worker adds its own."""
    yield from (s.AddComponent("server", home, name, thread=worker) for worker, name in _each(count, uses))
    yield from _joined(count)


def _additions_beside(home: str, count: int, uses: int) -> Iterator[Step]:
    """The others add while a body is held in on_init."""
    yield s.AddComponent("slow", home, thread="worker 0")
    yield s.ReachGate("inside")
    yield from (s.AddComponent("server", home, f"server {n}", thread=f"worker {n}") for n in range(1, count))
    yield from (s.Settle(f"worker {number}") for number in range(1, count))
    yield s.OpenGate("inside")
    yield from _joined(count)


def _removals(home: str, count: int, uses: int) -> Iterator[Step]:
    """Each worker removes its own; one is left."""
    yield s.AddComponent("server", home, "left")
    yield from (s.AddComponent("server", home, name) for _, name in _each(count, uses))
    yield from (s.RemoveComponent(name, home, thread=worker) for worker, name in _each(count, uses))
    yield from _joined(count)


def _turnover(home: str, count: int, uses: int) -> Iterator[Step]:
    """Each worker removes one and adds another one, again and again."""
    yield from (s.AddComponent("server", home, f"old {name}") for _, name in _each(count, uses))
    for worker, name in _each(count, uses):
        yield s.RemoveComponent(f"old {name}", home, thread=worker)
        yield s.AddComponent("server", home, f"new {name}", thread=worker)
    yield from _joined(count)


def _connections(home: str, count: int, uses: int) -> Iterator[Step]:
    """Each worker connects and disconnects its own client."""
    yield s.AddComponent("server", home)
    yield s.GetPortElement("server", "in.api", "to server", home)
    yield from (s.AddComponent("client", home, f"client {number}") for number in range(count))
    for use in range(uses):
        for number in range(count):
            link, worker = f"link {number} {use}", f"worker {number}"
            yield s.Connect(f"client {number}", "out.api", "to server", link, home, thread=worker)
            yield s.Disconnect(link, home, thread=worker)
    yield from _joined(count)


_KINDS: dict[str, tuple[Callable[[str, int, int], Iterator[Step]], tuple[str, ...]]] = {
    "additions": (_additions, ("R-11.2.2.1-03", "R-11.2.2.1-14", "R-11.2.3-05")),
    "additions beside a slow one": (_additions_beside, ("R-11.2.2.1-03", "R-11.2.2.1-14", "R-11.2.3-05")),
    "removals": (_removals, ("R-11.2.2.1-14", "R-11.2.1.2-06")),
    "turnover": (_turnover, ("R-11.2.2.1-14", "R-11.2.1.2-06", "R-11.2.3-05")),
    "connections": (_connections, ("R-11.2.1.3-02", "R-11.2.1.3-05")),
}
