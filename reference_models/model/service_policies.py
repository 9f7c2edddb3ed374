"""What the policies of the container services say in a declaration (10.1.4)."""

from __future__ import annotations

import re

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Declaration, Policy
from ucm_cts.reference_models.model.execution_policies import is_contradictory, protection_of
from ucm_cts.reference_models.model.runtime import raises

TRACES = (s.COMPONENT_TRACE, s.PORT_TRACE)
SERVICES = (s.CLOCK, *TRACES)
TIMERS = (s.INDEX_TIMERS, s.OBJECT_TIMERS)
BESIDE_EXECUTION = (*SERVICES, *TIMERS)
"""The policies of the platform that are no execution policies."""


def policies_of(declaration: Declaration | None, *definitions: str) -> list[Policy]:
    """The policies of these definitions that a component has."""
    return [p for p in declaration.policies if p.definition in definitions] if declaration is not None else []


def policy_elements(declaration: Declaration | None, *definitions: str) -> dict[str, str]:
    """The port elements that a component requires by such policies, each with the definition of its policy."""
    if declaration is None or not declaration.policies:
        return {}
    return {p.element: p.definition for p in policies_of(declaration, *definitions) if p.element is not None}


def has_several_clocks(declaration: Declaration | None) -> bool:
    """Has the component more than the one clock that it may have (10.1.4.1)?"""
    return declaration is not None and bool(declaration.policies) and len(policies_of(declaration, s.CLOCK)) > 1


def port_traces(declaration: Declaration | None, port: str, method: str) -> list[Policy]:
    """The policies that have calls of ``method`` through ``port`` recorded; one without port is about all ports, one without
    parameters about all methods (core-parameters).
    """
    traces = policies_of(declaration, s.PORT_TRACE)
    return [p for p in traces if p.port in (None, port) and (not p.parameters or method in methods_named(p))]


def methods_named(policy: Policy) -> set[str]:
    """The methods that methods_to_trace names, with any separators."""
    return set(re.findall(r"\w+", policy.parameters.get(s.METHODS_TO_TRACE, "")))


def has_timers(declaration: Declaration | None, *definitions: str) -> bool:
    """Has the component timers (10.3), of any kind or of these policies?"""
    return declaration is not None and any(p.definition in (definitions or TIMERS) for p in declaration.policies)


def has_second_timers(declaration: Declaration) -> bool:
    """Has the component two policies for timers of one kind? It may be refused for that, at its start at latest."""
    return len(declaration.policies) > 1 and any(len(policies_of(declaration, one)) > 1 for one in TIMERS)


def only_service(declaration: Declaration, *definitions: str) -> bool:
    """Can only policies of these definitions be a reason to refuse this component?"""
    services = policies_of(declaration, *definitions)
    is_plain = protection_of(declaration) in ("passive", "unprotected") and not is_contradictory(declaration)
    is_plain = is_plain and not raises(declaration, "on_init", "set_container_interface")
    return is_plain and bool(services) and len(services) + 1 == len(declaration.policies)
