"""Execution policies of components (10.1.3, 10.5): how they protect a component, and what they promise about its executions."""

from __future__ import annotations

from typing import Literal

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Declaration
from ucm_cts.reference_models.model.ics import Ics

Protection = Literal["", "self-executing", "active", "passive", "unprotected"]

_PROTECTIONS: dict[str, Protection] = {
    s.SELF_EXECUTING: "self-executing",
    s.ACTIVE: "active",
    s.PROTECTED_PASSIVE: "passive",
    s.UNPROTECTED_PASSIVE: "unprotected",
}
OF_THE_CORE = frozenset(_PROTECTIONS)
"""The execution policies of 10.1.3."""

_PROTECTIONS |= {extended: _PROTECTIONS[base] for extended, base in s.EXTENDED.items()}

_KNOWN = {*_PROTECTIONS, s.CLOCK, s.COMPONENT_TRACE, s.PORT_TRACE, s.INDEX_TIMERS, s.OBJECT_TIMERS}

_RUNS_APART = "R-10.1.3.2-05"
_RUN_AND_PORTS, _MANAGED_PORTS, _WHOLE_COMPONENT = "R-10.1.3.2-06", "R-10.1.3.2-09", "R-10.1.3.2-10"
_PASSIVE, _EXECUTIONS_APART = "R-10.1.3.2-13", "R-10.1.3.2-16"
_EXTENDED_SELF_EXECUTING, _EXTENDED_ACTIVE = "R-10.5.2-18", "R-10.5.2-19"
TIMERS_EXCLUDED, TRIGGERS_EXCLUDED = "R-10.3.2-43", "R-10.3.1-36"
"""The requirements that keep callbacks of timers, and triggers of object timers, apart from other executions."""

CALL_EXCLUSIONS = (
    _RUN_AND_PORTS,
    _MANAGED_PORTS,
    _WHOLE_COMPONENT,
    _PASSIVE,
    _EXECUTIONS_APART,
    _EXTENDED_SELF_EXECUTING,
    _EXTENDED_ACTIVE,
    TIMERS_EXCLUDED,
    TRIGGERS_EXCLUDED,
)
"""The requirements that keep executions by calls apart."""

EXCLUSIONS = (_RUNS_APART, *CALL_EXCLUSIONS)
"""The requirements that keep executions of a component apart."""

LOWEST_PRIORITY = 255
"""The greatest value of a priority (10.5.1)."""

_ACTIVE_CALLS = ("R-10.1.3.2-07", "R-10.1.3.2-08")

_GUARANTEES: dict[str, tuple[str, ...]] = {"passive": ("R-10.1.3.2-15",), "unprotected": ("R-10.1.3.2-21",)}


def protection_of(declaration: Declaration | None) -> Protection:
    """How its execution policy, or the one that this extends, protects a component; empty without an execution policy."""
    if declaration is None or not declaration.policies:
        return ""
    known = (_PROTECTIONS.get(p.definition) for p in declaration.policies)
    return next((protection for protection in known if protection is not None), "")


def extended_policy(declaration: Declaration) -> s.Policy | None:
    """The policy of 10.5 that the component has; the first of several."""
    if not declaration.policies:
        return None
    return next((policy for policy in declaration.policies if policy.definition in s.EXTENDED), None)


def wrong_value(policy: s.Policy) -> str:
    """The parameter of a policy of 10.5 whose value its type cannot hold, or a period that is none, with the value; empty if there is none."""
    for name, value in policy.settings.items():
        is_priority = name == s.PRIORITY.get(policy.definition)
        is_period = name == s.PERIOD.get(policy.definition)
        if (is_priority and not 0 <= value <= LOWEST_PRIORITY) or value < is_period:
            return f"{name} = {value}"
    return ""


def may_refuse_values(declaration: Declaration, ics: Ics) -> bool:
    """May the component be refused, at its start at latest, for the values of a policy of 10.5?"""
    policy = extended_policy(declaration)
    if policy is None:
        return False
    is_zero = policy.settings.get(s.PRIORITY[policy.definition]) == 0
    return bool(wrong_value(policy)) or (is_zero and ics.permits("priority-zero", "refused"))


def managed_ports(declaration: Declaration) -> set[str]:
    """The port elements that an active policy applies to: all of a component that has it as a whole."""
    ports = {p.port for p in declaration.policies if _PROTECTIONS.get(p.definition) == "active"}
    return set(declaration.provides) if None in ports else {port for port in ports if port is not None}


def exclusion(declaration: Declaration, ics: Ics, one: str, other: str) -> str:
    """The requirement that keeps two ways into a component apart; empty if none does, or if the vendor reads it so. Callbacks of timers
    have one of their own, and so have triggers.
    """
    if not {one, other}.isdisjoint(declaration.handlers):
        return TRIGGERS_EXCLUDED if _exclusion(declaration, ics, one, other) else ""
    if s.TIMER_CALLBACK in (one, other) and s.TIMER_CALLBACK not in declaration.provides:
        return TIMERS_EXCLUDED if _exclusion(declaration, ics, one, other) else ""
    return _exclusion(declaration, ics, one, other)


def _exclusion(declaration: Declaration, ics: Ics, one: str, other: str) -> str:
    protection = protection_of(declaration)
    if protection == "self-executing":
        extended = extended_policy(declaration) is not None
        if one == other == "run":
            return _EXTENDED_SELF_EXECUTING if extended else _RUNS_APART
        if ics.reading("self-exec-mutex") == "run-only":
            return ""
        return _EXTENDED_SELF_EXECUTING if extended else _RUN_AND_PORTS
    if protection == "active":
        if {one, other} <= managed_ports(declaration):
            return _MANAGED_PORTS if extended_policy(declaration) is None else _EXTENDED_ACTIVE
        return "" if ics.reading("active-unmanaged") == "unprotected" else _WHOLE_COMPONENT
    if protection == "passive":
        return _PASSIVE if one == other else _EXECUTIONS_APART
    return ""


def has_second_active(declaration: Declaration) -> bool:
    """Has the component active policies on several port elements? Where that counts as several policies it is refused, at its start at
    latest.
    """
    return len({p.port for p in declaration.policies if _PROTECTIONS.get(p.definition) == "active"} - {None}) > 1


def is_contradictory(declaration: Declaration) -> bool:
    """Has the component more than the one execution policy that it may have (10.1.3)?"""
    if not declaration.policies:
        return False
    applied = [p for p in declaration.policies if p.definition in _PROTECTIONS]
    return len({p.definition for p in applied}) > 1 or sum(p.port is None for p in applied) > 1


def is_plainest(declaration: Declaration, knows_policies: bool, ics: Ics) -> bool:
    """Does no policy of the component give a reason to refuse it? It has none in a scenario that knows none, or only the one that it must
    have where components without any are declared refused.
    """
    if not declaration.policies:
        return not knows_policies
    is_passive = declaration.policies in ((s.Policy(s.UNPROTECTED_PASSIVE),), (s.Policy(s.PROTECTED_PASSIVE),))
    return is_passive and ics.reading("missing-execution-policy") == "refuse"


def knows_policies(scenario: s.Scenario) -> bool:
    """Has any component an execution policy?"""
    return any(protection_of(declaration) for declaration in scenario.components.values())


def has_unknown_policy(declaration: Declaration) -> bool:
    """Has the component a policy that the platform does not define?"""
    return any(p.definition not in _KNOWN for p in declaration.policies)


def call_guarantees(declaration: Declaration, port: str) -> tuple[str, ...]:
    """The requirements by which an execution policy of 10.1.3 guarantees that calls of ``port`` are carried out."""
    if not declaration.policies or extended_policy(declaration) is not None:
        return ()
    protection = protection_of(declaration)
    managed = managed_ports(declaration)
    if protection == "active" and port in managed:
        return _ACTIVE_CALLS[::-1] if len(managed) == 1 else _ACTIVE_CALLS
    return _GUARANTEES.get(protection, ())
