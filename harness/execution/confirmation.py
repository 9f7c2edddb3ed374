"""Failures are doubted, and passes that depend on time: what another look shows otherwise is unstable, and no verdict.

Findings of timed rules stand if the same scenario, run once more with a multiple of the patience while the machine did not
stand still, shows them again. All others stand if one of a few further runs, in other circumstances, shows them again.
Requirements that depend on time and were kept are looked at once more, too.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.harness.execution.clock_gaps import StallWatch
from ucm_cts.harness.execution.driver import Answer, Circumstances, Driver
from ucm_cts.harness.results.tally import Cause, cause_of
from ucm_cts.harness.results.values import Execution
from ucm_cts.reference_models.findings import Finding
from ucm_cts.reference_models.monitor import Judge
from ucm_cts.reference_models.verdicts import RULES

PATIENT = Circumstances(patience=5)
"""The second look at what depends on time."""

OTHERWISE = Circumstances(patience=2, one_core=True)
"""Another timeout, another schedule."""

FURTHER = (OTHERWISE, PATIENT, Circumstances())
"""The looks at a failure that does not depend on time; the first one that shows it again is the last."""

LOOKS = 3
"""So often a second look may fail to show a failure; it is not taken for the same one any more."""

TIMED = frozenset(requirement for rule in RULES.values() if rule.timed for requirement in rule.stands_for)
"""Requirements that depend on how long something takes."""


def is_timed(finding: Finding) -> bool:
    """Does it depend on how long something took?"""
    known = RULES.get(finding.rule)
    return known is not None and known.timed


@dataclass(frozen=True)
class Doubt:
    """A finding that does not stand, why, and a run of the same scenario that does not show it, if there is one."""

    finding: Finding
    reason: str
    steady: Answer | None = None


class Doubts:
    """Sorts the findings of one run. ``watch`` tells when the machine stood still."""

    def __init__(self, driver: Driver, judge: Judge, watch: StallWatch | None = None) -> None:
        self._driver = driver
        self._judge = judge
        self._watch = watch or StallWatch()
        self._confirmed: set[Cause] = set()
        self._in_vain: Counter[Cause] = Counter()

    def sort(self, answer: Answer, findings: Sequence[Finding]) -> tuple[list[Finding], list[Doubt]]:
        """The findings that stand, and those that do not."""
        doubtful = {cause_of(f) for f in findings if is_timed(f)} - self._confirmed
        if not doubtful:
            return list(findings), []
        reason, steady = self._look_again(answer, doubtful)
        stand = [f for f in findings if cause_of(f) not in doubtful or cause_of(f) in self._confirmed]
        return stand, [Doubt(f, reason, steady) for f in findings if f not in stand]

    def stalled(self, answer: Answer, findings: Sequence[Finding]) -> list[Finding]:
        """The findings less those that a stall of the machine may have caused; nothing is run again."""
        return [f for f in findings if not (is_timed(f) and self._watch.longest(answer.trace))]

    def of_failure(self, finding: Finding, execution: Execution) -> Doubt | None:
        """Why ``finding`` of ``execution`` does not stand; None if it was shown again, or nobody came back to tell.

        Timed ones have been sorted, and are not looked at here.
        """
        if is_timed(finding):
            return None
        steady: Answer | None = None
        for circumstances in FURTHER:
            answer = self._driver.again(execution.name, execution.scenario, circumstances)
            if any(f.requirement == finding.requirement for f in self._judged(answer)):
                return None
            steady = answer if answer.trace else steady
        if steady is None:
            return None
        return Doubt(
            finding, f"unstable: seen, and not when the same scenario was run {len(FURTHER)} times more", steady
        )

    def of_pass(self, name: str, scenario: Scenario) -> tuple[Answer, list[Finding], list[Doubt]]:
        """What ``scenario``, which was kept before, shows whenever its circumstances are others: the answer, its findings that
        stand because its own circumstances show them now as well, and those that do not.
        """
        answer = self._driver.again(name, scenario, OTHERWISE)
        findings = self._lasting(answer)
        if not findings:
            return answer, [], []
        twice = {f.requirement for f in self._lasting(self._driver.again(name, scenario, OTHERWISE))}
        usual = self._driver.again(name, scenario, Circumstances())
        now = {f.requirement for f in self._lasting(usual)}
        stand = [f for f in findings if f.requirement in twice & now]
        reason = "unstable: kept, but not with all threads on one core and more patience"
        return answer, stand, [Doubt(f, reason, usual) for f in findings if f.requirement in twice - now]

    def _lasting(self, answer: Answer) -> list[Finding]:
        return self.stalled(answer, self._judged(answer))

    def _look_again(self, answer: Answer, doubtful: set[Cause]) -> tuple[str, Answer | None]:
        """Confirm of ``doubtful`` what can be; returns why the others do not stand, and what does not show them."""
        stall = self._watch.longest(answer.trace)
        if all(self._in_vain[cause] >= LOOKS for cause in doubtful):
            vain = "unstable: seen now and then, and never again when the same scenario was run once more"
            return _told(stall) or vain, None
        second = self._driver.again(answer.name, answer.scenario, PATIENT)
        stalled = self._watch.longest(second.trace)
        if not stalled:
            self._confirmed |= doubtful & {cause_of(f) for f in self._judged(second)}
        self._in_vain.update(doubtful - self._confirmed)
        if not second.trace:
            return _told(stall) or "unstable: seen once, and the same scenario could not be run again", None
        again = f"not when the same scenario was run again with {PATIENT.patience} times the patience"
        return _told(max(stall, stalled)) or f"unstable: seen once, and {again}", second

    def _judged(self, answer: Answer) -> list[Finding]:
        return self._judge.judge(answer.disguised, answer.trace).findings if answer.trace else []


def _told(stall: int) -> str:
    return f"the machine stood still for {stall} ms when it was to be seen" if stall else ""
