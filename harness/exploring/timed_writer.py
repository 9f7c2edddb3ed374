"""Random scenarios of timers (10.3): components that start and cancel timers, are called back, stopped and started again."""

from __future__ import annotations

import msgspec

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Action, CallMethod, Declaration, Hook, Policy, Scenario, Step
from ucm_cts.harness.exploring.writer import Choose
from ucm_cts.harness.purposes.derived import object_timer_steps as objects
from ucm_cts.harness.purposes.derived import timer_steps as timers

_INSIDE = "inside"
_ELSEWHERE = "elsewhere"
_NUMBERS = (5, 6, 300, 0, s.LARGEST_NUMBER)
_SECONDS = (1, 1, 1, 2, 3, 0)
_DELAYS = (0.2, 0.3, 0.5, 0.8, 0.25, 1.2, 0)
_INTERVALS = (0.3, 0.5, 0.8, 1.1)
_ROUNDS = (1, 2, 3, 5, 40, 0)
_PAUSES = (20, 300, 700, 1000, 1350)
"""Milliseconds."""

_EXECUTION = (
    (),
    (Policy(s.UNPROTECTED_PASSIVE),),
    (Policy(s.PROTECTED_PASSIVE),),
    (Policy(s.ACTIVE, timers.PORT),),
)
_OPERATIONS = (*["tell"] * 6, *["pause"] * 5, "restart", "half", "at_once")


def timed_scenario(choose: Choose) -> Scenario:
    """A new scenario of components with index timers; ``choose`` picks one of several things."""
    return _TimedWriter(choose).scenario()


def scheduled_scenario(choose: Choose) -> Scenario:
    """The same with object timers."""
    return _ScheduledWriter(choose).scenario()


class _TimedWriter:
    """Writes one scenario of index timers. Each call of a component has a value of its own, and with it an order of its own."""

    def __init__(self, choose: Choose) -> None:
        self.choose = choose
        self.components: dict[str, Declaration] = {}
        self.orders: dict[str, list[Action]] = {}
        self.steps: list[Step] = []
        self.members: dict[str, str] = {}
        self.told = 0
        self.places = (s.MANAGER, _ELSEWHERE) if choose((False, False, True)) else (s.MANAGER,)

    def scenario(self) -> Scenario:
        """A new scenario."""
        self.steps += [s.CreateContainer(place) for place in self.places[1:]]
        for number in range(self.choose((1, 1, 2))):
            self._add(f"timed {number}")
        if self.choose((False, False, True)):
            self._place(next(iter(self.components)), "again")
        self.steps += map(s.Start, self.places)
        for _ in range(self.choose((4, 6, 9))):
            getattr(self, f"_{self.choose(_OPERATIONS)}")()
        self.steps += [s.OpenGate(_INSIDE), s.Pause(self.choose(_PAUSES)), *map(s.Stop, self.places)]
        self.steps += [s.Pause(self.choose(_PAUSES)), s.GetComponents()]
        return Scenario({name: self._whole(name) for name in self.components}, tuple(self.steps), 4000)

    def _add(self, name: str) -> None:
        plan: dict[Hook, tuple[Action, ...]] = {}
        if self.choose((False,) * 4 + (True,)):
            plan["on_startup"] = (self._order(None),)
        if self.choose((False, False, False, True)):
            plan["exchange"] = (s.HoldAtGate(_INSIDE),)
        called: tuple[Action, ...] = self.choose(
            ((), (), (self._cancel_own(),), (self._order_inside(),), (s.HoldAtGate(_INSIDE),), (s.RaiseError(),))
        )
        self.components[name] = self._component(self.choose(_EXECUTION), called, plan)
        self.orders[name] = []
        self._place(name, name)

    def _component(
        self, execution: tuple[Policy, ...], called: tuple[Action, ...], plan: dict[Hook, tuple[Action, ...]]
    ) -> Declaration:
        policies = (*execution, *self.choose(((timers.TIMERS,), timers.WITH_CLOCK)))
        reads = timers.READ_CLOCKS if timers.WITH_CLOCK[1] in policies else ()
        return timers.timed(policies=policies, on_timeout=(*reads, *called), plan=plan)

    def _cancel_own(self) -> CallMethod:
        return timers.cancel_own()

    def _whole(self, name: str) -> Declaration:
        """The component with all orders that it is given."""
        made = self.components[name]
        plan = {**made.plan, "exchange": (*self.orders[name], *made.plan.get("exchange", ()))}
        return msgspec.structs.replace(made, plan={hook: actions for hook, actions in plan.items() if actions})

    def _place(self, component: str, name: str) -> None:
        place = self.choose(self.places)
        self.members[name] = component
        self.steps += [
            s.AddComponent(component, place, bind=name),
            s.GetPortElement(name, timers.PORT, f"tell {name}", place),
        ]

    def _order(self, told: int | None) -> CallMethod:
        """What is done when ``told``; always, but for timers that are due at once, if that is None."""
        number, delay = self.choose(_NUMBERS), self.choose(_SECONDS)
        delay = max(delay, 1) if told is None else delay
        made = (
            timers.sporadic(number, delay, told),
            timers.sporadic(number, delay, told),
            timers.periodic(number, delay, max(1, self.choose(_SECONDS)), told),
            timers.cancel(number, told),
            timers.is_canceled(number, told),
        )
        found: CallMethod = self.choose(made)
        return found

    def _order_inside(self) -> CallMethod:
        """What is done in each callback."""
        return self._order(None)

    def _new_call(self) -> Step:
        """It has a thread of its own, as it may be held."""
        self.told += 1
        name = self.choose(tuple(self.members))
        self.orders[self.members[name]].append(self._order(self.told))
        return s.Invoke(f"tell {name}", self.told, thread=f"teller {self.told}")

    def _tell(self) -> None:
        self.steps += [self._new_call(), s.Pause(5)]

    def _at_once(self) -> None:
        self.steps += [self._new_call(), self._new_call()]

    def _pause(self) -> None:
        self.steps.append(s.Pause(self.choose(_PAUSES)))

    def _restart(self) -> None:
        self.steps += [s.OpenGate(_INSIDE), *map(s.Stop, self.places), s.Pause(self.choose(_PAUSES))]
        self.steps += map(s.Start, self.places)

    def _half(self) -> None:
        """One container is stopped, and started again."""
        place = self.choose(self.places)
        self.steps += [s.OpenGate(_INSIDE), s.Stop(place), s.Pause(self.choose(_PAUSES)), s.Start(place)]


class _ScheduledWriter(_TimedWriter):
    """Writes one scenario of object timers."""

    def __init__(self, choose: Choose) -> None:
        super().__init__(choose)
        self.asks: tuple[Action, ...] = choose((objects.ASKS, objects.ASKS, ()))

    def _component(
        self, execution: tuple[Policy, ...], called: tuple[Action, ...], plan: dict[Hook, tuple[Action, ...]]
    ) -> Declaration:
        beside = self.choose(((), (), (timers.TIMERS,)))
        policies = (*execution, objects.SCHEDULES, *beside)
        return objects.scheduling(policies=policies, on_trigger=(*self.asks, *called), plan=plan)

    def _cancel_own(self) -> CallMethod:
        return objects.own(s.CANCEL)

    def _order(self, told: int | None) -> CallMethod:
        delay = self.choose(_DELAYS)
        delay = max(delay, 0.2) if told is None else delay
        handler, nth = self.choose(objects.HANDLERS), self.choose((1, 1, 2, 3))
        methods = (s.CANCEL, s.CANCEL, s.IS_CANCELLED, s.TIMER_ID, s.TIMER_ID, s.TIMER_ROUNDS)
        orders = (
            objects.once(delay, told, handler),
            objects.once(delay, told, handler),
            objects.repeated(delay, self.choose(_INTERVALS), self.choose(_ROUNDS), told, handler),
            objects.made(self.choose(methods), nth, told),
        )
        found: CallMethod = self.choose(orders)
        return found

    def _order_inside(self) -> CallMethod:
        """No timers that repeat, which would make as many in each round."""
        order = self._order(None)
        return order if order.method != s.SCHEDULE_REPEATED else objects.once(self.choose(_DELAYS[:-1]))
