"""Values of UCM types inside a probe: received values are copied before any other code can change them."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

from ucm_cts.adapters.contract.data_types import Datum

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
    try:
        text = _ADDRESS.sub("", repr(value))[:_LONGEST].encode("utf-8", "replace").decode()
    except Exception:  # noqa: BLE001 - the value is the framework's
        text = "a value"
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
        else:
            values[index] = value + "?"


def _copy(value: Any) -> Datum:
    return [_copy(one) for one in value] if isinstance(value, list | tuple) else value
