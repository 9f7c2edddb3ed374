"""Conformant frameworks, clause 10.3.2: what the text leaves open about index timers."""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.programming_model import Implementation, PortConnection, UcmError
from ucm_cts.adapters.mutants.python.registry import TIMED, Base, variant_of
from ucm_cts.adapters.reference.python.members import Member
from ucm_cts.adapters.reference.python.timers import Timer, Timers

_SECOND = 1_000_000_000


READINGS_OF_BOTH = {
    "zero-delay": "at-once",
    "is-cancelled": "cancelled",
    "timers-at-stop": "dropped",
    "callback-exception": "continues",
    "timer-in-startup": "works",
    "timer-overrun": "queued",
    "timer-cancel": "strict",
    "timer-anchor": "grid",
    "second-timer-policy": "refused",
}
"""What the reference framework makes of the options that both kinds of timers have."""


@variant_of(
    *TIMED,
    readings={
        **READINGS_OF_BOTH,
        "past-time": "at-once",
        "absolute-rate": "ignored",
        "absolute-clock": "local",
        "number-in-use": "replace",
        "first-periodic-expiry": "delay",
        "callback-time": "requested",
    },
)
class declares_its_timers(Base):
    """The reference framework, with all that it does declared."""


@variant_of(*TIMED, readings={"second-timer-policy": "separate"})
class has_two_timer_services(Base):
    """A component may have several policies for index timers, each with numbers of its own."""

    def _check_policies(self, implementation: Implementation) -> None:
        policies = list(implementation.policies)
        timers = [p for p in policies if p.definition == s.INDEX_TIMERS]
        super()._check_policies(replace(implementation, policies=[p for p in policies if p not in timers[1:]]))

    def _service_element(self, member: Member, policy: s.Policy) -> PortConnection:
        before = member.timers
        element = super()._service_element(member, policy)
        if policy.definition == s.INDEX_TIMERS and member.timers is not None:
            timers = [p for p in member.implementation.policies if p.definition == s.INDEX_TIMERS]
            if policy is not timers[0] and before is not None:
                own, member.timers = member.timers, before
                own.trigger = before.trigger
                member.__dict__["second"] = own
                service = _SecondService(own)
                return PortConnection(element.from_port, (service,))  # type: ignore[arg-type]
        return element

    def _begin_execution(self, member: Member) -> None:
        super()._begin_execution(member)
        if second := member.__dict__.get("second"):
            second._call_back = lambda timer: self._call_second(member, second, timer)
            second.begin()

    def _call_second(self, member: Member, second: Timers, timer: Timer) -> None:
        def enter() -> None:
            if second.take(timer):
                self._callback_of(member).call(s.ON_TIMEOUT, [list(timer.asked), timer.number])

        self._execute_callback(member, lambda: second.trigger.run(enter))

    def _end_execution(self, member: Member) -> None:
        if second := member.__dict__.pop("second", None):
            second.end()
        super()._end_execution(member)


class _SecondService:
    """The service of a second policy."""

    def __init__(self, timers: Timers) -> None:
        self.timers = timers

    def call(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        result = getattr(self.timers, method)(*arguments)
        return [] if result is None else [result]


class _Refuses(Timers):
    """``_is_refused`` says which time-outs of a start are refused."""

    def _is_refused(self, *times: Sequence[Any]) -> bool:
        raise NotImplementedError

    def start_periodic_scheduler(self, number: int, delay: Sequence[Any], rate: Sequence[Any]) -> None:
        if self._is_refused(delay, rate):
            raise UcmError("no such time")
        super().start_periodic_scheduler(number, delay, rate)

    def start_sporadic_scheduler(self, number: int, time_out: Sequence[Any]) -> None:
        if self._is_refused(time_out):
            raise UcmError("no such time")
        super().start_sporadic_scheduler(number, time_out)


class _Ignores(_Refuses):
    """``_is_refused`` says which time-outs of a start have no effect."""

    def start_periodic_scheduler(self, number: int, delay: Sequence[Any], rate: Sequence[Any]) -> None:
        if not self._is_refused(delay, rate):
            super().start_periodic_scheduler(number, delay, rate)

    def start_sporadic_scheduler(self, number: int, time_out: Sequence[Any]) -> None:
        if not self._is_refused(time_out):
            super().start_sporadic_scheduler(number, time_out)


def _is_zero(*times: Sequence[Any]) -> bool:
    return list(times[0]) == [0, s.RELATIVE_TIME]


def _is_absolute_rate(*times: Sequence[Any]) -> bool:
    return len(times) > 1 and times[1][1] == s.ABSOLUTE_TIME


@variant_of(*TIMED, readings={"zero-delay": "ignored"})
class ignores_no_delay(_Ignores):
    """A timer with a delay of zero never calls back."""

    def _is_refused(self, *times: Sequence[Any]) -> bool:
        return _is_zero(*times)


@variant_of(*TIMED, readings={"zero-delay": "refused"})
class refuses_no_delay(_Refuses):
    """A delay of zero is refused."""

    def _is_refused(self, *times: Sequence[Any]) -> bool:
        return _is_zero(*times)


@variant_of(*TIMED, readings={"absolute-rate": "refused"})
class refuses_dates_as_rates(_Refuses):
    """A rate with the flag of dates is refused."""

    def _is_refused(self, *times: Sequence[Any]) -> bool:
        return _is_absolute_rate(*times)


@variant_of(*TIMED, readings={"absolute-rate": "refused"})
class ignores_dates_as_rates(_Ignores):
    """A timer whose rate has the flag of dates never calls back."""

    def _is_refused(self, *times: Sequence[Any]) -> bool:
        return _is_absolute_rate(*times)


class _Past(Timers):
    """``_is_past`` is what a date that has passed leads to."""

    def _start(self, timer: Timer) -> None:
        if timer.asked[1] == s.ABSOLUTE_TIME and timer.due <= time.monotonic():
            self._take_past()
        else:
            super()._start(timer)

    def _take_past(self) -> None:
        """Nothing happens."""


@variant_of(*TIMED, readings={"past-time": "never"})
class ignores_the_past(_Past):
    """A date that has passed never calls back."""


@variant_of(*TIMED, readings={"past-time": "refused"})
class refuses_the_past(_Past):
    """A date that has passed is refused."""

    def _take_past(self) -> None:
        raise UcmError("the date has passed")


@variant_of(*TIMED, readings={"absolute-clock": "synchronized"})
class takes_synchronized_dates(Base):
    """Dates are those of synchronized time, which is an hour ahead of local time."""

    def _synchronized_time(self, member: Member) -> int:
        return super()._synchronized_time(member) + 3600 * _SECOND

    def _date_clock(self, member: Member) -> int:
        return self._synchronized_time(member)


@variant_of(*TIMED, readings={"absolute-clock": "observed"})
class takes_dates_of_another_clock(takes_synchronized_dates):
    """The same, and it declares nothing."""


@variant_of(*TIMED, readings={"timer-anchor": "chained", "timer-overrun": "shifted"})
class counts_from_the_last_callback(Timers):
    """A rate counts from the callback before."""

    def _next_due(self, timer: Timer, rate: float) -> float:
        return time.monotonic() + rate


@variant_of(*TIMED, readings={"timer-overrun": "skipped"})
class leaves_out_missed_expiries(Timers):
    """Expiries that pass while a callback lasts are left out."""

    def _next(self) -> Timer | None:
        now = time.monotonic()
        with self._changed:
            for timer in list(self._waiting.values()):
                if timer.rate is not None and timer.due < now - 0.05:
                    missed = math.ceil((now - timer.due) / timer.rate)
                    self._waiting[timer.number] = replace(timer, due=timer.due + missed * timer.rate)
        return super()._next()


@variant_of(*TIMED, readings={"timer-overrun": "merged"})
class merges_missed_expiries(Timers):
    """One callback comes for all expiries that passed while a callback lasted."""

    def _next_due(self, timer: Timer, rate: float) -> float:
        passed = max(0, math.floor((time.monotonic() - timer.due) / rate))
        return timer.due + (passed + 1) * rate


@variant_of(*TIMED, readings={"timer-overrun": "shifted"})
class begins_anew_after_long_callbacks(Timers):
    """After a callback that lasted longer than its rate the timer is due a whole rate later."""

    def _next(self) -> Timer | None:
        now = time.monotonic()
        with self._changed:
            for timer in list(self._waiting.values()):
                if timer.rate is not None and timer.due < now - 0.05:
                    self._waiting[timer.number] = replace(timer, due=now + timer.rate)
        return super()._next()


@variant_of(*TIMED, readings={"timer-cancel": "tolerant"})
class cancels_what_is_not_on_its_way(Timers):
    """A timer that has begun to call back, and has to wait for its component, is not cancelled any more."""

    def _next(self) -> Timer | None:
        timer = super()._next()
        self.__dict__["on_its_way"] = timer
        return timer

    def take(self, timer: Timer) -> bool:
        cancelled = timer.number not in self._waiting and timer.number in self._cancelled
        return super().take(timer) or (cancelled and self.__dict__.get("on_its_way") is timer)


@variant_of(*TIMED, readings={"is-cancelled": "inactive"})
class says_what_is_inactive(Timers):
    """is_canceled is true for every number whose timer does not wait."""

    def is_canceled(self, number: int) -> bool:
        return number not in self._waiting


@variant_of(*TIMED, readings={"timers-at-stop": "resumed"})
class resumes_timers(Base):
    """Timers that wait at stop go on after the restart."""

    def _end_execution(self, member: Member) -> None:
        if member.timers is not None and not member.timers.trigger.ended.is_set():
            member.__dict__["waiting"] = dict(member.timers._waiting)
        super()._end_execution(member)

    def _new_timers(self, member: Member) -> Timers:
        timers = super()._new_timers(member)
        timers._waiting.update(member.__dict__.pop("waiting", {}))
        return timers


@variant_of(*TIMED, readings={"timer-in-startup": "ignored"})
class ignores_timers_of_startup(Timers):
    """A timer that is set in on_startup has no effect."""

    def _start(self, timer: Timer) -> None:
        if self._is_serving:
            super()._start(timer)


@variant_of(*TIMED, readings={"first-periodic-expiry": "delay-plus-rate"})
class begins_one_rate_later(Timers):
    """The first callback of a periodic timer comes one rate after the delay."""

    def start_periodic_scheduler(self, number: int, delay: Sequence[Any], rate: Sequence[Any]) -> None:
        seconds = float(rate[0])
        self._start(Timer(number, self._due(delay) + seconds, seconds, list(delay)))


@variant_of(*TIMED, readings={"callback-time": "due"})
class tells_when_it_was_due(Base):
    """A callback tells the date when its timer was due."""

    def _told(self, member: Member, timer: Timer) -> list[Datum]:
        due = self._local_time(member) - int((time.monotonic() - timer.due) * _SECOND)
        return [due // _SECOND, s.ABSOLUTE_TIME]


@variant_of(*TIMED, readings={"callback-time": "now"})
class tells_the_date_of_the_call(Base):
    """A callback tells the date when it is called."""

    def _told(self, member: Member, timer: Timer) -> list[Datum]:
        return [self._local_time(member) // _SECOND, s.ABSOLUTE_TIME]


@variant_of(*TIMED)
class tells_its_rate(Base):
    """A periodic timer tells its rate."""

    def _told(self, member: Member, timer: Timer) -> list[Datum]:
        return list(timer.asked) if timer.rate is None else [int(timer.rate), s.RELATIVE_TIME]


@variant_of(*TIMED)
class raises_for_unknown_numbers(Timers):
    """Cancelling or asking for a number that nobody started raises, and so does cancelling what has expired."""

    def cancel_timer(self, number: int) -> None:
        if number not in self._waiting:
            raise UcmError("no such timer")
        super().cancel_timer(number)

    def is_canceled(self, number: int) -> bool:
        if number not in self._waiting and number not in self._cancelled:
            raise UcmError("no such timer")
        return super().is_canceled(number)


@variant_of(*TIMED)
class has_one_timer_thread(Base):
    """One thread calls back all components of the runtime."""

    def _execute_callback(self, member: Member, work: Callable[[], None]) -> None:
        lock: threading.RLock = self.manager.__dict__.setdefault("timer_lock", threading.RLock())
        with lock:
            super()._execute_callback(member, work)


@variant_of(*TIMED)
class calls_back_on_own_threads(Base):
    """Each callback has a thread of its own."""

    def _call_back(self, member: Member, timer: Timer) -> None:
        timers = self._timers_of(member)
        if not self._is_protected(member) and timers.take(timer):
            callback = self._callback_of(member)
            told = self._told(member, timer)

            def enter() -> None:
                if not timers.trigger.ended.is_set():
                    callback.call(s.ON_TIMEOUT, [told, timer.number])

            threading.Thread(target=enter, daemon=True).start()
        elif self._is_protected(member):
            super()._call_back(member, timer)


@variant_of(*TIMED)
class is_a_little_late(Timers):
    """Each callback comes fifty milliseconds after it is due, which the usual lateness permits."""

    def _next(self) -> Timer | None:
        timer = super()._next()
        if timer is not None and (early := timer.due + 0.05 - time.monotonic()) > 0:
            self.trigger.ended.wait(early)
        return timer
