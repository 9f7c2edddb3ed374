"""The timers of 10.3: policies, port elements and methods of index timers and object timers; all names are those of the text.

``adapters.contract.scenario`` exports all names of this module.

A time-out of 10.3.2 is a list of whole seconds and a flag. ``RELATIVE_TIME`` counts from the call, ``ABSOLUTE_TIME`` is a date of a
clock. A time of 10.3.1 is a list of seconds and microseconds, as that of the clock (10.1.4.1).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from ucm_cts.adapters.contract.data_types import Datum

INDEX_TIMERS: Final = "itt_timer"
"""The policy of index timers."""

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
"""All methods of index timers."""

OBJECT_TIMERS: Final = "ott_timer"
"""The policy of object timers."""

TIMER_SCHEDULER: Final = "timer_scheduler"
"""Its port element, which the component requires."""

SCHEDULE_ONCE: Final = "scheduler_trigger"
SCHEDULE_REPEATED: Final = "schedule_repeated_trigger"
"""The methods of the scheduler: handler and delay, with a timer as the result; handler, start delay, interval and rounds."""

ON_TRIGGER: Final = "on_trigger"
"""The method of a handler: a timer, a time and a round."""

CANCEL: Final = "cancel"
IS_CANCELLED: Final = "is_cancelled"
TIMER_ROUNDS: Final = "rounds"
TIMER_ID: Final = "id"
"""The methods of an object timer, and the getters of its attributes."""

OBJECT_TIMER_METHODS: Final = frozenset(
    (SCHEDULE_ONCE, SCHEDULE_REPEATED, ON_TRIGGER, CANCEL, IS_CANCELLED, TIMER_ROUNDS, TIMER_ID)
)
"""All methods of object timers."""

LARGEST_NUMBER: Final = 2**32 - 1
LARGEST_SECONDS: Final = 2**32 - 1
"""The largest number of a timer or a round, and the latest date."""


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
