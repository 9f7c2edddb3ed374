"""The order of requirements in reports, and their counts."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Protocol

from ucm_cts.harness.results.values import (
    FrameworkReport,
    IncidentReport,
    Overall,
    Report,
    RequirementResult,
    ToolChainReport,
    Verdict,
    incidents_of,
)

VERDICTS: tuple[Verdict, ...] = ("fail", "error", "inconclusive", "pass", "not applicable")
"""All verdicts, the worst first."""

SYMBOLS: dict[Verdict, str] = {"fail": "✗", "error": "!", "inconclusive": "?", "pass": "✓", "not applicable": "–"}
"""A symbol a verdict, so that colour is never needed."""

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


def clause_key(clause: str) -> tuple[int, ...]:
    """Sorts clauses as a table of contents does: 11.2.3 before 11.10."""
    return tuple(int(number[:9]) for number in _NUMBER.findall(clause))


@dataclass(frozen=True)
class Fix:
    """Something to mend: the incidents of one cause, or a requirement that failed.

    ``incident``: the number of the incident in the report (from 0), None for a requirement.
    ``explains``: the requirements that it decides or that failed after it in the same scenarios, itself among them.
    ``times``: the scenarios that showed it.
    """

    result: RequirementResult | None
    report: IncidentReport | None
    incident: int | None
    explains: frozenset[str]
    times: int


def to_fix(report: Report) -> list[Fix]:
    """What to mend, in the order to work on it: incidents, then failed requirements; first what explains most."""
    incidents = [
        Fix(None, item, number, frozenset(item.requirements), item.occurrences)
        for number, item in enumerate(incidents_of(report))
        if item.incident.kind != "untried"
    ]
    failed = [
        Fix(
            result,
            None,
            None,
            frozenset({result.id}.union(*(found.explains for found in result.findings))),
            sum(found.occurrences for found in result.findings),
        )
        for result in report.requirements
        if result.verdict == "fail"
    ]

    def key(fix: Fix) -> tuple[int, int, tuple[int, ...], str]:
        clause = clause_key(fix.result.clause) if fix.result is not None else ()
        return -len(fix.explains), -fix.times, clause, fix.result.id if fix.result is not None else ""

    return [*sorted(incidents, key=key), *sorted(failed, key=key)]


def failed_first(results: Sequence[RequirementResult], fixes: Iterable[Fix]) -> list[RequirementResult]:
    """All ``results``, those of ``fixes`` first and in their order."""
    failed = [fix.result for fix in fixes if fix.result is not None]
    return [*failed, *(result for result in results if result.verdict != "fail")]


class HasVerdict(Protocol):
    """A requirement's result, of a run or as it was read from a report."""

    @property
    def verdict(self) -> Verdict:
        """Its verdict."""


def count(results: Iterable[HasVerdict]) -> dict[Verdict, int]:
    """How many requirements have each verdict, the worst first."""
    verdicts = [result.verdict for result in results]
    return {verdict: verdicts.count(verdict) for verdict in VERDICTS}
