"""How long scenarios may take: as long as they wait, and longer if they are long or the product is slow."""

from __future__ import annotations

import statistics
from collections import deque

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.trace import Trace
from ucm_cts.adapters.contract.traits import duration
from ucm_cts.adapters.sdk.python.workers import FAREWELL

SECONDS_A_STEP = 0.02
"""A long scenario gets so much time more for each step after the first ``LONG``: some have hundreds."""

LONG = 50
"""The number of steps that fit into the usual time."""

LONGER = 3
"""A scenario of a slow product may take so many times longer than its pace says."""

COMPUTED = 10
"""Threads of ``Stress`` compute as long as it lasts: on a busy machine, and in virtual time, that may take so many times longer."""

MOST_MORE = 600.0
"""Seconds that a scenario of a slow product gets more than usual, at most."""

KNOWN_BY = 9
"""From so many scenarios a pace is known."""

SLOW = 0.002
"""Seconds a step. Others take a tenth of it, or less."""


def waits(scenario: s.Scenario) -> float:
    """How many seconds ``scenario`` itself may have a host wait, at most, if each probe is held at a gate once."""
    waiting = 0
    milliseconds = 0
    threads = False
    for step in scenario.steps:
        threads = threads or step.thread is not None
        waiting += step.waits
        milliseconds += duration(step)[1] * (COMPUTED if isinstance(step, s.Stress) else 1)
    for declaration in scenario.components.values():
        for actions in declaration.plan.values():
            waiting += sum(isinstance(action, s.HoldAtGate) for action in actions)
    farewell = max(scenario.patience, 1000 * FAREWELL) if threads else 0
    return (waiting * scenario.patience + farewell + milliseconds) / 1000


def lasts(scenario: s.Scenario) -> int:
    """How many milliseconds ``scenario`` takes at least."""
    return sum(duration(step)[0] for step in scenario.steps)


class Pace:
    """The pace of one product: that of the last scenarios which do not wait.

    ``seconds_a_step``: the median; 0 until it is known.
    """

    def __init__(self) -> None:
        self.seconds_a_step = 0.0
        self._last: deque[float] = deque(maxlen=KNOWN_BY)

    def note(self, scenario: s.Scenario, trace: Trace, at_most: float) -> None:
        """``scenario`` took as long as ``trace`` says, and ``at_most`` so many seconds. Nothing is learnt of one that waits."""
        if not trace or waits(scenario) > 0:
            return
        self._last.append(min((trace[-1].t - trace[0].t) / 1e9, at_most) / max(len(scenario.steps), 1))
        if self.is_known:
            self.seconds_a_step = statistics.median(tuple(self._last))

    @property
    def is_known(self) -> bool:
        """Have there been enough scenarios?"""
        return len(self._last) == KNOWN_BY

    @property
    def is_slow(self) -> bool:
        """Does the product take much longer than others?"""
        return self.seconds_a_step > SLOW

    def more_for(self, steps: int) -> float:
        """How many seconds more than usual a scenario of so many ``steps`` may take."""
        return max(SECONDS_A_STEP * max(0, steps - LONG), min(MOST_MORE, LONGER * self.seconds_a_step * steps))
