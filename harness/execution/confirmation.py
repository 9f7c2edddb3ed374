"""Runs a scenario again to confirm what it showed.

A failure, or a pass that depends on time, that another run does not show again is unstable and gives no verdict.

A finding of a timed property is confirmed if the same scenario shows it again with more patience while the machine did not
stand still. Any other finding is confirmed if one of a few further runs, in other circumstances, shows it again.
A requirement that depends on time and was kept is run once more, too.
"""

from __future__ import annotations

import functools
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.harness.execution.driving import LONGEST_HISTORY, Answer, Circumstances, Driving, Gaps
from ucm_cts.harness.results.tally import Cause, cause_of
from ucm_cts.harness.results.values import Execution
from ucm_cts.reference_models.findings import Finding
from ucm_cts.reference_models.monitor import Monitor
from ucm_cts.reference_models.properties.table import PROPERTIES

PATIENT = Circumstances(patience=5)
"""The circumstances in which a finding of a timed property is confirmed."""

OTHERWISE = Circumstances(patience=2, one_core=True)
"""Another timeout and another schedule."""

LATER = Circumstances(after=LONGEST_HISTORY)
"""On a host that has run as many scenarios before as are known."""

FURTHER = (OTHERWISE, PATIENT, Circumstances(), LATER)
"""The further runs of a failure that does not depend on time; the first run that shows it again ends them."""

MOST_ATTEMPTS = 3
"""After so many runs that did not confirm a cause, no further run is made for it."""


@functools.cache
def timed_requirements() -> frozenset[str]:
    """The requirements that depend on how long something takes."""
    return frozenset(requirement for one in PROPERTIES.values() if one.timed for requirement in one.stands_for)


def is_timed(finding: Finding) -> bool:
    """Whether ``finding`` depends on how long something took."""
    known = PROPERTIES.get(finding.rule)
    return known is not None and known.timed


@dataclass(frozen=True)
class Unconfirmed:
    """A finding that no further run confirmed.

    ``finding``: what was seen once.
    ``reason``: why it gives no verdict.
    ``steady``: a run of the same scenario that does not show it, if there is one.
    """

    finding: Finding
    reason: str
    steady: Answer | None = None


class Confirmation:
    """Confirms the findings of one run. ``gaps`` knows when the machine stood still."""

    def __init__(self, driver: Driving, monitor: Monitor, gaps: Gaps) -> None:
        self._driver = driver
        self._monitor = monitor
        self._gaps = gaps
        self._confirmed: set[Cause] = set()
        self._attempts: Counter[Cause] = Counter()

    def separate(self, answer: Answer, findings: Sequence[Finding]) -> tuple[list[Finding], list[Unconfirmed]]:
        """The findings of ``answer`` that give a verdict, and those that are unconfirmed. Runs timed ones again."""
        open_causes = {cause_of(f) for f in findings if is_timed(f)} - self._confirmed
        if not open_causes:
            return list(findings), []
        reason, steady = self._confirm_timed(answer, open_causes)
        confirmed = [f for f in findings if cause_of(f) not in open_causes or cause_of(f) in self._confirmed]
        return confirmed, [Unconfirmed(f, reason, steady) for f in findings if f not in confirmed]

    def outside_gaps(self, answer: Answer, findings: Sequence[Finding]) -> list[Finding]:
        """``findings`` without those that a clock gap of the machine may have caused. Runs nothing."""
        return [f for f in findings if not (is_timed(f) and self._gaps.longest(answer.trace))]

    def of_failure(self, finding: Finding, execution: Execution) -> Unconfirmed | None:
        """Why ``finding`` of ``execution`` is unconfirmed; None if a further run showed it again, or no run gave a trace.

        Findings of timed properties have been separated before and are not run again here.
        """
        if is_timed(finding):
            return None
        steady: Answer | None = None
        for circumstances in FURTHER:
            answer = self._driver.again(execution.name, execution.scenario, circumstances)
            if any(f.requirement == finding.requirement for f in self._findings(answer)):
                return None
            steady = answer if answer.trace else steady
        if steady is None:
            return None
        reason = f"unstable: seen, and not when the same scenario was run {len(FURTHER)} times more"
        return Unconfirmed(finding, reason, steady)

    def of_pass(self, name: str, scenario: Scenario) -> tuple[Answer, list[Finding], list[Unconfirmed]]:
        """Runs ``scenario``, which was kept before, in other circumstances.

        Returns the answer, the findings that the usual circumstances now show as well, and the unconfirmed ones.
        """
        answer = self._driver.again(name, scenario, OTHERWISE)
        findings = self._findings_outside_gaps(answer)
        if not findings:
            return answer, [], []
        twice = {f.requirement for f in self._findings_outside_gaps(self._driver.again(name, scenario, OTHERWISE))}
        usual = self._driver.again(name, scenario, Circumstances())
        now = {f.requirement for f in self._findings_outside_gaps(usual)}
        confirmed = [f for f in findings if f.requirement in twice & now]
        reason = "unstable: kept, but not with all threads on one core and more patience"
        return answer, confirmed, [Unconfirmed(f, reason, usual) for f in findings if f.requirement in twice - now]

    def _findings_outside_gaps(self, answer: Answer) -> list[Finding]:
        return self.outside_gaps(answer, self._findings(answer))

    def _confirm_timed(self, answer: Answer, causes: set[Cause]) -> tuple[str, Answer | None]:
        """Runs ``answer``'s scenario with more patience. Returns why the rest of ``causes`` is unconfirmed, and a run without it."""
        gap = self._gaps.longest(answer.trace)
        if all(self._attempts[cause] >= MOST_ATTEMPTS for cause in causes):
            seldom = "unstable: seen now and then, and never again when the same scenario was run once more"
            return _gap_reason(gap) or seldom, None
        second = self._driver.again(answer.name, answer.scenario, PATIENT)
        second_gap = self._gaps.longest(second.trace)
        if not second_gap:
            self._confirmed |= causes & {cause_of(f) for f in self._findings(second)}
        self._attempts.update(causes - self._confirmed)
        if not second.trace:
            return _gap_reason(gap) or "unstable: seen once, and the same scenario could not be run again", None
        again = f"not when the same scenario was run again with {PATIENT.patience} times the patience"
        return _gap_reason(max(gap, second_gap)) or f"unstable: seen once, and {again}", second

    def _findings(self, answer: Answer) -> list[Finding]:
        return self._monitor.judge(answer.disguised, answer.trace).findings if answer.trace else []


def _gap_reason(gap: int) -> str:
    return f"the machine stood still for {gap} ms when it was to be seen" if gap else ""
