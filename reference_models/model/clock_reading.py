"""One reading of the clock of a body (10.1.4.1)."""

from __future__ import annotations

from dataclasses import dataclass

from ucm_cts.reference_models.model.method_calls import MethodCall
from ucm_cts.reference_models.model.runtime import Container


@dataclass(frozen=True, slots=True)
class ClockReading:
    """A body asked for the time and got it. All times are in nanoseconds.

    ``begin``, ``end``: the events.
    ``asked``, ``answered``: when, by the host's monotonic clock.
    ``time``: what the body's clock gave.
    ``advanced``: the virtual time that had passed by then.
    """

    call: MethodCall
    begin: int
    end: int
    asked: int
    answered: int
    time: int
    advanced: int

    @property
    def body(self) -> tuple[str, int]:
        """The body that read the clock."""
        return self.call.request.body

    @property
    def container(self) -> Container | None:
        """Where the body is; None if that is not known."""
        return self.call.caller.container if self.call.caller is not None else None
