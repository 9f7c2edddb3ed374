"""Which steps of an application are possible: none uses what was not made, and none calls a component that is waiting for its start.

A framework may keep such a call waiting until the component is ready (11.2.3), which it may never be.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Declaration, Hook, Step
from ucm_cts.adapters.contract.traits import bound_by, used_by

_TO_READY: tuple[Hook, ...] = ("on_connect", "on_startup")


def possible(steps: Iterable[Step], components: Mapping[str, Declaration]) -> tuple[Step, ...]:
    """``steps`` without those that need what none of them has made before, such as a connection, and without calls of components that
    are not ready if no step fails.
    """
    there = {s.MANAGER, s.NIL, s.UNKNOWN}
    so_far = _Application(components)
    kept = []
    for step in steps:
        if there.issuperset(used_by(step)) and not (isinstance(step, s.Invoke) and so_far.may_keep_waiting(step.ref)):
            there.update(bound_by(step))
            so_far.take(step)
            kept.append(step)
    return tuple(kept)


@dataclass
class _Application:
    """What has been built so far, if every step succeeds.

    ``declarations``: of components.
    ``kinds``, ``homes``: declaration and container of each component there is.
    ``ends``: the client and the provider of each connection; the provider is empty where the step names none.
    ``goals``: the component of each reference.
    ``running``: the containers that were started when all of their components could be.
    """

    declarations: Mapping[str, Declaration]
    kinds: dict[str, str] = field(default_factory=dict)
    homes: dict[str, str] = field(default_factory=dict)
    ends: dict[str, tuple[str, str]] = field(default_factory=dict)
    goals: dict[str, str] = field(default_factory=dict)
    running: set[str] = field(default_factory=set)

    def may_keep_waiting(self, reference: str) -> bool:
        """Is the component of ``reference`` there, but not ready?"""
        home = self.homes.get(self.goals[reference])
        return home is not None and home not in self.running

    def take(self, step: Step) -> None:
        match step:
            case s.AddComponent() if step.component in self.declarations:
                name = step.bind or step.component
                self.kinds[name], self.homes[name] = step.component, step.container
            case s.GetPortElement():
                self.goals[step.bind] = step.id
            case s.Connect():
                self.ends[step.bind] = step.id, self.goals.get(step.to, "")
            case s.Disconnect():
                self.ends.pop(step.connection, None)
            case s.RemoveComponent():
                self.homes.pop(step.id, None)
                self.ends = {name: ends for name, ends in self.ends.items() if step.id not in ends}
            case s.RemoveContainer():
                gone = {name for name, home in self.homes.items() if home == step.container}
                self.homes = {name: home for name, home in self.homes.items() if name not in gone}
                self.ends = {name: ends for name, ends in self.ends.items() if gone.isdisjoint(ends)}
            case s.Start() if self._is_complete(step.container):
                self.running.add(step.container)
            case s.Stop():
                self.running.discard(step.container)
            case s.Destroy():
                self.homes.clear()

    def _is_complete(self, container: str) -> bool:
        """Is every component of ``container`` connected, and does none fail in a callback that leads to its being ready?"""
        members = {name: self.declarations[self.kinds[name]] for name, home in self.homes.items() if home == container}
        clients = Counter(client for client, _ in self.ends.values())
        return all(len(each.requires) <= clients[name] and not _fails(each) for name, each in members.items())


def _fails(declaration: Declaration) -> bool:
    actions = (action for hook in _TO_READY for action in declaration.plan.get(hook, ()))
    return any(isinstance(action, s.RaiseError) for action in actions)
