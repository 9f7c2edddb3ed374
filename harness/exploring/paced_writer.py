"""Random scenarios of the execution policies of 10.5: components with random values, which are called, stopped and started again."""

from __future__ import annotations

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Declaration, Hook, Scenario, Step
from ucm_cts.harness.exploring.writer import Choose
from ucm_cts.harness.purposes.derived.paced_policies import OTHER_PORT, PORT, policy

_RAN, _INSIDE = "ran", "inside"
_ELSEWHERE = "elsewhere"
_PERIODS, _OFFSETS, _PAUSES = (10, 20, 45, 90), (0, 0, 7, 35, 120), (3, 15, 40, 110)
"""Milliseconds."""

_PRIORITIES = (1, 2, 100, 254, 255)
_MOST_CALLS = 12
_OF_RUNS = (*["wait"] * 4, *["pause"] * 2, "call", "restart", "half")
_OF_CALLS = (*["call"] * 4, *["burst", "pause"] * 2, "restart", "half", "settle")


def paced_scenario(part: str, choose: Choose) -> Scenario:
    """A new scenario of components with the policy ``part``; ``choose`` picks one of several things."""
    return _PacedWriter(part, choose).scenario()


class _PacedWriter:
    """Writes one scenario. What it waits for comes under each reading of the text."""

    def __init__(self, part: str, choose: Choose) -> None:
        self.part = part
        self.choose = choose
        self.runs = s.is_self_executing(part)
        self.components: dict[str, Declaration] = {}
        self.steps: list[Step] = []
        self.callers: list[str] = []
        self.places = (s.MANAGER, _ELSEWHERE) if choose((False, True)) else (s.MANAGER,)
        self.is_sure = part == s.PERIODIC_SELF_EXECUTING

    def scenario(self) -> Scenario:
        """A new scenario."""
        self.steps += [s.CreateContainer(place) for place in self.places[1:]]
        for number in range(self.choose((1, 1, 2, 3))):
            self._add(f"part {number}")
        self.steps += [s.OpenGate(_RAN), *map(s.Start, self.places)]
        if self.is_held:
            self.steps += [s.Pause(self.choose(_PAUSES)), s.OpenGate(_INSIDE)]
        for _ in range(self.choose((3, 5, 8))):
            getattr(self, f"_{self.choose(_OF_RUNS if self.runs else _OF_CALLS)}")()
        self._end()
        return Scenario(self.components, tuple(self.steps))

    @property
    def is_held(self) -> bool:
        """Does any component pass the gate that is closed at first?"""
        held = s.HoldAtGate(_INSIDE)
        return any(held in actions for one in self.components.values() for actions in one.plan.values())

    def _add(self, name: str) -> None:
        after: tuple[s.Action, ...] = self.choose(((), (), (), (s.RaiseError(),)))
        gate = s.HoldAtGate(self.choose((_RAN, _RAN, _INSIDE)))
        plan: dict[Hook, tuple[s.Action, ...]] = {"run" if self.runs else "exchange": (gate, *after)}
        values = self.choose(_PERIODS), self.choose(_OFFSETS), self.choose(_PRIORITIES)
        ports = (PORT,) if self.runs else self.choose(((PORT,), (PORT, OTHER_PORT)))
        policies = tuple(policy(self.part, *values, port=port) for port in ports)
        self.components[name] = Declaration((PORT, OTHER_PORT), plan=plan, policies=policies)
        place = self.choose(self.places)
        self.steps += [
            s.AddComponent(name, place),
            s.GetPortElement(name, PORT, f"{name} in", place),
            s.GetPortElement(name, OTHER_PORT, f"{name} aux", place),
        ]

    def _call(self) -> None:
        if len(self.callers) < _MOST_CALLS:
            caller = f"caller {len(self.callers)}"
            self.callers.append(caller)
            name = self.choose(tuple(self.components))
            self.steps.append(s.Invoke(f"{name} {self.choose(('in', 'in', 'aux'))}", len(self.callers), thread=caller))

    def _burst(self) -> None:
        for _ in range(3):
            self._call()

    def _pause(self) -> None:
        self.steps.append(s.Pause(self.choose(_PAUSES)))

    def _wait(self) -> None:
        """Periodic runs come, unless all components are stopped."""
        if self.is_sure and not self.is_held:
            self.steps.append(s.ReachGate(_RAN, more=self.choose((1, 3, 8))))
        else:
            self._pause()

    def _settle(self) -> None:
        if self.callers:
            self.steps.append(s.Settle(self.callers[-1]))

    def _restart(self) -> None:
        """Callers are waited for before, so that nobody calls a component that is not operational."""
        self._join()
        stopped = self.choose((self.places, self.places[:1]))
        self.steps += [*map(s.Stop, stopped), s.Pause(self.choose(_PAUSES)), *map(s.Start, stopped)]

    def _half(self) -> None:
        """A container is stopped while callers may wait, and started again."""
        place = self.choose(self.places)
        self.steps.append(s.Stop(place))
        self._join()
        self.steps.append(s.Start(place))

    def _join(self) -> None:
        self.steps += [s.Join(caller) for caller in self.callers if s.Join(caller) not in self.steps]

    def _end(self) -> None:
        self._join()
        self.steps += [*map(s.Stop, self.places), s.Pause(self.choose(_PAUSES)), s.GetComponents()]
