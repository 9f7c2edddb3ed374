"""Suites without a guarantee, to compare with: random walks, and hypothesis' rule-based state machine."""

from __future__ import annotations

import random
from typing import Any

from hypothesis import HealthCheck, Phase, seed, settings
from hypothesis.stateful import RuleBasedStateMachine, precondition, rule, run_state_machine_as_test

from ucm_cts.harness.purposes.systematic.machine import Machine, Word
from ucm_cts.harness.purposes.systematic.suites import Suite

STEPS = 50
"""The most steps of one of hypothesis' examples: its own default."""


def random_walks(machine: Machine, inputs: int, drawn: int, longest: int = 1000) -> Suite:
    """Words of ``inputs`` inputs in all, each input drawn from those defined; after ``longest``, or where nothing more can
    be asked, a new word begins.
    """
    draw = random.Random(drawn)
    words: list[Word] = []
    while inputs:
        word: list[int] = []
        state = 0
        while inputs and len(word) < longest and machine.moves[state]:
            asked = draw.choice(tuple(machine.moves[state]))
            word.append(asked)
            state = machine.moves[state][asked].next
            inputs -= 1
        words.append(tuple(word))
    return tuple(words)


def hypothesis_walks(machine: Machine, inputs: int, drawn: int) -> Suite:
    """The words that hypothesis' rule-based state machine takes, with one rule an input, until there are ``inputs`` in all."""
    words: list[Word] = []
    taken = 0
    while taken < inputs:
        walker = _walker(machine, words)
        examples = max(1, (inputs - taken) // STEPS)
        quiet = settings(
            max_examples=examples,
            stateful_step_count=STEPS,
            database=None,
            deadline=None,
            phases=(Phase.generate,),
            suppress_health_check=tuple(HealthCheck),
            print_blob=False,
        )
        seed(drawn + len(words))(walker)
        run_state_machine_as_test(walker, settings=quiet)
        taken = sum(map(len, words))
    return tuple(_cut(words, inputs))


def _cut(words: list[Word], inputs: int) -> list[Word]:
    kept: list[Word] = []
    for word in words:
        if inputs and word:
            kept.append(word[:inputs])
            inputs -= len(kept[-1])
    return kept


def _walker(machine: Machine, words: list[Word]) -> Any:
    """A state machine class that records its inputs."""

    def begin(self: Any) -> None:
        RuleBasedStateMachine.__init__(self)
        self.state, self.word = 0, []

    def end(self: Any) -> None:
        words.append(tuple(self.word))

    def take(asked: int) -> Any:
        def step(self: Any) -> None:
            self.word.append(asked)
            self.state = machine.moves[self.state][asked].next
            if self.state in machine.final:
                end(self)
                self.state, self.word = 0, []

        step.__name__ = f"input_{asked}"
        return precondition(lambda self: asked in machine.moves[self.state])(rule()(step))

    members = {f"input_{asked}": take(asked) for asked in range(len(machine.inputs))}
    return type("Walker", (RuleBasedStateMachine,), {"__init__": begin, "teardown": end, **members})
