"""Which declarations lead to which, over any number of steps: found out once for each, so that long chains cost no more than short ones."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from ucm_cts.adapters.contract.metamodel.names import Declared


class Reaching:
    """The marks of all declarations that one leads to.

    ``next_ones`` gives the declarations that one leads to directly, ``mark`` what is collected of each; empty for nothing.
    """

    def __init__(self, next_ones: Callable[[Declared], Iterable[Declared]], mark: Callable[[Declared], str]) -> None:
        self._next_ones = next_ones
        self._mark = mark
        self._known: dict[int, frozenset[str]] = {}

    def marks(self, start: Declared) -> frozenset[str]:
        """The marks of what ``start`` leads to; its own only if it leads back to itself."""
        waiting = [(start, False)]
        begun: set[int] = set()
        while waiting:
            one, ready = waiting.pop()
            if ready:
                self._known[id(one.element)] = self._beyond(one)
            elif id(one.element) not in self._known and id(one.element) not in begun:
                begun.add(id(one.element))
                waiting.append((one, True))
                waiting += [(next_one, False) for next_one in self._next_ones(one)]
        return self._known[id(start.element)]

    def _beyond(self, start: Declared) -> frozenset[str]:
        """The marks beyond ``start``; what it leads to is known, unless it stands in one circle with ``start``."""
        found: set[str] = set()
        met: set[int] = set()
        waiting = [*self._next_ones(start)]
        while waiting:
            one = waiting.pop()
            if id(one.element) in met:
                continue
            met.add(id(one.element))
            found.add(self._mark(one))
            known = self._known.get(id(one.element))
            if known is None:
                waiting += self._next_ones(one)
            else:
                found |= known
        return frozenset(found - {""})
