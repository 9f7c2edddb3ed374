"""What modules consist of and use: the names, functions and tables that a seal remembers."""

from __future__ import annotations

import builtins
from collections.abc import Iterable, Iterator, Mapping
from types import BuiltinFunctionType, CellType, CodeType, FunctionType, ModuleType
from typing import Any, NamedTuple

_MAY_CHANGE = {
    *("__annotations__", "__annotate__", "__annotate_func__", "__annotations_cache__"),
    *("__doc__", "__slotnames__", "__msgspec_cache__", "__warningregistry__"),
}
"""What Python and msgspec add to modules and classes by themselves."""

_FOLLOWED = frozenset(("threading", "contextlib"))
"""Modules of Python whose own functions decide what is recorded: what these use is remembered, too."""


class Names(NamedTuple):
    """Names of ``where``, which belong to ``owner``, and what they mean. ``whole``: how many there are, -1 if others may come."""

    owner: str
    where: Mapping[str, Any]
    names: tuple[str, ...]
    values: tuple[Any, ...]
    whole: int


def new_name(where: Mapping[str, Any], names: Iterable[str]) -> str | None:
    """A name of ``where`` that is not among ``names``; None if there is no other than Python's own."""
    return min((str(name) for name in where if name not in names and name not in _MAY_CHANGE), default=None)


class Reach:
    """What the given modules consist of and use.

    ``functions``: by name, those of the modules, and those of Python that decide what is recorded.
    ``values``: what the modules' own names mean.
    """

    def __init__(self) -> None:
        self.functions: dict[str, FunctionType] = {}
        self.values: dict[str, Any] = {}
        self._tables: list[Names] = []
        self._used: dict[int, tuple[str, Mapping[str, Any], dict[str, Any]]] = {}
        self._seen: set[int] = set()

    def module(self, module: ModuleType) -> list[type]:
        """Adds ``module``; returns its classes."""
        kinds = []
        self.remember(module.__name__, vars(module))
        for name, value in vars(module).items():
            self.values[f"{module.__name__}.{name}"] = value
            if isinstance(value, type) and value.__module__ == module.__name__:
                kinds.append(value)
                self._add_class(value)
            elif isinstance(value, dict) and name.isupper():
                self.remember(f"{module.__name__}.{name}", value)
            elif getattr(value, "__module__", None) == module.__name__:
                self._follow(f"{module.__name__}.{name}", value)
        return kinds

    def remember(self, owner: str, where: Mapping[str, Any]) -> None:
        """All names of ``where``, and that there are no others."""
        names = tuple(name for name in where if name not in _MAY_CHANGE)
        self._tables.append(Names(owner, where, names, tuple(where[name] for name in names), len(where)))

    def tables(self) -> tuple[Names, ...]:
        """The names of the modules and of their classes and tables, and the names that functions use of others."""
        used = (Names(owner, where, tuple(of), tuple(of.values()), -1) for owner, where, of in self._used.values())
        return *self._tables, *used

    def cells(self) -> Iterator[tuple[str, CellType]]:
        """What functions refer to of the functions around them, each with the function's name."""
        for owner, function in self.functions.items():
            yield from ((owner, cell) for cell in function.__closure__ or () if _is_filled(cell))

    def _add_class(self, kind: type) -> None:
        owner = f"{kind.__module__}.{kind.__qualname__}"
        self.remember(owner, vars(kind))
        for name, value in vars(kind).items():
            self._follow(f"{owner}.{name}", value)

    def _follow(self, owner: str, value: Any) -> None:
        """Add the functions that ``value`` consists of, and what they use."""
        if id(value) in self._seen:
            return
        self._seen.add(id(value))
        for part in (getattr(value, name, None) for name in ("fget", "fset", "__func__", "__wrapped__")):
            if isinstance(part, FunctionType):
                self._follow(owner, part)
        if not isinstance(value, FunctionType):
            return
        self.functions[owner if owner not in self.functions else f"{owner}#{len(self.functions)}"] = value
        for cell in value.__closure__ or ():
            if _is_filled(cell) and isinstance(cell.cell_contents, FunctionType):
                self._follow(owner, cell.cell_contents)
        self._use(value.__globals__, value.__code__)

    def _use(self, where: Mapping[str, Any], code: CodeType) -> None:
        """Names in ``code`` that its module or Python defines, and attributes of modules that they may mean."""
        for name in code.co_names:
            if name in where:
                value = where[name]
                self._note(str(where.get("__name__")), where, name)
                if isinstance(value, ModuleType):
                    for attribute in code.co_names:
                        if attribute in vars(value):
                            self._note(value.__name__, vars(value), attribute)
            elif name in vars(builtins):
                self._note("builtins", vars(builtins), name)
        for inner in code.co_consts:
            if isinstance(inner, CodeType):
                self._use(where, inner)

    def _note(self, owner: str, where: Mapping[str, Any], name: str) -> None:
        value = where[name]
        if not isinstance(value, FunctionType | BuiltinFunctionType | type | ModuleType):
            return  # what a module keeps may change
        self._used.setdefault(id(where), (owner, where, {}))[2][name] = value
        if getattr(value, "__module__", None) not in _FOLLOWED or id(value) in self._seen:
            return
        if isinstance(value, type):
            self._seen.add(id(value))
            parts = {key: one for key, one in vars(value).items() if isinstance(one, FunctionType | property)}
            self._used[id(value)] = (f"{owner}.{name}", vars(value), parts)
            for key, part in parts.items():
                self._follow(f"{owner}.{name}.{key}", part)
        else:
            self._follow(f"{owner}.{name}", value)


def _is_filled(cell: CellType) -> bool:
    try:
        return cell.cell_contents is not _is_filled
    except ValueError:
        return False
