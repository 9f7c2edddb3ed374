"""How findings name operations and what left them."""

from __future__ import annotations

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract import trace as t

_SUBJECTS = ("component", "id", "role", "port", "to", "connection", "link", "ref")
"""The fields of steps that say what they are about, in the order in which they are shown."""


def designation(step: s.Step) -> str:
    """The operation of ``step`` and what it is applied to, such as ``connect(client, out.api, api)``."""
    given = [str(value) for name in _SUBJECTS if (value := getattr(step, name, None))]
    if isinstance(step, s.Link | s.CreateContainer):
        given = [step.bind]
    return f"{s.operation(step)}({', '.join(given) or getattr(step, 'container', s.MANAGER)})"


def error_name(error: t.ErrorName) -> str:
    """How findings name what left an operation."""
    return "an undeclared exception" if error == "UNDECLARED" else error
