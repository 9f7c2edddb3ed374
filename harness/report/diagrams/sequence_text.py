"""Sequence diagrams as text: lanes to the left, words to the right, for terminals and CI logs."""

from __future__ import annotations

import shlex
import textwrap
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from ucm_cts.harness.report.diagrams.excerpt import Comparison, compare
from ucm_cts.harness.report.diagrams.sequence import Diagram, Line, lay_out
from ucm_cts.harness.results.foreign import LONGEST_STACKS, clean, one_line
from ucm_cts.harness.results.values import Execution
from ucm_cts.reference_models.findings import Finding

WIDTH = 110
"""Columns of a diagram, by default."""

NARROW = 8
"""Lanes closer together than that get letters for names."""

SHARED = 4
"""How many lines that both diagrams share are repeated."""

_MARKS = {"normal": " ", "offending": "✗", "expected": "✓"}


def replay_text(execution: Execution, findings: Sequence[Finding] = (), width: int = WIDTH) -> str:
    """A whole execution as text, with the offending lines of ``findings`` marked."""
    return to_text(lay_out(execution, [event for finding in findings for event in finding.events]), width)


def failure_text(finding: Finding, execution: Execution, width: int = WIDTH) -> str:
    """Both diagrams of a failure, one below the other; the second begins shortly before they part."""
    both = compare(finding, execution)
    return f"observed\n{to_text(both.observed, width)}\n\n{_expected_text(both, width)}"


def finding_text(finding: Finding, title: str, execution: Execution, width: int = WIDTH) -> str:
    """What ``finding`` says below a whole ``execution``: its requirement with its ``title``, its rule, and what was expected."""
    where = f", at {', '.join(map(str, finding.events))}" if finding.events else ""
    rows = [
        f"✗ {finding.requirement}  {one_line(title)} (rule {finding.rule}{where})",
        f"  expected  {one_line(finding.expected, 300)}",
        f"  observed  {one_line(finding.observed, 300)}",
    ]
    return "\n".join([*rows, "", _expected_text(compare(finding, execution), width)])


def _expected_text(both: Comparison, width: int) -> str:
    shared = next((i for i, line in enumerate(both.expected.lines) if line.style == "expected"), 0)
    start = max(0, shared - SHARED)
    again = replace(both.expected, lines=both.expected.lines[start:])
    return f"{'expected instead' if start else 'expected'}\n{to_text(again, width)}"


def to_text(diagram: Diagram, width: int = WIDTH) -> str:
    """A diagram as plain monospaced text, at most ``width`` columns wide."""
    numbers = max((len(str(n)) for line in diagram.lines for n in line.events[:1]), default=1)
    gutter = 2 + numbers + (4 if diagram.threads else 0) + 2
    widest = (width * 3 // 5 - gutter) // max(1, len(diagram.lanes))
    narrow = widest < NARROW
    heads = [
        _letter(i) if narrow else one_line(lane.label, min(17, widest - 1)) for i, lane in enumerate(diagram.lanes)
    ]
    gaps = [max(3, widest) if narrow else max(5, len(head) + 2) for head in heads]
    columns = {lane.key: sum(gaps[:i]) for i, lane in enumerate(diagram.lanes)}
    end = sum(gaps)
    words = max(16, width - gutter - end - 1)
    rows = []
    if narrow:
        named = ", ".join(f"{head} {lane.label}" for head, lane in zip(heads, diagram.lanes, strict=True))
        rows += textwrap.wrap(named, width - 2, initial_indent="  ", subsequent_indent="  ")
    rows.append(" " * gutter + "".join(head.ljust(gap) for head, gap in zip(heads, gaps, strict=True)))
    for line in diagram.lines:
        head = f"{_MARKS[line.style]} {str(line.events[0]) if line.events else '':>{numbers}}"
        if diagram.threads:
            head += f" t{line.thread:<2}" if line.events else "    "
        rows.append(f"{head}  {_drawn(line, columns, end)} {one_line(_words(line), words)}")
    return "\n".join(row[:width].rstrip() for row in rows)


def printed_text(printed: str, file: Path, adapter: str) -> str:
    """What a host printed while the scenario in ``file`` ran on ``adapter``, and how to debug it if it asked for a debugger."""
    lines = [f"  | {one_line(line)}" for line in clean(printed, LONGEST_STACKS).strip().splitlines()]
    hint = f"debug it with: ucm-cts replay {shlex.quote(str(file))} {shlex.quote(adapter)} --in-process"
    asked = any(word in printed for word in ("breakpoint() at ", "(Pdb)", "bdb.BdbQuit"))
    return "\n".join(["", "printed by the host", *lines, *([hint] if asked else [])])


def _letter(number: int) -> str:
    return chr(ord("A") + number) if number < 26 else str(number)


def _words(line: Line) -> str:
    match line.kind:
        case "gap":
            return f"… {line.label}"
        case "note":
            return f"• {line.label}"
        case "end":
            return f"ended by {line.label}"
        case _:
            return line.label


def _drawn(line: Line, columns: dict[str, int], end: int) -> str:
    """The lanes' part of one row."""
    if line.kind == "end":
        return "═" * end
    cells = [" "] * end
    for column in columns.values():
        cells[column] = "┊" if line.kind == "gap" else "│"
    source, target = columns.get(line.source, 0), columns.get(line.target)
    if line.kind == "gap":
        return "".join(cells)
    if line.kind == "note":
        cells[source] = "●"
        return "".join(cells)
    if target is None:
        _put(cells, source, "├──▷")
        return "".join(cells)
    if target == source:
        _put(cells, source, "├─┐" if line.kind == "call" else "◀─┘")
        return "".join(cells)
    left, right = min(source, target), max(source, target)
    stroke = "╌" if line.kind == "answer" else "─"
    for column in range(left + 1, right):
        cells[column] = stroke if cells[column] == " " else "┼" if stroke == "─" else cells[column]
    if target > source:
        cells[left], cells[right - 1] = "├", "▶"
    else:
        cells[left + 1], cells[right] = "◀", "┤"
    return "".join(cells)


def _put(cells: list[str], at: int, drawing: Sequence[str]) -> None:
    for offset, cell in enumerate(drawing):
        if at + offset < len(cells):
            cells[at + offset] = cell
