"""Checks whether data are values of a UCM type (9.2.3 to 9.2.5), and takes values apart."""

from __future__ import annotations

import json
from collections.abc import Iterator

import msgspec

from ucm_cts.adapters.contract import data_types as d

SCALARS = (d.Integer, d.Float, d.Char, d.Boolean, d.String, d.Enumeration)
"""Types whose values are not made of others."""

_DIGITS = {"FLOAT": 8, "DOUBLE": 16}
_MANTISSA = {"FLOAT": 23, "DOUBLE": 52}
_LARGEST = {"CHAR8": 0xFF, "CHAR32": 0x10FFFF}
_SURROGATES = range(0xD800, 0xE000)
_LONGEST = 60
"""The most characters of a value that are shown."""


def misfit(of: d.AnyType, value: object) -> str:
    """Why ``value`` is no value of type ``of``, naming the place inside; empty if it is one.

    Every reading of unclear places is taken at its widest: BYTE is signed, CHAR8 has eight bits, sequences any length.
    """
    match of:
        case d.Alias():
            return misfit(of.of, value)
        case d.Structure():
            return _misfit_of_structure(of, value)
        case d.Union():
            return _misfit_of_union(of, value)
        case d.Array():
            return _misfit_of_array(of.of, of.sizes, value)
        case d.Sequence():
            if not isinstance(value, list):
                return f"{printed(value, _LONGEST)} is no list"
            if 0 <= of.size < len(value):
                return f"{len(value)} elements are more than {of.size}"
            return _misfit_of_elements(of.of, value)
        case _:
            return _misfit_of_scalar(of, value)


def _misfit_of_scalar(of: d.AnyType, value: object) -> str:
    match of:
        case d.Boolean():
            fits = isinstance(value, bool)
        case d.Integer():
            low, high = d.integer_range(of.kind)
            fits = _is_integer(value, low, high)
        case d.Char():
            fits = _is_integer(value, 0, _LARGEST[of.kind]) and value not in _SURROGATES
        case d.Float():
            fits = isinstance(value, str) and _is_float(of, value)
        case d.Enumeration():
            fits = isinstance(value, str) and value in of.values
        case d.String():
            return _misfit_of_string(of, value)
        case _:
            fits = False
    return "" if fits else f"{printed(value, _LONGEST)} is no {kind_name(of)}"


def _is_integer(value: object, low: int, high: int) -> bool:
    return isinstance(value, int) and not isinstance(value, bool) and low <= value <= high


def _is_float(of: d.Float, value: str) -> bool:
    digits = len(value) == _DIGITS[of.kind] and set(value) <= set("0123456789abcdef")
    return digits and not (is_nan(of, value) and not int(value, 16) >> (_MANTISSA[of.kind] - 1) & 1)


def is_nan(of: d.Float, value: str) -> bool:
    """Are these the bits of a NaN? ``value`` has the right number of hexadecimal digits."""
    bits, mantissa = int(value, 16), _MANTISSA[of.kind]
    exponent = bits >> mantissa & (1 << len(value) * 4 - 1 - mantissa) - 1
    return exponent == (1 << len(value) * 4 - 1 - mantissa) - 1 and bits & ((1 << mantissa) - 1) != 0


def _misfit_of_string(of: d.String, value: object) -> str:
    if not isinstance(value, str):
        return f"{printed(value, _LONGEST)} is no string"
    if 0 <= of.size < len(value):
        return f"{len(value)} characters are more than {of.size}"
    wrong = {c for c in set(value) if not 0 < ord(c) <= _LARGEST[of.base] or ord(c) in _SURROGATES}
    first = next(c for c in value if c in wrong) if wrong else ""
    return f"U+{ord(first):04X} is no character of a {of.base} string" if first else ""


def _misfit_of_structure(of: d.Structure, value: object) -> str:
    if not isinstance(value, list) or len(value) != len(of.fields):
        return f"{printed(value, _LONGEST)} has not the {len(of.fields)} fields of {of.name}"
    for (name, field), one in zip(of.fields.items(), value, strict=True):
        problem = misfit(field, one)
        if problem:
            return f"{name}: {problem}"
    return ""


def _misfit_of_union(of: d.Union, value: object) -> str:
    if not isinstance(value, list) or len(value) != 2 or not isinstance(value[0], str):
        return f"{printed(value, _LONGEST)} is not [enumerator, value]"
    case = case_of(of, value[0])
    if case is None:
        return f"{of.name} has no case for {printed(value[0], _LONGEST)}"
    problem = misfit(case.of, value[1])
    return f"{case.name}: {problem}" if problem else ""


def _misfit_of_array(of: d.AnyType, sizes: tuple[int, ...], value: object) -> str:
    if not isinstance(value, list) or len(value) != sizes[0]:
        return f"{printed(value, _LONGEST)} has not {sizes[0]} elements"
    if len(sizes) == 1:
        return _misfit_of_elements(of, value)
    problems = (
        f"{index}: {problem}" for index, one in enumerate(value) if (problem := _misfit_of_array(of, sizes[1:], one))
    )
    return next(problems, "")


def _misfit_of_elements(of: d.AnyType, value: list[object]) -> str:
    return next((f"{index}: {problem}" for index, one in enumerate(value) if (problem := misfit(of, one))), "")


def case_of(union: d.Union, enumerator: str) -> d.UnionCase | None:
    """The case that ``enumerator`` selects; None if there is no such enumerator, or none of the cases is for it."""
    if enumerator not in union.selector.values:
        return None
    selected = [case for case in union.cases if enumerator in case.selectors]
    return next(iter(selected or [case for case in union.cases if case.default]), None)


def components_of(of: d.AnyType, value: d.Datum) -> list[tuple[str, d.AnyType, d.Datum]]:
    """The direct components of a value of ``of``: place, type and value; none of scalars. An alias has one, the value itself."""
    match of:
        case d.Alias():
            return [("", of.of, value)]
        case d.Structure():
            assert isinstance(value, list)
            return [(name, field, one) for (name, field), one in zip(of.fields.items(), value, strict=True)]
        case d.Union():
            assert isinstance(value, list)
            case = case_of(of, value[0])
            return [(case.name, case.of, value[1])] if case is not None else []
        case d.Array():
            return [(f"[{','.join(map(str, place))}]", of.of, one) for place, one in _flat(value, len(of.sizes))]
        case d.Sequence():
            return [(f"[{','.join(map(str, place))}]", of.of, one) for place, one in _flat(value, 1)]
        case _:
            return []


def parts(of: d.AnyType, value: d.Datum) -> Iterator[tuple[d.AnyType, d.Datum]]:
    """``value`` and everything inside it, each with its type, the outer before the inner."""
    yield of, value
    for _, part, one in components_of(of, value):
        yield from parts(part, one)


def flat(value: d.Datum, dimensions: int) -> list[d.Datum]:
    """The elements of an array of so many dimensions, row by row."""
    return [one for _, one in _flat(value, dimensions)]


def _flat(value: d.Datum, dimensions: int) -> Iterator[tuple[tuple[int, ...], d.Datum]]:
    assert isinstance(value, list)
    for index, one in enumerate(value):
        if dimensions == 1:
            yield (index,), one
        else:
            yield from (((index, *place), element) for place, element in _flat(one, dimensions - 1))


def a_value(of: d.AnyType) -> d.Datum:
    """A value of the type, for results that mean nothing: mostly zeros, with as few elements as may be."""
    match of:
        case d.Integer() | d.Char():
            return 0
        case d.Float():
            return "0" * (8 if of.kind == "FLOAT" else 16)
        case d.Boolean():
            return False
        case d.String():
            return ""
        case d.Enumeration():
            return next(iter(of.values))
        case d.Structure():
            return [a_value(field) for field in of.fields.values()]
        case d.Union():
            enumerator = next(name for name in of.selector.values if case_of(of, name) is not None)
            case = case_of(of, enumerator)
            assert case is not None
            return [enumerator, a_value(case.of)]
        case d.Array():
            made = a_value(of.of)
            for size in reversed(of.sizes):
                made = [_like(made) for _ in range(size)]
            return made
        case d.Alias():
            return a_value(of.of)
        case _:
            return []


def _like(value: d.Datum) -> d.Datum:
    return [_like(one) for one in value] if isinstance(value, list) else value


def spell(value: d.Datum) -> str:
    """A value as text, for attributes: JSON, as on the wire."""
    return msgspec.json.encode(value).decode()


def printed(value: object, longest: int = 0) -> str:
    """A value for people, spelled as in scenarios and reports; of one with more than ``longest`` characters the beginning and the
    length, unless ``longest`` is 0.
    """
    if value is None:
        return "nothing"
    text = json.dumps(value, ensure_ascii=False, default=str)
    text = text if text.isprintable() else json.dumps(value, default=str)
    if not 0 < longest < len(text):
        return text
    return f"{text[: longest - 20]}… ({len(value if isinstance(value, str) else text)} characters)"


def read_spelled(text: str | None) -> d.Datum | None:
    """The value that ``text`` spells; None if it is any other text."""
    try:
        value: d.Datum = msgspec.json.decode(text or "", type=d.Datum)
    except msgspec.MsgspecError:
        return None
    return value


def kind_name(of: d.AnyType) -> str:
    """The kind of the type, in the words of 9.2: LONGLONG, CHAR8 string, enumeration, structure, ..."""
    match of:
        case d.Integer() | d.Float() | d.Char():
            return of.kind
        case d.String():
            return f"{of.base} string"
        case _:
            return type(of).__name__.lower()
