"""Finds the shortest scenario of each failure, and the smallest values in it, that show the same cause."""

from __future__ import annotations

import time
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.harness.execution import shrink, smaller_values
from ucm_cts.harness.execution.confirmation import Confirmation
from ucm_cts.harness.execution.driving import Answer, Driving
from ucm_cts.harness.execution.leftovers import HOST_CHECKS
from ucm_cts.harness.results.incidents import finding_of_incident
from ucm_cts.harness.results.tally import Cause, Tally, cause_of
from ucm_cts.harness.results.values import Execution, IncidentKind
from ucm_cts.reference_models.findings import Finding
from ucm_cts.reference_models.monitor import Monitor

_SHORTENED = ", shortened"
"""The names of shortened scenarios end so; they begin with the name of the one that failed."""

_QUICK: frozenset[IncidentKind] = frozenset(("crash", "exit"))
"""Incidents whose scenarios are shortened; each try of another one would cost its whole deadline."""

SECONDS_FOR_SHORTER_CRASHES = 20
"""How long the search for shorter scenarios of crashes takes; each try takes two hosts."""

SECONDS_FOR_SHORTER = 10
"""How long the search for a shorter scenario of one failure takes at most; it ends with the try that goes on then."""

SECONDS_FOR_ALL_SHORTER = 60
"""The same for all failures of a run. Each has an equal share of what is left when its search begins."""

SECONDS_FOR_SMALLER_VALUES = 5
"""How long the search for a smaller value with the same failure takes."""


@dataclass(frozen=True)
class _Shown:
    """The candidate with this ``index`` shows the failure."""

    index: int
    finding: Finding
    execution: Execution
    answer: Answer


def _name_of_shorter(execution: Execution) -> str:
    return f"{execution.name.removesuffix(_SHORTENED)}{_SHORTENED}"


class Shortening:
    """Shortens the failures of ``tally`` and replaces them there."""

    def __init__(self, driver: Driving, monitor: Monitor, confirmation: Confirmation, tally: Tally) -> None:
        self._driver = driver
        self._monitor = monitor
        self._confirmation = confirmation
        self._tally = tally

    def of_all(self) -> Iterator[Cause]:
        """Search the shortest scenario of each failure; yields each cause when it is done."""
        until = time.monotonic() + SECONDS_FOR_SHORTER_CRASHES
        last = time.monotonic() + SECONDS_FOR_ALL_SHORTER
        searched = [(cause, execution) for cause in self._tally.failures if (execution := self._to_shorten(cause))]
        for number, (cause, execution) in enumerate(searched):
            incident = execution.incident
            began = time.monotonic()
            ends = began + min(SECONDS_FOR_SHORTER, (last - began) / (len(searched) - number))
            shortest: list[_Shown] = []

            def first_failing(
                candidates: Sequence[Scenario],
                cause: Cause = cause,
                execution: Execution = execution,
                ends: float = ends,
                shortest: list[_Shown] = shortest,
            ) -> int | None:
                within = ends if execution.incident is None else min(ends, until)
                shown = self._show(cause, candidates, within) if time.monotonic() < within else None
                if shown is None:
                    return None
                shortest[:] = [shown]
                return shown.index

            try:
                with self._driver.tries():
                    if incident is None:
                        finding = self._tally.failures[cause].finding
                        soon = min(began + SECONDS_FOR_SMALLER_VALUES, ends)
                        smaller_values.smallest(finding, execution, first_failing, self._driver.seed, soon)
                    if incident is None or incident.kind in _QUICK:
                        smaller = shortest[0].execution if shortest else execution
                        shrink.shortest(smaller.scenario, first_failing)
            finally:
                for shown in shortest:
                    self._tally.replace(cause, shown.finding, shown.execution)
                    self._driver.keep(cause, shown.answer)
            yield cause

    def adopt(self, cause: Cause, answer: Answer) -> str:
        """Replace the execution of ``cause`` by ``answer``, which an earlier search has found. Returns why it cannot; empty if it can."""
        known = self._to_shorten(cause)
        if known is None:
            return "it is no failure of this run that is shortened"
        if answer.name != _name_of_shorter(known):
            return f"it is not named '{_name_of_shorter(known)}'"
        execution = self._driver.revealed(answer)
        shown = next((one for one in self._findings(answer, execution) if cause_of(one) == cause), None)
        if shown is None:
            return "it does not show that failure"
        self._tally.replace(cause, shown, execution)
        return ""

    def _to_shorten(self, cause: Cause) -> Execution | None:
        """What shows ``cause``, if that is to be shortened."""
        failure = self._tally.failures.get(cause)
        if failure is None or failure.unstable or failure.finding.rule in HOST_CHECKS:
            return None
        return failure.execution

    def _show(self, cause: Cause, candidates: Sequence[Scenario], until: float) -> _Shown | None:
        """The first of ``candidates`` that shows ``cause``; none is begun when one has shown it, or after ``until``.

        Many are on their way at a time, but for those that may end the host. If some are when the time is up, the host is given up.
        """
        first: _Shown | None = None
        known = self._tally.failures[cause].execution
        assert known is not None
        name, alone = _name_of_shorter(known), known.incident is not None

        def cases() -> Iterator[tuple[str, Scenario]]:
            for candidate in candidates:
                if first is not None or time.monotonic() > until:
                    return
                yield name, candidate

        answers = self._one_by_one(cases()) if alone else self._driver.run(cases())
        for index, answer in enumerate(answers):
            if first is None:
                execution = self._driver.revealed(answer)
                shown = [finding for finding in self._findings(answer, execution) if cause_of(finding) == cause]
                if shown:
                    first = _Shown(index, shown[0], execution, answer)
            if time.monotonic() > until:
                break
        return first

    def _one_by_one(self, cases: Iterable[tuple[str, Scenario]]) -> Iterator[Answer]:
        for case in cases:
            yield from self._driver.run([case], insist=True)

    def _findings(self, answer: Answer, execution: Execution) -> list[Finding]:
        """The findings about one answer, in the names of the scenario."""
        if answer.incident is not None:
            finding = finding_of_incident(execution)
            return [finding] if finding is not None else []
        findings = self._monitor.judge(answer.disguised, answer.trace).findings
        return [self._driver.reveal(finding) for finding in self._confirmation.outside_gaps(answer, findings)]
