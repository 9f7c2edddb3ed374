"""Expected against observed: two diagrams of one failure, equal up to the fault."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from ucm_cts.adapters.contract.trace import Call, Raise, Return
from ucm_cts.harness.report.diagrams.sequence import TEST, Diagram, Line, LineKind, find_lane, lay_out
from ucm_cts.harness.results.foreign import one_line
from ucm_cts.harness.results.values import Execution
from ucm_cts.reference_models.findings import Arrow, Finding

SHORT = 26
"""Up to so many lines a diagram is shown whole."""

BEFORE, AFTER = 9, 2
"""In longer ones, how many lines around an offending one stay."""

TAIL = 16
"""Of an execution that ended in an incident, so many of the last lines are shown."""

SUSPECTS = 12
"""So many offending lines at most are shown."""


@dataclass(frozen=True)
class Comparison:
    """What was observed, with the offending lines marked, and what should have been there instead."""

    observed: Diagram
    expected: Diagram


def compare(finding: Finding, execution: Execution) -> Comparison:
    """The two diagrams of a failure, cut down to what a reader needs."""
    whole = lay_out(execution, finding.events)
    lines = list(whole.lines)
    first = next((i for i, line in enumerate(lines) if line.style == "offending" and line.kind != "end"), None)
    if first is None:
        # an event is missing, so the place where it is due is marked
        first = _place_of_step(finding, execution, lines)
        lines.insert(first, _missing(finding, whole))
    asked = lines[first].source
    expected = [_expected(arrow, whole, asked) for arrow in finding.expected_events] or [
        Line("note", TEST, TEST, one_line(finding.expected, 90), style="expected")
    ]
    kept = _kept(lines)
    # a call of the test is no fault; only its consequences differ
    parting = (
        first + 1 if _asked(lines[first]) and (expected[0].source != TEST or expected[0].kind == "note") else first
    )
    prefix = {i for i in kept if i < parting}
    before = [replace(line, style="normal") if i == first else line for i, line in enumerate(lines)]
    lanes = replace(whole, lines=tuple(lines))
    return Comparison(
        replace(lanes, lines=_elide(lines, kept, len(lines))).without_idle_lanes(*expected),
        replace(lanes, lines=(*_elide(before, prefix, parting), *expected)).without_idle_lanes(
            *(lines[i] for i in kept), *expected
        ),
    )


def excerpt(execution: Execution, longest: int = TAIL) -> Diagram:
    """The diagram of the end of an execution, before a crash or a hang."""
    whole = lay_out(execution)
    lines = list(whole.lines)
    start = max(0, len(lines) - longest)
    start = next((i for i in range(start, len(lines)) if _asked(lines[i])), start) if start else 0
    kept = set(range(start, len(lines)))
    return replace(whole, lines=_elide(lines, kept, len(lines))).without_idle_lanes()


def _missing(finding: Finding, diagram: Diagram) -> Line:
    wanted = finding.expected_events[0] if finding.expected_events else None
    where = find_lane(wanted.source, diagram.lanes) if wanted else None
    label = one_line(f"missing: {wanted.label if wanted else finding.expected}", 70)
    return Line("note", where or TEST, where or TEST, label, style="offending")


def _expected(arrow: Arrow, diagram: Diagram, asked: str) -> Line:
    """An expected event as a line; where the diagram lacks a lane, the caller's lane takes its place."""
    source, target = find_lane(arrow.source, diagram.lanes) or asked, find_lane(arrow.target, diagram.lanes) or asked
    kind: LineKind = "answer" if target == TEST or arrow.label.startswith(("return", "raise", "result")) else "call"
    return Line(kind, source, target, one_line(arrow.label, 90), style="expected")


def _place_of_step(finding: Finding, execution: Execution, lines: Sequence[Line]) -> int:
    ends = {e.n for e in execution.trace if isinstance(e, Return | Raise) and e.step == finding.step}
    calls = {e.n for e in execution.trace if isinstance(e, Call) and e.step == finding.step}
    for index, line in enumerate(lines):
        if ends.intersection(line.events):
            return index + 1 if calls.intersection(line.events) else index
    end = len(lines)
    return end - 1 if lines and lines[-1].kind == "end" else end


def _kept(lines: Sequence[Line]) -> set[int]:
    if len(lines) <= SHORT:
        return set(range(len(lines)))
    suspects = [i for i, line in enumerate(lines) if line.style == "offending"]
    suspects = suspects[: SUSPECTS - 2] + suspects[-2:] if len(suspects) > SUSPECTS else suspects
    start = max(0, suspects[0] - BEFORE)
    # begin with a call of the test, if there is one near, so that no answer stands without its question
    start = next((i for i in range(start, max(-1, start - BEFORE), -1) if _asked(lines[i])), start)
    kept = set(range(start, min(len(lines), suspects[0] + AFTER + 1)))
    for suspect in suspects[1:]:
        kept.update(i for i in range(suspect - 1, suspect + AFTER) if 0 <= i < len(lines))
    return kept


def _asked(line: Line) -> bool:
    return line.kind == "call" and line.source == TEST


def _elide(lines: Sequence[Line], kept: set[int], end: int) -> tuple[Line, ...]:
    """The kept lines before ``end``, with a gap that counts the events wherever some were left out."""
    shown: list[Line] = []
    gone = 0
    for index in range(end + 1):
        if index < end and index not in kept:
            gone += max(1, len(lines[index].events))
            continue
        if gone:
            shown.append(Line("gap", TEST, TEST, f"{gone} events not shown"))
            gone = 0
        if index < end:
            shown.append(lines[index])
    return tuple(shown)
