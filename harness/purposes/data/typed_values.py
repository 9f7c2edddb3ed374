"""Draws values from UCM types: at random for a run, or as a strategy of hypothesis, which can shrink them.

Both make the same choices: each is one integer out of a range, and the one nearest to zero is the simplest.
"""

from __future__ import annotations

import random
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ucm_cts.adapters.contract import data_types as d
from ucm_cts.adapters.contract.data_values import case_of, parts
from ucm_cts.harness.purposes.data import corner_values as corner

if TYPE_CHECKING:
    from hypothesis import strategies as st

Choose = Callable[[int, int], int]
"""Gives an integer between two, both included."""

_USUAL_STRING, _USUAL_SEQUENCE = 30, 6
"""The greatest lengths that are drawn by default."""

_SURROGATES = range(0xD800, 0xE000)
_FIRST_CHARACTERS = "abc "


@dataclass(frozen=True)
class _Source:
    """The source of values: the chooser, the readings, and the lengths of strings and sequences."""

    choose: Choose
    readings: corner.Readings
    longest_string: int = _USUAL_STRING
    longest_sequence: int = _USUAL_SEQUENCE


def values(
    of: d.AnyType, readings: corner.Readings = corner.UNDECLARED, around: d.Datum | None = None
) -> st.SearchStrategy[d.Datum]:
    """All values of ``of`` within the readings; corner values come often.

    Where smaller ones than a value ``around`` are looked for, strings and sequences get as long as in it, and corner values,
    which do not shrink, are left out.
    """
    from hypothesis import strategies as st  # it takes a while, and runs without a failure do without

    inside = [value for _, value in parts(of, around)] if around is not None else []
    longest_string = max((len(value) for value in inside if isinstance(value, str)), default=0)
    longest_sequence = max((len(value) for value in inside if isinstance(value, list)), default=0)

    @st.composite
    def drawn(draw: st.DrawFn) -> d.Datum:
        source = _Source(
            lambda low, high: draw(st.integers(low, high)),
            readings,
            max(_USUAL_STRING, longest_string),
            max(_USUAL_SEQUENCE, longest_sequence),
        )
        return _value(of, source)

    return drawn() if around is not None else st.one_of(drawn(), st.sampled_from(corner.corners(of, readings)))


def draw(of: d.AnyType, number: int, seed: str, readings: corner.Readings = corner.UNDECLARED) -> list[d.Datum]:
    """So many values of ``of``, the same for the same seed."""
    chance = random.Random(seed)

    def choose(low: int, high: int) -> int:
        if chance.random() < 0.7:
            return chance.randint(low, high)
        near = chance.choice((low, high, 0, 1, -1, 2 ** chance.randrange(64), -(2 ** chance.randrange(64))))
        return min(max(near, low), high)

    return [_value(of, _Source(choose, readings)) for _ in range(number)]


def _value(of: d.AnyType, source: _Source) -> d.Datum:
    """One value of ``of``."""
    return _DRAWN[type(of)](of, source)


def _of_alias(of: d.Alias, source: _Source) -> d.Datum:
    return _value(of.of, source)


def _of_integer(of: d.Integer, source: _Source) -> d.Datum:
    return source.choose(*corner.bounds(of, source.readings))


def _of_float(of: d.Float, source: _Source) -> d.Datum:
    choose = source.choose
    sort = choose(0, 3)
    if sort == 0:
        return corner.float_bits(of.kind, float(choose(-1000, 1000)))
    if sort == 1:
        return corner.float_bits(of.kind, choose(-(2**20), 2**20) / 1024)
    digits, mantissa = (8, 23) if of.kind == "FLOAT" else (16, 52)
    sign = choose(0, 1) << (digits * 4 - 1)
    greatest = (1 << (digits * 4 - 1 - mantissa)) - 1
    if sort == 2:
        rest = choose(0, (greatest << mantissa) - 1)
    else:  # a quiet NaN
        rest = greatest << mantissa | 1 << (mantissa - 1) | choose(0, (1 << (mantissa - 1)) - 1)
    return f"{sign | rest:0{digits}x}"


def _of_char(of: d.Char, source: _Source) -> d.Datum:
    return _character(of.kind, source, 0)


def _character(kind: str, source: _Source, least: int) -> int:
    """The simplest characters are letters, the rest follows by code point."""
    sort = source.choose(0, 2)
    if sort == 0:
        return ord(_FIRST_CHARACTERS[source.choose(0, len(_FIRST_CHARACTERS) - 1)])
    largest = corner.largest_character(kind, source.readings)
    point = source.choose(least, min(largest, 0x7F if sort == 1 else largest))
    return point if point not in _SURROGATES else point - len(_SURROGATES)


def _of_boolean(of: d.Boolean, source: _Source) -> d.Datum:
    return source.choose(0, 1) == 1


def _of_string(of: d.String, source: _Source) -> d.Datum:
    longest = source.longest_string
    length = source.choose(0, longest if of.size < 0 else min(of.size, longest))
    return "".join(chr(_character(of.base, source, 1)) for _ in range(length))


def _of_enumeration(of: d.Enumeration, source: _Source) -> d.Datum:
    return list(of.values)[source.choose(0, len(of.values) - 1)]


def _of_structure(of: d.Structure, source: _Source) -> d.Datum:
    return [_value(field, source) for field in of.fields.values()]


def _of_union(of: d.Union, source: _Source) -> d.Datum:
    covered = [(enumerator, case) for enumerator in of.selector.values if (case := case_of(of, enumerator))]
    enumerator, case = covered[source.choose(0, len(covered) - 1)]
    return [enumerator, _value(case.of, source)]


def _of_array(of: d.Array, source: _Source) -> d.Datum:
    def dimension(sizes: tuple[int, ...]) -> d.Datum:
        if not sizes:
            return _value(of.of, source)
        return [dimension(sizes[1:]) for _ in range(sizes[0])]

    return dimension(of.sizes)


def _of_sequence(of: d.Sequence, source: _Source) -> d.Datum:
    longest = source.longest_sequence
    least, most = corner.lengths(of, source.readings, longest)
    length = source.choose(least, max(least, min(most, longest)))
    return [_value(of.of, source) for _ in range(length)]


_DRAWN: dict[type, Callable[[Any, _Source], d.Datum]] = {
    d.Alias: _of_alias,
    d.Integer: _of_integer,
    d.Float: _of_float,
    d.Char: _of_char,
    d.Boolean: _of_boolean,
    d.String: _of_string,
    d.Enumeration: _of_enumeration,
    d.Structure: _of_structure,
    d.Union: _of_union,
    d.Array: _of_array,
    d.Sequence: _of_sequence,
}
