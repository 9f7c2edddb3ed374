"""What a variable holds when a step begins counts, whatever later steps bind it to."""

from __future__ import annotations

import random
from collections import Counter
from collections.abc import Iterator, Sequence

import msgspec
import pytest
from performing import gist

from ucm_cts.adapters.contract import trace as t
from ucm_cts.adapters.contract.scenario import Scenario, Step
from ucm_cts.adapters.contract.traits import Binds, Uses, bound_by, fields
from ucm_cts.harness.catalogue.requirements import load_life_cycle
from ucm_cts.harness.execution.driver import Driver
from ucm_cts.harness.exploring.core_writer import CoreWriter
from ucm_cts.harness.exploring.extension_writer import WRITTEN_PARTS, extension_scenario
from ucm_cts.harness.hosting.locate import locate
from ucm_cts.harness.statement.files import stated_by
from ucm_cts.reference_models.findings import Finding
from ucm_cts.reference_models.model.ics import Ics
from ucm_cts.reference_models.monitor import Monitor

SUBJECTS = (
    "reference-py",
    "ucm_cts.adapters.mutants.python:coalesces_notifications",
    "ucm_cts.adapters.mutants.python:does_not_cancel",
)
DRAWN = 20


@pytest.mark.parametrize("subject", SUBJECTS)
def test_findings_do_not_depend_on_variables_that_are_bound_anew(subject: str) -> None:
    choosing = random.Random(subject)
    drawn = [with_bindings_repeated(drawn_scenario(choosing), choosing) for _ in range(DRAWN)]
    differing = 0
    for scenario, trace in performed(subject, drawn):
        apart, told = with_variables_apart(scenario, trace)
        differing += apart != scenario
        assert Counter(gist(judged(scenario, trace))) == Counter(gist(judged(apart, told)))
    assert differing > DRAWN // 2


def performed(subject: str, scenarios: Sequence[Scenario]) -> Iterator[tuple[Scenario, t.Trace]]:
    with Driver(locate(subject, virtual_time=True), 1) as driver:
        for answer in driver.run(("drawn", scenario) for scenario in scenarios):
            if answer.incident is None:
                yield answer.disguised, answer.trace


def judged(scenario: Scenario, trace: t.Trace) -> Sequence[Finding]:
    return Monitor(load_life_cycle(), Ics(stated_by(None, "reference-py").readings)).judge(scenario, trace).findings


def drawn_scenario(choosing: random.Random) -> Scenario:
    part = choosing.choice((*WRITTEN_PARTS, ""))
    return extension_scenario(part, choosing.choice) if part else CoreWriter(choosing.choice).scenario()


def with_bindings_repeated(scenario: Scenario, choosing: random.Random) -> Scenario:
    """Two steps that bind variables come once more, later, on the thread of the scenario."""
    steps = list(scenario.steps)
    for _ in range(2):
        which = choosing.choice([number for number, step in enumerate(steps) if bound_by(step)])
        steps.insert(choosing.randint(which + 1, len(steps)), msgspec.structs.replace(steps[which], thread=None))
    return msgspec.structs.replace(scenario, steps=tuple(steps))


def with_variables_apart(scenario: Scenario, trace: t.Trace) -> tuple[Scenario, t.Trace]:
    """The same scenario and trace with a variable of its own for each step that binds one again."""
    steps = list(scenario.steps)
    now: dict[str, str] = {}
    bound: Counter[str] = Counter()
    told: list[t.Event] = []

    def use(number: int) -> None:
        for field, trait in fields(type(steps[number])):
            if isinstance(trait, Uses):
                value = getattr(steps[number], field)
                others = now.get(value, value) if isinstance(value, str) else tuple(now.get(one, one) for one in value)
                steps[number] = msgspec.structs.replace(steps[number], **{field: others})

    def bind(step: Step) -> Step:
        for field, trait in fields(type(step)):
            (name,) = bound_by(step) if isinstance(trait, Binds) else ("",)
            if name and bound[name]:
                step = msgspec.structs.replace(step, **{field: f"{name} {bound[name]}"})
            bound[name] += 1
        return step

    for event in trace:
        if isinstance(event, t.Call):
            use(event.step)
            steps[event.step] = bind(steps[event.step])
        elif isinstance(event, t.Return):
            now |= zip(bound_by(scenario.steps[event.step]), bound_by(steps[event.step]), strict=True)
        elif isinstance(event, t.Skip | t.Stressed):
            use(event.step)
            if isinstance(event, t.Skip):
                event = msgspec.structs.replace(event, variable=now.get(event.variable, event.variable))
        told.append(event)
    return msgspec.structs.replace(scenario, steps=tuple(steps)), tuple(told)
