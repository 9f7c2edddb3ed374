"""An operational phase of one component: from a start that returned up to the first step that may end it."""

from __future__ import annotations

from dataclasses import dataclass

from ucm_cts.adapters.contract.trace import Enter, Exit
from ucm_cts.reference_models.model.method_calls import Operation
from ucm_cts.reference_models.model.runtime import Member


@dataclass(frozen=True)
class Phase:
    """An operational phase of ``member``.

    ``number``: which phase of the instance it is, from 0.
    ``start``: the start that led to it, and returned.
    ``startup``, ``started``: how on_startup was entered and left.
    ``until``, ``ended_at``: the event that may end it (``n``; later than all if there is none), and when that was (``t``).
    ``closed``: the event by which the operation returned that ended it, or the next phase began; later than all if none did.
    """

    member: Member
    number: int
    start: Operation
    startup: Enter
    started: Exit
    until: int
    ended_at: int
    closed: int
