"""Finds out whether declarations lead back to themselves, in time linear in their number."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from graphlib import CycleError, TopologicalSorter
from typing import TypeVar

from ucm_cts.adapters.contract.metamodel.common import Named
from ucm_cts.adapters.contract.metamodel.names import Declared, Scope
from ucm_cts.adapters.reference.toolchain.checking import Complaint

Kind = TypeVar("Kind", bound=Named)


def declared_in(root: Scope, kind: type[Named]) -> Iterable[Declared]:
    """All that modules declare of exactly this ``kind``, wherever below ``root``."""
    return root.remembered("declared_in", lambda: _by_kind(root)).get(kind, ())


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


def circle(
    root: Scope, kinds: Iterable[type[Named]], leads_to: Callable[[Declared], Iterator[Declared]]
) -> list[Named]:
    """The elements of ``kinds`` of one circle in order, each leading to the next one and the last to the first; none if there is no circle."""
    starts = [declared for kind in kinds for declared in declared_in(root, kind)]
    if not _leads_back(starts, leads_to):
        return []
    known: dict[int, Named] = {}
    sorter: TopologicalSorter[int] = TopologicalSorter()
    for declared in starts:
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


def _leads_back(starts: Iterable[Declared], leads_to: Callable[[Declared], Iterator[Declared]]) -> bool:
    """Whether there is a circle at all; asking costs much less than finding it."""
    done: set[int] = set()
    for start in starts:
        if id(start.element) in done:
            continue
        open_: set[int] = {id(start.element)}
        path = [(id(start.element), leads_to(start))]
        while path:
            here, next_ones = path[-1]
            for one in next_ones:
                key = id(one.element)
                if key in open_:
                    return True
                if key not in done:
                    open_.add(key)
                    path.append((key, leads_to(one)))
                    break
            else:
                path.pop()
                open_.discard(here)
                done.add(here)
    return False


def circle_complaint(
    found: list[Named], leads: str, what: str = "", remedy: str = "break the circle"
) -> Iterator[Complaint]:
    """The complaint about a circle, if one was ``found``; ``leads`` is the verb between its members."""
    if found:
        yield found[0], f"{what}{f' {leads} '.join(one.name for one in (*found, found[0]))}; {remedy}"
