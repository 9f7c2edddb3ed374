"""Circles: calls that come back to a protected component while it waits for them (10.1.3.2, protected-recursion).

Whoever waits there may wait for ever, so these scenarios say which worker need not come back; a component beside the circle
shows that the rest still works.
"""

from __future__ import annotations

import msgspec

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_types import Interface, Method
from ucm_cts.adapters.contract.scenario import Declaration, Policy, Scenario, Step
from ucm_cts.harness.purposes.scripts import TestPurpose

_PATIENCE = 500
_POLICIES = {"protected passive": Policy(s.PROTECTED_PASSIVE), "active": Policy(s.ACTIVE, "back.api")}
_PROMISES = {"protected passive": "R-10.1.3.2-15", "active": "R-10.1.3.2-08"}


def circle_purposes() -> list[TestPurpose]:
    """A component that calls itself, and two that call each other, of each kind."""
    return [
        TestPurpose(
            f"circle/{kind}",
            "10.1.3.2",
            f"Components that are {kind} call themselves and each other in a circle.",
            (_PROMISES[kind],),
            tuple((f"circle/{kind}/{size} in a circle", _circle(policy, size)) for size in (1, 2)),
        )
        for kind, policy in _POLICIES.items()
    ]


def _circle(policy: Policy, size: int) -> Scenario:
    """The first member is entered at ``in.api`` and calls on; a member that is called at ``back.api`` calls on, except the first."""
    names = [f"member {number}" for number in range(size)]
    call = s.CallMethod("out.api", "pass_on")
    answer = s.Answer("pass_on")
    beside = msgspec.structs.replace(policy, port=policy.port and "in.api")
    components = {"beside": _member(beside)}
    for number, name in enumerate(names):
        components[name] = _member(policy, exchange=(call,), method=(answer,) if number == 0 else (call, answer))
    steps: list[Step] = [s.AddComponent(name) for name in components]
    steps += [s.GetPortElement(name, "back.api", f"back of {name}") for name in names]
    for name, following in zip(names, (*names[1:], names[0]), strict=True):
        steps.append(s.Connect(name, "out.api", f"back of {following}", f"from {name}"))
    steps += [
        s.Connect("beside", "out.api", f"back of {names[0]}", "from beside"),
        s.GetPortElement(names[0], "in.api", "circle"),
        s.GetPortElement("beside", "in.api", "beside it"),
        s.Start(),
        s.Invoke("circle", 1, thread="caller"),
        s.Settle("caller"),
        s.Invoke("beside it", 2),
    ]
    return Scenario(components, tuple(steps), _PATIENCE, {"circle": Interface({"pass_on": Method()})}, ("caller",))


def _member(policy: Policy, **plan: tuple[s.Action, ...]) -> Declaration:
    return Declaration(
        ("in.api", "back.api"),
        ("out.api",),
        plan=plan,  # type: ignore[arg-type]
        policies=(policy,),
        ports={"back.api": "circle", "out.api": "circle"},
    )
