"""Judges the traces of an old record by the rules of this suite, to say which requirements would change (delta certification).

The scenarios are those of the old suite, so nothing is said about what this one would run. The report is no certificate.
"""

from __future__ import annotations

from collections import defaultdict

import msgspec

import ucm_cts
from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.adapters.contract.trace import Trace
from ucm_cts.harness.catalogue.requirements import load_life_cycle, load_options, requirements_of
from ucm_cts.harness.certificates.problems import unreadable
from ucm_cts.harness.execution import leftovers
from ucm_cts.harness.execution.record import Answered, Record, Repeated
from ucm_cts.harness.results.foreign import one_line
from ucm_cts.harness.results.incidents import finding_of_incident
from ucm_cts.harness.results.known_failures import KnownFailure
from ucm_cts.harness.results.statement import Statement, default_statement
from ucm_cts.harness.results.tally import Tally, overall
from ucm_cts.harness.results.values import Execution, FrameworkReport, TraceEvidence
from ucm_cts.harness.statement.checks import check_statement
from ucm_cts.reference_models.findings import Finding
from ucm_cts.reference_models.monitor import Monitor

NOT_FROM_TRACES = frozenset((leftovers.FREED,))
"""Requirements that traces do not decide: what an old certificate says of them stays."""


def judged_by_this_suite(
    record: Record, profile: str, statement: Statement, known: tuple[KnownFailure, ...]
) -> FrameworkReport:
    """The report that the rules of this suite give on the traces of ``record``. Raises ``Unreadable``."""
    today = fitted(statement)
    monitor = Monitor(load_life_cycle(), today.ics)
    requirements = list(requirements_of(profile))
    tally = Tally()
    check_statement(today, profile, requirements, tally)
    repeats: dict[str, list[frozenset[str]]] = defaultdict(list)
    answers: list[tuple[Answered, Scenario, Trace]] = []
    for entry, trace in record.performed():
        if not isinstance(entry, Answered | Repeated):
            continue
        scenario = _scenario(record.scenario(entry))
        if isinstance(entry, Answered):
            answers.append((entry, scenario, trace))
        elif trace:
            repeats[entry.name].append(frozenset(f.requirement for f in monitor.judge(scenario, trace).findings))
    for entry, scenario, trace in answers:
        execution = Execution(entry.name, scenario, trace, entry.incident)
        if entry.incident is not None and not entry.is_whole:
            tally.add_incident(execution, (), finding_of_incident(execution))
            continue
        verdicts = monitor.judge(scenario, trace)
        steady = [f for f in verdicts.findings if _is_steady(f, repeats[entry.name])]
        tally.add(execution, verdicts, steady)
        for finding in verdicts.findings:
            if finding not in steady:
                tally.mark_unstable(finding, TraceEvidence(execution), "the second look of the old run did not show it")
    results = tally.results(requirements, known)
    return FrameworkReport(
        product=record.heading.identity.product,
        version=record.heading.identity.version,
        profile=profile,
        verdict=overall(results, tally.incidents, ""),
        requirements=results,
        transitions=tally.transitions(load_life_cycle()),
        incidents=tally.incidents,
        adapter=record.heading.adapter,
        suite_version=ucm_cts.__version__,
        seed=record.heading.seed,
        started=record.heading.started,
        seconds=0.0,
        scenarios=tally.scenarios,
        events=tally.events,
        statement=today,
        readings={option: tuple(sorted(values)) for option, values in sorted(tally.readings.items())},
    )


def fitted(statement: Statement) -> Statement:
    """``statement`` with what this suite asks for: what is new has its default, and what is gone is left out."""
    default, options = default_statement(), load_options()

    def merged(ours: dict[str, object], theirs: dict[str, object]) -> dict[str, object]:
        return {name: theirs.get(name, value) for name, value in ours.items()}

    readings = {o: v for o, v in statement.readings.items() if v in options.get(o, ())}
    return msgspec.structs.replace(
        statement,
        capabilities=merged(dict(default.capabilities), dict(statement.capabilities)),
        readings=merged(dict(default.readings), dict(readings)),
        ixit=merged(dict(default.ixit), dict(statement.ixit)),
    )


def _is_steady(finding: Finding, repeats: list[frozenset[str]]) -> bool:
    return all(finding.requirement in shown for shown in repeats)


def _scenario(raw: bytes) -> Scenario:
    try:
        return msgspec.json.decode(raw, type=Scenario)
    except (msgspec.MsgspecError, RecursionError) as error:
        raise unreadable(
            "record", f"this suite does not know a scenario of the record any more: {one_line(str(error), 120)}"
        ) from None
