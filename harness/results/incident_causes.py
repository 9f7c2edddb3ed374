"""Groups incidents: those that agree in kind, in detail and in the operation in progress are one."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import NamedTuple

import msgspec

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.harness.results.failures import length
from ucm_cts.harness.results.foreign import one_line
from ucm_cts.harness.results.incidents import is_waiting, last_open_call
from ucm_cts.harness.results.values import FRAMEWORK_INCIDENTS, Execution, IncidentKind, IncidentReport

NOT_AGAIN = "not when run once more"
"""In place of an operation: the second run, which would have shown it, did not show the incident."""

_DIFFERENT = re.compile(r"0[xX][0-9a-fA-F]+|\b(?=[a-fA-F-]*\d)[0-9a-fA-F-]{8,}\b|\d+(?:[.,]\d+)*")
"""Addresses, hexadecimal ids and numbers."""

_SAME_AGAIN = re.compile(r"([^\s,]+)(?:, \1)+(?![^\s,])")
"""A list of things that are all alike by now."""


class IncidentCause(NamedTuple):
    """The key by which two incidents are the same.

    ``detail`` is its first line, in which numbers, ids, addresses and names of components are all alike; ``operation`` was
    in progress, or is empty if nothing is known of that. Calls that wait for a start are kept apart from other calls that hang.
    """

    kind: IncidentKind
    detail: str
    operation: str
    waits: bool = False

    @property
    def is_open(self) -> bool:
        """Whether no second run showed the operation in progress."""
        return not self.operation and self.kind in FRAMEWORK_INCIDENTS

    def may_be(self, other: IncidentCause) -> bool:
        """Are both the same, as far as is known?"""
        vague = any(one.is_open or one.operation == NOT_AGAIN for one in (self, other))
        return self[:2] == other[:2] and (vague or self[2:] == other[2:])


def cause_of_incident(execution: Execution) -> IncidentCause:
    """The cause of the incident that ``execution`` ended in."""
    incident = execution.incident
    assert incident is not None
    first = next(iter(incident.detail.splitlines()), "")
    for name in execution.scenario.components:
        first = re.sub(rf"\b{re.escape(name)}\b", "#", first)
    alike = _SAME_AGAIN.sub(r"\1", _DIFFERENT.sub("#", one_line(first)))
    call = last_open_call(execution.trace)
    steps = execution.scenario.steps
    operation = s.operation(steps[call.step]) if call is not None and call.step < len(steps) else ""  # hosts may lie
    if not incident.reproduced:
        operation = NOT_AGAIN
    return IncidentCause(incident.kind, alike, operation, is_waiting(execution))


def during(cause: IncidentCause) -> str:
    """When it happened, in words that continue the incident's description; empty if it is not known."""
    if cause.operation in ("", NOT_AGAIN):
        return cause.operation and f", {cause.operation}"
    return f", during {cause.operation}"


class DistinctIncidents:
    """For each cause the shortest scenario that met it, and how many did."""

    def __init__(self) -> None:
        self._met: dict[IncidentCause, IncidentReport] = {}

    def add(self, execution: Execution, requirements: Iterable[str] = ()) -> None:
        """Add one that was to exercise ``requirements``. Without a known operation it counts as one of those that it may be."""
        assert execution.incident is not None
        self.add_report(IncidentReport(execution.incident, execution, requirements=tuple(requirements)))

    def add_report(self, new: IncidentReport) -> None:
        """Add the incidents of ``new``, which have one cause."""
        execution = new.execution
        cause = cause_of_incident(execution)
        alike = [one for one in self._met if one.may_be(cause) and NOT_AGAIN not in (one.operation, cause.operation)]
        counted, requirements = new.occurrences, {*new.requirements}
        known = self._met.get(cause)
        if known is None and cause.is_open and alike:
            cause = max(alike, key=lambda one: self._met[one].occurrences)
            known = new = self._met[cause]
        others = [self._met.pop(one) for one in alike if one.is_open and one != cause]  # their operation is known now
        for report in (*others, *([known] if known is not None else [])):
            counted += report.occurrences
            requirements.update(report.requirements)
        best = known if known is not None and length(known.execution) <= length(execution) else new
        self._met[cause] = msgspec.structs.replace(best, occurrences=counted, requirements=tuple(sorted(requirements)))

    @property
    def reports(self) -> tuple[IncidentReport, ...]:
        """All of them, in the order in which they were first met."""
        return tuple(self._met.values())
