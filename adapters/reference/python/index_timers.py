"""Index timers (10.3.2), which a container provides to its components by their policy."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import replace
from typing import Any

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.programming_model import Implementation, PortConnection, PortElementObject, UcmError
from ucm_cts.adapters.reference.python.container_services import OffersServices, ServiceElement
from ucm_cts.adapters.reference.python.members import Member
from ucm_cts.adapters.reference.python.timers import Timer, Timers

_SECOND = 1_000_000_000


class TimerElement(ServiceElement):
    """itt_service_intf."""

    container: SetsTimers

    def call(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        if method not in s.TIMER_METHODS - {s.ON_TIMEOUT}:
            raise UcmError(f"the timer service has no method {method!r}")
        timers = self.container._timers_of(self.member)
        result = getattr(timers, method)(*arguments)
        return [] if result is None else [result]


class SetsTimers(OffersServices):
    """The part of a container that sets timers for its components. One concern each, for variants to override."""

    timers_class: type[Timers] = Timers

    def _check_policies(self, implementation: Implementation) -> None:
        timers = [p for p in implementation.policies if p.definition == s.INDEX_TIMERS]
        others = [p for p in implementation.policies if p.definition != s.INDEX_TIMERS]
        super()._check_policies(replace(implementation, policies=others))
        if len(timers) > 1 or any(p.port is not None or p.element is None or p.parameters for p in timers):
            raise UcmError(f"{implementation.name!r} has index timers that cannot be applied")

    def _check_body(self, member: Member) -> None:
        super()._check_body(member)
        if self._has_timers(member):
            self._callback_of(member)

    def _has_timers(self, member: Member) -> bool:
        return any(p.definition == s.INDEX_TIMERS for p in member.implementation.policies)

    def _callback_of(self, member: Member) -> PortElementObject:
        callback = member.body.get_policy_port(s.INDEX_TIMERS, s.TIMER_CALLBACK)
        if callback is None:
            raise UcmError(f"component {member.id} does not provide {s.TIMER_CALLBACK}")
        return callback

    def _service_element(self, member: Member, policy: s.Policy) -> PortConnection:
        if policy.definition != s.INDEX_TIMERS:
            return super()._service_element(member, policy)
        member.timers = self._new_timers(member)  # each phase has timers of its own
        return PortConnection(policy.element or "", (TimerElement(self, member, policy),))

    def _new_timers(self, member: Member) -> Timers:
        return self.timers_class(
            lambda timer: self._call_back(member, timer), lambda time_out: self._lasting(member, time_out)
        )

    def _timers_of(self, member: Member) -> Timers:
        if member.timers is None:
            raise UcmError(f"component {member.id} is not operational")
        return member.timers

    def _begin_execution(self, member: Member) -> None:
        super()._begin_execution(member)
        if member.timers is not None:
            member.timers.begin()

    def _end_execution(self, member: Member) -> None:
        if member.timers is not None:
            member.timers.end()
        super()._end_execution(member)

    def _lasting(self, member: Member, time_out: Sequence[Any]) -> float:
        """How many seconds ``time_out`` lasts from now; none if its date has passed."""
        seconds, flag = time_out
        if flag != s.ABSOLUTE_TIME:
            return float(seconds)
        now = self._date_clock(member) + self.manager.advanced
        return max(0.0, (int(seconds) * _SECOND - now) / _SECOND)

    def _date_clock(self, member: Member) -> int:
        """The clock, in nanoseconds, that decides on absolute times."""
        return self._local_time(member)

    def _call_back(self, member: Member, timer: Timer) -> None:
        """Enter the component, unless the timer has been cancelled or the phase ends; an exception is dropped."""
        timers = self._timers_of(member)

        def enter() -> None:
            if timers.take(timer):
                self._call_body(member, timer)

        with suppress(Exception):
            self._execute_callback(member, lambda: timers.trigger.run(enter))

    def _call_body(self, member: Member, timer: Timer) -> None:
        self._callback_of(member).call(s.ON_TIMEOUT, [self._told(member, timer), timer.number])

    def _execute_callback(self, member: Member, work: Callable[[], None]) -> None:
        """A callback is executed as a call of a port element that the execution policy does not manage."""
        if self._is_protected(member):
            self._execute(member, s.TIMER_CALLBACK, work)
        else:
            work()

    def _told(self, member: Member, timer: Timer) -> list[Datum]:
        """The time that the callback tells: the one that was asked for."""
        return list(timer.asked)
