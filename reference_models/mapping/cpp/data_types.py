"""Modules, data types, constants and exceptions (13.1 to 13.4, 13.10.1, 13.10.2)."""

from __future__ import annotations

import re
from collections.abc import Iterator

from ucm_cts.adapters.contract.metamodel import contracts
from ucm_cts.adapters.contract.metamodel.modules import MODULES
from ucm_cts.adapters.contract.metamodel.names import Declared
from ucm_cts.reference_models.mapping.cpp import claims
from ucm_cts.reference_models.mapping.cpp.classes import Named
from ucm_cts.reference_models.mapping.cpp.context import (
    ABSTRACT,
    DATA,
    LARGE,
    OBSERVED,
    Context,
    actual,
    expect,
    footprint,
    plain,
    spelled,
)
from ucm_cts.reference_models.mapping.cpp.expected import Expected

INTEGERS = {
    "BYTE": ("R-13.1-01", "uint8_t"),
    "SHORT": ("R-13.1-02", "int16_t"),
    "LONG": ("R-13.1-03", "int32_t"),
    "LONGLONG": ("R-13.1-04", "int64_t"),
    "UBYTE": ("R-13.1-05", "uint8_t"),
    "USHORT": ("R-13.1-06", "uint16_t"),
    "ULONG": ("R-13.1-07", "uint32_t"),
    "ULONGLONG": ("R-13.1-08", "uint64_t"),
}
FLOATS = {"FLOAT": ("R-13.1-09", "float"), "DOUBLE": ("R-13.1-10", "double")}
CHARS = {"CHAR8": ("R-13.1-11", "char"), "CHAR32": ("R-13.1-12", "wchar_t")}
STRINGS = {"CHAR8": ("R-13.2.6-01", "::std::string"), "CHAR32": ("R-13.2.6-02", "::std::wstring")}


def modules(context: Context) -> Iterator[Expected]:
    """A namespace for each module (13.3)."""
    for declared in context.declared:
        if isinstance(declared.element, MODULES) and context.is_sayable(declared.path):
            yield expect("R-13.3-01", declared, claims.Namespace(spelled(declared)))


def data_types(context: Context) -> Iterator[Expected]:
    """All that is said of data types."""
    for declared in context.declared:
        if isinstance(declared.element, contracts.DataType) and context.is_sayable(declared.path):
            if is_abstract(declared) or isinstance(declared.element, contracts.NativeType):
                continue
            yield expect("R-13.2-01", declared, claims.Declares(spelled(declared)))
            yield from _data_type(declared, context)


def is_abstract(declared: Declared) -> bool:
    """Whether there is an abstract type among what ``declared`` is made of. What was found out is remembered for what is made of it."""
    known = declared.scope.root.remembered("whether data types are abstract", dict[int, bool])
    met: set[int] = set()
    waiting = [declared]
    found = False
    while waiting and not found:
        one = waiting.pop()
        identity = id(one.element)
        if identity not in met:
            met.add(identity)
            found = known.get(identity, isinstance(one.element, ABSTRACT))
            if identity not in known:
                waiting += _parts(one)
    if found:
        known[id(declared.element)] = True
    else:
        known.update(dict.fromkeys(met, False))
    return found


def _parts(declared: Declared) -> Iterator[Declared]:
    """The data types that ``declared`` is made of directly, as often as it names them."""
    element, scope = declared
    parts = (element, *getattr(element, "fields", ()), *getattr(element, "cases", ()))
    for reference in (getattr(part, "type", "") for part in parts):
        found = scope.find(reference, *DATA) if reference else None
        if found is not None:
            yield found


def _data_type(declared: Declared, context: Context) -> Iterator[Expected]:
    name = spelled(declared)
    match declared.element:
        case contracts.PrimitiveInteger(kind=kind) if kind in INTEGERS:
            requirement, type_ = INTEGERS[kind]
            types = byte_types(context) if kind == "BYTE" else (type_,)
            yield expect(requirement, declared, claims.Is(name, types))
        case contracts.PrimitiveFloat(kind=kind) if kind in FLOATS:
            yield expect(FLOATS[kind][0], declared, claims.Is(name, (FLOATS[kind][1],)))
        case contracts.PrimitiveChar(kind=kind) if kind in CHARS:
            yield expect(CHARS[kind][0], declared, claims.Is(name, (CHARS[kind][1],)))
        case contracts.PrimitiveBoolean():
            yield expect("R-13.1-13", declared, claims.Is(name, ("bool",)))
        case contracts.StringType(char_base=kind) if kind in STRINGS:
            yield expect(STRINGS[kind][0], declared, claims.Is(name, (STRINGS[kind][1],)))
        case contracts.Alias(type=type_):
            renamed = context.data(type_, declared.scope)
            if renamed is not None and context.is_sayable(renamed.path):
                yield expect("R-13.2-02", declared, claims.Is(name, (spelled(renamed),)))
        case contracts.Structure():
            yield from _structure(declared, declared.element, context)
        case contracts.Union():
            yield from _union(declared, declared.element, context)
        case contracts.Enumeration():
            yield from _enumeration(declared, declared.element, context)
        case contracts.Array():
            yield from _array(declared, declared.element, context)
        case contracts.Sequence():
            yield from _sequence(declared, declared.element, context)


def byte_types(context: Context) -> tuple[str, ...]:
    """What BYTE maps to: the table says ``uint8_t``, the range of values ``int8_t``."""
    reading = context.reading("cpp-byte")
    return ("uint8_t", "int8_t") if reading == OBSERVED else (reading,)


def struct_forms(context: Context) -> tuple[claims.StructForm, ...]:
    """How fields may be read and written."""
    match context.reading("cpp-struct"):
        case "accessors":
            return ("accessors",)
        case "plain":
            return ("plain",)
    return ("accessors", "plain")


def _is_large(declared: Declared) -> bool:
    """Whether a program of probes makes no values of the structure, union or exception."""
    return sum(footprint(part) for part in _parts(declared)) > LARGE


def _field(
    requirement: str,
    copied: str,
    declared: Declared,
    field: contracts.StructureField | contracts.UnionCase | contracts.ExceptionField,
    context: Context,
) -> Iterator[Expected]:
    found = context.data(field.type, declared.scope)
    nameable = context.is_sayable(field.name) and plain(field.name) != plain(declared.element.name)
    if _is_large(declared):
        return
    if found is not None and nameable and context.is_sayable(found.path):
        claim = claims.Field(spelled(declared), plain(field.name), context.sample(found), struct_forms(context))
        yield expect(requirement, declared, claim, field)
        if claim.sample.comparable:
            yield expect(copied, declared, claims.Copied(claim.owner, claim.field, claim.sample, claim.forms), field)
            if isinstance(field, contracts.ExceptionField):
                thrown = claims.Copied(claim.owner, claim.field, claim.sample, claim.forms, True)
                yield expect("R-13.4-08", declared, thrown, field)


def _structure(declared: Declared, structure: contracts.Structure, context: Context) -> Iterator[Expected]:
    name = spelled(declared)
    yield expect("R-13.2.1-01", declared, claims.IsClass(name))
    if not _is_large(declared):
        yield expect("R-13.2.1-02", declared, claims.Regular(name))
    asked = [
        one for field in structure.fields for one in _field("R-13.2.1-03", "R-13.2.1-02", declared, field, context)
    ]
    yield from asked
    if struct_forms(context) != ("accessors",):
        return
    fields = [one.claim for one in asked if isinstance(one.claim, claims.Field)]
    for field, claim in zip(structure.fields, fields, strict=False) if len(fields) == len(structure.fields) else ():
        yield expect("R-13.2.1-04", declared, claims.Changed(name, claim.field, claim.sample), field)
    if fields and len(fields) == len(structure.fields):
        made = claims.Constructed(name, tuple((claim.field, claim.sample) for claim in fields))
        yield expect("R-13.2.1-04", declared, made)


def _union(declared: Declared, union: contracts.Union, context: Context) -> Iterator[Expected]:
    name = spelled(declared)
    yield expect("R-13.2.2-01", declared, claims.IsClass(name))
    if not _is_large(declared):
        yield expect("R-13.2.2-02", declared, claims.Regular(name))
    for case in union.cases:
        yield from _field("R-13.2.2-03", "R-13.2.2-02", declared, case, context)
        yield from _discriminator(declared, union, case, context)


def _discriminator(
    declared: Declared, union: contracts.Union, case: contracts.UnionCase, context: Context
) -> Iterator[Expected]:
    selector, type_ = (context.data(t, declared.scope) for t in (union.selector_type, case.type))
    if _is_large(declared) or selector is None or type_ is None or plain(case.name) == plain(declared.element.name):
        return
    enumeration = actual(selector)
    if not isinstance(enumeration.element, contracts.Enumeration):
        return
    enumerators = [e.name for e in enumeration.element.enumerators]
    listed = {v.enumerator for v in case.selector_values}
    others = {v.enumerator for other in union.cases if other is not case for v in other.selector_values}
    chosen = [e for e in enumerators if e in listed or (case.default_case and e not in others)]
    if chosen and context.is_sayable(selector.path, type_.path, case.name, *enumerators):
        claim = claims.Discriminator(
            spelled(declared),
            tuple(dict.fromkeys(("_d", plain(union.selector_name)))),
            plain(case.name),
            context.sample(type_),
            tuple(f"{spelled(enumeration)}::{plain(e)}" for e in chosen),
            struct_forms(context),
        )
        yield expect("R-13.2.2-04", declared, claim, case)


def _enumeration(declared: Declared, enumeration: contracts.Enumeration, context: Context) -> Iterator[Expected]:
    name = spelled(declared)
    form, member, value, inner = (
        ("R-13.2.3-01", "R-13.2.3-02", "R-13.2.3-03", "R-13.2.3-04")
        if context.modern
        else ("R-13.10.2-03", "R-13.10.2-05", "R-13.10.2-02", "R-13.10.2-04")
    )
    types = _underlying(declared, enumeration, context)
    if context.modern:
        reading = context.reading("cpp-enum")
        forms: tuple[str, ...] = ("enum", "enum-class") if reading == OBSERVED else (reading,)
        yield expect(form, declared, claims.EnumForm(name, forms))  # type: ignore[arg-type]
        yield expect(form, declared, claims.FixedType(name))
        if types:
            yield expect(inner, declared, claims.Underlying(name, types))
    else:
        yield expect("R-13.10.2-01", declared, claims.IsClass(f"{name}_def"))
        yield expect("R-13.10.2-01", declared, claims.EnumForm(f"{name}_def::type", ("enum",)))
        yield expect(form, declared, claims.SafeEnum(name, f"{name}_def"))
        if types:
            yield expect(inner, declared, claims.SafeEnumInner(name, types))
        yield expect(inner, declared, claims.Works("safe-enum-default", (f"{name}_def",)))
    owner = name if context.modern else f"{name}_def"
    sayable = [e for e in enumeration.enumerators if context.is_sayable(e.name)]
    for enumerator in sayable:
        found = claims.EnumeratorOf(name, plain(enumerator.name), name if context.modern else f"{name}_def::type")
        yield expect(member, declared, found, enumerator)
        if enumerator.value is not None:
            yield expect(
                value, declared, claims.EnumeratorValue(owner, plain(enumerator.name), enumerator.value), enumerator
            )
    if len(sayable) == len(enumeration.enumerators):
        whole = claims.NoOtherEnumerators(
            owner if context.modern else f"{owner}::type", tuple(plain(e.name) for e in sayable)
        )
        yield expect(member if context.modern else value, declared, whole)
    if context.reading("cpp-enum-type") == "uint32_t":  # other values have no order that it keeps
        sayable = [e for e in sayable if _has_uint32_t(e)]
    if not context.modern and len(sayable) > 1:
        yield from _safe_enum(declared, tuple(f"{name}::{plain(e.name)}" for e in sayable[:2]), sayable)


def _safe_enum(
    declared: Declared, values: tuple[str, ...], enumerators: list[contracts.Enumerator]
) -> Iterator[Expected]:
    types = (spelled(declared),)
    yield expect("R-13.10.2-06", declared, claims.Works("safe-enum-construction", types, values))
    numbers = tuple(str(e.value) for e in enumerators[:2] if e.value is not None)
    if len(numbers) == len(values):
        yield expect("R-13.10.2-07", declared, claims.Works("safe-enum-underlying", types, (*values, *numbers)))
        ordered = tuple(v for _, v in sorted(zip(map(int, numbers), values, strict=True)))
        for position, operator in enumerate(("==", "!=", "<", "<=", ">", ">=")):
            claim = claims.Works("safe-enum-comparison", types, ordered, operator)
            yield expect(f"R-13.10.2-{position + 8:02}", declared, claim)


def _underlying(declared: Declared, enumeration: contracts.Enumeration, context: Context) -> tuple[str, ...]:
    kind = enumeration.index_type
    if kind not in INTEGERS:
        found = declared.scope.find(kind, contracts.PrimitiveInteger) if kind else None
        kind = found.element.kind if found and isinstance(found.element, contracts.PrimitiveInteger) else ""
    if kind not in INTEGERS:
        return ()
    of_index = byte_types(context) if kind == "BYTE" else (INTEGERS[kind][1],)
    of_32_bits = (
        ("uint32_t",) if all(map(_has_uint32_t, enumeration.enumerators)) else ("uint32_t", "int32_t", *of_index)
    )
    match context.reading("cpp-enum-type"):
        case "index-type":
            return of_index
        case "uint32_t":
            return tuple(dict.fromkeys(of_32_bits))
    return tuple(dict.fromkeys((*of_index, *of_32_bits)))


def _has_uint32_t(enumerator: contracts.Enumerator) -> bool:
    """Whether the enumerator's value is one of ``uint32_t``."""
    return enumerator.value is None or 0 <= enumerator.value < 2**32


def _array(declared: Declared, array: contracts.Array, context: Context) -> Iterator[Expected]:
    element = context.data(array.type, declared.scope)
    sizes = [d.size for d in array.dimensions if d.size is not None]
    if element is None or len(sizes) != len(array.dimensions) or not context.is_sayable(element.path):
        return
    claim = claims.ArrayOf(spelled(declared), context.array, spelled(element), len(sizes))
    yield expect("R-13.2.4-01" if context.modern else "R-13.10.1-01", declared, claim)
    yield expect("R-13.2.4-02", declared, claims.Sizes(spelled(declared), tuple(sizes)))
    if not context.modern:
        yield expect("R-13.10.1-02", declared, claims.Works("array", (spelled(declared),), tuple(map(str, sizes))))


def _sequence(declared: Declared, sequence: contracts.Sequence, context: Context) -> Iterator[Expected]:
    element = context.data(sequence.type, declared.scope)
    if element is None or not context.is_sayable(element.path) or sequence.max_size == 0:
        return
    if footprint(declared) > LARGE:
        return
    name = spelled(declared)
    if sequence.max_size is None or sequence.max_size < 0:
        yield expect("R-13.2.5-02", declared, claims.Is(name, (f"::std::vector< {spelled(element)} >",)))
        return
    reading = context.reading("cpp-bounded-sequence")
    forms: tuple[str, ...] = ("array", "bounded-vector") if reading == OBSERVED else (reading,)
    claim = claims.BoundedSequence(name, context.array, context.sample(element), sequence.max_size, forms)  # type: ignore[arg-type]
    yield expect("R-13.2.5-01", declared, claim)


def constants(context: Context) -> Iterator[Expected]:
    """All that is said of constants (13.2.7, 13.10)."""
    for declared in context.declared:
        element = declared.element
        if not isinstance(element, contracts.Constant):
            continue
        type_ = context.data(element.type, declared.scope)
        if type_ is None or not context.is_sayable(declared.path, type_.path):
            continue
        name = spelled(declared)
        yield expect("R-13.2.7-01", declared, claims.IsConstant(name))
        value = constant_value(element.value, actual(type_), declared, context)
        if value:
            claim = claims.ConstantIs(name, spelled(type_), f"static_cast< {spelled(type_)} >({value})")
            yield expect("R-13.2.7-02", declared, claim)
        floating = isinstance(actual(type_).element, contracts.PrimitiveFloat)
        if floating and not context.modern and context.reading("cpp03-float-constants", "source") == "source":
            yield expect("R-13.10-05", declared, claims.NotInHeader(name))


_TOKEN = re.compile(
    r"""L?"(?:\\.|[^"\\])*"|L?'(?:\\.|[^'\\])+'|0[xX][0-9a-fA-F]+|(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"""
    r"""|(?:::)?[A-Za-z_]\w*(?:(?:::|-)[A-Za-z_]\w*)*|<<|>>|[-+*/%~|&^()]"""
)


def constant_value(text: str, type_: Declared, declared: Declared, context: Context) -> str:
    """``text`` as C++; nothing if it says something else than literals, names of constants and operators."""
    tokens: list[str] = []
    for token in _TOKEN.findall(text):
        found = _constant_token(token, type_, declared, context)
        if found is None:
            return ""
        tokens.append(found)
    return " ".join(tokens) if not _TOKEN.sub("", text).strip() else ""


def _constant_token(token: str, type_: Declared, declared: Declared, context: Context) -> str | None:
    wide = getattr(type_.element, "kind", getattr(type_.element, "char_base", "")) == "CHAR32"
    if token[0] in "\"'":
        return f"L{token}" if wide else token
    if token in ("TRUE", "FALSE"):
        return token.lower()
    if token[0].isdigit() and token.isdecimal() and len(token) > 18:
        return None
    if not (token[0].isalpha() or token[0] in "_:") or token[-1] in "\"'":
        return token
    bare = token.rpartition("::")[2]
    if isinstance(type_.element, contracts.Enumeration) and bare in {e.name for e in type_.element.enumerators}:
        return f"{spelled(type_)}::{plain(bare)}"
    found = declared.scope.find(token, contracts.Constant)
    return spelled(found) if found is not None and context.is_sayable(found.path) else None


def exceptions(context: Context) -> Iterator[Expected]:
    """The expectations of exceptions (13.4), and of their roots if there is an exception."""
    roots = False
    for declared in context.declared:
        element = declared.element
        if not isinstance(element, contracts.Exception_) or not context.is_sayable(declared.path):
            continue
        if not roots:
            roots = True
            yield from _roots(declared)
        name = spelled(declared)
        yield expect("R-13.3-02", declared, claims.Declares(name))
        yield expect("R-13.4-01", declared, claims.IsClass(name))
        if not _is_large(declared):
            yield expect("R-13.4-01", declared, claims.Regular(name))
        yield expect("R-13.4-04", declared, claims.Derives(Named(name), "::UCM::UserException"))
        yield expect("R-13.4-03", declared, claims.NoMember(Named(name), "rep_id"))
        yield expect("R-13.4-03", declared, claims.NoMember(Named(name), "_rep_id"))
        yield expect("R-13.4-06", declared, claims.NotCorba(Named(name)))
        if not _is_large(declared):
            yield expect("R-13.4-08", declared, claims.Thrown(name, "::UCM::Exception"))
        for field in element.fields:
            yield from _field("R-13.4-07", "R-13.4-01", declared, field, context)


def _roots(declared: Declared) -> Iterator[Expected]:
    root = "::UCM::Exception"
    yield expect("R-13.4-02", declared, claims.IsAbstract(Named(root)))
    yield expect("R-13.4-02", declared, claims.Derives(Named("::UCM::UserException"), root))
    yield expect("R-13.4-02", declared, claims.Derives(Named("::UCM::SystemException"), root))
    yield expect("R-13.4-03", declared, claims.NoMember(Named(root), "rep_id"))
    yield expect("R-13.4-03", declared, claims.NoMember(Named(root), "_rep_id"))
    yield expect("R-13.4-05", declared, claims.IsClass("::UCM::SystemException"))
    both = ("::UCM::UserException", "::UCM::SystemException")
    for derived, other in (both, both[::-1]):
        yield expect("R-13.4-05", declared, claims.NotDerived(Named(derived), other))
    for other in ("::UCM::UserException", "::UCM::SystemException"):
        yield expect("R-13.4-06", declared, claims.NotCorba(Named(other)))
