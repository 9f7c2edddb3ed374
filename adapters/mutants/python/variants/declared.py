"""Conformant variants that declare readings which no other variant declares: of what the reference framework does, or of less."""

from __future__ import annotations

from typing import Any

import msgspec

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_types import Char, Integer
from ucm_cts.adapters.contract.data_types import Sequence as SequenceType
from ucm_cts.adapters.contract.programming_model import Implementation, UcmError
from ucm_cts.adapters.mutants.python.altering import ChangingLink
from ucm_cts.adapters.mutants.python.registry import CONTAINER, Base, variant_of
from ucm_cts.adapters.reference.python.container_services import Record
from ucm_cts.adapters.reference.python.members import Member

_TRACES, _DATA = ("10.1.4",), ("10.1.1",)


@variant_of(
    *CONTAINER,
    readings={
        "callback-failure": "error",
        "container-interface": "once",
        "double-start": "noop",
        "late-add": "refuse",
        "late-container": "allowed",
        "late-disconnect": "refuse",
        "manager-get-components": "own",
        "manager-start": "own",
        "remove-container-in-use": "cascade",
        "remove-provider-in-use": "refuse",
        "remove-while-connected": "cascade",
        "remove-while-ready": "refuse",
        "second-connect": "refuse",
        "self-connection": "allowed",
        "start-order": "one-by-one",
        "start-unconfigured": "refuse",
        "stop-drain": "abandon",
        "stop-when-stopped": "noop",
        "unknown-names": "not-found",
    },
)
class declares_its_life_cycle(Base):
    """The reference framework; its vendor declares all that it does with life cycles."""


# values (10.1.1)


def _few_values(of: Any, value: Any) -> Any:
    match of:
        case Integer(kind="BYTE") if value < 0:
            raise UcmError("a byte has no sign")
        case Char(kind="CHAR8") if value > 0x7F:
            raise UcmError("a character of 8 bits is not one of ASCII")
        case Char(kind="CHAR32") if value > 0xFFFF:
            raise UcmError("a character is beyond the Basic Multilingual Plane")
        case SequenceType() if 0 <= of.size != len(value):
            raise UcmError("a bounded sequence is not full")
    return value


@variant_of(*_DATA, readings={"byte": "unsigned", "char8": "ascii", "char32": "bmp", "bounded-sequence": "full-only"})
class carries_few_values(ChangingLink):
    """Bytes have no sign, characters 7 or 16 bits, and bounded sequences are full; all else raises."""

    change = staticmethod(_few_values)


@variant_of(
    *_DATA,
    readings={"char8": "byte", "byte": "signed", "char32": "full", "bounded-sequence": "any-length", "nan": "exact"},
)
class carries_many_values(Base):
    """The reference framework, whose characters of 8 bits are not only those of ASCII."""


# clocks and traces (10.1.4)


@variant_of(*_TRACES, readings={"clock-epoch": "unix", "local-clock": "settable"})
class has_calendar_clocks(Base):
    """Local time is that of the calendar, as the vendor declares."""


@variant_of(
    *_TRACES,
    readings={
        "log-message": "wide-unbounded",
        "log-severity-set": "model-6",
        "log-threshold": "none",
        "methods-to-trace": "list",
        "port-trace-applicability": "onPort",
        "port-trace-parameters": "both",
        "port-trace-records": "call",
    },
)
class declares_its_traces(Base):
    """The reference framework; its vendor declares what it traces."""


@variant_of(*_TRACES, readings={"log-severity-set": "idl-5", "log-message": "narrow-255"})
class has_the_trace_of_idl(Base):
    """There are the severities of the IDL; a message has at most 255 characters of ASCII."""

    severities = ("debug", "info", "warning", "error", "fatal")

    def _log(self, member: Member, severity: str, message: str) -> None:
        if len(message) > 255 or not message.isascii():
            raise UcmError("the message is too long or too wide")
        super()._log(member, severity, message)


class _Threshold(Base):
    least: str

    def _write(self, record: Record) -> None:
        if self.severities.index(record[0]) >= self.severities.index(self.least):
            super()._write(record)


@variant_of(*_TRACES, readings={"log-threshold": "debug"})
class records_from_debug_on(_Threshold):
    """What is less severe than debug is not recorded."""

    least = "debug"


@variant_of(*_TRACES, readings={"log-threshold": "info"})
class records_from_info_on(_Threshold):
    """What is less severe than info is not recorded."""

    least = "info"


@variant_of(*_TRACES, readings={"log-threshold": "warning"})
class records_from_warning_on(_Threshold):
    """What is less severe than warning is not recorded."""

    least = "warning"


@variant_of(*_TRACES, readings={"log-threshold": "error"})
class records_errors_only(_Threshold):
    """What is less severe than error is not recorded."""

    least = "error"


@variant_of(*_TRACES, readings={"port-trace-applicability": "onBoth"})
class traces_ports_or_whole_components(Base):
    """port_trace can be applied to a port, or to a component, all ports of which are traced then."""

    takes_ports = True

    def _check_service(self, implementation: Implementation, policy: s.Policy) -> None:
        if policy.definition == s.PORT_TRACE and policy.port is None:
            policy = replace_port(policy, next(iter((*implementation.provides, *implementation.requires)), None))
        elif policy.definition == s.PORT_TRACE and not self.takes_ports:
            raise UcmError("port_trace applies to components")
        super()._check_service(implementation, policy)

    def _port_traces(self, member: Member, port: str) -> list[s.Policy]:
        policies = member.implementation.policies
        return [p for p in policies if p.definition == s.PORT_TRACE and p.port in (port, None)]


@variant_of(*_TRACES, readings={"port-trace-applicability": "onComponent"})
class traces_whole_components(traces_ports_or_whole_components):
    """port_trace is applied to a component, all ports of which are traced then."""

    takes_ports = False


def replace_port(policy: s.Policy, port: str | None) -> s.Policy:
    """``policy``, applied to ``port``."""
    return s.Policy(policy.definition, port, policy.parameters, policy.element)


@variant_of(*_TRACES, readings={"port-trace-parameters": "none"})
class knows_no_parameters_of_port_traces(Base):
    """port_trace has no parameters: every call is recorded, as information."""

    def _check_service(self, implementation: Implementation, policy: s.Policy) -> None:
        if policy.definition == s.PORT_TRACE and policy.parameters:
            raise UcmError("port_trace has no parameters")
        super()._check_service(implementation, self._with_parameters(policy))

    def _port_traces(self, member: Member, port: str) -> list[s.Policy]:
        return [self._with_parameters(policy) for policy in super()._port_traces(member, port)]

    def _is_traced(self, policy: s.Policy, method: str) -> bool:
        return True

    def _with_parameters(self, policy: s.Policy) -> s.Policy:
        if policy.definition != s.PORT_TRACE:
            return policy
        return msgspec.structs.replace(policy, parameters={s.METHODS_TO_TRACE: "", s.LOG_SEVERITY: "info"})
