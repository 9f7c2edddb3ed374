"""Mutants whose one defect is in one method of the container, each a function: what the method returns instead, or when it
does nothing, or when it refuses.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from ucm_cts.adapters.contract.programming_model import UcmError
from ucm_cts.adapters.mutants.python.registry import CONTAINER, Base, breaks

Own = Callable[..., Any]
"""What the container's own method does, bound to the container."""


class _Defect:
    """Makes mutants: ``instead`` is called with the function, the container, its own method and the arguments."""

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
            def wrong(container: Base, *arguments: Any) -> Any:
                return self.instead(function, container, getattr(super(mixin, container), method), *arguments)

            mixin = type(function.__name__, (Base,), {method: wrong, "__doc__": function.__doc__})
            return breaks(*requirements, also=also, clauses=clauses, readings=readings)(mixin)

        return register


@_Defect
def alters(change: Callable[..., Any], container: Base, own: Own, *arguments: Any) -> Any:
    """The function makes another result of the container, the method's result and its arguments."""
    return change(container, own(*arguments), *arguments)


@_Defect
def does_only_if(condition: Callable[..., bool], container: Base, own: Own, *arguments: Any) -> None:
    """The method does something only if the function says so of the container and the arguments."""
    if condition(container, *arguments):
        own(*arguments)


@_Defect
def refuses_if(condition: Callable[..., bool], container: Base, own: Own, *arguments: Any) -> Any:
    """The method raises ``UCM_ERROR`` if the function says so of the container and the arguments."""
    if condition(container, *arguments):
        raise UcmError("refused")
    return own(*arguments)
