"""Calls of methods that a probe makes: of references of its port elements, of schedulers and of object timers (10.3.1).

Each is a function that takes the arguments and gives the results. It looks for the method when it is called, as the callee may be anything.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from ucm_cts.adapters.contract import programming_model as pm
from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_types import Datum

Calling = Callable[[list[Datum]], Any]

_METHODS = (s.CANCEL, s.IS_CANCELLED, s.TIMER_ROUNDS, s.TIMER_ID)


def call_port(reference: pm.PortElementObject, method: str) -> Calling:
    """A call of ``reference``."""
    return lambda arguments: reference.call(method, arguments)


def is_timer(value: Any) -> bool:
    """Has ``value`` the methods of an object timer?"""
    try:
        return value is not None and all(callable(getattr(value, method, None)) for method in _METHODS)
    except Exception:  # noqa: BLE001 - the object is the framework's
        return False


def schedule(scheduler: Any, method: str, handler: pm.TimerHandler | None) -> Calling:
    """A call of ``scheduler``: takes the arguments behind the handler, and gives the timer, or nothing if the method returns none."""

    def call(arguments: list[Datum]) -> Sequence[Any]:
        timer = getattr(scheduler, method)(handler, *arguments)
        return () if timer is None and method == s.SCHEDULE_REPEATED else (timer,)

    return call


def call_timer(timer: Any, method: str) -> Calling:
    """A call of a method of ``timer``: gives its result, nothing for ``cancel``."""

    def call(arguments: list[Datum]) -> Sequence[Any]:
        result = getattr(timer, method)(*arguments)
        return () if method == s.CANCEL else (result,)

    return call
