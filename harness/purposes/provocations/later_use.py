"""Later use: what a framework gave out is used after something has happened to it or beside it (``suite/later_use.yaml``)."""

from __future__ import annotations

import msgspec

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Declaration, Scenario, Step
from ucm_cts.adapters.contract.traits import used_by
from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.catalogue.documents import read
from ucm_cts.harness.catalogue.requirements import SUITE
from ucm_cts.harness.purposes.provocations.possible import possible
from ucm_cts.harness.purposes.scripts import TestPurpose

_BOX, _NEW, _ROOT = "box", "new box", "root"
_REQUIREMENTS = ("R-12.10-05", "R-12.10-06", "R-12.10-07", "R-12.10-08")
_COMPONENTS = {
    "anchor": Declaration(("in.api",), attributes={"label": "anchor", "level": "low"}),
    "server": Declaration(("in.api",), attributes={"label": "server", "level": "low"}),
    "client": Declaration(
        ("in.api",),
        ("out.api",),
        {"label": "client", "level": "high"},
        connectable=True,
        plan={"exchange": (s.CallPort("out.api", 4),)},
    ),
    "bystander": Declaration(
        ("in.api",),
        ("out.api",),
        {"label": "bystander", "level": "other"},
        plan={"exchange": (s.CallPort("out.api", 5),)},
    ),
}
_ADDED: tuple[Step, ...] = (
    *(s.AddComponent(name) for name in _COMPONENTS),
    *(s.GetPortElement(name, "in.api", f"to {name}") for name in _COMPONENTS),
)
_CONNECTED: tuple[Step, ...] = (
    s.Connect("client", "out.api", "to server", "link"),
    s.Connect("bystander", "out.api", "to anchor", "own link"),
    s.Start(),
    s.Invoke("to client", 1),
    s.Stop(),
)
_SET_UP = (*_ADDED, s.Start(), s.Stop(), *_CONNECTED)
_SET_UP_ACROSS: tuple[Step, ...] = (
    s.CreateContainer(_BOX),
    s.AddComponent("server", _BOX),
    s.GetPortElement("server", "in.api", "to server", _BOX),
    s.Start(_BOX),
    *(step for step in _ADDED if "server" not in (getattr(step, "component", ""), getattr(step, "id", ""))),
    s.Start(),
    s.Stop(),
    *_CONNECTED,
)


class Across(Value, frozen=True):
    """What happens in the meantime, by its name, where the server is in a container of its own, and the ``uses`` that follow."""

    since: dict[str, tuple[Step, ...]]
    uses: tuple[str, ...]


class LaterUse(Value, frozen=True):
    """``suite/later_use.yaml``.

    ``since``: what happens in the meantime, by its name.
    ``uses``: how something is used then, by its name.
    ``across``: the same with a server in another container than its client.
    """

    since: dict[str, tuple[Step, ...]]
    uses: dict[str, tuple[Step, ...]]
    across: Across


def later_use_purposes() -> list[TestPurpose]:
    """One purpose for each thing that happens in the meantime."""
    dimensions = read(SUITE / "later_use.yaml", LaterUse)
    within = [
        _purpose(
            name,
            [
                (f"{use} in the {home}", _scenario(home, (*since, *steps)))
                for use, steps in dimensions.uses.items()
                for home in (s.MANAGER, _BOX)
                if (home == _BOX or not _needs_box((*since, *steps))) and _has_all((*since, *steps))
            ],
        )
        for name, since in dimensions.since.items()
    ]
    across = [
        _purpose(name, [(use, _scenario_across((*since, *dimensions.uses[use]))) for use in dimensions.across.uses])
        for name, since in dimensions.across.since.items()
    ]
    return [*within, *across]


def _purpose(name: str, scenarios: list[tuple[str, Scenario]]) -> TestPurpose:
    text = f"What was given out is used after {name}."
    named = tuple((f"later use/{name}/{use}", scenario) for use, scenario in scenarios)
    return TestPurpose(f"later use/{name}", "12.10", text, _REQUIREMENTS, named)


def _needs_box(steps: tuple[Step, ...]) -> bool:
    return any(_BOX in used_by(step) for step in steps)


def _has_all(steps: tuple[Step, ...]) -> bool:
    """Is a second sub-container used only if it has been created?"""
    created = any(isinstance(step, s.CreateContainer) for step in steps)
    return created or not any(_NEW in used_by(step) or getattr(step, "container", "") == _NEW for step in steps)


def _scenario(home: str, steps: tuple[Step, ...]) -> Scenario:
    """The application, and the steps, in container ``home``."""
    created = () if home == s.MANAGER else (s.CreateContainer(home),)
    return Scenario(
        _COMPONENTS, possible((*created, *(_within(home, step) for step in (*_SET_UP, *steps))), _COMPONENTS)
    )


def _scenario_across(steps: tuple[Step, ...]) -> Scenario:
    """The application with its server in a container of its own, and the steps."""
    return Scenario(_COMPONENTS, possible((*_SET_UP_ACROSS, *steps), _COMPONENTS))


def _within(home: str, step: Step) -> Step:
    if isinstance(step, s.RemoveContainer) or "container" not in step.__struct_fields__:
        return step
    named = step.container  # type: ignore[union-attr]
    if named not in (s.MANAGER, _ROOT):
        return step
    return msgspec.structs.replace(step, container=s.MANAGER if named == _ROOT else home)
