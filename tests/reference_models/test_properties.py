"""Properties are pure: a trace has the same verdicts in every order of checks."""

from __future__ import annotations

import ast
import random
import re
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import pytest

from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.adapters.contract.trace import Trace
from ucm_cts.adapters.mutants.python.subjects import CONTAINER, POLICIES, mutants_of
from ucm_cts.harness.catalogue.requirements import load_life_cycle
from ucm_cts.harness.execution.driver import Driver, Limits
from ucm_cts.harness.hosting.locate import locate
from ucm_cts.harness.purposes.selection import load_purposes
from ucm_cts.reference_models.monitor import Monitor
from ucm_cts.reference_models.properties import table
from ucm_cts.reference_models.properties.table import PROPERTIES

SCENARIOS, MUTANTS = 6, 8
PROPERTY_MODULES = Path(table.__file__).parent
MODELS = PROPERTY_MODULES.parent
SHOWING = 3
"""So many purposes more concern what the mutant breaks."""

REQUIREMENT = re.compile(r"R-[\d.]+-\d+")


@pytest.fixture(scope="module")
def traces() -> list[tuple[Scenario, Trace]]:
    """What some mutants do in scenarios for container and policies."""
    chosen = random.Random(1)
    found = []
    for clauses, profile in ((CONTAINER, "container"), (POLICIES, "core")):
        purposes = [p for p in load_purposes(profile) if p.clause.startswith(clauses)]
        for name in chosen.sample(sorted(mutants_of(clauses)), MUTANTS):
            sample = chosen.sample(purposes, min(SCENARIOS, len(purposes)))
            broken = mutants_of(clauses)[name].requirements[0]
            sample += [purpose for purpose in purposes if broken in purpose.requirements][:SHOWING]
            with Driver(locate(f"ucm_cts.adapters.mutants.python:{name}"), 1, Limits(seconds=1)) as driver:
                answers = driver.run(purpose.scenarios[0] for purpose in sample)
                found += [(a.disguised, a.trace) for a in answers if a.incident is None]
    return found


@pytest.fixture
def in_their_order() -> Iterator[None]:
    usual = dict(PROPERTIES)
    yield
    PROPERTIES.clear()
    PROPERTIES.update(usual)


def verdicts_on(traces: list[tuple[Scenario, Trace]]) -> list[object]:
    monitor = Monitor(load_life_cycle())
    found = [monitor.judge(scenario, trace) for scenario, trace in traces]
    return [(Counter(v.findings), v.exercises, v.readings, v.measures, v.rows) for v in found]


@pytest.mark.usefixtures("in_their_order")
def test_the_order_of_properties_does_not_matter(traces: list[tuple[Scenario, Trace]]) -> None:
    expected = verdicts_on(traces)
    assert sum(bool(findings) for findings, *_ in expected) > 2
    for seed in range(3):
        shuffled = list(PROPERTIES.items())
        random.Random(seed).shuffle(shuffled)
        PROPERTIES.clear()
        PROPERTIES.update(shuffled)
        assert verdicts_on(traces) == expected, f"seed {seed}"


def test_properties_write_nothing() -> None:
    """No property assigns to an attribute or an element: what follows from a finding is a conclusion."""
    modules = [*PROPERTY_MODULES.glob("clause_*.py"), PROPERTY_MODULES / "declared_choices.py"]
    assert len(modules) > 10
    for path in modules:
        for node in ast.walk(ast.parse(path.read_text())):
            if isinstance(node, ast.Assign | ast.AugAssign | ast.AnnAssign):
                targets = node.targets if isinstance(node, ast.Assign) else [node.target]
                written = [t for t in targets if isinstance(t, ast.Attribute | ast.Subscript)]
                assert not written, f"{path.name}:{node.lineno} writes {ast.unparse(written[0])}"


@pytest.mark.parametrize(
    "path", [*MODELS.glob("model/*.py"), *MODELS.glob("properties/*.py")], ids=lambda path: path.stem
)
def test_each_requirement_id_is_typed_once_in_a_module(path: Path) -> None:
    """An id that a module needs more than once is bound to a constant."""
    texts = [node.value for node in ast.walk(ast.parse(path.read_text())) if isinstance(node, ast.Constant)]
    typed = Counter(found for text in texts if isinstance(text, str) for found in REQUIREMENT.findall(text))
    assert not [requirement for requirement, times in typed.items() if times > 1]
