"""Test purposes of provocations: one for each entrance and action, and one for each refused operation."""

from __future__ import annotations

import itertools
from collections.abc import Iterable

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Declaration, Scenario, Step
from ucm_cts.harness.purposes.provocations.application import Application
from ucm_cts.harness.purposes.provocations.boundaries import load_boundaries
from ucm_cts.harness.purposes.provocations.dimensions import Cell, Entrance, load_cells, load_dimensions
from ucm_cts.harness.purposes.scripts import TestPurpose


def provocation_purposes() -> list[TestPurpose]:
    """All provocations of the suite."""
    cells = load_cells()
    return [
        *_purposes("provocation", "A body {action} in {entrance}.", [c for c in cells if c.entrance.hook]),
        *_purposes("refusal", "It is refused that {entrance}.", [c for c in cells if not c.entrance.hook]),
    ]


_LONG = 50
"""Durations from so many milliseconds on are long."""


def duration_purposes() -> list[TestPurpose]:
    """Bodies that take their time: each entrance for each duration, the longest ones in one place, because they cost that time.

    A body that is added late may be refused, and would be waited for in vain.
    """
    dimensions, durations = load_dimensions(), load_boundaries().durations
    purposes = []
    certain = (
        entrance for entrance in dimensions.entrances if (entrance.by, entrance.after) != ("add_component", "start")
    )
    for number, entrance in enumerate(certain):
        name = f"duration/{entrance.name}"
        cells = [cell for place in dimensions.places if (cell := _held_in(entrance, place))]
        scenarios = tuple(
            (f"{name}/{ms} ms, {cell.name}", Application(cell, ms).scenario())
            for ms in durations
            for cell in (cells if ms < _LONG else [cells[number % len(cells)]])
        )
        text = f"A body takes its time in {entrance.name}."
        exercises = entrance.exercises
        purposes.append(TestPurpose(name, exercises[0].split("-")[1], text, exercises, scenarios))
    slow = tuple(
        (f"duration/call of a {kind}/{ms} ms, {home}", _slow_peer(ms, home, kind == "fragment"))
        for ms in durations
        for home in dimensions.places
        for kind in dimensions.kinds
    )
    text = "A component or fragment that another one calls takes its time."
    return [*purposes, TestPurpose("duration/call of a peer", "11.1.3", text, ("R-11.1.3-01", "R-11.1.2-02"), slow)]


def run_purposes() -> list[TestPurpose]:
    """What a body does in run, where it executes by itself: profile core. The gate shows that it has been there."""
    here = (s.HoldAtGate("ran"),)
    purposes = []
    for action in load_dimensions().actions:
        plan = {"hold": here, "raise": (*here, *action.plan), "call": (*action.plan, *here)}.get(action.tag)
        if plan is None:
            continue
        name = f"run/{action.name}"
        components = {
            "server": Declaration(("in.api",), policies=(s.Policy(s.UNPROTECTED_PASSIVE),)),
            "runner": Declaration(
                ("in.api",), ("out.api",), plan={"run": plan}, policies=(s.Policy(s.SELF_EXECUTING),)
            ),
        }
        scenarios = tuple(
            (f"{name}/then {then}", Scenario(components, (*_RUN, *after))) for then, after in _AFTER_RUN.items()
        )
        text = f"A body {action.name} in run."
        purposes.append(TestPurpose(name, "10.1.3.2", text, ("R-10.1.3.2-01",), scenarios))
    return purposes


_RUN: tuple[Step, ...] = (
    s.AddComponent("server"),
    s.AddComponent("runner"),
    s.GetPortElement("server", "in.api", "to server"),
    s.Connect("runner", "out.api", "to server", "link"),
    s.Start(),
    s.ReachGate("ran"),
    s.OpenGate("ran"),
    s.Invoke("to server", 1),
)
_RUN_AGAIN: tuple[Step, ...] = (s.Start(), s.ReachGate("ran", total=2), s.Invoke("to server", 2), s.Stop())
_AFTER_RUN: dict[str, tuple[Step, ...]] = {
    "start and stop": (s.Stop(), *_RUN_AGAIN),
    "undo and redo": (
        s.Stop(),
        s.Disconnect("link"),
        s.RemoveComponent("runner"),
        s.AddComponent("runner"),
        s.Connect("runner", "out.api", "to server", "other link"),
        *_RUN_AGAIN,
        s.GetComponents(),
    ),
    "destroy": (s.Destroy(),),
}


def _held_in(entrance: Entrance, place: str) -> Cell | None:
    """A cell in which the body is held, and another one was added before; None if there is none in that place."""
    dimensions = load_dimensions()
    held = next(action for action in dimensions.actions if action.name == "is held")
    order = itertools.product(dimensions.aftermaths, (place,), dimensions.positions[1:], dimensions.kinds)
    cells = (Cell(entrance, held, *others) for others in order)
    return next((cell for cell in cells if not dimensions.why_empty(cell)), None)


def _slow_peer(milliseconds: int, home: str, is_fragment: bool) -> Scenario:
    components = {
        "server": Declaration(("in.api",), fragment=is_fragment, plan={"exchange": (s.HoldAtGate("inside"),)}),
        "client": Declaration(
            ("in.api",), ("out.api",), fragment=is_fragment, plan={"exchange": (s.CallPort("out.api", 7),)}
        ),
    }
    steps: tuple[Step, ...] = (
        *((s.CreateContainer(home),) if home != s.MANAGER else ()),
        *(s.AddComponent(name, home) for name in components),
        *(s.GetPortElement(name, "in.api", f"to {name}", home) for name in components),
        s.Connect("client", "out.api", "to server", "link", home),
        s.Start(home),
        s.Invoke("to client", 1, thread="caller"),
        s.ReachGate("inside"),
        s.Pause(milliseconds),
        s.OpenGate("inside"),
        s.Join("caller"),
        s.Stop(home),
    )
    return Scenario(components, steps)


def _purposes(family: str, text: str, cells: Iterable[Cell]) -> list[TestPurpose]:
    by_purpose: dict[tuple[str, str], list[Cell]] = {}
    for cell in cells:
        by_purpose.setdefault((cell.entrance.name, cell.action.name), []).append(cell)
    purposes = []
    for (entrance, action), some in by_purpose.items():
        name = f"{family}/{entrance}" + (f"/{action}" if some[0].entrance.hook else "")
        exercises = some[0].entrance.exercises
        scenarios = tuple((f"{name}/{cell.name}", Application(cell).scenario()) for cell in some)
        described = text.format(action=action, entrance=entrance)
        purposes.append(TestPurpose(name, exercises[0].split("-")[1], described, exercises, scenarios))
    return purposes
