"""``report.html``: one file that needs nothing else, for the person who has to find out what is wrong."""

from __future__ import annotations

import base64
import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import jinja2
from markupsafe import Markup

from ucm_cts.harness.catalogue.profiles import PARTS, TOOLCHAIN_PROFILES
from ucm_cts.harness.catalogue.requirements import Requirement
from ucm_cts.harness.report import life_cycle_diagram, sequence_svg
from ucm_cts.harness.report.excerpt import compare, excerpt
from ucm_cts.harness.report.models import ModelLine, command_text, ending, model_lines
from ucm_cts.harness.report.order import SYMBOLS, VERDICTS, clause_key, count, to_fix
from ucm_cts.harness.report.sequence import last_call
from ucm_cts.harness.report.sequence_text import failure_text, to_text
from ucm_cts.harness.report.stated import stated
from ucm_cts.harness.report.transitions import STATES, RowSeen, choices, rows_seen, worst
from ucm_cts.harness.results.failures import (
    file_name,
    incident_file,
    repeat_command,
    replay_command,
    scenario_text,
    shortest_first,
)
from ucm_cts.harness.results.foreign import one_line
from ucm_cts.harness.results.values import FailedExecution, IncidentReport, Report, RequirementResult
from ucm_cts.reference_models.model.life_cycle import LifeCycleTable, State

FINDINGS = 3
"""The number of causes of one requirement that are shown with diagrams; further causes are shown in words."""

BUDGET = 1_000_000
"""The bytes that all evidence together may take; evidence beyond them is shown without diagrams."""

INCIDENTS = 20
"""The number of incidents that are shown with diagrams and stacks."""

NOTHING = Markup("")

_TEMPLATES = Path(__file__).parent / "templates"


@dataclass(frozen=True)
class Evidence:
    """One cause of failure as the page shows it.

    There are no diagrams once the budget is spent, and no ``command`` where nothing was run.
    """

    failed: FailedExecution
    command: str
    scenario: str = ""
    observed: Markup = NOTHING
    expected: Markup = NOTHING
    text: str = ""
    steady: Markup = NOTHING
    model: tuple[ModelLine, ...] = ()
    ending: str = ""

    @property
    def size(self) -> int:
        """Bytes it adds to the page."""
        parts = (self.scenario, self.observed, self.expected, self.text, self.steady, *(m.text for m in self.model))
        return sum(len(part.encode()) for part in parts)


@dataclass(frozen=True)
class Item:
    """One requirement as the page shows it: the verdict of the run and what the catalogue says."""

    result: RequirementResult
    requirement: Requirement
    evidence: tuple[Evidence, ...]
    decisions: tuple[tuple[str, str], ...]


@dataclass(frozen=True)
class IncidentItem:
    """One incident as the page shows it."""

    report: IncidentReport
    last: str
    command: str
    diagram: Markup
    text: str


@dataclass(frozen=True)
class Cell:
    """One cell of the life-cycle table: all conditions of one operation in one state."""

    operation: str
    state: State
    rows: tuple[RowSeen, ...]

    @property
    def verdict(self) -> str:
        """The worst verdict of the cell's rows."""
        return worst([row.verdict for row in self.rows]) if self.rows else ""


def to_html(
    report: Report, catalogue: Sequence[Requirement], table: LifeCycleTable, interpretations: Mapping[str, str]
) -> str:
    """The whole page. The report must be clean (``foreign.clean_report``)."""
    script = _read("report.js")
    digest = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
    rows = rows_seen(table, report.transitions)
    reported = {result.id for result in report.requirements}
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(_TEMPLATES),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["one_line"] = one_line
    return environment.get_template("report.html.jinja").render(
        report=report,
        counts=count(report.requirements),
        verdicts=VERDICTS,
        symbols=SYMBOLS,
        to_fix=to_fix(report.requirements),
        items=_items(report, catalogue, interpretations),
        untestable=sorted(
            (entry for entry in catalogue if entry.untestable and entry.id not in reported),
            key=lambda entry: (clause_key(entry.clause), entry.id),
        ),
        incidents=[_incident(item, number, report) for number, item in enumerate(report.incidents)],
        incidents_shown=INCIDENTS,
        diagram=life_cycle_diagram.to_svg(rows),
        cells=_cells(rows),
        choices=choices(rows),
        states=STATES,
        stated=stated(report.statement, report.readings, PARTS[report.profile]),
        rows=rows,
        shortest_first=shortest_first,
        style=Markup(_read("report.css")),
        script=Markup(script),
        digest=digest,
        repeat=repeat_command(report),
        of_models=report.profile in TOOLCHAIN_PROFILES,
    )


def _read(name: str) -> str:
    return (_TEMPLATES / name).read_text(encoding="utf-8")


def _items(report: Report, catalogue: Sequence[Requirement], interpretations: Mapping[str, str]) -> list[Item]:
    known = {requirement.id: requirement for requirement in catalogue}
    left = BUDGET
    items = {}
    # the budget goes to what should be fixed first
    for result in [*to_fix(report.requirements), *(r for r in report.requirements if r.verdict != "fail")]:
        requirement = known.get(result.id) or Requirement(result.id, result.clause, result.title, "statement", "")
        evidence = []
        for number, failed in enumerate(shortest_first(result.findings)):
            entry = _evidence(failed, file_name(result.id, number), report, number < FINDINGS and left > 0)
            left -= entry.size
            evidence.append(entry)
        decisions = tuple((name, interpretations.get(name, "")) for name in requirement.interpretations)
        items[result.id] = Item(result, requirement, tuple(evidence), decisions)
    return sorted(items.values(), key=lambda item: (clause_key(item.result.clause), item.result.id))


def _evidence(failed: FailedExecution, file: str, report: Report, drawn: bool) -> Evidence:
    execution, processed = failed.execution, failed.processed
    if processed is not None:
        command = command_text(processed, file.removesuffix("json") + "xml")
        return Evidence(failed, command, model=tuple(model_lines(processed)) if drawn else (), ending=ending(processed))
    if execution is None:
        return Evidence(failed, "")
    command = replay_command(file, report)
    if not drawn:
        return Evidence(failed, command)
    both = compare(failed.finding, execution)
    return Evidence(
        failed,
        command,
        scenario_text(execution),
        sequence_svg.to_svg(both.observed, f"Observed: {one_line(failed.finding.observed)}"),
        sequence_svg.to_svg(both.expected, f"Expected: {one_line(failed.finding.expected)}"),
        failure_text(failed.finding, execution),
        NOTHING
        if failed.steady is None
        else sequence_svg.to_svg(excerpt(failed.steady), "Another run of the scenario"),
    )


def _incident(item: IncidentReport, number: int, report: Report) -> IncidentItem:
    command = replay_command(incident_file(number), report)
    last = last_call(item.execution)
    if number >= INCIDENTS:
        return IncidentItem(item, last, command, Markup(""), "")
    shown = excerpt(item.execution)
    name = one_line(f"What happened until the {item.incident.kind}")
    return IncidentItem(item, last, command, sequence_svg.to_svg(shown, name), to_text(shown))


def _cells(rows: Sequence[RowSeen]) -> list[tuple[str, list[Cell]]]:
    """The table's rows by operation and state, in the order in which operations first appear."""
    operations = list(dict.fromkeys(seen.row.operation for seen in rows))
    return [
        (
            operation,
            [
                Cell(operation, state, tuple(s for s in rows if (s.row.operation, s.row.state) == (operation, state)))
                for state in STATES
            ],
        )
        for operation in operations
    ]
