"""Components with object timers (10.3.1) that make and cancel timers when they are told to."""

from __future__ import annotations

from collections.abc import Iterable

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Action, CallMethod, Declaration, Hook, Policy, TimerFrom
from ucm_cts.harness.purposes.derived.timer_steps import OTHER_PORT, PORT

SCHEDULER = "timer.timer_scheduler"
SCHEDULES = Policy(s.OBJECT_TIMERS, element=SCHEDULER)
FIRST, SECOND, THIRD = HANDLERS = ("first", "second", "third")
"""The handlers of each such component."""

_MICROSECONDS = 1_000_000


def time(seconds: float) -> list[int]:
    """ucm_timeval_t."""
    return [*divmod(round(seconds * _MICROSECONDS), _MICROSECONDS)]


def once(delay: float, told: int | None = None, handler: str = FIRST, scheduler: str = SCHEDULER) -> CallMethod:
    """Makes a timer with one trigger when the body is told ``told``, or always."""
    return CallMethod(scheduler, s.SCHEDULE_ONCE, (time(delay),), given=told, handler=handler)


def repeated(delay: float, interval: float, rounds: int, told: int | None = None, handler: str = FIRST) -> CallMethod:
    """Makes a timer with so many triggers."""
    arguments = (time(delay), time(interval), rounds)
    return CallMethod(SCHEDULER, s.SCHEDULE_REPEATED, arguments, given=told, handler=handler)


def made(
    method: str, nth: int = 1, told: int | None = None, by: str = s.SCHEDULE_ONCE, scheduler: str = SCHEDULER
) -> CallMethod:
    """Calls a method of the ``nth`` timer that schedulers returned ``by`` this method."""
    return CallMethod(scheduler, method, given=told, on=TimerFrom(by, nth))


def own(method: str, nth: int = 0, told: int | None = None) -> CallMethod:
    """Calls a method of the timer that was handed over: in its own trigger, or in the ``nth`` one."""
    return CallMethod(SCHEDULER, method, given=told, on=TimerFrom(s.ON_TRIGGER, nth))


ASKS = (own(s.TIMER_ID), own(s.TIMER_ROUNDS), own(s.IS_CANCELLED))
"""A handler that asks its timer."""


def identified(*orders: CallMethod, before: int = 0) -> tuple[CallMethod, ...]:
    """``orders``, each of which makes a timer with one trigger, and then asks for its identifier. So many of them were made ``before``."""
    return tuple(
        one for number, order in enumerate(orders, 1 + before) for one in (order, made(s.TIMER_ID, number, order.given))
    )


def scheduling(
    *orders: Action,
    policies: Iterable[Policy] = (SCHEDULES,),
    on_trigger: tuple[Action, ...] = ASKS,
    plan: dict[Hook, tuple[Action, ...]] | None = None,
) -> Declaration:
    """A component with object timers that does ``orders`` when it is called, and ``on_trigger`` when a timer triggers."""
    whole: dict[Hook, tuple[Action, ...]] = {"exchange": orders, "method": on_trigger, **(plan or {})}
    return Declaration(
        (PORT, OTHER_PORT),
        policies=tuple(policies),
        plan={hook: actions for hook, actions in whole.items() if actions},
        handlers=HANDLERS,
    )
