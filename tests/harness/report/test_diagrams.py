"""Sequence diagrams of observed and expected events."""

from __future__ import annotations

import random
import re
import typing
from typing import Any

import msgspec
from lxml import etree
from made_up_run import (
    API,
    COMPONENTS,
    HOSTILE,
    STEPS,
    Tape,
    crash,
    lost_call,
    missing,
    refused_stop,
    wrong_error,
)

from ucm_cts.adapters.contract.scenario import AddComponent, Scenario, Start, Step
from ucm_cts.adapters.contract.trace import Call, Create, Dependency, Event, LogRecord, Return
from ucm_cts.harness.report.diagrams import sequence, sequence_svg
from ucm_cts.harness.report.diagrams.excerpt import compare
from ucm_cts.harness.report.diagrams.sequence_text import failure_text, replay_text
from ucm_cts.harness.results.values import Execution, Incident
from ucm_cts.reference_models.findings import Arrow, Finding


def test_a_known_trace_becomes_this_text() -> None:
    failed = wrong_error()
    finding = msgspec.structs.replace(failed.finding, observed="no")
    trace = (*failed.execution.trace[:-1], msgspec.structs.replace(failed.execution.trace[-1], detail="KeyError: 99"))
    text = failure_text(finding, msgspec.structs.replace(failed.execution, trace=trace))
    assert text.splitlines() == [
        "observed",
        "     test  manager  provider",
        "  1  ├────▶│        │          add_component provider",
        "  2  │     ├───────▶│          create",
        "  3  │     ├───────▶│          on_init()",
        "  5  │◀╌╌╌╌┤        │          returns 1",
        "  6  ├────▶│        │          remove_component unknown",
        "✗ 7  │◀╌╌╌╌┤        │          raises an undeclared exception: KeyError: 99",
        "",
        "expected instead",
        "     test  manager  provider",
        "  2  │     ├───────▶│          create",
        "  3  │     ├───────▶│          on_init()",
        "  5  │◀╌╌╌╌┤        │          returns 1",
        "  6  ├────▶│        │          remove_component unknown",
        "✓    │◀╌╌╌╌┤        │          raises NOT_FOUND",
    ]


def test_calls_between_bodies_name_both_port_elements_and_the_result() -> None:
    diagram = sequence.lay_out(lost_call(1).execution)
    labels = {line.label: (line.source, line.target) for line in diagram.lines}
    assert labels["connect client.out_api → provider.in_api"] == ("test", "manager")
    assert labels["on_connect(out_api, provider.in_api)"] == ("manager", "client#1")
    assert labels["on_startup(out_api → provider.in_api)"] == ("manager", "client#1")
    assert labels["invoke client.in_go exchange(0)"] == ("test", "client#1")
    assert labels["exchange(0) out_api → in_api ⇒ -1"] == ("client#1", "provider#1")


def test_every_event_is_on_exactly_one_line() -> None:
    for failed in (refused_stop(), wrong_error(), lost_call(3)):
        lines = sequence.lay_out(failed.execution, failed.finding.events).lines
        assert sorted(n for line in lines for n in line.events) == [event.n for event in failed.execution.trace]


def test_a_trace_cut_off_by_a_crash_ends_with_the_incident_and_names_the_last_call() -> None:
    execution = crash().execution
    text = replay_text(execution).splitlines()
    assert text[-1].startswith("✗")
    assert text[-1].endswith("ended by crash: signal 11 (SIGSEGV)")
    assert " t3 " in text[-2]
    assert "exchange(7) through out_api" in text[-2]
    assert sequence.last_call(execution) == "invoke client.in_go exchange(7)"


def test_long_traces_are_elided_visibly_and_both_diagrams_share_their_beginning() -> None:
    failed = lost_call(80)
    both = compare(failed.finding, failed.execution)
    assert both.observed.lines[0].kind == both.expected.lines[0].kind == "gap"
    assert re.fullmatch(r"\d+ events not shown", both.observed.lines[0].label)
    assert len(both.observed.lines) < 40
    first = next(i for i, line in enumerate(both.observed.lines) if line.style == "offending")
    assert both.observed.lines[:first] == both.expected.lines[:first]
    assert {line.style for line in both.expected.lines[first:]} == {"expected"}


def test_missing_event_is_marked_at_its_place() -> None:
    failed = missing()
    both = compare(failed.finding, failed.execution)
    at = next(i for i, line in enumerate(both.observed.lines) if line.style == "offending")
    assert both.observed.lines[at].label == "missing: on_shutdown()"
    assert both.observed.lines[at + 1].label == "returns"


def test_a_hang_expects_an_end_of_the_call_and_instances_have_the_names_of_findings() -> None:
    steps: tuple[Step, ...] = (
        AddComponent(component="client"),
        AddComponent(component="client", bind="other"),
        Start(),
    )
    tape = Tape()
    for instance in (1, 2):
        tape.put(Call, step=instance - 1)
        tape.put(Create, component="client", instance=instance)
        tape.put(Return, step=instance - 1, value=instance)
    tape.put(Call, step=2)
    execution = Execution("hang", Scenario(COMPONENTS, steps), tape.trace(), Incident("hang", "silent"))
    finding = Finding("R", "r", "c", "start returns or raises UCM_ERROR", "start did not end", (7,), 2)
    both = compare(finding, execution)
    assert [line.label for line in both.observed.lines[-2:]] == ["start", "hang: silent"]
    assert [(line.label, line.style) for line in both.expected.lines[-2:]] == [
        ("start", "normal"),
        ("start returns or raises UCM_ERROR", "expected"),
    ]
    assert [lane.label for lane in both.observed.lanes] == ["test", "manager", "client", "client#2"]
    named = msgspec.structs.replace(finding, expected_events=(Arrow("caller", "client#2", "exchange"),))
    assert (line := compare(named, execution).expected.lines[-1]).target == "client#2"
    assert line.source == "test"


def test_text_is_at_most_110_columns_wide_with_many_lanes() -> None:
    steps = tuple(AddComponent(component=f"a-component-with-a-long-name-{i}") for i in range(12))
    tape = Tape()
    for i in range(12):
        tape.put(Call, step=i)
        tape.put(Create, component=f"a-component-with-a-long-name-{i}", instance=1)
        tape.put(Return, step=i, value=i)
    text = replay_text(Execution("wide", Scenario({}, steps), tape.trace()))
    assert max(map(len, text.splitlines())) <= 110


_COUNTS = {
    "first",
    "count",
    "received",
    "distinct",
    "disordered",
    "least",
    "greatest",
    "calendar",
    "calls",
    "failed",
} | {
    "overlaps",
    "control_calls",
    "control_overlaps",
}


def test_no_trace_however_absurd_breaks_a_diagram() -> None:
    kinds: tuple[Any, ...] = typing.get_args(Event)
    values: dict[str, list[Any]] = {
        "thread": [0, 0, 1, 2],
        "step": [0, 3, 6, 99, -1],
        "component": ["provider", "client", "odd#1", HOSTILE],
        "instance": [1, 1, 2],
        "hook": ["on_init", "on_startup", "on_connect", "exchange", "run", "method"],
        "where": ["done", "held", "blocked", "running"],
        "error": ["NOT_FOUND", "UNDECLARED"],
        **{name: ["in_api", "out_api", "g", HOSTILE] for name in ("port", "gate", "variable", "detail", "worker")},
        "value": [None, 7],
        "reference": [None, "opaque", API],
        "dependencies": [None, (Dependency(port="out_api", references=(None, "opaque", API)),)],
        "attributes": [None, {"a": HOSTILE}],
        "raised": [False, True],
        "wrong": ["", HOSTILE],
        "ids": [(), (1, 2)],
        "method": [None, "push", HOSTILE],
        "exception": [None, HOSTILE],
        **{name: [None, (), (1, [HOSTILE], True)] for name in ("arguments", "results")},
        "records": [None, (), (LogRecord("info", HOSTILE),)],
        "answers": [{}, {HOSTILE: 3}],
        "handler": [None, HOSTILE],
        "timer": [None, 1, -1],
        **{name: [0, 5, -1] for name in _COUNTS},
    }
    for seed in range(200):
        chance = random.Random(seed)
        trace = []
        for n in range(1, 60):
            kind = chance.choice(kinds)
            fields = {name: chance.choice(values[name]) for name in kind.__struct_fields__ if name not in ("n", "t")}
            trace.append(kind(n=n, t=n, **fields))
        execution = Execution("soup", Scenario(COMPONENTS, STEPS), tuple(trace), crash().incident)
        suspects = tuple(chance.sample(range(1, 60), chance.choice([0, 1, 30])))
        finding = Finding(
            "R", "r", "c", "e", "o", suspects, chance.choice([None, 3]), (Arrow("client", "nobody", "x"),)
        )
        both = compare(finding, execution)
        assert max(map(len, failure_text(finding, execution).splitlines())) <= 110
        for diagram in (both.observed, both.expected):
            etree.fromstring(sequence_svg.to_svg(diagram, "soup"))
        assert sorted(n for line in sequence.lay_out(execution).lines for n in line.events) == list(range(1, 60))
