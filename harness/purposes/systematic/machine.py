"""A finite Mealy machine as a value: what is asked, what is permitted as an answer, and where that leads.

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
"""How an answer begins that returns a list; what is listed follows."""


class Observation(NamedTuple):
    """What is seen of one input: how the operation ended, and which instance heard which callbacks meanwhile."""

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
    """A transition: the state it leads to, and the number of what it permits."""

    next: int
    output: int


@dataclass(frozen=True, eq=False)
class Machine:
    """``moves`` tells, for each state, what each input that is defined there does; ``outputs`` are numbered."""

    inputs: tuple[str, ...]
    outputs: tuple[Permitted, ...]
    moves: tuple[Mapping[int, Move], ...]

    @property
    def transitions(self) -> int:
        """How many inputs are defined, over all states."""
        return sum(map(len, self.moves))

    @cached_property
    def final(self) -> frozenset[int]:
        """States in which nothing can be asked any more."""
        return frozenset(state for state, moves in enumerate(self.moves) if not moves)

    @cached_property
    def cover(self) -> tuple[Word, ...]:
        """For each state a shortest word that leads there from the initial one: the *state cover*."""
        words: dict[int, Word] = {0: ()}
        queue = deque([0])
        while queue:
            state = queue.popleft()
            for asked, move in self.moves[state].items():
                if move.next not in words:
                    words[move.next] = (*words[state], asked)
                    queue.append(move.next)
        return tuple(words[state] for state in range(len(self.moves)))

    def path(self, word: Sequence[int], state: int = 0) -> Iterator[tuple[int, int, Move]]:
        """The transitions that ``word`` takes from ``state``: where from, by which input, and how. Raises ``KeyError``
        for an input that is not defined.
        """
        for asked in word:
            move = self.moves[state][asked]
            yield state, asked, move
            state = move.next

    def after(self, word: Sequence[int], state: int = 0) -> int | None:
        """Where ``word`` leads from ``state``; None if it is not defined there."""
        for asked in word:
            move = self.moves[state].get(asked)
            if move is None:
                return None
            state = move.next
        return state

    @cached_property
    def exclusive(self) -> tuple[tuple[bool, ...], ...]:
        """Of each two outputs: does one exclude the other?"""
        return tuple(tuple(one.excludes(other) for other in self.outputs) for one in self.outputs)
