"""Object timers (10.3.1), which a container provides to its components by their policy.

They are timers of ``timers`` whose numbers the scheduler gives.
"""

from __future__ import annotations

import itertools
import time
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.programming_model import (
    BadParameter,
    Implementation,
    ObjectTimer,
    PortConnection,
    TimerHandler,
    TimerScheduler,
    UcmError,
)
from ucm_cts.adapters.reference.python.index_timers import SetsTimers
from ucm_cts.adapters.reference.python.members import Member
from ucm_cts.adapters.reference.python.timers import Timer, Timers

_MICROSECONDS = 1_000_000


@dataclass(frozen=True, kw_only=True)
class Trigger(Timer):
    """An object timer that waits.

    ``handler``: what it calls.
    ``max_rounds``, ``round``: how often in all, and how often it has.
    ``scheduled``: when it was made.
    ``last``: when it triggered last; when it was made, at first.
    """

    handler: TimerHandler
    max_rounds: int
    round: int = 0
    scheduled: float
    last: float


class Triggers(Timers):
    """The object timers of one scheduler in one operational phase. One concern each, for variants to override."""

    timer_class: type[ScheduledTimer]

    def __init__(self, call_back: Callable[[Timer], None]) -> None:
        super().__init__(call_back, lambda time_out: time_out[0] + time_out[1] / _MICROSECONDS)
        self._numbers = itertools.count(1)

    def once(self, handler: TimerHandler, delay: Sequence[int]) -> ScheduledTimer:
        """Makes a timer that triggers once."""
        return self._make(handler, delay, None, 1)

    def repeated(
        self, handler: TimerHandler, start_delay: Sequence[int], interval: Sequence[int], max_rounds: int
    ) -> ScheduledTimer:
        """Makes a timer that triggers ``max_rounds`` times."""
        if max_rounds <= 0 or self._seconds(interval) <= 0:
            raise BadParameter("no rounds, or no interval")
        return self._make(handler, start_delay, interval, max_rounds)

    def _make(
        self, handler: TimerHandler, delay: Sequence[int], interval: Sequence[int] | None, max_rounds: int
    ) -> ScheduledTimer:
        now = time.monotonic()
        rate = self._seconds(interval) if interval is not None else None
        number = self._new_number()
        timer = Trigger(
            number,
            self._due(delay),
            rate,
            list(delay),
            handler=handler,
            max_rounds=max_rounds,
            scheduled=now,
            last=now,
        )
        self._start(timer)
        return self.given(timer)

    def given(self, timer: Trigger) -> ScheduledTimer:
        """The timer as components see it."""
        return self.timer_class(self, timer)

    def _new_number(self) -> int:
        return next(self._numbers)

    def _following(self, timer: Timer) -> Timer | None:
        assert isinstance(timer, Trigger)
        following = super()._following(timer)
        if following is None or self._is_last(timer):
            return None
        assert isinstance(following, Trigger)
        return replace(following, round=timer.round + 1, last=time.monotonic())

    def _is_last(self, timer: Trigger) -> bool:
        return timer.round + 1 >= timer.max_rounds


class ScheduledTimer(ObjectTimer):
    """An object timer as components see it. One concern each, for variants to override."""

    def __init__(self, triggers: Triggers, timer: Trigger) -> None:
        self.triggers, self.timer = triggers, timer

    def rounds(self) -> int:
        """The rounds that were asked for."""
        return self.timer.max_rounds

    def id(self) -> str:
        return str(self.timer.number)

    def cancel(self) -> None:
        self.triggers.cancel_timer(self.timer.number)

    def is_cancelled(self) -> bool:
        return self.triggers.is_canceled(self.timer.number)


Triggers.timer_class = ScheduledTimer


class SchedulerElement(TimerScheduler):
    """ott_scheduler, as the container provides it to one component by one policy."""

    def __init__(self, container: SchedulesTimers, member: Member, triggers: Triggers) -> None:
        self.container, self.member, self.triggers = container, member, triggers

    def scheduler_trigger(self, handler: TimerHandler, delay: Sequence[int]) -> ObjectTimer:
        return self.container._schedule(self.member, self.triggers).once(handler, delay)

    def schedule_repeated_trigger(
        self, handler: TimerHandler, start_delay: Sequence[int], interval: Sequence[int], max_rounds: int
    ) -> ObjectTimer | None:
        triggers = self.container._schedule(self.member, self.triggers)
        return self.container._repeated_result(triggers.repeated(handler, start_delay, interval, max_rounds))


class SchedulesTimers(SetsTimers):
    """The part of a container that schedules object timers for its components. One concern each, for variants to override."""

    triggers_class: type[Triggers] = Triggers

    def _check_policies(self, implementation: Implementation) -> None:
        timers = [p for p in implementation.policies if p.definition == s.OBJECT_TIMERS]
        others = [p for p in implementation.policies if p.definition != s.OBJECT_TIMERS]
        super()._check_policies(replace(implementation, policies=others))
        self._check_schedulers(implementation, timers)

    def _check_schedulers(self, implementation: Implementation, timers: Sequence[s.Policy]) -> None:
        if len(timers) > 1 or any(p.port is not None or p.element is None or p.parameters for p in timers):
            raise UcmError(f"{implementation.name!r} has object timers that cannot be applied")

    def _service_element(self, member: Member, policy: s.Policy) -> PortConnection:
        if policy.definition != s.OBJECT_TIMERS:
            return super()._service_element(member, policy)
        triggers = self.triggers_class(lambda timer: self._trigger(member, triggers, timer))
        member.schedulers = [*[one for one in member.schedulers if not one.trigger.ended.is_set()], triggers]
        return PortConnection(policy.element or "", (SchedulerElement(self, member, triggers),))

    def _schedule(self, member: Member, triggers: Triggers) -> Triggers:
        """The timers of a scheduler that is called."""
        if triggers.trigger.ended.is_set():
            raise UcmError(f"component {member.id} is not operational")
        return triggers

    def _repeated_result(self, timer: ObjectTimer) -> ObjectTimer | None:
        """As printed, the method returns nothing."""
        return None

    def _begin_execution(self, member: Member) -> None:
        super()._begin_execution(member)
        for triggers in member.schedulers:
            triggers.begin()

    def _end_execution(self, member: Member) -> None:
        for triggers in member.schedulers:
            triggers.end()
        super()._end_execution(member)

    def _trigger(self, member: Member, triggers: Triggers, timer: Timer) -> None:
        """Enter the component at the handler, unless the timer has been cancelled or the phase ends; an exception is dropped."""
        assert isinstance(timer, Trigger)

        def enter() -> None:
            if triggers.take(timer):
                self._call_handler(triggers, timer)

        with suppress(Exception):
            self._execute_callback(member, lambda: triggers.trigger.run(enter))

    def _call_handler(self, triggers: Triggers, timer: Trigger) -> None:
        told = self._timer_told(triggers, timer), self._delta_time(timer), self._round_told(timer)
        self._handler_of(timer).on_trigger(*told)  # type: ignore[arg-type]

    def _timer_told(self, triggers: Triggers, timer: Trigger) -> ObjectTimer | None:
        return triggers.given(timer)

    def _handler_of(self, timer: Trigger) -> TimerHandler:
        return timer.handler

    def _delta_time(self, timer: Trigger) -> Sequence[int]:
        """The delay that was asked for; from the second round on, the interval."""
        if timer.round and timer.rate is not None:
            return _time(timer.rate)
        return [int(one) for one in timer.asked if isinstance(one, int)]

    def _round_told(self, timer: Trigger) -> int:
        """Rounds are counted from 0."""
        return timer.round


def _time(seconds: float) -> list[int]:
    """ucm_timeval_t."""
    return [*divmod(max(0, round(seconds * _MICROSECONDS)), _MICROSECONDS)]
