"""Runs a sample of scenarios through one endpoint and judges the traces."""

from __future__ import annotations

import functools
import multiprocessing
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass

from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.adapters.contract.trace import Trace
from ucm_cts.harness.catalogue.requirements import load_life_cycle
from ucm_cts.harness.execution.driver import Driver
from ucm_cts.harness.hosting.locate import locate
from ucm_cts.harness.purposes.scripts import load_scripts
from ucm_cts.harness.purposes.selection import load_purposes
from ucm_cts.reference_models.monitor import Monitor

GENERATED = 60


@dataclass(frozen=True)
class Seen:
    """What came through an endpoint; what was exercised is counted where no threads run a race."""

    traces: dict[str, Trace]
    exercised: Counter[str]
    broken: dict[str, list[str]]


@functools.cache
def sample() -> tuple[tuple[str, Scenario], ...]:
    """Every script, and generated scenarios from all over the life cycle."""
    purposes = load_purposes("container")
    scripts = len(load_scripts())
    generated = [case for purpose in purposes[scripts:] for case in purpose.scenarios]
    return (
        *(case for purpose in purposes[:scripts] for case in purpose.scenarios),
        *generated[:: len(generated) // GENERATED],
    )


@functools.cache
def through(endpoint: str, in_process: bool = False) -> Seen:
    """The sample run and judged, each endpoint with the same names and payloads."""
    monitor = Monitor(load_life_cycle())
    seen = Seen({}, Counter(), {})
    with Driver(locate(endpoint, in_process), seed=9) as driver:
        for answer in driver.run(sample()):
            assert answer.incident is None, (answer.name, answer.incident)
            verdicts = monitor.judge(answer.disguised, answer.trace)
            seen.traces[answer.name] = answer.trace
            if not any(step.thread for step in answer.disguised.steps):
                seen.exercised.update(verdicts.exercises)
            if verdicts.findings:
                seen.broken[answer.name] = sorted(f.requirement for f in verdicts.findings)
    assert len(seen.traces) == len(sample())
    return seen


def in_a_process_of_its_own(endpoint: str) -> Seen:
    """``through`` with the framework inside the harness process, which is a new one: it may hang or crash alone."""
    with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as pool:
        return pool.submit(through, endpoint, True).result()
