"""Data types, constants, exceptions and interfaces as IDL (12.3 to 12.6)."""

from __future__ import annotations

from ucm_cts.adapters.contract.metamodel import contracts as c
from ucm_cts.adapters.contract.metamodel.names import Scope
from ucm_cts.adapters.reference.toolchain.idl.names import TYPES, absolute, identifier

BASIC = {
    "BYTE": "octet",
    "SHORT": "short",
    "LONG": "long",
    "LONGLONG": "long long",
    "UBYTE": "octet",
    "USHORT": "unsigned short",
    "ULONG": "unsigned long",
    "ULONGLONG": "unsigned long long",
    "FLOAT": "float",
    "DOUBLE": "double",
    "LONGDOUBLE": "long double",
    "CHAR8": "char",
    "CHAR32": "wchar",
}

SIGNS = {"BYTE": "@int8 ", "UBYTE": "@uint8 "}
"""What tells signed and unsigned octets apart."""

Lines = list[str]


def type_name(reference: str, scope: Scope) -> str:
    """The IDL name of the type that ``reference`` means. The model must be well-formed."""
    found = scope.find_one_of(reference, TYPES)
    assert found is not None, reference
    return absolute(found)


def data_type(element: c.DataType, scope: Scope) -> Lines:
    """The declaration of a data type."""
    name = identifier(element.name)
    match element:
        case c.PrimitiveInteger() | c.PrimitiveFloat() | c.PrimitiveChar():
            return [f"{SIGNS.get(element.kind, '')}typedef {BASIC[element.kind]} {name};"]
        case c.PrimitiveBoolean():
            return [f"typedef boolean {name};"]
        case c.Alias():
            return [f"typedef {type_name(element.type, scope)} {name};"]
        case c.StringType():
            bound = f"<{element.max_size}>" if (element.max_size or 0) > 0 else ""
            return [f"typedef {'wstring' if element.char_base == 'CHAR32' else 'string'}{bound} {name};"]
        case c.Sequence():
            bound = f", {element.max_size}" if (element.max_size or 0) > 0 else ""
            inner = type_name(element.type, scope)
            return [index(element.index_type, scope), f"typedef sequence<{inner}{bound}> {name};"]
        case c.Array():
            sizes = "".join(f"[{one.size}]" for one in element.dimensions)
            inner = type_name(element.type, scope)
            return [index(element.dimensions[0].index_type, scope), f"typedef {inner} {name}{sizes};"]
        case c.Structure():
            fields = [f"{type_name(f.type, scope)} {identifier(f.name)};" for f in element.fields]
            return block(f"struct {name}", fields)
        case c.NativeType():
            return [f"@MemoryFootprint(max={element.max_size})", f"native {name};"]
        case c.Enumeration():
            return enumeration(element, scope)
        case c.Union():
            return union(element, scope)
    return []


def block(head: str, lines: Lines) -> Lines:
    """``head { lines };``"""
    return [f"{head} {{", *(f"    {line}" for line in lines), "};"]


def index(reference: str, scope: Scope) -> str:
    """The annotation that names an index type."""
    name = BASIC[reference] if reference in c.INTEGER_RANGES else type_name(reference, scope)
    return f'@IndexType(typeid="{name}")'


def enumeration(element: c.Enumeration, scope: Scope) -> Lines:
    """An enumeration; each enumerator says its value."""
    lines = []
    for number, one in enumerate(element.enumerators, 1):
        comma = "," if number < len(element.enumerators) else ""
        lines += [f'@DefaultValue(val="{one.value}")', f"{identifier(one.name)}{comma}"]
    return [index(element.index_type, scope), *block(f"enum {identifier(element.name)}", lines)]


def union(element: c.Union, scope: Scope) -> Lines:
    """A union; one whose cases name all enumerators must not have a default."""
    selector = scope.find(element.selector_type, c.Enumeration)
    assert selector is not None
    assert isinstance(selector.element, c.Enumeration)
    around = absolute(selector).rpartition("::")[0]
    named = {value.enumerator for case in element.cases for value in case.selector_values}
    complete = named >= {one.name for one in selector.element.enumerators}
    lines = []
    for case in element.cases:
        labels = [f"case {around}::{identifier(value.enumerator)}:" for value in case.selector_values]
        if case.default_case and not complete:
            labels.append("default:")
        lines += [*labels, f"    {type_name(case.type, scope)} {identifier(case.name)};"]
    return block(f"union {identifier(element.name)} switch ({absolute(selector)})", lines)


def constant(element: c.Constant, scope: Scope) -> Lines:
    """A constant, if its type is one that constants of IDL can have."""
    found = scope.find(element.type, c.DataType)
    while found is not None and isinstance(found.element, c.Alias):
        found = found.scope.find(found.element.type, c.DataType)
    if found is None:
        return []
    value = element.value.strip()
    another = scope.find(value, c.Constant)
    if another is not None:
        return [f"const {type_name(element.type, scope)} {identifier(element.name)} = {absolute(another)};"]
    match found.element:
        case c.Enumeration():
            value = f"{absolute(found).rpartition('::')[0]}::{identifier(value.rpartition('::')[2])}"
        case c.StringType() if not value.startswith(('"', 'L"')):
            value = f'"{element.value}"'
        case c.PrimitiveChar() if "'" not in value:
            value = f"'{element.value}'"
        case c.PrimitiveBoolean():
            value = value.upper()
    match found.element:
        case c.StringType(char_base="CHAR32") | c.PrimitiveChar(kind="CHAR32") if not value.startswith("L"):
            value = f"L{value}"
        case c.Structure() | c.Union() | c.Array() | c.Sequence() | c.NativeType():
            return []
    return [f"const {type_name(element.type, scope)} {identifier(element.name)} = {value};"]


def exception(element: c.Exception_, scope: Scope) -> Lines:
    """An exception."""
    fields = [f"{type_name(f.type, scope)} {identifier(f.name)};" for f in element.fields]
    return block(f"exception {identifier(element.name)}", fields)


def attribute(element: c.Attribute, scope: Scope) -> Lines:
    """An attribute of an interface or of a component type, with its default value if it has one."""
    readonly = "readonly " if element.mode == "READ" else ""
    default = ""
    if element.default_value is not None:
        escaped = element.default_value.replace("\\", "\\\\").replace('"', '\\"')
        default = f'@DefaultValue(val="{escaped}") '
    return [f"{default}{readonly}attribute {type_name(element.type, scope)} {identifier(element.name)};"]


def method(element: c.Method, scope: Scope) -> Lines:
    """An operation."""
    result = next((type_name(p.type, scope) for p in element.parameters if p.direction == "RETURN"), "void")
    arguments = ", ".join(
        f"{p.direction.lower()} {type_name(p.type, scope)} {identifier(p.name)}"
        for p in element.parameters
        if p.direction != "RETURN"
    )
    raised = [scope.find(one.exception, c.Exception_) for one in element.raised_exceptions]
    raises = ", ".join(absolute(one) for one in raised if one is not None)
    return [f"{result} {identifier(element.name)}({arguments})" + (f" raises ({raises});" if raises else ";")]


def interface(element: c.Interface, scope: Scope, extra_bases: Lines) -> Lines:
    """An interface; ``extra_bases`` stand behind those of the model."""
    bases = [type_name(one.interface, scope) for one in element.inherited_interfaces] + extra_bases
    lines = [line for one in element.attributes for line in attribute(one, scope)]
    lines += [line for one in element.methods for line in method(one, scope)]
    return block(f"interface {identifier(element.name)}{inherits(bases)}", lines)


def inherits(bases: Lines) -> str:
    """The part of an interface's head that names its bases, each once."""
    return f" : {', '.join(dict.fromkeys(bases))}" if bases else ""
