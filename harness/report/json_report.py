"""``report.json``: the report for machines, flat, in a stable order of keys, with a schema made from the same types."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Final, Literal, Self

import msgspec

from ucm_cts.adapters.contract.json_schema import schema_of
from ucm_cts.adapters.contract.trace import Event
from ucm_cts.harness.catalogue.requirements import Level, Requirement, requirements_of
from ucm_cts.harness.report.scope import Scope, scope_of
from ucm_cts.harness.results import values as v
from ucm_cts.harness.results.failures import file_name, incident_file, shortest_first
from ucm_cts.harness.results.foreign import clean_report

SCHEMA_FILE = "report.schema.json"

SCHEMA_VERSION: Final = 2
"""Of ``report.json``. It changes with every field; readers refuse reports of other versions. Version 1 did not name itself."""

EVENTS = 50
"""The most events of one finding that are written; a replay of the saved scenario shows all."""

TRACE = 500
"""The number of events that are written of the end of an unstable finding's trace."""

OUTPUT = 4_000
"""The most characters that are written of what a command printed."""


class Entry(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Base of the values of ``report.json``: every field is always there."""

    @classmethod
    def of(cls, source: object, **others: Any) -> Self:
        """Takes the fields that ``source`` has under the same name, and ``others`` as they are given."""
        same = {
            name: getattr(source, name)
            for name in cls.__struct_fields__
            if name not in others and hasattr(source, name)
        }
        return cls(**same, **others)


class FindingEntry(Entry, frozen=True):
    """One cause of failure.

    ``occurrences`` counts the executions that show it. ``waived`` says why it was expected, empty if it was not.
    ``unstable`` says why it does not count, empty if it counts.
    ``scenario`` is the scenario or, for a tool chain, the model; empty where nothing was run.
    ``events`` are those that break the requirement. ``replay`` is the file that repeats the scenario, empty where nothing was run.
    ``model`` is the file of a tool chain's model, ``command`` the command that was given it, ``status`` its exit status,
    ``output`` what it printed, and ``place`` the wrong place in a generated file.
    ``trace`` is a trace of an unstable finding, ``steady`` one of the same scenario without the finding, if there is one.
    ``explains``: other requirements that were broken after it in the same scenarios.
    """

    rule: str
    expected: str
    observed: str
    occurrences: int
    waived: str
    unstable: str
    scenario: str
    events: tuple[Event, ...]
    replay: str
    model: str = ""
    command: tuple[str, ...] = ()
    status: int | None = None
    output: str = ""
    place: str = ""
    trace: tuple[Event, ...] = ()
    steady: tuple[Event, ...] = ()
    explains: tuple[str, ...] = ()


class RequirementEntry(Entry, frozen=True):
    """One requirement of the catalogue with its verdict.

    ``caused_by`` is a requirement from whose violation all its failures may follow, empty if there is none.
    ``decides``: whether it decides the verdict of the run; a recommendation (level ``should``) does not.
    ``derived``: why it holds although the text does not say it; empty if the text says it.
    ``seconds`` were spent on scenarios that are to exercise it.
    """

    id: str
    clause: str
    title: str
    level: Level
    verdict: v.Verdict
    exercised: int
    reason: str
    findings: tuple[FindingEntry, ...]
    caused_by: str = ""
    decides: bool = True
    derived: str = ""
    seconds: float = 0.0


class IncidentEntry(Entry, frozen=True):
    """A cause for which scenarios broke the framework's host.

    ``occurrences`` counts the scenarios, ``scenario`` is the shortest one, ``requirements`` are those that they were to exercise.
    """

    kind: str
    detail: str
    stacks: str
    reproduced: bool
    scenario: str
    replay: str
    occurrences: int = 1
    requirements: tuple[str, ...] = ()


class TransitionEntry(Entry, frozen=True):
    """One row of the life-cycle table."""

    row: str
    exercised: int
    violated: int
    readings: tuple[str, ...]


class StatementEntry(Entry, frozen=True):
    """What the vendor states; ``source`` is the file's name, empty if there was no file and defaults hold."""

    source: str
    product: str
    version: str
    profiles: tuple[str, ...]
    capabilities: dict[str, bool]
    readings: dict[str, str]
    ixit: dict[str, float]
    models: tuple[str, ...]


class ReportEntry(Entry, frozen=True, kw_only=True):
    """The whole of ``report.json``.

    ``schema_version`` is that of this schema. ``scope`` says what the verdict is about.
    ``incomplete`` says why the run ended before its end, empty if it did not. ``selection`` is what ``-k`` selected,
    empty after a run of everything. ``isolation`` says where the product's code ran: ``bubblewrap``, in a sandbox; ``process``, in
    processes beside the harness; ``none``, in its own; ``remote``, behind a socket. ``adapter_file`` is the file that the adapter was loaded from, and ``warnings`` are
    what its vendor should know of it.
    """

    schema_version: Literal[2] = SCHEMA_VERSION
    product: str
    version: str
    profile: str
    verdict: v.Overall
    scope: Scope
    requirements: tuple[RequirementEntry, ...]
    incidents: tuple[IncidentEntry, ...]
    transitions: tuple[TransitionEntry, ...]
    adapter: str
    suite_version: str
    seed: int
    started: str
    seconds: float
    scenarios: int
    events: int
    statement: StatementEntry
    readings: dict[str, tuple[str, ...]]
    measures: dict[str, int]
    seconds_by_clause: dict[str, float]
    runs: int
    incomplete: str = ""
    selection: str = ""
    isolation: v.Isolation = "process"
    adapter_file: str = ""
    warnings: tuple[str, ...] = ()
    provoked: dict[str, int] = {}


def to_json(report: v.Report, catalogue: Sequence[Requirement]) -> bytes:
    """``report.json``, indented, ending with a newline. The report must be clean (``foreign.clean_report``)."""
    known = {requirement.id: requirement for requirement in catalogue}
    entry = ReportEntry.of(
        report,
        scope=scope_of(report, catalogue),
        requirements=tuple(_requirement(result, known) for result in report.requirements),
        statement=StatementEntry.of(report.statement),
        measures=report.effort.measures,
        seconds_by_clause=report.effort.seconds,
        **_body(report),
    )
    return msgspec.json.format(msgspec.json.encode(entry), indent=2) + b"\n"


def entry_of(report: v.Report) -> ReportEntry:
    """``report.json`` of ``report``, as a value."""
    content = to_json(clean_report(report), requirements_of(report.profile))
    return msgspec.json.decode(content, type=ReportEntry)


def _body(report: v.Report) -> dict[str, Any]:
    """What differs between products. For a tool chain ``scenarios`` are models and ``events`` are facts."""
    if isinstance(report, v.FrameworkReport):
        return {
            "incidents": tuple(
                IncidentEntry.of(
                    item.incident,
                    scenario=item.execution.name,
                    replay=incident_file(number),
                    occurrences=item.occurrences,
                    requirements=item.requirements,
                )
                for number, item in enumerate(report.incidents)
            ),
            "transitions": tuple(map(TransitionEntry.of, report.transitions)),
        }
    assert isinstance(report, v.ToolChainReport)
    counts = {"scenarios": report.models, "events": report.facts, "runs": 1}
    return {"incidents": (), "transitions": (), "readings": {}, "provoked": {}, **counts}


def schema() -> dict[str, Any]:
    """JSON Schema of ``report.json``."""
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "$id": f"urn:ucm-cts:schema:report:{SCHEMA_VERSION}",
        "title": "UCM-CTS conformance report",
        **schema_of(ReportEntry),
    }


def _requirement(result: v.RequirementResult, known: Mapping[str, Requirement]) -> RequirementEntry:
    findings = enumerate(shortest_first(result.findings))
    return RequirementEntry.of(
        result,
        derived=known[result.id].derived if result.id in known else "",
        findings=tuple(_finding(failed, file_name(result.id, number)) for number, failed in findings),
    )


def _finding(failed: v.ReportedFinding, replay: str) -> FindingEntry:
    finding = failed.finding
    shown = FindingEntry.of(
        failed,
        rule=finding.rule,
        expected=finding.expected,
        observed=finding.observed,
        scenario="",
        events=(),
        replay="",
        steady=(),
    )
    match failed.evidence:
        case v.TraceEvidence(execution=execution, steady=steady):
            suspects = set(finding.events)
            return msgspec.structs.replace(
                shown,
                scenario=execution.name,
                events=tuple(event for event in execution.trace if event.n in suspects)[:EVENTS],
                replay=replay,
                trace=execution.trace[-TRACE:] if failed.unstable else (),
                steady=steady.trace[-TRACE:] if steady is not None else (),
            )
        case v.FactEvidence(processed=processed):
            return msgspec.structs.replace(
                shown,
                scenario=processed.name,
                model=replay.removesuffix("json") + "xml",
                command=processed.command,
                status=processed.status,
                output=processed.output[:OUTPUT],
                place=failed.evidence.place,
            )
    return shown


def schema_bytes() -> bytes:
    """The schema as it stands in ``report.schema.json`` beside this module."""
    return msgspec.json.format(msgspec.json.encode(schema()), indent=2) + b"\n"


if __name__ == "__main__":
    Path(__file__).with_name(SCHEMA_FILE).write_bytes(schema_bytes())
