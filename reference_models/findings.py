"""What the judge says about one trace."""

from __future__ import annotations

from ucm_cts.adapters.contract.value import Value


class Arrow(Value, frozen=True):
    """One message of a sequence diagram: who speaks to whom, and what. Lanes are ``test``, containers and bodies."""

    source: str
    target: str
    label: str


class Finding(Value, frozen=True):
    """One violation of one requirement, told so that a reader understands it in a minute.

    ``events`` are the ``n`` of the offending events; ``step`` is the scenario step they belong to, if any;
    ``expected_events`` says what should have happened in their place. ``expected`` and ``observed`` are one sentence
    each; two findings with the same ``requirement``, ``rule`` and ``cause`` have the same cause.
    """

    requirement: str
    rule: str
    cause: str
    expected: str
    observed: str
    events: tuple[int, ...] = ()
    step: int | None = None
    expected_events: tuple[Arrow, ...] = ()
