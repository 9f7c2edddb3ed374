"""Incidents of the framework: the finding that each gives, and the time that a run spends on them.

Once incidents have used up their time, scenarios with an operation that has met an incident are left out.
"""

from __future__ import annotations

from collections import Counter

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.adapters.contract.trace import Call, Create, Enter, Exit, Raise, Reply, Request, Return, Skip, Trace
from ucm_cts.harness.results.unanswered_calls import finding_of_lost_call
from ucm_cts.harness.results.values import FRAMEWORK_INCIDENTS, Execution, Incident, IncidentKind
from ucm_cts.reference_models.findings import Finding
from ucm_cts.reference_models.model.designation import designation
from ucm_cts.reference_models.model.operation import DECLARED_ERRORS
from ucm_cts.reference_models.properties.clause_11_2_2 import DECLARED

FREE_CONFIRMATIONS = 0.25
"""The part of the incident time in which every incident gets a second run."""

CONFIRMATIONS = 2
"""After that part, an operation with this many incidents of a kind explains the next one of that kind."""


class IncidentTime:
    """The time that a run spends on incidents: ``seconds`` in all."""

    def __init__(self, seconds: float) -> None:
        self.seconds = seconds
        self._spent = 0.0
        self._spent_confirming = 0.0
        self._met: Counter[tuple[str, IncidentKind]] = Counter()
        self._exhausted = False
        self._unoffered: set[str] = set()

    def note_skips(self, scenario: Scenario, trace: Trace) -> None:
        """Note the connectors that ``trace`` shows the adapter not to offer."""
        for event in trace:
            if type(event) is Skip:
                step = scenario.steps[event.step]
                if isinstance(step, s.Link) and event.variable == s.operation(step):
                    self._unoffered.add(step.connector)

    def not_tried(self, scenario: Scenario) -> Incident | None:
        """Why ``scenario`` is left out; None if it is to be run.

        A scenario with a connector that is not offered is left out, because each of its waits would last in vain.
        """
        links = (step.connector for step in scenario.steps if isinstance(step, s.Link))
        unoffered = next((connector for connector in links if connector in self._unoffered), None)
        if unoffered is not None:
            return Incident("untried", f"not tried: the adapter does not offer {unoffered}")
        if self._spent < self.seconds:
            return None
        reason = f"incidents had taken {self.seconds:g} s (--incident-time)"
        if self._exhausted:
            return Incident("untried", f"not tried: {reason}")
        for (operation, kind), _ in self._met.most_common():
            if operation in _operations(scenario):
                return Incident("untried", f"not tried: {operation} had met a {kind} before, and {reason}")
        return None

    def is_worth_confirming(self, scenario: Scenario, kind: IncidentKind) -> bool:
        """Is ``scenario`` to be run again after an incident of this kind?"""
        if self._spent_confirming < FREE_CONFIRMATIONS * self.seconds:
            return True
        return not any(self._met[operation, kind] >= CONFIRMATIONS for operation in _operations(scenario))

    def spend_confirming(self, seconds: float) -> None:
        """A further run after an incident has taken ``seconds``."""
        self._spent_confirming += seconds

    def spend(self, seconds: float, scenario: Scenario, incident: Incident, trace: Trace) -> None:
        """An incident has taken ``seconds`` in all; ``trace`` is the known part of its trace."""
        self._spent += seconds
        call = last_open_call(trace)
        if call is not None:
            self._met[s.operation(scenario.steps[call.step]), incident.kind] += 1
        elif self._spent >= self.seconds and not any(self._met[o, incident.kind] for o in _operations(scenario)):
            self._exhausted = True  # the operation is not known, so no scenario can be left out for it


def finding_of_incident(execution: Execution) -> Finding | None:
    """A business call that a hang shows to be lost; or a crash, exit, hang or memory blow-up inside an operation, which did not
    end as declared (12.10), or else while a business call was open.
    """
    incident = execution.incident
    call = last_open_call(execution.trace)
    if incident is None or incident.kind not in FRAMEWORK_INCIDENTS:
        return None
    lost = finding_of_lost_call(execution)
    if lost is not None and incident.kind == "hang":
        return lost
    if call is None or is_waiting(execution):
        return lost
    operation = s.operation(execution.scenario.steps[call.step])
    if operation not in DECLARED:
        return lost
    requirement, declared = DECLARED[operation], DECLARED_ERRORS[operation]
    return Finding(
        requirement,
        "declared_errors",
        f"{operation} {incident.kind}",
        f"{designation(execution.scenario.steps[call.step])} returns or raises {' or '.join(declared)}",
        f"it did not end: {incident.kind}, {incident.detail}",
        (call.n,),
        call.step,
    )


def is_unexplained(execution: Execution) -> bool:
    """Is it a crash, exit, hang or memory blow-up that fails no requirement, as on a thread of the framework's own?"""
    incident = execution.incident
    ours = incident is None or incident.kind not in FRAMEWORK_INCIDENTS
    return not ours and not is_waiting(execution) and finding_of_incident(execution) is None


def may_wait(scenario: Scenario, trace: Trace) -> bool:
    """Was a call under way when ``trace`` broke off, while a component was not operational, so that it may have to wait for
    the start (11.2.3)?
    """
    pending: Counter[tuple[str, int, int]] = Counter()
    ready: dict[tuple[str, int], bool] = {}
    invoked = set()
    for event in trace:
        match event:
            case Call() if isinstance(scenario.steps[event.step], s.Invoke):
                invoked.add(event.step)
            case Return() | Raise():
                invoked.discard(event.step)
            case Request() | Reply():
                pending[event.component, event.instance, event.thread] += 1 if isinstance(event, Request) else -1
            case Create():
                ready[event.component, event.instance] = False
            case Exit(hook="on_startup"):
                ready[event.component, event.instance] = not event.raised
            case Enter(hook="on_shutdown"):
                ready[event.component, event.instance] = False
    return bool(invoked or +pending) and not all(ready.values())


def is_waiting(execution: Execution) -> bool:
    """Does the execution hang in a call that may wait for the start of a component?"""
    hangs = execution.incident is not None and execution.incident.kind == "hang"
    return hangs and may_wait(execution.scenario, execution.trace)


def last_open_call(trace: Trace) -> Call | None:
    """The operation that was in progress when the trace broke off."""
    calls = {e.step: e for e in trace if isinstance(e, Call)}
    for event in trace:
        if isinstance(event, Return | Raise):
            calls.pop(event.step, None)
    return calls[max(calls)] if calls else None


def _operations(scenario: Scenario) -> set[str]:
    return {s.operation(step) for step in scenario.steps}
