"""Findings: the violations that the monitor finds in a trace."""

from __future__ import annotations

from ucm_cts.adapters.contract.value import Value


class Arrow(Value, frozen=True):
    """One message of a sequence diagram. Lanes are ``test``, containers and bodies."""

    source: str
    target: str
    label: str


class Finding(Value, frozen=True):
    """One violation of one requirement.

    ``rule``: the name of the property. Two findings with the same ``requirement``, ``rule`` and ``cause`` have the same cause.
    ``expected``, ``observed``: one sentence each.
    ``events``: the ``n`` of the offending events.
    ``step``: the scenario step they belong to, if any.
    ``expected_events``: what should have happened in their place.
    ``caused_by``: another requirement that was violated before about what this finding concerns, and that may be its cause.
    ``late_by``: nanoseconds by which something came later than it may, also if what followed it came too soon for that; 0 if the
    finding is about anything else.
    """

    requirement: str
    rule: str
    cause: str
    expected: str
    observed: str
    events: tuple[int, ...] = ()
    step: int | None = None
    expected_events: tuple[Arrow, ...] = ()
    caused_by: str = ""
    late_by: int = 0
