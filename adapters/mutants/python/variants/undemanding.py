"""Conformant variants that do what the weakest claims allow, and declare these; some do as the reference framework does."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.adapter import NotOffered
from ucm_cts.adapters.contract.programming_model import Implementation, UcmError
from ucm_cts.adapters.mutants.python.methods import alters, refuses_if, replaces
from ucm_cts.adapters.mutants.python.registry import CONTAINER, POLICIES, Base, variant_of
from ucm_cts.adapters.reference.python.container_services import Record
from ucm_cts.adapters.reference.python.execution import POLICIES as EXECUTION_POLICIES
from ucm_cts.adapters.reference.python.members import Member

_TRACES, _INTERFACES = ("10.1.4",), ("11.2.3", "12.10")
_KNOWN = {*EXECUTION_POLICIES, s.CLOCK, s.COMPONENT_TRACE, s.PORT_TRACE}


@refuses_if("_check_removable", readings={"remove-while-connected": "refuse"})
def keeps_what_is_connected(self: Base, member: Member) -> bool:
    """remove_component refuses a component that is connected."""
    return bool(self._connections_from(member))


@replaces("_check_compatible", clauses=_INTERFACES, readings={"incompatible-ends": "unasked"})
def connects_whatever_is_asked(_self: Base, *_: object) -> None:
    """connect does not compare interfaces, of which nothing is declared."""


@replaces("_check_policies", clauses=("10.1.3", "9.4.3.2"), readings={"unknown-policy": "unasked"})
def passes_unknown_policies_over(self: Base, implementation: Implementation) -> None:
    """Policies that the framework does not know are ignored, of which nothing is declared."""
    known = [policy for policy in implementation.policies if policy.definition in _KNOWN]
    Base._check_policies(self, replace(implementation, policies=known))


@alters("_is_protected", clauses=POLICIES, readings={"unprotected-concurrency": "may-serialise"})
def serialises_all_components(_self: Base, given: bool, member: Member) -> bool:
    """Calls of unprotected components enter one at a time, too, as the vendor declares."""
    return given or member.execution.definition == s.UNPROTECTED_PASSIVE


@variant_of(
    *POLICIES,
    readings={
        "active-unmanaged": "protected",
        "protected-active-applicability": "onPort",
        "raw-references": "protected",
        "self-exec-mutex": "component",
    },
)
class declares_its_protection(Base):
    """The reference framework; its vendor declares what it protects."""


@variant_of(*_TRACES, readings={"trace-sink": "none", "virtual-time": "none"})
class shows_no_log(Base):
    """The adapter offers neither to read the trace back nor to let virtual time pass, and the vendor declares so."""

    def read_log(self) -> list[Record]:
        raise NotOffered

    def advance(self, milliseconds: int) -> None:
        raise NotOffered


@replaces("_is_traced", clauses=_TRACES, readings={"methods-to-trace": "one-name"})
def knows_one_method_to_trace(_self: Base, policy: s.Policy, method: str) -> bool:
    """The parameter of port_trace is the name of one method, never a list."""
    return method == policy.parameters[s.METHODS_TO_TRACE]


@variant_of(*CONTAINER, readings={"container-operations": "unasked"})
class bears_no_operations_at_once(Base):
    """An operation is refused while another thread carries out one, of which nothing is declared."""

    @contextmanager
    def _operation(self) -> Iterator[None]:
        if not self.manager.lock.acquire(blocking=False):
            raise UcmError("another thread is in the middle of an operation")
        self.manager.lock.release()
        with super()._operation():
            yield


@replaces("_check_alive")
def goes_on_when_removed(_self: Base) -> None:
    """A container that was removed, and a runtime that was destroyed, are empty and can be used like new ones: the text leaves that open."""
