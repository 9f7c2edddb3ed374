"""Prints the result of an exploration, for people and for machines."""

from __future__ import annotations

import shlex
from collections.abc import Sequence
from pathlib import Path

import msgspec
from rich.console import Group, RenderableType
from rich.text import Text

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.exploring.exploration import Fate, Progress, Replayed
from ucm_cts.harness.exploring.memory import Remembered, mishaps
from ucm_cts.harness.report.summary import cut
from ucm_cts.harness.results import values as v
from ucm_cts.harness.results.failures import file_name, incident_file, replay_command, shortest_first
from ucm_cts.harness.results.foreign import clean_report, one_line
from ucm_cts.harness.results.incident_causes import cause_of_incident, during
from ucm_cts.harness.results.incidents import is_waiting
from ucm_cts.reference_models.findings import Finding

FILE = "exploration.json"

SHOWN = 20
"""How many failures, and how many incidents, the terminal shows; the file has all."""

_COLOURS: dict[Fate, str] = {"still there": "red", "no longer shown": "green", "unknown": "yellow"}

_STEPS = 12
"""How many steps of the shortest scenario the terminal shows."""


class Failure(Value, frozen=True):
    """One cause of failure.

    ``requirement``: its id.
    ``clause``: its clause.
    ``title``: its title.
    ``rule``: the property that found it.
    ``cause``: what failures of one cause share.
    ``expected``: one sentence.
    ``observed``: one sentence.
    ``occurrences``: scenarios that showed it.
    ``steps``: of the shortest scenario.
    ``file``: the shortest scenario, relative to the folder.
    ``replay``: a command that runs it, in the folder.
    ``unstable``: why it gives no verdict; empty if it was confirmed.
    """

    requirement: str
    clause: str
    title: str
    rule: str
    cause: str
    expected: str
    observed: str
    occurrences: int
    steps: tuple[str, ...]
    file: str
    replay: str
    unstable: str = ""


class Mishap(Value, frozen=True):
    """One cause of incidents: the shortest scenario that met it, and how often it was met."""

    kind: str
    detail: str
    operation: str
    occurrences: int
    steps: tuple[str, ...]
    file: str
    replay: str


class Known(Value, frozen=True):
    """A remembered failure, or the ``kind`` of a remembered incident, and whether it is still there; null if unknown."""

    requirement: str
    kind: str
    cause: str
    still_there: bool | None


class Found(Value, frozen=True):
    """All that one exploration says."""

    product: str
    version: str
    adapter: str
    profile: str
    suite_version: str
    seed: int
    seconds: float
    scenarios: int
    rows_visited: int
    rows: int
    pairs_of_events: int
    failures: tuple[Failure, ...]
    incidents: tuple[Mishap, ...]
    known: tuple[Known, ...]


def is_found(report: v.FrameworkReport) -> bool:
    """Whether anything failed, or hung where waiting for ever is not permitted."""
    return bool(mishaps(report)) or any(result.verdict == "fail" and result.decides for result in report.requirements)


def exploration_file(report: v.FrameworkReport, far: Progress, known: Sequence[Replayed]) -> bytes:
    """``exploration.json``."""
    content = msgspec.json.encode(_found(clean_report(report), far, known))
    return msgspec.json.format(content, indent=2) + b"\n"


def _found(report: v.FrameworkReport, far: Progress, known: Sequence[Replayed]) -> Found:
    return Found(
        report.product,
        report.version,
        report.adapter,
        report.profile,
        report.suite_version,
        report.seed,
        report.seconds,
        far.scenarios,
        far.rows,
        far.of,
        far.events,
        _failures(report),
        tuple(_mishap(report, number, item) for number, item in enumerate(report.incidents)),
        tuple(map(_known, known)),
    )


def _mishap(report: v.FrameworkReport, number: int, item: v.IncidentReport) -> Mishap:
    cause, file = cause_of_incident(item.execution), incident_file(number)
    fields = item.incident.kind, item.incident.detail, cause.operation, item.occurrences, _steps(item.execution)
    return Mishap(*fields, file, replay_command(file, report))


def _known(replayed: Replayed) -> Known:
    one = replayed.remembered
    is_there = {"still there": True, "no longer shown": False}.get(replayed.fate)
    return Known(one.requirement, "" if one.requirement else one.rule, one.cause, is_there)


def _failures(report: v.FrameworkReport) -> tuple[Failure, ...]:
    return tuple(
        _failure(report, result, number, failed)
        for result in report.requirements
        for number, failed in enumerate(shortest_first(result.findings))
    )


def _failure(report: v.FrameworkReport, result: v.RequirementResult, number: int, failed: v.ReportedFinding) -> Failure:
    finding, file = failed.finding, file_name(result.id, number)
    fields = result.id, result.clause, result.title, finding.rule, finding.cause, finding.expected, finding.observed
    steps = _steps(failed.execution) if failed.execution is not None else ()
    return Failure(*fields, failed.occurrences, steps, file, replay_command(file, report), failed.unstable)


def _steps(execution: v.Execution) -> tuple[str, ...]:
    return tuple(s.operation(step) for step in execution.scenario.steps)


def known_text(known: Sequence[Replayed], unreadable: int) -> RenderableType:
    """The fate of the remembered failures."""
    lines = [
        Text.assemble((f"{k.fate:15}  ", _COLOURS[k.fate]), f"{_name(k.remembered)}  {one_line(_observed(k), 200)}")
        for k in known
    ]
    if unreadable:
        lines.append(Text(f"{unreadable} remembered failures cannot be read by this version and are left alone", "dim"))
    return Group(*map(cut, lines))


def _name(one: Remembered) -> str:
    return one.requirement or one.rule


def _observed(replayed: Replayed) -> str:
    incident = replayed.remembered.incident
    return replayed.remembered.observed + (during(incident) if incident is not None else "")


def seen_text(finding: Finding | None, execution: v.Execution) -> RenderableType:
    """A failure when it is first seen, before it is confirmed and shortened."""
    head = Text.assemble(("seen  ", "yellow"), f"in '{execution.name}'")
    lines = [head]
    if finding is not None:
        head.append(f"  {finding.requirement}", "bold")
        lines += _lines_of_finding(finding.expected, finding.observed)
    elif execution.incident is not None:
        head.append(f"  {execution.incident.kind}: {one_line(execution.incident.detail, 160)}")
    return Group(*map(cut, lines))


def found_text(report: v.FrameworkReport, far: Progress, out: Path) -> RenderableType:
    """The end of an exploration: how much was run, then each cause of failure in a few lines."""
    failures = _failures(report)
    confirmed = [failure for failure in failures if not failure.unstable]
    incidents = mishaps(report)
    found = f"{len(confirmed)} causes of failure" if confirmed else "nothing found"
    if incidents:
        found = f"{len(confirmed)} causes of failure, {len(incidents)} of incidents"
    left_out = sum(item.occurrences for item in report.incidents if item.incident.kind == "untried")
    drawn = f"{far.scenarios} scenarios{f' ({left_out} not tried)' if left_out else ''}"
    covered = f"{far.rows} of {far.of} rows of the life-cycle table, {far.events} pairs of events"
    lines = [
        Text.assemble(
            (("✗ " if is_found(report) else "✓ ") + found, "bold red" if is_found(report) else "bold green"),
            f"  in {drawn}: {covered}",
        )
    ]
    for failure in confirmed[:SHOWN]:
        lines += [Text(), *_lines_of(failure, report, out)]
    if len(confirmed) > SHOWN:
        lines += [Text(), Text(f"and {len(confirmed) - SHOWN} more causes of failure")]
    lines += [
        cut(Text.assemble(("? ", "yellow"), (f.requirement, "bold"), f"  {one_line(f.unstable, 300)}"))
        for f in failures
        if f.unstable
    ][:SHOWN]
    if incidents:
        lines.append(Text())
    for number, item in incidents[:SHOWN]:
        often = f"{item.occurrences} times" if item.occurrences > 1 else "once"
        what = f"{one_line(item.incident.detail, 160)}{during(cause_of_incident(item.execution))}"
        text = f"  {often}  {incident_file(number)}  {what}"
        lines.append(cut(Text.assemble(("⚡ ", "magenta"), (item.incident.kind, "bold magenta"), text)))
    if len(incidents) > SHOWN:
        lines.append(Text(f"and {len(incidents) - SHOWN} more causes of incidents"))
    waiting = sum(item.occurrences for item in report.incidents if is_waiting(item.execution))
    if waiting:
        lines.append(
            Text(f"{waiting} scenarios hung in calls that may wait for a component to be started: no failure", "dim")
        )
    lines += [Text(f"warning: {one_line(warning, 600)}", "yellow") for warning in report.warnings]
    if failures or incidents:
        lines += [Text(), Text.assemble("all     ", (str(out / FILE), "bold"), overflow="fold")]
    return Group(*lines)


def _lines_of(failure: Failure, report: v.FrameworkReport, out: Path) -> list[Text]:
    steps = ", ".join(failure.steps[:_STEPS]) + (", ..." if len(failure.steps) > _STEPS else "")
    statement = f" --ics {shlex.quote(str(out / 'failures' / 'ics.toml'))}" if report.statement.source else ""
    replay = f"ucm-cts replay {shlex.quote(str(out / failure.file))} {shlex.quote(one_line(report.adapter))}{statement}"
    return [
        cut(Text.assemble(("✗ ", "red"), (failure.requirement, "bold"), f"  {one_line(failure.title)}")),
        *map(cut, _lines_of_finding(failure.expected, failure.observed)),
        cut(Text.assemble(("  shortest  ", "dim"), f"{len(failure.steps)} steps: {steps}")),
        Text.assemble(("  replay    ", "dim"), replay, overflow="fold"),
    ]


def _lines_of_finding(expected: str, observed: str) -> list[Text]:
    return [
        Text.assemble(("  expected  ", "green"), one_line(expected, 300)),
        Text.assemble(("  observed  ", "red"), one_line(observed, 300)),
    ]
