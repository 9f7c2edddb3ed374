"""Stress finds rare overlaps in protected components; circles of calls are observed (10.1.3.2)."""

from __future__ import annotations

import functools
import itertools
import threading
from collections.abc import Callable
from typing import TypeVar

import msgspec
import pytest
from performing import answer

from ucm_cts.adapters.contract.messages import Traced
from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.adapters.contract.trace import Stressed, Trace
from ucm_cts.adapters.mutants.python.registry import Base, bind
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter
from ucm_cts.adapters.reference.python.members import Member
from ucm_cts.harness.catalogue.requirements import load_life_cycle
from ucm_cts.harness.execution.integrity import contradiction
from ucm_cts.harness.purposes.scripts import TestPurpose, load_scripts, to_scenario
from ucm_cts.harness.purposes.tables import purposes_of
from ucm_cts.reference_models.model.ics import Ics
from ucm_cts.reference_models.monitor import Monitor
from ucm_cts.reference_models.verdicts import Verdicts

pytestmark = pytest.mark.slow

T = TypeVar("T")


def played(asked: Scenario, adapter: type[ReferenceAdapter]) -> Trace:
    reply = answer(asked, adapter)
    assert isinstance(reply, Traced), reply
    assert contradiction(asked, reply.events, reply.stuck) is None
    assert set(reply.stuck) <= set(asked.may_stay)
    return reply.events


def judged(
    purposes: list[TestPurpose], adapter: type[ReferenceAdapter], claims: dict[str, str] | None = None
) -> dict[str, Verdicts]:
    monitor = Monitor(load_life_cycle(), Ics(claims or {}))
    cases = [case for purpose in purposes for case in purpose.scenarios]
    return {name: monitor.judge(asked, played(asked, adapter)) for name, asked in cases}


class leaves_the_lock_out(Base):
    """One of a hundred executions is not protected."""

    executions = itertools.count(1)

    def _execute_alone(self, member: Member, port: str | None, work: Callable[[], T]) -> T:
        if next(self.executions) % 100 == 0:
            return work()
        return super()._execute_alone(member, port, work)


class checks_and_then_enters(Base):
    """Whether somebody is inside is looked up, and set afterwards."""

    def _execute_alone(self, member: Member, port: str | None, work: Callable[[], T]) -> T:
        while member.__dict__.get("occupied"):
            pass
        member.__dict__["occupied"] = True
        try:
            return work()
        finally:
            member.__dict__["occupied"] = False


def policy_purposes(prefix: str) -> list[TestPurpose]:
    return [purpose for purpose in purposes_of("execution_policies") if purpose.id.startswith(prefix)]


def test_reference_framework_withstands_stress() -> None:
    by_case = judged(policy_purposes("stress/"), ReferenceAdapter)
    assert not [finding for verdicts in by_case.values() for finding in verdicts.findings]


@pytest.mark.parametrize("mixin", [leaves_the_lock_out, checks_and_then_enters])
def test_framework_with_a_tiny_hole_is_found_out(mixin: type) -> None:
    adapter = bind(mixin.__name__, mixin)
    purposes = [p for p in policy_purposes("stress/") if p.id == "stress/protected passive, two ports"]
    found = [judged(purposes, adapter) for _ in range(20)]
    broken = {f.requirement for by_case in found for verdicts in by_case.values() for f in verdicts.findings}
    assert broken == {"R-10.1.3.2-16"}


@functools.cache
def stressed() -> tuple[Scenario, Trace]:
    (purpose,) = [p for p in policy_purposes("stress/") if p.id == "stress/protected passive, one port"]
    ((_, asked),) = purpose.scenarios
    return asked, played(asked, ReferenceAdapter)


@pytest.mark.parametrize(
    ("counted", "exercised"),
    [({"overlaps": 0, "control_overlaps": 3}, True), ({"overlaps": 0, "control_overlaps": 0}, False)],
)
def test_stress_without_overlaps_of_the_unprotected_body_is_undecided(counted: dict[str, int], exercised: bool) -> None:
    asked, trace = stressed()
    reported = tuple(msgspec.structs.replace(e, **counted) if isinstance(e, Stressed) else e for e in trace)
    verdicts = Monitor(load_life_cycle()).judge(asked, reported)
    assert ("R-10.1.3.2-13" in verdicts.exercises) == exercised
    assert not verdicts.findings


class refuses_to_come_round(Base):
    """Calls that come back to a protected component are refused."""

    def _execute(self, member: Member, port: str | None, work: Callable[[], T]) -> T:
        if member.execution.is_inside:
            raise RuntimeError("the component waits for this very call")
        return super()._execute(member, port, work)


class waits_for_itself(Base):
    """Calls that come back to a protected component wait for it."""

    def _execute_alone(self, member: Member, port: str | None, work: Callable[[], T]) -> T:
        with member.__dict__.setdefault("plain lock", threading.Lock()):
            return work()


CIRCLES = {"enter": ReferenceAdapter} | {
    reading: bind(mixin.__name__, mixin)
    for reading, mixin in (("refuse", refuses_to_come_round), ("wait", waits_for_itself))
}


@pytest.mark.parametrize(("reading", "adapter"), CIRCLES.items())
def test_circle_is_observed_and_fails_only_if_declared_otherwise(reading: str, adapter: type[ReferenceAdapter]) -> None:
    passive = [p for p in policy_purposes("circle/") if p.id == "circle/protected passive"]
    for name, verdicts in judged(passive, adapter).items():
        assert verdicts.readings["protected-recursion"] == {reading}, name
        assert not verdicts.findings
        assert "R-10.1.3.2-15" in verdicts.exercises, "the component beside the circle is served"
    for other in CIRCLES.keys() - {reading}:
        for verdicts in judged(passive, adapter, {"protected-recursion": other}).values():
            assert {f.requirement for f in verdicts.findings} <= {"R-10.1.3.2-13", "R-10.1.3.2-16"}
            assert verdicts.findings


@pytest.mark.parametrize(("declared", "kept"), [("observed", True), ("default", True), ("refuse", False)])
def test_component_without_execution_policy_fares_as_declared(declared: str, kept: bool) -> None:
    (script,) = [script for script in load_scripts() if script.scenario == "without-execution-policy"]
    asked = to_scenario(script)
    verdicts = Monitor(load_life_cycle(), Ics({"missing-execution-policy": declared})).judge(
        asked, played(asked, ReferenceAdapter)
    )
    assert [f.requirement for f in verdicts.findings] == ([] if kept else ["R-10.1.3-02"])
    assert "R-10.1.3-02" in verdicts.exercises
