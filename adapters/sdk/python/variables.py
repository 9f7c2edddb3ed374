"""The variables of a scenario: steps bind them, later steps use them."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TypeVar

from ucm_cts.adapters.contract.adapter import ContainerHandle, LinkHandle
from ucm_cts.adapters.contract.programming_model import PortElementObject
from ucm_cts.adapters.contract.scenario import MANAGER, NIL, UNKNOWN
from ucm_cts.adapters.sdk.python.seal import KeptClass

T = TypeVar("T")
_LARGEST_ID = 2**31 - 1


class Unbound(Exception):
    """A step uses a variable that was never bound; ``variable`` names it."""

    def __init__(self, variable: str) -> None:
        super().__init__(variable)
        self.variable = variable


class Variables(metaclass=KeptClass):
    """The variables of one scenario. A name has one value at a time, of one kind; looking up raises ``Unbound``."""

    def __init__(self, manager: ContainerHandle) -> None:
        self._ids: dict[str, int] = {}
        self._references: dict[str, PortElementObject | None] = {}
        self._containers: dict[str, ContainerHandle] = {MANAGER: manager}
        self._links: dict[str, LinkHandle] = {}
        self._given: set[int] = set()

    def bind_id(self, name: str, value: int) -> None:
        """``name`` is a component or connection from now on."""
        self._given.add(value)
        self._bind(self._ids, name, value)

    def bind_reference(self, name: str, reference: PortElementObject | None) -> None:
        """``name`` is a reference, possibly null, from now on."""
        self._bind(self._references, name, reference)

    def bind_container(self, name: str, container: ContainerHandle) -> None:
        """``name`` is a container from now on."""
        self._bind(self._containers, name, container)

    def bind_link(self, name: str, link: LinkHandle) -> None:
        """``name`` is a connection with a connector from now on."""
        self._bind(self._links, name, link)

    def saw(self, ids: Iterable[int]) -> None:
        """The framework has given out these ids, so none of them can serve as unknown."""
        self._given.update(ids)

    def id(self, name: str) -> int:
        """The component or connection ``name``; ``unknown`` gives an integer the framework has not given out."""
        if name == UNKNOWN:
            return next(i for i in range(_LARGEST_ID, 0, -1) if i not in self._given)
        return _find(self._ids, name)

    def reference(self, name: str) -> PortElementObject | None:
        """The reference ``name``; ``nil`` gives the null reference."""
        return None if name == NIL else _find(self._references, name)

    def container(self, name: str) -> ContainerHandle:
        """The container ``name``; ``nil`` gives the null container."""
        return None if name == NIL else _find(self._containers, name)

    def link(self, name: str) -> LinkHandle:
        """The connection with a connector ``name``."""
        return _find(self._links, name)

    def _bind(self, values: dict[str, T], name: str, value: T) -> None:
        for known in (self._ids, self._references, self._containers, self._links):
            known.pop(name, None)
        values[name] = value


def _find(values: dict[str, T], name: str) -> T:
    if name not in values:
        raise Unbound(name)
    return values[name]
