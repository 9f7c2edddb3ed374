"""The index timers of 10.3.2: the policy, its port elements and their methods; all names are those of the text.

``adapters.contract.scenario`` exports all names of this module.

A time-out is a list of whole seconds and a flag. ``RELATIVE_TIME`` counts from the call, ``ABSOLUTE_TIME`` is a date of a clock.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from ucm_cts.adapters.contract.data_types import Datum

INDEX_TIMERS: Final = "itt_timer"
"""The policy."""

TIMER_SERVICE: Final = "timer_service"
TIMER_CALLBACK: Final = "timer_callback"
"""Its port elements: what the component requires, and what it provides to its container."""

START_PERIODIC: Final = "start_periodic_scheduler"
START_SPORADIC: Final = "start_sporadic_scheduler"
CANCEL_TIMER: Final = "cancel_timer"
IS_CANCELED: Final = "is_canceled"
"""The methods of the service: number, delay and rate; number and time; number; number, with a boolean as its result."""

ON_TIMEOUT: Final = "on_timeout"
"""The method of the callback: a time-out and a number."""

ABSOLUTE_TIME: Final = "ABSOLUTE_TIME"
RELATIVE_TIME: Final = "RELATIVE_TIME"
"""The flags of a time-out."""

TIMER_METHODS: Final = frozenset((START_PERIODIC, START_SPORADIC, CANCEL_TIMER, IS_CANCELED, ON_TIMEOUT))
"""All methods."""

LARGEST_NUMBER: Final = 2**32 - 1
LARGEST_SECONDS: Final = 2**32 - 1
"""The largest number of a timer, and the latest date."""


def date_from(arguments: Sequence[Datum], position: int, time: Sequence[Datum]) -> tuple[Datum, ...] | None:
    """``arguments`` whose time-out at ``position`` counts from the seconds of ``time``, what a method of the clock gave; None if it gave
    no time, no time-out is there, or the date is none of 32 bits without sign.
    """
    match time, arguments[position : position + 1]:
        case [[now, microseconds]], [[seconds, flag]]:
            numbers = (now, microseconds, seconds)
            if any(isinstance(one, bool) or not isinstance(one, int) for one in numbers):
                return None
            if not (0 <= now <= LARGEST_SECONDS and 0 <= now + seconds <= LARGEST_SECONDS):
                return None
            return (*arguments[:position], [now + seconds, flag], *arguments[position + 1 :])
    return None
