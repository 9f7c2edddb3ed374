"""A finite Mealy machine as a value: inputs, permitted outputs, and next states.

The machine is deterministic in its states and need not be so in its outputs: a transition permits a *set* of
observations, all of which lead to the same state. It is partial: an input that is not defined in a state is not given
there. States and inputs are numbers; state 0 is the initial one.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

Word = tuple[int, ...]
"""Inputs, one after the other."""


LISTS = "lists"
"""The first word of an output that returns a list; its items follow."""


class Observation(NamedTuple):
    """The output of one input: how the operation ended, and which instance got which callbacks meanwhile."""

    answer: str
    callbacks: tuple[tuple[str, tuple[str, ...]], ...] = ()


@dataclass(frozen=True)
class Permitted:
    """The observations that are right, the usual one first. ``lenient`` ones permit any UCM_ERROR beside."""

    observations: tuple[Observation, ...]
    lenient: bool = False

    def permits(self, seen: Observation) -> bool:
        """Is ``seen`` right?"""
        return seen in self.observations or (self.lenient and seen.answer == "UCM_ERROR")

    def excludes(self, other: Permitted) -> bool:
        """Is nothing right for both?"""
        return not any(map(other.permits, self.observations)) and not any(map(self.permits, other.observations))


class Move(NamedTuple):
    """A transition: its next state, and the number of its output."""

    next: int
    output: int


@dataclass(frozen=True, eq=False)
class Machine:
    """A finite Mealy machine.

    ``inputs``: by number.
    ``outputs``: by number.
    ``moves``: for each state, the transition of each defined input.
    """

    inputs: tuple[str, ...]
    outputs: tuple[Permitted, ...]
    moves: tuple[Mapping[int, Move], ...]

    @property
    def transitions(self) -> int:
        """How many inputs are defined, over all states."""
        return sum(map(len, self.moves))

    @cached_property
    def final(self) -> frozenset[int]:
        """States without inputs."""
        return frozenset(state for state, moves in enumerate(self.moves) if not moves)

    @cached_property
    def cover(self) -> tuple[Word, ...]:
        """For each state a shortest word that leads there from the initial one: the *state cover*."""
        words: dict[int, Word] = {0: ()}
        queue = deque([0])
        while queue:
            state = queue.popleft()
            for given, move in self.moves[state].items():
                if move.next not in words:
                    words[move.next] = (*words[state], given)
                    queue.append(move.next)
        return tuple(words[state] for state in range(len(self.moves)))

    def path(self, word: Sequence[int], state: int = 0) -> Iterator[tuple[int, int, Move]]:
        """The transitions that ``word`` takes from ``state``: where from, by which input, and how. Raises ``KeyError``
        for an input that is not defined.
        """
        for given in word:
            move = self.moves[state][given]
            yield state, given, move
            state = move.next

    def after(self, word: Sequence[int], state: int = 0) -> int | None:
        """Where ``word`` leads from ``state``; None if it is not defined there."""
        for given in word:
            move = self.moves[state].get(given)
            if move is None:
                return None
            state = move.next
        return state

    @cached_property
    def exclusive(self) -> tuple[tuple[bool, ...], ...]:
        """Of each two outputs: does one exclude the other?"""
        return tuple(tuple(one.excludes(other) for other in self.outputs) for one in self.outputs)
