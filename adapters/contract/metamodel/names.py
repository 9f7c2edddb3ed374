"""Resolves references to elements, by name and kind: a module, a policy and an interface may share a name.

``a::b`` is looked up in the module where it stands, then in those around it; ``::a::b`` at the root; ``a::b.c`` is the member
``c`` of ``a::b``, or of what that one inherits from. ``::core::a`` and ``::a`` may both name a core definition.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator
from itertools import repeat
from typing import NamedTuple, TypeVar, cast

from ucm_cts.adapters.contract.metamodel.aspects import TechnicalPolicyDefinition
from ucm_cts.adapters.contract.metamodel.common import Element, Named, children
from ucm_cts.adapters.contract.metamodel.components import ComponentType
from ucm_cts.adapters.contract.metamodel.interactions import InteractionPattern
from ucm_cts.adapters.contract.metamodel.modules import MODULES, Model
from ucm_cts.adapters.contract.metamodel.spelling import fields_towards

Result = TypeVar("Result")

SEPARATOR = "::"
MEMBER = "."

CORE = "core"
"""The module that may or may not be around core definitions (10.1)."""


class Declared(NamedTuple):
    """An element with a name, and the scope of the module that declares it."""

    element: Named
    scope: Scope

    @property
    def path(self) -> str:
        """Its name from the root, as ``::a::b``."""
        return f"{self.scope.path}{SEPARATOR}{self.element.name}"


class Scope:
    """A module, or the root: what it declares, and what is around it. ``path`` is ``::a::b``, empty for the root."""

    __slots__ = ("_known", "_last", "_remembered", "around", "members", "modules", "path")

    def __init__(self, path: str = "", around: Scope | None = None) -> None:
        self.path = path
        self.around = around
        self.members: dict[str, list[Declared]] = {}
        self.modules: dict[str, list[Scope]] = {}
        self._known: dict[str, tuple[Declared, ...]] = {}
        self._remembered: dict[Hashable, object] = {}
        self._last: dict[str, tuple[Hashable, object]] = {}

    def find(self, reference: str, *kinds: type[Named]) -> Declared | None:
        """What ``reference`` means where this scope is, if it is one of ``kinds``; None if there is no such thing."""
        return self.find_one_of(reference, kinds)

    def find_one_of(self, reference: str, kinds: tuple[type[Named], ...]) -> Declared | None:
        """The same for kinds that are in a tuple already, which is faster."""
        known = self._known.get(reference)
        if known is None:
            known = self._known[reference] = self._first_of_each_kind(reference)
        for declared in known:
            if isinstance(declared.element, kinds):
                return declared
        return None

    def _first_of_each_kind(self, reference: str) -> tuple[Declared, ...]:
        """All that can be found for ``reference``: it may mean many things of one class, but only the first is ever found."""
        found: dict[type[Named], Declared] = {}
        for declared in self.candidates(reference):
            found.setdefault(type(declared.element), declared)
        return tuple(found.values())

    def remembered(self, key: Hashable, find_out: Callable[[], Result]) -> Result:
        """What ``find_out`` gave when this scope was first asked for ``key``, which must say whose it is and what it is about.

        It may hold the ``id`` of an element of the model, which lives as long as its scopes.
        """
        try:
            return cast(Result, self._remembered[key])
        except KeyError:
            result = self._remembered[key] = find_out()
            return result

    def remembered_last(self, what: str, key: Hashable, find_out: Callable[[], Result]) -> Result:
        """The same for what is asked several times in a row: of ``what`` only the result for the last ``key`` is kept."""
        last = self._last.get(what)
        if last is None or last[0] != key:
            last = self._last[what] = (key, find_out())
        return cast(Result, last[1])

    def candidates(self, reference: str) -> Iterator[Declared]:
        """All that ``reference`` could mean here, of any kind, the nearest first."""
        parts = reference.split(SEPARATOR)
        if not parts[0]:
            yield from self.root.below(parts[1:])
            if parts[1:2] == [CORE]:
                yield from self.root.below(parts[2:])
            else:
                yield from self.root.below([CORE, *parts[1:]])
            return
        scope: Scope | None = self
        while scope is not None:
            yield from scope.below(parts)
            scope = scope.around
        if parts[0] == CORE:
            yield from self.root.below(parts[1:])

    def below(self, parts: list[str]) -> Iterator[Declared]:
        """What is declared under this path inside the scope."""
        if len(parts) == 1:
            yield from self.members.get(parts[0], ())
        elif parts:
            for scope in self.modules.get(parts[0], ()):
                yield from scope.below(parts[1:])

    def member(self, reference: str, owner: type[Named], field: str) -> Declared | None:
        """What ``owner.member`` means here: an element of ``field`` of the owner, or of what the owner inherits from."""
        name, dot, wanted = reference.rpartition(MEMBER)
        found = self.find(name, owner) if dot else None
        return member_of(found, field, wanted) if found is not None else None

    @property
    def root(self) -> Scope:
        """The outermost scope."""
        scope = self
        while scope.around is not None:
            scope = scope.around
        return scope


def member_of(owner: Declared, field: str, name: str) -> Declared | None:
    """The element ``name`` in ``field`` of ``owner`` or, nearest first, of what it inherits from."""
    for ancestor in lineage(owner):
        for element in getattr(ancestor.element, field):
            if element.name == name:
                return Declared(element, ancestor.scope)
    return None


_INHERITED = {InteractionPattern: "extends", TechnicalPolicyDefinition: "extends", ComponentType: "refines"}


def parent_of(declared: Declared) -> Declared | None:
    """The pattern, policy definition or component type that ``declared`` extends or refines, if it names one that is there."""
    kind = type(declared.element)
    field = _INHERITED.get(kind)
    reference = getattr(declared.element, field) if field is not None else ""
    return declared.scope.find(reference, kind) if reference else None


def lineage(declared: Declared) -> list[Declared]:
    """``declared`` and its ancestors, nearest first; of a cycle each member once."""
    found = [declared]
    seen = {id(declared.element)}
    parent = parent_of(declared)
    while parent is not None and id(parent.element) not in seen:
        found.append(parent)
        seen.add(id(parent.element))
        parent = parent_of(parent)
    return found


class Names:
    """The scopes of a model, which has one for each module; modules of one kind and name side by side share theirs."""

    def __init__(self, model: Model) -> None:
        self.root = Scope()
        self._scopes: dict[int, Scope] = {}
        self._shared: dict[tuple[int, type[Element], str], Scope] = {}
        for module in model.modules:
            self._enter(module, self.root)

    def inside(self, module: Element) -> Scope:
        """The scope of ``module``, which must be of this very model and not merely equal to one of its modules."""
        return self._scopes[id(module)]

    def _enter(self, element: Named, scope: Scope) -> None:
        same_name = scope.members.get(element.name)
        if same_name is None:
            scope.members[element.name] = [Declared(element, scope)]
        else:
            same_name.append(Declared(element, scope))
        if not isinstance(element, MODULES):
            return
        key = (id(scope), type(element), element.name)
        inner = self._shared.get(key)
        if inner is None:
            inner = self._shared[key] = Scope(f"{scope.path}{SEPARATOR}{element.name}", scope)
            scope.modules.setdefault(element.name, []).append(inner)
        self._scopes[id(element)] = inner
        for child in children(element):
            if isinstance(child, Named):
                self._enter(child, inner)


def each_element(model: Model, names: Names, *kinds: type[Element]) -> Iterator[tuple[Element, Scope]]:
    """All elements of ``model``, parents first, each with the scope in which its references are looked up.

    With ``kinds`` only those of these classes; where none of them can be is not searched.
    """
    waiting: list[tuple[Element, Scope]] = [(module, names.root) for module in reversed(model.modules)]
    while waiting:
        element, scope = waiting.pop()
        if not kinds or isinstance(element, kinds):
            yield element, scope
        fields = fields_towards(type(element), kinds)
        if fields:
            inner = names.inside(element) if isinstance(element, MODULES) else scope
            for field in reversed(fields):
                waiting.extend(zip(reversed(getattr(element, field)), repeat(inner)))
