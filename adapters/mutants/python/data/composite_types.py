"""Wrong frameworks, clause 10.1.1: structures, unions, arrays, sequences, aliases, and types inside types."""

from __future__ import annotations

import collections.abc
import itertools
import math
import struct
from collections.abc import Mapping
from typing import Any

from ucm_cts.adapters.contract import data_types as d
from ucm_cts.adapters.contract.data_values import components_of
from ucm_cts.adapters.contract.programming_model import UcmError
from ucm_cts.adapters.mutants.python.altering import carries, made_to, register_carried
from ucm_cts.adapters.mutants.python.methods import replaces
from ucm_cts.adapters.mutants.python.registry import Base, Row
from ucm_cts.adapters.reference.python.connectors import Link

_CLAUSE = ("10.1.1",)
_REFUSED = ("R-10.1.2-02", "R-10.1.2-09", "R-10.1.5.1-01", "R-10.1.5.1-13", "R-10.1.6.1-20")
"""What a call, a push or a connection that is refused for its types breaks as well."""


@carries("R-10.1.1-13", d.Structure, also=("R-10.1.1-07",))
def has_the_first_field_twice(of: Any, value: Any) -> Any:
    """A second field of the same type arrives with the value of the first."""
    types = list(of.fields.values())
    return [value[0], value[0], *value[2:]] if types[:1] == types[1:2] else value


@carries("R-10.1.1-14", d.Union)
def loses_default_selectors(of: Any, value: Any) -> Any:
    """A union of the default case arrives with the first selector of that case."""
    named = [enumerator for case in of.cases for enumerator in case.selectors]
    default = next((case for case in of.cases if case.default), None)
    return value if value[0] in named or default is None else [default.selectors[0], value[1]]


@carries("R-10.1.1-14", d.Union)
def loses_the_default_case(of: Any, value: Any) -> Any:
    """A value of a selector that only the default case covers arrives empty."""
    named = [enumerator for case in of.cases for enumerator in case.selectors]
    return value if value[0] in named else [value[0], _EMPTY.get(type(components_of(of, value)[0][1]), value[1])]


_EMPTY: dict[type, d.Datum] = {d.Integer: 0, d.Float: "00000000", d.String: ""}


# arrays, sequences


@carries("R-10.1.1-15", d.Array)
def transposes_arrays(of: Any, value: Any) -> Any:
    """Rows and columns of square arrays are exchanged."""
    is_square = len(of.sizes) == 2 and of.sizes[0] == of.sizes[1]
    return [list(column) for column in zip(*value, strict=True)] if is_square else value


@carries("R-10.1.1-15", d.Array)
def flattens_cubes(of: Any, value: Any) -> Any:
    """Arrays of three dimensions lose the first."""
    return list(itertools.chain(*value)) if len(of.sizes) == 3 else value


@carries("R-10.1.1-16", d.Sequence)
def loses_the_last_element(of: Any, value: Any) -> Any:
    """A sequence of exactly its bound loses the last element."""
    return value[: of.size - 1] if 1 < of.size == len(value) else value


# aliases, types in types


def _one_octet(of: Any, value: Any) -> Any:
    return [one and place < 8 for place, one in enumerate(value)] if isinstance(of.of, d.Boolean) else value


@carries("R-10.1.1-16", d.Sequence)
def writes_no_special_numbers_in_sequences(of: Any, value: Any) -> Any:
    """In sequences, infinities, NaNs and negative zeros arrive as zeros."""
    if not isinstance(of.of, d.Float):
        return value
    form = ">f" if of.of.kind == "FLOAT" else ">d"
    numbers = [struct.unpack(form, bytes.fromhex(str(one)))[0] for one in value]
    spelled = map(str, value)
    return [
        one if math.isfinite(number) and (number or one[0] != "8") else "0" * len(one)
        for one, number in zip(spelled, numbers, strict=True)
    ]


@replaces("link", "R-10.1.1-17", clauses=_CLAUSE, also=_REFUSED)
def refuses_aliases(self: Base, connector: str, interface: d.Interface) -> Link:
    """Connectors cannot be bound to an interface that has an alias for a type."""
    types = [parameter.of for method in interface.methods.values() for parameter in method.parameters]
    if any(isinstance(of, d.Alias) for of in types):
        raise UcmError("what is an alias?")
    return Base.link(self, connector, interface)


@carries("R-10.1.1-17", d.Alias)
def takes_aliases_for_shorts(of: Any, value: Any) -> Any:
    """An integer whose type is an alias has 15 bits."""
    return value & 0x7FFF if isinstance(value, int) and not isinstance(value, bool) else value


def _depth(of: d.AnyType, value: d.Datum) -> int:
    composite = int(isinstance(of, d.Structure | d.Union | d.Array | d.Sequence))
    return composite + max((_depth(part, one) for _, part, one in components_of(of, value)), default=0)


@replaces("send", "R-10.1.1-18", clauses=_CLAUSE, also=_REFUSED)
def refuses_types_in_types(self: Link, method: str, arguments: collections.abc.Sequence[d.Datum]) -> Any:
    """Calls with structures, unions, arrays or sequences that contain others are refused."""
    types = [p.of for p in self.interface.methods[method].arguments]
    if any(_depth(of, value) > 1 for of, value in zip(types, arguments, strict=True)):
        raise UcmError("the value is too deep")
    return Link.send(self, method, arguments)


@carries("R-10.1.1-18", also=("R-10.1.1-16",))
def cuts_inner_sequences(of: Any, value: Any) -> Any:
    """A sequence inside a structure or a sequence arrives with its first element only."""
    if not isinstance(of, d.Structure | d.Sequence):
        return value

    def cut(inner: d.AnyType, one: d.Datum) -> d.Datum:
        return one[:1] if isinstance(inner, d.Sequence) and isinstance(one, list) else one

    inside = components_of(of, value)
    return [cut(part, one) for _, part, one in inside]


CARRIED: Mapping[str, Row] = {
    "turns_structures_round": Row(
        "R-10.1.1-13",
        "The fields of a structure arrive in the opposite order.",
        made_to(d.Structure, lambda of, value: value[::-1]),
    ),
    "repeats_the_first_row": Row(
        "R-10.1.1-15",
        "All rows of an array are like the first one.",
        made_to(d.Array, lambda of, value: [value[0]] * len(value)),
        also=("R-10.1.1-18",),
    ),
    "turns_sequences_round": Row(
        "R-10.1.1-16", "Elements arrive in the opposite order.", made_to(d.Sequence, lambda of, value: value[::-1])
    ),
    "counts_elements_in_an_octet": Row(
        "R-10.1.1-16", "No sequence is longer than 255 elements.", made_to(d.Sequence, lambda of, value: value[:255])
    ),
    "packs_flags_into_one_octet": Row(
        "R-10.1.1-16",
        "From the ninth element on, every BOOLEAN of a sequence arrives as false.",
        made_to(d.Sequence, _one_octet),
    ),
    "loses_renamed_strings": Row(
        "R-10.1.1-17",
        "A string whose type is an alias arrives empty.",
        made_to(d.Alias, lambda of, value: "" if isinstance(value, str) and isinstance(of.of, d.String) else value),
    ),
}
register_carried(CARRIED)
