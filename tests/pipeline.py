"""Runs the whole suite on a Python adapter in this process: what most tests of rules need."""

from __future__ import annotations

import functools

from ucm_cts.adapters.contract.adapter import Adapter
from ucm_cts.adapters.contract.messages import Run, Traced, encode, from_host_decoder
from ucm_cts.adapters.python.engine import Engine
from ucm_cts.harness.catalogue import load_life_cycle
from ucm_cts.harness.disguise import Disguise
from ucm_cts.harness.integrity import contradiction
from ucm_cts.harness.purposes import load_purposes
from ucm_cts.reference_models.judgement import Judge
from ucm_cts.reference_models.ledger import Ledger


@functools.cache
def _prepared() -> tuple[tuple[str, object, bytes], ...]:
    disguise = Disguise(1, "{port}_{element}")
    scenarios = [(name, disguise.scenario(x)) for p in load_purposes("container") for name, x in p.scenarios]
    return tuple((name, scenario, encode(Run(0, scenario))) for name, scenario in scenarios)


def ledgers(adapter: type[Adapter]) -> list[tuple[str, Ledger]]:
    """What the judge says of every scenario of the suite, run on ``adapter``."""
    engine = Engine(adapter)
    judge = Judge(load_life_cycle())
    said = []
    for name, scenario, line in _prepared():
        answer = from_host_decoder().decode(engine.answer(line))
        assert isinstance(answer, Traced), (name, answer)
        problem = contradiction(scenario, answer.events, bool(answer.stuck))  # type: ignore[arg-type]
        assert problem is None, (name, problem)
        said.append((name, judge.judge(scenario, answer.events)))  # type: ignore[arg-type]
    return said


def failing_requirements(adapter: type[Adapter]) -> dict[str, str]:
    """Failing requirements, each with an example: scenario, expected, observed."""
    failing: dict[str, str] = {}
    for name, ledger in ledgers(adapter):
        for f in ledger.findings:
            failing.setdefault(f.requirement, f"{name}: expected {f.expected}; observed {f.observed}")
    return failing
