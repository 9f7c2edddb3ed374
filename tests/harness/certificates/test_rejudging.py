"""A run that is judged again from its record has the same report, and each change of a record is told."""

from __future__ import annotations

import dataclasses
import itertools
import json
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import suppress
from typing import Any, NamedTuple

import msgspec
import pytest
import subjects
from hypothesis import given, settings
from hypothesis import strategies as st
from recorded_runs import judged, plan_of, recorded, some_purposes
from statements import EXTENSIONS

from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.harness.certificates.rejudging import Judged, RunPlan, judge_again, without_clock
from ucm_cts.harness.execution import campaign
from ucm_cts.harness.execution import record as r
from ucm_cts.harness.execution.campaign import BUSY
from ucm_cts.harness.execution.clock_gaps import ClockGaps
from ucm_cts.harness.execution.confirmation import OF_THE_MACHINE
from ucm_cts.harness.execution.recording import Record, RecordError, decoded, encoded
from ucm_cts.harness.purposes.scripts import TestPurpose
from ucm_cts.harness.results.statement import default_statement
from ucm_cts.harness.results.values import FrameworkReport
from ucm_cts.harness.statement.applicability import purposes_for

MUTANTS = "ucm_cts.adapters.mutants.python"


class Run(NamedTuple):
    plan: RunPlan
    purposes: tuple[TestPurpose, ...]
    report: FrameworkReport
    record: Record

    def judged(self, record: Record | None = None, **other: Any) -> Judged:
        plan = msgspec.structs.replace(self.plan, **other)
        return judged(record or self.record, plan, self.purposes)


def run_of(adapter: str, *words: str, every: int = 12, **more: Any) -> Run:
    plan = plan_of(adapter, **more)
    purposes = some_purposes(plan, words, every)
    return Run(plan, purposes, *recorded(adapter, plan, purposes))


def is_same(run: Run) -> None:
    again = run.judged()
    assert again.problems == ()
    assert without_clock(again.report) == without_clock(run.report)
    assert again.report.started[:2] == "20"


@pytest.fixture(scope="module")
def conformant() -> Run:
    return run_of("reference-py", "R-11.2.2.2-07", drawn=20)


def test_a_record_is_judged_like_the_run(conformant: Run) -> None:
    is_same(conformant)
    assert {r.Answered, r.Repeated, r.InSeries} <= kinds(conformant)
    assert conformant.report.effort.measures["scenarios drawn at random"] == 20


def test_a_reader_finds_every_scenario_and_its_whole_trace(conformant: Run) -> None:
    performed = list(conformant.record.performed())
    events = sum(len(trace) for entry, trace in performed if isinstance(entry, r.Answered))
    assert events == conformant.report.events
    for entry, trace in performed:
        scenario = json.loads(conformant.record.scenario(entry))
        steps = {event.step for event in trace if hasattr(event, "step")}
        assert steps <= set(range(len(scenario["steps"])))
    times = [event.t for _, trace in performed for event in trace[:1]]
    assert times == sorted(times)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("adapter", "words", "more"),
    [
        (f"{MUTANTS}:leaves_its_watchdog", ("R-11.2.2.2-07",), {}),
        ("hostile.failing:CrashesInRemove", (), {"incident_seconds": 3.0}),
        ("hostile.failing:HangsInStop", (), {"seconds": 0.5, "incident_seconds": 3.0}),
        (
            "hostile.failing:LeavesCallsWaiting",
            ("later use/removal of the server",),
            {"seconds": 1.0, "incident_seconds": 5.0},
        ),
        ("hostile.failing:AddsNothing", (), {}),
        ("hostile.failing:TakesMemoryInStop", (), {"memory": 250, "incident_seconds": 3.0}),
    ],
)
@pytest.mark.usefixtures("here")
def test_what_fails_crashes_or_hangs_is_judged_like_the_run(
    adapter: str, words: tuple[str, ...], more: dict[str, Any]
) -> None:
    run = run_of(adapter, *words, every=10**6 if words else 25, **more)
    shown = any(result.findings for result in run.report.requirements)
    assert shown or run.report.incidents or run.report.warnings
    is_same(run)


def of_one_purpose(adapter: str, name: str, profile: str = "core") -> Run:
    """A run in this process, of the first scenario of a test purpose of ``profile``, with a log that can be read.

    Of the extensions all are claimed.
    """
    default = default_statement()
    statement = msgspec.structs.replace(
        default,
        readings=default.readings | {"trace-sink": "hook"},
        capabilities=default.capabilities | dict.fromkeys(EXTENSIONS if profile == "extensions" else (), True),
    )
    plan = RunPlan(profile, 5, statement)
    (whole,) = (one for one in purposes_for(statement, profile) if one.id == name)
    purpose = dataclasses.replace(whole, scenarios=whole.scenarios[:1])
    return Run(plan, (purpose,), *recorded(adapter, plan, (purpose,), in_process=True))


def kinds(run: Run) -> set[type]:
    return {type(entry) for entry in run.record.entries}


@pytest.mark.parametrize(("slips", "verdict"), [(1, "inconclusive"), (1000, "fail")])
def test_second_looks_decide_when_a_run_is_judged_again(slips: int, verdict: str) -> None:
    subjects.Slips.left = slips
    run = of_one_purpose("subjects:Slipping", "same-connection-twice")
    assert {one.verdict for one in run.report.requirements if one.id == "R-11.2.1.2-06"} == {verdict}
    assert {r.Repeated} <= kinds(run)
    is_same(run)
    entries = tuple(entry for entry in run.record.entries if not isinstance(entry, r.Repeated))
    without = run.judged(msgspec.structs.replace(run.record, entries=entries))
    assert any("second look" in problem for problem in without.problems)


def test_shorter_scenarios_are_shown_and_must_show_their_failure() -> None:
    subjects.Slips.left = 1000
    run = of_one_purpose("subjects:Slipping", "same-connection-twice")
    number, shorter = next((n, e) for n, e in enumerate(run.record.entries) if isinstance(e, r.Shorter))
    for changes, problem in (
        ({"cause": ("R-11.2.1.2-01", "x", "y")}, "no failure of this run"),
        ({"name": "mine"}, "is not named"),
        ({"plain": Scenario({}, ())}, "is not the scenario"),
        ({"words": {}}, "does not show"),
        ({"events": shorter.events[:-2], "times": shorter.times[:-2]}, "cannot be true"),
    ):
        entries = list(run.record.entries)
        edit(entries, number, **changes)
        again = run.judged(msgspec.structs.replace(run.record, entries=tuple(entries)))
        assert any(problem in one for one in again.problems) or changes == {"words": {}}, (changes, again.problems)


def test_failures_that_were_not_looked_at_again_for_want_of_time(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(campaign, "SECONDS_FOR_CONFIRMATION", 0.0)
    subjects.Slips.left = 1000
    run = of_one_purpose("subjects:Slipping", "same-connection-twice")
    assert run.report.effort.measures["failures that were not run again"] >= 1
    assert r.UsedUp in kinds(run)
    is_same(run)
    monkeypatch.setattr(campaign, "SECONDS_FOR_CONFIRMATION", 60.0)
    assert any("cannot have been used up" in problem for problem in run.judged().problems)


def test_moments_at_which_the_machine_stood_still_are_recorded(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ClockGaps, "longest", lambda gaps, events: 800)
    subjects.Forgets.left = 1000
    run = of_one_purpose("subjects:Forgetful", "log-of-several-components")
    reasons = {one.reason for one in run.report.requirements if one.id == "R-10.1.4.2-26"}
    assert reasons == {"the machine stood still for 800 ms when it was to be seen"}
    assert r.Stood in kinds(run)
    is_same(run)
    assert any("the machine stood still" in one for one in run.judged().unshown)


@pytest.mark.parametrize(("waited", "verdict"), [(450, "pass"), (399, "inconclusive")])
def test_lateness_that_was_the_machines_does_not_count_when_a_run_is_judged_again(
    waited: int, verdict: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(ClockGaps, "contended", lambda gaps, events: waited)
    subjects.Dawdles.left = 1
    run = of_one_purpose("subjects:Dawdling", "index timers/sporadic", "extensions")
    assert {one.verdict for one in run.report.requirements if one.id == "R-10.3.2-26"} == {verdict}
    assert run.report.effort.measures.get(OF_THE_MACHINE, 0) == (verdict == "pass")
    assert (BUSY in run.report.warnings) == (verdict == "pass")
    assert r.Contended in kinds(run)
    is_same(run)
    assert any("too few processors" in one for one in run.judged().unshown)
    entries = (
        msgspec.structs.replace(entry, milliseconds=10**6) if isinstance(entry, r.Contended) else entry
        for entry in run.record.entries
    )
    forged = run.judged(msgspec.structs.replace(run.record, entries=tuple(entries)))
    assert any("cannot have waited" in problem for problem in forged.problems)


def test_a_gap_in_the_first_of_several_looks_is_judged_again(monkeypatch: pytest.MonkeyPatch) -> None:
    stood = iter([800])
    monkeypatch.setattr(ClockGaps, "longest", lambda gaps, events: next(stood, 0))
    subjects.Dawdles.left = 1
    run = of_one_purpose("subjects:Dawdling", "index timers/sporadic", "extensions")
    assert {one.verdict for one in run.report.requirements if one.id == "R-10.3.2-26"} == {"pass"}
    monkeypatch.undo()
    is_same(run)


@pytest.mark.usefixtures("here")
def test_a_remote_host_is_judged_by_its_own_clock(tmp_path: Any) -> None:
    module = "ucm_cts.adapters.sdk.python.host"
    subject = "ucm_cts.adapters.reference.python.adapter:ReferenceAdapter"
    command = [sys.executable, "-m", module, subject, "--listen", f"unix:{tmp_path / 'socket'}"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as server:
        try:
            assert server.stdout is not None
            address = server.stdout.readline().removeprefix("listening on ").strip()
            run = run_of(address, every=60)
        finally:
            server.terminate()
    assert run.record.heading.isolation == "remote"
    is_same(run)
    entries = list(run.record.entries)
    later(entries, answers(entries)[0], -(10**10))
    again = run.judged(msgspec.structs.replace(run.record, entries=tuple(entries)))
    assert any("before the end" in problem for problem in again.problems), again.problems


def test_profile_core_is_judged_again() -> None:
    is_same(run_of("reference-py", profile="core", every=40, drawn=10))


Entries = list[Any]
Change = Callable[[Entries], object]


def answers(entries: Entries) -> list[int]:
    """Where answers to scenarios of a test purpose with many events are, far apart."""
    found = [n for n, entry in enumerate(entries) if isinstance(entry, r.Answered) and len(entry.events) > 20]
    return found[5 : len(found) // 2 : 9]


def place(entries: Entries, kind: type) -> int:
    return next(n for n, entry in enumerate(entries) if isinstance(entry, kind))


def exchange(entries: Entries, first: int, second: int) -> None:
    entries[first], entries[second] = entries[second], entries[first]


def edit(entries: Entries, number: int, **changes: Any) -> None:
    entries[number] = msgspec.structs.replace(entries[number], **changes)


def cut(entries: Entries, number: int, by: int) -> None:
    entry = entries[number]
    edit(entries, number, events=entry.events[:-by], times=entry.times[:-by])


def later(entries: Entries, number: int, nanoseconds: int) -> None:
    """One trace later than it was, and all others when they were."""
    times, after = entries[number].times, entries[number + 1].times
    edit(entries, number, times=(times[0] + nanoseconds, *times[1:]))
    edit(entries, number + 1, times=(after[0] - nanoseconds, *after[1:]))


def with_trace_of(entries: Entries, number: int, other: int) -> None:
    edit(entries, number, events=entries[other].events, times=entries[other].times)


TAMPERING: dict[str, tuple[Change, str]] = {
    "a scenario is dropped": (lambda e: e.pop(answers(e)[0]), "is missing from the record"),
    "the first scenario is dropped": (lambda e: e.pop(0), "is missing from the record"),
    "two scenarios are exchanged": (lambda e: exchange(e, *answers(e)[:2]), "in another place than it is due"),
    "two scenarios are exchanged that are near": (
        lambda e: exchange(e, answers(e)[0], answers(e)[0] + 1),
        "in another place than it is due",
    ),
    "a scenario is there twice": (lambda e: e.insert(answers(e)[0], e[answers(e)[0]]), "stands where"),
    "a scenario is surplus at the end": (lambda e: e.append(e[answers(e)[0]]), "goes on after the end"),
    "the record ends early": (lambda e: e.__delitem__(slice(answers(e)[-1], None)), "the record ends"),
    "a scenario has another name": (lambda e: edit(e, answers(e)[0], name="mine"), "'mine' stands where"),
    "a scenario is another one": (lambda e: edit(e, answers(e)[0], scenario=e[0].scenario), "another scenario"),
    "a trace is cut": (lambda e: cut(e, answers(e)[0], 3), "cannot be true"),
    "a trace is cut, and a worker is said to be stuck": (
        lambda e: (cut(e, answers(e)[0], 3), edit(e, answers(e)[0], stuck=("w",))),
        "cannot be true",
    ),
    "a trace is empty": (lambda e: edit(e, answers(e)[0], events=(), times=()), "cannot be true"),
    "a trace is that of another scenario": (lambda e: with_trace_of(e, *answers(e)[:2]), "cannot be true"),
    "the events of a trace are reordered": (
        lambda e: edit(e, answers(e)[0], events=e[answers(e)[0]].events[::-1]),
        "cannot be true",
    ),
    "a trace was earlier than it can have been": (lambda e: later(e, answers(e)[0], -(10**10)), "before the end"),
    "a trace was later than it can have been": (lambda e: later(e, answers(e)[0], 10**10), "before the end"),
    "an answer came before the one before it": (lambda e: edit(e, answers(e)[0], at=0), "before the one before it"),
    "a second look is dropped": (lambda e: e.pop(place(e, r.Repeated)), "second look"),
    "a second look was in easier circumstances": (
        lambda e: edit(e, place(e, r.Repeated), patience=1.0, one_core=False),
        "other circumstances",
    ),
    "time for second looks is said to be used up": (
        lambda e: e.__setitem__(slice(place(e, r.Repeated), None), [r.UsedUp(10**9)]),
        "cannot have been used up",
    ),
    "a run of a series is dropped": (lambda e: e.pop(place(e, r.InSeries)), "series"),
    "incidents are said to have taken all the time": (
        lambda e: edit(
            e, answers(e)[0], events=(), times=(), incident=r.Incident("untried", "not tried: incidents had taken 60 s")
        ),
        "cannot have taken",
    ),
    "a crash has a trace that cannot be": (
        lambda e: edit(e, answers(e)[0], events=e[answers(e)[0]].events[::-1], incident=r.Incident("crash", "SIGSEGV")),
        "contradicts itself",
    ),
}


@pytest.mark.parametrize("how", TAMPERING)
def test_what_is_changed_in_a_record_is_told(conformant: Run, how: str) -> None:
    change, problem = TAMPERING[how]
    entries = list(conformant.record.entries)
    change(entries)
    again = conformant.judged(msgspec.structs.replace(conformant.record, entries=tuple(entries)))
    assert any(problem in one for one in again.problems), again.problems
    assert again.report.incomplete
    assert all("\n" not in one and len(one) < 500 for one in again.problems)


@pytest.mark.parametrize(
    ("other", "problem"),
    [
        ({"seed": 8}, "seed"),
        ({"drawn": 0}, "there is 'explored 1'"),
        ({"drawn": 21}, "'explored 21'"),
        ({"statement": "patience"}, "another scenario"),
    ],
)
def test_a_record_of_another_plan_is_told(conformant: Run, other: dict[str, Any], problem: str) -> None:
    if other.get("statement") == "patience":
        statement = conformant.plan.statement
        other = {"statement": msgspec.structs.replace(statement, ixit={**statement.ixit, "patience": 1500.0})}
        purposes = some_purposes(msgspec.structs.replace(conformant.plan, **other), ["R-11.2.2.2-07"])
        conformant = conformant._replace(purposes=purposes)
    again = conformant.judged(**other)
    assert any(problem in one for one in again.problems), again.problems


def test_several_changes_are_told_together(conformant: Run) -> None:
    entries = list(conformant.record.entries)
    first, second, third, fourth = answers(entries)[:4]
    names = [entries[number].name for number in (first, second, third, fourth)]
    cut(entries, first, 3)
    later(entries, second, -(10**10))
    edit(entries, fourth, name="mine")
    edit(entries, place(entries, r.Repeated), patience=7.0)
    entries.pop(third)
    again = conformant.judged(msgspec.structs.replace(conformant.record, entries=tuple(entries)))
    told = (
        f"the trace of '{names[0][:70]}",
        f"the trace of '{names[1][:70]}",
        f"the answer to '{names[2][:70]}",
        f"the answer to '{names[3][:70]}",
        "the answer to 'mine' stands where",
        "none of the 20 drawn scenarios was compared",
        "was in other circumstances",
    )
    assert [one for one in told if not any(one in problem for problem in again.problems)] == [], again.problems
    assert len(again.problems) == len(told)


def test_a_host_whose_threads_cannot_be_counted_is_not_excused(conformant: Run) -> None:
    """A process can hide what it holds, and a record can leave it out; only one that is elsewhere cannot be counted."""
    series = [entry for entry in conformant.record.entries if isinstance(entry, r.InSeries)]
    entries = [
        msgspec.structs.replace(entry, usage=None) if isinstance(entry, r.InSeries) else entry
        for entry in conformant.record.entries
        if entry not in series[10:] and not isinstance(entry, r.Counted)
    ]
    again = conformant.judged(msgspec.structs.replace(conformant.record, entries=tuple(entries)))
    (freed,) = (one for one in again.report.requirements if one.id == "R-11.2.2.2-07")
    assert (freed.verdict, "could not be counted" in freed.reason) == ("inconclusive", True), freed


def test_second_looks_without_a_trace_are_on_the_signers_word(conformant: Run) -> None:
    assert conformant.judged().unshown == ()
    entries = list(conformant.record.entries)
    looks = [number for number, entry in enumerate(entries) if isinstance(entry, r.Repeated)]
    edit(entries, looks[0], events=(), times=())
    again = conformant.judged(msgspec.structs.replace(conformant.record, entries=tuple(entries)))
    assert again.problems == ()
    (unshown,) = again.unshown
    assert f"1 of {len(looks)} second looks gave no trace" in unshown


def test_what_is_cut_out_does_not_accuse_the_rest(conformant: Run) -> None:
    entries = list(conformant.record.entries)
    number = answers(entries)[0]
    names = {entry.name for entry in entries[number : number + 5]}
    del entries[number : number + 5]
    again = conformant.judged(msgspec.structs.replace(conformant.record, entries=tuple(entries)))
    *missing, drawn = again.problems
    assert len(missing) == 5
    assert all(
        "is missing from the record" in one and any(f"'{name}'"[:75] in one for name in names) for one in missing
    )
    assert "none of the 20 drawn" in drawn


def test_a_trouble_among_drawn_scenarios_does_not_accuse_the_rest(conformant: Run) -> None:
    entries = list(conformant.record.entries)
    number = next(n for n, e in enumerate(entries) if isinstance(e, r.Answered) and e.name == "explored 3")
    cut(entries, number, 2)
    again = conformant.judged(msgspec.structs.replace(conformant.record, entries=tuple(entries)))
    assert "the trace of 'explored 3' cannot be true" in again.problems[0]
    assert not any("another scenario" in one or "missing from" in one for one in again.problems), again.problems


def test_answers_of_another_run_of_the_same_seed_cannot_be_mixed_in(conformant: Run) -> None:
    """Both runs have the same scenarios; only their times differ."""
    _, other = recorded("reference-py", conformant.plan, conformant.purposes)
    entries = list(conformant.record.entries)
    number = answers(entries)[1]
    traces = {entry.name: trace for entry, trace in other.performed() if isinstance(entry, r.Answered)}
    before = [trace for _, trace in itertools.islice(conformant.record.performed(), number) if trace][-1][-1].t
    clock = [before, *(event.t for event in traces[entries[number].name])]
    shifted = tuple(after - before for before, after in itertools.pairwise(clock))
    known = {msgspec.json.encode(event): n for n, event in enumerate(conformant.record.events)}
    events = list(conformant.record.events)
    places = []
    for event in traces[entries[number].name]:
        plain = msgspec.structs.replace(event, n=0, t=0)
        key = msgspec.json.encode(plain)
        if key not in known:
            known[key] = len(events)
            events.append(plain)
        places.append(known[key])
    moved = entries[number + 1].times[0] - sum(shifted) + sum(entries[number].times)
    edit(entries, number, events=tuple(places), times=shifted)
    edit(entries, number + 1, times=(moved, *entries[number + 1].times[1:]))
    mixed = msgspec.structs.replace(conformant.record, entries=tuple(entries), events=tuple(events))
    again = conformant.judged(mixed)
    assert any("before the end" in one for one in again.problems), again.problems


@pytest.mark.slow
def test_a_record_of_another_process_with_other_hashes_is_judged_alike(conformant: Run, tmp_path: Any) -> None:
    """What is drawn at random depends on the seed only."""
    code = (
        "import sys, msgspec; from pathlib import Path; from recorded_runs import *;"
        "plan = plan_of('reference-py', drawn=20); purposes = some_purposes(plan, ['R-11.2.2.2-07']);"
        "again = judged(decoded(Path(sys.argv[1]).read_bytes()), plan, purposes);"
        "print(again.problems, len(again.report.requirements))"
    )
    (tmp_path / "record").write_bytes(encoded(conformant.record))
    from files import SUPPORT

    ended = subprocess.run(
        [sys.executable, "-c", code, str(tmp_path / "record")],
        env={"PYTHONHASHSEED": "5", "PYTHONPATH": str(SUPPORT), "PATH": ""},
        capture_output=True,
        text=True,
        check=False,
    )
    assert ended.stdout == f"() {len(conformant.report.requirements)}\n", ended.stderr


def test_a_record_is_written_in_one_way_only(conformant: Run) -> None:
    data = encoded(conformant.record)
    assert decoded(data) == conformant.record
    for other in (data.replace(b'"at":', b'"at": ', 1), data + b"\n", data.replace(b"\n", b"\r\n", 1)):
        with pytest.raises(RecordError):
            decoded(other)


def tables(record: Record) -> Iterator[tuple[str, Record]]:
    replace = msgspec.structs.replace
    yield "format", replace(record, heading=replace(record.heading, format=r.FORMAT + 1))
    yield "that no entry names", replace(record, scenarios=(*record.scenarios, msgspec.Raw(b"{}")))
    yield "listed twice", replace(record, scenarios=(record.scenarios[1], *record.scenarios[1:]))
    yield "another order", replace(record, entries=record.entries[::-1])
    yield "number or a time", replace(record, events=(replace(record.events[0], n=1), *record.events[1:]))
    entry = record.entries[0]
    assert isinstance(entry, r.Answered)
    yield "times", replace(record, entries=(replace(entry, times=()), *record.entries[1:]))
    far = (2**62, 2**62, *entry.times[2:])
    yield "no clock", replace(record, entries=(replace(entry, times=far), *record.entries[1:]))
    many = replace(entry, events=(*entry.events, *entry.events[:1] * r.MOST_IN_TRACE), times=entry.times)
    yield "more than 1000000 events", replace(record, entries=(many, *record.entries[1:]))
    beyond = (len(record.events), *entry.events[1:])
    yield "another order", replace(record, entries=(replace(entry, events=beyond), *record.entries[1:]))
    number, series = next((k, one) for k, one in enumerate(record.entries) if isinstance(one, r.InSeries))
    fewer = replace(series, usage=r.Usage(-1, 3))
    yield "threads|>= 0", replace(record, entries=(*record.entries[:number], fewer, *record.entries[number + 1 :]))


def test_lists_that_do_not_fit_are_refused(conformant: Run) -> None:
    for problem, record in tables(conformant.record):
        with pytest.raises(RecordError, match=problem):
            decoded(encoded(record))


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"\n\n\n\n",
        b"{}\n[]\n[]\n",
        b"\xff\xfe",
        b"[" * 10**6,
        b"{}\n" + b"[" * 10**5 + b"\n[]\n",
        b"null\n" * 9,
        b"\x00" * 99,
    ],
)
def test_bytes_that_are_no_record_are_refused(data: bytes) -> None:
    with pytest.raises(RecordError) as refused:
        decoded(data)
    assert "\n" not in str(refused.value)


@settings(max_examples=300, deadline=None)
@given(st.data())
def test_a_record_with_any_bytes_changed_gives_no_traceback(conformant: Run, data: st.DataObject) -> None:
    """A part of the record, so that a test takes little time; what can be read is judged."""
    entries = conformant.record.entries[:40]
    events = max((n for e in entries if isinstance(e, r.Answered) for n in e.events), default=-1) + 1
    scenarios = max(e.scenario for e in entries if isinstance(e, r.Answered)) + 1
    record = conformant.record
    part = Record(record.heading, record.events[:events], record.scenarios[:scenarios], entries)
    whole = bytearray(encoded(part))
    for _ in range(data.draw(st.integers(1, 3))):
        at = data.draw(st.integers(0, len(whole) - 1))
        whole[at : at + data.draw(st.integers(0, 3))] = data.draw(
            st.sampled_from([b"", b"0", b"1", b"9", b"\xed\xa0\x80", b'"', b"{"])
        )
    with suppress(RecordError):
        assert conformant.judged(decoded(bytes(whole))).problems, "a part of a record is no record"


def test_events_that_are_edited_within_the_schema_give_no_traceback(conformant: Run) -> None:
    """Lists of events are rotated: hosts can be made to say anything. The series is as it was, so that the run goes on."""
    entries = [
        msgspec.structs.replace(e, events=(*e.events[1:], e.events[0]))
        if isinstance(e, r.Answered) and e.events and e.name != "destroy-frees"
        else e
        for e in conformant.record.entries
    ]
    again = conformant.judged(msgspec.structs.replace(conformant.record, entries=tuple(entries)))
    assert len(again.problems) > 10
    assert any(one.endswith("more of this kind") for one in again.problems)


@pytest.mark.slow
def test_a_whole_run_of_a_profile_is_judged_again() -> None:
    plan = plan_of("reference-py", drawn=50)
    purposes = some_purposes(plan, every=1)
    report, record = recorded("reference-py", plan, purposes)
    again = judge_again(record, plan)
    assert again.problems == ()
    assert without_clock(again.report) == without_clock(report)
    assert report.verdict == "conformant"
