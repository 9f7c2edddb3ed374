"""The same run several times, with other seeds: a requirement whose verdict is not the same in all of them is unstable."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence

import msgspec

from ucm_cts.harness.catalogue.requirements import load_life_cycle
from ucm_cts.harness.execution.driver import Circumstances, Driver, Limits
from ucm_cts.harness.hosting.locate import Endpoint
from ucm_cts.harness.results import values as v
from ucm_cts.harness.results.incident_causes import DistinctIncidents
from ucm_cts.harness.results.tally import cause_of, overall
from ucm_cts.reference_models.model.ics import Ics
from ucm_cts.reference_models.monitor import Monitor

SEEDS = 3
"""The scenario of a failure is run again for up to this many runs that did not show it, until one does not show it."""

Steady = Callable[[v.ReportedFinding, int], v.Execution | None]
"""Runs the scenario of a failure with the seed of another run; the execution, unless that one shows the failure, too."""


def steady_search(endpoint: Endpoint, limits: Limits, ics: Ics) -> Steady:
    """Searches for executions without the failure, on hosts behind ``endpoint``."""
    monitor = Monitor(load_life_cycle(), ics)

    def steady(failed: v.ReportedFinding, seed: int) -> v.Execution | None:
        if failed.execution is None:
            return None
        with Driver(endpoint, seed, limits) as driver:
            answer = driver.again(failed.execution.name, failed.execution.scenario, Circumstances())
            findings = monitor.judge(answer.disguised, answer.trace).findings
            shown = not answer.trace or any(f.requirement == failed.finding.requirement for f in findings)
            return None if shown else driver.revealed(answer)

    return steady


def repeated(reports: Sequence[v.FrameworkReport], steady: Steady) -> v.FrameworkReport:
    """One report of all runs, which differ in their seeds only; the first one's is the report's."""
    first = reports[0]
    if len(reports) == 1:
        return first
    requirements = tuple(
        _result(results, reports, steady) for results in zip(*(r.requirements for r in reports), strict=True)
    )
    incidents = _incidents(reports)
    incomplete = next((report.incomplete for report in reports if report.incomplete), "")
    return msgspec.structs.replace(
        first,
        verdict=overall(requirements, incidents, incomplete),
        requirements=requirements,
        incidents=incidents,
        transitions=tuple(map(_transition, zip(*(r.transitions for r in reports), strict=True))),
        seconds=round(sum(report.seconds for report in reports), 3),
        scenarios=sum(report.scenarios for report in reports),
        events=sum(report.events for report in reports),
        warnings=tuple(dict.fromkeys(warning for report in reports for warning in report.warnings)),
        readings=_readings(reports),
        provoked=dict(sum((Counter(report.provoked) for report in reports), Counter())),
        effort=_effort(reports),
        runs=len(reports),
        incomplete=incomplete,
        isolation=v.weakest(report.isolation for report in reports),
    )


def _result(
    results: Sequence[v.RequirementResult], reports: Sequence[v.FrameworkReport], steady: Steady
) -> v.RequirementResult:
    """The verdict that all runs agree on, or that it is unstable."""
    verdicts = Counter(result.verdict for result in results)
    exercised = sum(result.exercised for result in results)
    seconds = round(sum(result.seconds for result in results), 3)
    worst = next(
        (result for result in results if result.verdict == "fail"),
        max(results, key=lambda result: len(result.findings)),
    )
    if len(verdicts) == 1:
        findings = _joined(results)
        return msgspec.structs.replace(worst, exercised=exercised, findings=findings, seconds=seconds)
    counts = ", ".join(f"{verdict} in {number}" for verdict, number in verdicts.most_common())
    reason = f"unstable: of {len(results)} runs with other seeds {counts}"
    kept = [r.seed for r, result in zip(reports, results, strict=True) if result.verdict == "pass"][:SEEDS]

    def with_steady(failed: v.ReportedFinding) -> v.Evidence | None:
        if failed.execution is None:
            return failed.evidence
        other = failed.steady or next(filter(None, (steady(failed, seed) for seed in kept)), None)
        return v.TraceEvidence(failed.execution, other)

    findings = tuple(
        msgspec.structs.replace(failed, unstable=reason, evidence=with_steady(failed)) for failed in _joined(results)
    )
    return msgspec.structs.replace(
        worst, verdict="inconclusive", exercised=exercised, findings=findings, reason=reason, seconds=seconds
    )


def _joined(results: Sequence[v.RequirementResult]) -> tuple[v.ReportedFinding, ...]:
    """Each cause once, with all its occurrences."""
    known: dict[tuple[str, str, str], v.ReportedFinding] = {}
    for failed in (failed for result in results for failed in result.findings):
        cause = cause_of(failed.finding)
        before = known.get(cause, msgspec.structs.replace(failed, occurrences=0))
        known[cause] = msgspec.structs.replace(
            before,
            occurrences=before.occurrences + failed.occurrences,
            explains=tuple(sorted({*before.explains, *failed.explains})),
        )
    return tuple(known.values())


def _incidents(reports: Sequence[v.FrameworkReport]) -> tuple[v.IncidentReport, ...]:
    """Each cause once, with all its occurrences."""
    distinct = DistinctIncidents()
    for incident in (incident for report in reports for incident in report.incidents):
        distinct.add_report(incident)
    return distinct.reports


def _transition(rows: Sequence[v.TransitionResult]) -> v.TransitionResult:
    return v.TransitionResult(
        rows[0].row,
        sum(row.exercised for row in rows),
        sum(row.violated for row in rows),
        tuple(sorted({reading for row in rows for reading in row.readings})),
    )


def _readings(reports: Sequence[v.FrameworkReport]) -> dict[str, tuple[str, ...]]:
    options = sorted({option for report in reports for option in report.readings})
    return {
        option: tuple(sorted({value for report in reports for value in report.readings.get(option, ())}))
        for option in options
    }


def _effort(reports: Sequence[v.FrameworkReport]) -> v.Effort:
    measures: Counter[str] = Counter()
    seconds: Counter[str] = Counter()
    for report in reports:
        measures.update(report.effort.measures)
        seconds.update(report.effort.seconds)
    return v.Effort(dict(measures.most_common()), {clause: round(spent, 3) for clause, spent in seconds.items()})
