"""Exploration: generates scenarios one after the other and sends them, many at a time, through the ordinary pipeline.

Of a few candidates the one is sent whose transitions of the life-cycle model are the rarest so far. A scenario that shows events in an
order not seen before is changed and becomes a candidate again.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import count
from typing import Literal

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.harness.catalogue.profiles import PARTS
from ucm_cts.harness.catalogue.requirements import load_life_cycle
from ucm_cts.harness.execution.campaign import Campaign, Checked
from ucm_cts.harness.execution.driver import Answer
from ucm_cts.harness.exploring.changing import changed
from ucm_cts.harness.exploring.core_writer import CoreWriter
from ucm_cts.harness.exploring.extension_writer import WRITTEN_PARTS, extension_scenario
from ucm_cts.harness.exploring.memory import Identity, Memory, Remembered
from ucm_cts.harness.exploring.novelty import Events, Guide
from ucm_cts.harness.exploring.writer import Writer
from ucm_cts.harness.purposes.scripts import TestPurpose
from ucm_cts.harness.results.incident_causes import IncidentCause, cause_of_incident
from ucm_cts.harness.results.incidents import is_waiting
from ucm_cts.harness.results.statement import Statement
from ucm_cts.harness.results.tally import Cause, cause_of
from ucm_cts.harness.results.values import Execution
from ucm_cts.harness.statement.applicability import fitting, with_policies
from ucm_cts.reference_models.findings import Finding
from ucm_cts.reference_models.verdicts import Verdicts

DRAWN = "explored"
"""The names of drawn scenarios begin so."""

KNOWN = "known"
"""The names of remembered scenarios begin so."""

CANDIDATES = 4
"""So many scenarios are compared for one that is sent."""

CHANGED = 0.15
"""So often a candidate is one that showed something new, changed."""

LAG = 128
"""After this many further scenarios a new one is varied. It is more than are in the pipeline at a time, so that a seed repeats the run."""

TRIES = 3
"""How often the scenario of a remembered failure is run before the failure counts as gone."""

IN_VAIN = 64
"""After this many scenarios in a row that were left out because of incidents, no more are drawn."""

_CALLED_AGAIN = (s.INDEX_TIMERS, s.OBJECT_TIMERS, s.PERIODIC_SELF_EXECUTING)
"""Policies by which a component is called again and again."""


@dataclass(frozen=True)
class Progress:
    """How far an exploration has come.

    ``scenarios``: run so far.
    ``rows``: of the life-cycle table, visited.
    ``of``: rows of the life-cycle table.
    ``events``: pairs of successive events that were seen.
    ``failures``: different causes.
    """

    scenarios: int
    rows: int
    of: int
    events: int
    failures: int


Fate = Literal["still there", "no longer shown", "unknown"]
"""The fate of a remembered failure; None if an incident or the end of the time came first."""


@dataclass(frozen=True)
class Replayed:
    """A remembered failure and its fate."""

    remembered: Remembered
    fate: Fate


class Exploration:
    """Looks for failures with the scenarios that it draws, and adds them to a campaign. Use ``replay`` before ``explore``."""

    def __init__(self, campaign: Campaign, seed: int, memory: Memory | None) -> None:
        """``seed``: of the scenarios. ``memory``: the failures known so far, if any are kept."""
        self._statement: Statement = campaign.statement
        self._memory = memory
        self._campaign = campaign
        self._random = random.Random(f"exploration {seed}")
        self._all_rows = load_life_cycle().rows
        self._guide = Guide(load_life_cycle())
        self._events = Events()
        self._rows: set[str] = set()
        self._new: list[tuple[int, Scenario]] = []
        self._failures: list[tuple[Finding | None, Execution]] = []
        self._causes: set[Cause] = set()
        self._incidents: set[IncidentCause] = set()
        self._unexplained: set[IncidentCause] = set()
        self._run = 0
        claimed = self._statement.extensions if "extensions" in PARTS[campaign.profile] else ()
        self._parts = [part for part in WRITTEN_PARTS if part in claimed]

    def replay(self) -> list[Replayed]:
        """Run the remembered failures. One that is not shown any more is forgotten, unless an incident came first."""
        if self._memory is None:
            return []
        remembered = missing = self._memory.recall()
        answered: set[Identity] = set()
        for attempt in range(1, TRIES + 1):
            again = (self._purpose(f"{KNOWN} {n}.{attempt}", one.scenario) for n, one in enumerate(missing, 1))
            for one, checked in zip(missing, self._check(again), strict=True) if missing else ():
                if _is_decided(one, checked):
                    answered.add(one.identity)
            missing = [one for one in missing if not self._is_shown(one)]
        gone = answered & {one.identity for one in missing}
        for identity in gone:
            self._memory.forget(identity)
        return [Replayed(one, _fate(one in missing, one.identity in gone)) for one in remembered]

    def _is_shown(self, one: Remembered) -> bool:
        if one.incident is not None:
            return any(one.incident.may_be(met) for met in self._incidents)
        return (one.requirement, one.rule, one.cause) in self._causes

    def explore(self) -> Iterator[Progress]:
        """Draw and run scenarios; yields after each. Ends by itself only if nothing more can be tried."""
        in_vain = 0
        seen = len(self._failures)
        for checked in self._check(self._purposes()):
            self._run += 1
            for failure in self._failures[seen:]:
                self._remember(*failure)
            seen = len(self._failures)
            yield Progress(self._run, len(self._rows), len(self._all_rows), len(self._events), len(self._failures))
            kinds = {execution.incident.kind for _, execution in checked.failures if execution.incident}
            in_vain = in_vain + 1 if "untried" in kinds else 0
            if in_vain >= IN_VAIN or "unreachable" in kinds:
                return

    @property
    def failures(self) -> list[tuple[Finding | None, Execution]]:
        """The first failure of each cause so far, remembered ones included; of an incident that explains none, no finding."""
        return list(self._failures)

    def _check(self, purposes: Iterator[TestPurpose]) -> Iterator[Checked]:
        for checked in self._campaign.check(purposes, self._watch):
            self._campaign.checked.pop()  # an exploration has no end
            for finding, execution in checked.failures:
                if finding is not None and cause_of(finding) not in self._causes:
                    self._causes.add(cause_of(finding))
                    self._failures.append((finding, execution))
                incident = execution.incident
                if incident is not None and incident.kind != "untried" and not is_waiting(execution):
                    cause = cause_of_incident(execution)
                    self._incidents.add(cause)
                    if finding is None and cause not in self._unexplained:
                        self._unexplained.add(cause)
                        self._failures.append((None, execution))
            yield checked

    def _remember(self, finding: Finding | None, execution: Execution) -> None:
        """Keep a failure at once: an exploration takes hours, and may be killed before its end."""
        if self._memory is None:
            return
        if finding is not None:
            self._memory.remember_first(Remembered.of_finding(finding, execution.scenario))
        elif execution.incident is not None and execution.incident.kind != "unreachable":
            self._memory.remember_first(Remembered.of_incident(execution))

    def _purposes(self) -> Iterator[TestPurpose]:
        for number in count(1):
            known = [scenario for found, scenario in self._new if found <= number - LAG]
            of_core = "core" in PARTS[self._campaign.profile] and number % 2 == 0
            of_extensions = self._parts and number % 4 == 1
            draw = self._draw_core if of_core else partial(self._draw, known)
            draw = self._draw_extension if of_extensions else draw
            yield self._purpose(f"{DRAWN} {number}", self._guide.choose([draw() for _ in range(CANDIDATES)]))

    def _draw(self, known: Sequence[Scenario]) -> Scenario:
        choose = self._random.choice
        vary = known and self._random.random() < CHANGED
        drawn = changed(choose(known), choose) if vary else Writer(choose).scenario()
        return with_policies(drawn, self._statement)

    def _draw_core(self) -> Scenario:
        """A scenario that needs only what the vendor claims."""
        for _ in range(TRIES):
            drawn = fitting([("", CoreWriter(self._random.choice).scenario())], self._statement)
            if drawn and not self._may_wait_for_ever(drawn[0][1]):
                return drawn[0][1]
        return self._draw(())

    def _may_wait_for_ever(self, scenario: Scenario) -> bool:
        """Does the vendor declare that a call waits until its link is mended (``service-failure``)? No drawn scenario sees to that."""
        waits = self._statement.readings["service-failure"] == "wait"
        return waits and any(isinstance(step, s.Break) for step in scenario.steps)

    def _draw_extension(self) -> Scenario:
        """A scenario of a part of profile extensions that the vendor claims."""
        part = self._random.choice(self._parts)
        drawn = fitting([("", extension_scenario(part, self._random.choice))], self._statement)
        return drawn[0][1] if drawn else self._draw_core()

    def _purpose(self, name: str, scenario: Scenario) -> TestPurpose:
        text = "A random scenario, drawn for this run."
        return TestPurpose(name, "explored", text, (), ((name, scenario),))

    def _watch(self, answer: Answer, verdicts: Verdicts) -> None:
        self._rows |= verdicts.rows.keys()
        may_change = not answer.scenario.interfaces and not _is_called_again(answer.scenario)
        if self._events.are_new(answer.disguised, answer.trace) and may_change:
            self._new.append((self._run, answer.scenario))


def _is_called_again(scenario: Scenario) -> bool:
    """Whether components are called without end: a call that a change adds could wait behind ever more of these calls."""
    policies = (policy.definition for one in scenario.components.values() for policy in one.policies)
    return any(definition in _CALLED_AGAIN for definition in policies)


def _is_decided(one: Remembered, checked: Checked) -> bool:
    """Does an execution of its scenario show whether ``one`` is still there? Not if another incident came first."""
    met = [execution for _, execution in checked.failures if execution.incident is not None]
    if one.incident is None or not met:
        return not met
    causes = [cause_of_incident(execution) for execution in met]
    return not any(cause.is_open or cause.kind in ("untried", "unreachable") for cause in causes)


def _fate(is_missing: bool, is_gone: bool) -> Fate:
    if is_gone:
        return "no longer shown"
    return "unknown" if is_missing else "still there"
