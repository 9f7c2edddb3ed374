"""Draws the payloads of a scenario for a run, among them negative ones and the edges of the payload type.

The numbers in scripts only say which payloads are the same. The disguise makes random long numbers of them and keeps
their sign; the edges are too short, or too well known, to be distinguished from other numbers and are not replaced.
"""

from __future__ import annotations

import random
from collections.abc import Callable

import msgspec

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Action, Declaration, Scenario, Step

SMALLEST, LARGEST = -(2**31), 2**31 - 1

EDGES = (0, -1, -2, SMALLEST, LARGEST)
"""Payloads that are never disguised. A probe answers with the complement, so that 1 comes back for -2."""


class Payloads:
    """Deals payloads out, in an order drawn from ``seed``: every edge is dealt before any is dealt again."""

    def __init__(self, seed: int) -> None:
        self._random = random.Random(f"payloads of {seed}")
        self._deck: list[int] = []

    def deal(self, scenario: Scenario) -> Scenario:
        """``scenario`` with some payloads replaced; those that were the same, or distinct, still are."""
        plain = _payloads(scenario)
        if not plain:
            return scenario
        dealt = {value: value for value in plain}
        taken = {*plain, *(~value for value in plain if value in EDGES)}
        for value in plain:
            instead = self._instead_of(value)
            if value not in EDGES and instead not in taken:
                dealt[value] = instead
                taken |= {instead, ~instead}
        return with_payloads(scenario, dealt.__getitem__)

    def _instead_of(self, value: int) -> int:
        chance = self._random.randrange(4)
        if chance == 0:
            return value
        if chance == 1:
            return -10 - abs(value)
        if not self._deck:
            self._deck = self._random.sample(EDGES, len(EDGES))
        return self._deck.pop()


def with_payloads(scenario: Scenario, change: Callable[[int], int]) -> Scenario:
    """``scenario`` with each payload changed."""

    def action(one: Action) -> Action:
        if isinstance(one, s.CallPort | s.ReturnValue):
            return msgspec.structs.replace(one, value=change(one.value))
        if isinstance(one, s.CallMethod) and one.given is not None:
            return msgspec.structs.replace(one, given=change(one.given))
        return one

    def declaration(one: Declaration) -> Declaration:
        plan = {hook: tuple(map(action, actions)) for hook, actions in one.plan.items()}
        return msgspec.structs.replace(one, plan=plan)

    def step(one: Step) -> Step:
        return msgspec.structs.replace(one, value=change(one.value)) if isinstance(one, s.Invoke) else one

    return msgspec.structs.replace(
        scenario,
        components={name: declaration(one) for name, one in scenario.components.items()},
        steps=tuple(map(step, scenario.steps)),
    )


def _payloads(scenario: Scenario) -> list[int]:
    """The distinct payloads of ``scenario``, in the order they are met."""
    actions = (a for one in scenario.components.values() for planned in one.plan.values() for a in planned)
    carrying = [
        a.given if isinstance(a, s.CallMethod) else a.value
        for a in actions
        if isinstance(a, s.CallPort | s.ReturnValue | s.CallMethod)
    ]
    invoked = [one.value for one in scenario.steps if isinstance(one, s.Invoke)]
    return list(dict.fromkeys(value for value in (*carrying, *invoked) if value is not None))
