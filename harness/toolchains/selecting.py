"""What ``-k`` selects of a run on a tool chain."""

from __future__ import annotations

from collections.abc import Collection

from ucm_cts.harness.catalogue.requirements import requirements_of
from ucm_cts.harness.purposes.selection import words_of
from ucm_cts.harness.results.tally import of_selection
from ucm_cts.harness.results.values import ToolChainReport
from ucm_cts.harness.toolchains.campaign import ToolChainCampaign


def testable(profile: str) -> tuple[str, ...]:
    """The requirements of ``profile`` that a run can decide, by id."""
    return tuple(r.id for r in requirements_of(profile) if not r.untestable)


def named(ids: Collection[str], expression: str) -> frozenset[str]:
    """Those of ``ids`` that hold a word of ``expression``."""
    return frozenset(id_ for id_ in ids if any(word in id_.lower() for word in words_of(expression)))


def as_selected(report: ToolChainReport, campaign: ToolChainCampaign, profile: str, expression: str) -> ToolChainReport:
    """The ``report`` of ``campaign`` with the verdicts on what ``expression`` selects; as it is if that is empty."""
    if not expression:
        return report
    asked = named(testable(profile), expression) | campaign.asked_by(words_of(expression))
    return of_selection(report, expression, asked)
