"""Wrong frameworks, clause 10.1.4.2: port traces that lose, invent or mix up records."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from typing import TypeVar

from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.scenario import METHODS_TO_TRACE, PORT_TRACE, Policy
from ucm_cts.adapters.mutants.python.container_services.clocks import HERE
from ucm_cts.adapters.mutants.python.methods import alters, does_only_if, replaces
from ucm_cts.adapters.mutants.python.registry import Base, breaks
from ucm_cts.adapters.mutants.python.variants.declared import knows_no_parameters_of_port_traces
from ucm_cts.adapters.reference.python.connectors import Link
from ucm_cts.adapters.reference.python.container_services import Record
from ucm_cts.adapters.reference.python.members import Member

T = TypeVar("T")


@replaces("_port_traces", "R-10.1.4.2-04", clauses=HERE)
def traces_no_ports(_self: Base, *_: object) -> list[Policy]:
    """port_trace is accepted and forgotten."""
    return []


@breaks("R-10.1.4.2-04", clauses=HERE, readings={"port-trace-parameters": "none"})
class forgets_traces_without_parameters(knows_no_parameters_of_port_traces):
    """port_trace, which has no parameters, is accepted and forgotten."""

    def _is_traced(self, policy: Policy, method: str) -> bool:
        return False


@alters("_port_traces", "R-10.1.4.2-04", clauses=HERE, also=("R-10.1.4.2-32",))  # only one of both ends is traced
def traces_provided_ports_only(_self: Base, given: list[Policy], member: Member, port: str) -> list[Policy]:
    """port_trace of a required port is accepted and forgotten."""
    return given if port in member.implementation.provides else []


@replaces("_port_traces", "R-10.1.4.2-04", clauses=HERE)
def traces_one_port_of_a_component(self: Base, member: Member, port: str) -> list[Policy]:
    """Only the last of several port traces of a component is applied."""
    last = [p for p in member.implementation.policies if p.port is not None][-1:]
    return [p for p in Base._port_traces(self, member, port) if p in last]


@breaks("R-10.1.4.2-32", clauses=HERE)
class traces_until_the_first_stop(Base):
    """A component that is started again is not traced any more."""

    def _end_execution(self, member: Member) -> None:
        super()._end_execution(member)
        member.__dict__["was stopped"] = True

    def _trace_call(self, member: Member, port: str, method: str, work: Callable[[], T]) -> T:
        return work() if "was stopped" in member.__dict__ else super()._trace_call(member, port, method, work)


class _BlindLink(Link):
    within = threading.local()

    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        self.within.connector = True
        try:
            return super()._request(method, arguments)
        finally:
            self.within.connector = False


@breaks("R-10.1.4.2-32", clauses=HERE)
class traces_no_calls_from_connectors(Base):
    """Calls that come through a service connector are not traced."""

    link_class = _BlindLink

    def _trace_call(self, member: Member, port: str, method: str, work: Callable[[], T]) -> T:
        if getattr(_BlindLink.within, "connector", False):
            return work()
        return super()._trace_call(member, port, method, work)


@does_only_if("_write", "R-10.1.4.2-32", clauses=HERE)
def traces_the_first_call(self: Base, record: Record) -> bool:
    """Only the first call of a method is recorded."""
    return record not in self.manager.log or not _is_of_a_call(self, record)


def _is_of_a_call(container: Base, record: Record) -> bool:
    return record[1].startswith(tuple(container.manager.implementations))


@replaces(
    "_trace_call", "R-10.1.4.2-32", clauses=HERE, also=("R-10.1.4.2-33",)
)  # calls of other components might have left them
def traces_calls_again_and_again(self: Base, member: Member, port: str, method: str, work: Callable[[], T]) -> T:
    """Each traced call has five records."""
    for _ in range(4):
        Base._trace_call(self, member, port, method, lambda: None)
    return Base._trace_call(self, member, port, method, work)


@replaces("_call_message", "R-10.1.4.2-04", clauses=HERE)
def traces_calls_without_their_names(_self: Base, member: Member, port: str, *_: object) -> str:
    """Records of calls do not name the method."""
    return f"{member.implementation.name} {port} called"


@breaks("R-10.1.4.2-32", clauses=HERE, readings={"port-trace-records": "call-and-return"})
class traces_calls_and_no_returns(Base):
    """A call has one record; the vendor declares two."""


@replaces("_trace_call", "R-10.1.4.2-32", clauses=HERE, readings={"port-trace-records": "call"})
def traces_calls_and_returns(self: Base, member: Member, port: str, method: str, work: Callable[[], T]) -> T:
    """A call has two records; the vendor declares one."""
    result = Base._trace_call(self, member, port, method, work)
    Base._trace_call(self, member, port, method, lambda: None)
    return result


@replaces("_is_traced", "R-10.1.4.2-33", clauses=HERE)
def traces_all_methods(_self: Base, *_: object) -> bool:
    """Calls of all methods are recorded, not only those named in methods_to_trace."""
    return True


@replaces("_is_traced", "R-10.1.4.2-33", clauses=HERE)
def traces_methods_that_begin_alike(_self: Base, policy: Policy, method: str) -> bool:
    """Methods are traced whose names begin with the text of methods_to_trace."""
    return method.startswith(policy.parameters[METHODS_TO_TRACE])


@replaces("_is_traced", "R-10.1.4.2-33", clauses=HERE)
def traces_methods_found_somewhere_in_names(_self: Base, policy: Policy, method: str) -> bool:
    """Methods are traced whose names are substrings of methods_to_trace."""
    return method in policy.parameters[METHODS_TO_TRACE]


@alters("_port_traces", "R-10.1.4.2-33", clauses=HERE)
def traces_all_ports(self: Base, own: list[Policy], _member: Member, _port: str) -> list[Policy]:
    """The port trace of one port applies to all ports."""
    policies = (p for i in self.manager.implementations.values() for p in i.policies)
    return own or [p for p in policies if p.definition == PORT_TRACE][:1]


@replaces("_port_traces", "R-10.1.4.2-33", clauses=HERE)
def traces_ports_with_later_names(_self: Base, member: Member, port: str) -> list[Policy]:
    """The policy of one port is applied to all ports of its component whose names sort after it."""
    return [p for p in member.implementation.policies if p.definition == PORT_TRACE and (p.port or "") <= port]


@replaces("_port_traces", "R-10.1.4.2-33", clauses=HERE)
def traces_ports_with_earlier_names(_self: Base, member: Member, port: str) -> list[Policy]:
    """The policy of one port is applied to all ports of its component whose names sort before it."""
    return [p for p in member.implementation.policies if p.definition == PORT_TRACE and (p.port or "") >= port]


@replaces("_trace_call", "R-10.1.4.2-33", clauses=HERE)
def notes_every_call(self: Base, member: Member, port: str, method: str, work: Callable[[], T]) -> T:
    """Calls of methods that are not to be traced leave a record without a name."""
    if not any(self._is_traced(policy, method) for policy in self._port_traces(member, port)):
        self._write(("debug", "a call"))
    return Base._trace_call(self, member, port, method, work)


@replaces("_trace_call", "R-10.1.4.2-35", clauses=HERE)
def traces_ports_as_info(self: Base, member: Member, port: str, method: str, work: Callable[[], T]) -> T:
    """Port traces always record the severity info."""
    if any(self._is_traced(policy, method) for policy in self._port_traces(member, port)):
        self._write(("info", self._call_message(member, port, method)))
    return work()


@replaces("_write", "R-10.1.4.2-35", clauses=HERE)
def traces_errors_as_warnings(self: Base, record: Record) -> None:
    """Port traces of severity error are recorded as warnings."""
    of_an_error = record[0] == "error" and _is_of_a_call(self, record)
    Base._write(self, ("warning", record[1]) if of_an_error else record)


@alters("_trace_call", "R-11.1.3-01", clauses=HERE, also=("R-10.1.3.2-21",))
def loses_results_of_traced_calls(
    _self: Base, result: T, _member: Member, _port: str, method: str, _work: Callable[[], T]
) -> T:
    """A call of exchange through a traced port has no result."""
    return 0 if method == "exchange" else result  # type: ignore[return-value]
