"""The order of requirements in reports, and their counts."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Literal

from ucm_cts.harness.catalogue.requirements import decides
from ucm_cts.harness.results.tally import Counted
from ucm_cts.harness.results.values import (
    REQUIREMENTS_WITH,
    SIDES,
    FrameworkReport,
    IncidentReport,
    Isolation,
    Overall,
    Report,
    RequirementResult,
    ToolChainReport,
    Verdict,
    incidents_of,
)

Shown = Literal[Verdict, "not followed"]
"""A verdict as people read it: a recommendation that fails was not followed."""

VERDICTS: tuple[Shown, ...] = ("fail", "error", "inconclusive", "not followed", "pass", "not applicable")
"""All of them, the worst first."""

SYMBOLS: dict[Shown, str] = {
    "fail": "✗",
    "error": "!",
    "inconclusive": "?",
    "not followed": "~",
    "pass": "✓",
    "not applicable": "–",
}
"""A symbol a verdict, so that colour is never needed."""

ISOLATIONS: dict[Isolation, str] = {
    "bubblewrap": "in a sandbox (bubblewrap): could neither see nor reach the harness",
    "process": "as processes of the same user: could reach the harness and its files",
    "none": "in the process of the harness: for debugging, proves nothing to others",
    "remote": "elsewhere, behind a socket: out of the harness' reach",
}
"""What to say of where the code of the product ran."""

SEALS: dict[Overall, str] = {"conformant": "✓", "not conformant": "✗", "inconclusive": "?"}
"""The same for the verdict of a run."""

_NUMBER = re.compile(r"\d+")


def counted(report: Report) -> tuple[tuple[int, str], tuple[int, str]]:
    """The extent of a run, in the two units of its product."""
    match report:
        case FrameworkReport():
            return (report.scenarios, "scenarios"), (report.events, "events")
        case ToolChainReport():
            return (report.models, "models"), (report.facts, "facts")
    raise TypeError(type(report))


def sides(report: Report) -> list[str]:
    """What a checker does with legal and with broken models, a sentence each; nothing for other products."""
    measures = report.effort.measures
    return [
        f"{side}: {measures.get(done, 0):,} of {measures[asked]:,} models, "
        f"{measures.get(REQUIREMENTS_WITH + done, 0):,} of {measures.get(REQUIREMENTS_WITH + asked, 0):,} requirements"
        for side, (asked, done) in SIDES.items()
        if asked in measures
    ]


def clause_key(clause: str) -> tuple[int, ...]:
    """Sorts clauses as a table of contents does: 11.2.3 before 11.10."""
    return tuple(int(number[:9]) for number in _NUMBER.findall(clause))


@dataclass(frozen=True)
class Fix:
    """Something to mend: the incidents of one cause, or a requirement that failed.

    ``incident``: the number of the incident in the report (from 0), None for a requirement.
    ``explains``: the requirements that it decides or that failed after it in the same scenarios, itself among them.
    ``times``: the scenarios that showed it.
    ``followers``: failed requirements all of whose failures may follow from it; they are not listed on their own.
    """

    result: RequirementResult | None
    report: IncidentReport | None
    incident: int | None
    explains: frozenset[str]
    times: int
    followers: tuple[RequirementResult, ...] = ()


def to_fix(report: Report) -> list[Fix]:
    """What to mend, in the order to work on it: incidents, then failed requirements; first what explains most.

    Failed requirements whose causes others show (``of_same_causes``) are left out.
    """
    incidents = [
        Fix(None, item, number, frozenset(item.requirements), item.occurrences)
        for number, item in enumerate(incidents_of(report))
        if item.incident.kind != "untried"
    ]
    elsewhere = {result.id for result in of_same_causes(report)}
    failed = [result for result in report.requirements if shown(result) == "fail" and result.id not in elsewhere]
    independent = {result.id for result in failed if not result.caused_by}
    fixes = [
        Fix(
            result,
            None,
            None,
            frozenset({result.id}.union(*(found.explains for found in result.findings))),
            _occurrences(result),
            tuple(other for other in failed if other.caused_by == result.id),
        )
        for result in failed
        if result.caused_by not in independent
    ]

    def key(fix: Fix) -> tuple[int, int, tuple[int, ...], str]:
        clause = clause_key(fix.result.clause) if fix.result is not None else ()
        return -len(fix.explains), -fix.times, clause, fix.result.id if fix.result is not None else ""

    return [*sorted(incidents, key=key), *sorted(fixes, key=key)]


def of_same_causes(report: Report) -> list[RequirementResult]:
    """The failed requirements that one cause breaks together with others, which have its evidence."""
    failed = [result for result in report.requirements if shown(result) == "fail"]
    causes = {f.finding.cause for result in failed for f in result.findings if f.evidence is not None}
    return [
        result
        for result in failed
        if result.findings and all(f.evidence is None and f.finding.cause in causes for f in result.findings)
    ]


def failed_first(results: Sequence[RequirementResult], fixes: Iterable[Fix]) -> list[RequirementResult]:
    """All ``results``: those of ``fixes`` in their order, each before its followers, then the others."""
    listed = [result for fix in fixes if fix.result is not None for result in (fix.result, *fix.followers)]
    ids = {result.id for result in listed}
    return [*listed, *(result for result in results if result.id not in ids)]


def not_followed(results: Iterable[RequirementResult]) -> list[RequirementResult]:
    """Recommendations that were not followed: the most frequent first, then by clause."""

    def key(result: RequirementResult) -> tuple[int, tuple[int, ...], str]:
        return -_occurrences(result), clause_key(result.clause), result.id

    return sorted((result for result in results if shown(result) == "not followed"), key=key)


def _occurrences(result: RequirementResult) -> int:
    return sum(failed.occurrences for failed in result.findings)


def shown(result: Counted) -> Shown:
    """The verdict of ``result`` as people read it."""
    return result.verdict if decides(result.level) or result.verdict != "fail" else "not followed"


def count(results: Iterable[Counted]) -> dict[Shown, int]:
    """How many requirements have each verdict, the worst first."""
    verdicts = [shown(result) for result in results]
    return {verdict: verdicts.count(verdict) for verdict in VERDICTS}
