"""Execution policies (10.1.3): gate schedules prove exclusion, and a framework without it fails each time."""

from __future__ import annotations

import functools
from collections import Counter

import msgspec
import pytest

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.trace import Enter, Exit, Settled
from ucm_cts.harness.catalogue.requirements import load_life_cycle
from ucm_cts.harness.execution.driver import Driver
from ucm_cts.harness.hosting.locate import locate
from ucm_cts.harness.purposes.derived.schedules import overlap_purposes
from ucm_cts.harness.purposes.selection import load_purposes
from ucm_cts.reference_models.monitor import Monitor

pytestmark = [pytest.mark.native, pytest.mark.usefixtures("here")]

EXCLUSION = {f"R-10.1.3.2-{number}" for number in ("06", "09", "10", "13", "16")}


@functools.cache
def judged(adapter: str, times: int = 1) -> tuple[Counter[str], dict[str, set[str]]]:
    """What ``times`` runs of all schedules exercised, and the scenarios that broke each requirement."""
    monitor = Monitor(load_life_cycle())
    exercised: Counter[str] = Counter()
    broken: dict[str, set[str]] = {}
    alone = [p for p in load_purposes("core") if p.id in ("self-executing/alone", "two execution policies")]
    cases = [case for purpose in (*overlap_purposes(), *alone) if not purpose.under for case in purpose.scenarios]
    for seed in range(times):
        with Driver(locate(adapter), seed=seed) as driver:
            for answer in driver.run(cases):
                assert answer.incident is None, (answer.name, answer.incident)
                verdicts = monitor.judge(answer.disguised, answer.trace)
                exercised.update(verdicts.exercises)
                for finding in verdicts.findings:
                    broken.setdefault(finding.requirement, set()).add(answer.name)
    return exercised, broken


@pytest.mark.parametrize("adapter", ["reference-py", "reference-cpp"])
def test_reference_framework_keeps_callers_apart_and_that_is_proved(adapter: str) -> None:
    exercised, broken = judged(adapter, 2)
    assert broken == {}
    assert set(exercised) >= EXCLUSION | {"R-10.1.3-03", "R-10.1.3.2-05", "R-10.1.3.2-17", "R-10.1.3.2-20"}


def test_every_schedule_proves_something() -> None:
    monitor = Monitor(load_life_cycle())
    wanted = EXCLUSION | {"R-10.1.3-03", "R-10.1.3.2-05", "R-10.1.3.2-20"}
    with Driver(locate("reference-py"), seed=1) as driver:
        for purpose in (p for p in overlap_purposes() if not p.under):
            for answer in driver.run(purpose.scenarios):
                assert wanted & monitor.judge(answer.disguised, answer.trace).exercises.keys(), answer.name


@pytest.mark.parametrize("seen", [None, "another", "done"])
def test_worker_not_seen_waiting_is_undecided(seen: str | None) -> None:
    monitor = Monitor(load_life_cycle())
    called = [p for p in overlap_purposes() if p.id.startswith("protected") and not p.id.endswith("/messages")]
    cases = [case for purpose in called for case in purpose.scenarios]
    with Driver(locate("reference-py"), seed=1) as driver:
        for answer in driver.run(cases):
            trace = answer.trace
            assert EXCLUSION & monitor.judge(answer.disguised, trace).exercises.keys(), answer.name
            changes = {"worker": "nobody"} if seen == "another" else {"where": "done"}
            doubtful = [
                msgspec.structs.replace(event, **changes) if isinstance(event, Settled) else event
                for event in trace
                if seen is not None or not isinstance(event, Settled)
            ]
            assert not EXCLUSION & monitor.judge(answer.disguised, tuple(doubtful)).exercises.keys(), answer.name


def test_pending_method_call_leads_to_no_exchange_of_another_thread() -> None:
    """A call of a method has no number of its own, and 0 is a payload, too."""
    (circle,) = (p for p in load_purposes("core") if p.id == "circle/active")
    name, scenario = circle.scenarios[1]
    *before, called, settled, beside = scenario.steps
    first, second = (msgspec.structs.replace(beside, value=value) for value in (5, 0))
    steps: tuple[s.Step, ...] = (*before, first, called, settled, second)
    with Driver(locate("reference-py"), seed=1) as driver:
        (answer,) = driver.run([(name, msgspec.structs.replace(scenario, steps=steps))])
    trace = [
        msgspec.structs.replace(event, thread=99)
        if isinstance(event, Enter | Exit) and event.component == "beside" and event.hook == "exchange"
        else event
        for event in answer.trace
    ]
    (value,) = {step.value for step in answer.disguised.steps[-1:] if isinstance(step, s.Invoke)}
    assert value == 0
    assert Monitor(load_life_cycle()).judge(answer.disguised, trace).findings == []
