"""Clock and trace (10.1.4), which a container provides to its components by their policies.

A body gets the clock and the trace among its dependencies, under the names that its policies give. Calls are recorded
where they are made or come in, before they are carried out; the runtime keeps the log.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from typing import TypeVar

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.programming_model import Implementation, PortConnection, PortElementObject, UcmError
from ucm_cts.adapters.reference.python.members import Member
from ucm_cts.adapters.reference.python.policies import ExecutesComponents

T = TypeVar("T")

_SERVICES = {s.CLOCK, s.COMPONENT_TRACE, s.PORT_TRACE}
_SECOND, _MILLISECOND, _MICROSECOND = 1_000_000_000, 1_000_000, 1_000

Record = tuple[str, str]
"""Severity and message."""


class ServiceElement(PortElementObject):
    """A port element that the container provides to one of its components by ``policy``."""

    def __init__(self, container: OffersServices, member: Member, policy: s.Policy) -> None:
        self.container, self.member, self.policy = container, member, policy

    def exchange(self, value: int) -> int:
        raise UcmError(f"{self.policy.definition!r} has no method 'exchange'")


class ClockElement(ServiceElement):
    """clock_service_intf."""

    def call(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        container = self.container
        if method == "get_local_time":
            return [container._time_value(container._local_time(self.member) + container.manager.advanced)]
        if method == "get_synchronized_time":
            return [container._time_value(container._synchronized_time(self.member) + container.manager.advanced)]
        raise UcmError(f"the clock has no method {method!r}")


class TraceElement(ServiceElement):
    """trace_service_intf."""

    def call(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        if method != "log":
            raise UcmError(f"the trace has no method {method!r}")
        severity, message = arguments
        container = self.container
        if severity not in container.severities:
            raise UcmError(f"there is no severity {severity!r}")
        container._log(self.member, str(severity), str(message))
        return []


class TracedElement(PortElementObject):
    """Stands for a port element, provided or required, whose calls are traced."""

    def __init__(self, container: OffersServices, member: Member, port: str, element: PortElementObject) -> None:
        self.container, self.member, self.port, self.element = container, member, port, element

    def exchange(self, value: int) -> int:
        return self._traced("exchange", lambda: self.element.exchange(value))

    def call(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        return self._traced(method, lambda: self.element.call(method, arguments))

    def _traced(self, method: str, work: Callable[[], T]) -> T:
        return self.container._trace_call(self.member, self.port, method, work)


class OffersServices(ExecutesComponents):
    """The part of a container that offers clock and trace. One concern each, for variants to override."""

    manager: OffersServices
    log: list[Record]
    """The manager keeps all records of the runtime."""
    severities: Sequence[str] = ("trace", "debug", "info", "warning", "error", "critical")
    """The enumerators of log_severity_t, least first."""

    def _check_policies(self, implementation: Implementation) -> None:
        others = [p for p in implementation.policies if p.definition not in _SERVICES]
        super()._check_policies(replace(implementation, policies=others))
        for policy in implementation.policies:
            if policy.definition in _SERVICES:
                self._check_service(implementation, policy)
        self._check_clocks(implementation)

    def _check_service(self, implementation: Implementation, policy: s.Policy) -> None:
        if policy.definition == s.PORT_TRACE:
            fits = policy.port in {*implementation.provides, *implementation.requires} and not policy.element
            fits = fits and policy.parameters.keys() == {s.METHODS_TO_TRACE, s.LOG_SEVERITY}
            fits = fits and policy.parameters[s.LOG_SEVERITY] in self.severities
        else:
            fits = policy.port is None and policy.element is not None and not policy.parameters
        if not fits:
            raise UcmError(f"{implementation.name!r} has a policy that cannot be applied: {policy}")

    def _check_clocks(self, implementation: Implementation) -> None:
        if sum(policy.definition == s.CLOCK for policy in implementation.policies) > 1:
            raise UcmError(f"{implementation.name!r} has more than one clock")

    # references to port elements

    def _with_services(self, member: Member, connections: Iterable[PortConnection]) -> list[PortConnection]:
        """The dependencies of a body at start: its connections, traced as its policies say, and its clocks and traces."""
        traced = [PortConnection(c.from_port, self._traced_references(member, c)) for c in connections]
        elements = [self._service_element(member, p) for p in member.implementation.policies if p.element is not None]
        return [*traced, *elements]

    def _traced_references(self, member: Member, connection: PortConnection) -> tuple[PortElementObject | None, ...]:
        port = connection.from_port
        if not self._port_traces(member, port):
            return tuple(connection.to_port)
        return tuple(target and TracedElement(self, member, port, target) for target in connection.to_port)

    def _service_element(self, member: Member, policy: s.Policy) -> PortConnection:
        kind = ClockElement if policy.definition == s.CLOCK else TraceElement
        return PortConnection(policy.element or "", (kind(self, member, policy),))

    def _reference_to(self, member: Member, port: str) -> PortElementObject | None:
        element = super()._reference_to(member, port)
        if element is None or not self._port_traces(member, port):
            return element
        return member.traced.setdefault(port, TracedElement(self, member, port, element))

    # the clock, in nanoseconds

    advanced = 0
    """Virtual time by which all clocks of the runtime are ahead."""

    def advance(self, milliseconds: int) -> None:
        self.manager.advanced += milliseconds * _MILLISECOND

    def _local_time(self, member: Member) -> int:
        return time.time_ns()

    def _synchronized_time(self, member: Member) -> int:
        return time.time_ns()

    def _time_value(self, nanoseconds: int) -> list[Datum]:
        """ucm_timeval_t."""
        seconds, rest = divmod(nanoseconds, _SECOND)
        return [seconds % 2**32, rest // _MICROSECOND]

    # the trace

    def _port_traces(self, member: Member, port: str) -> list[s.Policy]:
        return [p for p in member.implementation.policies if p.definition == s.PORT_TRACE and p.port == port]

    def _log(self, member: Member, severity: str, message: str) -> None:
        """Record a message of a body."""
        self._write((severity, message))

    def _trace_call(self, member: Member, port: str, method: str, work: Callable[[], T]) -> T:
        """Record and carry out a call through a traced port element."""
        for policy in self._port_traces(member, port):
            if self._is_traced(policy, method):
                self._write((policy.parameters[s.LOG_SEVERITY], self._call_message(member, port, method)))
        return work()

    def _is_traced(self, policy: s.Policy, method: str) -> bool:
        return method in (name.strip() for name in policy.parameters[s.METHODS_TO_TRACE].split(","))

    def _call_message(self, member: Member, port: str, method: str) -> str:
        return f"{member.implementation.name} {port}: {method}"

    def _write(self, record: Record) -> None:
        self.manager.log.append(record)
