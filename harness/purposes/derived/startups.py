"""For a vendor who declares how start calls members (11.2.2.1): two members meet in on_startup, if they can."""

from __future__ import annotations

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.harness.purposes.scripts import TestPurpose

_GATE = "starting"
_MEMBERS = ("one", "two")


def startup_purposes() -> list[TestPurpose]:
    """One purpose, whose scenarios cost a framework that starts one by one as much time as there is patience."""
    text = "Of two members that have nothing to do with each other, neither leaves on_startup until both are inside."
    scenarios = tuple((f"startups meet/{where}", _meeting(where)) for where in (s.MANAGER, "box"))
    return [
        TestPurpose(
            "startups meet", "11.2.2.1", text, ("R-11.2.2.1-13",), scenarios, under=("start-order=one-by-one|at-once",)
        )
    ]


def _meeting(container: str) -> s.Scenario:
    made = () if container == s.MANAGER else (s.CreateContainer(container),)
    body = s.Declaration(plan={"on_startup": (s.HoldAtGate(_GATE),)})
    steps = (
        *made,
        *(s.AddComponent(name, container) for name in _MEMBERS),
        s.Start(container, thread="starter"),
        s.ReachGate(_GATE, total=len(_MEMBERS)),
        s.OpenGate(_GATE),
        s.Join("starter"),
        s.Stop(container),
    )
    return s.Scenario(dict.fromkeys(_MEMBERS, body), steps)
