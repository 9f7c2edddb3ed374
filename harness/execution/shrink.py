"""Shortens a scenario: leaves out steps, components and plans as long as the same failure shows."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import msgspec

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Action, Declaration, Scenario, Step
from ucm_cts.adapters.contract.traits import bound_by, named, used_by
from ucm_cts.harness.purposes.scripts import overlaps

ROUNDS = 40
"""How often the candidates of a shorter scenario are tried; each round leaves out at least one thing."""


def shortest(scenario: Scenario, first_failing: Callable[[Sequence[Scenario]], int | None]) -> Scenario:
    """A scenario as short as can be found. ``first_failing`` runs candidates and returns the index of the first that still shows the failure."""
    for fewer in (_halves, _shorter):
        for _ in range(ROUNDS):
            candidates = list(fewer(scenario))
            index = first_failing(candidates) if candidates else None
            if index is None:
                break
            scenario = candidates[index]
    return scenario


def _halves(scenario: Scenario) -> Iterator[Scenario]:
    """Scenarios with far fewer components: neighbours stay together, because most often they are connected."""
    names = list(scenario.components)
    size = len(names)
    for most in (size // 4, size // 2):
        for first in range(0, size, max(most, 1)) if most > 1 else ():
            kept = names[first : first + most]
            steps = scenario.steps
            for index in range(len(steps) - 1, -1, -1):
                step = steps[index]
                if isinstance(step, s.AddComponent) and step.component not in kept:
                    steps = without_step(steps, index)
            if not any(overlaps(steps)):
                yield tidied(scenario, steps)


def _shorter(scenario: Scenario) -> Iterator[Scenario]:
    """Shorter scenarios, the shortest first, with one thread at a time on the containers."""
    return (shorter for shorter in _with_less(scenario) if not any(overlaps(shorter.steps)))


def _with_less(scenario: Scenario) -> Iterator[Scenario]:
    steps = scenario.steps
    for half in (steps[: len(steps) // 2], steps[: -len(steps) // 4 or None]):
        if 0 < len(half) < len(steps):
            yield tidied(scenario, half)
    for index in range(len(steps) - 1, -1, -1):
        yield tidied(scenario, without_step(steps, index))
    for name, declaration in scenario.components.items():
        for hook in declaration.plan:
            without = {h: a for h, a in declaration.plan.items() if h != hook}
            for plan in (without, *(declaration.plan | {hook: fewer} for fewer in _fewer(declaration.plan[hook]))):
                simpler = msgspec.structs.replace(declaration, plan=plan)
                yield tidied(
                    msgspec.structs.replace(scenario, components={**scenario.components, name: simpler}), steps
                )
        for simpler in _plainer(declaration):
            yield msgspec.structs.replace(scenario, components={**scenario.components, name: simpler})
        for port in (*declaration.requires, *declaration.provides):
            yield from _without_port(scenario, name, port)
    for container in {step.bind for step in steps if isinstance(step, s.CreateContainer)}:
        yield _in_one_container(scenario, container)


def _plainer(declaration: Declaration) -> Iterator[Declaration]:
    """The same component with fewer callbacks or without attributes."""
    if declaration.connectable:
        yield msgspec.structs.replace(declaration, connectable=False)
    if declaration.fragment:
        yield msgspec.structs.replace(declaration, fragment=False)
    if declaration.attributes:
        yield msgspec.structs.replace(declaration, attributes={})
    if declaration.defaults:
        yield msgspec.structs.replace(declaration, defaults={})


def _without_port(scenario: Scenario, component: str, port: str) -> Iterator[Scenario]:
    """The component without that port element, unless its plan or a policy names it, and the steps without those for it."""
    declaration = scenario.components[component]
    if port in msgspec.json.encode((declaration.plan, declaration.policies)).decode():
        return
    simpler = msgspec.structs.replace(
        declaration,
        provides=tuple(p for p in declaration.provides if p != port),
        requires=tuple(p for p in declaration.requires if p != port),
        ports={p: interface for p, interface in declaration.ports.items() if p != port},
    )
    steps = scenario.steps
    its = {step.bind or component for step in steps if isinstance(step, s.AddComponent) and step.component == component}
    for index in range(len(steps) - 1, -1, -1):
        step = steps[index]
        if port in named(step, "port element") and its.intersection(used_by(step)):
            steps = without_step(steps, index)
    yield tidied(msgspec.structs.replace(scenario, components={**scenario.components, component: simpler}), steps)


def _in_one_container(scenario: Scenario, container: str) -> Scenario:
    """The root container takes the place of ``container``, which is not created."""
    steps = tuple(
        msgspec.structs.replace(step, container=s.MANAGER) if getattr(step, "container", "") == container else step
        for step in scenario.steps
        if not (isinstance(step, s.CreateContainer) and step.bind == container)
        and not (isinstance(step, s.RemoveContainer) and step.container == container)
    )
    return tidied(scenario, steps)


def _fewer(actions: tuple[Action, ...]) -> Iterator[tuple[Action, ...]]:
    """The first half and the second half of what a probe does in a hook."""
    if len(actions) > 1:
        middle = len(actions) // 2
        yield from (actions[:middle], actions[middle:])


def without_step(steps: tuple[Step, ...], index: int) -> tuple[Step, ...]:
    """``steps`` without one of them, and without those that need what it binds."""
    lost = set(bound_by(steps[index]))
    kept = list(steps[:index])
    for step in steps[index + 1 :]:
        if lost.intersection(used_by(step)):
            lost.update(bound_by(step))
        else:
            lost.difference_update(bound_by(step))
            kept.append(step)
    return tuple(kept)


def tidied(scenario: Scenario, steps: tuple[Step, ...]) -> Scenario:
    """The scenario with these steps, without waits, gates and components that they no longer need."""
    workers = {step.thread for step in steps if step.thread}
    steps = tuple(x for x in steps if workers.issuperset(named(x, "worker")))
    added = {step.component for step in steps if isinstance(step, s.AddComponent)}
    components = {name: d for name, d in scenario.components.items() if name in added}
    plans = (actions for d in components.values() for actions in d.plan.values())
    gates = {gate for actions in plans for action in actions for gate in named(action, "gate")}
    steps = tuple(x for x in steps if gates.issuperset(named(x, "gate")))
    return msgspec.structs.replace(scenario, components=components, steps=steps)
