"""Draws values from UCM types: at random for a run, or as a strategy of hypothesis, which can shrink them.

Both make the same choices: each is one integer out of a range, and the one nearest to zero is the simplest.
"""

from __future__ import annotations

import random
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

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

    To find smaller values than ``around``, strings and sequences get as long as in it, and corner values,
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
    choose = source.choose
    match of:
        case d.Alias():
            return _value(of.of, source)
        case d.Integer():
            return choose(*corner.bounds(of, source.readings))
        case d.Float():
            return _float(of, choose)
        case d.Char():
            return _character(of.kind, source, 0)
        case d.Boolean():
            return choose(0, 1) == 1
        case d.String():
            longest = source.longest_string
            length = choose(0, longest if of.size < 0 else min(of.size, longest))
            return "".join(chr(_character(of.base, source, 1)) for _ in range(length))
        case d.Enumeration():
            return list(of.values)[choose(0, len(of.values) - 1)]
        case d.Structure():
            return [_value(field, source) for field in of.fields.values()]
        case d.Union():
            covered = [(enumerator, case) for enumerator in of.selector.values if (case := case_of(of, enumerator))]
            enumerator, chosen = covered[choose(0, len(covered) - 1)]
            return [enumerator, _value(chosen.of, source)]
        case d.Array():
            return _array(of.of, of.sizes, source)
        case d.Sequence():
            longest = source.longest_sequence
            least, most = corner.lengths(of, source.readings, longest)
            return [_value(of.of, source) for _ in range(choose(least, max(least, min(most, longest))))]


def _array(of: d.AnyType, sizes: tuple[int, ...], source: _Source) -> d.Datum:
    return [_array(of, sizes[1:], source) for _ in range(sizes[0])] if sizes else _value(of, source)


def _float(of: d.Float, choose: Choose) -> d.Datum:
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


def _character(kind: str, source: _Source, least: int) -> int:
    """The simplest characters are letters, the rest follows by code point."""
    sort = source.choose(0, 2)
    if sort == 0:
        return ord(_FIRST_CHARACTERS[source.choose(0, len(_FIRST_CHARACTERS) - 1)])
    largest = corner.largest_character(kind, source.readings)
    point = source.choose(least, min(largest, 0x7F if sort == 1 else largest))
    return point if point not in _SURROGATES else point - len(_SURROGATES)
