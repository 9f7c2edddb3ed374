"""Runs the whole suite on a Python adapter in this process: what most tests of rules need."""

from __future__ import annotations

import functools
import re

from ucm_cts.adapters.contract.adapter import Adapter
from ucm_cts.adapters.contract.messages import Run, Traced, encode, from_host_decoder
from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.adapters.python.engine import Engine
from ucm_cts.harness.catalogue import load_life_cycle
from ucm_cts.harness.disguise import Disguise
from ucm_cts.harness.integrity import contradiction
from ucm_cts.harness.payloads import Payloads
from ucm_cts.harness.purposes import load_purposes
from ucm_cts.reference_models.findings import Finding
from ucm_cts.reference_models.judgement import Judge

_TIME = re.compile(rb'"t":\d+')


_known: dict[tuple[bytes, bytes], tuple[Finding, ...]] = {}
"""Same trace, same findings: what many subjects do alike, but for the time it took, is judged once."""


def failing_requirements(adapter: type[Adapter]) -> dict[str, str]:
    """Failing requirements, each with an example: scenario, expected, observed."""
    engine = Engine(adapter)
    failing: dict[str, str] = {}
    for line, (name, scenario) in _prepared().items():
        answer = engine.answer(line)
        key = line, _TIME.sub(b"", answer)
        if key not in _known:
            _known[key] = _findings(name, scenario, answer)
        for f in _known[key]:
            failing.setdefault(f.requirement, f"{name}: expected {f.expected}; observed {f.observed}")
    return failing


@functools.cache
def _prepared() -> dict[bytes, tuple[str, Scenario]]:
    """The suite's scenarios by what a host is sent; those that several test purposes share are there once."""
    disguise, payloads = Disguise(1, "{port}_{element}"), Payloads(1)
    prepared: dict[bytes, tuple[str, Scenario]] = {}
    for purpose in load_purposes("container"):
        for name, plain in purpose.scenarios:
            scenario = disguise.scenario(payloads.deal(plain))
            prepared.setdefault(encode(Run(0, scenario)), (name, scenario))
    return prepared


def _findings(name: str, scenario: Scenario, answer: bytes) -> tuple[Finding, ...]:
    traced = from_host_decoder().decode(answer)
    assert isinstance(traced, Traced), (name, traced)
    problem = contradiction(scenario, traced.events, bool(traced.stuck))
    assert problem is None, (name, problem)
    return tuple(_judge().judge(scenario, traced.events).findings)


@functools.cache
def _judge() -> Judge:
    return Judge(load_life_cycle())
