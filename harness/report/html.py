"""``report.html``: one self-contained file for the person who examines failures."""

from __future__ import annotations

import base64
import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from ucm_cts.harness.catalogue.profiles import PARTS
from ucm_cts.harness.catalogue.requirements import Requirement
from ucm_cts.harness.report.framework_body import TraceShown, framework_body, trace_shown
from ucm_cts.harness.report.order import (
    VERDICTS,
    Fix,
    Shown,
    clause_key,
    count,
    counted,
    failed_first,
    not_followed,
    of_same_causes,
    shown,
    sides,
    to_fix,
)
from ucm_cts.harness.report.page import part, rendered
from ucm_cts.harness.report.scope import scope_of
from ucm_cts.harness.report.stated import stated
from ucm_cts.harness.report.toolchain_body import FactShown, fact_shown
from ucm_cts.harness.report.wanting import wanting
from ucm_cts.harness.results import values as v
from ucm_cts.harness.results.failures import (
    file_name,
    repeat_command,
    replay_command,
    shortest_first,
)
from ucm_cts.reference_models.model.life_cycle import LifeCycleTable

FINDINGS = 3
"""The number of causes of one requirement that are shown with diagrams; further causes are shown in words."""

BUDGET = 1_000_000
"""The bytes that all evidence together may take; evidence beyond them is shown without diagrams."""


@dataclass(frozen=True)
class Cause:
    """One cause of failure as the page shows it; ``shown`` is None where nothing was run."""

    failed: v.ReportedFinding
    shown: TraceShown | FactShown | None


@dataclass(frozen=True)
class Item:
    """One requirement as the page shows it: the verdict of the run and what the catalogue says."""

    result: v.RequirementResult
    requirement: Requirement
    causes: tuple[Cause, ...]
    decisions: tuple[tuple[str, str], ...]

    @property
    def shown(self) -> Shown:
        """Its verdict as people read it."""
        return shown(self.result)


def to_html(
    report: v.Report, catalogue: Sequence[Requirement], table: LifeCycleTable, interpretations: Mapping[str, str]
) -> str:
    """The whole page. The report must be clean (``foreign.clean_report``)."""
    script = part("report.js")
    digest = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
    readings = report.readings if isinstance(report, v.FrameworkReport) else {}
    reported = {result.id for result in report.requirements}
    fixes = to_fix(report)
    return rendered(
        "report.html.jinja",
        report=report,
        scope=scope_of(report, catalogue),
        counts=count(report.requirements),
        verdicts=VERDICTS,
        to_fix=fixes,
        same_cause=len(of_same_causes(report)),
        sides=sides(report),
        not_followed=not_followed(report.requirements),
        items=_items(report, fixes, catalogue, interpretations),
        untestable=sorted(
            (entry for entry in catalogue if entry.untestable and entry.id not in reported),
            key=lambda entry: (clause_key(entry.clause), entry.id),
        ),
        framework=framework_body(report, table) if isinstance(report, v.FrameworkReport) else None,
        wanting=wanting(report),
        stated=stated(report.statement, readings, PARTS[report.profile]),
        shortest_first=shortest_first,
        script=script,
        digest=digest,
        repeat=repeat_command(report),
        counted=counted(report),
    )


def _items(
    report: v.Report, fixes: Sequence[Fix], catalogue: Sequence[Requirement], interpretations: Mapping[str, str]
) -> list[Item]:
    known = {requirement.id: requirement for requirement in catalogue}
    left = BUDGET
    items = {}
    # the budget goes to what should be fixed first
    for result in failed_first(report.requirements, fixes):
        requirement = known.get(result.id) or Requirement(result.id, result.clause, result.title, result.level, "")
        causes = []
        for number, failed in enumerate(shortest_first(result.findings)):
            cause = _cause(failed, file_name(result.id, number), report, number < FINDINGS and left > 0)
            left -= cause.shown.size if cause.shown is not None else 0
            causes.append(cause)
        decisions = tuple((name, interpretations.get(name, "")) for name in requirement.interpretations)
        items[result.id] = Item(result, requirement, tuple(causes), decisions)
    return sorted(items.values(), key=lambda item: (clause_key(item.result.clause), item.result.id))


def _cause(failed: v.ReportedFinding, file: str, report: v.Report, whole: bool) -> Cause:
    match failed.evidence:
        case v.TraceEvidence():
            return Cause(failed, trace_shown(failed.finding, failed.evidence, replay_command(file, report), whole))
        case v.FactEvidence():
            return Cause(failed, fact_shown(failed.evidence, file.removesuffix("json") + "xml", whole))
    return Cause(failed, None)
