"""Scenarios with any number of components, containers or restarts: what judging an event costs must not depend on how many there are.

The events are those of the Python reference framework.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Iterator

import msgspec

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.trace import Trace
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter
from ucm_cts.adapters.sdk.python.engine import Performance
from ucm_cts.adapters.sdk.python.recorder import Recorder

_PROVIDED, _REQUIRED = "in_api", "out_api"
_TIMES = 5
_FRAMES = 10
"""So many calls of functions at most lead from one component to the next one."""

_COMPONENTS = {
    "server": s.Declaration(provides=(_PROVIDED,)),
    "relay": s.Declaration(
        provides=(_PROVIDED,),
        requires=(_REQUIRED,),
        connectable=True,
        plan={"exchange": (s.CallPort(_REQUIRED, 2),)},
    ),
    "end": s.Declaration(provides=(_PROVIDED,), requires=(_REQUIRED,), connectable=True),
}
"""A server, and what can stand before one in a chain: a relay passes calls on, an end answers them itself."""


def _chain(size: int) -> Iterator[s.Step]:
    """Components of which each is connected to the next one. Every second one passes a call on; then all are disconnected and removed."""
    for number in range(size):
        yield s.AddComponent("server" if number == size - 1 else ("relay", "end")[number % 2], bind=f"c{number}")
        yield s.GetPortElement(f"c{number}", _PROVIDED, f"r{number}")
    for number in range(size - 1):
        yield s.Connect(f"c{number}", _REQUIRED, f"r{number + 1}", f"l{number}")
    yield s.Start()
    for number in range(size):
        yield s.Invoke(f"r{number}", number)
    yield s.Stop()
    for number in range(size - 1):
        yield s.Disconnect(f"l{number}")
    for number in range(size):
        yield s.RemoveComponent(f"c{number}")


def _passed_through(size: int) -> Iterator[s.Step]:
    """A chain through which a call passes, from the first component to the last."""
    for number in range(size):
        yield s.AddComponent("server" if number == size - 1 else "relay", bind=f"c{number}")
        yield s.GetPortElement(f"c{number}", _PROVIDED, f"r{number}")
    for number in range(size - 1):
        yield s.Connect(f"c{number}", _REQUIRED, f"r{number + 1}", f"l{number}")
    yield s.Start()
    yield from [s.Invoke("r0", 1)] * _TIMES
    yield s.Stop()


def _started_together(size: int) -> Iterator[s.Step]:
    """Pairs of components that are started and stopped together, a few times. Some of them are called."""
    yield from _pairs(size, lambda number: s.MANAGER)
    for _ in range(_TIMES):
        yield s.Start()
        for number in range(0, size // 2, _TIMES):
            yield s.Invoke(f"entry{number}", number)
        yield s.Stop()


def _restarts(size: int) -> Iterator[s.Step]:
    """A few components that are started and stopped so many times, and connected anew each time."""
    yield from _pairs(4, lambda number: s.MANAGER)
    for number in range(size):
        yield s.Start()
        yield s.Invoke("entry0", number)
        yield s.Stop()
        yield s.Disconnect("link1")
        yield s.Connect("client1", _REQUIRED, "api1", "link1")


def _containers_in_turn(size: int) -> Iterator[s.Step]:
    """A container that is made, used and removed so many times, beside components of the manager."""
    yield from _pairs(4, lambda number: s.MANAGER)
    for _ in range(size):
        yield s.CreateContainer("box")
        yield s.AddComponent("server", "box", bind="inner")
        yield s.GetPortElement("inner", _PROVIDED, "reference", "box")
        yield s.Start("box")
        yield s.Invoke("reference", 1)
        yield s.Stop("box")
        yield s.RemoveContainer("box")


def _side_by_side(size: int) -> Iterator[s.Step]:
    """Containers with a pair of components each, started, called, stopped and removed one by one."""
    for number in range(size):
        yield s.CreateContainer(f"box{number}")
    yield from _pairs(2 * size, lambda number: f"box{number}")
    for number in range(size):
        yield s.Start(f"box{number}")
        yield s.Invoke(f"entry{number}", number)
    for number in range(size):
        yield s.GetComponents(f"box{number}")
        yield s.Stop(f"box{number}")
    for number in range(size):
        yield s.RemoveContainer(f"box{number}")


def _nested(size: int) -> Iterator[s.Step]:
    """Containers in the manager's, which has members of its own: each pair is connected across both, and the manager starts and stops all."""
    for number in range(size):
        yield s.CreateContainer(f"box{number}")
    yield from _pairs(2 * size, lambda number: f"box{number}", servers_in=lambda number: s.MANAGER)
    for _ in range(_TIMES):
        yield s.Start()
        for number in range(size):
            yield s.Invoke(f"entry{number}", number)
        yield s.Stop()
    yield s.Destroy()


def _replacements(size: int) -> Iterator[s.Step]:
    """Clients of which each is removed and made anew, one by one, connected to the same server, while the others stay."""
    yield from _server()
    yield from _clients(range(size))
    for number in range(size):
        yield s.Disconnect(f"link{number}")
        yield s.RemoveComponent(f"client{number}")
        yield from _clients([number])
    yield s.GetComponents()


def _shared_server(size: int) -> Iterator[s.Step]:
    """Clients of one server, which is removed in the end while they are connected."""
    yield from _server()
    yield from _clients(range(size))
    yield s.Start()
    for number in range(size):
        yield s.Invoke(f"entry{number}", number)
    yield s.Stop()
    yield s.RemoveComponent("server")


def _server() -> Iterator[s.Step]:
    yield s.AddComponent("server")
    yield s.GetPortElement("server", _PROVIDED, "api")


def _clients(numbers: Iterable[int]) -> Iterator[s.Step]:
    """Clients with these numbers; ``server`` is already there."""
    for number in numbers:
        yield s.AddComponent("relay", bind=f"client{number}")
        yield s.GetPortElement(f"client{number}", _PROVIDED, f"entry{number}")
        yield s.Connect(f"client{number}", _REQUIRED, "api", f"link{number}")


def _pairs(
    components: int, place: Callable[[int], str], servers_in: Callable[[int], str] | None = None
) -> Iterator[s.Step]:
    """So many components, each client connected to its own server."""
    for number in range(components // 2):
        own, other = place(number), (servers_in or place)(number)
        yield s.AddComponent("server", other, bind=f"server{number}")
        yield s.AddComponent("relay", own, bind=f"client{number}")
        yield s.GetPortElement(f"server{number}", _PROVIDED, f"api{number}", other)
        yield s.GetPortElement(f"client{number}", _PROVIDED, f"entry{number}", own)
        yield s.Connect(f"client{number}", _REQUIRED, f"api{number}", f"link{number}", own)


SHAPES: dict[str, Callable[[int], Iterator[s.Step]]] = {
    "components in a chain": _chain,
    "a call through a chain": _passed_through,
    "components started together": _started_together,
    "restarts": _restarts,
    "containers, one after the other": _containers_in_turn,
    "containers side by side": _side_by_side,
    "containers in the manager's": _nested,
    "clients replaced": _replacements,
    "clients of one server": _shared_server,
}
"""What there can be any number of, with the steps for so many."""


def scenario_of(shape: str, size: int, profile: str = "container") -> s.Scenario:
    """The scenario of that shape with ``size`` parts. In profile ``core`` the components have an execution policy, so that interactions are followed."""
    components = _COMPONENTS
    if profile != "container":
        policies = (s.Policy(s.PROTECTED_PASSIVE),)
        components = {name: msgspec.structs.replace(one, policies=policies) for name, one in components.items()}
    return s.Scenario(components, tuple(SHAPES[shape](size)))


def trace_of(scenario: s.Scenario) -> Trace:
    """What happens when the Python reference framework carries it out."""
    deepest = sys.getrecursionlimit()
    sys.setrecursionlimit(deepest + _FRAMES * len(scenario.steps))
    try:
        trace, stuck = Performance(ReferenceAdapter(), scenario, Recorder()).run()
    finally:
        sys.setrecursionlimit(deepest)
    assert not stuck
    return trace
