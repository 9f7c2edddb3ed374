"""Names of a model as IDL spells them, and which modules become templates (12.7)."""

from __future__ import annotations

import functools
import itertools
from collections.abc import Iterable

from ucm_cts.adapters.contract.metamodel.aspects import TechnicalPolicyDefinition
from ucm_cts.adapters.contract.metamodel.common import Named, children
from ucm_cts.adapters.contract.metamodel.contracts import AbstractDataType, AbstractInterface, DataType, Interface
from ucm_cts.adapters.contract.metamodel.interactions import PortType
from ucm_cts.adapters.contract.metamodel.modules import MODULES, Module
from ucm_cts.adapters.contract.metamodel.names import SEPARATOR, Declared, Names, Scope

_KEYWORDS = """abstract any alias attribute bitfield bitmask bitset boolean case char component connector const consumes
    context custom default double emits enum eventtype exception factory false finder fixed float getraises home import in
    inout int16 int32 int64 int8 interface local long manages map mirrorport module multiple native object octet oneway out
    port porttype primarykey private provides public publishes raises readonly sequence setraises short string struct
    supports switch true truncatable typedef typeid typename typeprefix uint16 uint32 uint64 uint8 union unsigned uses
    valuebase valuetype void wchar wstring"""
KEYWORDS = frozenset(_KEYWORDS.split())
"""Words of IDL 4.2, in lower case; a name that equals one in any case gets an underscore."""

TYPES = (DataType, AbstractDataType, Interface, AbstractInterface)
ABSTRACT = (AbstractDataType, AbstractInterface)

REMEMBERED = 10_000
"""The number of names whose spelling is remembered."""


@functools.lru_cache(maxsize=REMEMBERED)
def identifier(name: str) -> str:
    """``name`` without hyphens, escaped if it is a keyword."""
    plain = name.replace("-", "_")
    return f"_{plain}" if plain.lower() in KEYWORDS else plain


@functools.lru_cache(maxsize=REMEMBERED)
def folded(name: str) -> str:
    """What is left of ``name`` once what IDL does not tell apart is equal."""
    return name.replace("-", "_").lower()


def parameter(element: Named) -> str:
    """The template parameter that stands for an abstract type."""
    return element.name.replace("-", "_").upper()


def absolute(declared: Declared) -> str:
    """The IDL name of ``declared`` from the root; of an abstract type the template parameter."""
    if isinstance(declared.element, ABSTRACT):
        return parameter(declared.element)
    return f"{_module(declared.scope.path)}::{identifier(declared.element.name)}"


@functools.lru_cache(maxsize=REMEMBERED)
def _module(path: str) -> str:
    """The IDL name, from the root, of the module with this ``path``."""
    return "".join(f"::{identifier(part)}" for part in path.split(SEPARATOR) if part)


class Templates:
    """The template parameters of modules: abstract types that they declare or use themselves."""

    def __init__(self, names: Names) -> None:
        self._names = names

    def parameters(self, module: Module) -> list[Declared]:
        """The abstract types that ``module`` needs to be given, in the order in which it meets them."""
        scope = self._names.inside(module)
        found: dict[str, Declared] = {}
        for element in children(module):
            if isinstance(element, MODULES) or not isinstance(element, Named):
                continue
            if isinstance(element, ABSTRACT):
                direct = Declared(element, scope)
                found.setdefault(direct.path, direct)
            for declared in used(element, scope):
                if isinstance(declared.element, ABSTRACT):
                    found.setdefault(declared.path, declared)
        return list(found.values())


def used(element: Named, scope: Scope) -> list[Declared]:
    """The types that a declaration of a contract, a port type or a policy definition names, each reference once."""
    references: Iterable[str] = ()
    if isinstance(element, (PortType, TechnicalPolicyDefinition)):
        references = (one.interface for one in element.port_elements)
    elif isinstance(element, Interface):
        signatures = (parameter.type for method in element.methods for parameter in method.parameters)
        references = itertools.chain((attribute.type for attribute in element.attributes), signatures)
    elif isinstance(element, DataType):
        parts = (element, *getattr(element, "fields", ()), *getattr(element, "cases", ()))
        references = (getattr(one, "type", "") for one in parts)
    found = (scope.find_one_of(reference, TYPES) for reference in dict.fromkeys(references) if reference)
    return [one for one in found if one is not None]
