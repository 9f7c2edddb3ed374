"""Wrong frameworks, clause 10.1.3: policies that are refused, ignored or too many, and results that come back cut."""

from __future__ import annotations

from dataclasses import replace

from ucm_cts.adapters.contract.programming_model import Implementation, PortElementObject, UcmError
from ucm_cts.adapters.contract.scenario import (
    ACTIVE,
    CLOCK,
    COMPONENT_TRACE,
    PORT_TRACE,
    PROTECTED_PASSIVE,
    SELF_EXECUTING,
    UNPROTECTED_PASSIVE,
)
from ucm_cts.adapters.mutants.python.methods import replaces
from ucm_cts.adapters.mutants.python.registry import (
    POLICIES,
    Base,
    Row,
    breaks,
    family,
)
from ucm_cts.adapters.mutants.python.variants.execution import refuses_to_start_components_without_policy
from ucm_cts.adapters.reference.python.members import Member
from ucm_cts.adapters.reference.python.policies import ProtectedElement


@replaces("_check_policies", "R-10.1.3-03", clauses=POLICIES)
def takes_any_number_of_policies(_self: Base, *_: object) -> None:
    """A component with several execution policies is accepted; the first one counts."""


@replaces("_check_policies", "R-10.1.3-03", clauses=POLICIES)
def takes_a_policy_twice(self: Base, implementation: Implementation) -> None:
    """Of two equal execution policies of a component one counts."""
    once = list({(policy.definition, policy.port): policy for policy in implementation.policies}.values())
    Base._check_policies(self, replace(implementation, policies=once))


class _Refuses(Base):
    definition: str

    def _check_policies(self, implementation: Implementation) -> None:
        if any(policy.definition == self.definition for policy in implementation.policies):
            raise UcmError(f"{self.definition} is not supported")
        super()._check_policies(implementation)


_REFUSED = {
    "knows_no_self_execution": Row("R-10.1.3.1-12", "Self-executing components are refused.", SELF_EXECUTING),
    "knows_no_activity": Row("R-10.1.3.1-13", "Active components are refused.", ACTIVE),
    "knows_no_protection": Row("R-10.1.3.1-14", "Protected passive components are refused.", PROTECTED_PASSIVE),
    "knows_no_libraries": Row("R-10.1.3.1-15", "Unprotected passive components are refused.", UNPROTECTED_PASSIVE),
}
family(_Refuses, "definition", _REFUSED, clauses=POLICIES)


class _Forwards(ProtectedElement):
    def exchange(self, value: int) -> int:
        return super().exchange(value) & 0xFFFF


class _Truncates(Base):
    definition = ACTIVE

    def _reference_to(self, member: Member, port: str) -> PortElementObject | None:
        element = super()._reference_to(member, port)
        if member.execution.definition != self.definition or element is None or not self._truncates(member, port):
            return element
        inner = element.element if isinstance(element, ProtectedElement) else element
        return member.execution.references.setdefault(f"{port}, truncated", _Forwards(self, member, port, inner))

    def _truncates(self, member: Member, port: str) -> bool:
        return True


_TRUNCATED = {
    "truncates_results_of_active_components": Row(
        "R-10.1.3.2-08",
        "Of what an active component returns only 16 bits come back.",
        ACTIVE,
        also=("R-10.1.3.2-07", "R-10.1.3.2-10", "R-11.1.3-01", "R-11.2.1.1-02"),
    ),
    "truncates_results_of_protected_components": Row(
        "R-10.1.3.2-15",
        "Of what a protected passive component returns only 16 bits come back.",
        PROTECTED_PASSIVE,
        also=("R-11.1.3-01",),
    ),
    "truncates_results_of_libraries": Row(
        "R-10.1.3.2-21",
        "Of what an unprotected passive component returns only 16 bits come back.",
        UNPROTECTED_PASSIVE,
        also=("R-11.1.3-01",),
    ),
}
family(_Truncates, "definition", _TRUNCATED, clauses=POLICIES)


@replaces("_truncates", "R-10.1.3.2-07", clauses=POLICIES, also=("R-11.1.3-01",))
def truncates_results_of_the_second_active_port(_self: _Truncates, member: Member, port: str) -> bool:
    """Of what the second managed port of a component returns only 16 bits come back."""
    return len(member.execution.managed) > 1 and port == list(member.implementation.provides)[-1]


@breaks("R-10.1.3-02", clauses=("10.1.3",), readings={"missing-execution-policy": "default"})
class starts_nobody_without_policy(refuses_to_start_components_without_policy):
    """The vendor declares a default policy for components without execution policy; their container is not started."""


@breaks("R-10.1.3-02", clauses=("10.1.3",), readings={"missing-execution-policy": "refuse"})
class starts_what_it_says_it_refuses(Base):
    """The vendor declares that components without execution policy are refused; they are started."""


@replaces("_check_policies", "R-9.4.3.2-06", clauses=("10.1.3", "9.4.3.2"), readings={"unknown-policy": "refused"})
def ignores_unknown_policies(self: Base, implementation: Implementation) -> None:
    """Policies that the framework does not know are ignored."""
    known = [p for p in implementation.policies if p.definition in _KNOWN]
    Base._check_policies(self, replace(implementation, policies=known))


@replaces("_check_policies", "R-9.4.3.2-06", clauses=("10.1.3", "9.4.3.2"), readings={"unknown-policy": "refused"})
def ignores_unknown_policies_of_ports(self: Base, implementation: Implementation) -> None:
    """Policies of ports are ignored if the framework does not know them."""
    known = [p for p in implementation.policies if p.port is None or p.definition in _KNOWN]
    Base._check_policies(self, replace(implementation, policies=known))


_KNOWN = {ACTIVE, PROTECTED_PASSIVE, SELF_EXECUTING, UNPROTECTED_PASSIVE, CLOCK, COMPONENT_TRACE, PORT_TRACE}
