"""Draws values from UCM types: at random for a run, or as a strategy of hypothesis, which can shrink them.

Both make the same choices: each is one integer out of a range, and the one nearest to zero is the simplest.
"""

from __future__ import annotations

import random
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from ucm_cts.adapters.contract.data_types import (
    Alias,
    AnyType,
    Array,
    Boolean,
    Char,
    Datum,
    Enumeration,
    Float,
    Integer,
    Sequence,
    String,
    Structure,
    Union,
)
from ucm_cts.adapters.contract.data_values import case_of
from ucm_cts.harness.corner_values import UNDECLARED, Readings, bounds, corners, float_bits, largest_character, lengths

if TYPE_CHECKING:
    from hypothesis import strategies as st

Choose = Callable[[int, int], int]
"""Gives an integer between two, both included."""

_USUAL_STRING, _USUAL_SEQUENCE = 30, 6
"""The greatest length that is drawn where a type has no bound, and where it has a greater one."""

_SURROGATES = range(0xD800, 0xE000)
_FIRST_CHARACTERS = "abc "


def values(of: AnyType, readings: Readings = UNDECLARED) -> st.SearchStrategy[Datum]:
    """All values of ``of`` within the readings; corner values come often."""
    from hypothesis import strategies as st  # it takes a while, and runs without a failure do without

    @st.composite
    def drawn(draw: st.DrawFn) -> Datum:
        return value_of(of, lambda low, high: draw(st.integers(low, high)), readings)

    return st.one_of(drawn(), st.sampled_from(corners(of, readings)))


def draw(of: AnyType, number: int, seed: str, readings: Readings = UNDECLARED) -> list[Datum]:
    """So many values of ``of``, the same for the same seed."""
    source = random.Random(seed)

    def choose(low: int, high: int) -> int:
        if source.random() < 0.7:
            return source.randint(low, high)
        near = source.choice((low, high, 0, 1, -1, 2 ** source.randrange(64), -(2 ** source.randrange(64))))
        return min(max(near, low), high)

    return [value_of(of, choose, readings) for _ in range(number)]


def value_of(of: AnyType, choose: Choose, readings: Readings) -> Datum:
    """One value of ``of``, as ``choose`` decides."""
    return _DRAWN[type(of)](of, choose, readings)


def _of_alias(of: Alias, choose: Choose, readings: Readings) -> Datum:
    return value_of(of.of, choose, readings)


def _of_integer(of: Integer, choose: Choose, readings: Readings) -> Datum:
    return choose(*bounds(of, readings))


def _of_float(of: Float, choose: Choose, readings: Readings) -> Datum:
    sort = choose(0, 3)
    if sort == 0:
        return float_bits(of.kind, float(choose(-1000, 1000)))
    if sort == 1:
        return float_bits(of.kind, choose(-(2**20), 2**20) / 1024)
    digits, mantissa = (8, 23) if of.kind == "FLOAT" else (16, 52)
    sign = choose(0, 1) << (digits * 4 - 1)
    greatest = (1 << (digits * 4 - 1 - mantissa)) - 1
    if sort == 2:
        rest = choose(0, (greatest << mantissa) - 1)
    else:  # a quiet NaN
        rest = greatest << mantissa | 1 << (mantissa - 1) | choose(0, (1 << (mantissa - 1)) - 1)
    return f"{sign | rest:0{digits}x}"


def _of_char(of: Char, choose: Choose, readings: Readings) -> Datum:
    return _character(of.kind, choose, readings, 0)


def _character(kind: str, choose: Choose, readings: Readings, least: int) -> int:
    """The simplest characters are letters, the rest follows by code point."""
    sort = choose(0, 2)
    if sort == 0:
        return ord(_FIRST_CHARACTERS[choose(0, len(_FIRST_CHARACTERS) - 1)])
    largest = largest_character(kind, readings)
    point = choose(least, min(largest, 0x7F if sort == 1 else largest))
    return point if point not in _SURROGATES else point - len(_SURROGATES)


def _of_boolean(of: Boolean, choose: Choose, readings: Readings) -> Datum:
    return choose(0, 1) == 1


def _of_string(of: String, choose: Choose, readings: Readings) -> Datum:
    length = choose(0, _USUAL_STRING if of.size < 0 else min(of.size, _USUAL_STRING))
    return "".join(chr(_character(of.base, choose, readings, 1)) for _ in range(length))


def _of_enumeration(of: Enumeration, choose: Choose, readings: Readings) -> Datum:
    return list(of.values)[choose(0, len(of.values) - 1)]


def _of_structure(of: Structure, choose: Choose, readings: Readings) -> Datum:
    return [value_of(field, choose, readings) for field in of.fields.values()]


def _of_union(of: Union, choose: Choose, readings: Readings) -> Datum:
    covered = [(enumerator, case) for enumerator in of.selector.values if (case := case_of(of, enumerator))]
    enumerator, case = covered[choose(0, len(covered) - 1)]
    return [enumerator, value_of(case.of, choose, readings)]


def _of_array(of: Array, choose: Choose, readings: Readings) -> Datum:
    def dimension(sizes: tuple[int, ...]) -> Datum:
        if not sizes:
            return value_of(of.of, choose, readings)
        return [dimension(sizes[1:]) for _ in range(sizes[0])]

    return dimension(of.sizes)


def _of_sequence(of: Sequence, choose: Choose, readings: Readings) -> Datum:
    least, most = lengths(of, readings, _USUAL_SEQUENCE)
    length = choose(least, max(least, min(most, _USUAL_SEQUENCE)))
    return [value_of(of.of, choose, readings) for _ in range(length)]


_DRAWN: dict[type, Callable[[Any, Choose, Readings], Datum]] = {
    Alias: _of_alias,
    Integer: _of_integer,
    Float: _of_float,
    Char: _of_char,
    Boolean: _of_boolean,
    String: _of_string,
    Enumeration: _of_enumeration,
    Structure: _of_structure,
    Union: _of_union,
    Array: _of_array,
    Sequence: _of_sequence,
}
