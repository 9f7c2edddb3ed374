"""Wrong frameworks, clause 10.1.1: values that connectors lose, shorten or refuse; attributes that are not there in time."""

from __future__ import annotations

import math
import struct
from collections.abc import Callable, Mapping

from ucm_cts.adapters.contract.data_types import (
    AnyType,
    Boolean,
    Char,
    Datum,
    Enumeration,
    Float,
    Integer,
    String,
)
from ucm_cts.adapters.contract.data_values import read_spelled, spell
from ucm_cts.adapters.contract.programming_model import UcmError
from ucm_cts.adapters.mutants.python.altering import Change, carries, changing, made_to
from ucm_cts.adapters.mutants.python.registry import Base, breaks, variant_of
from ucm_cts.adapters.reference.python.framework import Member

_CLAUSE = ("10.1.1",)


# integers


def _in_bits(bits: int, signed: bool) -> Change:
    def cut(of: AnyType, value: Datum) -> Datum:
        assert isinstance(value, int)
        rest = value & ((1 << bits) - 1)
        return rest - (1 << bits) if signed and rest >= 1 << (bits - 1) else rest

    return cut


@carries(made_to(Integer, _in_bits(32, True), "LONGLONG"), "R-10.1.1-07")
class cuts_integers_to_32_bits(Base):
    """LONGLONG has 32 bits on its way."""


@carries(made_to(Integer, _in_bits(8, False), "BYTE"), "R-10.1.1-07")
class takes_bytes_for_octets(Base):
    """A negative BYTE arrives as what an octet of the same bits is."""


@carries(made_to(Integer, _in_bits(64, True), "ULONGLONG"), "R-10.1.1-07")
class has_no_great_unsigned_integers(Base):
    """ULONGLONG goes through a signed integer of 64 bits."""


@carries(made_to(Integer, lambda of, value: int(float(value))), "R-10.1.1-07")  # type: ignore[arg-type]
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

    return made_to(Float, change, *kinds)


def _single(number: float) -> float:
    try:
        return float(struct.unpack(">f", struct.pack(">f", number))[0])
    except OverflowError:
        return float("inf") if number > 0 else float("-inf")


def _one_nan(of: AnyType, value: Datum) -> Datum:
    (number,) = struct.unpack(">f" if of.kind == "FLOAT" else ">d", bytes.fromhex(value))  # type: ignore[union-attr,arg-type]
    return value if not math.isnan(number) else "7fc00000" if of.kind == "FLOAT" else "7ff8000000000000"  # type: ignore[union-attr]


@carries(_through(_single, "DOUBLE"), "R-10.1.1-08")
class sends_doubles_as_floats(Base):
    """DOUBLE goes through single precision."""


@carries(_through(lambda number: number + 0.0), "R-10.1.1-08")
class knows_one_zero(Base):
    """Minus zero arrives as zero."""


@carries(_through(lambda number: number if abs(number) >= 2**-126 else 0.0, "FLOAT"), "R-10.1.1-08")
class flushes_subnormals(Base):
    """A subnormal FLOAT arrives as zero."""


@carries(_through(lambda number: min(max(number, -1e308), 1e308), "DOUBLE"), "R-10.1.1-08")
class has_no_infinity(Base):
    """Infinities arrive as great numbers, and the greatest numbers, too."""


@carries(made_to(Float, _one_nan), "R-10.1.1-08", readings={"nan": "exact"})
class knows_one_nan(Base):
    """Every NaN arrives as the same one, although the vendor declares that NaNs arrive as they are."""


@variant_of("10.1.1", readings={"nan": "any"})
class may_know_one_nan(Base):
    """Every NaN arrives as the same one, as its vendor says."""

    link_class = changing(made_to(Float, _one_nan))


# characters, booleans, strings


@carries(made_to(Char, _in_bits(16, False)), "R-10.1.1-09")
class cuts_characters_to_16_bits(Base):
    """A CHAR32 beyond the Basic Multilingual Plane loses its upper bits."""


@carries(made_to(Char, lambda of, value: value or 0x20), "R-10.1.1-09")
class cannot_send_nul(Base):
    """The character NUL arrives as a blank."""


@carries(made_to(Boolean, lambda of, value: True), "R-10.1.1-10")
class knows_only_true(Base):
    """Every boolean arrives as true."""


@carries(made_to(Boolean, lambda of, value: int(value)), "R-10.1.1-10")  # type: ignore[arg-type]
class sends_booleans_as_integers(Base):
    """Booleans arrive as 0 and 1."""


def _text(change: Callable[[String, str], str]) -> Change:
    return made_to(String, lambda of, value: change(of, value))  # type: ignore[arg-type]


@carries(_text(lambda of, text: text[: of.size - 1] if of.size > 1 else text), "R-10.1.1-11")
class leaves_room_for_nul(Base):
    """A string of exactly its bound loses the last character."""


@carries(_text(lambda of, text: text.rstrip(" ")), "R-10.1.1-11")
class strips_blanks(Base):
    """Strings lose trailing blanks."""


@carries(_text(lambda of, text: text[:255]), "R-10.1.1-11")
class counts_characters_in_an_octet(Base):
    """No string is longer than 255 characters."""


@carries(_text(lambda of, text: text[:1000]), "R-10.1.1-11")
class cuts_strings_after_a_thousand_characters(Base):
    """No string is longer than 1,000 characters."""


@carries(_text(lambda of, text: text[:0xFFFF]), "R-10.1.1-11")
class counts_characters_in_16_bits(Base):
    """No string is longer than 65,535 characters."""


def _sendable(of: String, text: str) -> str:
    if len(text) > 0xFFFF:
        raise UcmError("too long")
    return text


@carries(_text(_sendable), "R-10.1.1-11", also=("R-10.1.2-02", "R-10.1.2-09", "R-10.1.5.1-01", "R-10.1.5.1-13"))
class refuses_long_strings(Base):
    """What is longer than 65,535 characters cannot be sent."""


@carries(_text(lambda of, text: "".join(c if ord(c) <= 0xFFFF else "?" for c in text)), "R-10.1.1-11")
class sends_strings_in_ucs_2(Base):
    """Characters beyond the Basic Multilingual Plane arrive as question marks when they are in strings."""


@carries(_text(lambda of, text: text.replace("\r\n", "\n")), "R-10.1.1-11")
class translates_line_ends(Base):
    """Line ends are made those of this platform."""


@carries(_text(lambda of, text: text or "null"), "R-10.1.1-11")
class has_no_empty_string(Base):
    """An empty string arrives as ``null``."""


# enumerations


def _by_index(of: AnyType, value: Datum) -> Datum:
    assert isinstance(of, Enumeration)
    in_order = sorted(of.values, key=lambda name: of.values[name])
    return in_order[list(of.values).index(str(value))]


@carries(made_to(Enumeration, _by_index), "R-10.1.1-12")
class counts_enumerators(Base):
    """Enumerators are sent by position and read by the order of their indices."""


def _not_negative(of: AnyType, value: Datum) -> Datum:
    assert isinstance(of, Enumeration)
    return next(name for name, index in of.values.items() if index >= max(0, of.values[str(value)]))


@carries(made_to(Enumeration, _not_negative), "R-10.1.1-12")
class has_no_negative_enumerators(Base):
    """An enumerator with a negative index arrives as the first that has none."""


def _of_short_index(of: AnyType, value: Datum) -> Datum:
    assert isinstance(of, Enumeration)
    return next(iter(of.values)) if of.index in ("LONGLONG", "ULONGLONG") else value


@carries(made_to(Enumeration, _of_short_index), "R-10.1.1-12")
class has_no_enumerations_with_long_indices(Base):
    """Where the index type has 64 bits the first enumerator arrives, whichever was sent."""


# attributes


@breaks("R-10.1.1-06", clauses=_CLAUSE, also=("R-11.2.1.2-05",))
class configures_after_on_init(Base):
    """Attributes are set when on_init has returned."""

    def _configure(self, member: Member, attributes: Mapping[str, str]) -> None:
        super()._configure(member, {})
        self._set_attributes(member, attributes)


@breaks("R-10.1.1-06", clauses=_CLAUSE, also=("R-11.2.1.2-05",))
class configures_with_small_numbers(Base):
    """The value of an attribute that is a great integer is cut to 32 bits."""

    def _set_attributes(self, member: Member, attributes: Mapping[str, str]) -> None:
        super()._set_attributes(member, {name: self._cut(value) for name, value in attributes.items()})

    def _cut(self, value: str) -> str:
        number = read_spelled(value)
        return str(number % 2**32) if isinstance(number, int) and not isinstance(number, bool) else value


@breaks("R-10.1.1-06", clauses=_CLAUSE, also=("R-11.2.1.2-05",))
class forgets_attributes_with_lists(Base):
    """Only attributes with simple values are set."""

    def _set_attributes(self, member: Member, attributes: Mapping[str, str]) -> None:
        super()._set_attributes(member, {name: value for name, value in attributes.items() if value[:1] != "["})


# other ways of doing it right


@variant_of("10.1.1")
class copies_values_deeply(Base):
    """Everything is copied on its way, part by part."""

    link_class = changing(lambda of, value: list(value) if isinstance(value, list) else value)


@variant_of("10.1.1")
class marshals_values(Base):
    """Values travel as text, and each is given a second time to those who read it twice."""

    link_class = changing(lambda of, value: read_spelled(spell(value)))  # type: ignore[arg-type,return-value]


@variant_of("10.1.1")
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
