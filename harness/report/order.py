"""The order of requirements in reports, and their counts."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from typing import Literal

from ucm_cts.harness.catalogue.requirements import decides
from ucm_cts.harness.results.tally import Counted
from ucm_cts.harness.results.values import FrameworkReport, Overall, Report, RequirementResult, ToolChainReport, Verdict

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


def to_fix(results: Iterable[RequirementResult]) -> list[RequirementResult]:
    """Failed requirements in the order to work on them: the most frequent first, then by clause."""
    return sorted((result for result in results if shown(result) == "fail"), key=_urgency)


def not_followed(results: Iterable[RequirementResult]) -> list[RequirementResult]:
    """Recommendations that were not followed, in the same order."""
    return sorted((result for result in results if shown(result) == "not followed"), key=_urgency)


def _urgency(result: RequirementResult) -> tuple[int, tuple[int, ...], str]:
    return -sum(failed.occurrences for failed in result.findings), clause_key(result.clause), result.id


def roots(failed: Sequence[RequirementResult]) -> list[tuple[RequirementResult, list[RequirementResult]]]:
    """``failed`` in their order, but for those that may follow from another one, which are listed with it."""
    known = {result.id for result in failed if not result.caused_by}
    return [
        (result, [other for other in failed if other.caused_by == result.id and other.caused_by in known])
        for result in failed
        if result.caused_by not in known
    ]


def shown(result: Counted) -> Shown:
    """The verdict of ``result`` as people read it."""
    return result.verdict if decides(result.level) or result.verdict != "fail" else "not followed"


def count(results: Iterable[Counted]) -> dict[Shown, int]:
    """How many requirements have each verdict, the worst first."""
    verdicts = [shown(result) for result in results]
    return {verdict: verdicts.count(verdict) for verdict in VERDICTS}
