"""Data types for lwucm's calls by name: how it describes them, and how values of their C++ types become its own."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import chain

from ucm_cts.adapters.contract.metamodel import contracts
from ucm_cts.adapters.contract.metamodel.names import Declared
from ucm_cts.adapters.reference.toolchain.cpp.names import identifier, instance, qualified
from ucm_cts.adapters.reference.toolchain.cpp.types import DATA, actual, find, index_kind

_FLOATS = {"FLOAT": "float_type()", "DOUBLE": "double_type()"}
_CHARS = {"CHAR8": "char8_type()", "CHAR32": "char32_type()"}
_STRINGS = {"CHAR8": "string8_type", "CHAR32": "string32_type"}


def is_known(declared: Declared, around: tuple[str, ...] = ()) -> bool:
    """Whether lwucm has values of the type, and its C++ type has all of them. Types ``around`` it, by their paths, contain it."""
    if declared.path in around:
        return False
    match declared.element:
        case contracts.PrimitiveFloat(kind=kind):
            return kind in _FLOATS
        case contracts.PrimitiveInteger() | contracts.PrimitiveChar() | contracts.PrimitiveBoolean():
            return True
        case contracts.StringType() | contracts.Enumeration():
            return True
        case contracts.Sequence(max_size=bound) if bound is not None and bound > 0:
            return False  # its C++ type is an array of that size
        case contracts.Structure() | contracts.Array() | contracts.Sequence() | contracts.Alias():
            return all(is_known(part, (*around, declared.path)) for part in parts(declared))
    return False


def parts(declared: Declared) -> Iterator[Declared]:
    """The types that the type or exception is made of."""
    element = declared.element
    if isinstance(element, contracts.Structure | contracts.Exception_):
        references = [field.type for field in element.fields]
    else:
        references = (
            [element.type] if isinstance(element, contracts.Array | contracts.Sequence | contracts.Alias) else []
        )
    for reference in references:
        yield find(reference, declared.scope, *DATA)


def described(declared: Declared) -> str:
    """The expression that makes lwucm's description of a known type. Primitive types, strings and lists have no names there."""
    element, scope = declared
    match element:
        case contracts.PrimitiveInteger(kind=kind):
            return f"integer_type(IntegerKind::{kind})"
        case contracts.PrimitiveFloat(kind=kind):
            return _FLOATS[kind]
        case contracts.PrimitiveChar(kind=kind):
            return _CHARS[kind]
        case contracts.PrimitiveBoolean():
            return "boolean_type()"
        case contracts.StringType():
            bound = element.max_size if element.max_size is not None and element.max_size > 0 else "UNBOUNDED"
            return f"{_STRINGS[element.char_base]}({bound})"
        case contracts.Enumeration():
            index = index_kind(element.index_type, scope)
            listed = ", ".join(f'{{"{name}", {_literal(value)}}}' for name, value in _numbered(element))
            return f'enumeration_type("{element.name}", IntegerKind::{index}, {{{listed}}})'
        case contracts.Array():
            sizes = ", ".join(str(dimension.size) for dimension in element.dimensions)
            return f"array_type({described(next(parts(declared)))}, {{{sizes}}})"
        case contracts.Sequence():
            return f"sequence_type({described(next(parts(declared)))})"
        case contracts.Alias():
            return f'alias_type("{element.name}", {described(next(parts(declared)))})'
    return structure(declared)


def structure(declared: Declared) -> str:
    """The same of a structure or an exception."""
    element = declared.element
    assert isinstance(element, contracts.Structure | contracts.Exception_)
    typed = zip(element.fields, parts(declared), strict=True)
    listed = ", ".join(f'{{"{field.name}", {described(part)}}}' for field, part in typed)
    return f'structure_type("{element.name}", {{{listed}}})'


def _numbered(element: contracts.Enumeration) -> Iterator[tuple[str, int]]:
    value = -1
    for enumerator in element.enumerators:
        value = value + 1 if enumerator.value is None else enumerator.value
        yield enumerator.name, value


def _literal(value: int) -> str:
    return f"static_cast< ::std::int64_t>({value}ULL)" if value >= 2**63 else f"{value}LL"


def to_value(type_: Declared, expression: str) -> str:
    """``expression``, of a known type, as a value of lwucm."""
    return f"{instance('TypedValue', qualified(type_))}::to({expression})"


def from_value(type_: Declared, expression: str) -> str:
    """The value of lwucm that ``expression`` is, as one of the known type."""
    return f"{instance('TypedValue', qualified(type_))}::from({expression})"


def conversions(types: Iterable[Declared]) -> Iterator[str]:
    """The specialisations of ``TypedValue`` for ``types`` and all that they are made of, each after those it needs."""
    done: set[str] = set()

    def add(type_: Declared) -> Iterator[str]:
        declared = actual(type_)
        if declared.path in done:
            return
        done.add(declared.path)
        yield from chain.from_iterable(map(add, parts(declared)))
        if isinstance(declared.element, contracts.Structure):
            yield _of_structure(declared)
        elif isinstance(declared.element, contracts.Enumeration):
            yield _of_enumeration(declared, [enumerator.name for enumerator in declared.element.enumerators])

    yield from chain.from_iterable(map(add, types))


def field_names(declared: Declared) -> list[str]:
    """What the accessors of a structure or an exception are called."""
    element = declared.element
    assert isinstance(element, contracts.Structure | contracts.Exception_)
    names = [identifier(field.name) for field in element.fields]
    return [f"{name}_" if name == identifier(element.name) else name for name in names]


def fields_from(declared: Declared, items: str) -> str:
    """The arguments of the constructor of a structure or an exception, from ``items``, an expression for the values of its fields."""
    return ", ".join(from_value(part, f"{items}[{n}]") for n, part in enumerate(parts(declared)))


def fields_to(declared: Declared, whole: str) -> str:
    """The values of the fields of ``whole``, an expression for a structure or an exception."""
    fields = zip(field_names(declared), parts(declared), strict=True)
    return ", ".join(to_value(part, f"{whole}.{name}()") for name, part in fields)


def _of_structure(declared: Declared) -> str:
    type_, named = qualified(declared), bool(field_names(declared))
    taken = " value" * named
    read = f"    const Values& items = expect_values(value.as_list(), {len(field_names(declared))});"
    return _specialisation(
        type_,
        f"static Value to(const {type_}&{taken}) {{ return Value::list({{{fields_to(declared, 'value')}}}); }}",
        f"static {type_} from(const Value&{taken}) {{",
        *[read] * named,
        f"    return {type_}({fields_from(declared, 'items')});",
        "}",
    )


def _of_enumeration(declared: Declared, names: Sequence[str]) -> str:
    type_ = qualified(declared)
    spelled = [f"{type_}::{identifier(name)}" for name in names]
    return _specialisation(
        type_,
        f"static Value to({type_} value) {{",
        *(
            f'    if (value == {one}) {{ return Value::enumerator("{name}"); }}'
            for one, name in zip(spelled, names, strict=True)
        ),
        '    throw BAD_PARAMETER("the value is no enumerator");',
        "}",
        f"static {type_} from(const Value& value) {{",
        "    const ::std::string& name = value.as_enumerator();",
        *(f'    if (name == "{name}") {{ return {one}; }}' for one, name in zip(spelled, names, strict=True)),
        """    throw BAD_PARAMETER("there is no enumerator '" + name + "'");""",
        "}",
    )


def _specialisation(type_: str, *lines: str) -> str:
    return "\n".join(
        ["template <>", f"struct {instance('TypedValue', type_)} {{", *(f"    {one}" for one in lines), "};", ""]
    )
