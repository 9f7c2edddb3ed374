"""Scenarios in which components make the calls that the test makes in others.

They are for vendors whose references are not guarded when the test itself calls them (``raw-references = unprotected``).
"""

from __future__ import annotations

import dataclasses

import msgspec

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import CallPort, Declaration, Policy, Scenario, Step
from ucm_cts.harness.purposes.scripts import TestPurpose

_IN, _OUT = "in.api", "out.api"
UNDER = "raw-references=unprotected"


def through_components(purpose: TestPurpose) -> TestPurpose:
    """The same purpose with a component for each value that the test passes to a reference: told so, it calls the reference with that value."""
    called = [
        (n, scenario) for n, scenario in purpose.scenarios if any(isinstance(o, s.Invoke) for o in scenario.steps)
    ]
    cases = tuple((f"{name}, called by components", _relayed(scenario)) for name, scenario in called)
    name = f"{purpose.id}, called by components"
    return dataclasses.replace(purpose, id=name, scenarios=cases, under=(*purpose.under, UNDER))


def _relayed(scenario: Scenario) -> Scenario:
    """The components and their connections are made before the first start, in the manager. So ``scenario`` has all components whose references
    are called then, and needs references for nothing else.
    """
    given = {step.bind or "": step for step in scenario.steps if isinstance(step, s.GetPortElement)}
    values = dict.fromkeys((step.ref, step.value) for step in scenario.steps if isinstance(step, s.Invoke))
    steps: list[Step] = []
    is_made = False
    for step in scenario.steps:
        if isinstance(step, s.Start) and not is_made:
            is_made = True
            steps += (_goal(given[ref]) for ref in dict.fromkeys(ref for ref, _ in values))
            for ref, value in values:
                steps += _made(ref, value)
        if isinstance(step, s.Invoke):
            steps.append(msgspec.structs.replace(step, ref=_told(step.ref, step.value)))
        elif not isinstance(step, s.GetPortElement):
            steps.append(step)
    callers = {_caller(ref, value): _declaration(value) for ref, value in values}
    return msgspec.structs.replace(scenario, components=scenario.components | callers, steps=tuple(steps))


def _goal(step: s.GetPortElement) -> Step:
    return msgspec.structs.replace(step, bind=f"goal {step.bind}")


def _made(ref: str, value: int) -> tuple[Step, ...]:
    name = _caller(ref, value)
    return (
        s.AddComponent(name),
        s.Connect(name, _OUT, f"goal {ref}", f"line of {name}"),
        s.GetPortElement(name, _IN, _told(ref, value)),
    )


def _declaration(value: int) -> Declaration:
    unprotected = (Policy(s.UNPROTECTED_PASSIVE),)
    return Declaration((_IN,), (_OUT,), policies=unprotected, plan={"exchange": (CallPort(_OUT, value),)})


def _caller(ref: str, value: int) -> str:
    return f"caller {value} of {ref}"


def _told(ref: str, value: int) -> str:
    return f"{ref} {value}"
