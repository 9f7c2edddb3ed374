"""Steps that scenarios of all connectors of 10.4 have: time that passes, and faults of a connection."""

from __future__ import annotations

from typing import Literal, Self

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Step

_SETTLING = 600
"""Milliseconds after which a connector knows that it was broken or mended, unless the vendor declares more."""


class ConnectionSteps:
    """Adds to ``steps``; ``link`` is the connection that is being made, or was made last."""

    steps: list[Step]
    link: str

    def pause(self, milliseconds: int) -> Self:
        """Let time pass."""
        self.steps.append(s.Pause(milliseconds))
        return self

    def break_(self, where: Literal["transport", "inside"]) -> Self:
        """Break the connection, and let the connector learn of it."""
        self.steps += [s.Break(self.link, where), s.Pause(_SETTLING)]
        return self

    def mend(self) -> Self:
        """Mend it, and let the connector learn of it."""
        self.steps += [s.Mend(self.link), s.Pause(_SETTLING)]
        return self
