"""One cause, one failure: which findings about a trace may follow from an earlier one, because both concern the same thing."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Mapping, Sequence

import msgspec

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract import trace as t
from ucm_cts.reference_models.findings import Finding
from ucm_cts.reference_models.model.runtime import Member

_OF_MEMBERS = (s.AddComponent, s.RemoveComponent, s.GetComponents)
"""What they concern besides the instance: who the members of a container are."""

_OF_ALL = (s.Start, s.Stop, s.RemoveContainer, s.CreateContainer)
"""They concern a container with all its members."""


class Causes:
    """What each finding about one trace concerns: instances, the membership or the phase of containers, connections."""

    def __init__(
        self, scenario: s.Scenario, trace: Iterable[t.Event], bodies: Mapping[tuple[str, int], Member]
    ) -> None:
        self._steps = scenario.steps
        self._events = {event.n: event for event in trace}
        self._bodies = bodies
        self._variables = {member.name: body for body, member in bodies.items()}

    def linked(self, findings: Sequence[Finding]) -> list[Finding]:
        """``findings``, each with the requirement that was violated first about what it concerns, if that is another one."""
        roots: list[tuple[Finding, frozenset[Hashable]]] = []
        causes: dict[int, str] = {}
        for index in sorted(range(len(findings)), key=lambda index: self._moment(findings[index])):
            finding = findings[index]
            concerned = self._concerned(finding)
            root = next((earlier for earlier, of in roots if of & concerned), None)
            if root is None:
                roots.append((finding, concerned))
            elif root.requirement != finding.requirement:
                causes[index] = root.requirement
        return [
            msgspec.structs.replace(finding, caused_by=causes[index]) if index in causes else finding
            for index, finding in enumerate(findings)
        ]

    def _moment(self, finding: Finding) -> int:
        """When it was violated: at its last event; by an operation of a container from the call on, before what happens within."""
        called = (n for n in finding.events if isinstance(self._events.get(n), t.Call))
        return min(called, default=max(finding.events, default=0))

    def _concerned(self, finding: Finding) -> frozenset[Hashable]:
        events = [self._events[n] for n in finding.events if n in self._events]
        steps = {event.step for event in events if isinstance(event, t.StepEvent)}
        if finding.step is not None:
            steps.add(finding.step)
        found: set[Hashable] = {event.body for event in events if isinstance(event, t.BodyEvent)}
        for step in (self._steps[number] for number in steps):
            found.update(self._of_step(step))
        return frozenset(found)

    def _of_step(self, step: s.Step) -> Iterable[Hashable]:
        container = getattr(step, "container", s.MANAGER)
        variable = step.bind or step.component if isinstance(step, s.AddComponent) else getattr(step, "id", "")
        if variable in self._variables:
            yield self._variables[variable]
        if isinstance(step, _OF_MEMBERS):
            yield "members", container
        if isinstance(step, _OF_ALL):
            yield "members", container
            yield from (body for body, member in self._bodies.items() if member.container.name == container)
        for name in ("connection", "link"):
            if value := getattr(step, name, ""):
                yield "connection", value
        if isinstance(step, s.Connect | s.Link):
            yield "connection", step.bind
