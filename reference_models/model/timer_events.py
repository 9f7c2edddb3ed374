"""What was seen of index timers (10.3.2): operational phases, with the timers that were started in them and their callbacks.

All times are those of events (``t``), in nanoseconds of the recorder's clock.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Literal, NamedTuple

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.trace import Enter
from ucm_cts.reference_models.model.clock_reading import ClockReading
from ucm_cts.reference_models.model.executions import Execution
from ucm_cts.reference_models.model.method_calls import MethodCall
from ucm_cts.reference_models.model.operational_phase import Phase
from ucm_cts.reference_models.model.runtime import Member

SECOND = 1_000_000_000
"""In nanoseconds."""


class TimeOut(NamedTuple):
    """A time-out: whole seconds, and whether they are a date."""

    seconds: int
    is_absolute: bool

    @property
    def lasts(self) -> int:
        """A relative one in nanoseconds."""
        return self.seconds * SECOND


def time_out_of(value: Datum | None) -> TimeOut | None:
    """``value`` as a time-out; None if it is none."""
    match value:
        case [int(seconds), (s.ABSOLUTE_TIME | s.RELATIVE_TIME) as flag] if not isinstance(seconds, bool):
            return TimeOut(seconds, flag == s.ABSOLUTE_TIME)
    return None


@dataclass(slots=True, eq=False)
class TimerCallback:
    """A component was entered at its callback.

    ``timer``: the timer that it belongs to; None if there is none.
    """

    execution: Execution
    timer: Timer | None = None

    @property
    def enter(self) -> Enter:
        """How the body was entered."""
        return self.execution.enter

    @property
    def n(self) -> int:
        """The event."""
        return self.execution.enter.n

    @property
    def t(self) -> int:
        """When that was."""
        return self.execution.enter.t

    @property
    def told(self) -> TimeOut | None:
        """The time that it tells; None if it tells none."""
        arguments = self.enter.arguments or ()
        return time_out_of(arguments[0]) if len(arguments) == 2 else None

    @property
    def number(self) -> int | None:
        """The number that it tells; None if it tells none."""
        arguments = self.enter.arguments or ()
        number = arguments[1] if len(arguments) == 2 else None
        return number if isinstance(number, int) and not isinstance(number, bool) else None


@dataclass(slots=True, eq=False)
class Timer:
    """A timer, from the call that started it.

    ``phase``: where it was started.
    ``call``: how. ``is_in_startup``: inside on_startup.
    ``delay``, ``rate``: what was asked for; sporadic timers have no rate.
    ``cancels``: the calls that cancel its number, before the number is started anew.
    ``again``: the call that started its number anew.
    ``is_contested``: its number was started while a timer of that number may have been waiting.
    ``callbacks``: in its phase, in order.
    ``begun``: between which moments its delay has passed, once that was asked for; None if it cannot be told.
    ``disturbed``: the number of the first callback that may have come at another time, once that was asked for.
    """

    phase: TimerPhase
    call: MethodCall
    number: int
    delay: TimeOut
    rate: TimeOut | None
    is_in_startup: bool
    cancels: list[MethodCall] = field(default_factory=list)
    again: MethodCall | None = None
    is_contested: bool = False
    callbacks: list[TimerCallback] = field(default_factory=list)
    begun: tuple[int, int] | Literal["open"] | None = "open"
    disturbed: int | None = None

    @property
    def is_started(self) -> bool:
        """Did the call that starts it return?"""
        return self.call.reply is not None and not self.call.reply.failed

    @property
    def has_usual_times(self) -> bool:
        """Are its times relative, and greater than zero?"""
        return (
            not self.delay.is_absolute and self.delay.seconds > 0 and (self.rate is None or not self.rate.is_absolute)
        )

    def waits(self, n: int) -> bool:
        """May it wait at event ``n``? A sporadic one does until its callback, each one until somebody cancels it."""
        has_come = self.rate is None and any(callback.n < n for callback in self.callbacks)
        return not has_come and not any(cancel.request.n < n for cancel in self.cancels)

    @property
    def cancelled(self) -> MethodCall | None:
        """The call that cancelled it while it waited; None if none did."""
        for cancel in self.cancels:
            has_come = self.rate is None and any(c.n < cancel.request.n for c in self.callbacks)
            return None if has_come else cancel
        return None

    @property
    def until(self) -> tuple[int, int]:
        """The event, and the moment, from which it need not call back any more: it is cancelled, or its phase ends."""
        ends = [(c.request.n, c.request.t) for c in (*self.cancels, *([self.again] if self.again else []))]
        return min([*ends, (self.phase.of.until, self.phase.of.ended_at)])


@dataclass(slots=True, eq=False)
class TimerPhase:
    """An operational phase of a component with index timers.

    ``of``: the phase.
    ``timers``: those started in it, in order.
    ``callbacks``: all of them, up to the end of the operation that ended it.
    ``resumed``: those of them that belong to timers of an earlier phase.
    ``calls``: all calls of the service, up to the end of the operation that ended it.
    ``executions``: all executions of the component in it, callbacks and others.
    ``readings``: what the component read from its clocks, by method, at any time.
    """

    of: Phase
    timers: list[Timer] = field(default_factory=list)
    callbacks: list[TimerCallback] = field(default_factory=list)
    resumed: list[TimerCallback] = field(default_factory=list)
    calls: list[MethodCall] = field(default_factory=list)
    executions: list[Execution] = field(default_factory=list)
    readings: Mapping[str, Sequence[ClockReading]] = field(default_factory=dict)

    @property
    def member(self) -> Member:
        """The component."""
        return self.of.member
