"""The technical policies of an implementation, sorted by what a framework does with them (10.1.3, 10.1.4)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.programming_model import UcmError

EXECUTION = (s.SELF_EXECUTING, s.ACTIVE, s.PROTECTED_PASSIVE, s.UNPROTECTED_PASSIVE)


@dataclass(frozen=True)
class PortTrace:
    """A policy port_trace: the framework leaves a record of each call of certain methods.

    ``port``: the traced port element, provided or required; None: all port elements of the component.
    ``methods``: names of the methods to trace.
    ``severity``: severity of the records.
    """

    port: str | None
    methods: frozenset[str]
    severity: str


@dataclass(frozen=True)
class Policies:
    """The policies of one implementation.

    ``executions``: definitions of the execution policies, each once.
    ``managed``: port elements that the thread of an active component serves.
    ``elements``: policies that make the component require a port element (clock, trace, timers), by that port element's name.
    ``traces``: the port traces.
    ``others``: policies that 10.1 does not have, those of 10.5 among them.
    """

    executions: tuple[str, ...]
    managed: tuple[str, ...]
    elements: dict[str, str]
    traces: tuple[PortTrace, ...]
    others: tuple[s.Policy, ...]

    @classmethod
    def of(cls, policies: Sequence[s.Policy]) -> Policies:
        """``Implementation.policies``, sorted."""
        execution = [p for p in policies if p.definition in EXECUTION]
        services = [p for p in policies if p.definition in s.REQUIRED_ELEMENTS]
        traces = [p for p in policies if p.definition == s.PORT_TRACE]
        return cls(
            tuple(dict.fromkeys(p.definition for p in execution)),
            tuple(p.port for p in execution if p.definition == s.ACTIVE and p.port is not None),
            {p.element: p.definition for p in services if p.element is not None},
            tuple(map(_port_trace, traces)),
            tuple(p for p in policies if p not in [*execution, *services, *traces]),
        )

    @property
    def execution(self) -> str:
        """The one execution policy; ``unprotected_passive_component`` if there is none.

        Raises ``UcmError`` for several, which cannot be told to a framework that takes one.
        """
        if len(self.executions) > 1:
            raise UcmError(f"several execution policies: {', '.join(self.executions)}")
        return self.executions[0] if self.executions else s.UNPROTECTED_PASSIVE


def _port_trace(policy: s.Policy) -> PortTrace:
    named = policy.parameters.get(s.METHODS_TO_TRACE, "").split(",")
    methods = frozenset(name.strip() for name in named if name.strip())
    return PortTrace(policy.port, methods, policy.parameters.get(s.LOG_SEVERITY, ""))
