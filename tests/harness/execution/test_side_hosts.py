"""Scenarios that wait do so side by side on further hosts; answers, incidents and reports are those of one host."""

from __future__ import annotations

import itertools
import os
from collections.abc import Iterator
from pathlib import Path

import msgspec
import psutil
import pytest
from files import SUPPORT

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_types import Interface
from ucm_cts.adapters.contract.scenario import Declaration, Scenario
from ucm_cts.harness.certificates.rejudging import without_clock
from ucm_cts.harness.execution.aside import MOST_INCIDENTS
from ucm_cts.harness.execution.campaign import Campaign
from ucm_cts.harness.execution.driver import Answer, Circumstances, Driver
from ucm_cts.harness.hosting.host_watch import Limits
from ucm_cts.harness.hosting.locate import locate
from ucm_cts.harness.hosting.pace import KNOWN_BY
from ucm_cts.harness.results.values import FrameworkReport
from ucm_cts.harness.statement.applicability import purposes_for
from ucm_cts.harness.statement.files import stated_by

pytestmark = pytest.mark.slow

JOBS = 4
LIMITS = Limits(seconds=2)
CALM = Scenario({"calm": Declaration()}, (s.AddComponent("calm"), s.Start()))
WAITS = Scenario({"calm": Declaration()}, (s.AddComponent("calm"), s.Pause(300), s.Start()))
PROVOKING = Declaration(("one", "two", "three"))
TRIGGER = Scenario({"trigger": PROVOKING}, (s.AddComponent("trigger"), s.Pause(10)))
CALM_TRIGGER = Scenario({"trigger": PROVOKING}, (s.AddComponent("trigger"),))
PICKY = """
import os
import subprocess
import time

import misbehaving
from ucm_cts.adapters.contract.adapter import NotOffered
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter

def picky(base):
    class Picky(base):
        def create_runtime(self, implementations):
            self.wanted = [one.name for one in implementations if len(one.provides) == 3]
            return super().create_runtime(implementations)

        def add_component(self, container, implementation, attributes):
            return super().add_component(container, "trigger" if implementation in self.wanted else implementation, attributes)

    return Picky

class Once(misbehaving.ReadsNullPointer):
    def misbehave(self):
        if os.path.exists("crashed"):
            return super(misbehaving.ReadsNullPointer, self).add_component(None, "trigger", {})
        open("crashed", "w").close()
        super().misbehave()


class Slow(misbehaving.ReadsNullPointer):
    def start(self, container):
        time.sleep(0.02)
        super().start(container)


class Unconnected(ReferenceAdapter):
    def link(self, *arguments):
        raise NotOffered


class Leaves(misbehaving.ReadsNullPointer):
    def misbehave(self):
        subprocess.Popen(["sleep", "77"], start_new_session=True)
        return 1


CrashesOnce = picky(Once)
LeavesProcesses = picky(Leaves)
Crashes = picky(misbehaving.ReadsNullPointer)
IsKilled = picky(misbehaving.IsKilled)
IsSlow = picky(Slow)
Hangs = picky(misbehaving.Hangs)
"""
"""Frameworks that misbehave when a component provides three port elements, whatever its name."""


@pytest.fixture(autouse=True)
def in_a_folder_with_picky_frameworks(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "picky.py").write_text(PICKY)
    (tmp_path / "misbehaving.py").write_text((SUPPORT / "hostile" / "misbehaving.py").read_text())
    monkeypatch.chdir(tmp_path)


@pytest.fixture(autouse=True)
def no_leaks() -> Iterator[None]:
    before = {child.pid for child in psutil.Process().children(recursive=True)}
    descriptors = set(os.listdir("/proc/self/fd"))
    yield
    assert {child.pid for child in psutil.Process().children(recursive=True)} <= before
    assert set(os.listdir("/proc/self/fd")) <= descriptors


def answers(adapter: str, cases: list[tuple[str, Scenario]], jobs: int = JOBS) -> list[Answer]:
    with Driver(locate(adapter), 1, LIMITS, jobs) as driver:
        return list(driver.run(cases))


def cases(*scenarios: Scenario) -> list[tuple[str, Scenario]]:
    return [(str(number), scenario) for number, scenario in enumerate(scenarios)]


def overlap(one: Answer, other: Answer) -> bool:
    return one.trace[0].t < other.trace[-1].t and other.trace[0].t < one.trace[-1].t


def test_waits_overlap_and_answers_are_in_order() -> None:
    asked = cases(*[CALM, WAITS, WAITS] * 5)
    got = answers("reference-py", asked)
    assert [(answer.name, answer.scenario) for answer in got] == asked
    assert all(answer.incident is None and answer.trace for answer in got)
    assert any(overlap(*two) for two in itertools.combinations(got[1::3], 2))
    alone = answers("reference-py", asked, jobs=1)
    assert not any(overlap(*two) for two in itertools.combinations(alone, 2))
    assert [len(answer.trace) for answer in got] == [len(answer.trace) for answer in alone]


def test_endless_cases_are_drawn_a_few_at_a_time() -> None:
    drawn: list[int] = []

    def endless() -> Iterator[tuple[str, Scenario]]:
        for number in itertools.count():
            drawn.append(number)
            yield str(number), CALM if number % 24 == 0 else WAITS

    with Driver(locate("reference-py"), 1, LIMITS, JOBS) as driver:
        taken = [answer.name for answer in itertools.islice(driver.run(endless()), 3)]
    assert taken == ["0", "1", "2"]
    assert len(drawn) < 100


@pytest.mark.parametrize(
    ("adapter", "kind"),
    [("picky:Crashes", "crash"), ("picky:Hangs", "hang"), ("picky:IsKilled", "crash")],
)
@pytest.mark.parametrize("place", [0, 3, 9])
def test_incident_is_that_of_its_scenario_alone(adapter: str, kind: str, place: int) -> None:
    scenarios = [CALM, WAITS, WAITS, CALM, WAITS, WAITS, WAITS, CALM, WAITS]
    scenarios.insert(place, TRIGGER)
    got = answers(adapter, cases(*scenarios))
    assert [answer.scenario for answer in got] == scenarios
    assert [answer.incident.kind if answer.incident else "" for answer in got] == [
        kind if one is TRIGGER else "" for one in scenarios
    ]
    incident = got[place].incident
    assert incident is not None
    assert incident.reproduced


@pytest.mark.parametrize("jobs", [1, JOBS])
def test_incident_that_does_not_come_again_is_told(jobs: int) -> None:
    with Driver(locate("picky:CrashesOnce", sandbox=False), 1, LIMITS, jobs) as driver:
        got = list(driver.run(cases(WAITS, TRIGGER, WAITS)))
    told = [(answer.incident.kind, answer.incident.reproduced) if answer.incident else None for answer in got]
    assert told == [None, ("crash", False), None]


def test_processes_left_behind_are_told() -> None:
    with Driver(locate("picky:LeavesProcesses", sandbox=False), 1, LIMITS, JOBS) as driver:
        for _ in driver.run(cases(*[TRIGGER] * 6)):
            pass
    assert "hosts left 6 processes behind" in " ".join(driver.warnings)


def test_only_incidents_spend_the_time_for_incidents() -> None:
    long = msgspec.structs.replace(WAITS, steps=(s.AddComponent("calm"), s.Pause(600), s.Start()))
    limits = Limits(seconds=2, incident_seconds=3)
    with Driver(locate("picky:Crashes"), 1, limits, JOBS) as driver:
        got = list(driver.run(cases(*[long, long, CALM_TRIGGER] * 4)))
    assert [answer.incident.kind if answer.incident else "" for answer in got] == ["", "", "crash"] * 4


def test_what_is_not_wanted_any_more_is_not_waited_for() -> None:
    hour = msgspec.structs.replace(WAITS, steps=(s.AddComponent("calm"), s.Pause(3_600_000)))
    with Driver(locate("reference-py"), 1, LIMITS, JOBS) as driver:
        answers = driver.run(cases(*[CALM, hour, hour] * 4))
        assert next(answers).name == "0"
        answers.close()  # type: ignore[attr-defined]
        (later,) = driver.run(cases(CALM))
    assert later.incident is None


def test_second_looks_that_will_be_asked_for_overlap() -> None:
    asked = cases(WAITS, TRIGGER, WAITS, WAITS)
    patient = Circumstances(patience=2, one_core=True)
    with Driver(locate("picky:Crashes"), 1, LIMITS, JOBS) as driver:
        list(driver.run(cases(CALM)))
        driver.look_ahead(asked, patient)
        got = [driver.again(name, scenario, patient) for name, scenario in asked]
        other = driver.again("0", WAITS, Circumstances())
    assert [answer.name for answer in got] == [name for name, _ in asked]
    assert [bool(answer.trace) for answer in got] == [True, False, True, True]
    assert overlap(got[0], got[2])
    assert got[0].scenario.patience == 2 * WAITS.patience
    assert other.scenario.patience == WAITS.patience


def test_second_look_that_is_not_asked_for_is_not_waited_for() -> None:
    hour = msgspec.structs.replace(WAITS, steps=(s.AddComponent("calm"), s.Pause(3_600_000)))
    with Driver(locate("reference-py"), 1, LIMITS, JOBS) as driver:
        driver.look_ahead(cases(*[hour] * 6), Circumstances())
        (later,) = driver.run(cases(CALM))
    assert later.incident is None


def test_threads_that_never_come_back_are_the_scenarios_own() -> None:
    stuck = Scenario({"trigger": PROVOKING}, (s.AddComponent("trigger", thread="w"), s.Pause(10)), patience=200)
    got = answers("picky:Hangs", cases(WAITS, stuck, WAITS, CALM, WAITS))
    assert [answer.incident.kind if answer.incident else "" for answer in got] == ["", "hang", "", "", ""]
    assert [answer.stuck for answer in got] == [(), ("w",), (), (), ()]


def report(adapter: str, jobs: int) -> FrameworkReport:
    """Of the scenarios of 10.1.3, most of which wait, and those of 11.2.3."""
    statement = stated_by(None, "reference-py")
    chosen = [p for p in purposes_for(statement, "core") if p.clause.startswith("10.1.3") and not p.of_dimensions][:12]
    chosen += [p for p in purposes_for(statement, "core") if p.clause.startswith("11.2.3")][:40]
    with Driver(locate(adapter), 1, Limits(seconds=3), jobs) as driver:
        campaign = Campaign(driver, "core", (), statement)
        for _ in campaign.check(chosen):
            pass
        return without_clock(campaign.report())


@pytest.mark.parametrize("adapter", ["reference-py", "ucm_cts.adapters.mutants.python:leaves_passive_components_open"])
def test_report_is_that_of_one_host(adapter: str) -> None:
    several, one = report(adapter, JOBS), report(adapter, 1)
    assert [(r.id, r.verdict, r.exercised > 0) for r in several.requirements] == [
        (r.id, r.verdict, r.exercised > 0) for r in one.requirements
    ]
    assert (several.verdict, several.incidents) == (one.verdict, one.incidents)


def test_hosts_may_not_differ(tmp_path: Path) -> None:
    """The second host says another version: it is not taken, and the run goes on with the first."""
    (tmp_path / "changing.py").write_text(
        "import os\n"
        "from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter\n"
        "class Changing(ReferenceAdapter):\n"
        "    version = str(os.getpid())\n"
    )
    got = answers("changing:Changing", cases(CALM, WAITS, CALM, WAITS))
    assert [answer.incident for answer in got] == [None] * 4


def test_side_hosts_are_started_again_after_one_could_not_answer(tmp_path: Path) -> None:
    """A busy machine kept one from its work, which may not cost all further scenarios their overlap."""
    (tmp_path / "failing.py").write_text(
        "import os\n"
        "from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter\n"
        "with open('starts', 'a') as starts:\n"
        "    starts.write('.')\n"
        "class Failing(ReferenceAdapter):\n"
        "    version = 'other' if os.stat('starts').st_size == 2 else '1'\n"
    )
    with Driver(locate("failing:Failing", sandbox=False), 1, LIMITS, JOBS) as driver:
        got = list(driver.run(cases(CALM, *[WAITS, CALM] * 12)))
    assert [(answer.name, answer.incident) for answer in got] == [(str(number), None) for number in range(25)]
    assert any(overlap(*two) for two in itertools.combinations(got[-8:], 2))


@pytest.mark.parametrize("jobs", [1, JOBS])
def test_scenarios_with_a_connector_that_is_not_offered_are_left_out_once_that_is_known(jobs: int) -> None:
    link = s.Link("simple_service_connector", "any", "l")
    linked = Scenario({"calm": Declaration()}, (link, s.AddComponent("calm")), interfaces={"any": Interface({})})
    with Driver(locate("picky:Unconnected"), 1, LIMITS, jobs) as driver:
        got = [*driver.run(cases(linked)), *driver.run(cases(CALM, linked, CALM))]
    assert [answer.incident.kind if answer.incident else "" for answer in got] == ["", "", "untried", ""]


def test_stressed_scenarios_stay_with_the_pipeline() -> None:
    stress = msgspec.structs.replace(WAITS, steps=(*WAITS.steps, s.Stress((), 10)))
    got = answers("reference-py", cases(*[stress] * 6))
    assert not any(overlap(*two) for two in itertools.combinations(got, 2))


def test_scenarios_that_begin_before_they_are_due_are_answered_in_order_under_their_names() -> None:
    due = cases(CALM, *[msgspec.structs.replace(WAITS) for _ in range(4)], CALM, WAITS)
    with Driver(locate("reference-py"), 1, LIMITS, JOBS) as driver:
        assert [driver.may_begin(scenario) for _, scenario in due] == [False, *[True] * 4, False, True]
        driver.begin([*due[1:5], ("7", WAITS), due[6]])  # the same scenario twice
        got = list(driver.run(due))
    assert [answer.name for answer in got] == [name for name, _ in due]
    assert all(answer.incident is None for answer in got)
    assert any(overlap(*two) for two in itertools.combinations(got[1:5], 2))


def test_what_begins_early_and_is_not_asked_for_is_not_waited_for() -> None:
    hour = msgspec.structs.replace(WAITS, steps=(s.AddComponent("calm"), s.Pause(3_600_000)))
    with Driver(locate("reference-py"), 1, LIMITS, JOBS) as driver:
        driver.begin(cases(*[msgspec.structs.replace(hour) for _ in range(6)]))
        (later,) = driver.run(cases(CALM))
    assert later.incident is None


def test_what_has_begun_is_run_by_the_own_host_once_there_are_no_others() -> None:
    waiting = [msgspec.structs.replace(WAITS) for _ in range(6)]
    crashing = [msgspec.structs.replace(TRIGGER) for _ in range(MOST_INCIDENTS + 1)]
    asked = cases(*crashing, *waiting)
    with Driver(locate("picky:Crashes"), 1, LIMITS, JOBS) as driver:
        driver.begin(asked)
        got = list(driver.run(asked))
    assert [answer.scenario for answer in got] == [scenario for _, scenario in asked]
    assert [answer.incident.kind if answer.incident else "" for answer in got] == ["crash"] * len(crashing) + [""] * 6


def test_all_scenarios_of_a_slow_product_are_run_side_by_side_whatever_happens() -> None:
    usual, after = [CALM] * (32 + KNOWN_BY), MOST_INCIDENTS + 2
    got = answers("picky:IsSlow", cases(*usual, *[CALM, CALM_TRIGGER] * after, *usual))
    assert [answer.incident is not None for answer in got] == [
        *[False] * len(usual), *[False, True] * after, *[False] * len(usual)
    ]  # fmt: skip
    last = got[-len(usual) :]
    assert any(overlap(*two) for two in itertools.pairwise(last))
    quick = answers("picky:Crashes", cases(*usual, *usual))
    assert not any(overlap(*two) for two in itertools.pairwise(quick))


def test_answers_that_are_there_count_although_the_time_for_incidents_is_used_up() -> None:
    waiting = cases(*[msgspec.structs.replace(WAITS) for _ in range(2)])
    longer = msgspec.structs.replace(WAITS, steps=(s.AddComponent("calm"), s.Pause(900)))
    with Driver(locate("picky:Crashes"), 1, Limits(seconds=2, incident_seconds=0), JOBS) as driver:
        driver.begin(waiting)
        before = [*driver.run([("longer", longer)]), *driver.run([("crash", CALM_TRIGGER)])]
        got = list(driver.run([*waiting, ("calm", CALM)]))
    assert [answer.incident.kind if answer.incident else "" for answer in before] == ["", "crash"]
    assert [answer.incident.kind if answer.incident else "" for answer in got] == ["", "", "untried"]
