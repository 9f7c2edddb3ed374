"""The page of a framework: diagrams of failures, incidents, and the life-cycle table."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from markupsafe import Markup

from ucm_cts.harness.purposes.provocations.coverage import ProvocationRow
from ucm_cts.harness.purposes.provocations.coverage import rows as provocation_rows
from ucm_cts.harness.report.diagrams import life_cycle_diagram, sequence_svg
from ucm_cts.harness.report.diagrams.excerpt import compare, excerpt
from ucm_cts.harness.report.diagrams.sequence import last_call
from ucm_cts.harness.report.diagrams.sequence_text import failure_text, to_text
from ucm_cts.harness.report.diagrams.transitions import STATES, Choice, RowSeen, choices, rows_seen, worst
from ucm_cts.harness.results.failures import incident_file, replay_command, scenario_text
from ucm_cts.harness.results.foreign import one_line
from ucm_cts.harness.results.values import FrameworkReport, IncidentReport, TraceEvidence
from ucm_cts.reference_models.findings import Finding
from ucm_cts.reference_models.model.life_cycle import LifeCycleTable, State

INCIDENTS = 20
"""The number of incidents that are shown with diagrams and stacks."""

NOTHING = Markup("")


@dataclass(frozen=True)
class TraceShown:
    """Evidence of a framework as a page shows it; without diagrams once the page is full."""

    evidence: TraceEvidence
    command: str
    scenario: str = ""
    observed: Markup = NOTHING
    expected: Markup = NOTHING
    text: str = ""
    steady: Markup = NOTHING

    @property
    def size(self) -> int:
        """Bytes that it adds to the page."""
        parts = (self.scenario, self.observed, self.expected, self.text, self.steady)
        return sum(len(part.encode()) for part in parts)


@dataclass(frozen=True)
class IncidentItem:
    """One incident as the page shows it."""

    report: IncidentReport
    last: str
    command: str
    diagram: Markup
    text: str


@dataclass(frozen=True)
class FrameworkBody:
    """The sections of the page that only frameworks have."""

    incidents: tuple[IncidentItem, ...]
    rows: tuple[RowSeen, ...]
    choices: tuple[Choice, ...]
    diagram: Markup
    provoked: tuple[ProvocationRow, ...] = ()
    states: tuple[State, ...] = STATES

    @property
    def operations(self) -> list[str]:
        """In the order of the table."""
        return list(dict.fromkeys(seen.row.operation for seen in self.rows))

    def cell(self, operation: str, state: State) -> list[RowSeen]:
        """The rows of the table for all conditions of one operation in one state."""
        return [seen for seen in self.rows if (seen.row.operation, seen.row.state) == (operation, state)]

    def verdict(self, cell: Sequence[RowSeen]) -> str:
        """The worst verdict of ``cell``; empty if it has no rows."""
        return worst([seen.verdict for seen in cell]) if cell else ""


def framework_body(report: FrameworkReport, table: LifeCycleTable) -> FrameworkBody:
    """Incidents and life cycle of ``report``."""
    rows = rows_seen(table, report.transitions)
    return FrameworkBody(
        tuple(_incident(item, number, report) for number, item in enumerate(report.incidents)),
        rows,
        choices(rows),
        life_cycle_diagram.to_svg(rows),
        provocation_rows(report.provoked),
    )


def trace_shown(finding: Finding, evidence: TraceEvidence, command: str, whole: bool) -> TraceShown:
    """``evidence`` of ``finding`` for a page, with diagrams only if it is shown ``whole``; ``command`` replays it."""
    if not whole:
        return TraceShown(evidence, command)
    execution, steady = evidence.execution, evidence.steady
    both = compare(finding, execution)
    return TraceShown(
        evidence,
        command,
        scenario_text(execution),
        sequence_svg.to_svg(both.observed, f"Observed: {one_line(finding.observed)}"),
        sequence_svg.to_svg(both.expected, f"Expected: {one_line(finding.expected)}"),
        failure_text(finding, execution),
        NOTHING if steady is None else sequence_svg.to_svg(excerpt(steady), "Another run of the scenario"),
    )


def _incident(item: IncidentReport, number: int, report: FrameworkReport) -> IncidentItem:
    command = replay_command(incident_file(number), report)
    last = last_call(item.execution)
    if number >= INCIDENTS:
        return IncidentItem(item, last, command, Markup(""), "")
    shown = excerpt(item.execution)
    name = one_line(f"What happened until the {item.incident.kind}")
    return IncidentItem(item, last, command, sequence_svg.to_svg(shown, name), to_text(shown))
