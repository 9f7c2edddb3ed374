"""What a probe receives: values of UCM types and connections, copied before any other code can change them."""

from __future__ import annotations

import contextlib
import itertools
import re
import reprlib
from collections.abc import Iterable, Sequence
from typing import Any, TypeVar

from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.programming_model import PortConnection, PortElementObject
from ucm_cts.adapters.contract.trace import MOST

T = TypeVar("T")


class TooMany(ValueError):
    """More than an event may hold."""


def at_most(values: Iterable[T]) -> tuple[T, ...]:
    """``values``, which may come without end. Raises ``TooMany``, and ``TypeError`` if they are no iterable."""
    taken = tuple(itertools.islice(values, MOST + 1))
    if len(taken) > MOST:
        raise TooMany(f"more than {MOST}")
    return taken


_SHOWN = reprlib.Repr()
_SHOWN.maxstring, _SHOWN.maxother = 80, 160
_SHOWN.maxlist = _SHOWN.maxtuple = _SHOWN.maxdict = 8


def shown(value: object) -> str:
    """``value`` for a message, shortened; never raises."""
    try:
        return _SHOWN.repr(value)
    except BaseException:  # noqa: BLE001 - the object is the framework's
        return f"a {type(value).__name__} that cannot be shown"


_ADDRESS = re.compile(" at 0x[0-9a-f]+")
_LONGEST = 200
"""The most characters of a value that are shown."""


def is_datum(value: object) -> bool:
    """Can it stand for a value of a UCM type?"""
    if isinstance(value, list | tuple):
        return all(map(is_datum, value))
    return isinstance(value, bool | int | str)


def in_words(value: object) -> str:
    """``value`` and its type, for people."""
    text = _ADDRESS.sub("", shown(value))[:_LONGEST].encode("utf-8", "replace").decode()
    return f"{text} ({type(value).__name__})" if value is not None else "nothing"


def snapshot(values: Sequence[Any]) -> tuple[Datum, ...]:
    """``values`` as they are now, in lists of their own."""
    return tuple(_copy(value) for value in values)


def overwrite(values: list[Datum]) -> None:
    """Put something else in every place of ``values``, as the owner of a buffer may."""
    for index, value in enumerate(values):
        if isinstance(value, list):
            overwrite(value)
            value.append(0)
        elif isinstance(value, bool):
            values[index] = not value
        elif isinstance(value, int):
            values[index] = int(value == 0)
        elif isinstance(value, str):
            values[index] = value + "?"


def overwrite_parts(results: Sequence[Any]) -> None:
    """Overwrite the lists among ``results``: a caller may do so with what it was given. Those that cannot be changed stay."""
    with contextlib.suppress(Exception):  # the lists are the framework's
        for value in results:
            if isinstance(value, list):
                overwrite(value)


def _copy(value: Any) -> Datum:
    return [_copy(one) for one in value] if isinstance(value, list | tuple) else value


Given = list[tuple[str, tuple[PortElementObject | None, ...]]]


def read_connections(dependencies: Sequence[PortConnection]) -> tuple[Given, str]:
    """The names and references that on_startup was given, and what of it is of a wrong type."""
    given: Given = []
    try:
        for connection in at_most(dependencies):
            name = connection.from_port
            if not isinstance(name, str):
                return [], f"{in_words(name)} as the name of a port element"
            try:
                given.append((str.__str__(name), at_most(connection.to_port)))
            except TooMany as many:
                return [], f"{many} references of {name}"
            except TypeError:
                return [], f"{in_words(connection.to_port)} as the references of {name}"
    except TooMany as many:
        return [], f"{many} connections"
    except Exception:  # noqa: BLE001 - the object is the framework's
        return [], f"{in_words(dependencies)} as its connections"
    return given, ""


def named(port: object) -> dict[str, Any]:
    """The name of a port element as ``enter`` records it."""
    return {"port": str.__str__(port)} if isinstance(port, str) else {"wrong": in_words(port)}
