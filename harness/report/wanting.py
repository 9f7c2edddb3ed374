"""The lines of a vendor's statement for want of which a run decides nothing about requirements."""

from __future__ import annotations

import shlex
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass

from ucm_cts.harness.catalogue.requirements import load_requirements
from ucm_cts.harness.results.foreign import one_line
from ucm_cts.harness.results.values import FrameworkReport, Report
from ucm_cts.harness.statement.applicability import Line, lines_for


@dataclass(frozen=True)
class Wanting:
    """What a statement should say.

    ``requirements``: how many requirements are inconclusive for want of it.
    ``lines``: the lines that would help, most helpful first, each with the number of requirements that need it.
    ``remedy``: where they belong, or what writes a statement with them.
    """

    requirements: int
    lines: Mapping[Line, int]
    remedy: str


def wanting(report: Report) -> Wanting | None:
    """What the statement of ``report`` should say; None if no line of it would help."""
    known = {requirement.id: requirement for requirement in load_requirements()}
    undecided = [
        lines_for(known[result.id], report.statement)
        for result in report.requirements
        if result.verdict == "inconclusive" and not result.findings and result.id in known
    ]
    helped = [lines for lines in undecided if lines]
    if not helped:
        return None
    counts = Counter(line for lines in helped for line in lines)
    return Wanting(len(helped), dict(counts.most_common()), _remedy(report))


def _remedy(report: Report) -> str:
    if report.statement.source:
        return f"add to {one_line(report.statement.source)}"
    adapter = shlex.quote(one_line(report.adapter))
    subject = adapter if isinstance(report, FrameworkReport) else f"--toolchain {adapter}"
    return f"'ucm-cts ics {subject} --profile {one_line(report.profile)}' writes them"
