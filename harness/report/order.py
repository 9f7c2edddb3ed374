"""The order of requirements in reports, and their counts."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import Protocol

from ucm_cts.harness.results.values import (
    REQUIREMENTS_WITH,
    SIDES,
    FrameworkReport,
    Overall,
    Report,
    RequirementResult,
    ToolChainReport,
    Verdict,
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


def to_fix(results: Iterable[RequirementResult]) -> list[RequirementResult]:
    """Failed requirements in the order to work on them: the most frequent first, then by clause, then those whose causes others show."""
    failed = [result for result in results if result.verdict == "fail"]
    shown = _causes_shown(failed)

    def key(result: RequirementResult) -> tuple[bool, int, tuple[int, ...], str]:
        times = sum(finding.occurrences for finding in result.findings)
        return _is_shown_elsewhere(result, shown), -times, clause_key(result.clause), result.id

    return sorted(failed, key=key)


def by_own_cause(failed: list[RequirementResult]) -> tuple[list[RequirementResult], int]:
    """Those of ``failed`` that show a cause, and how many others fail for these causes only."""
    shown = _causes_shown(failed)
    own = [result for result in failed if not _is_shown_elsewhere(result, shown)]
    return own, len(failed) - len(own)


def _causes_shown(results: Iterable[RequirementResult]) -> frozenset[str]:
    """The causes of findings that have evidence."""
    return frozenset(f.finding.cause for result in results for f in result.findings if f.evidence is not None)


def _is_shown_elsewhere(result: RequirementResult, shown: frozenset[str]) -> bool:
    """Whether each finding has its evidence at another requirement, which one cause breaks as well."""
    return bool(result.findings) and all(f.evidence is None and f.finding.cause in shown for f in result.findings)


class HasVerdict(Protocol):
    """A requirement's result, of a run or as it was read from a report."""

    @property
    def verdict(self) -> Verdict:
        """Its verdict."""


def count(results: Iterable[HasVerdict]) -> dict[Verdict, int]:
    """How many requirements have each verdict, the worst first."""
    verdicts = [result.verdict for result in results]
    return {verdict: verdicts.count(verdict) for verdict in VERDICTS}
