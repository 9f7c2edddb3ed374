"""Traces of simulated implementations: the monitor's findings show what a suite detects.

A simulated framework does what its machine says, and nothing else is wrong with it: ids are new, references are right,
on_startup gets the connections made so far. Its trace ends with the first thing that is not permitted.
"""

from __future__ import annotations

from typing import Any

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract import trace as t
from ucm_cts.adapters.contract.scenario import ContainerCall, Scenario
from ucm_cts.harness.purposes.systematic.faults import Fault, Subject
from ucm_cts.harness.purposes.systematic.machine import LISTS, Observation, Word
from ucm_cts.harness.purposes.systematic.settings import Setting
from ucm_cts.harness.purposes.systematic.wording import scenario_of

RIGHT = Fault("none", {})


def simulate(setting: Setting, subject: Subject, fault: Fault, word: Word) -> tuple[Scenario, t.Trace]:
    """The scenario of ``word``, and the trace that the implementation with ``fault`` leaves."""
    scenario = scenario_of(setting, subject.machine, word)
    framework = _Framework(scenario)
    state, step = 0, 0
    for _, given, move in subject.machine.path(word):
        state, seen = subject.react(fault, state, given)
        framework.go(step, seen)
        for offset in range(1, len(setting.inputs[given].steps)):
            framework.find(step + offset)
        step += len(setting.inputs[given].steps)
        if not subject.machine.outputs[move.output].permits(seen):
            break
    return scenario, tuple(framework.events)


def can_happen(setting: Setting, subject: Subject, fault: Fault, word: Word) -> bool:
    """Whether only existing instances get callbacks. No trace can show anything else."""
    made: set[str] = set()
    state = 0
    for _, given, move in subject.machine.path(word):
        state, seen = subject.react(fault, state, given)
        step = setting.inputs[given].step
        if isinstance(step, s.AddComponent) and step.component in setting.components:
            made.add(step.component)
        if not made.issuperset(name for name, _ in seen.callbacks):
            return False
        if not subject.machine.outputs[move.output].permits(seen):
            break
    return True


class _Framework:
    """Records the trace of a framework whose operations go as given."""

    def __init__(self, scenario: Scenario) -> None:
        self.scenario = scenario
        self.events: list[t.Event] = []
        self.made: dict[str, int] = {}
        self.ids: dict[str, int] = {}
        self.found: dict[str, t.Reference] = {}
        self.connected: dict[str, dict[str, t.Reference]] = {}
        self.latest = 0

    def put(self, kind: type[Any], **fields: Any) -> None:
        n = len(self.events) + 1
        self.events.append(kind(n=n, t=n, thread=0, **fields))

    def go(self, number: int, seen: Observation) -> None:
        """Step ``number`` goes as ``seen``."""
        step = self.scenario.steps[number]
        assert isinstance(step, s.ContainerCall)
        self.put(t.Call, step=number)
        answer, *listed = seen.answer.split()
        callbacks = dict(seen.callbacks)
        adds = isinstance(step, s.AddComponent) and step.component in self.scenario.components
        if (
            isinstance(step, s.AddComponent)
            and adds
            and (answer == "return" or "on_init" in callbacks.get(step.component, ()))
        ):
            self.made[step.component] = self.made.get(step.component, 0) + 1
            self.put(t.Create, component=step.component, instance=self.made[step.component])
        for name in sorted(callbacks, reverse=not isinstance(step, s.Start)):
            for hook in callbacks[name]:
                self.enter(name, hook, step)
        if answer in ("return", LISTS):
            self.put(t.Return, step=number, value=self.result(step, listed))
        else:
            self.put(t.Raise, step=number, error=answer)

    def enter(self, name: str, hook: str, step: ContainerCall) -> None:
        instance = self.made.get(name, 1)
        links = self.connected.setdefault(name, {})
        more: dict[str, Any] = {}
        if hook == "on_startup":
            more["dependencies"] = tuple(t.Dependency(port=port, references=(to,)) for port, to in links.items())
        elif hook == "on_connect" and isinstance(step, s.Connect):
            more = {"port": step.port, "reference": self.found.get(step.to)}
        elif hook in ("on_connect", "on_disconnect"):
            more["port"] = next(iter(self.scenario.components[name].requires), "")
        self.put(t.Enter, component=name, instance=instance, hook=hook, **more)
        self.put(t.Exit, component=name, instance=instance, hook=hook)
        if hook == "on_disconnect":
            links.clear()

    def result(self, step: ContainerCall, listed: list[str]) -> Any:
        """What a step gives that returns."""
        match step:
            case s.AddComponent():
                self.connected[step.component] = {}
                return self.new_id(step.component)
            case s.Connect():
                if step.to in self.found:
                    self.connected.setdefault(step.id, {})[step.port] = self.found[step.to]
                return self.new_id(step.bind)
            case s.GetPortElement():
                return t.Reference(step.id, self.made.get(step.id, 1), step.port)
            case s.GetComponents():
                return tuple(self.ids.get(name, 0) for name in listed)
        return None

    def new_id(self, name: str) -> int:
        self.latest += 1
        self.ids[name] = self.latest
        return self.latest

    def find(self, number: int) -> None:
        """Step ``number`` gets a port element of what the step before has added."""
        step, before = self.scenario.steps[number], self.events[-1]
        assert isinstance(step, s.GetPortElement)
        if step.id not in self.ids:
            self.put(t.Skip, step=number, variable=step.id)
            return
        self.put(t.Call, step=number)
        if isinstance(before, t.Return):
            self.found[step.bind] = t.Reference(step.id, self.made.get(step.id, 1), step.port)
            self.put(t.Return, step=number, value=self.found[step.bind])
        else:
            self.put(t.Raise, step=number, error="NOT_FOUND")
