"""Test suites with a guarantee: W (Chow), Wp (Fujiwara et al.) and HSI (Petrenko et al.), for k extra states; tours.

A suite is a set of words, each to be given to a fresh implementation. With those of ``w``, ``wp`` and ``hsi`` every
implementation that is a deterministic machine of at most k states more than the model, and that does something that is
not permitted, does so while it takes the suite.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator, Sequence

from ucm_cts.harness.purposes.systematic.identification import (
    characterisation_set,
    harmonised_identifiers,
    without_beginnings,
)
from ucm_cts.harness.purposes.systematic.machine import Machine, Word

Suite = tuple[Word, ...]

Method = Callable[[Machine, int], Suite]


def hsi(machine: Machine, extra: int) -> Suite:
    """After each state, and after all words of up to ``extra`` + 1 inputs more, the identifiers of the state reached."""
    identifiers = harmonised_identifiers(machine)
    return without_beginnings(
        (*word, *end) for word, state in _traversed(machine, extra + 1) for end in identifiers[state] or ((),)
    )


def w(machine: Machine, extra: int) -> Suite:
    """The same with the characterisation set in place of identifiers."""
    ends = characterisation_set(machine)
    return without_beginnings(
        (*word, *_defined(machine, state, end)) for word, state in _traversed(machine, extra + 1) for end in (*ends, ())
    )


def wp(machine: Machine, extra: int) -> Suite:
    """The characterisation set after each state and ``extra`` inputs more, identifiers after one input more than that."""
    identifiers = harmonised_identifiers(machine)
    ends = characterisation_set(machine)

    def words() -> Iterator[Word]:
        for word, state in _traversed(machine, extra):
            yield from ((*word, *_defined(machine, state, end)) for end in ends)
        for word, state in _traversed(machine, extra + 1):
            yield from ((*word, *end) for end in identifiers[state] or ((),))

    return without_beginnings(words())


def transition_cover(machine: Machine) -> Suite:
    """Each transition once, without identifying the next state: a suite without a guarantee, for comparison."""
    return without_beginnings(word for word, _ in _traversed(machine, 1))


def tour(machine: Machine, longest: int = 400) -> Suite:
    """Words of at most ``longest`` inputs that take every transition: greedily, first those that stay in a state, then
    those that lead where most is left to be taken. It identifies no state.
    """
    staying = [[a for a, move in moves.items() if move.next == s] for s, moves in enumerate(machine.moves)]
    leaving = [[a for a, move in moves.items() if move.next != s] for s, moves in enumerate(machine.moves)]
    left = machine.transitions
    words: list[Word] = []
    while left:
        word: list[int] = []
        state = 0
        while left and len(word) < longest:
            if staying[state]:
                asked = staying[state].pop()
            elif leaving[state]:
                moves = machine.moves[state]
                asked = max(leaving[state], key=lambda a: len(leaving[moves[a].next]) + len(staying[moves[a].next]))
                leaving[state].remove(asked)
            else:
                way = _to_untaken(machine, staying, leaving, state)
                if way is None or len(word) + len(way) >= longest:
                    break
                word += way
                state = machine.after(way, state) or 0
                continue
            left -= 1
            word.append(asked)
            state = machine.moves[state][asked].next
        if not word:
            raise ValueError(f"no word of {longest} inputs reaches what is left")
        words.append(tuple(word))
    return tuple(words)


def _to_untaken(
    machine: Machine, staying: Sequence[list[int]], leaving: Sequence[list[int]], start: int
) -> Word | None:
    """A shortest way from ``start`` to a state in which something is left to be taken."""
    words: dict[int, Word] = {start: ()}
    queue = deque([start])
    while queue:
        state = queue.popleft()
        if staying[state] or leaving[state]:
            return words[state]
        for asked, move in machine.moves[state].items():
            if move.next not in words:
                words[move.next] = (*words[state], asked)
                queue.append(move.next)
    return None


def _traversed(machine: Machine, length: int) -> Iterator[tuple[Word, int]]:
    """The state cover followed by all words of up to ``length`` inputs, each with the state it leads to."""
    for state, word in enumerate(machine.cover):
        yield from _onward(machine, word, state, length)


def _onward(machine: Machine, word: Word, state: int, length: int) -> Iterator[tuple[Word, int]]:
    yield word, state
    if length:
        for asked, move in machine.moves[state].items():
            yield from _onward(machine, (*word, asked), move.next, length - 1)


def _defined(machine: Machine, state: int, word: Word) -> Word:
    """As much of ``word`` as is defined in ``state``."""
    for length, asked in enumerate(word):
        move = machine.moves[state].get(asked)
        if move is None:
            return word[:length]
        state = move.next
    return word
