"""Failures that depend on time are doubted: seen once they may be the machine's, or nobody's.

Findings of timed rules stand if the same scenario, run once more with a multiple of the patience while the machine did not
stand still, shows them again. Otherwise they are no failures, and why is told as the reason of an inconclusive verdict.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.adapters.contract.trace import Trace
from ucm_cts.harness.running.driver import Answer, Driver
from ucm_cts.harness.running.stalls import StallWatch
from ucm_cts.harness.tally import Cause, cause_of
from ucm_cts.reference_models.findings import Finding
from ucm_cts.reference_models.judgement import Judge
from ucm_cts.reference_models.ledger import RULES

PATIENCE = 5
"""So many times as patient is the second look."""

LOOKS = 3
"""So often a second look may fail to show a failure; it is not taken for the same one any more."""


def is_timed(finding: Finding) -> bool:
    """Does it depend on how long something took?"""
    known = RULES.get(finding.rule)
    return known is not None and known.timed


class Doubts:
    """Sorts the findings of one run. ``watch`` tells when the machine stood still."""

    def __init__(self, driver: Driver, judge: Judge, watch: StallWatch | None = None) -> None:
        self._driver = driver
        self._judge = judge
        self._watch = watch or StallWatch()
        self._confirmed: set[Cause] = set()
        self._in_vain: Counter[Cause] = Counter()

    def sort(self, answer: Answer, findings: Sequence[Finding]) -> tuple[list[Finding], list[tuple[Finding, str]]]:
        """The findings that stand, and those that do not, each with the reason."""
        doubtful = {cause_of(f) for f in findings if is_timed(f)} - self._confirmed
        if not doubtful:
            return list(findings), []
        reason = self._look_again(answer, doubtful)
        stand = [f for f in findings if cause_of(f) not in doubtful or cause_of(f) in self._confirmed]
        return stand, [(f, reason) for f in findings if f not in stand]

    def stalled(self, answer: Answer, findings: Sequence[Finding]) -> list[Finding]:
        """The findings less those that a stall of the machine may have caused; nothing is run again."""
        return [f for f in findings if not (is_timed(f) and self._watch.longest(answer.trace))]

    def _look_again(self, answer: Answer, doubtful: set[Cause]) -> str:
        """Confirm of ``doubtful`` what can be; returns why the others do not stand."""
        stall = self._watch.longest(answer.trace)
        if all(self._in_vain[cause] >= LOOKS for cause in doubtful):
            return (
                _told(stall) or "unstable: seen now and then, and never again when the same scenario was run once more"
            )
        scenario, trace = self._driver.again(answer, PATIENCE * answer.disguised.patience)
        second = self._watch.longest(trace)
        if not second:
            self._confirmed |= doubtful & {cause_of(f) for f in self._judged(scenario, trace)}
        self._in_vain.update(doubtful - self._confirmed)
        if not trace:
            return _told(stall) or "unstable: seen once, and the same scenario could not be run again"
        again = f"not when the same scenario was run again with {PATIENCE} times the patience"
        return _told(max(stall, second)) or f"unstable: seen once, and {again}"

    def _judged(self, scenario: Scenario, trace: Trace) -> list[Finding]:
        return self._judge.judge(scenario, trace).findings


def _told(stall: int) -> str:
    return f"the machine stood still for {stall} ms when it was to be seen" if stall else ""
