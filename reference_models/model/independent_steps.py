"""Finds out whether steps that several threads take at once succeed in every order."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from ucm_cts.adapters.contract import scenario as s


def succeed_in_any_order(scenario: s.Scenario, steps: Sequence[s.Step]) -> bool:
    """Do ``steps`` only add, connect and remove plain components, and none twice or of another thread, so that each succeeds
    whatever the other threads do?
    """
    actions = (action for one in scenario.components.values() for plan in one.plan.values() for action in plan)
    if scenario.interfaces or not all(isinstance(action, s.HoldAtGate) for action in actions):
        return False
    world = _World(scenario.components)
    return all(world.take(step) for step in steps)


@dataclass
class _World:
    """What the steps so far have made, each with the thread that made it.

    ``homes``: the containers; ``added``: the components, each with its container; ``used``: those that steps have looked up, or connected.
    ``references``, ``links``: what port elements and connections were bound to; ``connected``: the port elements that are connected.
    """

    declared: Mapping[str, s.Declaration]
    homes: set[str] = field(default_factory=lambda: {s.MANAGER})
    added: dict[str, tuple[s.Declaration, str, str | None]] = field(default_factory=dict)
    used: set[str] = field(default_factory=set)
    references: dict[str, str | None] = field(default_factory=dict)
    links: dict[str, tuple[tuple[str, str], str, str | None]] = field(default_factory=dict)
    connected: set[tuple[str, str]] = field(default_factory=set)

    def take(self, step: s.Step) -> bool:
        """Does ``step`` succeed, whatever other threads do? It is done then."""
        if not isinstance(step, s.AddComponent | s.RemoveComponent | s.GetPortElement | s.Connect | s.Disconnect):
            return isinstance(step, s.GetComponents) or self._is_new_home(step)
        if step.container not in self.homes:
            return False
        match step:
            case s.AddComponent():
                name, declaration = step.bind or step.component, self.declared.get(step.component)
                if declaration is None or name in self.added or step.attributes:
                    return False
                self.added[name] = declaration, step.container, step.thread
            case s.RemoveComponent():
                if step.id in self.used or self._declaration(step) is None:
                    return False
                del self.added[step.id]
            case s.GetPortElement():
                declaration = self._declaration(step)
                if declaration is None or step.port not in declaration.provides or step.bind in self.references:
                    return False
                self.used.add(step.id)
                self.references[step.bind] = step.thread
            case s.Connect():
                declaration, end = self._declaration(step), (step.id, step.port)
                is_known = step.to in self.references and self.references[step.to] in (None, step.thread)
                if declaration is None or step.port not in declaration.requires or not is_known:
                    return False
                if step.bind in self.links or end in self.connected:
                    return False
                self.links[step.bind] = end, step.container, step.thread
                self.used.add(step.id)
                self.connected.add(end)
            case s.Disconnect():
                end, *made = self.links.get(step.connection, (("", ""), "", None))
                if end not in self.connected or made != [step.container, step.thread]:
                    return False
                self.connected.remove(end)
        return True

    def _is_new_home(self, step: s.Step) -> bool:
        if not isinstance(step, s.CreateContainer) or step.bind in self.homes or step.thread is not None:
            return False
        self.homes.add(step.bind)
        return True

    def _declaration(self, step: s.RemoveComponent | s.GetPortElement | s.Connect) -> s.Declaration | None:
        """What is declared of the component that ``step`` is about, if that is certainly in the container when its thread asks."""
        declaration, home, maker = self.added.get(step.id, (None, "", None))
        return declaration if home == step.container and maker in (None, step.thread) else None
