"""The entries of a record, in the order in which a campaign asks for them: what is missing, surplus or elsewhere does not hide the rest."""

from __future__ import annotations

from collections import Counter, deque
from collections.abc import Iterable, Iterator
from typing import NamedTuple

from ucm_cts.harness.execution import record as r

NEAR = 8
"""How many answers may stand before the expected one. They are set aside; if there are more, the expected answer is out of place."""


class Placed(NamedTuple):
    """An entry, and the time of the last event before it in the record."""

    entry: r.AnyEntry
    last: int


class Alignment:
    """Hands out ``entries``. ``bring`` brings the answer that is asked for to their beginning."""

    def __init__(self, entries: Iterable[r.AnyEntry]) -> None:
        self._left = deque(_placed(entries))
        self._ahead = Counter(one.entry.name for one in self._left if isinstance(one.entry, r.Answered))
        self._aside: dict[str, Placed] = {}

    @property
    def head(self) -> r.AnyEntry | None:
        """The next entry; None at the end."""
        return self._left[0].entry if self._left else None

    def pop(self) -> Placed:
        """Take the next entry."""
        taken = self._left.popleft()
        if isinstance(taken.entry, r.Answered):
            self._ahead[taken.entry.name] -= 1
        return taken

    @property
    def set_aside(self) -> tuple[str, ...]:
        """The names of the answers that nobody has asked for so far, although later ones were."""
        return tuple(self._aside)

    def has(self, name: str) -> bool:
        """Is the answer to ``name`` still to come, or set aside?"""
        return self._ahead[name] > 0 or name in self._aside

    @property
    def has_answers(self) -> bool:
        """Is any answer still to come?"""
        return self._ahead.total() > 0

    def bring(self, name: str) -> bool:
        """Bring the answer to ``name``, which the record has, to the beginning. Did it stand where it is due?"""
        if self._is_next(name):
            return True
        if name in self._aside:
            self._put_back(self._aside.pop(name))
            return False
        before = []
        while not self._is_next(name):
            before.append(self.pop())
        answers = [one for one in before if isinstance(one.entry, r.Answered)]
        if len(answers) <= NEAR:  # what followed them goes with them
            self._aside.update((one.entry.name, one) for one in answers if isinstance(one.entry, r.Answered))
            return True
        wanted = self.pop()
        self._put_back(*before)
        self._put_back(wanted)
        return False

    def take_second_look(self, name: str) -> Placed | None:
        """Take the next second look at ``name``, wherever it is; None if there is none."""
        for place, one in enumerate(self._left):
            if isinstance(one.entry, r.Repeated) and one.entry.name == name:
                del self._left[place]
                return one
        return None

    def _is_next(self, name: str) -> bool:
        return isinstance(self.head, r.Answered) and self.head.name == name

    def _put_back(self, *those: Placed) -> None:
        self._left.extendleft(reversed(those))
        self._ahead.update(one.entry.name for one in those if isinstance(one.entry, r.Answered))


def _placed(entries: Iterable[r.AnyEntry]) -> Iterator[Placed]:
    last = 0
    for entry in entries:
        yield Placed(entry, last)
        if isinstance(entry, r.Performed):
            last += sum(entry.times)
