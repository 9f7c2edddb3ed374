"""Detects changes of the SDK: an adapter runs in the same process and can change it.

``Kept`` refuses, and ``Seal`` reports, replaced functions of classes, modules and objects, and state of the SDK that is set from
outside. Code that controls a process can in the end hide everything from them; a reading of the adapter's source finds that
(docs/honesty.md).
"""

from __future__ import annotations

import sys
from abc import ABCMeta
from collections.abc import Iterable, Mapping
from types import CodeType, FrameType, FunctionType, ModuleType
from typing import Any, NamedTuple, NoReturn

_refused: list[str] = []
"""Refused changes, until a seal has reported them."""


_OURS = __name__.removesuffix("seal")


def _refuse(owner: type, name: str) -> NoReturn:
    _refused.append(f"{owner.__module__}.{owner.__name__}.{name}")
    raise TypeError(f"{_refused[-1]} is a part of the SDK, which an adapter must not change")


def _is_ours(caller: FrameType) -> bool:
    name: str = caller.f_globals.get("__name__", "")
    return name.startswith(_OURS)


class KeptClass(ABCMeta):
    """Classes whose functions only the SDK sets: an adapter cannot replace them, not even for a moment."""

    def __setattr__(cls, name: str, value: object) -> None:
        if hasattr(cls, name) and not name.startswith("_abc_") and not _is_ours(sys._getframe(1)):
            _refuse(cls, name)
        super().__setattr__(name, value)


class Kept(metaclass=KeptClass):
    """Objects whose functions and slots only the SDK sets: an adapter cannot replace them, not even for a moment.

    What others set is checked as it is set, which takes longer; so this is for objects of which a scenario has one.
    """

    __slots__ = ()

    def __setattr__(self, name: str, value: object) -> None:
        if not _is_ours(sys._getframe(1)) and hasattr(type(self), name):
            _refuse(type(self), name)
        object.__setattr__(self, name, value)


class _Part(NamedTuple):
    where: Mapping[str, Any]
    owner: str
    name: str
    value: Any
    code: CodeType | None


class Seal(metaclass=KeptClass):
    """Remembers the functions and classes of ``modules`` as they are when it is made."""

    def __init__(self, modules: Iterable[ModuleType]) -> None:
        self._parts: list[_Part] = []
        self._names: dict[type, frozenset[str]] = {}
        for module in modules:
            self._remember(vars(module), module.__name__)
            for name, value in vars(module).items():
                if isinstance(value, type) and value.__module__ == module.__name__:
                    self._names[value] = frozenset(dir(value))
                    self._remember(vars(value), f"{module.__name__}.{name}")

    def broken(self, *objects: object) -> str | None:
        """What has been replaced, or was to be, by its name, also in ``objects`` of sealed classes; None if all is as it was."""
        if _refused:
            first = _refused[0]
            _refused.clear()
            return first
        for where, owner, name, value, code in self._parts:
            if (code and value.__code__ is not code) or where.get(name) is not value:
                return f"{owner}.{name}"
        for one in objects:
            kind = type(one)
            names = self._names.get(kind)
            if names is None:
                return f"an object that is now a {kind.__name__}"
            own = getattr(one, "__dict__", ())
            if not names.isdisjoint(own):
                return f"{kind.__module__}.{kind.__name__}.{min(names.intersection(own))}"
        return None

    def _remember(self, where: Mapping[str, Any], owner: str) -> None:
        for name, value in where.items():
            if isinstance(value, FunctionType):
                self._parts.append(_Part(where, owner, name, value, value.__code__))
            elif isinstance(value, type | property):
                self._parts.append(_Part(where, owner, name, value, None))
