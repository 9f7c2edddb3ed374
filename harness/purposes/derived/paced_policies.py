"""Scenarios about policies of 10.5 as such: they are taken, one alone, with each priority (10.5.1); and how components get them."""

from __future__ import annotations

import itertools

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Declaration, Policy, Scenario, Step
from ucm_cts.harness.purposes.scripts import TestPurpose

PORT, OTHER_PORT = "in.api", "aux.api"
_PERIOD = 20
_PRIORITIES = (1, 2, 127, 128, 129, 200, 254, 255)

NAMES = {
    s.PERIODIC_SELF_EXECUTING: "periodic self-executing",
    s.BACKGROUND: "background",
    s.PERIODIC_ACTIVE: "periodic active",
    s.SPORADIC_ACTIVE: "sporadic",
}
_SUPPORT = {
    s.PERIODIC_SELF_EXECUTING: "R-10.5.1-19",
    s.BACKGROUND: "R-10.5.1-20",
    s.PERIODIC_ACTIVE: "R-10.5.1-22",
    s.SPORADIC_ACTIVE: "R-10.5.1-21",
}


def policy(definition: str, period: float = _PERIOD, offset: float = 0, priority: int = 7, port: str = PORT) -> Policy:
    """A policy of 10.5 with these values, in milliseconds; ``port`` is what an active one manages."""
    settings = {s.PRIORITY[definition]: priority}
    for names, milliseconds in ((s.PERIOD, period), (s.OFFSET, offset)):
        if definition in names:
            settings[names[definition]] = round(milliseconds * 1000)
    return Policy(definition, None if s.is_self_executing(definition) else port, settings=settings)


def purposes_about(name: str, requirements: str, *scenarios: tuple[str, Scenario], under: str = "") -> TestPurpose:
    """A purpose of 10.5; ``requirements`` are without their ``R-10.5.``."""
    ids = tuple(f"R-10.5.{one}" for one in requirements.split())
    cases = tuple((f"{name}/{case}", scenario) for case, scenario in scenarios)
    text = f"A component whose execution policy is {name.replace('/', ', ')}."
    return TestPurpose(f"paced/{name}", "10.5", text, ids, cases, under=(under,) if under else ())


def policy_purposes() -> list[TestPurpose]:
    """Each policy alone with each priority, and two at once."""
    purposes = []
    for definition, name in NAMES.items():
        support = _SUPPORT[definition].removeprefix("R-10.5.")
        alone = [(f"priority {n}", _started({"paced": (policy(definition, priority=n),)})) for n in (*_PRIORITIES, 0)]
        purposes.append(purposes_about(f"{name}/alone", f"{support} 1-24", *alone))
        wrong = [(f"priority {n}", _started({"paced": (policy(definition, priority=n),)})) for n in (256, -1)]
        wrong += [
            (f"{parameter} of {value}", _started({"paced": (one,)})) for parameter, value, one in _wrong(definition)
        ]
        checked = "parameter-values-checked=refused"
        purposes.append(purposes_about(f"{name}/out of range", "1-24", *wrong, under=checked))
    pairs = [(f"{NAMES[one]}, {NAMES[other]}", _both(one, other)) for one, other in itertools.combinations(NAMES, 2)]
    cores = (
        (s.SELF_EXECUTING, None),
        (s.ACTIVE, OTHER_PORT),
        (s.PROTECTED_PASSIVE, None),
        (s.UNPROTECTED_PASSIVE, None),
    )
    for definition, name in NAMES.items():
        for core, port in cores:
            pairs.append((f"{name}, {core}", _started({"paced": (policy(definition), Policy(core, port))})))
    for definition in (s.PERIODIC_SELF_EXECUTING, s.BACKGROUND):
        twice = (policy(definition), policy(definition, priority=8))
        pairs.append((f"{NAMES[definition]} twice", _started({"paced": twice})))
    purposes.append(purposes_about("two of them", "1-23", *pairs))
    return purposes


def _wrong(definition: str) -> list[tuple[str, int, Policy]]:
    """A period of zero, and times below zero. A least distance of zero is no limit."""
    found = []
    for names, values in ((s.PERIOD, (0, -1)), (s.OFFSET, (-1,))):
        if definition in names:
            for value in values if definition != s.SPORADIC_ACTIVE else values[1:]:
                right = policy(definition)
                settings = {**right.settings, names[definition]: value}
                found.append((names[definition], value, Policy(definition, right.port, settings=settings)))
    return found


def _both(one: str, other: str) -> Scenario:
    return _started({"paced": (policy(one), policy(other, port=OTHER_PORT))})


def _started(components: dict[str, tuple[Policy, ...]]) -> Scenario:
    declared = {name: Declaration((PORT, OTHER_PORT), policies=policies) for name, policies in components.items()}
    steps: list[Step] = [s.AddComponent(name) for name in components]
    return Scenario(declared, (*steps, s.Start(), s.Stop(), s.GetComponents()))
