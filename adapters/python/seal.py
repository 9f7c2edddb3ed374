"""Is the SDK still what it was? An adapter runs in the same process as the SDK and can change it.

This tells of functions that were replaced, in classes, modules or single objects. Who controls a process can in the end hide
everything from it; that is looked for in the adapter's source (docs/honesty.md).
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from types import FunctionType, ModuleType
from typing import Any, NamedTuple


class _Part(NamedTuple):
    where: Mapping[str, Any]
    owner: str
    name: str
    value: object
    code: object


class Seal:
    """Remembers the functions and classes of ``modules`` as they are when it is made."""

    def __init__(self, modules: Iterable[ModuleType]) -> None:
        self._parts: list[_Part] = []
        self._classes: set[type] = set()
        for module in modules:
            self._remember(vars(module), module.__name__)
            for name, value in vars(module).items():
                if isinstance(value, type) and value.__module__ == module.__name__:
                    self._classes.add(value)
                    self._remember(vars(value), f"{module.__name__}.{name}")

    def broken(self, *objects: object) -> str | None:
        """What has been replaced, by its name, also in ``objects`` of sealed classes; None if all is as it was."""
        for where, owner, name, value, code in self._parts:
            found = where.get(name)
            if found is not value or (isinstance(found, FunctionType) and found.__code__ is not code):
                return f"{owner}.{name}"
        for one in objects:
            kind = type(one)
            if kind not in self._classes:
                return f"an object that is now a {kind.__name__}"
            for name in vars(one).keys() & vars(kind).keys():
                return f"{kind.__module__}.{kind.__name__}.{name}"
        return None

    def _remember(self, where: Mapping[str, Any], owner: str) -> None:
        for name, value in where.items():
            if isinstance(value, FunctionType):
                self._parts.append(_Part(where, owner, name, value, value.__code__))
            elif isinstance(value, type | property):
                self._parts.append(_Part(where, owner, name, value, None))
