"""Mutants and variants that differ from the reference framework in one method, each a function.

The type of its first parameter is the class whose method it changes (the container, a ``Link`` or a ``Proxy``). With requirements the function becomes a mutant that breaks them, without any a conformant variant.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping
from concurrent.futures import Future
from typing import Any, TypeVar, get_type_hints

from ucm_cts.adapters.contract.programming_model import UcmError
from ucm_cts.adapters.mutants.python.registry import CONTAINER, Base, breaks, variant_of
from ucm_cts.adapters.reference.python.framework import ContainerManager

T = TypeVar("T")

Own = Callable[..., Any]
"""What the class' own method does, bound to the object."""


class _Change:
    """Makes mutants and variants: ``instead`` is called with the function, the object, its own method and the arguments."""

    def __init__(self, instead: Callable[..., Any]) -> None:
        self.instead = instead

    def __call__(
        self,
        method: str,
        *requirements: str,
        also: tuple[str, ...] = (),
        clauses: tuple[str, ...] = CONTAINER,
        readings: Mapping[str, str] = {},
    ) -> Callable[[Callable[..., Any]], type]:
        def register(function: Callable[..., Any]) -> type:
            changed = next(iter(get_type_hints(function).values()))
            assert hasattr(ContainerManager if changed is Base else changed, method), (function.__name__, method)

            def altered(part: Any, *arguments: Any) -> Any:
                return self.instead(function, part, getattr(super(mixin, part), method), *arguments)

            mixin = type(function.__name__, (changed,), {method: altered, "__doc__": function.__doc__})
            if requirements:
                return breaks(*requirements, also=also, clauses=clauses, readings=readings)(mixin)
            return variant_of(*clauses, readings=readings)(mixin)

        return register


@_Change
def replaces(substitute: Callable[..., Any], part: object, _own: Own, *arguments: Any) -> Any:
    """The function is the method; as ``Base.method(self, ...)`` it can call the class' own."""
    return substitute(part, *arguments)


@_Change
def alters(change: Callable[..., Any], part: object, own: Own, *arguments: Any) -> Any:
    """The function makes another result of the object, the method's result and its arguments."""
    return change(part, own(*arguments), *arguments)


@_Change
def does_only_if(condition: Callable[..., bool], part: object, own: Own, *arguments: Any) -> None:
    """The method does something only if the function says so of the object and the arguments."""
    if condition(part, *arguments):
        own(*arguments)


@_Change
def refuses_if(condition: Callable[..., bool], part: object, own: Own, *arguments: Any) -> Any:
    """The method raises ``UCM_ERROR`` if the function says so of the object and the arguments."""
    if condition(part, *arguments):
        raise UcmError("refused")
    return own(*arguments)


def elsewhere(work: Callable[[], T]) -> Future[T]:
    """Have ``work`` done by a thread of its own."""
    outcome: Future[T] = Future()

    def do() -> None:
        try:
            outcome.set_result(work())
        except BaseException as error:  # noqa: BLE001 - the caller gets any exception
            outcome.set_exception(error)

    threading.Thread(target=do, daemon=True).start()
    return outcome
