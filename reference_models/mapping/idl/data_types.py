"""What 12.2 to 12.5 make of data types and constants."""

from __future__ import annotations

from collections.abc import Iterator

from ucm_cts.adapters.contract.metamodel.contracts import (
    UNBOUNDED,
    Alias,
    Array,
    Constant,
    DataType,
    Enumeration,
    NativeType,
    PrimitiveBoolean,
    PrimitiveChar,
    PrimitiveFloat,
    PrimitiveInteger,
    Sequence,
    StringType,
    Structure,
    Union,
)
from ucm_cts.adapters.contract.metamodel.names import Declared, Scope
from ucm_cts.reference_models.mapping.idl.declarations import Annotated as AnnotatedType
from ucm_cts.reference_models.mapping.idl.declarations import (
    Annotation,
    ArrayOf,
    Basic,
    Expression,
    Literal,
    SequenceOf,
    Text,
    Type,
)
from ucm_cts.reference_models.mapping.idl.expectations import (
    Declares,
    Expected,
    Indexed,
    Labelled,
    Lists,
    Means,
    Numbered,
    Ordered,
    Path,
    Selects,
    Tagged,
    Valued,
)
from ucm_cts.reference_models.mapping.idl.subjects import DATA_TYPES, Subject, integer_kind, path_in, type_named

BASIC = {
    "BYTE": ("R-12.3.1-01", "octet"),
    "SHORT": ("R-12.3.1-02", "short"),
    "LONG": ("R-12.3.1-03", "long"),
    "LONGLONG": ("R-12.3.1-04", "long long"),
    "UBYTE": ("R-12.3.1-05", "octet"),
    "USHORT": ("R-12.3.1-06", "unsigned short"),
    "ULONG": ("R-12.3.1-07", "unsigned long"),
    "ULONGLONG": ("R-12.3.1-08", "unsigned long long"),
    "FLOAT": ("R-12.3.1-09", "float"),
    "DOUBLE": ("R-12.3.1-10", "double"),
    "CHAR8": ("R-12.3.1-11", "char"),
    "CHAR32": ("R-12.3.1-12", "wchar"),
    "BOOLEAN": ("R-12.3.1-13", "boolean"),
}
"""The table of 12.3.1, by the meta-model's kinds; the interpretations idl-ulonglong, idl-boolean and char-kinds are about it."""

EIGHT_BITS = {"BYTE": ("R-12.3.2-02", "int8"), "UBYTE": ("R-12.3.2-03", "uint8")}

PRIMITIVE = (PrimitiveInteger, PrimitiveFloat, PrimitiveChar, PrimitiveBoolean)

KINDS: dict[type[DataType], tuple[str, str]] = {
    Alias: ("R-12.4.1-01", "typedef"),
    Structure: ("R-12.4.1-02", "struct"),
    Union: ("R-12.4.1-04", "union"),
    Enumeration: ("R-12.4.1-07", "enum"),
    Array: ("R-12.4.1-08", "typedef"),
    Sequence: ("R-12.4.1-09", "typedef"),
    StringType: ("R-12.4.1-10", "typedef"),
    NativeType: ("R-12.4.1-11", "native"),
}
"""Which requirement asks for a declaration of which kind (interpretation idl-complex-types)."""


def primitive_kind(element: DataType) -> str:
    """The kind of a primitive type, BOOLEAN for the one that has none."""
    return "BOOLEAN" if isinstance(element, PrimitiveBoolean) else str(getattr(element, "kind", ""))


def is_mapped(element: DataType) -> bool:
    """Whether clause 12 says what becomes of it: long double has no row."""
    return not isinstance(element, PRIMITIVE) or primitive_kind(element) in BASIC


def data_type_facts(subject: Subject) -> Iterator[Expected]:
    """All that is expected of a data type."""
    element = subject.element
    assert isinstance(element, DataType)
    if not is_mapped(element):
        return
    yield Declares(**subject.about("R-12.2-03"), kind="")
    if isinstance(element, PRIMITIVE):
        yield from _primitive(subject, primitive_kind(element))
        return
    requirement, kind = KINDS[type(element)]
    yield Declares(**subject.about(requirement), kind=kind, needed=False)
    match element:
        case Structure():
            yield from _structure(subject, element)
        case Union():
            yield from _union(subject, element)
        case Enumeration():
            yield from _enumeration(subject, element)
        case NativeType():
            yield from _native(subject, element)
        case _:
            type_ = meaning_of(Declared(element, subject.scope))
            if type_ is not None:
                yield Means(**subject.about(requirement), type=type_)
            yield from _indexed(subject)


def meaning_of(declared: Declared) -> Type | None:
    """What a data type with a typedef is another name of; None for others and for what the model does not say."""
    element, scope = declared
    match element:
        case PrimitiveInteger() | PrimitiveFloat() | PrimitiveChar() | PrimitiveBoolean():
            return _basic(primitive_kind(element))
        case Alias():
            return type_named(element.type, scope, DATA_TYPES)
        case StringType() if element.char_base and element.max_size is not None:
            return Text(element.char_base == "CHAR32", _bound(element.max_size))
        case Sequence() if element.max_size is not None:
            inner = type_named(element.type, scope, DATA_TYPES)
            return SequenceOf(inner, _bound(element.max_size)) if inner is not None else None
        case Array():
            inner = type_named(element.type, scope, DATA_TYPES)
            sizes = tuple(_number(d.size) for d in element.dimensions if d.size is not None)
            return ArrayOf(inner, sizes) if inner is not None and len(sizes) == len(element.dimensions) > 0 else None
    return None


def _basic(kind: str) -> Type | None:
    if kind not in BASIC:
        return None
    basic = Basic(BASIC[kind][1])
    return AnnotatedType(basic, (Annotation(EIGHT_BITS[kind][1]),)) if kind in EIGHT_BITS else basic


def _number(value: int) -> Expression:
    return Literal("integer", str(value))


def _bound(size: int) -> Expression | None:
    return None if size == UNBOUNDED else _number(size)


def _primitive(subject: Subject, kind: str) -> Iterator[Expected]:
    requirement, name = BASIC[kind]
    yield Means(**subject.about(requirement), type=Basic(name))
    if kind in EIGHT_BITS:
        requirement, annotation = EIGHT_BITS[kind]
        yield Tagged(**subject.about(requirement), name=annotation)


def _structure(subject: Subject, structure: Structure) -> Iterator[Expected]:
    yield Lists(**subject.about("R-12.4.1-02"), names=tuple(field.name for field in structure.fields))
    for field in structure.fields:
        type_ = type_named(field.type, subject.scope, DATA_TYPES)
        if type_ is not None:
            yield Means(**subject.about("R-12.4.1-03", field), type=type_)


def _union(subject: Subject, union: Union) -> Iterator[Expected]:
    selector = subject.scope.find(union.selector_type, Enumeration)
    if selector is not None:
        yield Selects(**subject.about("R-12.4.1-04"), type=_named_type(selector))
    yield Lists(**subject.about("R-12.4.1-05"), names=tuple(case.name for case in union.cases), ordered=False)
    for case in union.cases:
        type_ = type_named(case.type, subject.scope, DATA_TYPES)
        if type_ is not None:
            yield Means(**subject.about("R-12.4.1-05", case), type=type_)
        if selector is not None:
            labels = tuple(path_in(selector.scope, value.enumerator) for value in case.selector_values)
            yield Labelled(**subject.about("R-12.4.1-06", case), labels=labels, default=case.default_case)


def _named_type(declared: Declared) -> Type:
    found = type_named(declared.path, declared.scope, (Enumeration,))
    assert found is not None
    return found


def _enumeration(subject: Subject, enumeration: Enumeration) -> Iterator[Expected]:
    names = tuple(one.name for one in enumeration.enumerators)
    yield Lists(**subject.about("R-12.4.1-07"), names=names, ordered=False)
    numbers = {one.name: one.value for one in enumeration.enumerators if one.value is not None}
    by_value = tuple(sorted(names, key=lambda name: numbers[name])) if len(numbers) == len(names) else names
    yield Ordered(**subject.about("R-12.4.1-12"), orders=(names, by_value))
    values = tuple((one.name, one.value) for one in enumeration.enumerators if one.value is not None)
    if values and len(values) == len(enumeration.enumerators):
        yield Numbered(**subject.about("R-12.4.1.3-02"), values=values)
    yield from _indexed(subject)


def _indexed(subject: Subject) -> Iterator[Expected]:
    element, scope = subject
    match element:
        case Sequence():
            requirement, references = "R-12.4.1.2-04", [element.index_type]
        case Array():
            requirement, references = "R-12.4.1.2-05", [d.index_type for d in element.dimensions]
        case Enumeration():
            requirement, references = "R-12.4.1.2-06", [element.index_type]
        case _:
            return
    kinds = [integer_kind(reference, scope) for reference in references]
    known = tuple(dict.fromkeys(kind for kind in kinds if kind is not None))
    if known and len(kinds) == len([kind for kind in kinds if kind]):
        yield Indexed(**subject.about(requirement), kinds=known)
        yield Indexed(**subject.about("R-12.4.1.2-02"), kinds=())


def _native(subject: Subject, native: NativeType) -> Iterator[Expected]:
    if native.max_size is not None and native.max_size > 0:
        yield Tagged(**subject.about("R-12.4.1.1-02"), name="MemoryFootprint")
        yield Tagged(**subject.about("R-12.4.1.1-03"), name="MemoryFootprint", maximum=native.max_size)


def constant_type(constant: Constant, scope: Scope) -> Declared | None:
    """The data type of a constant, aliases followed; None if the model does not say."""
    found = scope.find(constant.type, *DATA_TYPES)
    for _ in range(100):
        if found is None or not isinstance(found.element, Alias):
            break
        found = found.scope.find(found.element.type, *DATA_TYPES)
    return found


def constant_facts(subject: Subject) -> Iterator[Expected]:
    """All that is expected of a constant; IDL has none of composite types (interpretation constant-types)."""
    constant = subject.element
    assert isinstance(constant, Constant)
    type_ = type_named(constant.type, subject.scope, DATA_TYPES)
    last = constant_type(constant, subject.scope)
    if type_ is None or last is None or not isinstance(last.element, (*PRIMITIVE, Enumeration, StringType)):
        return
    if not is_mapped(last.element):
        return
    yield Declares(**subject.about("R-12.5-01"), kind="const")
    yield Means(**subject.about("R-12.5-02"), type=type_)
    is_calculated = isinstance(last.element, (PrimitiveInteger, PrimitiveFloat, PrimitiveBoolean))
    value = constant.value if is_calculated else _named_value(constant, subject.scope)
    yield Valued(**subject.about("R-12.5-03"), type=type_, value=value)


def _named_value(constant: Constant, scope: Scope) -> str:
    """The value of a constant, which may be the name of another one."""
    for _ in range(100):
        found = scope.find(constant.value.strip(), Constant)
        if found is None or not isinstance(found.element, Constant):
            break
        constant, scope = found.element, found.scope
    return constant.value


__all__ = ["Path", "constant_facts", "data_type_facts", "is_mapped", "meaning_of"]
