"""One run on one IUT: drives scenarios, judges, confirms, shortens and adds up."""

from __future__ import annotations

import datetime
import math
import time
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass

import ucm_cts
from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.harness.catalogue.requirements import load_life_cycle, requirements_of
from ucm_cts.harness.execution import leftovers
from ucm_cts.harness.execution.campaign_state import CampaignState
from ucm_cts.harness.execution.confirmation import (
    OF_THE_MACHINE,
    OTHERWISE,
    Confirmation,
    Unconfirmed,
    timed_requirements,
)
from ucm_cts.harness.execution.driving import Answer, Driving
from ucm_cts.harness.execution.judging import Judge
from ucm_cts.harness.execution.shortening import Shortening
from ucm_cts.harness.purposes.payloads import Payloads
from ucm_cts.harness.purposes.provocations.coverage import provocations
from ucm_cts.harness.purposes.scripts import TestPurpose
from ucm_cts.harness.results.incidents import finding_of_incident
from ucm_cts.harness.results.known_failures import KnownFailure
from ucm_cts.harness.results.statement import Statement, default_statement
from ucm_cts.harness.results.tally import Cause, Tally, overall
from ucm_cts.harness.results.values import (
    FRAMEWORK_INCIDENTS,
    Effort,
    Execution,
    FrameworkReport,
    Isolation,
    TraceEvidence,
    weakest,
)
from ucm_cts.harness.statement.checks import check_statement
from ucm_cts.reference_models.findings import Finding
from ucm_cts.reference_models.verdicts import Verdicts

SECONDS_FOR_CONFIRMATION = 60
"""How long all further runs may take; failures that were not run again by then count as they are."""

SEEN_OFTEN = 10
"""A failure that so many runs of scenarios showed is no accident, even if the run that is to confirm it does not show it."""

NOT_CONFIRMED = "failures that were not run again"
"""The measure of how many failures were not run again because the time was used up."""

BUSY = "the machine was busy, or stood still: lateness that was seen once, and not when the scenario was run four times more, was not counted"
"""The warning of a report that measures ``OF_THE_MACHINE``."""


@dataclass(frozen=True)
class Checked:
    """The result of one test purpose: the failures that its scenarios showed, of any requirement."""

    purpose: TestPurpose
    executions: int
    failures: tuple[tuple[Finding | None, Execution], ...]


class Campaign:
    """Runs test purposes on the driver's implementation and collects verdicts. Use ``check`` often, ``report`` once."""

    def __init__(
        self,
        driver: Driving,
        profile: str,
        known_failures: Sequence[KnownFailure] = (),
        statement: Statement | None = None,
        judge: Judge | None = None,
    ) -> None:
        """``judge`` is one by the ``statement``."""
        self._driver = driver
        self.profile = profile
        self.known = known_failures
        self.statement = statement or default_statement()
        self.checked: list[TestPurpose] = []
        self._judge = judge or Judge(self.statement.ics)
        self._monitor = self._judge.monitor
        self._requirements = list(requirements_of(profile))
        self._tally = Tally()
        check_statement(self.statement, profile, self._requirements, self._tally)
        self._confirmation = Confirmation(driver, self._monitor, driver.gaps, self._tally.measures)
        self._shortening = Shortening(driver, self._monitor, self._confirmation, self._tally)
        self._payloads = Payloads(driver.seed)
        self._timed: dict[str, tuple[str, Scenario]] = {}
        self._took: dict[str, float] = {}
        self._done: list[str] = []
        self._spent: dict[str, float] = {}
        self._warned: tuple[str, ...] = ()
        self._isolations: list[Isolation] = []
        self._began = time.monotonic()
        self._started = datetime.datetime.now(datetime.UTC).isoformat(timespec="seconds")

    def check(
        self, purposes: Iterable[TestPurpose], watch: Callable[[Answer, Verdicts], None] | None = None
    ) -> Iterator[Checked]:
        """Run all scenarios of ``purposes`` in one pipelined stream; yields each purpose as soon as it is judged.

        Those that were done in a state that was restored are left out. ``watch`` gets each answer with a trace, and the
        verdicts on it.
        """
        queue: deque[TestPurpose] = deque()
        before = frozenset(self._done)

        depends = not isinstance(purposes, Sequence)  # what is drawn next may depend on the verdicts before
        begun = {} if depends else self._begun([purpose for purpose in purposes if purpose.id not in before])

        def cases() -> Iterator[tuple[str, Scenario]]:
            for purpose in purposes:
                if purpose.id not in before:
                    queue.append(purpose)
                    for place, (name, scenario) in enumerate(self._scenarios_of(purpose)):
                        known = begun.pop((purpose.id, place), None)
                        yield known or (name, self._payloads.deal(scenario))

        answers = self._driver.run(cases())
        failures: list[tuple[Finding | None, Execution]] = []
        done = 0
        is_lost = False
        since = time.monotonic()
        for answer, verdicts in self._judge.judged(answers, at_once=depends):
            purpose = queue[0]
            failures.extend(self._take(answer, verdicts, purpose, watch))
            is_lost |= answer.incident is not None and answer.incident.kind not in FRAMEWORK_INCIDENTS
            done += 1
            if done == len(purpose.scenarios):
                failures.extend(self._examine_leftovers(purpose) if not failures else ())
                now = time.monotonic()
                self._spent[purpose.clause] = self._spent.get(purpose.clause, 0.0) + now - since
                for requirement in purpose.requirements:
                    self._tally.seconds[requirement] += (now - since) / len(purpose.requirements)
                since = now
                self.checked.append(purpose)
                if not is_lost:
                    self._done.append(purpose.id)
                yield Checked(queue.popleft(), done, tuple(failures))
                failures, done, is_lost = [], 0, False

    def _begun(self, purposes: Iterable[TestPurpose]) -> dict[tuple[str, int], tuple[str, Scenario]]:
        """The named scenarios of ``purposes`` that further hosts begin with, by the ids of these and their places in them."""
        if not self._driver.has_side_hosts:
            return {}
        begun = {
            (purpose.id, place): (name, self._payloads.deal(scenario))
            for purpose in purposes
            for place, (name, scenario) in enumerate(self._scenarios_of(purpose))
            if self._driver.may_begin(scenario)
        }
        self._driver.begin(list(begun.values()))
        return begun

    def _scenarios_of(self, purpose: TestPurpose) -> tuple[tuple[str, Scenario], ...]:
        """Its scenarios; where values are drawn, within what the vendor says of them."""
        return purpose.draw(self._driver.seed, self.statement.ics.readings) if purpose.draw else purpose.scenarios

    def _take(
        self,
        answer: Answer,
        verdicts: Verdicts | None,
        purpose: TestPurpose,
        watch: Callable[[Answer, Verdicts], None] | None,
    ) -> Iterator[tuple[Finding | None, Execution]]:
        if verdicts is None:
            execution = self._driver.revealed(answer)
            judged = list(self._judge_hang(answer, execution)) if answer.is_whole else []
            finding = finding_of_incident(execution)
            if finding is not None and any(set(other.events) & set(finding.events) for other, _ in judged):
                finding = None  # a property has found the same call, or operation, lacking
            self._tally.add_incident(execution, purpose.requirements, finding)
            yield finding, execution
            yield from judged
            return
        self._tally.provoked.update(p.name for p in provocations(answer.disguised, answer.trace))
        if watch is not None:
            watch(answer, verdicts)
        if not verdicts.findings:
            self._tally.add(Execution(answer.name, answer.scenario, answer.trace), verdicts, ())
            took = answer.trace[-1].t - answer.trace[0].t if answer.trace else 0
            for requirement in sorted(timed_requirements().intersection(verdicts.exercises)):
                self._keep_quickest(requirement, (answer.name, answer.scenario), took)
            return
        execution = self._driver.revealed(answer)
        confirmed, unconfirmed = self._confirmation.separate(answer, verdicts.findings)
        findings = [self._driver.reveal(finding) for finding in confirmed]
        self._tally.add(execution, verdicts, findings)
        self._mark_unstable(execution, unconfirmed)
        for finding in findings:
            yield finding, execution

    def _examine_leftovers(self, purpose: TestPurpose) -> Iterator[tuple[Finding, Execution]]:
        """If ``purpose`` asks whether destroy frees resources: what many destroyed runtimes leave in their host."""
        if leftovers.FREED not in purpose.requirements:
            return
        patience = self.statement.ixit["patience"] / 1000
        for name, scenario in purpose.scenarios:
            try:
                examined = leftovers.examine(self._driver, name, scenario, patience)
            except leftovers.NotCounted:
                if self._driver.isolation in ("none", "remote"):
                    reason = "there is no process of a host on this machine whose threads and files can be counted"
                    self._tally.settle(leftovers.FREED, "not applicable", reason)
                else:  # a host can hide them, which is no excuse
                    reason = (
                        "threads and files of the host's process could not be counted, although it is on this machine"
                    )
                    self._tally.explain(leftovers.FREED, reason)
                continue
            if examined is None:
                continue
            answer, finding = examined
            self._tally.exercised[leftovers.FREED] += 1
            if finding is not None:
                execution = self._driver.revealed(answer)
                self._tally.add_failure(finding, TraceEvidence(execution))
                yield finding, execution

    def _judge_hang(self, answer: Answer, execution: Execution) -> Iterator[tuple[Finding, Execution]]:
        """Judge the trace of a scenario whose threads never came back: a property may forbid that."""
        findings = self._monitor.judge(answer.disguised, answer.trace).findings
        confirmed, unconfirmed = self._confirmation.separate(answer, findings)
        for finding in map(self._driver.reveal, confirmed):
            self._tally.exercised[finding.requirement] += 1
            self._tally.add_failure(finding, TraceEvidence(execution))
            yield finding, execution
        self._mark_unstable(execution, unconfirmed)

    def confirm(self, passes: bool = True) -> None:
        """Run again each failure that was seen once, one failure of each requirement that failed more often and, with
        ``passes``, one scenario of each requirement that was kept and depends on time.

        The runs have another timeout and another schedule. A result that changes is unstable and gives no verdict.
        A failure that ``SEEN_OFTEN`` runs showed is not run again: one more run cannot refute them.
        """
        began = time.monotonic()
        allowance = self._driver.allow(SECONDS_FOR_CONFIRMATION)
        confirmed: set[str] = set()
        for failure in list(self._tally.failures.values()):
            execution, requirement = failure.execution, failure.finding.requirement
            if execution is None or execution.incident is not None or failure.unstable:
                continue
            if failure.finding.rule in leftovers.HOST_CHECKS:  # dozens of runs have shown it
                continue
            if failure.occurrences >= SEEN_OFTEN or (failure.occurrences > 1 and requirement in confirmed):
                continue
            if allowance.is_used_up():
                self._tally.measures[NOT_CONFIRMED] += 1
                continue
            unconfirmed = self._confirmation.of_failure(failure.finding, execution)
            if unconfirmed is not None:
                self._mark_unstable(execution, [unconfirmed])
            else:
                confirmed.add(requirement)
        again = self._passes_to_confirm() if passes else {}
        self._driver.look_ahead(again.items(), OTHERWISE)
        for name, scenario in again.items():
            if allowance.is_used_up():
                break
            answer, findings, not_confirmed = self._confirmation.of_pass(name, scenario)
            if findings or not_confirmed:
                execution = self._driver.revealed(answer)
                for finding in findings:
                    self._tally.add_failure(self._driver.reveal(finding), TraceEvidence(execution))
                self._mark_unstable(execution, not_confirmed)
        self._spent["confirmation"] = self._spent.get("confirmation", 0.0) + time.monotonic() - began

    def begin_to_confirm(self) -> None:
        """Further hosts may begin to run again what ``confirm`` will have run again, as far as that is known."""
        self._driver.look_ahead(self._passes_to_confirm().items(), OTHERWISE)

    def _passes_to_confirm(self) -> dict[str, Scenario]:
        """One scenario of each requirement that was kept and depends on time, by its name."""
        failed = {requirement for requirement, _, _ in self._tally.failures}
        kept = [case for requirement, case in self._timed.items() if requirement not in failed]
        return dict(kept)

    def _mark_unstable(self, execution: Execution, unconfirmed: Iterable[Unconfirmed]) -> None:
        for one in unconfirmed:
            steady = self._driver.revealed(one.steady) if one.steady is not None else None
            self._tally.mark_unstable(self._driver.reveal(one.finding), TraceEvidence(execution, steady), one.reason)

    def shorten(self) -> Iterator[Cause]:
        """Search the shortest scenario of each failure; yields each cause when it is done."""
        yield from self._shortening.of_all()

    def take_shorter(self, cause: Cause, answer: Answer) -> str:
        """Show ``cause`` with ``answer``, which a search of an earlier run has found. Returns why that cannot be, empty if it can."""
        return self._shortening.adopt(cause, answer)

    def count(self, measure: str, times: int) -> None:
        """Add ``times`` to a measure of the run's effort."""
        self._tally.measures[measure] += times

    @property
    def state(self) -> CampaignState:
        """What was measured so far, to be restored in another campaign of the same purposes."""
        timed, took, causes = dict(self._timed), dict(self._took), self._tally.causes
        return CampaignState(self.report(), tuple(self._done), timed, took, causes)

    def restore(self, state: CampaignState) -> None:
        """Go on from ``state``. Call it before ``check``; for several parts of one run, in their order."""
        self._tally.restore(state.report, state.causes)
        self._tally.measures.pop(NOT_CONFIRMED, None)  # they will be
        for requirement, case in state.timed.items():
            self._keep_quickest(requirement, case, state.took[requirement])
        self._done += state.done
        for clause, seconds in state.report.effort.seconds.items():
            self._spent[clause] = self._spent.get(clause, 0.0) + seconds
        self._began -= state.report.seconds
        self._started = min(self._started, state.report.started)
        self._warned = tuple(dict.fromkeys((*self._warned, *state.report.warnings)))
        self._isolations.append(state.report.isolation)

    def pass_over(self, purposes: Iterable[TestPurpose]) -> None:
        """Draw names and payloads for ``purposes`` and run nothing: later ones get those that they have in a run of all."""
        for purpose in purposes:
            for _, scenario in self._scenarios_of(purpose):
                self._driver.disguise.scenario(self._payloads.deal(scenario))

    def _keep_quickest(self, requirement: str, case: tuple[str, Scenario], took: float) -> None:
        """Of the scenarios that keep a requirement that depends on time, the quickest is confirmed."""
        if took < self._took.get(requirement, math.inf):
            self._timed[requirement], self._took[requirement] = case, took

    def report(self, incomplete: str = "") -> FrameworkReport:
        """All verdicts of the run so far; ``incomplete`` says why it ended early, if it did."""
        results = self._tally.results(self._requirements, self.known)
        incidents = self._tally.incidents
        identity = self._driver.identity
        busy = (BUSY,) if self._tally.measures[OF_THE_MACHINE] else ()
        return FrameworkReport(
            product=identity.product,
            version=identity.version,
            profile=self.profile,
            verdict=overall(results, incidents, incomplete),
            requirements=results,
            transitions=self._tally.transitions(load_life_cycle()),
            incidents=incidents,
            adapter=self._driver.adapter,
            adapter_file=self._driver.adapter_file,
            warnings=tuple(dict.fromkeys((*self._warned, *self._driver.warnings, *busy))),
            suite_version=ucm_cts.__version__,
            seed=self._driver.seed,
            started=self._started,
            seconds=round(time.monotonic() - self._began, 3),
            scenarios=self._tally.scenarios,
            events=self._tally.events,
            statement=self.statement,
            readings={option: tuple(sorted(values)) for option, values in sorted(self._tally.readings.items())},
            provoked=dict(sorted(self._tally.provoked.items())),
            effort=Effort(
                dict(self._tally.measures.most_common()),
                {clause: round(seconds, 3) for clause, seconds in self._spent.items()},
            ),
            incomplete=incomplete,
            isolation=weakest((*self._isolations, self._driver.isolation)),
        )
