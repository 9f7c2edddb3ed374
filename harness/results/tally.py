"""Adds up all judged executions of a run: verdicts of the requirements, and the verdict of the run."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from typing import Protocol, TypeVar

import msgspec

from ucm_cts.harness.catalogue.requirements import Level, Requirement, decides
from ucm_cts.harness.models.core_models import Comparison
from ucm_cts.harness.results import values as v
from ucm_cts.harness.results.failures import reading_length, shortest_first
from ucm_cts.harness.results.incident_causes import DistinctIncidents
from ucm_cts.harness.results.known_failures import KnownFailure, waiver_for
from ucm_cts.reference_models.findings import Finding
from ucm_cts.reference_models.model.life_cycle import LifeCycleTable
from ucm_cts.reference_models.verdicts import RowTally, Verdicts

AnyReport = TypeVar("AnyReport", bound=v.Report)

Cause = tuple[str, str, str]
"""Requirement, rule and cause: findings that agree in these are one failure."""


Causes = tuple[tuple[Cause, tuple[str, ...]], ...]
"""Causes of failures, each with other requirements that were broken after it in the same scenarios."""


def cause_of(finding: Finding) -> Cause:
    """The key by which two findings are the same failure."""
    return finding.requirement, finding.rule, finding.cause


class Tally:
    """Counts what was exercised and keeps, for each cause of failure, the shortest execution that shows it."""

    def __init__(self) -> None:
        self.exercised: Counter[str] = Counter()
        self.failures: dict[Cause, v.ReportedFinding] = {}
        self.rows: dict[str, RowTally] = {}
        self.lost: dict[str, str] = {}
        self.seconds: defaultdict[str, float] = defaultdict(float)
        self._explained: dict[Cause, set[str]] = {}
        self._before: Counter[str] | None = None
        self._incidents = DistinctIncidents()
        self._untried: dict[str, v.IncidentReport] = {}
        self._left_out: dict[str, str] = {}
        self.scenarios = 0
        self.events = 0
        self.measures: Counter[str] = Counter()
        self.provoked: Counter[str] = Counter()
        self.readings: dict[str, set[str]] = {}
        self._settled: dict[str, tuple[v.Verdict, str]] = {}
        self._reasons: dict[str, str] = {}

    def add(self, execution: v.Execution, verdicts: Verdicts, findings: Sequence[Finding]) -> None:
        """Add one execution, the verdicts on it, and its findings in the scenario's names."""
        self.scenarios += 1
        self.events += len(execution.trace)
        self.exercised.update(verdicts.exercises)
        if verdicts.measures:
            self.measures.update(verdicts.measures)
        self._observe(verdicts.readings)
        for row, tally in verdicts.rows.items():
            self._add_row(row, tally)
        for finding in findings:
            self.add_failure(finding, v.TraceEvidence(execution))
        if findings:
            first = min(findings, key=lambda finding: min(finding.events, default=0))
            broken = {finding.requirement for finding in findings} - {first.requirement}
            self._explained.setdefault(cause_of(first), set()).update(broken)

    def _add_row(self, row: str, tally: RowTally) -> None:
        total = self.rows.setdefault(row, RowTally())
        total.exercised += tally.exercised
        total.violated += tally.violated
        total.readings |= tally.readings

    def _observe(self, readings: Mapping[str, Iterable[str]]) -> None:
        for option, values in readings.items():
            self.readings.setdefault(option, set()).update(values)

    def add_models(self, comparison: Comparison) -> None:
        """Add the results of comparing the framework's own models."""
        self._observe(comparison.readings)
        for result in comparison.results:
            if result.status in ("kept", "broken"):
                self.exercised[result.requirement] += 1
            if result.status == "broken":
                self.add_failure(
                    Finding(result.requirement, result.check, "models", result.expected, result.observed), None
                )
            elif result.status == "left out":
                self.settle(result.requirement, "not applicable", f"{result.expected}: {result.observed}")
            elif result.status != "kept":
                self.explain(result.requirement, f"models: {result.observed}")

    def settle(self, requirement: str, verdict: v.Verdict, reason: str) -> None:
        """Set the verdict of a requirement that no run decides, unless a finding breaks it."""
        self._settled.setdefault(requirement, (verdict, reason))

    def explain(self, requirement: str, reason: str) -> None:
        """Give the reason why no scenario exercises a requirement."""
        self._reasons.setdefault(requirement, reason)

    def deny(self, finding: Finding) -> None:
        """Add a finding that the vendor's statement itself shows."""
        self.exercised[finding.requirement] += 1
        self.add_failure(finding, None)

    def mark_unstable(self, finding: Finding, evidence: v.Evidence | None, reason: str) -> None:
        """``finding`` is unstable: another run of what ``evidence`` holds did not show it.

        Other evidence of the same cause counts less than this, until it is confirmed.
        """
        known = self.failures.get(cause_of(finding))
        if known is None or _repeatable(known.evidence) == _repeatable(evidence):
            occurrences = known.occurrences if known is not None else 1
            self.failures[cause_of(finding)] = v.ReportedFinding(finding, evidence, occurrences, unstable=reason)

    def add_failure(self, finding: Finding, evidence: v.Evidence | None) -> None:
        """Count ``finding`` once more, and keep the shorter evidence; before all, one that does not follow from another failure."""
        known = self.failures.get(cause_of(finding))
        new = v.ReportedFinding(finding, evidence)
        if known is None or known.unstable:
            occurrences = known.occurrences + 1 if known is not None else 1
            self.failures[cause_of(finding)] = msgspec.structs.replace(new, occurrences=occurrences)
            return
        self.failures[cause_of(finding)] = _shorter(known, new)

    def _join(self, cause: Cause, other: v.ReportedFinding) -> None:
        """Add what another tally has of ``cause``, as if its executions had come after those of this one."""
        known = self.failures.get(cause)
        if known is None:
            self.failures[cause] = other
        elif known.unstable and not other.unstable:
            self.failures[cause] = msgspec.structs.replace(other, occurrences=known.occurrences + other.occurrences)
        elif not other.unstable:
            self.failures[cause] = _shorter(known, other)

    def replace(self, cause: Cause, finding: Finding, execution: v.Execution) -> None:
        """A shorter execution of the same cause has been found; it does not count as another occurrence."""
        known = self.failures[cause]
        if not known.finding.caused_by:
            finding = msgspec.structs.replace(finding, caused_by="")
        self.failures[cause] = msgspec.structs.replace(known, finding=finding, evidence=v.TraceEvidence(execution))

    def add_incident(self, execution: v.Execution, requirements: Iterable[str], finding: Finding | None = None) -> None:
        """An execution that ended in an incident; ``requirements`` are those it meant to exercise, ``finding`` what it shows."""
        incident = execution.incident
        assert incident is not None
        if incident.kind == "untried":
            known = self._untried.get(incident.detail, v.IncidentReport(incident, execution, 0))
            self._untried[incident.detail] = msgspec.structs.replace(known, occurrences=known.occurrences + 1)
            for requirement in requirements:
                self._left_out.setdefault(requirement, incident.detail)
            return
        self.scenarios += 1
        self.events += len(execution.trace)
        requirements = tuple(requirements)
        self._incidents.add(execution, requirements)
        if incident.kind not in v.FRAMEWORK_INCIDENTS:
            for requirement in requirements:
                self.lost.setdefault(requirement, f"{incident.kind}: {incident.detail}")
            return
        if finding is not None:
            self.exercised[finding.requirement] += 1
            self.add_failure(finding, v.TraceEvidence(execution))

    @property
    def causes(self) -> Causes:
        """The cause of each failure in the order in which they were met, with the requirements that were broken after it."""
        return tuple((cause, tuple(sorted(self._explained.get(cause, ())))) for cause in self.failures)

    def restore(self, report: v.FrameworkReport, causes: Causes) -> None:
        """Add what another tally of the same run, or of a part of it, had reported; ``causes`` are that tally's.

        What no run decides must have been added before: each report has it.
        """
        if self._before is None:
            self._before = self.exercised.copy()
        measured: dict[Cause, v.ReportedFinding] = {}
        for result in report.requirements:
            self.exercised[result.id] += result.exercised - self._before[result.id]
            self.seconds[result.id] += result.seconds
            measured |= {cause_of(failed.finding): failed for failed in result.findings if failed.evidence is not None}
        for cause, explained in causes:
            if cause in measured:
                self._join(cause, msgspec.structs.replace(measured[cause], waived="", explains=()))
            self._explained.setdefault(cause, set()).update(explained)
        for row in report.transitions:
            self._add_row(row.row, RowTally(row.exercised, row.violated, {*row.readings}))
        for incident in report.incidents:
            if incident.incident.kind != "untried":  # their test purposes are run again
                self._incidents.add_report(incident)
        self._observe(report.readings)
        self.provoked.update(report.provoked)
        self.measures.update(report.effort.measures)
        self.scenarios += report.scenarios
        self.events += report.events

    @property
    def incidents(self) -> tuple[v.IncidentReport, ...]:
        """One of each cause, as scenarios that were not tried for the same reason are one."""
        left_out = (
            msgspec.structs.replace(one, incident=v.Incident("untried", f"{one.occurrences} scenarios {reason}"))
            for reason, one in self._untried.items()
        )
        return (*self._incidents.reports, *left_out)

    def results(
        self, requirements: Sequence[Requirement], known_failures: Sequence[KnownFailure]
    ) -> tuple[v.RequirementResult, ...]:
        """The verdict of each requirement of the profile, testable ones only."""
        by_requirement: dict[str, list[v.ReportedFinding]] = {}
        for failure in self.failures.values():
            by_requirement.setdefault(failure.finding.requirement, []).append(failure)
        results = [
            self._result(r, by_requirement.get(r.id, []), known_failures) for r in requirements if not r.untestable
        ]
        return tuple(_without_circles(results))

    def _result(
        self, requirement: Requirement, failures: list[v.ReportedFinding], known_failures: Sequence[KnownFailure]
    ) -> v.RequirementResult:
        by_length = shortest_first(tuple(failures))
        waived = tuple(
            msgspec.structs.replace(
                f, waived=waiver_for(f.finding, known_failures), explains=self._explained_by(f.finding)
            )
            for f in by_length
            if not f.unstable
        )
        verdict, reason = self._verdict(requirement.id, by_length, bool(waived))
        findings = waived or tuple(by_length)
        exercised = self.exercised[requirement.id]
        causes = [f.finding.caused_by for f in waived]
        return v.RequirementResult(
            requirement.id,
            requirement.clause,
            requirement.title,
            verdict,
            exercised,
            findings,
            reason,
            caused_by=causes[0] if causes and all(causes) else "",
            level=requirement.level,
            seconds=round(self.seconds[requirement.id], 3),
        )

    def _explained_by(self, finding: Finding) -> tuple[str, ...]:
        """The other requirements that failed in scenarios in which ``finding`` came first."""
        failed = {requirement for (requirement, _, _), one in self.failures.items() if not one.unstable}
        return tuple(sorted(failed & self._explained.get(cause_of(finding), set())))

    def _verdict(self, requirement: str, failures: Sequence[v.ReportedFinding], fails: bool) -> tuple[v.Verdict, str]:
        """The verdict, and the reason for any but pass and fail. Where it does not fail, ``failures`` are unstable."""
        if fails:
            return "fail", ""
        if failures:
            return "inconclusive", failures[0].unstable
        if requirement in self._settled:
            return self._settled[requirement]
        if requirement in self.lost:
            return "error", f"a scenario that was to exercise it was lost ({self.lost[requirement]})"
        if self.exercised[requirement]:
            return "pass", ""
        reason = self._reasons.get(requirement, "its condition never arose in this run")
        if requirement in self._left_out:
            reason += f"; scenarios that were to exercise it were {self._left_out[requirement]}"
        return "inconclusive", reason

    def transitions(self, table: LifeCycleTable) -> tuple[v.TransitionResult, ...]:
        """The result of each row of the table."""
        empty = RowTally()
        rows = [(row.id, self.rows.get(row.id, empty)) for row in table.rows]
        return tuple(v.TransitionResult(i, t.exercised, t.violated, tuple(sorted(t.readings))) for i, t in rows)


def _shorter(known: v.ReportedFinding, other: v.ReportedFinding) -> v.ReportedFinding:
    """The one with the shorter evidence, and the occurrences of both; before all, one that does not follow from another failure."""
    best = min(known, other, key=lambda one: (bool(one.finding.caused_by), reading_length(one)))
    return msgspec.structs.replace(best, occurrences=known.occurrences + other.occurrences)


def _without_circles(results: Sequence[v.RequirementResult]) -> Iterator[v.RequirementResult]:
    """Of two requirements that both failed after each other neither explains the other, unless it is named as its cause."""
    explained = {result.id: {one for f in result.findings for one in f.explains} for result in results}
    caused_by = {result.id: result.caused_by for result in results}
    for result in results:
        after = {
            id_ for id_ in explained[result.id] if result.id in explained.get(id_, ()) and caused_by[id_] != result.id
        }
        findings = tuple(
            msgspec.structs.replace(f, explains=tuple(id_ for id_ in f.explains if id_ not in after))
            for f in result.findings
        )
        yield msgspec.structs.replace(result, findings=findings)


def _repeatable(evidence: v.Evidence | None) -> object:
    """What another run of ``evidence`` repeats."""
    return evidence.execution if isinstance(evidence, v.TraceEvidence) else evidence


class Counted(Protocol):
    """A requirement's result, of a run or as it was read from a report."""

    @property
    def verdict(self) -> v.Verdict:
        """Its verdict."""

    @property
    def level(self) -> Level:
        """Its level."""


def overall(results: Sequence[Counted], incidents: Sequence[object], incomplete: str = "") -> v.Overall:
    """Not conformant if any requirement failed; conformant if all passed without incident, unless the run is ``incomplete``.
    Recommendations do not count.
    """
    deciding = [result.verdict for result in results if decides(result.level)]
    if "fail" in deciding:
        return "not conformant"
    if incomplete or incidents or "inconclusive" in deciding or "error" in deciding or not deciding:
        return "inconclusive"
    return "conformant"


def ended_early(report: AnyReport, incomplete: str) -> AnyReport:
    """``report`` as one of a run that ended early for the reason ``incomplete``; as it is if that is empty."""
    if not incomplete:
        return report
    verdict = overall(report.requirements, v.incidents_of(report), incomplete)
    return msgspec.structs.replace(report, verdict=verdict, incomplete=incomplete)


def of_selection(report: AnyReport, expression: str, asked: Collection[str]) -> AnyReport:
    """``report`` with the verdicts on what ``expression`` selected, the requirements ``asked``, and on what it showed besides."""
    results = tuple(r for r in report.requirements if r.id in asked or r.findings or r.verdict in ("pass", "fail"))
    verdict = overall(results, v.incidents_of(report), report.incomplete)
    return msgspec.structs.replace(report, requirements=results, verdict=verdict, selection=expression)
