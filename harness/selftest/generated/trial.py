"""Runs a generated mutant through the ordinary pipeline, until the first failure."""

from __future__ import annotations

import functools
import time
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Literal

import msgspec

from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.catalogue.requirements import load_life_cycle
from ucm_cts.harness.execution.campaign import Campaign
from ucm_cts.harness.execution.confirmation import Confirmation
from ucm_cts.harness.execution.driver import Driver
from ucm_cts.harness.hosting.hosts import HostUnavailable, Limits
from ucm_cts.harness.hosting.locate import WrongUse, locate
from ucm_cts.harness.purposes.scripts import TestPurpose
from ucm_cts.harness.results.statement import Statement
from ucm_cts.harness.results.values import FRAMEWORK_INCIDENTS, Execution, Incident
from ucm_cts.harness.statement.applicability import purposes_for
from ucm_cts.harness.statement.files import read_statement
from ucm_cts.reference_models.monitor import Monitor

AT_ONCE = 8
"""How many scenarios are run before the failures are read; a purpose may have hundreds."""

PATIENCE = 500
"""Milliseconds, as a vendor would declare them: mutants often never do what is waited for, and their machine is this one."""

MORE_PATIENCE = 4
"""The factor of patience when an incident is confirmed."""

INCIDENT_SECONDS = 10
"""What incidents may take before scenarios that would meet more of them are left out: one is enough."""

Fate = Literal["failed", "incident", "not loaded", "not certified", "survived", "open", "not compiled", "same program"]
"""What became of a mutant: a requirement failed; it crashed, hung or answered nonsense; it could not be loaded; the run ended
inconclusive; it was certified; or the quick trial
did not decide, and the pipeline has not run yet. By the compiler: it is no program, or the original one."""


class Outcome(Value, frozen=True):
    """The result of one generated mutant.

    ``fate``: what happened.
    ``by``: the failed requirement, or the kind of incident.
    ``scenario``: the scenario that showed it.
    ``detail``: what was observed.
    ``seconds``: duration.
    """

    fate: Fate
    by: str = ""
    scenario: str = ""
    detail: str = ""
    seconds: float = 0.0


def try_out(adapter: str, statement: Statement, clauses: Sequence[str], suspect: str, seed: int) -> Outcome:
    """Run profile core on ``adapter``, purpose ``suspect`` first, then those of ``clauses``, until something is wrong."""
    began = time.monotonic()
    outcome = _try_out(adapter, statement, ordered(statement, clauses, suspect), seed)
    return msgspec.structs.replace(outcome, seconds=round(time.monotonic() - began, 2))


def _try_out(adapter: str, statement: Statement, purposes: Sequence[TestPurpose], seed: int) -> Outcome:
    try:
        with Driver(locate(adapter), seed, Limits(incident_seconds=INCIDENT_SECONDS)) as driver:
            campaign = Campaign(driver, "core", (), statement)
            confirmation = Confirmation(driver, Monitor(load_life_cycle(), statement.ics), driver.gaps, Counter())
            for checked in campaign.check(_in_small_parts(purposes)):
                for finding, execution in checked.failures:
                    if execution.incident is not None:
                        return _of_incident(adapter, seed, execution, execution.incident)
                    if finding is not None and confirmation.of_failure(finding, execution) is None:
                        detail = f"{finding.rule}: {finding.observed}"
                        return Outcome("failed", finding.requirement, execution.name, detail)
            campaign.confirm()
            report = campaign.report()
    except (HostUnavailable, WrongUse) as problem:
        return Outcome("not loaded", detail=str(problem).strip().rpartition("\n")[2])
    if report.verdict == "conformant":
        return Outcome("survived")
    undecided = [f"{r.id} {r.verdict}" for r in report.requirements if r.verdict not in ("pass", "not applicable")]
    return Outcome("not certified", ", ".join(undecided), detail=report.verdict)


def _of_incident(adapter: str, seed: int, execution: Execution, incident: Incident) -> Outcome:
    """Incidents of hosts that died or hung are confirmed already; others are confirmed here, with more patience."""
    detail = incident.detail.partition("\n")[0]
    if incident.kind not in FRAMEWORK_INCIDENTS or "never came back" in detail or not incident.reproduced:
        patient = msgspec.structs.replace(execution.scenario, patience=MORE_PATIENCE * execution.scenario.patience)
        with Driver(locate(adapter), seed) as driver:
            (again,) = driver.run([(execution.name, patient)], insist=True)
        if again.incident is None:
            return Outcome("not certified", incident.kind, execution.name, f"seen once: {detail}")
    return Outcome("incident", incident.kind, execution.name, detail)


@functools.cache
def stated(path: Path) -> Statement:
    """The statement at ``path``, less patient."""
    statement = read_statement(path)
    return msgspec.structs.replace(statement, ixit={**statement.ixit, "patience": PATIENCE})


def ordered(statement: Statement, clauses: Sequence[str], suspect: str = "") -> list[TestPurpose]:
    """The purposes of profile core: ``suspect``, then those of ``clauses``, then all others."""
    purposes = purposes_for(statement, "core")
    return sorted(purposes, key=lambda purpose: (purpose.id != suspect, not purpose.clause.startswith(tuple(clauses))))


def _in_small_parts(purposes: Sequence[TestPurpose]) -> Iterator[TestPurpose]:
    for purpose in purposes:
        if purpose.draw or len(purpose.scenarios) <= AT_ONCE:
            yield purpose
            continue
        for first in range(0, len(purpose.scenarios), AT_ONCE):
            yield replace(purpose, scenarios=purpose.scenarios[first : first + AT_ONCE])
