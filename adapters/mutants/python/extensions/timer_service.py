"""Wrong frameworks, clause 10.3.2: the service of index timers is not there, refuses, waits, or takes other numbers."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.programming_model import Implementation, PortConnection, UcmError
from ucm_cts.adapters.mutants.python.methods import alters, refuses_if
from ucm_cts.adapters.mutants.python.registry import MISSING_CALLBACKS, TIMED, Base, Row, breaks, family
from ucm_cts.adapters.mutants.python.variants.timed import has_two_timer_services
from ucm_cts.adapters.reference.python.index_timers import SetsTimers, TimerElement
from ucm_cts.adapters.reference.python.members import Member
from ucm_cts.adapters.reference.python.timers import Timer, Timers

_ALL = (*(f"R-10.3.2-{number}" for number in range(19, 45)), "R-10.3-04", "R-10.3-09")
"""Without timers, or with few of them, anything may fail."""


def _has_timers(implementation: Implementation) -> bool:
    return any(policy.definition == s.INDEX_TIMERS for policy in implementation.policies)


def _has(implementation: Implementation, definition: str) -> bool:
    return any(policy.definition == definition for policy in implementation.policies)


@refuses_if("_check_policies", "R-10.3.2-19", clauses=TIMED, also=_ALL)
def refuses_timers(_self: Base, implementation: Implementation) -> bool:
    """A component with index timers cannot be added."""
    return _has_timers(implementation)


@refuses_if("_check_policies", "R-10.3.2-19", clauses=TIMED)
def refuses_timers_of_self_executing(_self: Base, implementation: Implementation) -> bool:
    """A self-executing component cannot have index timers."""
    return _has_timers(implementation) and _has(implementation, s.SELF_EXECUTING)


@refuses_if("_check_policies", "R-10.3.2-19", clauses=TIMED, also=("R-10.3.2-43", "R-10.3.2-44"))
def refuses_timers_of_active(_self: Base, implementation: Implementation) -> bool:
    """An active component cannot have index timers."""
    return _has_timers(implementation) and _has(implementation, s.ACTIVE)


@refuses_if("_check_startable", "R-10.3.2-19", clauses=TIMED, also=_ALL)
def refuses_to_start_timers(self: Base) -> bool:
    """A component with index timers cannot be started."""
    return any(_has_timers(member.implementation) for member in self.members.values())


@breaks("R-10.3-09", clauses=TIMED, readings={"second-timer-policy": "separate"})
class refuses_what_it_declares(Base):
    """A second policy for index timers is refused, although two are declared."""


@alters("_dependencies_of", "R-10.3.2-23", clauses=TIMED, also=_ALL)
def hands_over_no_service(_self: Base, given: list[PortConnection], member: Member) -> list[PortConnection]:
    """A component with index timers gets no reference of the service."""
    elements = [p.element for p in member.implementation.policies if p.definition == s.INDEX_TIMERS]
    return [d for d in given if d.from_port not in elements]


@alters("_dependencies_of", "R-10.3.2-23", clauses=TIMED, also=(*_ALL, "R-11.2.1.2-05", "R-11.2.1.2-10"))
def hands_over_a_null_service(_self: Base, given: list[PortConnection], member: Member) -> list[PortConnection]:
    """The reference of the service is null."""
    elements = [p.element for p in member.implementation.policies if p.definition == s.INDEX_TIMERS]
    return [PortConnection(d.from_port, (None,)) if d.from_port in elements else d for d in given]


@alters("_dependencies_of", "R-10.3.2-23", clauses=TIMED, also=_ALL)
def hands_over_the_service_once(_self: Base, given: list[PortConnection], member: Member) -> list[PortConnection]:
    """After a restart the reference of the service is missing."""
    elements = [p.element for p in member.implementation.policies if p.definition == s.INDEX_TIMERS]
    known = member.__dict__.setdefault("had_service", False)
    member.__dict__["had_service"] = True
    return [d for d in given if not (known and d.from_port in elements)]


@breaks("R-10.3.2-24", clauses=TIMED, also=("R-11.2.1.2-05", "R-11.2.1.2-07", "R-11.2.1.2-10", "R-11.2.1.2-04"))
class hands_the_service_to_all(Base):
    """A component without the policy gets a reference of the service, too."""

    def _dependencies_of(self, member: Member) -> list[PortConnection]:
        given = super()._dependencies_of(member)
        others = (p for m in self.members.values() for p in m.implementation.policies)
        policy = next((p for p in others if p.definition == s.INDEX_TIMERS), None)
        if policy is None or self._has_timers(member):
            return given
        return [*given, PortConnection(policy.element or "", (TimerElement(self, member, policy),))]


class _Raises(Timers):
    """``raising`` is the method that raises, and whether it does its work before."""

    raising = ("", False)

    def __getattribute__(self, name: str) -> Any:
        own = super().__getattribute__(name)
        method, works = type(self).raising
        if name != method:
            return own

        def raises(*arguments: Any) -> Any:
            if works:
                own(*arguments)
            raise UcmError("refused")

        return raises


family(
    _Raises,
    "raising",
    {
        "cannot_start_periodic": Row(
            "R-10.3.2-23", "Periodic timers cannot be started.", (s.START_PERIODIC, False), _ALL
        ),
        "cannot_start_sporadic": Row(
            "R-10.3.2-23", "Sporadic timers cannot be started.", (s.START_SPORADIC, False), _ALL
        ),
        "cancels_and_raises": Row("R-10.3.2-23", "cancel_timer cancels and raises.", (s.CANCEL_TIMER, True), _ALL),
        "cannot_be_asked": Row("R-10.3.2-23", "is_canceled raises.", (s.IS_CANCELED, False), _ALL),
    },
    TIMED,
)


@breaks("R-10.3.2-23", clauses=TIMED, also=_ALL)
class refuses_large_numbers(Timers):
    """Numbers above 255 are refused."""

    def _start(self, timer: Timer) -> None:
        if timer.number > 255:
            raise UcmError("too large")
        super()._start(timer)


@breaks("R-10.3.2-23", clauses=TIMED, also=_ALL)
class has_few_timers(Timers):
    """At most three timers wait at once."""

    def _start(self, timer: Timer) -> None:
        if len(self._waiting) >= 3:
            raise UcmError("too many")
        super()._start(timer)


@breaks("R-10.3.2-23", clauses=TIMED, also=_ALL)
class refuses_to_start_in_callbacks(Timers):
    """A timer cannot be started while one calls back."""

    calling = False

    def take(self, timer: Timer) -> bool:
        self.calling = super().take(timer)
        return self.calling

    def _next(self) -> Timer | None:
        self.calling = False
        return super()._next()

    def _start(self, timer: Timer) -> None:
        if self.calling:
            raise UcmError("busy")
        super()._start(timer)


class _Forgets(Timers):
    """Timers for which ``_is_forgotten`` holds do not wait."""

    def _is_forgotten(self, timer: Timer) -> bool:
        raise NotImplementedError

    def _start(self, timer: Timer) -> None:
        if not self._is_forgotten(timer):
            super()._start(timer)


@breaks("R-10.3.2-33", clauses=TIMED, also=MISSING_CALLBACKS)
class forgets_number_zero(_Forgets):
    """A timer with number 0 never expires."""

    def _is_forgotten(self, timer: Timer) -> bool:
        return timer.number == 0


@breaks("R-10.3.2-33", clauses=TIMED, also=MISSING_CALLBACKS)
class forgets_the_largest_number(_Forgets):
    """A timer with the largest number never expires."""

    def _is_forgotten(self, timer: Timer) -> bool:
        return timer.number == s.LARGEST_NUMBER


@breaks("R-10.3.2-36", clauses=TIMED, also=(*MISSING_CALLBACKS, "R-10.3.2-34"))
class keeps_one_timer(Timers):
    """A timer that is started ends the one that was waiting."""

    def _start(self, timer: Timer) -> None:
        self._waiting.clear()
        super()._start(timer)


@breaks("R-10.3.2-36", clauses=TIMED, also=MISSING_CALLBACKS)
class keeps_sixteen_timers(_Forgets):
    """Further timers are forgotten when sixteen wait."""

    def _is_forgotten(self, timer: Timer) -> bool:
        return len(self._waiting) >= 16


class _Numbers(Base):
    """The number that business code gives is changed by ``_number``."""

    def _number(self, number: int) -> int:
        raise NotImplementedError

    def _new_timers(self, member: Member) -> Timers:
        timers = super()._new_timers(member)
        own, start = self._number, timers._start
        timers._start = lambda timer: start(replace(timer, number=own(timer.number)))  # type: ignore[method-assign]
        return timers


_OTHER_NUMBERS = (
    *MISSING_CALLBACKS,
    "R-10.3.2-22",
    "R-10.3.2-34",
    "R-10.3.2-38",
    "R-10.3.2-40",
    "R-10.3.2-26",
    "R-10.3.2-29",
    "R-10.3.2-25",
)


@breaks("R-10.3.2-34", clauses=TIMED, also=_OTHER_NUMBERS)
class has_numbers_of_eight_bits(_Numbers):
    """Numbers are taken modulo 256."""

    def _number(self, number: int) -> int:
        return number % 256


@breaks("R-10.3.2-34", clauses=TIMED, also=_OTHER_NUMBERS)
class has_numbers_of_sixteen_bits(_Numbers):
    """Numbers are taken modulo 65,536."""

    def _number(self, number: int) -> int:
        return number % 65536


@breaks("R-10.3.2-34", clauses=TIMED, also=(*_OTHER_NUMBERS, "R-10.3.2-20"))
class counts_numbers_from_one(_Numbers):
    """A number is one larger than it was given."""

    def _number(self, number: int) -> int:
        return (number + 1) % 2**32


class _Waits(Base):
    """A call of one of ``methods`` lasts ``part`` of the time that it is about, or a second."""

    methods: tuple[str, ...] = ()

    def _new_timers(self, member: Member) -> Timers:
        timers = super()._new_timers(member)
        for method in self.methods:
            own = getattr(timers, method)

            def waiting(*arguments: Any, own: Any = own) -> Any:
                result = own(*arguments)
                time.sleep(max(1, *(a[0] for a in arguments[1:])) if len(arguments) > 1 else 2)
                return result

            setattr(timers, method, waiting)
        return timers


_SLOW = (
    *MISSING_CALLBACKS,
    "R-10.3.2-25",
    "R-10.3.2-26",
    "R-10.3.2-27",
    "R-10.3.2-31",
    "R-10.3.2-32",
    "R-10.3.2-38",
    "R-10.3.2-40",
)


@breaks("R-10.3.2-41", clauses=TIMED, also=_SLOW)
class starts_sporadic_and_waits(_Waits):
    """Starting a sporadic timer lasts until it is due."""

    methods = (s.START_SPORADIC,)


@breaks("R-10.3.2-41", clauses=TIMED, also=_SLOW)
class starts_periodic_and_waits(_Waits):
    """Starting a periodic timer lasts until it is due."""

    methods = (s.START_PERIODIC,)


@breaks("R-10.3.2-41", clauses=TIMED, also=_SLOW)
class cancels_and_waits(_Waits):
    """Cancelling a timer lasts for two seconds."""

    methods = (s.CANCEL_TIMER,)


@breaks("R-10.3.2-20", clauses=TIMED, also=_ALL)
class calls_another_method(Base):
    """A timer calls on_timer instead of on_timeout."""

    def _call_back(self, member: Member, timer: Timer) -> None:
        timers = self._timers_of(member)

        def enter() -> None:
            if timers.take(timer):
                self._callback_of(member).call("on_timer", [list(timer.asked), timer.number])

        self._execute_callback(member, lambda: timers.trigger.run(enter))


class _Tells(Base):
    """Callbacks are given other arguments."""

    def _arguments(self, told: list[Datum], number: int) -> Sequence[Datum]:
        raise NotImplementedError

    def _call_back(self, member: Member, timer: Timer) -> None:
        timers = self._timers_of(member)

        def enter() -> None:
            if timers.take(timer):
                told = self._arguments(self._told(member, timer), timer.number)
                self._callback_of(member).call(s.ON_TIMEOUT, told)

        self._execute_callback(member, lambda: timers.trigger.run(enter))


@breaks("R-10.3.2-20", clauses=TIMED, also=_ALL)
class tells_number_first(_Tells):
    """on_timeout gets the number before the time."""

    def _arguments(self, told: list[Datum], number: int) -> Sequence[Datum]:
        return [number, told]


@breaks("R-10.3.2-20", clauses=TIMED, also=_ALL)
class tells_seconds_alone(_Tells):
    """on_timeout gets the seconds without their flag."""

    def _arguments(self, told: list[Datum], number: int) -> Sequence[Datum]:
        return [told[0], number]


class _Wraps(Timers):
    """A relative time is taken modulo ``most`` seconds."""

    most = 0.0

    def _due(self, time_out: Sequence[Any]) -> float:
        due = super()._due(time_out)
        if time_out[1] == s.ABSOLUTE_TIME:
            return due
        return due - float(time_out[0]) + float(time_out[0]) % self.most


family(
    _Wraps,
    "most",
    {
        "has_seconds_of_sixteen_bits": Row("R-10.3.2-25", "Seconds have 16 bits.", 2.0**16),
        "has_milliseconds_of_32_bits": Row("R-10.3.2-25", "Milliseconds have 32 bits.", 2.0**32 / 1000),
        "has_microseconds_of_32_bits": Row("R-10.3.2-25", "Microseconds have 32 bits.", 2.0**32 / 1_000_000),
    },
    TIMED,
)


@breaks("R-10.3-09", clauses=TIMED, readings={"second-timer-policy": "separate"})
class shares_timers_of_two_policies(has_two_timer_services):
    """Two policies of a component have numbers in common."""

    def _service_element(self, member: Member, policy: s.Policy) -> PortConnection:
        return SetsTimers._service_element(self, member, policy)
