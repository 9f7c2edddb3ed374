"""A failure is shown by the shortest scenario that can be found, and that scenario still fails for the same reason."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from types import SimpleNamespace

import msgspec
import pytest

from ucm_cts.adapters.contract.scenario import AddComponent, CreateContainer, Scenario
from ucm_cts.harness.execution import shortening, shrink
from ucm_cts.harness.execution.campaign import Campaign
from ucm_cts.harness.execution.driver import Driver
from ucm_cts.harness.execution.driving import Answer
from ucm_cts.harness.hosting.locate import locate
from ucm_cts.harness.purposes.probes import load_probe_types
from ucm_cts.harness.purposes.scripts import Script, problems, to_scenario
from ucm_cts.harness.purposes.selection import load_purposes, select
from ucm_cts.harness.results.tally import cause_of
from ucm_cts.harness.results.values import ReportedFinding

pytestmark = pytest.mark.usefixtures("here")

SCENARIOS = [scenario for purpose in load_purposes("container") for _, scenario in purpose.scenarios]
LONGEST = max(
    (x for x in SCENARIOS if not any(isinstance(step, CreateContainer) for step in x.steps)), key=lambda x: len(x.steps)
)


def failures(adapter: str, expression: str) -> tuple[list[ReportedFinding], list[ReportedFinding]]:
    """What is found with the purposes that ``expression`` selects: as found, and shortened."""
    with Driver(locate(adapter), seed=4) as driver:
        campaign = Campaign(driver, "container")
        for _ in campaign.check(select(load_purposes("container"), expression)):
            pass
        found = [f for r in campaign.report().requirements for f in r.findings]
        causes = list(campaign.shorten())
        shortened = [f for r in campaign.report().requirements for f in r.findings]
    assert sorted(causes) == sorted(cause_of(f.finding) for f in found)
    return found, shortened


def test_shortened_failure_is_the_same_failure() -> None:
    found, shortened = failures("subjects:stops_in_startup_order", "stop-reverses-start")
    (long,), (short,) = found, shortened
    assert cause_of(short.finding) == cause_of(long.finding)
    assert len(long.execution.scenario.steps) >= 8
    assert [type(step).__name__ for step in short.execution.scenario.steps] == [
        "AddComponent", "AddComponent", "Start", "Stop"
    ]  # fmt: skip
    assert all(not d.plan and not d.connectable for d in short.execution.scenario.components.values())
    assert short.occurrences == long.occurrences, "tries are not counted"


def test_crash_is_shortened_with_the_trace_that_leads_to_it() -> None:
    found, shortened = failures("subjects:Crashing", "start/already started or ready/start/ or stop-reverses-start")
    assert found
    for long, short in zip(found, shortened, strict=True):
        assert cause_of(short.finding) == cause_of(long.finding)
        assert short.execution.incident is not None
        assert short.execution.incident.kind == "crash"
        assert "subjects.py" in short.execution.incident.stacks
        assert [type(step).__name__ for step in short.execution.scenario.steps] == ["AddComponent", "Start", "Start"]
        assert short.finding.events == (short.execution.trace[-1].n,)


def test_every_shorter_scenario_is_shorter_and_can_be_saved_and_read_back() -> None:
    probes = load_probe_types()
    for scenario in SCENARIOS[:: max(1, len(SCENARIOS) // 300)]:
        for shorter in shrink._shorter(scenario):
            assert len(encoded(shorter)) < len(encoded(scenario))
            script = msgspec.convert({"scenario": "saved", **msgspec.to_builtins(shorter)}, Script)
            assert to_scenario(script, probes) == shorter
            assert problems(script, probes) == []


def encoded(scenario: Scenario) -> bytes:
    return msgspec.json.encode(scenario)


def test_the_boldest_guess_that_fails_is_taken_and_then_improved() -> None:
    def adds_two(candidates: Sequence[Scenario]) -> int | None:
        fitting = [sum(isinstance(step, AddComponent) for step in c.steps) >= 2 for c in candidates]
        return fitting.index(True) if any(fitting) else None

    short = shrink.shortest(LONGEST, adds_two)
    assert [type(step) for step in short.steps] == [AddComponent, AddComponent]
    assert shrink.shortest(LONGEST, lambda candidates: None) == LONGEST


def test_the_search_for_shorter_scenarios_ends_in_time_and_each_failure_has_its_share(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    clock = 0.0
    begun: dict[str, list[float]] = {}

    class Slow(Driver):
        """Each scenario of a search takes three seconds."""

        def run(self, cases: Iterable[tuple[str, Scenario]], insist: bool = False) -> Iterator[Answer]:
            nonlocal clock
            for answer in super().run(cases, insist):
                if answer.name.endswith("shortened"):
                    begun.setdefault(answer.name, []).append(clock)
                    clock += 3
                yield answer

    monkeypatch.setattr(shortening, "time", SimpleNamespace(monotonic=lambda: clock))
    with Slow(locate("subjects:stops_in_startup_order"), seed=4) as driver:
        campaign = Campaign(driver, "container")
        purposes = select(load_purposes("container"), "stop-reverses-start or manager-cascade or restart")
        assert sum(1 for _ in campaign.check(purposes)) > 1
        causes = list(campaign.shorten())
    assert causes
    for times in begun.values():
        assert times[-1] - times[0] <= shortening.SECONDS_FOR_SHORTER
    assert len(begun) == len(causes)
    assert clock <= shortening.SECONDS_FOR_ALL_SHORTER + 3 * len(causes)
