"""Words that distinguish states: separating words, the characterisation set W, harmonised state identifiers.

Two states are distinguished by a word that is defined in both and at some point permits different things in each: nothing
that is right after the one is right after the other. An implementation that does right in both is then, for certain, in
two different states of its own.
"""

from __future__ import annotations

import itertools
from collections import deque
from collections.abc import Iterable, Sequence

from ucm_cts.harness.purposes.systematic.machine import Machine, Move, Word

Pair = tuple[int, int]


class NotReduced(Exception):
    """States of the machine are indistinguishable: no suite can identify them. ``pairs`` are these states."""

    def __init__(self, machine: Machine, pairs: Sequence[Pair]) -> None:
        one, other = (" ".join(machine.inputs[i] for i in machine.cover[state]) for state in pairs[0])
        super().__init__(f"no word distinguishes the states after '{one}' and after '{other}'")
        self.pairs = tuple(pairs)


def reduced(machine: Machine) -> Machine:
    """The machine as far as its states can be distinguished: of two that cannot, no input is defined in the one in which
    fewer inputs are defined, so that it need not be identified. Transitions lead there as before.
    """
    while True:
        try:
            separating_words(machine)
        except NotReduced as problem:
            states = {state for pair in problem.pairs for state in pair} - {0}
            machine = _without(machine, min(states, key=lambda state: (len(machine.moves[state]), -state)))
        else:
            return machine


def _without(machine: Machine, last: int) -> Machine:
    """No input is defined in state ``last``. States that are reached no other way are left out."""
    numbers = {0: 0}
    moves: list[dict[int, Move]] = []
    waiting = deque([0])
    while waiting:
        state = waiting.popleft()
        moves.append({})
        for given, move in machine.moves[state].items() if state != last else ():
            if move.next not in numbers:
                numbers[move.next] = len(numbers)
                waiting.append(move.next)
            moves[-1][given] = Move(numbers[move.next], move.output)
    return Machine(machine.inputs, machine.outputs, tuple(moves))


def separating_words(machine: Machine) -> dict[Pair, Word]:
    """For each two states with inputs, a shortest word that distinguishes them. Raises ``NotReduced``."""
    states = [state for state in range(len(machine.moves)) if state not in machine.final]
    open_pairs = list(itertools.combinations(states, 2))
    words: dict[Pair, Word] = {}
    while open_pairs:
        found = {pair: word for pair in open_pairs if (word := _longer(machine, pair, words)) is not None}
        if not found:
            raise NotReduced(machine, open_pairs)
        words |= found
        open_pairs = [pair for pair in open_pairs if pair not in found]
    return words


def _longer(machine: Machine, pair: Pair, words: dict[Pair, Word]) -> Word | None:
    """A word for ``pair``: an input that distinguishes at once, or one that leads to two states that ``words`` distinguish."""
    moves, others = machine.moves[pair[0]], machine.moves[pair[1]]
    shared = [given for given in moves if given in others]
    for given in shared:
        if machine.exclusive[moves[given].output][others[given].output]:
            return (given,)
    for given in shared:
        one, other = moves[given].next, others[given].next
        rest = words.get((min(one, other), max(one, other)))
        if rest is not None:
            return (given, *rest)
    return None


def distinguishing_length(machine: Machine, pair: Pair, word: Word) -> int:
    """The number of inputs of ``word`` that distinguish the states; 0 if it does not."""
    one, other = pair
    for length, given in enumerate(word, 1):
        move, counterpart = machine.moves[one].get(given), machine.moves[other].get(given)
        if move is None or counterpart is None:
            return 0
        if machine.exclusive[move.output][counterpart.output]:
            return length
        one, other = move.next, counterpart.next
    return 0


def harmonised_identifiers(machine: Machine) -> tuple[tuple[Word, ...], ...]:
    """For each state words such that any two states share one, or the beginning of one, that distinguishes them.

    Few different words are used: the one that distinguishes most pairs is chosen first, then the next among the others.
    """
    shortest = separating_words(machine)
    single = {(given,) for moves in machine.moves for given in moves}
    candidates = sorted(single.union(shortest.values()), key=lambda word: (len(word), word))
    distinguishes = {
        word: {p: n for p in shortest if (n := distinguishing_length(machine, p, word))} for word in candidates
    }
    identifiers: list[set[Word]] = [set() for _ in machine.moves]
    open_pairs = set(shortest)
    while open_pairs:
        best = max(candidates, key=lambda word: len(open_pairs & distinguishes[word].keys()))
        for pair in open_pairs & distinguishes[best].keys():
            for state in pair:
                identifiers[state].add(best[: distinguishes[best][pair]])
        open_pairs -= distinguishes[best].keys()
    return tuple(map(without_beginnings, identifiers))


def characterisation_set(machine: Machine) -> tuple[Word, ...]:
    """W: words such that any two states are distinguished by one of them."""
    return without_beginnings(itertools.chain.from_iterable(harmonised_identifiers(machine)))


def without_beginnings(words: Iterable[Word]) -> tuple[Word, ...]:
    """Each of ``words`` that is not the beginning of another one, once, sorted."""
    ordered = sorted(set(words))
    pairs = itertools.zip_longest(ordered, ordered[1:])
    return tuple(word for word, after in pairs if after is None or after[: len(word)] != word)
