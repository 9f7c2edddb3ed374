"""What all parts of the C++ mapping share: the model's names, the standard, the readings, and how C++ spells names."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

from ucm_cts.adapters.contract.metamodel import contracts
from ucm_cts.adapters.contract.metamodel.common import Named
from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.contract.metamodel.names import SEPARATOR, Declared, Names, Scope, each_element
from ucm_cts.reference_models.mapping.cpp import claims
from ucm_cts.reference_models.mapping.cpp.classes import Sample
from ucm_cts.reference_models.mapping.cpp.expected import Expected, Standard

DATA = (contracts.DataType, contracts.AbstractDataType)
INTERFACES = (contracts.Interface, contracts.AbstractInterface)
ABSTRACT = (contracts.AbstractDataType, contracts.AbstractInterface)

_RESERVED = """alignas alignof and and_eq asm auto bitand bitor bool break case catch char char16_t char32_t class compl
const const_cast constexpr continue decltype default delete do double dynamic_cast else enum explicit export extern false
float for friend goto if inline int long mutable namespace new noexcept not not_eq nullptr operator or or_eq private
protected public register reinterpret_cast return short signed sizeof static static_assert static_cast struct switch
template this thread_local throw true try typedef typeid typename union unsigned using virtual void volatile wchar_t while
xor xor_eq"""
RESERVED = frozenset(_RESERVED.split())

OBSERVED = "observed"

LARGE = 1 << 18
"""Bytes from which on no value of a type is made: programs have little room for such values where functions keep theirs."""


class Context:
    """One model under one standard and the vendor's readings (options of interpretations_13)."""

    def __init__(self, model: Model, standard: Standard, readings: Mapping[str, str]) -> None:
        self.standard = standard
        self.names = Names(model)
        self._readings = readings
        self.declared = list(_declared(model, self.names))
        self.shared_ptr = "::std::shared_ptr" if self.modern else "::ucm::shared_ptr"
        self.array = "::std::array" if self.modern else "::ucm::array"

    @property
    def modern(self) -> bool:
        """Whether this is C++11."""
        return self.standard == "cpp11"

    def reading(self, option: str, default: str = OBSERVED) -> str:
        """What the vendor declares for ``option``."""
        return self._readings.get(option, default)

    def is_sayable(self, *names: str) -> bool:
        """Whether the text says how C++ spells all these names, or paths of names."""
        parts = [part for name in names for part in name.split(SEPARATOR) if part]
        hyphen = self.reading("cpp-hyphen", "underscore") == "underscore"
        return all(part not in RESERVED and (hyphen or "-" not in part) for part in parts)

    def reference(self, class_name: str) -> str:
        """A shared pointer to a class."""
        return f"{self.shared_ptr}< {class_name} >"

    def data(self, reference: str, scope: Scope) -> Declared | None:
        """The data type that ``reference`` means."""
        return scope.find(reference, *DATA)

    def sample(self, declared: Declared) -> Sample:
        """Two values of a data type."""
        type_ = spelled(declared)
        first, second = self._values(type_, actual(declared))
        return Sample(type_, first, second, first != second)

    def _values(self, type_: str, declared: Declared) -> tuple[str, str]:
        match declared.element:
            case contracts.PrimitiveInteger():
                return f"static_cast< {type_} >(42)", f"static_cast< {type_} >(7)"
            case contracts.PrimitiveFloat():
                return f"static_cast< {type_} >(1.5)", f"static_cast< {type_} >(0.25)"
            case contracts.PrimitiveBoolean():
                return "true", "false"
            case contracts.PrimitiveChar():
                return f"static_cast< {type_} >('u')", f"static_cast< {type_} >('c')"
            case contracts.StringType(char_base="CHAR8"):
                return f'{type_}("ucm")', f'{type_}("cts")'
            case contracts.StringType():
                return f'{type_}(L"ucm")', f'{type_}(L"cts")'
            case contracts.Enumeration() as enumeration if all(
                self.is_sayable(e.name) for e in enumeration.enumerators
            ):
                named = [f"{type_}({spelled(declared)}::{plain(e.name)})" for e in enumeration.enumerators]
                return named[-1], named[0]
        return f"{type_}()", f"{type_}()"


def footprint(declared: Declared, depth: int = 50) -> int:
    """About how many bytes a value takes; what can grow counts as if it were empty."""
    found = actual(declared)
    return found.scope.remembered(
        ("footprint", id(found.element), depth), lambda: _footprint(found.element, found.scope, depth)
    )


def _footprint(element: Named, scope: Scope, depth: int) -> int:
    def of(reference: str) -> int:
        found = scope.find(reference, *DATA)
        return footprint(found, depth - 1) if found is not None and depth > 0 else 8

    match element:
        case contracts.Structure():
            return sum(of(field.type) for field in element.fields)
        case contracts.Union():
            return 8 + sum(of(case.type) for case in element.cases)
        case contracts.Array():
            return of(element.type) * math.prod(max(0, d.size or 0) for d in element.dimensions)
        case contracts.Sequence() if element.max_size is not None and element.max_size > 0:
            return of(element.type) * element.max_size
    return 32


def plain(name: str) -> str:
    """``name`` as C++ spells it."""
    return name.replace("-", "_")


def scope_of(path: str) -> str:
    """The namespace of a module's ``path``."""
    return "".join(f"::{plain(part)}" for part in path.split(SEPARATOR) if part)


def spelled(declared: Declared, prefix: str = "", suffix: str = "") -> str:
    """The name of ``declared`` from the root; ``prefix`` and ``suffix`` belong to its last part."""
    return f"{scope_of(declared.scope.path)}::{prefix}{plain(declared.element.name)}{suffix}"


def actual(declared: Declared) -> Declared:
    """What aliases lead to from ``declared``; the last alias if that is nothing."""
    for _ in range(1000):
        element = declared.element
        found = declared.scope.find(element.type, *DATA) if isinstance(element, contracts.Alias) else None
        if found is None:
            break
        declared = found
    return declared


def expect(requirement: str, declared: Declared, claim: claims.Claim, member: Named | None = None) -> Expected:
    """``claim`` because of ``declared``, or of its ``member``."""
    if member is None:
        return Expected(requirement, declared.path, declared.element.line, claim)
    return Expected(requirement, f"{declared.path}.{member.name}", member.line, claim)


def _declared(model: Model, names: Names) -> Iterator[Declared]:
    """Each element with a name and a place among names; of those given again, the first."""
    seen: set[tuple[type[Named], str]] = set()
    for element, scope in each_element(model, names):
        if isinstance(element, Named) and any(element is d.element for d in scope.members.get(element.name, ())):
            found = Declared(element, scope)
            if (type(element), found.path) not in seen:
                seen.add((type(element), found.path))
                yield found
