"""Corner values of UCM types: the bounds, the empty and the full, each enumerator, each case, values that other formats lose."""

from __future__ import annotations

import struct
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from itertools import cycle, islice
from types import MappingProxyType

from ucm_cts.adapters.contract import data_types as d
from ucm_cts.adapters.contract.data_values import case_of
from ucm_cts.harness.catalogue.requirements import load_interpretations

Readings = Mapping[str, str]
"""Values of options of ``suite/interpretations/clause_10_1.yaml``; an option that is missing has its first value."""

UNDECLARED: Readings = MappingProxyType({})
"""The readings of a vendor who declares nothing."""

LONG_STRING = 1025
"""Characters of an unbounded string that counts as long."""

LONGEST_STRING = 65_536
"""Characters of one that is longer than 16 bits can count."""

LONG_SEQUENCE = 1000
"""Elements of an unbounded sequence that counts as long."""

_OCTET = 256
"""More elements than an octet can count."""

_MOST_COMBINATIONS = 12


def reading_of(option: str, readings: Readings) -> str:
    """The value that ``option`` has. Raises ``KeyError`` for an unknown one."""
    if option in readings:
        return readings[option]
    return next(i.options[option][0] for i in load_interpretations() if option in i.options)


def largest_character(kind: str, readings: Readings) -> int:
    """The last code point of CHAR8 or CHAR32 that is sent."""
    if kind == "CHAR8":
        return 0xFF if reading_of("char8", readings) == "byte" else 0x7F
    return 0xFFFF if reading_of("char32", readings) == "bmp" else 0x10FFFF


def bounds(of: d.Integer, readings: Readings) -> tuple[int, int]:
    """The least and the greatest integer that is sent."""
    low, high = d.integer_range(of.kind)
    return (0 if of.kind == "BYTE" and reading_of("byte", readings) == "unsigned" else low), high


def lengths(of: d.Sequence, readings: Readings, longest: int) -> tuple[int, int]:
    """How few and how many elements are sent; ``longest`` is for unbounded ones."""
    if of.size < 0:
        return 0, longest
    return (of.size if reading_of("bounded-sequence", readings) == "full-only" else 0), of.size


def corners(of: d.AnyType, readings: Readings = UNDECLARED) -> list[d.Datum]:
    """Corner values of ``of``, the simplest first; at least one."""
    match of:
        case d.Alias():
            return corners(of.of, readings)
        case d.Integer():
            return _of_integer(of, readings)
        case d.Float():
            return list(_FLOAT_CORNERS[of.kind].split())
        case d.Char():
            return _of_char(of, readings)
        case d.Boolean():
            return [False, True]
        case d.String():
            return _of_string(of, readings)
        case d.Enumeration():
            return list(of.values)
        case d.Structure():
            return list(_combined([corners(field, readings) for field in of.fields.values()]))
        case d.Union():
            return _of_union(of, readings)
        case d.Array():
            return [_array(of.sizes, _dealer(corners(of.of, readings), start)) for start in range(3)]
        case d.Sequence():
            return _of_sequence(of, readings)


def float_bits(kind: str, value: float) -> str:
    """How ``value`` travels; it is rounded to FLOAT where that is wanted."""
    return struct.pack(">f" if kind == "FLOAT" else ">d", value).hex()


def _of_integer(of: d.Integer, readings: Readings) -> list[d.Datum]:
    low, high = bounds(of, readings)
    powers = [2**bits for bits in (7, 8, 15, 16, 31, 32, 53, 63)]
    candidates = [
        0,
        1,
        -1,
        *(n for power in powers for n in (power - 1, power, power + 1, -power, -power - 1)),
        low,
        high,
    ]
    return sorted({n for n in candidates if low <= n <= high}, key=lambda n: (abs(n), n < 0))


_FLOAT_CORNERS = {
    "FLOAT": (
        "00000000 80000000 3f800000 bf800000 3dcccccd 3f800001 4b7fffff 00800000 007fffff 00000001 80000001 "
        "7f7fffff ff7fffff 7f800000 ff800000 7fc00000 ffc00000 7fd23456 7fffffff ffd54321"
    ),
    "DOUBLE": (
        "0000000000000000 8000000000000000 3ff0000000000000 bff0000000000000 3fb999999999999a 3ff0000000000001 "
        "4340000000000001 7e37e43c8800759c 0010000000000000 000fffffffffffff 0000000000000001 8000000000000001 "
        "36a0000000000000 7fefffffffffffff ffefffffffffffff 7ff0000000000000 fff0000000000000 7ff8000000000000 "
        "fff8000000000000 7ff923456789abcd 7fffffffffffffff fffabcdef0123456"
    ),
}
"""Zeros, ones, a tenth, the least step above one, great integers, subnormals, the greatest, infinities, quiet NaNs."""


def _of_char(of: d.Char, readings: Readings) -> list[d.Datum]:
    last = largest_character(of.kind, readings)
    candidates = (0x61, 0x41, 0x20, 0x0A, 0x22, 0x5C, 0, 1, 0x7F, 0x80, 0xE9, 0xFF, 0x100, 0x20AC, 0xD7FF, 0xE000)
    beyond = (0xFEFF, 0xFFFD, 0xFFFF, 0x10000, 0x1F600, 0x10FFFF)
    return [c for c in (*candidates, *beyond) if c <= last]


def _of_string(of: d.String, readings: Readings) -> list[d.Datum]:
    last = largest_character(of.base, readings)
    size = of.size if of.size >= 0 else LONG_STRING
    alphabet = [chr(c) for c in _of_char(d.Char(of.base), readings) if isinstance(c, int) and c > 0]
    shapes = [
        "",
        "a",
        " a ",
        "  ",
        "null",
        "\"\\/'",
        "\t\r\n",
        "<&>%s",
        "0",
        alphabet[-1],
        "é",
        "e\u0301",
        "".join(alphabet),
    ]
    full = ["".join(alphabet[(i * 5 + 1) % len(alphabet)] for i in range(size)), "x" * size, "x" * (size - 1) + " "]
    full += ["y" * LONGEST_STRING] if of.size < 0 else []
    kept = [
        text for text in shapes + full if (of.size < 0 or len(text) <= size) and (not text or ord(max(text)) <= last)
    ]
    return list(dict.fromkeys(kept))


def _combined(columns: Sequence[Sequence[d.Datum]]) -> list[list[d.Datum]]:
    """Rows with the values of each column, from the first to the last if there are too many; neighbours are seldom alike."""
    rows = min(max(map(len, columns)), _MOST_COMBINATIONS)
    return [[_spread(column, row, rows, place) for place, column in enumerate(columns)] for row in range(rows)]


def _spread(values: Sequence[d.Datum], row: int, rows: int, place: int) -> d.Datum:
    """The value of a row, when many values are spread over few rows; each place begins at another one."""
    index = row * (len(values) - 1) // (rows - 1) if len(values) > rows > 1 else row
    return values[(index + place) % len(values)]


def _of_union(of: d.Union, readings: Readings) -> list[d.Datum]:
    values: list[d.Datum] = []
    for enumerator in of.selector.values:
        case = case_of(of, enumerator)
        if case is not None:
            ends = corners(case.of, readings)
            values += [[enumerator, ends[0]], [enumerator, ends[len(ends) // 2]], [enumerator, ends[-1]]]
    return values


def _array(sizes: tuple[int, ...], element: Callable[[], d.Datum]) -> list[d.Datum]:
    if len(sizes) == 1:
        return [element() for _ in range(sizes[0])]
    return [_array(sizes[1:], element) for _ in range(sizes[0])]


def _dealer(values: Sequence[d.Datum], start: int) -> Callable[[], d.Datum]:
    """Gives the values one by one, again and again, beginning somewhere."""
    return partial(next, islice(cycle(values), start * 5 % len(values), None))


def _of_sequence(of: d.Sequence, readings: Readings) -> list[d.Datum]:
    least, most = lengths(of, readings, LONG_SEQUENCE)
    elements = corners(of.of, readings)
    some = (_OCTET,) if of.size < 0 else (most // 2, most - 1)
    wanted = sorted({n for n in (least, 1, 2, *some, most) if least <= n <= most})
    if of.size < 0 and isinstance(of.of, d.Structure | d.Union | d.Array | d.Sequence):
        wanted = [n for n in wanted if n <= 2] + [5]
    return [_array((length,), _dealer(elements, length)) for length in wanted]
