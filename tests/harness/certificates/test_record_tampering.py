"""A record that was changed is refused, with the reason, and nothing else of it is accused."""

from __future__ import annotations

import itertools
import subprocess
import sys
from collections.abc import Iterator
from contextlib import suppress
from typing import Any

import msgspec
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from judged_runs import (
    Change,
    Run,
    answers,
    cut,
    edit,
    exchange,
    later,
    place,
    with_trace_of,
)
from recorded_runs import recorded, some_purposes

from ucm_cts.harness.execution import record as r
from ucm_cts.harness.execution.recording import Record, RecordError, decoded, encoded

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
