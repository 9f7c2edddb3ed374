"""A framework that gives its components schedulers of object timers (10.3.1), and lets the seconds of a time decide what happens.

tests/support/java/SchedulingAdapter.java does the same.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.adapter import Adapter
from ucm_cts.adapters.contract.programming_model import (
    DeclaredException,
    Implementation,
    ObjectTimer,
    PortConnection,
    PortElementObject,
    TimerHandler,
    TimerScheduler,
)

SCHEDULER = "sched"
FIRST, SECOND = "first", "second"

PLAIN, TRIGGERS, NULL, FAILS, DECLARED, NULL_TIMER, NULL_TIME, LARGEST, ODD_TIMER, FRACTION, CROWD = range(11)
"""What happens when a time has so many seconds: a timer is made; it triggers at once; ..."""

LARGEST_ROUND = 2**32 - 1

VALUES = (0, -1, -2)
"""What the framework calls port elements with. A disguise leaves them as they are."""


def scheduled(seconds: int, handler: str = FIRST, **options: Any) -> s.CallMethod:
    """A timer that triggers once."""
    return s.CallMethod(SCHEDULER, s.SCHEDULE_ONCE, ([seconds, 7],), handler=handler, **options)


def repeated(seconds: int, rounds: int, handler: str = FIRST, **options: Any) -> s.CallMethod:
    """A timer that triggers more than once."""
    return s.CallMethod(SCHEDULER, s.SCHEDULE_REPEATED, ([seconds, 7], [1, 8], rounds), handler=handler, **options)


def on_timer(called: str, method: str, nth: int = 0, **options: Any) -> s.CallMethod:
    """A call of ``called`` of the ``nth`` timer that came by ``method``."""
    return s.CallMethod(SCHEDULER, called, on=s.TimerFrom(method, nth), **options)


def every_method(method: str, nth: int = 0) -> tuple[s.CallMethod, ...]:
    """All that a body can ask a timer, and once more whether it is cancelled."""
    return tuple(
        on_timer(one, method, nth) for one in (s.TIMER_ROUNDS, s.TIMER_ID, s.IS_CANCELLED, s.CANCEL, s.IS_CANCELLED)
    )


def component(plan: Mapping[s.Hook, tuple[s.Action, ...]], **options: Any) -> s.Declaration:
    """A component with two handlers."""
    policies = (s.Policy(s.OBJECT_TIMERS, element=SCHEDULER),)
    return s.Declaration(plan=dict(plan), policies=policies, handlers=(FIRST, SECOND), **options)


def started(*of: s.Declaration) -> s.Scenario:
    """One body of each starts."""
    return s.Scenario({f"C{number}": one for number, one in enumerate(of, 1)}, (s.Start(),))


ALL = started(
    component(
        {
            "on_startup": (
                on_timer(s.CANCEL, s.SCHEDULE_ONCE, 1),  # not yet there
                scheduled(PLAIN),
                *every_method(s.SCHEDULE_ONCE, 1),
                scheduled(TRIGGERS, SECOND),
                *every_method(s.ON_TRIGGER, 1),
                *(scheduled(seconds) for seconds in (NULL, FAILS, DECLARED, NULL_TIMER, NULL_TIME, LARGEST, FRACTION)),
                scheduled(ODD_TIMER),
                on_timer(s.CANCEL, s.SCHEDULE_ONCE, -1),
                on_timer(s.CANCEL, s.SCHEDULE_ONCE, 99),
                on_timer(s.CANCEL, s.SCHEDULE_ONCE),
                on_timer("unknown", s.SCHEDULE_ONCE, 2),
                s.CallMethod(SCHEDULER, "unknown", handler=FIRST),
                s.CallMethod(SCHEDULER, s.SCHEDULE_ONCE, handler=FIRST),
                s.CallMethod(SCHEDULER, s.SCHEDULE_ONCE, ([PLAIN, 7],)),
            ),
            "method": (
                s.Answer(s.ON_TRIGGER, overwrite=True),
                *every_method(s.ON_TRIGGER),
                on_timer(s.IS_CANCELLED, s.SCHEDULE_ONCE, 1),
            ),
            "exchange": (
                *every_method(s.SCHEDULE_ONCE, 7),
                repeated(PLAIN, 3, SECOND, given=VALUES[0]),
                on_timer(s.IS_CANCELLED, s.SCHEDULE_REPEATED, 1, given=VALUES[1]),
                repeated(NULL, 1, given=VALUES[1]),
                repeated(ODD_TIMER, 0, given=VALUES[2]),
                s.CallMethod(
                    SCHEDULER,
                    s.SCHEDULE_ONCE,
                    ([9, 9],),
                    (s.Remembered(0, s.ON_TRIGGER, 0, 4),),
                    VALUES[2],
                    handler=SECOND,
                ),
            ),
        },
        provides=("go",),
    ),
    component({"method": (s.RaiseError(),), "on_startup": (scheduled(TRIGGERS), repeated(PLAIN, 2))}),
)
"""Each of these but ``CROWD``, and calls of each timer; in the second component handlers fail."""

CROWDED = started(
    component(
        {
            "on_startup": (scheduled(CROWD),),
            "method": (
                on_timer(s.CANCEL, s.ON_TRIGGER, 30),
                on_timer(s.TIMER_ID, s.ON_TRIGGER),
                on_timer(s.CANCEL, s.ON_TRIGGER, 30),
            ),
        }
    )
)
"""A timer triggers 20 times in each of four threads, which call one of the timers that meanwhile come."""


class Timer(ObjectTimer):
    """Its rounds are the first seconds that it was made with, as they are now."""

    def __init__(self, number: int, time: Sequence[int]) -> None:
        self.number, self.time, self.cancelled = number, time, False

    def rounds(self) -> int:
        return self.time[0]

    def id(self) -> str:
        return f"timer {self.number}"

    def cancel(self) -> None:
        self.cancelled = True

    def is_cancelled(self) -> bool:
        return self.cancelled


class OddTimer(Timer):
    """Some of its methods fail."""

    def rounds(self) -> int:
        return LARGEST_ROUND

    def id(self) -> Any:
        return None

    def cancel(self) -> None:
        raise DeclaredException("late", [self.number])

    def is_cancelled(self) -> bool:
        raise RuntimeError("no")


class Scheduler(TimerScheduler):
    """Triggers at once, within the call."""

    def __init__(self) -> None:
        self.made = 0

    def new(self, time: Sequence[int]) -> Timer:
        self.made += 1
        return (OddTimer if time[0] == ODD_TIMER else Timer)(self.made, time)

    def scheduler_trigger(self, handler: TimerHandler, delay: Sequence[int]) -> Any:
        timer = self.new(delay)
        triggers: dict[int, tuple[Any, Any, int]] = {
            TRIGGERS: (timer, [0, 7], 0),
            NULL_TIMER: (None, [0, 7], 0),
            NULL_TIME: (timer, None, 0),
            LARGEST: (timer, (LARGEST_ROUND, 999_999), LARGEST_ROUND),
            FRACTION: (timer, [0.5, 7], 0),
        }
        if delay[0] == FAILS:
            raise RuntimeError("no")
        if delay[0] == DECLARED:
            raise DeclaredException("refused", ["why", 1])
        if delay[0] == CROWD:
            _crowd(lambda number: handler.on_trigger(timer, delay, number))
        if delay[0] in triggers:
            handler.on_trigger(*triggers[delay[0]])
        return None if delay[0] == NULL else timer

    def schedule_repeated_trigger(
        self, handler: TimerHandler, start_delay: Sequence[int], interval: Sequence[int], max_rounds: int
    ) -> ObjectTimer | None:
        timer = self.new(start_delay)
        for number in range(max_rounds):
            handler.on_trigger(timer, interval if number else start_delay, number)
        return None if start_delay[0] == NULL else timer


def _crowd(trigger: Callable[[int], None]) -> None:
    def triggers() -> None:
        for number in range(20):
            trigger(number)

    threads = [threading.Thread(target=triggers) for _ in range(4)]
    for one in threads:
        one.start()
    for one in threads:
        one.join()


class SchedulingAdapter(Adapter):
    """Starts one body of each component. They are called at each port element with each of ``VALUES``."""

    def create_runtime(self, implementations: Sequence[Implementation]) -> Sequence[Implementation]:
        return implementations

    def start(self, container: Sequence[Implementation]) -> None:
        for one in container:
            body = one.create()
            body.on_startup([PortConnection(p.element or "", (Scheduler(),)) for p in one.policies])
            for port in one.provides:
                for value in VALUES:
                    body.get_portElement(port).exchange(value)

    def add_component(self, container: Any, component_impl: str, attributes: Mapping[str, str]) -> int:
        return 1

    def remove_component(self, container: Any, comp_instance: int) -> None: ...

    def get_port_element(self, container: Any, comp_instance: int, port_name: str) -> PortElementObject | None: ...

    def connect(self, container: Any, comp_instance: int, port_name: str, to_port: PortElementObject | None) -> int:
        return 1

    def disconnect(self, container: Any, connection_id: int) -> None: ...

    def stop(self, container: Any) -> None: ...

    def get_components(self, container: Any) -> Sequence[int]:
        return ()

    def create_container(self, manager: Any) -> Any: ...

    def remove_container(self, manager: Any, sub_container: Any) -> None: ...

    def destroy(self, manager: Any) -> None: ...
