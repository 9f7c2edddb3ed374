"""Runs a scenario again to confirm what it showed.

A failure, or a pass that depends on time, that another run does not show again is unstable and gives no verdict.

A finding of a timed property is confirmed if the same scenario shows it again with more patience while the machine did not
stand still. Any other finding is confirmed if one of a few further runs, in other circumstances, shows it again.
A requirement that depends on time and was kept is run once more, too.

Lateness that was seen while the machine stood still or had too few processors, and not in several further runs, is the machine's
and does not count. What came too early, or never, is not: a busy machine does not make a timer hurry.
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

FURTHER_OF_LATE = 3
"""So many runs, after the one with more patience, must not show lateness again before it counts as the machine's. On a busy machine so
many must show it again, each of them, before it counts as the product's.
"""

MOST_OF_LATE = 5
"""So many runs are made at most until enough of them did not show lateness."""

TROUBLE = 100
"""Milliseconds. For so long at least a machine stood still, or threads waited for a processor, where lateness is the machine's."""

_MILLISECOND = 1_000_000

OF_THE_MACHINE = "late once, on a busy machine: not counted"
"""The measure of how often lateness was the machine's."""

MOST_LOOKS = 3
"""A second look during which the machine stood still is taken again; so many looks at most."""

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


def is_late(finding: Finding) -> bool:
    """Whether ``finding`` tells that something came, and later than it may, or too soon after what came later than it may."""
    return is_timed(finding) and finding.late_by > 0


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
    """Confirms the findings of one run. ``gaps`` knows when the machine stood still or had too few processors.

    ``measures``: of the run's effort; gets ``OF_THE_MACHINE``.
    """

    def __init__(self, driver: Driving, monitor: Monitor, gaps: Gaps, measures: Counter[str]) -> None:
        self._driver = driver
        self._monitor = monitor
        self._gaps = gaps
        self._confirmed: set[Cause] = set()
        self._attempts: Counter[Cause] = Counter()
        self._measures = measures

    def separate(self, answer: Answer, findings: Sequence[Finding]) -> tuple[list[Finding], list[Unconfirmed]]:
        """The findings of ``answer`` that give a verdict, and those that are unconfirmed. Runs timed ones again.

        Lateness that was the machine's is among neither.
        """
        open_causes = {cause_of(f) for f in findings if is_timed(f)} - self._confirmed
        if not open_causes:
            return list(findings), []
        gap = self._gaps.longest(answer.trace)
        reason, steady = self._confirm_timed(answer, open_causes, gap)
        confirmed = [f for f in findings if cause_of(f) not in open_causes or cause_of(f) in self._confirmed]
        open_findings = [f for f in findings if f not in confirmed]
        if steady is not None and open_findings and self._is_of_the_machine(answer, gap, open_findings, steady):
            self._measures[OF_THE_MACHINE] += 1
            return confirmed, []
        return confirmed, [Unconfirmed(f, reason, steady) for f in open_findings]

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

    def _confirm_timed(self, answer: Answer, causes: set[Cause], gap: int) -> tuple[str, Answer | None]:
        """Runs ``answer``'s scenario with more patience. Returns why the rest of ``causes`` is unconfirmed, and a run without it.

        ``gap``: milliseconds that the machine stood still while ``answer`` came about.
        """
        if all(self._attempts[cause] >= MOST_ATTEMPTS for cause in causes):
            seldom = "unstable: seen now and then, and never again when the same scenario was run once more"
            return _gap_reason(gap) or seldom, None
        second, second_gap = self._again(answer, PATIENT)
        doubtful: set[Cause] = set()
        if not second_gap:
            doubtful = self._maybe_of_the_machine(second, causes)
            self._confirmed |= (causes & self._causes_in(second)) - doubtful
        steady = self._show_each_time(answer, doubtful)
        self._attempts.update(causes - self._confirmed)
        if not second.trace:
            return _gap_reason(gap) or "unstable: seen once, and the same scenario could not be run again", None
        if steady is not None:
            return "unstable: late on a busy machine, and not each time", steady
        again = f"not when the same scenario was run again with {PATIENT.patience} times the patience"
        return _gap_reason(max(gap, second_gap)) or f"unstable: seen once, and {again}", second

    def _maybe_of_the_machine(self, answer: Answer, causes: set[Cause]) -> set[Cause]:
        """Those of ``causes`` that ``answer`` shows, and only by lateness for which a busy machine had time enough."""
        found: dict[Cause, list[Finding]] = {}
        for finding in self._findings(answer):
            if cause_of(finding) in causes:
                found.setdefault(cause_of(finding), []).append(finding)
        late = {cause: findings for cause, findings in found.items() if all(map(is_late, findings))}
        if not late or self._driver.isolation == "remote":  # another machine
            return set()
        contended = self._gaps.contended(answer.trace)
        return {cause for cause, findings in late.items() if contended >= _needed(findings)}

    def _show_each_time(self, answer: Answer, causes: set[Cause]) -> Answer | None:
        """Confirms those of ``causes`` that several further runs of ``answer``'s scenario all show. Returns a run that shows not all, if any."""
        left, steady = set(causes), None
        for _ in range(FURTHER_OF_LATE if causes else 0):
            again, _ = self._again(answer, Circumstances())
            shown = self._causes_in(again)
            if again.trace and not left <= shown:
                steady = again
            left &= shown
            if not left:
                break
        self._confirmed |= left
        return steady

    def _is_of_the_machine(self, answer: Answer, gap: int, findings: Sequence[Finding], steady: Answer) -> bool:
        """Whether ``findings`` of ``answer`` tell of nothing but lateness for which a busy machine had time enough.

        ``steady``, the run with more patience, keeps their requirements, and several further runs do not show them either. One or two
        more may show them again, if the machine was busy then, too.
        """
        causes = {cause_of(finding) for finding in findings}
        if not all(map(is_late, findings)) or any(self._attempts[cause] > MOST_ATTEMPTS for cause in causes):
            return False
        if self._driver.isolation == "remote":  # another machine
            return False
        verdicts = self._monitor.judge(steady.disguised, steady.trace)
        kept = {finding.requirement for finding in findings} <= verdicts.exercises.keys()
        if not kept or causes & {cause_of(finding) for finding in verdicts.findings}:
            return False
        needed = _needed(findings)
        if gap < needed and self._gaps.contended(answer.trace) < needed:
            return False
        steady_ones = 0
        for _ in range(MOST_OF_LATE):
            again, _ = self._again(answer, Circumstances())
            shown = causes & self._causes_in(again)
            if not again.trace or shown != self._maybe_of_the_machine(again, shown):
                return False
            steady_ones += not shown
            if steady_ones == FURTHER_OF_LATE:
                return True
        return False

    def _again(self, answer: Answer, circumstances: Circumstances) -> tuple[Answer, int]:
        """A further run of ``answer``'s scenario, and the milliseconds for which the machine stood still meanwhile: if possible none."""
        for _ in range(MOST_LOOKS):
            again = self._driver.again(answer.name, answer.scenario, circumstances)
            gap = self._gaps.longest(again.trace)
            if not gap or not again.trace:
                break
        return again, gap

    def _causes_in(self, answer: Answer) -> set[Cause]:
        return {cause_of(finding) for finding in self._findings(answer)}

    def _findings(self, answer: Answer) -> list[Finding]:
        return self._monitor.judge(answer.disguised, answer.trace).findings if answer.trace else []


def _needed(late: Sequence[Finding]) -> int:
    """For how many milliseconds a machine must have been short of processors to explain the findings ``late``."""
    return max(TROUBLE, *(finding.late_by // _MILLISECOND for finding in late))


def _gap_reason(gap: int) -> str:
    return f"the machine stood still for {gap} ms when it was to be seen" if gap else ""
