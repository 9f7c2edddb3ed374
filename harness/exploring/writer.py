"""Random scenarios: any component declarations, any steps of the vocabulary, live, stale and unknown things alike.

``scenarios`` draws them for hypothesis; ``Writer`` writes one with any way to choose, ``random.choice`` for instance.
Calls go down only (port elements ``p2`` are provided by components that call ``p1`` or ``p0``), so that they end.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Action, Declaration, Hook, Scenario, Step

if TYPE_CHECKING:
    from hypothesis.strategies import SearchStrategy

Choose = Callable[[Sequence[Any]], Any]

_NAMES = ("ann", "bob", "cyd", "dan")
_GATE = "gate"
_HOOKS: tuple[Hook, ...] = ("on_init", "on_startup", "on_shutdown", "on_remove", "on_connect", "on_disconnect")
_OPERATIONS = (
    *["add"] * 12,
    *["find"] * 6,
    *["connect"] * 8,
    *["link"] * 12,
    *["start"] * 8,
    *["disconnect", "stop", "remove", "invoke"] * 6,
    *["list"] * 4,
    *["box"] * 3,
    *["unbox"] * 2,
    "destroy",
    *["held"] * 4,
)


def scenarios() -> SearchStrategy[Scenario]:
    """Scenarios for hypothesis, which is imported only here."""
    from hypothesis import strategies as st

    return st.composite(lambda draw: Writer(lambda options: draw(st.sampled_from(options))).scenario())()


class Writer:
    """Writes one scenario; ``choose`` picks one of several things."""

    def __init__(self, choose: Choose) -> None:
        self.choose = choose
        self.components: dict[str, Declaration] = {}
        self.steps: list[Step] = []
        self.members: dict[str, tuple[str, str]] = {}
        self.references: dict[str, str] = {}
        self.connections: dict[str, str] = {}
        self.boxes: list[str] = []
        self.holding = False
        self.threaded = False
        self.workers = 0

    def scenario(self) -> Scenario:
        """A new scenario."""
        failing = self.choose((False, False, False, True))
        self.threaded = self.choose((False,) * 7 + (True,))
        self.holding = self.threaded and self.choose((False, True))
        for _ in range(self.choose((2, 3, 4, 1))):
            self.recruit(failing)
        if self.choose((False, True)):
            self.assemble()
        self.go_on(self.choose((6, 10, 14, 20, 28)))
        return self.written()

    def resume(self, scenario: Scenario) -> None:
        """Take ``scenario``, or the beginning of one, as written so far."""
        self.components = dict(scenario.components)
        self.steps = list(scenario.steps)
        for step in scenario.steps:
            match step:
                case s.AddComponent():
                    self.members[step.bind or step.component] = (step.component, step.container)
                case s.GetPortElement():
                    self.references[step.bind] = step.port[:2]
                case s.Connect():
                    self.connections[step.bind] = step.container
                case s.CreateContainer():
                    self.boxes.append(step.bind)
        self.workers = sum(step.thread is not None for step in scenario.steps)

    def go_on(self, operations: int) -> None:
        """Write so many operations more."""
        for _ in range(operations):
            getattr(self, self.choose(_OPERATIONS))()

    def written(self) -> Scenario:
        """What is written by now."""
        return Scenario(self.components, tuple(self.steps), patience=20)

    def recruit(self, failing: bool) -> None:
        """One more component, as long as there are names for it."""
        name = next((name for name in _NAMES if name not in self.components), None)
        if name is not None:
            self.components[name] = self.declaration(failing)

    def declaration(self, failing: bool) -> Declaration:
        level = self.choose((0, 0, 1, 1, 2))
        provides = [f"p{level}.{e}" for e in self.choose(("x", "xy", ""))]
        requires = [f"r{level}.{e}" for e in self.choose(("", "x", "xy"))]
        return self.body(tuple(provides), tuple(requires), failing)

    def body(self, provides: tuple[str, ...], requires: tuple[str, ...], failing: bool) -> Declaration:
        """A component with these port elements; it may raise if it is ``failing``."""
        level = int(requires[0][1]) if requires else 0
        fragment = self.choose((False, False, True))
        plan: dict[Hook, tuple[Action, ...]] = {}
        if level and requires:
            plan["exchange"] = (self.call(requires),)
        if requires and self.choose((False, False, True)):
            plan[self.choose(("on_startup", "on_shutdown"))] = (self.call(requires),)
        if self.choose((False, True) if fragment else (False,) * 15 + (True,)):
            plan[self.choose((*_HOOKS, "exchange"))] = (s.QuerySiblings(),)
        if self.choose((False,) * 7 + (True,)):
            plan["exchange"] = (*plan.get("exchange", ()), s.ReturnValue(self.value()))
        if provides and self.holding:
            plan["exchange"] = (s.HoldAtGate(_GATE), *plan.get("exchange", ()))
        if failing and self.choose((False, True)):
            hook = self.choose((*_HOOKS, "exchange", "set_container_interface"))
            plan[hook] = (*plan.get(hook, ()), s.RaiseError())
        attributes = self.choose(({}, {}, {"size": "7"}, {"size": "7", "hue": ""}))
        return Declaration(provides, requires, attributes, self.choose((True, True, False)), fragment, plan)

    def call(self, ports: Sequence[str]) -> Action:
        return s.CallPort(self.choose(ports), self.value())

    def value(self) -> int:
        value: int = self.choose((1, 2, 3, 0, 2**31 - 1))
        return value

    def rarely(self, usual: Any, *others: Any) -> Any:
        """``usual``, or one of ``others`` now and then."""
        return self.choose((*[usual] * 15, *others))

    def name(self, kind: str, taken: Sequence[str]) -> str:
        """A variable for one more thing of a kind: mostly a new one."""
        fresh = f"{kind}{len(taken) + 1}"
        name: str = self.choose((*[fresh] * 12, *taken[:1]))
        return name

    def container(self) -> str:
        container: str = self.choose((s.MANAGER, s.MANAGER, *self.boxes))
        return container

    def thread(self) -> str | None:
        """Now and then a step is done by a worker, and waited for."""
        if not self.threaded or self.choose((True, True, False)):
            return None
        self.workers += 1
        return f"worker{self.workers}"

    def put(self, step: Step) -> None:
        self.steps.append(step)
        if step.thread is not None and not isinstance(step, s.Invoke):
            self.steps.append(s.Join(step.thread))

    # operations

    def assemble(self) -> None:
        """An application that could run: all of it connected, and perhaps started."""
        for _ in range(self.choose((0, 0, 1, 2))):
            self.box()
        for component in (*self.components, *self.components)[: self.choose((2, 3, 4, 5))]:
            self.add_to(component, self.container())
        for client in tuple(self.members):
            self.link_from(client)
        for container in (*self.boxes, s.MANAGER):
            if self.choose((True, True, False)):
                self.put(s.Start(container))

    def add(self) -> None:
        self.add_to(self.rarely(self.choose(tuple(self.components)), "nobody"), self.container())

    def add_to(self, component: str, container: str) -> None:
        bind = self.name("m", tuple(self.members))
        self.members[bind] = (component, container)
        self.put(s.AddComponent(component, container, bind, thread=self.thread()))

    def member(self) -> tuple[str, str, Declaration]:
        """A variable, the container to look in, and the declaration it probably stands for."""
        name = self.choose(tuple(self.members))
        component, container = self.members[name]
        declaration = self.components.get(component, Declaration())
        return self.rarely(name, s.UNKNOWN), self.rarely(container, self.container()), declaration

    def remove(self) -> None:
        if self.members:
            name, container, _ = self.member()
            self.put(s.RemoveComponent(name, container, thread=self.thread()))

    def find(self) -> None:
        if self.members:
            name, container, declaration = self.member()
            names = (*declaration.provides * 8, "p9.x", *declaration.requires)
            self.find_port(name, container, self.choose(names))

    def find_port(self, name: str, container: str, port: str) -> str:
        """A variable that is bound to the references of one level only, so that no calls go round."""
        level = port[:2]
        bind = self.name(level, [r for r, of in self.references.items() if of == level])
        self.references[bind] = level
        self.put(s.GetPortElement(name, port, bind, container, thread=self.thread()))
        return bind

    def connect(self) -> None:
        clients = [m for m, (c, _) in self.members.items() if self.required(c)]
        if not clients:
            return
        client = self.choose(clients)
        component, container = self.members[client]
        port = self.choose((*self.required(component) * 8, "r9.x", *self.components[component].provides))
        targets = [r for r, level in self.references.items() if self.goes_down(port, level)]
        to = self.choose((*targets * 8, s.NIL))
        bind = self.name("c", tuple(self.connections))
        self.connections[bind] = container
        id_, where = self.rarely(client, s.UNKNOWN), self.rarely(container, self.container())
        self.put(s.Connect(id_, port, to, bind, where, thread=self.thread()))

    def link(self) -> None:
        """Look a port element up and connect something to it."""
        clients = [m for m, (c, _) in self.members.items() if self.required(c)]
        if clients:
            self.link_from(self.choose(clients))
        else:
            self.add()

    def link_from(self, client: str) -> None:
        component, container = self.members[client]
        for port in self.required(component):
            servers = [
                (server, box, provided)
                for server, (c, box) in self.members.items()
                if c in self.components
                for provided in self.components[c].provides
                if self.goes_down(port, provided)
            ]
            if servers:
                server, box, provided = self.choose(servers)
                to = self.find_port(server, box, provided)
                bind = self.name("c", tuple(self.connections))
                self.connections[bind] = container
                self.put(s.Connect(client, port, to, bind, container))

    def required(self, component: str) -> tuple[str, ...]:
        return self.components[component].requires if component in self.components else ()

    def goes_down(self, required: str, provided: str) -> bool:
        return required[1] == "0" or provided[1] < required[1]

    def disconnect(self) -> None:
        if self.connections:
            name = self.choose(tuple(self.connections))
            where = self.rarely(self.connections[name], self.container())
            self.put(s.Disconnect(self.rarely(name, s.UNKNOWN), where, thread=self.thread()))

    def start(self) -> None:
        self.put(s.Start(self.container(), thread=self.thread()))

    def stop(self) -> None:
        self.put(s.Stop(self.container(), thread=self.thread()))

    def list(self) -> None:
        self.put(s.GetComponents(self.container(), thread=self.thread()))

    def box(self) -> None:
        if len(self.boxes) < 3:
            self.boxes.append(self.name("box", self.boxes))
            self.put(s.CreateContainer(self.boxes[-1], thread=self.thread()))

    def unbox(self) -> None:
        self.put(s.RemoveContainer(self.choose((*self.boxes * 4, s.NIL)), thread=self.thread()))

    def destroy(self) -> None:
        if self.choose((False, True)):
            self.put(s.Destroy(thread=self.thread()))

    def invoke(self) -> None:
        if self.references:
            self.put(s.Invoke(self.choose(tuple(self.references)), self.value(), thread=self.thread()))

    def held(self) -> None:
        """A call that is held inside a body while something else happens."""
        holds = any(s.HoldAtGate(_GATE) in d.plan.get("exchange", ()) for d in self.components.values())
        if not self.holding or not holds or not self.references:
            return
        self.holding = False
        self.put(s.Invoke(self.choose(tuple(self.references)), self.value(), thread="caller"))
        self.put(s.ReachGate(_GATE))
        for _ in range(self.choose((1, 2, 0))):
            getattr(self, self.choose(("stop", "list", "start", "remove", "disconnect", "invoke")))()
        self.put(s.OpenGate(_GATE))
        self.put(s.Join("caller"))
