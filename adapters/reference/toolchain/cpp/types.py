"""Data types, constants and exceptions as C++ (13.1 to 13.4, 13.10)."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from ucm_cts.adapters.contract.metamodel import contracts
from ucm_cts.adapters.contract.metamodel.common import Named
from ucm_cts.adapters.contract.metamodel.names import Declared, Scope
from ucm_cts.adapters.reference.toolchain.cpp.names import identifier, instance, qualified


@dataclass(frozen=True)
class Standard:
    """What the two standards spell differently: class templates, and ``const`` of what the compiler can evaluate."""

    name: str
    shared_ptr: str
    array: str
    constant: str

    @property
    def modern(self) -> bool:
        """Whether this is C++11."""
        return self.name == "cpp11"


CPP11 = Standard("cpp11", "::std::shared_ptr", "::std::array", "constexpr")
CPP03 = Standard("cpp03", "::ucm::shared_ptr", "::ucm::array", "const")

INTEGERS = {
    "BYTE": "uint8_t",
    "SHORT": "int16_t",
    "LONG": "int32_t",
    "LONGLONG": "int64_t",
    "UBYTE": "uint8_t",
    "USHORT": "uint16_t",
    "ULONG": "uint32_t",
    "ULONGLONG": "uint64_t",
}
FLOATS = {"FLOAT": "float", "DOUBLE": "double", "LONGDOUBLE": "long double"}
CHARS = {"CHAR8": "char", "CHAR32": "wchar_t"}
STRINGS = {"CHAR8": "::std::string", "CHAR32": "::std::wstring"}

PRIMITIVES = (
    contracts.PrimitiveInteger,
    contracts.PrimitiveFloat,
    contracts.PrimitiveChar,
    contracts.PrimitiveBoolean,
)
BY_VALUE = (*PRIMITIVES, contracts.Enumeration)
ABSTRACT = (contracts.AbstractDataType, contracts.AbstractInterface)
DATA = (contracts.DataType, contracts.AbstractDataType)
INTERFACES = (contracts.Interface, contracts.AbstractInterface)


class MissingReference(Exception):
    """A well-formed model never gets here: a reference that leads nowhere."""


def find(reference: str, scope: Scope, *kinds: type[Named]) -> Declared:
    """What ``reference`` means in ``scope``. Raises ``MissingReference``."""
    found = scope.find(reference, *kinds)
    if found is None:
        raise MissingReference(reference)
    return found


def actual(declared: Declared) -> Declared:
    """What aliases lead to from ``declared``."""
    seen: list[Named] = []
    while isinstance(declared.element, contracts.Alias) and declared.element not in seen:
        seen.append(declared.element)
        declared = find(declared.element.type, declared.scope, *DATA)
    return declared


def is_by_value(declared: Declared) -> bool:
    """Whether parameters of this type are passed by value."""
    return isinstance(actual(declared).element, BY_VALUE)


def index_kind(index_type: str, scope: Scope) -> str:
    """The kind that ``index_type`` says, or that of the PrimitiveInteger that it names."""
    if index_type in INTEGERS:
        return index_type
    found = find(index_type, scope, contracts.PrimitiveInteger).element
    assert isinstance(found, contracts.PrimitiveInteger)
    return found.kind


def type_definition(declared: Declared, standard: Standard) -> str:
    """The declaration of a data type inside its namespace."""
    element, scope = declared
    name = identifier(element.name)
    if isinstance(element, contracts.Enumeration):
        return _enumeration(element, scope, name, standard)
    if isinstance(element, contracts.Structure):
        return _structure(element, scope, name, standard)
    if isinstance(element, contracts.Union):
        return _union(element, scope, name, standard)
    return f"typedef {_renamed(element, scope, standard)} {name};\n"


def _renamed(element: Named, scope: Scope, standard: Standard) -> str:
    """What the typedef of a data type that gets no class of its own stands for."""
    match element:
        case contracts.PrimitiveInteger():
            return INTEGERS[element.kind]
        case contracts.PrimitiveFloat():
            return FLOATS[element.kind]
        case contracts.PrimitiveChar():
            return CHARS[element.kind]
        case contracts.PrimitiveBoolean():
            return "bool"
        case contracts.Alias():
            return type_name(element.type, scope)
        case contracts.StringType():
            return STRINGS[element.char_base]
        case contracts.Array():
            spelled = type_name(element.type, scope)
            for dimension in reversed(element.dimensions):
                spelled = instance(standard.array, spelled, dimension.size)
            return spelled
        case contracts.Sequence():
            elements = type_name(element.type, scope)
            bounded = element.max_size is not None and element.max_size > 0
            return (
                instance(standard.array, elements, element.max_size) if bounded else instance("::std::vector", elements)
            )
        case contracts.NativeType():
            size = element.max_size or 0
            return instance(standard.array, "uint8_t", size) if size > 0 else instance("::std::vector", "uint8_t")
    raise AssertionError(f"{type(element).__name__} is no data type")


def type_name(reference: str, scope: Scope) -> str:
    """The C++ name of the data type that ``reference`` means."""
    return qualified(find(reference, scope, *DATA))


def _enumeration(element: contracts.Enumeration, scope: Scope, name: str, standard: Standard) -> str:
    underlying = INTEGERS[index_kind(element.index_type, scope)]
    values = ",\n".join(
        f"        {identifier(e.name)}" + ("" if e.value is None else f" = {e.value}") for e in element.enumerators
    )
    if standard.modern:
        return f"enum {name} : {underlying} {{\n{values}\n}};\n"
    return (
        f"struct {name}_def {{\n    enum type {{\n{values}\n    }};\n}};\n"
        f"typedef {instance('::ucm::safe_enum', f'{name}_def', underlying)} {name};\n"
    )


@dataclass(frozen=True)
class Member:
    """A field of a structure or an exception, or a case of a union."""

    name: str
    type: str
    by_value: bool
    initial: str

    @property
    def passed(self) -> str:
        """How its value is passed to a function."""
        return self.type if self.by_value else f"const {self.type}&"


Field = contracts.StructureField | contracts.UnionCase | contracts.ExceptionField


def _members(fields: Sequence[Field], scope: Scope, owner: str) -> list[Member]:
    return [_member(field, scope, owner) for field in fields]


def _member(field: Field, scope: Scope, owner: str) -> Member:
    declared = find(field.type, scope, *DATA)
    enumeration = actual(declared)
    initial = ""
    if isinstance(enumeration.element, contracts.Enumeration):
        initial = f"{qualified(enumeration)}::{identifier(enumeration.element.enumerators[0].name)}"
    name = identifier(field.name)
    return Member(f"{name}_" if name == owner else name, qualified(declared), is_by_value(declared), initial)


def _accessors(member: Member, standard: Standard, on_writing: str = "") -> Iterator[str]:
    """Reading and writing as the IDL to C++11 mapping has it."""
    m = member
    yield f"    {m.passed} {m.name}() const {{ return stored_{m.name}; }}"
    yield f"    {m.type}& {m.name}() {{ return stored_{m.name}; }}"
    yield f"    void {m.name}({m.passed} value) {{ {on_writing}stored_{m.name} = value; }}"
    if standard.modern and not m.by_value:
        yield f"    void {m.name}({m.type}&& value) {{ {on_writing}stored_{m.name} = ::std::move(value); }}"


def _stored(members: Sequence[Member]) -> Iterator[str]:
    for member in members:
        yield f"    {member.type} stored_{member.name};"


def _constructors(name: str, members: Sequence[Member]) -> Iterator[str]:
    initial = ", ".join(f"stored_{m.name}({m.initial})" for m in members)
    yield f"    {name}()" + (f" : {initial}" if initial else "") + " {}"
    if members:
        given = ", ".join(f"{m.passed} {m.name}_value" for m in members)
        taken = ", ".join(f"stored_{m.name}({m.name}_value)" for m in members)
        yield f"    explicit {name}({given}) : {taken} {{}}"


def _equality(name: str, members: Sequence[str]) -> Iterator[str]:
    same = " && ".join(f"stored_{m} == other.stored_{m}" for m in members)
    yield f"    bool operator==(const {name}& other) const {{ return {same}; }}"
    yield f"    bool operator!=(const {name}& other) const {{ return !(*this == other); }}"


def _structure(element: contracts.Structure, scope: Scope, name: str, standard: Standard) -> str:
    members = _members(element.fields, scope, name)
    lines = [f"class {name} {{", "  public:", *_constructors(name, members)]
    for member in members:
        lines += _accessors(member, standard)
    lines += [*_equality(name, [m.name for m in members]), "", "  private:", *_stored(members), "};"]
    return "\n".join(lines) + "\n"


def _union(element: contracts.Union, scope: Scope, name: str, standard: Standard) -> str:
    members = _members(element.cases, scope, name)
    selector = find(element.selector_type, scope, contracts.Enumeration, contracts.Alias)
    enumeration = actual(selector)
    assert isinstance(enumeration.element, contracts.Enumeration)
    enumerators = [e.name for e in enumeration.element.enumerators]
    chosen = [_selector(case, element, enumerators) for case in element.cases]
    spelled = [f"{qualified(enumeration)}::{identifier(one)}" for one in chosen]
    initial = ", ".join([f"stored_selector({spelled[0]})", *(f"stored_{m.name}({m.initial})" for m in members)])
    type_ = qualified(selector)
    lines = [f"class {name} {{", "  public:", f"    {name}() : {initial} {{}}"]
    lines += [
        f"    {type_} _d() const {{ return stored_selector; }}",
        f"    void _d({type_} value) {{ stored_selector = value; }}",
    ]
    for member, value in zip(members, spelled, strict=True):
        lines += _accessors(member, standard, f"stored_selector = {value}; ")
    lines += [
        *_equality(name, ["selector", *(m.name for m in members)]),
        "",
        "  private:",
        f"    {type_} stored_selector;",
    ]
    return "\n".join([*lines, *_stored(members), "};"]) + "\n"


def _selector(case: contracts.UnionCase, union: contracts.Union, enumerators: Sequence[str]) -> str:
    """The enumerator that the selector has once ``case`` was written."""
    if case.selector_values:
        return case.selector_values[0].enumerator
    used = {value.enumerator for other in union.cases for value in other.selector_values}
    return next((e for e in enumerators if e not in used), enumerators[0])


def exception_definition(declared: Declared, standard: Standard) -> str:
    """The class of an exception inside its namespace (13.4)."""
    element = declared.element
    assert isinstance(element, contracts.Exception_)
    name = identifier(element.name)
    members = _members(element.fields, declared.scope, name)
    override = " override" if standard.modern else ""
    silent = "noexcept" if standard.modern else "throw()"
    lines = [f"class {name} : public ::UCM::UserException {{", "  public:", *_constructors(name, members)]
    lines.append(f"    virtual ~{name}() {silent} {{}}")
    lines += [
        f"    {name}(const {name}&) = default;",
        f"    {name}& operator=(const {name}&) = default;",
    ] * standard.modern
    lines += [
        f"    virtual void _raise() const{override} {{ throw *this; }}",
        f'    virtual const char* _name() const{override} {{ return "{name}"; }}',
    ]
    for member in members:
        lines += _accessors(member, standard)
    if members:
        lines += ["", "  private:", *_stored(members)]
    return "\n".join([*lines, "};"]) + "\n"


@dataclass(frozen=True)
class ConstantText:
    """A constant as the header declares it and, if the header must not define it, as a source file does."""

    declaration: str
    definition: str = ""


def constant_definition(declared: Declared, standard: Standard) -> ConstantText:
    """A constant inside its namespace; C++03 leaves the values of floating point constants to a source file (13.10)."""
    element = declared.element
    assert isinstance(element, contracts.Constant)
    declared_type = find(element.type, declared.scope, *DATA)
    type_ = actual(declared_type)
    value = constant_value(element.value, type_, declared.scope)
    named = f"{qualified(declared_type)} {identifier(element.name)}"
    if not isinstance(type_.element, BY_VALUE):
        return ConstantText(f"const {named} = {value};\n")
    if not standard.modern and isinstance(type_.element, contracts.PrimitiveFloat):
        return ConstantText(f"extern const {named};\n", f"extern const {named} = {value};\n")
    return ConstantText(f"{standard.constant} {named} = {value};\n")


_TOKEN = re.compile(
    r"""L?"(?:\\.|[^"\\])*"|L?'(?:\\.|[^'\\])+'|0[xX][0-9a-fA-F]+|(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"""
    r"""|(?:::)?[A-Za-z_]\w*(?:(?:::|-)[A-Za-z_]\w*)*|<<|>>|\S"""
)
_NAME = re.compile(r"(?:::)?[A-Za-z_]")
_WIDE_INTEGERS = ("LONGLONG", "ULONGLONG")
"""Kinds whose values may be wider than what C++ computes with where nothing says otherwise."""


def names_in_value(text: str) -> list[str]:
    """What may be names of constants in ``text``, a value in the syntax of IDL."""
    return [token for token in _TOKEN.findall(text) if _NAME.match(token) and token[-1] not in "\"'"]


def constant_value(text: str, type_: Declared, scope: Scope) -> str:
    """``text``, a value in the syntax of IDL, as C++ for a constant of ``type_``."""
    number = _integer(text) if isinstance(type_.element, contracts.PrimitiveInteger) else None
    if number is not None:
        return _spelled(number)
    wide = _is_wide(type_)
    return " ".join(_token(token, wide, type_, scope) for token in _TOKEN.findall(text))


def _integer(text: str) -> int | None:
    try:
        return int(text, 0)
    except ValueError:
        return int(text, 8) if re.fullmatch(r"-?0[0-7]+", text) else None


def _spelled(number: int) -> str:
    if number == -(2**63):
        return f"-{2**63 - 1} - 1"
    return f"{number}u" if number >= 2**63 else str(number)


def _is_wide(type_: Declared) -> bool:
    element = type_.element
    if isinstance(element, contracts.PrimitiveChar):
        return element.kind == "CHAR32"
    return isinstance(element, contracts.StringType) and element.char_base == "CHAR32"


def _token(token: str, wide: bool, type_: Declared, scope: Scope) -> str:
    if token[0].isdigit() and isinstance(type_.element, contracts.PrimitiveInteger):
        return f"{INTEGERS[type_.element.kind]}({token})" if type_.element.kind in _WIDE_INTEGERS else token
    if token[0] in "\"'":
        return f"L{token}" if wide else token
    if token in ("TRUE", "FALSE"):
        return token.lower()
    if not _NAME.match(token) or token[-1] in "\"'":
        return token
    if isinstance(type_.element, contracts.Enumeration):
        name = token.rpartition(":")[2]
        if any(e.name == name for e in type_.element.enumerators):
            return f"{qualified(type_)}::{identifier(name)}"
    return qualified(find(token, scope, contracts.Constant))
