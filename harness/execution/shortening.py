"""Finds the shortest scenario of each failure, and the smallest values in it, that show the same cause."""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence

from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.harness.execution import shrink, smaller_values
from ucm_cts.harness.execution.confirmation import Confirmation
from ucm_cts.harness.execution.driver import Answer, Driver
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
"""How long the search for a shorter scenario of one failure takes; its last try begins before."""

SECONDS_FOR_ALL_SHORTER = 180
"""The same for all failures of a run."""

SECONDS_FOR_SMALLER_VALUES = 5
"""How long the search for a smaller value with the same failure takes."""


class Shortening:
    """Shortens the failures of ``tally`` and replaces them there."""

    def __init__(self, driver: Driver, monitor: Monitor, confirmation: Confirmation, tally: Tally) -> None:
        self._driver = driver
        self._monitor = monitor
        self._confirmation = confirmation
        self._tally = tally

    def of_all(self) -> Iterator[Cause]:
        """Search the shortest scenario of each failure; yields each cause when it is done."""
        until = time.monotonic() + SECONDS_FOR_SHORTER_CRASHES
        last = time.monotonic() + SECONDS_FOR_ALL_SHORTER
        for cause, failure in list(self._tally.failures.items()):
            if failure.execution is None or failure.unstable or failure.finding.rule in HOST_CHECKS:
                continue
            incident = failure.execution.incident
            ends = min(time.monotonic() + SECONDS_FOR_SHORTER, last)

            def first_failing(candidates: Sequence[Scenario], cause: Cause = cause, ends: float = ends) -> int | None:
                shown = self._show(cause, candidates, until) if time.monotonic() < ends else None
                if shown is None:
                    return None
                self._tally.replace(cause, *shown[1:])
                return shown[0]

            if incident is None:
                soon = min(time.monotonic() + SECONDS_FOR_SMALLER_VALUES, last)
                smaller_values.smallest(failure.finding, failure.execution, first_failing, self._driver.seed, soon)
            smaller = self._tally.failures[cause].execution
            if smaller is not None and (incident is None or incident.kind in _QUICK):
                shrink.shortest(smaller.scenario, first_failing)
            yield cause

    def _show(
        self, cause: Cause, candidates: Sequence[Scenario], until: float
    ) -> tuple[int, Finding, Execution] | None:
        """The first of ``candidates`` that shows ``cause``; all are run, so that the host stays in step.

        Those that may end the host are run one by one, no more than needed, and none after ``until``.
        """
        first: tuple[int, Finding, Execution] | None = None
        known = self._tally.failures[cause].execution
        name = f"{known.name.removesuffix(_SHORTENED) if known is not None else cause[0]}{_SHORTENED}"
        cases = [(name, c) for c in candidates]
        alone = known is not None and known.incident is not None
        answers = self._one_by_one(cases, until) if alone else self._driver.run(cases)
        for index, answer in enumerate(answers):
            if first is None:
                execution = self._driver.revealed(answer)
                shown = [finding for finding in self._findings(answer, execution) if cause_of(finding) == cause]
                if shown:
                    first = index, shown[0], execution
            if first is not None and alone:
                break
        return first

    def _one_by_one(self, cases: Sequence[tuple[str, Scenario]], until: float) -> Iterator[Answer]:
        for case in cases:
            if time.monotonic() > until:
                return
            yield from self._driver.run([case], insist=True)

    def _findings(self, answer: Answer, execution: Execution) -> list[Finding]:
        """The findings about one answer, in the names of the scenario."""
        if answer.incident is not None:
            finding = finding_of_incident(execution)
            return [finding] if finding is not None else []
        findings = self._monitor.judge(answer.disguised, answer.trace).findings
        return [self._driver.reveal(finding) for finding in self._confirmation.outside_gaps(answer, findings)]
