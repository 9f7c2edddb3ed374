"""What was seen of timers (10.3): operational phases, with the timers that were started in them and their callbacks.

Index timers and object timers are timers of one kind or the other; a trigger of an object timer is its callback.

All times are those of events (``t``), in nanoseconds of the recorder's clock.
"""

from __future__ import annotations

import itertools
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

SECOND, _MICROSECOND = 1_000_000_000, 1000
"""In nanoseconds."""

Kind = Literal["index", "object"]
"""The two kinds of timers."""


class TimeOut(NamedTuple):
    """A time-out: seconds, whether they are a date, and the microseconds of object timers."""

    seconds: int
    is_absolute: bool
    microseconds: int = 0

    @property
    def lasts(self) -> int:
        """A relative one in nanoseconds."""
        return self.seconds * SECOND + self.microseconds * _MICROSECOND

    @property
    def shown(self) -> str:
        """For people."""
        fraction = f".{self.microseconds:06}".rstrip("0") if self.microseconds else ""
        return f"{self.seconds}{fraction} s"


def time_out_of(value: Datum | None) -> TimeOut | None:
    """``value`` as a time-out; None if it is none."""
    match value:
        case [int(seconds), (s.ABSOLUTE_TIME | s.RELATIVE_TIME) as flag] if not isinstance(seconds, bool):
            return TimeOut(seconds, flag == s.ABSOLUTE_TIME)
    return None


def span_of(value: Datum | None) -> TimeOut | None:
    """``value`` as a time of an object timer; None if it is none."""
    match value:
        case [int(seconds), int(microseconds)] if not isinstance(seconds, bool) and not isinstance(microseconds, bool):
            return TimeOut(seconds, False, microseconds) if seconds >= 0 and 0 <= microseconds < 1_000_000 else None
    return None


@dataclass(slots=True, eq=False)
class TimerCallback:
    """A component was entered at its callback, or at a handler.

    ``timer``: the timer that it belongs to; None if there is none.
    ``is_open``: it may belong to several timers.
    ``stranger``: the waiting timer of another handler that it was given, by its identifier.
    ``may_be_earlier``: a timer of an earlier phase may be the one.
    ``id``: what the object timer that it was given said its identifier is; None if it was not asked.
    """

    execution: Execution
    timer: Timer | None = None
    is_open: bool = False
    stranger: Timer | None = None
    may_be_earlier: bool = False
    id: Datum | None = None

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

    @property
    def delta(self) -> TimeOut | None:
        """The time difference that a trigger tells; None if it tells none."""
        arguments = self.enter.arguments or ()
        return span_of(arguments[0]) if len(arguments) == 2 else None


@dataclass(slots=True, eq=False)
class Timer:
    """A timer, from the call that started it.

    ``phase``: where it was started.
    ``call``: how. ``is_in_startup``: inside on_startup.
    ``number``: of an index timer; for an object timer, which one of its component it is, from 1.
    ``delay``, ``rate``: what was asked for; sporadic timers, and those with one trigger, have no rate.
    ``kind``: of which kind it is.
    ``goes_on``: it goes on when a callback raises, as its vendor declares.
    ``handler``, ``max_rounds``: what was asked for an object timer; ``max_rounds`` is None if it has one trigger.
    ``handles``: the numbers under which it came to the body.
    ``cancels``: the calls that cancel it, of an index timer those before its number is started anew.
    ``again``: the call that started its number anew.
    ``is_contested``: its callbacks cannot be told from those of another timer: its number was started while a timer of that number may
        have been waiting, or the body did not ask which object timer triggers its handler.
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
    kind: Kind = "index"
    goes_on: bool = False
    handler: str = ""
    max_rounds: int | None = None
    handles: list[int] = field(default_factory=list)
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
        """Are its times relative, and is there a delay, and a round?"""
        is_relative = not self.delay.is_absolute and (self.rate is None or not self.rate.is_absolute)
        return is_relative and self.delay.lasts > 0 and self.max_rounds != 0

    @property
    def has_no_delay(self) -> bool:
        """Is it due when it is started?"""
        return not self.delay.is_absolute and self.delay.lasts == 0

    @property
    def id(self) -> Datum | None:
        """What is known of the identifier of an object timer."""
        return next((self.phase.ids[handle] for handle in self.handles if handle in self.phase.ids), None)

    @property
    def most(self) -> int | None:
        """How often it calls back; None if there is no end, or may be none."""
        return 1 if self.rate is None else self.max_rounds or None

    @property
    def label(self) -> str:
        """What findings call it."""
        if self.kind == "index":
            return f"timer {self.number}"
        return f"timer {self.number} of handler '{self.handler}'"

    def has_come(self, n: int) -> bool:
        """Had it called back for the last time before event ``n``?"""
        return self.most is not None and sum(callback.n < n for callback in self.callbacks) >= self.most

    def waits(self, n: int) -> bool:
        """May it wait at event ``n``? It does until its last callback, or until somebody cancels it and that does not fail."""
        cancels = (cancel for cancel in self.cancels if cancel.reply is None or not cancel.reply.failed)
        return not self.has_come(n) and not any(cancel.request.n < n for cancel in cancels)

    @property
    def cancelled(self) -> MethodCall | None:
        """The call that cancelled it while it waited; None if none did. A call that failed cancels nothing."""
        calls = (cancel for cancel in self.cancels if cancel.reply is None or not cancel.reply.failed)
        first = next(calls, None)
        return first if first is not None and not self.has_come(first.request.n) else None

    @property
    def raised(self) -> Execution | None:
        """The first callback that raised."""
        return next((c.execution for c in self.callbacks if c.execution.failed), None)

    @property
    def failure(self) -> Execution | None:
        """The same, if that may have ended it."""
        return None if self.rate is None or self.goes_on else self.raised

    def may_have_failed(self, n: int) -> bool:
        """May an exception of a callback have ended it before event ``n``?"""
        return self.failure is not None and self.failure.end < n

    @property
    def until(self) -> tuple[int, int]:
        """The event, and the moment, from which it need not call back any more: it is cancelled, a callback raised, or its phase ends."""
        ends = [(c.request.n, c.request.t) for c in (*self.cancels, *([self.again] if self.again else []))]
        ends += [(self.failure.end, self.failure.left)] if self.failure is not None else []
        return min([*ends, (self.phase.of.until, self.phase.of.ended_at)])


@dataclass(slots=True, eq=False)
class TimerPhase:
    """An operational phase of a component with timers of one kind.

    ``of``: the phase.
    ``timers``: those started in it, in order.
    ``callbacks``: all of them, up to the end of the operation that ended it.
    ``resumed``: those of them that belong to timers of an earlier phase.
    ``calls``: all calls of the service, or of schedulers and object timers, up to the end of the operation that ended it.
    ``afterwards``: those that were made later, by executions that had not ended, before the next phase.
    ``executions``: all executions of the component in it, callbacks and others.
    ``readings``: what the component read from its clocks, by method, at any time.
    ``ids``: what object timers said first of their identifiers, by the number under which they came to the body.
    ``kind``: of which kind the timers are.
    """

    of: Phase
    timers: list[Timer] = field(default_factory=list)
    callbacks: list[TimerCallback] = field(default_factory=list)
    resumed: list[TimerCallback] = field(default_factory=list)
    calls: list[MethodCall] = field(default_factory=list)
    afterwards: list[MethodCall] = field(default_factory=list)
    executions: list[Execution] = field(default_factory=list)
    readings: Mapping[str, Sequence[ClockReading]] = field(default_factory=dict)
    kind: Kind = "index"
    ids: Mapping[int, Datum] = field(default_factory=dict)

    @property
    def member(self) -> Member:
        """The component."""
        return self.of.member


def note_later_calls(phases: Sequence[TimerPhase], calls: Sequence[MethodCall]) -> None:
    """Gives each of one component's ``phases``, in order, those ``calls`` of its service that were made after it."""
    for phase, later in itertools.zip_longest(phases, phases[1:]):
        until = later.of.startup.n if later is not None else None
        after = (c for c in calls if c.request.n >= phase.of.closed)
        phase.afterwards = [c for c in after if until is None or c.request.n < until]
