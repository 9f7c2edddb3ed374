"""Names that a model keeps apart and a target language does not: the generators refuse such a model with a diagnostic.

Enumerators belong to the scope around their enumeration in IDL and, as 13.2.3 prints enumerations, in C++11; identifiers of IDL differ
in more than case (12.2).
"""

from __future__ import annotations

import functools
import itertools
from collections.abc import Callable, Iterator

from ucm_cts.adapters.contract.metamodel import components as mc
from ucm_cts.adapters.contract.metamodel import contracts as c
from ucm_cts.adapters.contract.metamodel.common import Element, Named, child_fields
from ucm_cts.adapters.contract.metamodel.modules import MODULES, Model
from ucm_cts.adapters.contract.metamodel.names import Names, each_element
from ucm_cts.adapters.contract.metamodel.spelling import contained
from ucm_cts.adapters.reference.toolchain.diagnostics import CannotBeMapped

Spell = Callable[[str], str]
"""What a name is in the target language, so that equal ones clash."""

_WITH_MEMBERS = (c.Structure, c.Union, c.Exception_, c.Interface, c.Method, mc.ComponentType)
_OTHERS = (c.ConfigurationParameter, mc.Port)

DECLARED = (c.DataType, c.Constant, c.Exception_, c.Interface, mc.ComponentType, mc.AtomicComponentImplementation)


def refuse_clashes(model: Model, spell: Spell, clause: str, language: str, members: bool) -> None:
    """Raise ``CannotBeMapped`` for the first name that an earlier one of its scope equals.

    ``clause`` is that of the mapping and ``members`` says whether members of declarations may clash, too.
    """
    names = Names(model)
    scopes: dict[str, dict[str, Element]] = {}
    for element, scope in each_element(model, names, *DECLARED, *(_WITH_MEMBERS if members else ())):
        if isinstance(element, DECLARED):
            known = scopes.setdefault(scope.path, {})
            for name, one in _introduced(element):
                _enter(known, spell(name), one, clause, language)
        if members and isinstance(element, _WITH_MEMBERS):
            held = [getattr(element, field) for field in _member_fields(type(element))]
            names_of_members = [spell(member.name) for group in held for member in group]
            if len(set(names_of_members)) < len(names_of_members):
                inside: dict[str, Element] = {}
                for member in itertools.chain(*held):
                    _enter(inside, spell(member.name), member, clause, language)


@functools.cache
def _member_fields(cls: type[Element]) -> tuple[str, ...]:
    """The fields of ``cls`` that hold what has a name in the target language, too."""
    held = {
        field for inner, field in contained(cls).items() if issubclass(inner, Named) and not issubclass(inner, _OTHERS)
    }
    return tuple(field for field in child_fields(cls) if field in held)


def _introduced(element: Named) -> Iterator[tuple[str, Element]]:
    """The names that ``element`` adds to the scope of its module."""
    suffix = "_Body" if isinstance(element, mc.AtomicComponentImplementation) else ""
    yield element.name + suffix, element
    if isinstance(element, c.Enumeration):
        yield from ((one.name, one) for one in element.enumerators)


def _enter(known: dict[str, Element], name: str, element: Element, clause: str, language: str) -> None:
    first = known.setdefault(name, element)
    if first is not element and not (isinstance(first, MODULES) and isinstance(element, MODULES)):
        message = f"in {language} the name {getattr(element, 'name', name)} is that of line {first.line} again; rename one of both"
        raise CannotBeMapped(element.line, message, clause)
