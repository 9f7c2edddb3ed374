"""Names in findings: each finding says which instance, port element, connection or container it is about."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

import msgspec

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract import trace as t
from ucm_cts.reference_models.findings import Finding
from ucm_cts.reference_models.model.designation import designation
from ucm_cts.reference_models.model.runtime import lane

_VARIABLES = ("bind", "component", "id", "connection", "link", "ref", "container")


class Namer:
    """Sees to it that the findings about one trace name what they are about."""

    def __init__(self, scenario: s.Scenario, trace: Iterable[t.Event]) -> None:
        self._scenario = scenario
        self._events = {event.n: event for event in trace}
        self._names = re.compile(
            "|".join(rf"(?<![\w.]){re.escape(name)}(?!\w)" for name in sorted(_names(scenario), key=len, reverse=True))
        )

    def named(self, finding: Finding) -> Finding:
        """``finding``, with what it is about before what was expected, unless it has a name already."""
        if self._names.search(f"{finding.expected} {finding.observed}"):
            return finding
        subject = self._subject(finding.step, [self._events[n] for n in finding.events if n in self._events])
        if not subject:
            return finding
        return msgspec.structs.replace(finding, expected=f"{subject}: {finding.expected}")

    def _subject(self, step: int | None, events: Sequence[t.Event]) -> str:
        bodies = [event for event in events if isinstance(event, t.BodyEvent)]
        if bodies:
            port = next((port for event in bodies if (port := getattr(event, "port", None))), None)
            return " and ".join(dict.fromkeys(lane(*event.body) for event in bodies)) + (f", {port}" if port else "")
        if step is None:
            step = next((event.step for event in events if isinstance(event, t.StepEvent)), None)
        return designation(self._scenario.steps[step]) if step is not None else ""


def _names(scenario: s.Scenario) -> set[str]:
    """All names of a scenario that a finding may mention."""
    names = {s.MANAGER, *scenario.components}
    for declaration in scenario.components.values():
        names.update(declaration.provides, declaration.requires)
    for step in scenario.steps:
        names.update(value for name in _VARIABLES if isinstance(value := getattr(step, name, None), str))
    return names - {""}
