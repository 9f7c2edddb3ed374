"""Wrong frameworks, clause 10.3.1: object timers are not cancelled, or too many are; they serve components that are stopped."""

from __future__ import annotations

import threading
import time
from dataclasses import replace
from typing import Any

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.programming_model import PortConnection
from ucm_cts.adapters.mutants.python.extensions import timer_ends
from ucm_cts.adapters.mutants.python.registry import MISSING_TRIGGERS, TRIGGERED, Base, breaks, is_below
from ucm_cts.adapters.mutants.python.variants.triggered import for_objects, triggers_without_end
from ucm_cts.adapters.reference.python.members import Member
from ucm_cts.adapters.reference.python.object_timers import ScheduledTimer, Trigger, Triggers
from ucm_cts.adapters.reference.python.timers import Timers

_SILENT = ("R-10.3.1-31", "R-10.3.1-33", "R-10.3.1-18", "R-10.3.1-20", "R-10.3.1-23", "R-10.3.1-30")
_OUTSIDE = (
    "R-10.3.1-35",
    "R-10.3.1-25",
    "R-10.3.1-18",
    "R-11.2.3-06",
    "R-11.2.3-10",
    "R-11.2.3-15",
    "R-11.2.3-17",
    "R-11.2.3-27",
)


def _as(name: str, of: type[Timers], requirement: str, *also: str, **readings: str) -> None:
    """A defect of index timers is one of object timers, too."""
    declared = {option.replace("_", "-"): value for option, value in readings.items()}
    breaks(requirement, clauses=TRIGGERED, also=also, readings=declared)(for_objects(of, name))


_as("object_is_not_cancelled", timer_ends.does_not_cancel, "R-10.3.1-31", *_SILENT)
_as("object_only_says_cancelled", timer_ends.only_says_cancelled, "R-10.3.1-31", *_SILENT)
_as("repeated_object_is_not_cancelled", timer_ends.does_not_cancel_periodic, "R-10.3.1-31", *_SILENT)
_as("single_object_is_not_cancelled", timer_ends.does_not_cancel_sporadic, "R-10.3.1-31", *_SILENT)
_as("object_is_not_cancelled_in_its_handler", timer_ends.does_not_cancel_in_callbacks, "R-10.3.1-31", *_SILENT)
_as("cancel_ends_all_objects", timer_ends.cancels_all, "R-10.3.1-32", *MISSING_TRIGGERS)
_as("cancel_ends_what_is_due_next", timer_ends.cancels_what_is_due_next, "R-10.3.1-32", *MISSING_TRIGGERS, *_SILENT)
_as("object_forgets_that_it_was_cancelled", timer_ends.forgets_cancels_that_were_asked_for, "R-10.3.1-33")
_as("triggers_during_startup", timer_ends.calls_back_during_startup, "R-10.3.1-35", *_OUTSIDE, *MISSING_TRIGGERS)


@breaks("R-10.3.1-31", clauses=TRIGGERED, also=(*_SILENT, *MISSING_TRIGGERS, "R-10.3.1-22", "R-10.3.1-24"))
class cancel_leaves_out_one_round(Triggers):
    """cancel of a repeated timer leaves out its next round only."""

    def cancel_timer(self, number: int) -> None:
        waiting = self._waiting.get(number)
        super().cancel_timer(number)
        if waiting is not None and waiting.rate is not None:
            self._waiting[number] = replace(waiting, due=waiting.due + waiting.rate)


@breaks("R-10.3.1-31", clauses=TRIGGERED, also=(*_SILENT, "R-10.3.1-22", "R-10.3.1-21", "R-10.3.1-24"))
class cancel_comes_one_round_late(Triggers):
    """A cancelled timer triggers once more."""

    def cancel_timer(self, number: int) -> None:
        waiting = self._waiting.get(number)
        super().cancel_timer(number)
        if isinstance(waiting, Trigger):
            self._waiting[number] = replace(waiting, rate=None)


@breaks("R-10.3.1-32", clauses=TRIGGERED, also=(*MISSING_TRIGGERS, "R-10.3.1-33"))
class cancel_ends_all_of_its_handler(Triggers):
    """cancel ends all timers of the handler."""

    def cancel_timer(self, number: int) -> None:
        own = self._waiting.get(number)
        super().cancel_timer(number)
        for one in list(self._waiting.values()):
            if isinstance(one, Trigger) and isinstance(own, Trigger) and one.handler is own.handler:
                self._waiting.pop(one.number, None)


@breaks("R-10.3.1-32", clauses=TRIGGERED, also=(*MISSING_TRIGGERS, "R-10.3.1-33"))
class cancel_of_an_ended_timer_ends_the_last(Triggers):
    """cancel of a timer that has ended, or was cancelled, ends the timer that was made last."""

    def cancel_timer(self, number: int) -> None:
        if number not in self._waiting and self._waiting:
            self._waiting.pop(list(self._waiting)[-1])
        super().cancel_timer(number)


@breaks("R-10.3.1-32", clauses=TRIGGERED, also=(*MISSING_TRIGGERS, *_SILENT))
class cancel_ends_timers_of_all_components(Base):
    """cancel ends the timers of that number in all components."""

    def _service_element(self, member: Member, policy: s.Policy) -> PortConnection:
        element = super()._service_element(member, policy)
        if policy.definition == s.OBJECT_TIMERS:
            known: list[Timers] = self.manager.__dict__.setdefault("all_triggers", [])
            known.append(member.schedulers[-1])

            def cancel(number: int) -> None:
                for one in known:
                    Timers.cancel_timer(one, number)

            member.schedulers[-1].cancel_timer = cancel  # type: ignore[method-assign]
        return element


class _Lasting(Base):
    """Object timers that are not ended at stop; ``_is_spared`` says which."""

    def _is_spared(self, timer: Trigger) -> bool:
        return True

    def _end_execution(self, member: Member) -> None:
        lasting = [
            (triggers, timer)
            for triggers in member.schedulers
            if not triggers.trigger.ended.is_set()
            for timer in triggers._waiting.values()
        ]
        super()._end_execution(member)
        for triggers, timer in lasting:
            assert isinstance(timer, Trigger)
            assert isinstance(triggers, Triggers)
            if self._is_spared(timer):
                self._trigger_late(triggers, timer)

    def _trigger_late(self, triggers: Triggers, timer: Trigger) -> None:
        told = self._timer_told(triggers, timer), self._delta_time(timer), self._round_told(timer)
        alarm = threading.Timer(
            max(0.0, timer.due - time.monotonic()),
            lambda: timer.handler.on_trigger(*told),  # type: ignore[arg-type]
        )
        alarm.daemon = True
        alarm.start()


@breaks("R-10.3.1-35", clauses=TRIGGERED, also=_OUTSIDE)
class triggers_stopped_components(_Lasting):
    """Timers that wait at stop trigger when they are due."""


@breaks("R-10.3.1-35", clauses=TRIGGERED, also=_OUTSIDE)
class triggers_stopped_components_once_more(_Lasting):
    """A repeated timer that waits at stop triggers once more."""

    def _is_spared(self, timer: Trigger) -> bool:
        return timer.rate is not None


@breaks("R-10.3.1-35", clauses=TRIGGERED, also=_OUTSIDE)
class triggers_removed_components(Base):
    """Timers of a component that is removed trigger when they are due."""

    def _end_execution(self, member: Member) -> None:
        for triggers in member.schedulers:
            if not triggers.trigger.ended.is_set():
                member.__dict__["lasting"] = triggers, list(triggers._waiting.values())
        super()._end_execution(member)

    def _remove(self, member: Member, failures: Any) -> None:
        super()._remove(member, failures)
        triggers, waiting = member.__dict__.get("lasting", (None, ()))
        for timer in waiting:
            _Lasting._trigger_late(self, triggers, timer)  # type: ignore[arg-type]


@breaks("R-10.3.1-18", clauses=TRIGGERED, also=(*MISSING_TRIGGERS, "R-10.3.1-35", "R-10.3.1-20"))
class has_no_triggers_after_a_restart(Base):
    """After a restart object timers do not trigger."""

    def _begin_execution(self, member: Member) -> None:
        if member.__dict__.get("had_triggers"):
            for triggers in member.schedulers:
                triggers.begin = lambda: None  # type: ignore[method-assign]
        member.__dict__["had_triggers"] = True
        super()._begin_execution(member)


@breaks("R-10.3.1-35", clauses=TRIGGERED, readings={"object-timers-at-stop": "resumed"})
class drops_triggers_it_declares_resumed(Base):
    """Timers that wait at stop are dropped, although they are declared to go on."""


@breaks("R-10.3.1-35", clauses=TRIGGERED, readings={"object-timer-in-startup": "ignored"})
class takes_triggers_of_startup(Base):
    """A timer that is made in on_startup triggers, although it is declared to have no effect."""


@breaks("R-10.3.1-19", clauses=TRIGGERED, readings={"object-zero-delay": "ignored"})
class triggers_at_once_undeclared(Base):
    """A delay of zero triggers at once, although it is declared to have no effect."""


@breaks("R-10.3.1-22", clauses=TRIGGERED, readings={"object-timer-overrun": "merged"})
class catches_up_undeclared(Base):
    """Missed triggers are caught up, although they are declared to be merged."""


@breaks("R-10.3.1-23", clauses=TRIGGERED, readings={"zero-rounds": "none"}, also=("R-10.3.1-31", "R-10.3.1-17"))
class triggers_without_end_undeclared(triggers_without_end):
    """A timer with no rounds triggers without end, although it is declared never to."""


@breaks("R-10.3.1-23", clauses=TRIGGERED, readings={"zero-rounds": "none"}, also=("R-10.3.1-17",))
class refuses_no_rounds_undeclared(Base):
    """A timer with no rounds is refused, although it is declared accepted."""


@breaks("R-10.3.1-21", clauses=TRIGGERED, readings={"first-repeated-trigger": "delay-plus-interval"}, also=_SILENT)
class begins_at_the_delay_undeclared(Base):
    """The first repeated trigger comes at the start delay, although it is declared one interval later."""


@breaks("R-10.3.1-31", clauses=TRIGGERED, readings={"object-timer-cancel": "strict"}, also=_SILENT)
class triggers_on_their_way_come_undeclared(for_objects(timer_ends.cancels_what_is_not_on_its_way, "base")):  # type: ignore[misc]
    """A timer that has begun to trigger, and has to wait for its component, is not cancelled, although that is declared."""


class _Later(Base):
    """``_serve_again`` changes what a scheduler does from the second phase of its component on."""

    def _serve_again(self, triggers: Triggers) -> None:
        raise NotImplementedError

    def _service_element(self, member: Member, policy: s.Policy) -> PortConnection:
        is_again = bool(member.schedulers)
        element = super()._service_element(member, policy)
        if is_again and policy.definition == s.OBJECT_TIMERS:
            triggers = member.schedulers[-1]
            assert isinstance(triggers, Triggers)
            self._serve_again(triggers)
        return element


@breaks("R-10.3.1-31", clauses=TRIGGERED, also=_SILENT)
class does_not_cancel_after_a_restart(_Later):
    """After a restart cancel has no effect."""

    def _serve_again(self, triggers: Triggers) -> None:
        triggers.cancel_timer = lambda number: None  # type: ignore[method-assign]


@breaks(
    "R-10.3.1-28", clauses=TRIGGERED, also=(*_SILENT, *MISSING_TRIGGERS, "R-10.3.1-25", "R-10.3.1-26", "R-10.3.1-29")
)
class has_one_identifier_after_a_restart(_Later):
    """After a restart all timers have one identifier."""

    def _serve_again(self, triggers: Triggers) -> None:
        triggers.timer_class = type("Same", (ScheduledTimer,), {"id": lambda _: "timer"})


@breaks("R-10.3.1-32", clauses=TRIGGERED, also=MISSING_TRIGGERS)
class repeats_once_after_a_restart(_Later):
    """After a restart a repeated timer triggers once."""

    def _serve_again(self, triggers: Triggers) -> None:
        triggers._is_last = lambda timer: True  # type: ignore[method-assign]


@breaks("R-10.3.1-23", clauses=TRIGGERED, also=MISSING_TRIGGERS)
class repeats_once_in_containers_below(Base):
    """A repeated timer in a container below the manager triggers once."""

    def _service_element(self, member: Member, policy: s.Policy) -> PortConnection:
        element = super()._service_element(member, policy)
        if policy.definition == s.OBJECT_TIMERS and is_below(self):
            member.schedulers[-1]._is_last = lambda timer: True  # type: ignore[attr-defined]
        return element


@breaks("R-10.3.1-31", clauses=TRIGGERED, also=_SILENT)
class cancels_for_the_first_component_only(Base):
    """cancel has no effect for the second component that was started, and later ones."""

    def _service_element(self, member: Member, policy: s.Policy) -> PortConnection:
        element = super()._service_element(member, policy)
        if policy.definition == s.OBJECT_TIMERS and member.id != self.manager.__dict__.setdefault("first", member.id):
            member.schedulers[-1].cancel_timer = lambda number: None  # type: ignore[method-assign]
        return element
