"""How a property is declared: its name, the requirements it stands for, and when it is checked."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

Moment = Literal[
    "ended",
    "entered",
    "called",
    "answered",
    "replied",
    "noted",
    "began",
    "over",
    "served",
    "waited",
    "linked",
    "delivered",
    "completed",
    "told",
    "closed",
]
"""When a property is checked: an operation ended; a body was entered by a callback, or by a business call; a stimulus of the test
came back; a body's own call came back; a fragment's query came back. Where components have policies: an execution began,
or was over; a call that had to wait came back, or never did; a wait of the scenario ran out of patience. Where port
elements have interfaces or policies (interactions.py): a step for connectors ended; a method of a body was entered; a
body's call of a method came back; something was counted, measured or read back; the trace is over."""


Feature = Literal["", "policies", "interactions", "fragments", "attributes"]
"""What a scenario has to use for a property to apply: nothing; where components have policies; where interactions are
followed, because port elements have interfaces or components policies; where components are fragments, or have attributes.
"""


@dataclass(frozen=True)
class Property:
    """A named check and the requirements it stands for; ``check`` takes what the monitor has at ``moment``.

    ``at`` names the operations, for ``entered`` the hooks, for ``called`` who called, that it looks at; empty stands for all. What a ``timed`` property
    finds depends on how long something took, so that a machine that stood still may be to blame. With a ``feature`` it applies
    only to scenarios that use it.
    """

    name: str
    moment: Moment
    stands_for: tuple[str, ...]
    at: tuple[str, ...]
    check: Callable[..., None]
    timed: bool = False
    feature: Feature = ""


PROPERTIES: dict[str, Property] = {}
"""All properties by name, filled as their modules are imported; ``table`` imports them all."""


def property_at(
    moment: Moment, *stands_for: str, at: tuple[str, ...] = (), timed: bool = False, feature: Feature = ""
) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """Register the decorated function, under its own name, as a property that is checked at ``moment``."""

    def register(check: Callable[..., None]) -> Callable[..., None]:
        PROPERTIES[check.__name__] = Property(check.__name__, moment, stands_for, at, check, timed, feature)
        return check

    return register


def checks(moment: Moment, at: str = "", features: frozenset[Feature] = frozenset()) -> tuple[Callable[..., None], ...]:
    """The checks of all properties for this operation or hook at ``moment``, in scenarios that use ``features``."""
    return tuple(
        r.check
        for r in PROPERTIES.values()
        if r.moment == moment and (not r.at or at in r.at) and (not r.feature or r.feature in features)
    )
