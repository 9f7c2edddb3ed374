"""Wrong frameworks, clause 10.1.1: values that connectors lose, shorten or refuse; attributes that are not there in time."""

from __future__ import annotations

import itertools
import math
import struct
from collections.abc import Callable, Mapping

from derived.altering import Change, changing
from derived.registry import Base, breaks_core, core_variant_of
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
    Interface,
    Sequence,
    String,
    Structure,
    Union,
)
from ucm_cts.adapters.contract.data_values import components_of, read_spelled, spell
from ucm_cts.adapters.contract.programming_model import UcmError
from ucm_cts.adapters.reference_py.connectors import Link
from ucm_cts.adapters.reference_py.framework import Member

_CLAUSE = ("10.1.1",)
_REFUSED = ("R-10.1.2-02", "R-10.1.2-09", "R-10.1.5.1-01", "R-10.1.5.1-13", "R-10.1.6.1-20")
"""What a call, a push or a connection that is refused for its types breaks as well."""


def _carries(
    change: Change, *requirements: str, also: tuple[str, ...] = (), readings: Mapping[str, str] = {}
) -> Callable[[type], type]:
    """Register a framework whose connectors make ``change`` to every value."""

    def register(mixin: type) -> type:
        mixin.link_class = changing(change)  # type: ignore[attr-defined]
        return breaks_core(*requirements, clauses=_CLAUSE, also=also, readings=readings)(mixin)

    return register


def _of(kind: type, change: Change, *kinds: str) -> Change:
    """``change``, made to values of one sort of types only."""

    def only(of: AnyType, value: Datum) -> Datum:
        return change(of, value) if isinstance(of, kind) and (not kinds or of.kind in kinds) else value  # type: ignore[attr-defined]

    return only


# integers


def _in_bits(bits: int, signed: bool) -> Change:
    def cut(of: AnyType, value: Datum) -> Datum:
        assert isinstance(value, int)
        rest = value & (2**bits - 1)
        return rest - 2**bits if signed and rest >= 2 ** (bits - 1) else rest

    return cut


@_carries(_of(Integer, _in_bits(32, True), "LONGLONG"), "R-10.1.1-07")
class cuts_integers_to_32_bits(Base):
    """LONGLONG has 32 bits on its way."""


@_carries(_of(Integer, _in_bits(8, False), "BYTE"), "R-10.1.1-07")
class takes_bytes_for_octets(Base):
    """A negative BYTE arrives as what an octet of the same bits is."""


@_carries(_of(Integer, _in_bits(64, True), "ULONGLONG"), "R-10.1.1-07")
class has_no_great_unsigned_integers(Base):
    """ULONGLONG goes through a signed integer of 64 bits."""


@_carries(_of(Integer, lambda of, value: int(float(value))), "R-10.1.1-07")  # type: ignore[arg-type]
class sends_integers_as_doubles(Base):
    """Integers go through a double, as those who send JSON to JavaScript have it."""


# floating-point numbers


def _through(convert: Callable[[float], float], *kinds: str) -> Change:
    def change(of: AnyType, value: Datum) -> Datum:
        assert isinstance(value, str)
        assert isinstance(of, Float)
        layout = ">f" if of.kind == "FLOAT" else ">d"
        (number,) = struct.unpack(layout, bytes.fromhex(value))
        if math.isnan(number):
            return value
        converted = convert(number)
        return value if converted == number and str(converted) == str(number) else struct.pack(layout, converted).hex()

    return _of(Float, change, *kinds)


def _single(number: float) -> float:
    try:
        return float(struct.unpack(">f", struct.pack(">f", number))[0])
    except OverflowError:
        return float("inf") if number > 0 else float("-inf")


def _one_nan(of: AnyType, value: Datum) -> Datum:
    (number,) = struct.unpack(">f" if of.kind == "FLOAT" else ">d", bytes.fromhex(value))  # type: ignore[union-attr,arg-type]
    return value if not math.isnan(number) else "7fc00000" if of.kind == "FLOAT" else "7ff8000000000000"  # type: ignore[union-attr]


@_carries(_through(_single, "DOUBLE"), "R-10.1.1-08")
class sends_doubles_as_floats(Base):
    """DOUBLE goes through single precision."""


@_carries(_through(lambda number: number + 0.0), "R-10.1.1-08")
class knows_one_zero(Base):
    """Minus zero arrives as zero."""


@_carries(_through(lambda number: number if abs(number) >= 2**-126 else 0.0, "FLOAT"), "R-10.1.1-08")
class flushes_subnormals(Base):
    """A subnormal FLOAT arrives as zero."""


@_carries(_through(lambda number: min(max(number, -1e308), 1e308), "DOUBLE"), "R-10.1.1-08")
class has_no_infinity(Base):
    """Infinities arrive as great numbers, and the greatest numbers, too."""


@_carries(_of(Float, _one_nan), "R-10.1.1-08", readings={"nan": "exact"})
class knows_one_nan(Base):
    """Every NaN arrives as the same one, although the vendor declares that NaNs arrive as they are."""


@core_variant_of("10.1.1")
class may_know_one_nan(Base):
    """Every NaN arrives as the same one, and the vendor declares no other reading."""

    link_class = changing(_of(Float, _one_nan))


# characters, booleans, strings


@_carries(_of(Char, _in_bits(16, False)), "R-10.1.1-09")
class cuts_characters_to_16_bits(Base):
    """A CHAR32 beyond the Basic Multilingual Plane loses its upper bits."""


@_carries(_of(Char, lambda of, value: value or 0x20), "R-10.1.1-09")
class cannot_send_nul(Base):
    """The character NUL arrives as a blank."""


@_carries(_of(Boolean, lambda of, value: True), "R-10.1.1-10")
class knows_only_true(Base):
    """Every boolean arrives as true."""


@_carries(_of(Boolean, lambda of, value: int(value)), "R-10.1.1-10")  # type: ignore[arg-type]
class sends_booleans_as_integers(Base):
    """Booleans arrive as 0 and 1."""


def _text(change: Callable[[String, str], str]) -> Change:
    return _of(String, lambda of, value: change(of, value))  # type: ignore[arg-type]


@_carries(_text(lambda of, text: text[: of.size - 1] if of.size > 1 else text), "R-10.1.1-11")
class leaves_room_for_nul(Base):
    """A string of exactly its bound loses the last character."""


@_carries(_text(lambda of, text: text.rstrip(" ")), "R-10.1.1-11")
class strips_blanks(Base):
    """Strings lose trailing blanks."""


@_carries(_text(lambda of, text: text[:255]), "R-10.1.1-11")
class counts_characters_in_an_octet(Base):
    """No string is longer than 255 characters."""


@_carries(_text(lambda of, text: "".join(c if ord(c) <= 0xFFFF else "?" for c in text)), "R-10.1.1-11")
class sends_strings_in_ucs_2(Base):
    """Characters beyond the Basic Multilingual Plane arrive as question marks when they are in strings."""


@_carries(_text(lambda of, text: text.replace("\r\n", "\n")), "R-10.1.1-11")
class translates_line_ends(Base):
    """Line ends are made those of this platform."""


@_carries(_text(lambda of, text: text or "null"), "R-10.1.1-11")
class has_no_empty_string(Base):
    """An empty string arrives as ``null``."""


# enumerations, structures, unions


def _by_index(of: AnyType, value: Datum) -> Datum:
    assert isinstance(of, Enumeration)
    in_order = sorted(of.values, key=lambda name: of.values[name])
    return in_order[list(of.values).index(str(value))]


@_carries(_of(Enumeration, _by_index), "R-10.1.1-12")
class counts_enumerators(Base):
    """Enumerators are sent by position and read by the order of their indices."""


def _not_negative(of: AnyType, value: Datum) -> Datum:
    assert isinstance(of, Enumeration)
    return next(name for name, index in of.values.items() if index >= max(0, of.values[str(value)]))


@_carries(_of(Enumeration, _not_negative), "R-10.1.1-12")
class has_no_negative_enumerators(Base):
    """An enumerator with a negative index arrives as the first that has none."""


@_carries(_of(Structure, lambda of, value: value[::-1]), "R-10.1.1-13")  # type: ignore[index]
class turns_structures_round(Base):
    """The fields of a structure arrive in the opposite order."""


def _second_as_first(of: AnyType, value: Datum) -> Datum:
    assert isinstance(of, Structure)
    assert isinstance(value, list)
    types = list(of.fields.values())
    return [value[0], value[0], *value[2:]] if types[:1] == types[1:2] else value


@_carries(_of(Structure, _second_as_first), "R-10.1.1-13", also=("R-10.1.1-07",))
class has_the_first_field_twice(Base):
    """A second field of the same type has the value of the first, which no message with another number shows."""


def _without_default(of: AnyType, value: Datum) -> Datum:
    assert isinstance(of, Union)
    assert isinstance(value, list)
    named = [enumerator for case in of.cases for enumerator in case.selectors]
    default = next((case for case in of.cases if case.default), None)
    return value if value[0] in named or default is None else [default.selectors[0], value[1]]


@_carries(_of(Union, _without_default), "R-10.1.1-14")
class loses_default_selectors(Base):
    """What arrives through the default case has the case's first selector."""


def _first_case(of: AnyType, value: Datum) -> Datum:
    assert isinstance(of, Union)
    assert isinstance(value, list)
    named = [enumerator for case in of.cases for enumerator in case.selectors]
    return value if value[0] in named else [value[0], _EMPTY.get(type(components_of(of, value)[0][1]), value[1])]


_EMPTY: dict[type, Datum] = {Integer: 0, Float: "00000000", String: ""}


@_carries(_of(Union, _first_case), "R-10.1.1-14")
class loses_the_default_case(Base):
    """What is selected by nobody but the default case arrives empty."""


# arrays, sequences


def _transposed(of: AnyType, value: Datum) -> Datum:
    assert isinstance(of, Array)
    assert isinstance(value, list)
    is_square = len(of.sizes) == 2 and of.sizes[0] == of.sizes[1]
    return [list(column) for column in zip(*value, strict=True)] if is_square else value


@_carries(_of(Array, _transposed), "R-10.1.1-15")
class transposes_arrays(Base):
    """Rows and columns of square arrays are exchanged."""


@_carries(_of(Array, lambda of, value: [value[0]] * len(value)), "R-10.1.1-15", also=("R-10.1.1-18",))  # type: ignore[index,arg-type]
class repeats_the_first_row(Base):
    """All rows of an array are like the first one."""


@_carries(_of(Array, lambda of, value: list(itertools.chain(*value)) if len(of.sizes) == 3 else value), "R-10.1.1-15")  # type: ignore[arg-type,union-attr]
class flattens_cubes(Base):
    """Arrays of three dimensions lose the first."""


@_carries(_of(Sequence, lambda of, value: value[: of.size - 1] if 1 < of.size == len(value) else value), "R-10.1.1-16")  # type: ignore[union-attr,arg-type,index]
class loses_the_last_element(Base):
    """A sequence of exactly its bound loses the last element."""


@_carries(_of(Sequence, lambda of, value: value[::-1]), "R-10.1.1-16")  # type: ignore[index]
class turns_sequences_round(Base):
    """Elements arrive in the opposite order."""


@_carries(_of(Sequence, lambda of, value: value[:255]), "R-10.1.1-16")  # type: ignore[index]
class counts_elements_in_an_octet(Base):
    """No sequence is longer than 255 elements."""


# aliases, types in types


@breaks_core("R-10.1.1-17", clauses=_CLAUSE, also=_REFUSED)
class refuses_aliases(Base):
    """Connectors cannot be bound to an interface that has an alias for a type."""

    def link(self, connector: str, interface: Interface) -> Link:
        types = [parameter.of for method in interface.methods.values() for parameter in method.parameters]
        if any(isinstance(of, Alias) for of in types):
            raise UcmError("what is an alias?")
        return super().link(connector, interface)


def _as_short(of: AnyType, value: Datum) -> Datum:
    return value & 0x7FFF if isinstance(value, int) and not isinstance(value, bool) else value


@_carries(_of(Alias, _as_short), "R-10.1.1-17")
class takes_aliases_for_shorts(Base):
    """An integer whose type is an alias has 15 bits."""


@_carries(
    _of(Alias, lambda of, value: "" if isinstance(value, str) and isinstance(of.of, String) else value),  # type: ignore[union-attr]
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


@breaks_core("R-10.1.1-18", clauses=_CLAUSE, also=_REFUSED)
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


@_carries(_shallow, "R-10.1.1-18", also=("R-10.1.1-16",))
class cuts_inner_sequences(Base):
    """A sequence inside a structure or a sequence arrives with its first element only; messages are mostly structures."""


# attributes


@breaks_core("R-10.1.1-06", clauses=_CLAUSE, also=("R-11.2.1.2-05",))
class configures_after_on_init(Base):
    """Attributes are set when on_init has returned."""

    def _configure(self, member: Member, attributes: Mapping[str, str]) -> None:
        super()._configure(member, {})
        self._set_attributes(member, attributes)


@breaks_core("R-10.1.1-06", clauses=_CLAUSE, also=("R-11.2.1.2-05",))
class configures_with_small_numbers(Base):
    """The value of an attribute that is a great integer is cut to 32 bits."""

    def _set_attributes(self, member: Member, attributes: Mapping[str, str]) -> None:
        super()._set_attributes(member, {name: self._cut(value) for name, value in attributes.items()})

    def _cut(self, value: str) -> str:
        number = read_spelled(value)
        return str(number % 2**32) if isinstance(number, int) and not isinstance(number, bool) else value


@breaks_core("R-10.1.1-06", clauses=_CLAUSE, also=("R-11.2.1.2-05",))
class forgets_attributes_with_lists(Base):
    """Only attributes with simple values are set."""

    def _set_attributes(self, member: Member, attributes: Mapping[str, str]) -> None:
        super()._set_attributes(member, {name: value for name, value in attributes.items() if value[:1] != "["})


# other ways of doing it right


@core_variant_of("10.1.1")
class copies_values_deeply(Base):
    """Everything is copied on its way, part by part."""

    link_class = changing(lambda of, value: list(value) if isinstance(value, list) else value)


@core_variant_of("10.1.1")
class marshals_values(Base):
    """Values travel as text, and each is given a second time to those who read it twice."""

    link_class = changing(lambda of, value: read_spelled(spell(value)))  # type: ignore[arg-type,return-value]


@core_variant_of("10.1.1")
class spells_attributes_anew(Base):
    """Values of attributes are read, and spelled in another way."""

    def _set_attributes(self, member: Member, attributes: Mapping[str, str]) -> None:
        super()._set_attributes(
            member,
            {
                name: value.replace(",", " , ") if value[:1] == "[" and '"' not in value else value
                for name, value in attributes.items()
            },
        )
