"""Changes a scenario: adds, removes or repeats steps, or replaces a body."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import msgspec

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Scenario, Step
from ucm_cts.adapters.contract.traits import Uses, bindings, fields
from ucm_cts.harness.execution.shrink import tidied, without_step
from ucm_cts.harness.exploring.writer import Choose, Writer
from ucm_cts.harness.purposes.scripts import overlaps

LONGEST = 60
"""Steps. What is longer is only made shorter."""


def changed(scenario: Scenario, choose: Choose) -> Scenario:
    """``scenario`` with one to three changes that still keep one thread at a time on the containers."""
    for _ in range(choose((1, 1, 2, 3))):
        change: Callable[[Scenario, Choose], Scenario] = choose(_CHANGES)
        other = change(scenario, choose)
        if len(other.steps) <= max(LONGEST, len(scenario.steps)) and not any(overlaps(other.steps)):
            scenario = other
    return scenario


def _go_on(scenario: Scenario, choose: Choose) -> Scenario:
    """Other steps instead of the last ones, or after them."""
    kept = len(scenario.steps) - choose((0, 0, 1, 2, 4, 8))
    return _with_more(scenario, max(kept, 0), choose, ())


def _insert(scenario: Scenario, choose: Choose) -> Scenario:
    """More steps somewhere."""
    place = choose(range(len(scenario.steps) + 1))
    return _with_more(scenario, place, choose, scenario.steps[place:])


def _with_more(scenario: Scenario, kept: int, choose: Choose, remaining: tuple[Step, ...]) -> Scenario:
    writer = Writer(choose)
    writer.resume(msgspec.structs.replace(scenario, steps=scenario.steps[:kept]))
    writer.workers = sum(step.thread is not None for step in scenario.steps)
    if not writer.components or choose((True, False, False)):
        writer.recruit(choose((False, True)))
    writer.go_on(choose((1, 2, 3, 5)))
    return tidied(scenario, (*writer.steps, *remaining))


def _leave_out(scenario: Scenario, choose: Choose) -> Scenario:
    if not scenario.steps:
        return scenario
    return tidied(scenario, without_step(scenario.steps, choose(range(len(scenario.steps)))))


def _repeat(scenario: Scenario, choose: Choose) -> Scenario:
    """A step once more, later."""
    if not scenario.steps:
        return scenario
    which = choose(range(len(scenario.steps)))
    place = choose(range(which + 1, len(scenario.steps) + 1))
    again = msgspec.structs.replace(scenario.steps[which], thread=None)
    return msgspec.structs.replace(scenario, steps=(*scenario.steps[:place], again, *scenario.steps[place:]))


def _elsewhere(scenario: Scenario, choose: Choose) -> Scenario:
    """An operation of another container, or on another thing of its kind."""
    places = [i for i, step in enumerate(scenario.steps) if dict(_others(scenario, i, step))]
    if not places:
        return scenario
    place = choose(places)
    field, values = choose(tuple(_others(scenario, place, scenario.steps[place])))
    step = msgspec.structs.replace(scenario.steps[place], **{field: choose(values)})
    return msgspec.structs.replace(scenario, steps=(*scenario.steps[:place], step, *scenario.steps[place + 1 :]))


def _others(scenario: Scenario, place: int, step: Step) -> Iterator[tuple[str, tuple[str, ...]]]:
    """Other variables that the fields of a step could name."""
    bound = [one for before in scenario.steps[:place] for one in bindings(before)]
    if not isinstance(step, s.RemoveContainer):  # the root container cannot be removed
        bound.insert(0, (s.MANAGER, "container"))
    for field, trait in fields(type(step)):
        if isinstance(trait, Uses) and trait.kind in ("container", "component", "connection"):
            mine = getattr(step, field)
            others = [variable for variable, kind in bound if kind == trait.kind and variable != mine]
            if others:
                yield field, tuple(dict.fromkeys(others))


def _other_body(scenario: Scenario, choose: Choose) -> Scenario:
    """A component with the same ports and another plan."""
    if not scenario.components:
        return scenario
    name = choose(tuple(scenario.components))
    writer = Writer(choose)
    known = scenario.components[name]
    other = writer.body(known.provides, known.requires, choose((False, True)))
    return tidied(msgspec.structs.replace(scenario, components={**scenario.components, name: other}), scenario.steps)


_CHANGES = (_go_on, _go_on, _insert, _insert, _leave_out, _repeat, _elsewhere, _other_body)
