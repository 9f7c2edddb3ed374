"""Stress: scenarios in which callers enter a component with an execution policy as fast as they can (10.1.3.2)."""

from __future__ import annotations

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Declaration, Policy, Scenario
from ucm_cts.harness.purposes.scripts import TestPurpose

MILLISECONDS = 200
"""Milliseconds that a component is stressed; docs/reentrancy.md has the detection rates."""

_PORTS = ("in.api", "aux.api")

_KINDS = {
    "protected passive, one port": ((Policy(s.PROTECTED_PASSIVE),), (0, 0), "R-10.1.3.2-13"),
    "protected passive, two ports": ((Policy(s.PROTECTED_PASSIVE),), (0, 1), "R-10.1.3.2-16"),
    "active on one port": ((Policy(s.ACTIVE, "in.api"),), (0, 0), "R-10.1.3.2-09"),
    "active on one port, called on both": ((Policy(s.ACTIVE, "in.api"),), (0, 1), "R-10.1.3.2-10"),
    "self-executing": ((Policy(s.SELF_EXECUTING),), (0, 1), "R-10.1.3.2-06"),
    "unprotected passive": ((Policy(s.UNPROTECTED_PASSIVE),), (0, 0), "R-10.1.3.2-20"),
}


def stress_purposes() -> list[TestPurpose]:
    """Two callers of each kind of component."""
    return [
        TestPurpose(
            f"stress/{name}",
            "10.1.3.2",
            f"Two callers enter a component that is {name} as fast as they can.",
            (requirement,),
            ((f"stress/{name}", _stressed(policies, ports)),),
        )
        for name, (policies, ports, requirement) in _KINDS.items()
    ]


def _stressed(policies: tuple[Policy, ...], ports: tuple[int, int]) -> Scenario:
    steps: tuple[s.Step, ...] = (
        s.AddComponent("server"),
        *(s.GetPortElement("server", _PORTS[port], f"way {number}") for number, port in enumerate(ports)),
        s.Start(),
        s.Stress(("way 0", "way 1"), MILLISECONDS),
        s.Stop(),
        s.GetComponents(),
    )
    return Scenario({"server": Declaration(_PORTS, policies=policies)}, steps)
