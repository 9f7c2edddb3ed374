"""Elements of a model with their scopes, and their references as types of IDL."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

from ucm_cts.adapters.contract.metamodel import contracts as c
from ucm_cts.adapters.contract.metamodel.common import Element, Named
from ucm_cts.adapters.contract.metamodel.names import SEPARATOR, Declared, Scope
from ucm_cts.reference_models.mapping.idl.declarations import Named as Name
from ucm_cts.reference_models.mapping.idl.declarations import Type
from ucm_cts.reference_models.mapping.idl.expectations import Path

TYPES = (c.DataType, c.AbstractDataType, c.Interface, c.AbstractInterface)
DATA_TYPES = (c.DataType, c.AbstractDataType)
INTERFACES = (c.Interface, c.AbstractInterface)


class Subject(NamedTuple):
    """An element with expectations, and the scope of its references."""

    element: Named
    scope: Scope

    @property
    def path(self) -> Path:
        """Where its declaration stands."""
        return path_in(self.scope, self.element.name)

    def about(self, requirement: str, *inner: Named, path: Path | None = None) -> dict[str, Any]:
        """The fields that facts about it have in common, or about what stands ``inner`` it; ``path`` if that differs."""
        element: Element = inner[-1] if inner else self.element
        names = [one.name for one in (self.element, *inner)]
        return {
            "requirement": requirement,
            "element": SEPARATOR.join((self.scope.path, names[0])) + "".join(f".{name}" for name in names[1:]),
            "line": element.line,
            "path": self.path + tuple(names[1:]) if path is None else path,
        }


def path_in(scope: Scope, *names: str) -> Path:
    """The path of what ``names`` lead to from ``scope``."""
    return (*filter(None, scope.path.split(SEPARATOR)), *names)


def path_of(declared: Declared) -> Path:
    """The path of an element of the model."""
    return path_in(declared.scope, declared.element.name)


def named(path: Path) -> Name:
    """The type that stands at ``path``."""
    return Name(SEPARATOR.join(("", *path)))


def type_named(reference: str, scope: Scope, kinds: tuple[type[Named], ...] = TYPES) -> Type | None:
    """What ``reference`` means as a type; None if the model does not say, which is an error of the model."""
    found = scope.find(reference, *kinds)
    return named(path_of(found)) if found is not None else None


def integer_kind(reference: str, scope: Scope) -> str | None:
    """The kind of integer that ``reference`` means: a kind's own name, or a primitive integer or an alias of one."""
    if reference in c.INTEGER_RANGES:
        return reference
    found = scope.find(reference, c.PrimitiveInteger, c.Alias) if reference else None
    for _ in range(100):
        if found is None or isinstance(found.element, c.PrimitiveInteger):
            break
        assert isinstance(found.element, c.Alias)
        found = found.scope.find(found.element.type, c.PrimitiveInteger, c.Alias)
    return found.element.kind if found is not None and isinstance(found.element, c.PrimitiveInteger) else None


Bound = Mapping[Path, Type]
"""What stands for abstract types, by their paths."""
