"""Words as scenarios: each input becomes its steps, with the names that are bound at that point."""

from __future__ import annotations

import msgspec

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import ContainerCall, Scenario, Step
from ucm_cts.adapters.contract.traits import bound_by, uses
from ucm_cts.harness.purposes.systematic.machine import Machine, Word
from ucm_cts.harness.purposes.systematic.settings import Setting


def scenario_of(setting: Setting, machine: Machine, word: Word) -> Scenario:
    """The scenario that gives ``word`` to a framework. A name that is not bound by then is replaced by ``unknown``."""
    steps: list[Step] = []
    bound = {s.MANAGER, s.NIL}
    for _, asked, move in machine.path(word):
        meant = setting.inputs[asked]
        steps += [_named(meant.step, bound), *meant.follow]
        if machine.outputs[move.output].observations[0].answer == "return":
            bound.update(variable for step in meant.steps for variable in bound_by(step))
    return Scenario(dict(setting.components), tuple(steps))


def _named(step: ContainerCall, bound: set[str]) -> ContainerCall:
    missing = {use.kind for variable, use in uses(step) if variable not in bound}
    if isinstance(step, s.Disconnect):
        return msgspec.structs.replace(step, connection=s.UNKNOWN) if "connection" in missing else step
    if isinstance(step, s.RemoveContainer):
        return msgspec.structs.replace(step, container=s.NIL) if "container" in missing else step
    return msgspec.structs.replace(step, id=s.UNKNOWN) if "component" in missing else step
