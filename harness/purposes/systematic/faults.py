"""Wrong implementations of a machine, and the check whether a suite detects them.

The fault model is the usual one: output faults, transfer faults, missing states and extra states. An implementation is a
deterministic machine that shows one observation for each input; one that is right shows what is usual. Asked for what the
model leaves open, it does as it does in the first state in which the model knows the input, and stays where it is.
"""

from __future__ import annotations

import itertools
import random
from collections import defaultdict, deque
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import get_args

from ucm_cts.adapters.contract.trace import DeclaredError
from ucm_cts.harness.purposes.systematic.machine import LISTS, Machine, Observation, Word

Where = tuple[int, int]
"""A state of the implementation, and an input."""


@dataclass(frozen=True)
class Fault:
    """The differences from the right implementation: ``changes`` gives, for states and inputs, where they lead and what is
    seen. State ``n`` + i, with n those of the model, is an extra one: a twin of model state ``twins[i]`` but for changes.
    """

    kind: str
    changes: Mapping[Where, tuple[int, Observation]]
    twins: tuple[int, ...] = ()


@dataclass(frozen=True, eq=False)
class Subject:
    """A machine, and the words that its wrong implementations are run on."""

    machine: Machine
    _usual: dict[Where, tuple[int, Observation]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for state, moves in enumerate(self.machine.moves):
            for given, move in moves.items():
                self._usual[state, given] = move.next, self.machine.outputs[move.output].observations[0]

    @cached_property
    def anywhere(self) -> dict[int, Observation]:
        """The output of an input in the first state that has it."""
        shown: dict[int, Observation] = {}
        for (_, given), (_, seen) in self._usual.items():
            shown.setdefault(given, seen)
        return shown

    def react(self, fault: Fault, state: int, given: int) -> tuple[int, Observation]:
        """What the implementation with ``fault`` does in its ``state``, and where it is then."""
        changed = fault.changes.get((state, given))
        if changed is not None:
            return changed
        known = len(self.machine.moves)
        usual = self._usual.get((fault.twins[state - known] if state >= known else state, given))
        return usual if usual is not None else (state, self.anywhere[given])

    def killed_at(self, fault: Fault, word: Word) -> int:
        """After how many inputs of ``word`` something is seen that is not permitted; 0 if nothing is."""
        state = 0
        for length, (_, given, move) in enumerate(self.machine.path(word), 1):
            state, seen = self.react(fault, state, given)
            if not self.machine.outputs[move.output].permits(seen):
                return length
        return 0

    def is_wrong(self, fault: Fault) -> bool:
        """Is there any word at all that finds it out? All pairs of states are searched."""
        seen_pairs = {(0, 0)}
        queue = deque(seen_pairs)
        while queue:
            right, wrong = queue.popleft()
            for given, move in self.machine.moves[right].items():
                after, seen = self.react(fault, wrong, given)
                if not self.machine.outputs[move.output].permits(seen):
                    return True
                if (move.next, after) not in seen_pairs:
                    seen_pairs.add((move.next, after))
                    queue.append((move.next, after))
        return False

    def output_faults(self) -> Iterator[Fault]:
        """Every transition with every wrong observation: those of other transitions, other answers, callbacks lost, doubled
        or added.
        """
        for (state, given), (after, _) in self._usual.items():
            for seen in self.wrong(state, given):
                yield Fault("output", {(state, given): (after, seen)})

    def wrong(self, state: int, given: int) -> Iterator[Observation]:
        """The wrong observations of one transition."""
        permitted = self.machine.outputs[self.machine.moves[state][given].output]
        usual = self._usual[state, given][1]
        returns = LISTS if usual.answer.startswith(LISTS) else "return"
        for seen in dict.fromkeys((*self._alphabet, *_altered(usual))):
            if not permitted.permits(seen) and seen.answer.split()[0] in (returns, *get_args(DeclaredError)):
                yield seen

    @cached_property
    def _alphabet(self) -> tuple[Observation, ...]:
        return tuple(dict.fromkeys(seen for _, seen in self._usual.values()))

    def transfer_faults(self) -> Iterator[Fault]:
        """Every transition with every other state to lead to."""
        for (state, given), (after, seen) in self._usual.items():
            if after not in self.machine.final:
                for other in self._lively:
                    if other != after:
                        yield Fault("transfer", {(state, given): (other, seen)})

    @cached_property
    def _lively(self) -> tuple[int, ...]:
        return tuple(s for s in range(len(self.machine.moves)) if s not in self.machine.final)

    def missing_states(self) -> Iterator[Fault]:
        """Every state but the initial one with every other one in its place."""
        for gone, instead in itertools.permutations(self._lively, 2):
            if gone != 0:
                into = {w: (instead, seen) for w, (after, seen) in self._usual.items() if after == gone}
                yield Fault("missing state", into)

    def extra_states(self, extra: int) -> Iterator[Fault]:
        """Chains of up to ``extra`` twins: a transition leads to a twin of the state it should, then, by each input, to a
        twin of the next one; the last twin has one output or transfer fault. Twins keep what stays, or leave by it.
        """
        for entry, (after, seen) in self._usual.items():
            if after in self.machine.final:
                continue
            for length in range(1, extra + 1):
                for keeps in (True, False):
                    yield from self._chains({}, entry, seen, (after,), length, keeps)

    def _chains(
        self,
        changes: dict[Where, tuple[int, Observation]],
        entry: Where,
        seen: Observation,
        twins: tuple[int, ...],
        length: int,
        keeps: bool,
    ) -> Iterator[Fault]:
        known = len(self.machine.moves)
        number, model = known + len(twins) - 1, twins[-1]
        changes = {**changes, entry: (number, seen)}
        if keeps:
            for given, move in self.machine.moves[model].items():
                if move.next == model:
                    changes[number, given] = number, self._usual[model, given][1]
        for given in self.machine.moves[model]:
            after, usual = self._usual[model, given]
            if len(twins) < length:
                if after not in self.machine.final:
                    yield from self._chains(changes, (number, given), usual, (*twins, after), length, keeps)
                continue
            for wrong in itertools.islice(self.wrong(model, given), 2):
                yield Fault("extra state", {**changes, (number, given): (after, wrong)}, twins)
            for other in self._lively if after not in self.machine.final else ():
                if other != after:
                    yield Fault("extra state", {**changes, (number, given): (other, usual)}, twins)

    def drawn(self, kind: str, draw: random.Random) -> Fault:
        """One output or transfer fault, drawn: first the transition, then the fault."""
        while True:
            (state, given), (after, seen) = draw.choice(self._transitions)
            if kind == "output":
                return Fault(kind, {(state, given): (after, draw.choice(tuple(self.wrong(state, given))))})
            if after not in self.machine.final:
                other = draw.choice([lively for lively in self._lively if lively != after])
                return Fault(kind, {(state, given): (other, seen)})

    @cached_property
    def _transitions(self) -> tuple[tuple[Where, tuple[int, Observation]], ...]:
        return tuple(self._usual.items())

    def two_faults(self, amount: int, seed: int) -> Iterator[Fault]:
        """So many machines with two output or transfer faults at different transitions, drawn."""
        draw = random.Random(seed)
        while amount:
            one, other = (self.drawn(draw.choice(("output", "transfer")), draw) for _ in range(2))
            if one.changes.keys() != other.changes.keys():
                yield Fault("two faults", {**one.changes, **other.changes})
                amount -= 1


class Tried:
    """A suite, and which of its words take which transition of the model: only these can show a fault there."""

    def __init__(self, subject: Subject, suite: Iterable[Word]) -> None:
        self.subject = subject
        self.suite = tuple(suite)
        taking: defaultdict[Where, dict[Word, None]] = defaultdict(dict)
        for word in self.suite:
            for state, given, _ in subject.machine.path(word):
                taking[state, given][word] = None
        self.taking: Mapping[Where, Mapping[Word, None]] = taking

    @property
    def covered(self) -> tuple[int, int]:
        """How many states and transitions of the model are visited."""
        states = {0} | {self.subject.machine.moves[s][a].next for s, a in self.taking}
        return len(states), len(self.taking)

    def kills(self, fault: Fault) -> Word | None:
        """A word that finds ``fault`` out; None if there is none. Until a changed transition of the model is taken, the
        implementation is where the model is, so that no other words need to be tried.
        """
        for where in fault.changes:
            for word in self.taking.get(where, ()):
                if self.subject.killed_at(fault, word):
                    return word
        return None


def _altered(usual: Observation) -> Iterator[Observation]:
    for answer in ("return", "NOT_FOUND", "BAD_PARAMETER", "UCM_ERROR"):
        yield Observation(answer, usual.callbacks)
    for index, (name, hooks) in enumerate(usual.callbacks):
        before, after = usual.callbacks[:index], usual.callbacks[index + 1 :]
        yield Observation(usual.answer, before + after)
        for at, hook in enumerate(hooks):
            fewer = (*hooks[:at], *hooks[at + 1 :])
            if fewer:
                yield Observation(usual.answer, (*before, (name, fewer), *after))
            yield Observation(usual.answer, (*before, (name, (*hooks[:at], hook, *hooks[at:])), *after))
