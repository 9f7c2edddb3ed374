"""Calls on threads of their own, for frameworks whose calls of what is removed or not started wait for ever.

The text leaves such calls open (11.2.3). Made by the scenario's own thread, each would cost a host its whole deadline, and
the rest of its scenario.
"""

from __future__ import annotations

import itertools

import msgspec

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Scenario, Step
from ucm_cts.harness.hosting.pace import waits

PATIENCE = 400
"""Milliseconds after which such a call is left waiting, if nothing else in its scenario waits. A call that the text does not
leave open is made again, with all the time it may have.
"""

MOST = 32
"""Scenarios with more calls stay as they are."""


def with_calls_apart(scenario: Scenario) -> Scenario:
    """``scenario`` with each call of its own thread on a worker, which need not come back; as it is if it makes none."""
    calls = [step for step in scenario.steps if isinstance(step, s.Invoke) and step.thread is None]
    if not 0 < len(calls) <= MOST:
        return scenario
    taken = {step.thread for step in scenario.steps}
    names = (f"caller{number}" for number in itertools.count(1))
    callers = list(itertools.islice((name for name in names if name not in taken), len(calls)))
    free = iter(callers)
    steps: list[Step] = []
    for step in scenario.steps:
        if isinstance(step, s.Invoke) and step.thread is None:
            caller = next(free)
            steps += (msgspec.structs.replace(step, thread=caller), s.Join(caller))
        else:
            steps.append(step)
    patience = scenario.patience if waits(scenario) else min(scenario.patience, PATIENCE)
    stay = (*scenario.may_stay, *callers)
    return msgspec.structs.replace(scenario, steps=tuple(steps), patience=patience, may_stay=stay)
