"""Wrong frameworks, clause 10.3.2: index timers are not cancelled, or too many are; they serve components that are stopped."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable

from ucm_cts.adapters.contract.programming_model import UcmError
from ucm_cts.adapters.mutants.python.methods import alters
from ucm_cts.adapters.mutants.python.registry import MISSING_CALLBACKS, TIMED, Base, breaks
from ucm_cts.adapters.mutants.python.variants.timed import cancels_what_is_not_on_its_way
from ucm_cts.adapters.reference.python.members import Member
from ucm_cts.adapters.reference.python.timers import Timer, Timers

_SILENT = (
    "R-10.3.2-38",
    "R-10.3.2-40",
    "R-10.3.2-22",
    "R-10.3-04",
    "R-10.3.2-33",
    "R-10.3.2-29",
    "R-10.3.2-25",
    "R-10.3.2-26",
)
_OUTSIDE = (
    "R-10.3.2-42",
    "R-10.3.2-22",
    "R-10.3.2-34",
    "R-10.3.2-37",
    "R-11.2.3-06",
    "R-11.2.3-10",
    "R-11.2.3-15",
    "R-11.2.3-17",
    "R-11.2.3-27",
)


@breaks("R-10.3.2-38", clauses=TIMED, also=_SILENT)
class does_not_cancel(Timers):
    """cancel_timer does nothing."""

    def cancel_timer(self, number: int) -> None:
        pass


@breaks("R-10.3.2-38", clauses=TIMED, also=_SILENT)
class only_says_cancelled(Timers):
    """cancel_timer is remembered, and the timer calls back as before."""

    def cancel_timer(self, number: int) -> None:
        if number in self._waiting:
            self._cancelled.add(number)


@breaks("R-10.3.2-38", clauses=TIMED, also=_SILENT)
class does_not_cancel_periodic(Timers):
    """A periodic timer cannot be cancelled."""

    def cancel_timer(self, number: int) -> None:
        waiting = self._waiting.get(number)
        super().cancel_timer(number)
        if waiting is not None and waiting.rate is not None:
            self._waiting[number] = waiting


@breaks("R-10.3.2-38", clauses=TIMED, also=_SILENT)
class does_not_cancel_sporadic(Timers):
    """A sporadic timer cannot be cancelled."""

    def cancel_timer(self, number: int) -> None:
        waiting = self._waiting.get(number)
        super().cancel_timer(number)
        if waiting is not None and waiting.rate is None:
            self._waiting[number] = waiting


@breaks("R-10.3.2-38", clauses=TIMED, also=_SILENT)
class cancels_at_the_next_callback(Timers):
    """A cancelled periodic timer calls back once more."""

    def cancel_timer(self, number: int) -> None:
        waiting = self._waiting.get(number)
        super().cancel_timer(number)
        if waiting is not None:
            self._waiting[number] = Timer(number, waiting.due, None, waiting.asked)


@breaks("R-10.3.2-38", clauses=TIMED, also=_SILENT)
class does_not_cancel_in_callbacks(Timers):
    """A timer cannot be cancelled in its own callback."""

    def take(self, timer: Timer) -> bool:
        self.__dict__["calling"] = timer.number
        return super().take(timer)

    def _next(self) -> Timer | None:
        self.__dict__["calling"] = None
        return super()._next()

    def cancel_timer(self, number: int) -> None:
        if self.__dict__.get("calling") != number:
            super().cancel_timer(number)


@breaks("R-10.3.2-39", clauses=TIMED, also=MISSING_CALLBACKS)
class cancels_all(Timers):
    """cancel_timer cancels all timers of the component."""

    def cancel_timer(self, number: int) -> None:
        for known in list(self._waiting):
            super().cancel_timer(known)


@breaks("R-10.3.2-39", clauses=TIMED, also=(*MISSING_CALLBACKS, "R-10.3.2-38", "R-10.3.2-40"))
class cancels_what_is_due_next(Timers):
    """cancel_timer also cancels the timer that is due next."""

    def cancel_timer(self, number: int) -> None:
        super().cancel_timer(number)
        if self._waiting:
            self._waiting.pop(min(self._waiting.values(), key=lambda timer: timer.due).number)


@breaks("R-10.3.2-37", clauses=TIMED, also=(*MISSING_CALLBACKS, *_SILENT))
class cancels_in_all_components(Base):
    """cancel_timer cancels the timers of that number in all components."""

    def _new_timers(self, member: Member) -> Timers:
        timers = super()._new_timers(member)
        known: list[Timers] = self.manager.__dict__.setdefault("all_timers", [])
        known.append(timers)
        own: Callable[[int], None] = Timers.cancel_timer.__get__(timers)

        def cancel(number: int) -> None:
            for one in known:
                Timers.cancel_timer(one, number)
            own(number)

        timers.cancel_timer = cancel  # type: ignore[method-assign]
        return timers


@breaks("R-10.3.2-37", clauses=TIMED, also=(*MISSING_CALLBACKS, *_SILENT, "R-10.3.2-32", "R-10.3.2-31"))
class shares_numbers(Base):
    """A number that a component starts ends the timer of that number of another component."""

    def _new_timers(self, member: Member) -> Timers:
        timers = super()._new_timers(member)
        known: list[Timers] = self.manager.__dict__.setdefault("all_timers", [])
        known.append(timers)
        start = timers._start

        def shared(timer: Timer) -> None:
            for one in known:
                if one is not timers:
                    one._waiting.pop(timer.number, None)
            start(timer)

        timers._start = shared  # type: ignore[method-assign]
        return timers


_OTHERS = (
    "R-10.3.2-22",
    "R-10.3.2-34",
    "R-10.3.2-25",
    "R-10.3.2-26",
    "R-10.3.2-29",
    "R-10.3.2-32",
    "R-10.3.2-35",
    "R-10.3.2-38",
)


@breaks("R-10.3.2-37", clauses=TIMED, also=_OTHERS)
class calls_back_all_instances(Base):
    """A timer calls back all components with timers that are operational."""

    def _call_back(self, member: Member, timer: Timer) -> None:
        others = [m for m in self.started if m.timers is not None and m is not member]
        super()._call_back(member, timer)
        for other in others:
            _enter(self, other, timer)


@breaks("R-10.3.2-21", clauses=TIMED, also=(*MISSING_CALLBACKS, "R-10.3.2-22", "R-10.3.2-37", "R-10.3.2-42", *_OUTSIDE))
class calls_back_the_first_instance(Base):
    """A timer calls back the component that was started first."""

    def _call_back(self, member: Member, timer: Timer) -> None:
        first = next((m for m in self.started if m.timers is not None), member)
        if self._timers_of(member).take(timer):
            _enter(self, first, timer)


def _enter(container: Base, member: Member, timer: Timer) -> None:
    """Calls back ``member`` as if the timer was its own."""
    callback = container._callback_of(member)

    def call() -> None:
        callback.call("on_timeout", [list(timer.asked), timer.number])

    container._execute_callback(member, call)


@breaks("R-10.3.2-22", clauses=TIMED, also=("R-10.3.2-34", "R-10.3.2-37", "R-10.3.2-42"))
class calls_back_at_start(Base):
    """A component with timers is called back when it becomes operational."""

    def _begin_execution(self, member: Member) -> None:
        super()._begin_execution(member)
        if member.timers is not None:
            self._callback_of(member).call("on_timeout", [[0, "RELATIVE_TIME"], 4711])


# is_canceled


@alters("is_canceled", "R-10.3.2-40", clauses=TIMED)
def says_never_cancelled(_self: Timers, _answer: bool, _number: int) -> bool:
    """is_canceled gives false."""
    return False


@alters("is_canceled", "R-10.3.2-40", clauses=TIMED)
def says_always_cancelled(_self: Timers, _answer: bool, _number: int) -> bool:
    """is_canceled gives true."""
    return True


@alters("is_canceled", "R-10.3.2-40", clauses=TIMED)
def says_whether_it_waits(self: Timers, _answer: bool, number: int) -> bool:
    """is_canceled tells whether the timer waits."""
    return number in self._waiting


@alters("is_canceled", "R-10.3.2-40", clauses=TIMED)
def gives_a_number(_self: Timers, answer: bool, _number: int) -> int:
    """is_canceled gives 0 or 1."""
    return int(answer)


@breaks("R-10.3.2-40", clauses=TIMED)
class remembers_cancels_for_ever(Timers):
    """is_canceled gives true for a number that was cancelled once, also when it is started anew."""

    def _start(self, timer: Timer) -> None:
        cancelled = timer.number in self._cancelled
        super()._start(timer)
        if cancelled:
            self._cancelled.add(timer.number)


@breaks("R-10.3.2-40", clauses=TIMED)
class says_cancelled_if_any_is(Timers):
    """is_canceled gives true when any timer was cancelled."""

    def is_canceled(self, number: int) -> bool:
        return bool(self._cancelled)


@breaks("R-10.3-04", clauses=TIMED, also=(*MISSING_CALLBACKS, "R-10.3.2-40"))
class uses_numbers_once(Timers):
    """A number that was cancelled cannot be used again: its timer never expires."""

    def _start(self, timer: Timer) -> None:
        was_cancelled = timer.number in self.__dict__.setdefault("used", set())
        super()._start(timer)
        if was_cancelled:
            del self._waiting[timer.number]

    def cancel_timer(self, number: int) -> None:
        if number in self._waiting:
            self.__dict__.setdefault("used", set()).add(number)
        super().cancel_timer(number)


@breaks("R-10.3-04", clauses=TIMED, also=(*MISSING_CALLBACKS,))
class uses_expired_numbers_once(Timers):
    """A number whose timer has expired cannot be used again."""

    def take(self, timer: Timer) -> bool:
        if timer.rate is None:
            self.__dict__.setdefault("used", set()).add(timer.number)
        return super().take(timer)

    def _start(self, timer: Timer) -> None:
        if timer.number not in self.__dict__.get("used", ()):
            super()._start(timer)


# phases


class _Lasting(Base):
    """Timers that are not ended at stop."""

    def _is_spared(self, timer: Timer) -> bool:
        return True

    def _call_late(self, member: Member, timer: Timer) -> None:
        delay = max(0.0, timer.due - time.monotonic())
        callback = self._callback_of(member)
        alarm = threading.Timer(delay, lambda: callback.call("on_timeout", [list(timer.asked), timer.number]))
        alarm.daemon = True
        alarm.start()

    def _end_execution(self, member: Member) -> None:
        waiting = (
            list(member.timers._waiting.values())
            if member.timers is not None and not member.timers.trigger.ended.is_set()
            else []
        )
        super()._end_execution(member)
        for timer in waiting:
            if self._is_spared(timer):
                self._call_late(member, timer)


@breaks("R-10.3.2-42", clauses=TIMED, also=_OUTSIDE)
class serves_stopped_components(_Lasting):
    """Timers that wait at stop call back when they are due."""


@breaks("R-10.3.2-42", clauses=TIMED, also=_OUTSIDE)
class serves_periodic_ones_once_more(_Lasting):
    """A periodic timer that waits at stop calls back once more."""

    def _is_spared(self, timer: Timer) -> bool:
        return timer.rate is not None


@breaks("R-10.3.2-42", clauses=TIMED, also=_OUTSIDE)
class serves_removed_components(Base):
    """Timers of a component that is removed call back when they are due."""

    def _end_execution(self, member: Member) -> None:
        if member.timers is not None and not member.timers.trigger.ended.is_set():
            member.__dict__["waiting"] = list(member.timers._waiting.values())
        super()._end_execution(member)

    def _remove(self, member: Member, failures: object) -> None:
        super()._remove(member, failures)  # type: ignore[arg-type]
        for timer in member.__dict__.get("waiting", ()):
            _Lasting._call_late(self, member, timer)  # type: ignore[arg-type]


@breaks("R-10.3.2-42", clauses=TIMED, also=(*_OUTSIDE, *MISSING_CALLBACKS))
class calls_back_during_startup(Timers):
    """A timer that is set in on_startup calls back before on_startup has returned."""

    def _start(self, timer: Timer) -> None:
        super()._start(timer)
        self.begin()


@alters("_new_timers", "R-10.3.2-21", clauses=TIMED, also=(*MISSING_CALLBACKS, "R-10.3.2-42", "R-10.3.2-26"))
def has_no_timers_after_a_restart(_self: Base, timers: Timers, member: Member) -> Timers:
    """After a restart timers do not call back."""
    if member.__dict__.setdefault("had_timers", False):
        timers.begin = lambda: None  # type: ignore[method-assign]
    member.__dict__["had_timers"] = True
    return timers


@breaks("R-10.3.2-42", clauses=TIMED, readings={"timers-at-stop": "resumed"})
class drops_what_it_declares_resumed(Base):
    """Timers that wait at stop are dropped, although they are declared to go on."""


@breaks("R-10.3.2-23", clauses=TIMED, also=(*MISSING_CALLBACKS, "R-10.3.2-42", "R-10.3.2-44"))
class refuses_timers_in_startup(Timers):
    """A timer cannot be set in on_startup."""

    def _start(self, timer: Timer) -> None:
        if not self._is_serving:
            raise UcmError("not operational")
        super()._start(timer)


@breaks("R-10.3.2-39", clauses=TIMED, also=(*MISSING_CALLBACKS, "R-10.3.2-40"))
class cancels_the_last_for_unknown_numbers(Timers):
    """cancel_timer of a number that nobody started cancels the timer that was started last."""

    def cancel_timer(self, number: int) -> None:
        super().cancel_timer(number if number in self._waiting or not self._waiting else list(self._waiting)[-1])


@breaks("R-10.3.2-40", clauses=TIMED)
class forgets_cancels_that_were_asked_for(Timers):
    """is_canceled gives true once."""

    def is_canceled(self, number: int) -> bool:
        answer = super().is_canceled(number)
        self._cancelled.discard(number)
        return answer


@alters("_new_timers", "R-10.3.2-40", clauses=TIMED)
def keeps_cancels_over_restarts(_self: Base, timers: Timers, member: Member) -> Timers:
    """is_canceled of a number stays true in the next phase, also when the number is started anew."""
    kept = member.__dict__.setdefault("cancelled", set())
    timers._cancelled = kept
    start = timers._start

    def keeping(timer: Timer) -> None:
        before = timer.number in member.__dict__.get("former", ())
        start(timer)
        if before:
            kept.add(timer.number)

    timers._start = keeping  # type: ignore[method-assign]
    member.__dict__["former"] = set(kept)
    return timers


@breaks("R-10.3.2-40", clauses=TIMED, readings={"is-cancelled": "inactive"})
class says_what_it_declares_inactive(Base):
    """is_canceled is false for timers that have expired, although it is declared to be true."""


@breaks("R-10.3.2-38", clauses=TIMED, readings={"timer-cancel": "strict"})
class cancels_less_than_it_declares(cancels_what_is_not_on_its_way):
    """A timer that waits for its component is not cancelled, although it is declared to be."""
