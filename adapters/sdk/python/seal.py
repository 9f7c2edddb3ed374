"""Detects changes of the SDK: an adapter runs in the same process and can change it.

``Kept`` refuses, and ``Seal`` reports, what is replaced in the modules of the SDK, in their classes, functions and tables, in
what they use of other modules and of the builtins, and state of the SDK that is set from outside. Code that controls a process
can in the end hide everything from them; a reading of the adapter's source finds that (docs/honesty.md).
"""

from __future__ import annotations

import sys
from abc import ABCMeta
from collections.abc import Callable, Iterable, Iterator, Mapping
from operator import attrgetter, is_
from types import CodeType, FrameType, FunctionType, ModuleType
from typing import Any, NamedTuple, NoReturn, Self

from ucm_cts.adapters.sdk.python.reach import Names, Reach, new_name

_refused: list[str] = []
"""Refused changes, until a seal has reported them."""

_OURS = __name__.removesuffix("seal")
_codes: set[CodeType] = set()
"""The code of all sealed modules: only this sets what is kept."""


def _refuse(owner: type, name: str) -> NoReturn:
    _refused.append(f"{owner.__module__}.{owner.__name__}.{name}")
    raise TypeError(f"{_refused[-1]} is a part of the SDK, which an adapter must not change")


def _is_ours(caller: FrameType) -> bool:
    name: str = caller.f_globals.get("__name__", "")
    return name.startswith(_OURS) and (not _codes or caller.f_code in _codes)


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


class _Trait(NamedTuple):
    """What ``read`` gave of ``functions``, whose names are ``owners``."""

    read: Callable[[Any], Any]
    functions: tuple[FunctionType, ...]
    values: tuple[Any, ...]
    owners: tuple[str, ...]


class Seal(metaclass=KeptClass):
    """Remembers modules as they are: all names in them and in their classes and tables, the code and defaults of functions, and
    what these use of other modules and of the builtins. Another seal can be among what it remembers.
    """

    def __init__(self) -> None:
        self._names: dict[type, frozenset[str]] = {}
        self._tables: tuple[Names, ...] = ()
        self._functions: tuple[FunctionType, ...] = ()
        self._traits: tuple[_Trait, ...] = ()
        self._cells: tuple[tuple[str, Any, Any], ...] = ()
        self._lineages: tuple[tuple[type, tuple[type, ...]], ...] = ()
        self._tracing: tuple[str, ...] | None = None
        self._known_codes: int | None = None

    def remember(self, modules: Iterable[ModuleType], keeps: bool = False) -> Self:
        """Seals ``modules``. ``keeps``: from now on only their code sets what is kept, whatever other code calls itself."""
        reach = Reach()
        kinds = [kind for module in modules for kind in reach.module(module)]
        self._names = {kind: frozenset(dir(kind)) for kind in kinds}
        self._lineages = tuple((kind, kind.__mro__) for kind in kinds)
        self._functions = tuple(reach.functions.values())
        self._traits = tuple(_traits(reach.functions))
        self._cells = tuple((owner, cell, cell.cell_contents) for owner, cell in reach.cells())
        self._tracing = _tracing() if _is_host() else None
        if keeps:
            _codes.update(self._all_codes())
            self._known_codes = len(_codes)
        for name, value in reach.values.items():
            if isinstance(value, Seal) and value is not self:
                reach.remember(name, vars(value))
        self._tables = reach.tables()
        return self

    def _all_codes(self) -> Iterator[CodeType]:
        """The code of all its functions, and of functions in them."""
        waiting = [function.__code__ for function in self._functions]
        while waiting:
            code = waiting.pop()
            yield code
            waiting.extend(one for one in code.co_consts if isinstance(one, CodeType))

    def broken(self, *objects: object) -> str | None:
        """What has been replaced, or was to be, by its name, also in ``objects`` of sealed classes; None if all is as it was."""
        if _refused:
            first = _refused[0]
            _refused.clear()
            return first
        if self._known_codes is not None and _len(_codes) != self._known_codes:
            return f"{_OURS}seal._codes"
        for owner, where, names, values, whole in self._tables:
            if not _all(_map(_is, _map(where.get, names), values)):
                return f"{owner}.{_first_other(names, map(where.get, names), values)}"
            if whole >= 0 and _len(where) != whole and (new := new_name(where, names)):
                return f"{owner}.{new}"
        for read, functions, values, owners in self._traits:
            if not _all(_map(_is, _map(read, functions), values)):
                return _first_other(owners, map(read, functions), values)
        for owner, cell, value in self._cells:
            if cell.cell_contents is not value:
                return owner
        for kind, lineage in self._lineages:
            if _len(kind.__mro__) != _len(lineage) or not _all(_map(_is, kind.__mro__, lineage)):
                return f"{kind.__module__}.{kind.__name__}.__bases__"
        if self._tracing is not None and (traced := _tracing()) != self._tracing:
            return next(
                (now for before, now in zip(self._tracing, traced, strict=True) if now != before), "sys.settrace"
            )
        return self._broken_object(objects)

    def _broken_object(self, objects: tuple[object, ...]) -> str | None:
        for one in objects:
            kind = _type(one)
            names = self._names.get(kind)
            if names is None:
                return f"an object that is now a {kind.__name__}"
            own = _getattr(one, "__dict__", ())
            if not names.isdisjoint(own):
                return f"{kind.__module__}.{kind.__name__}.{min(names.intersection(own))}"
        return None


def replaces(part: str) -> str:
    """The reason for which there is no trace, if ``part`` is not what it was."""
    if part.startswith("ucm_cts."):
        return f"the adapter replaces a part of the SDK: {part}"
    return (
        f"the adapter replaces a part of the SDK: {part}, which the SDK uses; let the adapter, or what it loads, leave it as it "
        "is, or run the framework in a process of its own"
    )


def _traits(named: Mapping[str, FunctionType]) -> Iterator[_Trait]:
    for trait in ("__code__", "__defaults__", "__kwdefaults__"):
        read = attrgetter(trait)
        functions = {name: function for name, function in named.items() if read(function) is not None}
        yield _Trait(read, tuple(functions.values()), tuple(map(read, functions.values())), tuple(functions))


def _first_other(names: Iterable[str], now: Iterable[Any], before: Iterable[Any]) -> str:
    return next(name for name, one, other in zip(names, now, before, strict=True) if one is not other)


def _is_host() -> bool:
    """Elsewhere people trace: with debuggers, in their tests."""
    specification = getattr(sys.modules.get("__main__"), "__spec__", None)
    return specification is not None and specification.name == f"{_OURS}host"


def _tracing() -> tuple[str, ...]:
    """The means of Python to run code at each line or call, as far as they are in use."""
    monitoring = getattr(sys, "monitoring", None)
    tools = [monitoring.get_tool(number) for number in range(6)] if monitoring else []
    return (
        "sys.settrace" if sys.gettrace() else "",
        "sys.setprofile" if sys.getprofile() else "",
        "sys.monitoring" if any(tools) else "",
    )


_all: Callable[[Iterable[object]], bool] = all
_map: Any = map
_is, _len, _type, _getattr = is_, len, type, getattr
"""Bound here: builtins can be replaced."""
