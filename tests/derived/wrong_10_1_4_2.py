"""Wrong frameworks, clause 10.1.4.2: traces that are not there, and logs that lose, alter or invent records."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Sequence
from typing import TypeVar

from derived.registry import Base, breaks_core
from derived.wrong_10_1_4_1 import HERE, Withholds
from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.programming_model import Implementation, PortConnection, UcmError
from ucm_cts.adapters.contract.scenario import COMPONENT_TRACE, METHODS_TO_TRACE, PORT_TRACE, Policy
from ucm_cts.adapters.reference_py.connectors import Link
from ucm_cts.adapters.reference_py.container_services import Record
from ucm_cts.adapters.reference_py.framework import Member

T = TypeVar("T")

# what components get


@breaks_core("R-10.1.4.2-03", clauses=HERE)
class hands_over_no_trace(Withholds):
    """Nothing is behind the name of the trace."""

    definition = COMPONENT_TRACE

    def _withholds(self, member: Member) -> bool:
        return sum(p.definition == COMPONENT_TRACE for p in member.implementation.policies) == 1


@breaks_core("R-10.1.4.2-02", clauses=HERE)
class hands_over_the_first_trace_only(Base):
    """Nothing is behind the name of a second trace."""

    def _service_element(self, member: Member, policy: Policy) -> PortConnection:
        first = next(p for p in member.implementation.policies if p.definition == policy.definition)
        given = super()._service_element(member, policy)
        return given if policy is first else PortConnection(given.from_port, ())


@breaks_core("R-10.1.4.2-02", clauses=HERE)
class refuses_a_second_trace(Base):
    """One trace policy a component, and no more."""

    def _check_service(self, implementation: Implementation, policy: Policy) -> None:
        if sum(p.definition in (COMPONENT_TRACE, PORT_TRACE) for p in implementation.policies) > 1:
            raise UcmError("more than one trace")
        super()._check_service(implementation, policy)


@breaks_core("R-10.1.4.2-02", clauses=HERE)
class writes_to_every_trace_of_a_component(Base):
    """A call of log makes a record for each trace policy of the component."""

    def _log(self, member: Member, severity: str, message: str) -> None:
        for policy in member.implementation.policies:
            if policy.definition == COMPONENT_TRACE:
                super()._log(member, severity, message)


# messages


@breaks_core("R-10.1.4.2-25", clauses=HERE)
class log_fails_for_warnings(Base):
    """log raises when the severity is warning."""

    def _log(self, member: Member, severity: str, message: str) -> None:
        if severity == "warning":
            raise UcmError("no warnings, please")
        super()._log(member, severity, message)


@breaks_core("R-10.1.4.2-25", clauses=HERE, readings={"log-severity-set": "model-6"})
class log_knows_no_critical_severity(Base):
    """log raises when the severity is critical; the vendor declares the six of the model."""

    def _log(self, member: Member, severity: str, message: str) -> None:
        if severity == "critical":
            raise UcmError("no such severity")
        super()._log(member, severity, message)


@breaks_core("R-10.1.4.2-26", clauses=HERE)
class log_drops_debug_messages(Base):
    """What has severity debug is not recorded, and no threshold is declared."""

    def _log(self, member: Member, severity: str, message: str) -> None:
        if severity != "debug":
            super()._log(member, severity, message)


@breaks_core("R-10.1.4.2-26", clauses=HERE, also=("R-10.1.4.2-32",), readings={"log-threshold": "warning"})
class log_knows_no_threshold(Base):
    """Everything is recorded; the vendor declares a threshold."""


@breaks_core("R-10.1.4.2-26", clauses=HERE)
class log_loses_what_comes_from_sub_containers(Base):
    """What components of sub-containers write is not recorded."""

    def _log(self, member: Member, severity: str, message: str) -> None:
        if member.container is self.manager:
            super()._log(member, severity, message)


@breaks_core("R-10.1.4.2-26", clauses=HERE)
class log_loses_every_hundredth(Base):
    """One record of a hundred is lost."""

    def _log(self, member: Member, severity: str, message: str) -> None:
        runtime = self.manager.__dict__
        runtime["logged"] = runtime.get("logged", 0) + 1
        if runtime["logged"] % 100:
            super()._log(member, severity, message)


@breaks_core("R-10.1.4.2-26", clauses=HERE, also=("R-10.1.4.2-02",))
class log_records_twice(Base):
    """Each call of log leaves two records."""

    def _log(self, member: Member, severity: str, message: str) -> None:
        super()._log(member, severity, message)
        super()._log(member, severity, message)


@breaks_core("R-10.1.4.2-26", clauses=HERE, also=("R-10.1.4.2-02",))
class log_records_an_echo(Base):
    """Each call of log leaves a second record that speaks of it."""

    def _log(self, member: Member, severity: str, message: str) -> None:
        super()._log(member, severity, message)
        super()._log(member, "debug", f"logged: {message}")


@breaks_core("R-10.1.4.2-26", clauses=HERE)
class log_leaves_out_repetitions(Base):
    """A record like the last one is not written."""

    def _log(self, member: Member, severity: str, message: str) -> None:
        if self.manager.log[-1:] != [(severity, message)]:
            super()._log(member, severity, message)


class _Alters(Base):
    def _altered(self, message: str) -> str:
        raise NotImplementedError

    def _log(self, member: Member, severity: str, message: str) -> None:
        super()._log(member, severity, self._altered(message))


@breaks_core("R-10.1.4.2-53", clauses=HERE, also=("R-10.1.4.2-47",))
class log_truncates_soon(_Alters):
    """Texts end after 100 characters."""

    def _altered(self, message: str) -> str:
        return message[:100]


@breaks_core("R-10.1.4.2-53", clauses=HERE, also=("R-10.1.4.2-47",))
class log_adds_a_time_stamp(_Alters):
    """Texts begin with the time."""

    def _altered(self, message: str) -> str:
        return f"{time.ctime()} {message}"


@breaks_core("R-10.1.4.2-53", clauses=HERE)
class log_formats_texts(_Alters):
    """Texts are taken for format strings."""

    def _altered(self, message: str) -> str:
        return message.replace("%%", "%").replace("{0}", "").replace("\\n", "\n")


@breaks_core("R-10.1.4.2-53", clauses=HERE)
class log_folds_spaces(_Alters):
    """Several spaces become one."""

    def _altered(self, message: str) -> str:
        return " ".join(message.split())


@breaks_core("R-10.1.4.2-47", clauses=HERE)
class log_truncates_late(_Alters):
    """Texts end after 1,024 characters."""

    def _altered(self, message: str) -> str:
        return message[:1024]


@breaks_core("R-10.1.4.2-47", clauses=HERE)
class log_is_narrow(_Alters):
    """What is not ASCII becomes question marks."""

    def _altered(self, message: str) -> str:
        return message.encode("ascii", "replace").decode()


@breaks_core("R-10.1.4.2-47", clauses=HERE)
class log_has_sixteen_bits(_Alters):
    """What is beyond the Basic Multilingual Plane loses its upper bits."""

    def _altered(self, message: str) -> str:
        return "".join(chr(ord(c) & 0xFFFF) for c in message)


@breaks_core("R-10.1.4.2-47", clauses=HERE)
class log_drops_empty_texts(Base):
    """Nothing said, nothing recorded."""

    def _log(self, member: Member, severity: str, message: str) -> None:
        if message:
            super()._log(member, severity, message)


@breaks_core("R-10.1.4.2-47", clauses=HERE)
class log_says_something_for_nothing(_Alters):
    """An empty text becomes another one."""

    def _altered(self, message: str) -> str:
        return message or "(none)"


class _Ranks(Base):
    instead: dict[str, str]

    def _log(self, member: Member, severity: str, message: str) -> None:
        super()._log(member, self.instead.get(severity, severity), message)


@breaks_core("R-10.1.4.2-51", clauses=HERE)
class log_makes_warnings_errors(_Ranks):
    """Warnings are recorded as errors."""

    instead = {"warning": "error"}


@breaks_core("R-10.1.4.2-51", clauses=HERE)
class log_numbers_severities_otherwise(_Ranks):
    """Severities are one off, as between the model and IDL."""

    instead = {"debug": "info", "info": "warning", "warning": "error", "error": "critical"}


@breaks_core("R-10.1.4.2-51", clauses=HERE, readings={"log-severity-set": "model-6"})
class log_makes_critical_an_error(_Ranks):
    """What is critical is recorded as an error; the vendor declares the six severities of the model."""

    instead = {"critical": "error"}


# port traces


@breaks_core("R-10.1.4.2-04", clauses=HERE)
class traces_no_ports(Base):
    """port_trace is accepted and forgotten."""

    def _port_traces(self, member: Member, port: str) -> list[Policy]:
        return []


@breaks_core("R-10.1.4.2-04", clauses=HERE, also=("R-10.1.4.2-32",))  # of both ends, one is traced
class traces_provided_ports_only(Base):
    """port_trace of a required port is accepted and forgotten."""

    def _port_traces(self, member: Member, port: str) -> list[Policy]:
        return super()._port_traces(member, port) if port in member.implementation.provides else []


@breaks_core("R-10.1.4.2-04", clauses=HERE)
class traces_one_port_of_a_component(Base):
    """The last of several port traces of a component counts."""

    def _port_traces(self, member: Member, port: str) -> list[Policy]:
        last = [p for p in member.implementation.policies if p.port is not None][-1:]
        return [p for p in super()._port_traces(member, port) if p in last]


@breaks_core("R-10.1.4.2-32", clauses=HERE)
class traces_until_the_first_stop(Base):
    """Who is started again is not traced any more."""

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


@breaks_core("R-10.1.4.2-32", clauses=HERE)
class traces_no_calls_from_connectors(Base):
    """What comes in through a service connector is not traced."""

    link_class = _BlindLink

    def _trace_call(self, member: Member, port: str, method: str, work: Callable[[], T]) -> T:
        if getattr(_BlindLink.within, "connector", False):
            return work()
        return super()._trace_call(member, port, method, work)


@breaks_core("R-10.1.4.2-32", clauses=HERE)
class traces_the_first_call(Base):
    """A method is recorded when it is called first."""

    def _write(self, record: Record) -> None:
        if record not in self.manager.log or not _is_of_a_call(self, record):
            super()._write(record)


def _is_of_a_call(container: Base, record: Record) -> bool:
    return record[1].startswith(tuple(container.manager.implementations))


@breaks_core("R-10.1.4.2-32", clauses=HERE, also=("R-10.1.4.2-33",))  # others might have made them
class traces_calls_again_and_again(Base):
    """Each traced call has five records."""

    def _trace_call(self, member: Member, port: str, method: str, work: Callable[[], T]) -> T:
        for _ in range(4):
            super()._trace_call(member, port, method, lambda: None)
        return super()._trace_call(member, port, method, work)


@breaks_core("R-10.1.4.2-04", clauses=HERE)
class traces_calls_without_their_names(Base):
    """Records of calls do not tell which method was called."""

    def _call_message(self, member: Member, port: str, method: str) -> str:
        return f"{member.implementation.name} {port} called"


@breaks_core("R-10.1.4.2-32", clauses=HERE, readings={"port-trace-records": "call-and-return"})
class traces_calls_and_no_returns(Base):
    """A call has one record; the vendor declares two."""


@breaks_core("R-10.1.4.2-32", clauses=HERE, readings={"port-trace-records": "call"})
class traces_calls_and_returns(Base):
    """A call has two records; the vendor declares one."""

    def _trace_call(self, member: Member, port: str, method: str, work: Callable[[], T]) -> T:
        result = super()._trace_call(member, port, method, work)
        super()._trace_call(member, port, method, lambda: None)
        return result


@breaks_core("R-10.1.4.2-33", clauses=HERE)
class traces_all_methods(Base):
    """methods_to_trace does not select."""

    def _is_traced(self, policy: Policy, method: str) -> bool:
        return True


@breaks_core("R-10.1.4.2-33", clauses=HERE)
class traces_methods_that_begin_alike(Base):
    """Methods are traced whose names begin with what methods_to_trace says."""

    def _is_traced(self, policy: Policy, method: str) -> bool:
        return method.startswith(policy.parameters[METHODS_TO_TRACE])


@breaks_core("R-10.1.4.2-33", clauses=HERE)
class traces_methods_found_somewhere_in_names(Base):
    """Methods are traced whose names are anywhere in methods_to_trace."""

    def _is_traced(self, policy: Policy, method: str) -> bool:
        return method in policy.parameters[METHODS_TO_TRACE]


@breaks_core("R-10.1.4.2-33", clauses=HERE)
class traces_all_ports(Base):
    """The policy of one port is applied to all."""

    def _port_traces(self, member: Member, port: str) -> list[Policy]:
        own = super()._port_traces(member, port)
        policies = (p for i in self.manager.implementations.values() for p in i.policies)
        return own or [p for p in policies if p.definition == PORT_TRACE][:1]


@breaks_core("R-10.1.4.2-33", clauses=HERE)
class notes_every_call(Base):
    """Calls of methods that are not named leave a record that says nothing."""

    def _trace_call(self, member: Member, port: str, method: str, work: Callable[[], T]) -> T:
        if not any(self._is_traced(policy, method) for policy in self._port_traces(member, port)):
            self._write(("debug", "a call"))
        return super()._trace_call(member, port, method, work)


@breaks_core("R-10.1.4.2-35", clauses=HERE)
class traces_ports_as_info(Base):
    """What port traces record has always the same severity."""

    def _trace_call(self, member: Member, port: str, method: str, work: Callable[[], T]) -> T:
        if any(self._is_traced(policy, method) for policy in self._port_traces(member, port)):
            self._write(("info", self._call_message(member, port, method)))
        return work()


@breaks_core("R-10.1.4.2-35", clauses=HERE)
class traces_errors_as_warnings(Base):
    """What is to be recorded as error is a warning."""

    def _write(self, record: Record) -> None:
        of_an_error = record[0] == "error" and _is_of_a_call(self, record)
        super()._write(("warning", record[1]) if of_an_error else record)
