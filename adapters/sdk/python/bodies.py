"""What an adapter writes where a framework hosts bodies in its own way: first calls, connections, references, services."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.programming_model import (
    ComponentObject,
    ContainerInterface,
    FragmentObject,
    PortConnection,
    PortElementObject,
    UcmError,
)


def initialise(body: ComponentObject, attributes: Mapping[str, str], container: ContainerInterface) -> None:
    """What comes first for a body, in this order: its attributes, its container if it is a fragment, ``on_init``."""
    for name, value in attributes.items():
        body.set_attribute(name, value)
    if isinstance(body, FragmentObject):
        body.set_container_interface(container)
    body.on_init()


def port_connections(pairs: Iterable[tuple[str, PortElementObject | None]]) -> list[PortConnection]:
    """The dependencies of ``on_startup`` from pairs of a required port element and a reference: one for each name."""
    references: dict[str, list[PortElementObject | None]] = {}
    for port, reference in pairs:
        references.setdefault(port, []).append(reference)
    return [PortConnection(port, tuple(to)) for port, to in references.items()]


class Methods(PortElementObject):
    """A port element made of functions, by method name: a clock, a trace, the end of a connector.

    A function takes the values of the IN and INOUT parameters and returns the list of those of OUT, INOUT and RETURN.
    """

    def __init__(self, **functions: Callable[..., Sequence[Datum]]) -> None:
        self._functions = functions

    def exchange(self, value: int) -> int:
        raise UcmError("the port element has another interface")

    def call(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        if method not in self._functions:
            raise UcmError(f"the port element has no method {method!r}")
        return self._functions[method](*arguments)


class Wrapped(PortElementObject):
    """A framework's own reference ``own``, made by ``References``."""

    def __init__(self, references: References, own: Any) -> None:
        self._references, self.own = references, own

    def exchange(self, value: int) -> int:
        return self._references.exchange(self.own, value)

    def call(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        return self._references.call(self.own, method, arguments)


class References:
    """References of a framework that are no ``PortElementObject``, and back.

    ``exchange(own, value)`` and ``call(own, method, arguments)`` call through one.
    """

    def __init__(
        self,
        exchange: Callable[[Any, int], int],
        call: Callable[[Any, str, Sequence[Datum]], Sequence[Datum]] | None = None,
    ) -> None:
        self.exchange, self.call = exchange, call or _cannot_be_called

    def wrap(self, own: Any) -> PortElementObject | None:
        """``own`` with ``exchange`` and ``call``; a null reference stays one."""
        return None if own is None else Wrapped(self, own)

    @staticmethod
    def unwrap(reference: PortElementObject | None) -> Any:
        """The framework's own reference behind ``reference``, or ``reference`` itself if ``wrap`` did not make it."""
        return reference.own if isinstance(reference, Wrapped) else reference


def _cannot_be_called(own: Any, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
    raise UcmError(f"{method!r}: the framework's references have no typed calls")
