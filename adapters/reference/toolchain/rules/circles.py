"""Finds out whether declarations lead back to themselves, in time linear in their number."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from graphlib import CycleError, TopologicalSorter
from typing import TypeVar

from ucm_cts.adapters.contract.metamodel.common import Named
from ucm_cts.adapters.contract.metamodel.names import Declared, Scope

Kind = TypeVar("Kind", bound=Named)


def declared_in(root: Scope, kind: type[Named]) -> Iterator[Declared]:
    """All that modules declare of exactly this ``kind``, wherever below ``root``."""
    yield from root.remembered("declared_in", lambda: _by_kind(root)).get(kind, ())


def _by_kind(root: Scope) -> dict[type[Named], list[Declared]]:
    found: dict[type[Named], list[Declared]] = {}
    waiting = [root]
    while waiting:
        scope = waiting.pop()
        for same_name in scope.members.values():
            for declared in same_name:
                found.setdefault(type(declared.element), []).append(declared)
        for modules in scope.modules.values():
            waiting.extend(modules)
    return found


def has_circle(starts: Iterable[Declared], leads_to: Callable[[Declared], Iterable[Declared]]) -> bool:
    """Whether any of ``starts`` leads to itself, or to something that does."""
    done: set[int] = set()
    for start in starts:
        if id(start.element) in done:
            continue
        open_ones = {id(start.element)}
        way = [(id(start.element), iter(leads_to(start)))]
        while way:
            identity, following = way[-1]
            found = next(following, None)
            if found is None:
                way.pop()
                open_ones.discard(identity)
                done.add(identity)
            elif id(found.element) in open_ones:
                return True
            elif id(found.element) not in done:
                open_ones.add(id(found.element))
                way.append((id(found.element), iter(leads_to(found))))
    return False


def circle(root: Scope, kind: type[Named], leads_to: Callable[[Declared], Iterator[Declared]]) -> list[Named]:
    """The elements of one circle in order, each leading to the next one and the last to the first; none if there is no circle."""
    known: dict[int, Named] = {}
    sorter: TopologicalSorter[int] = TopologicalSorter()
    for declared in declared_in(root, kind):
        for next_one in leads_to(declared):
            known[id(declared.element)] = declared.element
            known[id(next_one.element)] = next_one.element
            sorter.add(id(declared.element), id(next_one.element))
    try:
        sorter.prepare()
    except CycleError as error:
        backwards: list[int] = error.args[1]
        return [known[one] for one in reversed(backwards[1:])]
    return []
