"""Unforeseeable scenarios: small applications drawn from a run's seed, so that no adapter can know them beforehand.

They find adapters that remember answers, or that answer only scenarios of known shape (docs/honesty.md). No step may wait for
ever: calls go down, and only while all containers are started. All components are in one container, so that defects between
containers, which other purposes check in each run, do not depend on the seed.
"""

from __future__ import annotations

import random
from collections.abc import Mapping

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Action, Declaration, Hook, Scenario, Step
from ucm_cts.harness.purposes.scripts import TestPurpose

NUMBER = 24
"""Scenarios of a run: about a second of a framework in Python."""

_REQUIREMENTS = ("R-11.1.1-01", "R-11.2.1.2-01", "R-11.2.3-01")
_PHASES = (1, 1, 2, 3)


def unforeseen_purposes() -> list[TestPurpose]:
    """One purpose, whose scenarios are others in each run."""
    text = "Applications drawn at random are set up, started, called, stopped, changed and taken down."

    def drawn(seed: int, readings: Mapping[str, str]) -> tuple[tuple[str, Scenario], ...]:
        return tuple((f"unforeseen/{n}", _Application(random.Random(f"{seed} {n}")).scenario()) for n in range(NUMBER))

    return [TestPurpose("unforeseen", "11.2.3", text, _REQUIREMENTS, drawn(0, {}), drawn)]


class _Application:
    """Components by levels; each requires port elements of components below."""

    def __init__(self, source: random.Random) -> None:
        self.random = source
        self.components: dict[str, Declaration] = {}
        self.steps: list[Step] = []
        self.boxes: list[str] = []
        self.home = s.MANAGER
        self.where: dict[str, str] = {}
        self.links: dict[tuple[str, str], str] = {}
        self.connections = 0
        self.calls = 0

    def scenario(self) -> Scenario:
        """The application's whole life."""
        for number in range(self.random.choice((0, 0, 1, 2))):
            self.boxes.append(f"box {number}")
            self.steps.append(s.CreateContainer(self.boxes[-1]))
        self.home = self.random.choice((s.MANAGER, *self.boxes))
        for number in range(self.random.randint(2, 5)):
            self.add(f"c{number}")
        for _ in range(self.random.choice(_PHASES)):
            self.operate()
            self.change()
        self.take_down()
        return Scenario(self.components, tuple(self.steps))

    def add(self, name: str) -> None:
        """A component that requires port elements of earlier ones, each of them connected; the first one requires nothing."""
        provides = tuple(f"p{n}.api" for n in range(self.random.randint(1, 3)))
        goals = [(server, port) for server, d in self.components.items() if not d.fragment for port in d.provides]
        goals = self.random.sample(goals, min(len(goals), self.random.choice((0, 1, 1, 2))))
        requires = tuple(f"r{n}.api" for n in range(len(goals)))
        plan: dict[Hook, tuple[Action, ...]] = {}
        if requires:
            plan["exchange"] = tuple(s.CallPort(port, self.value()) for port in requires)
        attributes = {f"a{n}": f"word{self.random.randint(0, 9)}" for n in range(self.random.choice((0, 0, 1, 2)))}
        is_connectable, is_fragment = self.random.random() < 0.7, self.random.random() < 0.25
        if is_fragment:
            plan["exchange"] = (*plan.get("exchange", ()), s.QuerySiblings())
        self.components[name] = Declaration(provides, requires, attributes, is_connectable, is_fragment, plan)
        self.where[name] = self.home
        self.steps.append(s.AddComponent(name, self.where[name]))
        for port, goal in zip(requires, goals, strict=True):
            self.connect(name, port, goal)

    def connect(self, client: str, port: str, goal: tuple[str, str]) -> None:
        server, provided = goal
        self.connections += 1
        bind = f"link {self.connections}"
        self.steps.append(s.GetPortElement(server, provided, f"to {self.connections}", self.where[server]))
        self.steps.append(s.Connect(client, port, f"to {self.connections}", bind, self.where[client]))
        self.links[client, port] = bind

    def operate(self) -> None:
        """Everything is started, called and stopped."""
        containers = [s.MANAGER, *self.boxes]
        self.random.shuffle(containers)
        self.steps += [s.Start(container) for container in containers]
        for name in self.random.choices(tuple(self.where), k=self.random.randint(1, 4)):
            self.calls += 1
            port = self.random.choice(self.components[name].provides)
            self.steps.append(s.GetPortElement(name, port, f"way {self.calls}", self.where[name]))
            self.steps.append(s.Invoke(f"way {self.calls}", self.value()))
        self.list_members()
        self.random.shuffle(containers)
        self.steps += [s.Stop(container) for container in containers]

    def change(self) -> None:
        """Connect something else, remove a component, or use something that does not exist."""
        if self.links and self.random.random() < 0.7:
            client, port = self.random.choice(tuple(self.links))
            self.steps.append(s.Disconnect(self.links.pop((client, port)), self.where[client]))
            earlier = tuple(self.components)[: tuple(self.components).index(client)]
            server = self.random.choice([n for n in earlier if n in self.where and not self.components[n].fragment])
            self.connect(client, port, (server, self.random.choice(self.components[server].provides)))
        if self.random.random() < 0.5:
            wrong = self.random.choice(
                (
                    s.RemoveComponent(s.UNKNOWN),
                    s.Disconnect(s.UNKNOWN),
                    s.GetPortElement(s.UNKNOWN, "p0.api", "nowhere"),
                )
            )
            self.steps.append(wrong)
        self.list_members()

    def take_down(self) -> None:
        """Remove the components that no other one needs, one by one; then the rest, and destroy the runtime."""
        for name in tuple(self.where)[::-1][: self.random.randint(0, len(self.where))]:
            for client, port in tuple(self.links):
                if client == name:
                    self.steps.append(s.Disconnect(self.links.pop((client, port)), self.where[client]))
            self.steps.append(s.RemoveComponent(name, self.where.pop(name)))
        self.list_members()
        if self.boxes and self.random.random() < 0.5:
            self.steps.append(s.RemoveContainer(self.boxes.pop()))
        if self.random.random() < 0.5:
            self.steps.append(s.Destroy())

    def list_members(self) -> None:
        if self.random.random() < 0.6:
            self.steps.append(s.GetComponents(self.random.choice((s.MANAGER, *self.boxes))))

    def value(self) -> int:
        return self.random.randint(1, 9)
