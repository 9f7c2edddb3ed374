"""Wrong frameworks, clause 10.1.4.2: missing traces, and logs that lose, alter or invent records."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TypeVar

from ucm_cts.adapters.contract.programming_model import Implementation, PortConnection
from ucm_cts.adapters.contract.scenario import COMPONENT_TRACE, PORT_TRACE, Policy
from ucm_cts.adapters.mutants.python.container_services.clocks import HERE, Withholds
from ucm_cts.adapters.mutants.python.methods import does_only_if, refuses_if, replaces
from ucm_cts.adapters.mutants.python.registry import Base, Row, breaks, family
from ucm_cts.adapters.reference.python.members import Member

T = TypeVar("T")

# what components get


@breaks("R-10.1.4.2-03", clauses=HERE)
class hands_over_no_trace(Withholds):
    """on_startup names the trace and gives no reference to it."""

    definition = COMPONENT_TRACE

    def _withholds(self, member: Member) -> bool:
        return sum(p.definition == COMPONENT_TRACE for p in member.implementation.policies) == 1


@replaces("_service_element", "R-10.1.4.2-02", clauses=HERE)
def hands_over_the_first_trace_only(self: Base, member: Member, policy: Policy) -> PortConnection:
    """on_startup names the second trace and gives no reference to it."""
    first = next(p for p in member.implementation.policies if p.definition == policy.definition)
    given = Base._service_element(self, member, policy)
    return given if policy is first else PortConnection(given.from_port, ())


@refuses_if("_check_service", "R-10.1.4.2-02", clauses=HERE)
def refuses_a_second_trace(_self: Base, implementation: Implementation, _policy: Policy) -> bool:
    """A component with two trace policies is refused."""
    return sum(p.definition in (COMPONENT_TRACE, PORT_TRACE) for p in implementation.policies) > 1


@replaces("_log", "R-10.1.4.2-02", clauses=HERE)
def writes_to_every_trace_of_a_component(self: Base, member: Member, severity: str, message: str) -> None:
    """A call of log makes a record for each trace policy of the component."""
    for policy in member.implementation.policies:
        if policy.definition == COMPONENT_TRACE:
            Base._log(self, member, severity, message)


# messages


@refuses_if("_log", "R-10.1.4.2-25", clauses=HERE)
def log_fails_for_warnings(_self: Base, _member: Member, severity: str, _message: str) -> bool:
    """log raises when the severity is warning."""
    return severity == "warning"


@refuses_if("_log", "R-10.1.4.2-25", clauses=HERE, readings={"log-severity-set": "model-6"})
def log_knows_no_critical_severity(_self: Base, _member: Member, severity: str, _message: str) -> bool:
    """log raises when the severity is critical; the vendor declares the six severities of the model."""
    return severity == "critical"


@does_only_if("_log", "R-10.1.4.2-26", clauses=HERE)
def log_drops_debug_messages(_self: Base, _member: Member, severity: str, _message: str) -> bool:
    """Messages of severity debug are not recorded; no threshold is declared."""
    return severity != "debug"


@breaks("R-10.1.4.2-26", clauses=HERE, also=("R-10.1.4.2-32",), readings={"log-threshold": "warning"})
class log_knows_no_threshold(Base):
    """Everything is recorded; the vendor declares a threshold."""


@does_only_if("_log", "R-10.1.4.2-26", clauses=HERE)
def log_loses_what_comes_from_sub_containers(self: Base, member: Member, _severity: str, _message: str) -> bool:
    """What components of sub-containers write is not recorded."""
    return member.container is self.manager


@replaces("_log", "R-10.1.4.2-26", clauses=HERE)
def log_loses_every_hundredth(self: Base, member: Member, severity: str, message: str) -> None:
    """One record of a hundred is lost."""
    runtime = self.manager.__dict__
    runtime["logged"] = runtime.get("logged", 0) + 1
    if runtime["logged"] % 100:
        Base._log(self, member, severity, message)


@replaces("_log", "R-10.1.4.2-26", clauses=HERE, also=("R-10.1.4.2-02",))
def log_records_twice(self: Base, member: Member, severity: str, message: str) -> None:
    """Each call of log leaves two records."""
    Base._log(self, member, severity, message)
    Base._log(self, member, severity, message)


@replaces("_log", "R-10.1.4.2-26", clauses=HERE, also=("R-10.1.4.2-02",))
def log_records_an_echo(self: Base, member: Member, severity: str, message: str) -> None:
    """Each call of log leaves a second record that quotes the first."""
    Base._log(self, member, severity, message)
    Base._log(self, member, "debug", f"logged: {message}")


@does_only_if("_log", "R-10.1.4.2-26", clauses=HERE)
def log_leaves_out_repetitions(self: Base, _member: Member, severity: str, message: str) -> bool:
    """A record that equals the last one is not written."""
    return self.manager.log[-1:] != [(severity, message)]


class _Alters(Base):
    altered: Callable[[str], str]

    def _log(self, member: Member, severity: str, message: str) -> None:
        super()._log(member, severity, self.altered(message))


_ALTERED = {
    "log_truncates_soon": Row(
        "R-10.1.4.2-53", "Texts end after 100 characters.", lambda message: message[:100], also=("R-10.1.4.2-47",)
    ),
    "log_adds_a_time_stamp": Row(
        "R-10.1.4.2-53",
        "Texts begin with the time.",
        lambda message: f"{time.ctime()} {message}",
        also=("R-10.1.4.2-47",),
    ),
    "log_formats_texts": Row(
        "R-10.1.4.2-53",
        "log takes texts for format strings.",
        lambda message: message.replace("%%", "%").replace("{0}", "").replace("\\n", "\n"),
    ),
    "log_folds_spaces": Row("R-10.1.4.2-53", "Several spaces become one.", lambda message: " ".join(message.split())),
    "log_truncates_late": Row("R-10.1.4.2-47", "Texts end after 1,024 characters.", lambda message: message[:1024]),
    "log_is_narrow": Row(
        "R-10.1.4.2-47",
        "Characters beyond ASCII become question marks.",
        lambda message: message.encode("ascii", "replace").decode(),
    ),
    "log_has_sixteen_bits": Row(
        "R-10.1.4.2-47",
        "Characters beyond the Basic Multilingual Plane lose their upper bits.",
        lambda message: "".join(chr(ord(c) & 0xFFFF) for c in message),
    ),
    "log_says_something_for_nothing": Row(
        "R-10.1.4.2-47", "An empty text is recorded as another text.", lambda message: message or "(none)"
    ),
}
family(_Alters, "altered", _ALTERED, clauses=HERE)


@does_only_if("_log", "R-10.1.4.2-47", clauses=HERE)
def log_drops_empty_texts(_self: Base, _member: Member, _severity: str, message: str) -> bool:
    """Empty texts are not recorded."""
    return bool(message)


class _Ranks(Base):
    instead: dict[str, str]

    def _log(self, member: Member, severity: str, message: str) -> None:
        super()._log(member, self.instead.get(severity, severity), message)


_RANKED = {
    "log_makes_warnings_errors": Row("R-10.1.4.2-51", "Warnings are recorded as errors.", {"warning": "error"}),
    "log_numbers_severities_otherwise": Row(
        "R-10.1.4.2-51",
        "Severities are recorded one too high, as if their numbers began at another value.",
        {"debug": "info", "info": "warning", "warning": "error", "error": "critical"},
    ),
    "log_makes_critical_an_error": Row(
        "R-10.1.4.2-51",
        "What is critical is recorded as an error; the vendor declares the six severities of the model.",
        {"critical": "error"},
        readings={"log-severity-set": "model-6"},
    ),
}
family(_Ranks, "instead", _RANKED, clauses=HERE)
