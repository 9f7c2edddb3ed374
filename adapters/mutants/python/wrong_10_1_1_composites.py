"""Wrong frameworks, clause 10.1.1: structures, unions, arrays, sequences, aliases, and what is inside of others."""

from __future__ import annotations

import itertools
import math
import struct

from ucm_cts.adapters.contract.data_types import (
    Alias,
    AnyType,
    Array,
    Boolean,
    Datum,
    Float,
    Integer,
    Interface,
    Sequence,
    String,
    Structure,
    Union,
)
from ucm_cts.adapters.contract.data_values import components_of
from ucm_cts.adapters.contract.programming_model import UcmError
from ucm_cts.adapters.mutants.python.altering import carries, made_to
from ucm_cts.adapters.mutants.python.registry import Base, breaks
from ucm_cts.adapters.reference.python.connectors import Link

_CLAUSE = ("10.1.1",)
_REFUSED = ("R-10.1.2-02", "R-10.1.2-09", "R-10.1.5.1-01", "R-10.1.5.1-13", "R-10.1.6.1-20")
"""What a call, a push or a connection that is refused for its types breaks as well."""


@carries(made_to(Structure, lambda of, value: value[::-1]), "R-10.1.1-13")  # type: ignore[index]
class turns_structures_round(Base):
    """The fields of a structure arrive in the opposite order."""


def _second_as_first(of: AnyType, value: Datum) -> Datum:
    assert isinstance(of, Structure)
    assert isinstance(value, list)
    types = list(of.fields.values())
    return [value[0], value[0], *value[2:]] if types[:1] == types[1:2] else value


@carries(made_to(Structure, _second_as_first), "R-10.1.1-13", also=("R-10.1.1-07",))
class has_the_first_field_twice(Base):
    """A second field of the same type has the value of the first, which no message with another number shows."""


def _without_default(of: AnyType, value: Datum) -> Datum:
    assert isinstance(of, Union)
    assert isinstance(value, list)
    named = [enumerator for case in of.cases for enumerator in case.selectors]
    default = next((case for case in of.cases if case.default), None)
    return value if value[0] in named or default is None else [default.selectors[0], value[1]]


@carries(made_to(Union, _without_default), "R-10.1.1-14")
class loses_default_selectors(Base):
    """What arrives through the default case has the case's first selector."""


def _first_case(of: AnyType, value: Datum) -> Datum:
    assert isinstance(of, Union)
    assert isinstance(value, list)
    named = [enumerator for case in of.cases for enumerator in case.selectors]
    return value if value[0] in named else [value[0], _EMPTY.get(type(components_of(of, value)[0][1]), value[1])]


_EMPTY: dict[type, Datum] = {Integer: 0, Float: "00000000", String: ""}


@carries(made_to(Union, _first_case), "R-10.1.1-14")
class loses_the_default_case(Base):
    """What is selected by nobody but the default case arrives empty."""


# arrays, sequences


def _transposed(of: AnyType, value: Datum) -> Datum:
    assert isinstance(of, Array)
    assert isinstance(value, list)
    is_square = len(of.sizes) == 2 and of.sizes[0] == of.sizes[1]
    return [list(column) for column in zip(*value, strict=True)] if is_square else value


@carries(made_to(Array, _transposed), "R-10.1.1-15")
class transposes_arrays(Base):
    """Rows and columns of square arrays are exchanged."""


@carries(made_to(Array, lambda of, value: [value[0]] * len(value)), "R-10.1.1-15", also=("R-10.1.1-18",))  # type: ignore[index,arg-type]
class repeats_the_first_row(Base):
    """All rows of an array are like the first one."""


def _flat(of: AnyType, value: Datum) -> Datum:
    assert isinstance(of, Array)
    assert isinstance(value, list)
    return list(itertools.chain(*value)) if len(of.sizes) == 3 else value


@carries(made_to(Array, _flat), "R-10.1.1-15")
class flattens_cubes(Base):
    """Arrays of three dimensions lose the first."""


def _without_the_last(of: AnyType, value: Datum) -> Datum:
    assert isinstance(of, Sequence)
    assert isinstance(value, list)
    return value[: of.size - 1] if 1 < of.size == len(value) else value


@carries(made_to(Sequence, _without_the_last), "R-10.1.1-16")
class loses_the_last_element(Base):
    """A sequence of exactly its bound loses the last element."""


@carries(made_to(Sequence, lambda of, value: value[::-1]), "R-10.1.1-16")  # type: ignore[index]
class turns_sequences_round(Base):
    """Elements arrive in the opposite order."""


@carries(made_to(Sequence, lambda of, value: value[:255]), "R-10.1.1-16")  # type: ignore[index]
class counts_elements_in_an_octet(Base):
    """No sequence is longer than 255 elements."""


# aliases, types in types


def _one_octet(of: AnyType, value: Datum) -> Datum:
    assert isinstance(of, Sequence)
    assert isinstance(value, list)
    return [one and place < 8 for place, one in enumerate(value)] if isinstance(of.of, Boolean) else value


@carries(made_to(Sequence, _one_octet), "R-10.1.1-16")
class packs_flags_into_one_octet(Base):
    """The ninth BOOLEAN of a sequence is always false, and so are those after it."""


def _plain_numbers(of: AnyType, value: Datum) -> Datum:
    assert isinstance(of, Sequence)
    assert isinstance(value, list)
    if not isinstance(of.of, Float):
        return value
    form = ">f" if of.of.kind == "FLOAT" else ">d"
    numbers = [struct.unpack(form, bytes.fromhex(str(one)))[0] for one in value]
    spelled = map(str, value)
    return [
        one if math.isfinite(number) and (number or one[0] != "8") else "0" * len(one)
        for one, number in zip(spelled, numbers, strict=True)
    ]


@carries(made_to(Sequence, _plain_numbers), "R-10.1.1-16")
class writes_no_special_numbers_in_sequences(Base):
    """In sequences, infinities, NaNs and negative zeros arrive as zeros."""


@breaks("R-10.1.1-17", clauses=_CLAUSE, also=_REFUSED)
class refuses_aliases(Base):
    """Connectors cannot be bound to an interface that has an alias for a type."""

    def link(self, connector: str, interface: Interface) -> Link:
        types = [parameter.of for method in interface.methods.values() for parameter in method.parameters]
        if any(isinstance(of, Alias) for of in types):
            raise UcmError("what is an alias?")
        return super().link(connector, interface)


def _as_short(of: AnyType, value: Datum) -> Datum:
    return value & 0x7FFF if isinstance(value, int) and not isinstance(value, bool) else value


@carries(made_to(Alias, _as_short), "R-10.1.1-17")
class takes_aliases_for_shorts(Base):
    """An integer whose type is an alias has 15 bits."""


@carries(
    made_to(Alias, lambda of, value: "" if isinstance(value, str) and isinstance(of.of, String) else value),  # type: ignore[union-attr]
    "R-10.1.1-17",
)
class loses_renamed_strings(Base):
    """A string whose type is an alias arrives empty."""


class _RefusesDepth(Link):
    def send(self, method: str, arguments: list[Datum]) -> list[Datum]:  # type: ignore[override]
        types = [p.of for p in self.interface.methods[method].arguments]
        if any(_depth(of, value) > 1 for of, value in zip(types, arguments, strict=True)):
            raise UcmError("the value is too deep")
        return super().send(method, arguments)  # type: ignore[return-value]


def _depth(of: AnyType, value: Datum) -> int:
    composite = int(isinstance(of, Structure | Union | Array | Sequence))
    return composite + max((_depth(part, one) for _, part, one in components_of(of, value)), default=0)


@breaks("R-10.1.1-18", clauses=_CLAUSE, also=_REFUSED)
class refuses_types_in_types(Base):
    """Calls with structures, unions, arrays or sequences that contain others are refused."""

    link_class = _RefusesDepth


def _shallow(of: AnyType, value: Datum) -> Datum:
    """Sequences inside sequences and structures keep one element only."""
    if not isinstance(of, Structure | Sequence):
        return value

    def cut(inner: AnyType, one: Datum) -> Datum:
        return one[:1] if isinstance(inner, Sequence) and isinstance(one, list) else one

    inside = components_of(of, value)
    return [cut(part, one) for _, part, one in inside]


@carries(_shallow, "R-10.1.1-18", also=("R-10.1.1-16",))
class cuts_inner_sequences(Base):
    """A sequence inside a structure or a sequence arrives with its first element only; messages are mostly structures."""
