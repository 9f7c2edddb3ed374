"""Random scenarios: conformant frameworks do not fail, and every trace can be judged."""

from __future__ import annotations

import itertools
import random
from collections.abc import Iterator, Sequence
from functools import cache
from pathlib import Path

import msgspec
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from performing import gist

from ucm_cts.adapters.contract.adapter import Adapter
from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.adapters.contract.trace import Event, Trace
from ucm_cts.adapters.mutants.python.subjects import CONTAINER, CORE, POLICIES, Variant, mutants_of, variants_of
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter
from ucm_cts.adapters.sdk.python.engine import ContractBroken, Performance
from ucm_cts.adapters.sdk.python.recorder import Recorder
from ucm_cts.harness.catalogue.requirements import load_life_cycle, load_requirements
from ucm_cts.harness.execution.confirmation import is_timed
from ucm_cts.harness.execution.disguise import Disguise
from ucm_cts.harness.execution.integrity import contradiction
from ucm_cts.harness.exploring.core_writer import CoreWriter
from ucm_cts.harness.exploring.writer import scenarios
from ucm_cts.harness.purposes.scripts import read_scripts, to_scenario
from ucm_cts.harness.results.statement import Statement, default_statement
from ucm_cts.harness.statement.applicability import fitting
from ucm_cts.reference_models.model.ics import Ics
from ucm_cts.reference_models.monitor import Monitor

pytestmark = pytest.mark.slow

WAITING = ("calls_wait_for_the_start", "starts_all_at_a_time")
"""Variants that may wait for ever where a scenario calls too early or a body raises."""

CONFORMANT: dict[str, type[Adapter]] = {"reference": ReferenceAdapter}
CONFORMANT |= {name: variant.adapter for name, variant in variants_of(CONTAINER).items()}
for waiting in WAITING:
    CONFORMANT.pop(waiting, None)
CORE_VARIANTS = variants_of((*POLICIES, *CORE))
WRONG = [mutant.adapter for mutant in mutants_of(CONTAINER).values()]
SOME = 20
"""One of so many wrong subjects takes part in each example."""

TESTABLE = {requirement.id for requirement in load_requirements() if requirement.rules}
ONCE_FAILED = {script.scenario: script for script in read_scripts(Path(__file__).parent / "once_failed.yaml")}

Mutation = tuple[str, int, int]
MUTATIONS = st.lists(
    st.tuples(st.sampled_from(("drop", "repeat", "swap", "copy")), st.integers(0, 99), st.integers(0, 99)),
    min_size=1,
    max_size=4,
)


def examples(number: int) -> settings:
    """The same examples each time; nothing is kept, and slow machines are no failures."""
    return settings(
        max_examples=number, derandomize=True, database=None, deadline=None, suppress_health_check=list(HealthCheck)
    )


@cache
def the_monitor() -> Monitor:
    return Monitor(load_life_cycle())


@cache
def monitor_of(variant: str) -> Monitor:
    """One that knows what the vendor of ``variant`` declares."""
    declared = variants_of(CONTAINER)[variant].readings if variant in variants_of(CONTAINER) else {}
    return Monitor(load_life_cycle(), Ics(dict(declared))) if declared else the_monitor()


def perform(adapter: type[Adapter], scenario: Scenario) -> tuple[Trace, Sequence[str]]:
    """What happens, and the workers that never came back."""
    performance = Performance(adapter(), scenario, Recorder())
    return performance.run()


def traces_of_wrong_subjects(scenario: Scenario, first: int) -> Iterator[tuple[Trace, Sequence[str]]]:
    for adapter in WRONG[first::SOME]:
        try:
            yield perform(adapter, scenario)
        except ContractBroken:
            continue


def assert_nobody_fails(scenario: Scenario) -> None:
    judged: set[tuple[Monitor, bytes]] = set()
    for name, adapter in CONFORMANT.items():
        trace, stuck = perform(adapter, scenario)
        timeless = msgspec.json.encode([msgspec.structs.replace(event, t=0) for event in trace])
        monitor = monitor_of(name)
        if (monitor, timeless) in judged:
            continue
        judged.add((monitor, timeless))
        assert contradiction(scenario, trace, stuck) is None, name
        findings = monitor.judge(scenario, trace).findings
        assert not findings, (name, findings, timeless)


@examples(150)
@given(scenarios())
def test_no_conformant_variant_is_ever_failed(scenario: Scenario) -> None:
    assert_nobody_fails(scenario)


def statement_of(variant: Variant) -> Statement:
    """What the vendor of a variant of core states."""
    usual = default_statement()
    return msgspec.structs.replace(usual, readings=usual.readings | variant.readings)


def assert_core_variant_passes(variant: Variant, stated: Statement, scenario: Scenario) -> None:
    """Findings that depend on time are left out here; a run confirms them."""
    trace, stuck = perform(variant.adapter, scenario)
    assert contradiction(scenario, trace, stuck) is None, variant.name
    findings = Monitor(load_life_cycle(), stated.ics).judge(scenario, trace).findings
    assert [finding for finding in findings if not is_timed(finding)] == [], variant.name


@pytest.mark.parametrize("name", CORE_VARIANTS)
def test_variants_of_core_do_not_fail_for_connectors(name: str) -> None:
    stated = statement_of(CORE_VARIANTS[name])
    writing = random.Random(name)
    drawn = (CoreWriter(writing.choice).scenario() for _ in itertools.count())
    fit = (one for scenario in drawn for _, one in fitting([("", scenario)], stated))
    for scenario in itertools.islice(fit, 4):
        assert_core_variant_passes(CORE_VARIANTS[name], stated, scenario)


@pytest.mark.parametrize("name", ONCE_FAILED)
def test_conformant_variants_once_failed_are_failed_no_more(name: str) -> None:
    scenario = to_scenario(ONCE_FAILED[name])
    assert_nobody_fails(scenario)
    for variant in CORE_VARIANTS.values() if scenario.interfaces else ():
        stated = statement_of(variant)
        for _, fit in fitting([(name, scenario)], stated):
            assert_core_variant_passes(variant, stated, fit)


@examples(200)
@given(scenarios(), st.integers(0, SOME - 1))
def test_findings_about_wrong_subjects_name_existing_events(scenario: Scenario, first: int) -> None:
    for trace, _ in traces_of_wrong_subjects(scenario, first):
        for finding in the_monitor().judge(scenario, trace).findings:
            assert finding.requirement in TESTABLE
            assert set(finding.events) <= {event.n for event in trace}
            assert finding.events
            assert finding.step is None or 0 <= finding.step < len(scenario.steps)
            assert finding.expected
            assert finding.observed


@examples(200)
@given(scenarios(), st.integers(0, SOME - 1), MUTATIONS, st.booleans())
def test_a_changed_trace_is_refused_or_judged(
    scenario: Scenario, first: int, mutations: Sequence[Mutation], stuck: bool
) -> None:
    workers = {step.thread for step in scenario.steps if step.thread is not None} if stuck else ()
    for trace, _ in traces_of_wrong_subjects(scenario, first):
        changed = mutated(trace, mutations)
        if contradiction(scenario, changed, workers) is None:
            the_monitor().judge(scenario, changed)


@examples(100)
@given(scenarios(), st.integers(0, SOME - 1), st.integers(0, 2**32))
def test_findings_depend_on_the_trace_alone_and_not_on_names(scenario: Scenario, first: int, seed: int) -> None:
    disguise = Disguise(seed, "{port}_{element}")
    disguised = disguise.scenario(scenario)
    for trace, _ in traces_of_wrong_subjects(disguised, first):
        findings = the_monitor().judge(disguised, trace).findings
        assert the_monitor().judge(disguised, trace).findings == findings
        assert Monitor(load_life_cycle()).judge(disguised, trace).findings == findings
        revealed = tuple(disguise.reveal(event) for event in trace)
        assert gist(the_monitor().judge(scenario, revealed).findings) == gist(findings)


def mutated(trace: Trace, mutations: Sequence[Mutation]) -> Trace:
    """The trace with events left out, repeated, swapped, or with something of another event; counted anew."""
    events = list(trace)
    for what, here, there in mutations:
        if not events:
            break
        i, j = here % len(events), there % len(events)
        if what == "drop":
            del events[i]
        elif what == "repeat":
            events.insert(j, events[i])
        elif what == "swap":
            events[i], events[j] = events[j], events[i]
        else:
            events[i] = mixed(events[i], events[j], here + there)
    return tuple(msgspec.structs.replace(event, n=index + 1, t=index) for index, event in enumerate(events))


def mixed(event: Event, other: Event, which: int) -> Event:
    """``event`` with one field of ``other``, if the wire could carry that."""
    fields = [f for f in event.__struct_fields__ if f in other.__struct_fields__]
    field = fields[which % len(fields)]
    change = msgspec.structs.replace(event, **{field: getattr(other, field)})
    try:
        return msgspec.json.decode(msgspec.json.encode(change), type=type(event))
    except msgspec.ValidationError:
        return event
