"""Wrong frameworks, clause 10.1.1: values that connectors lose, shorten or refuse; attributes that are set too late."""

from __future__ import annotations

import math
import struct
from collections.abc import Callable, Mapping
from typing import Any

from ucm_cts.adapters.contract.data_types import Boolean, Char, Enumeration, Float, Integer, String
from ucm_cts.adapters.contract.data_values import read_spelled, spell
from ucm_cts.adapters.contract.programming_model import UcmError
from ucm_cts.adapters.mutants.python.altering import Change, ChangingLink, carries, made_to, register_carried
from ucm_cts.adapters.mutants.python.methods import replaces
from ucm_cts.adapters.mutants.python.registry import Base, Row, breaks, variant_of
from ucm_cts.adapters.reference.python.members import Member

_CLAUSE = ("10.1.1",)


# integers


def _in_bits(bits: int, signed: bool) -> Change:
    def cut(of: Any, value: Any) -> Any:
        rest = value & ((1 << bits) - 1)
        return rest - (1 << bits) if signed and rest >= 1 << (bits - 1) else rest

    return cut


# floating-point numbers


def _through(convert: Callable[[float], float], *kinds: str) -> Change:
    def change(of: Any, value: Any) -> Any:
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


def _one_nan(of: Any, value: Any) -> Any:
    (number,) = struct.unpack(">f" if of.kind == "FLOAT" else ">d", bytes.fromhex(value))
    return value if not math.isnan(number) else "7fc00000" if of.kind == "FLOAT" else "7ff8000000000000"


@variant_of("10.1.1", readings={"nan": "any"})
class may_know_one_nan(ChangingLink):
    """Every NaN arrives as the same one, as the vendor declares."""

    change = staticmethod(made_to(Float, _one_nan))


# characters, booleans, strings


def _text(change: Callable[[String, str], str]) -> Change:
    return made_to(String, lambda of, value: change(of, value))


def _sendable(of: String, text: str) -> str:
    if len(text) > 0xFFFF:
        raise UcmError("too long")
    return text


# enumerations


@carries("R-10.1.1-12", Enumeration)
def counts_enumerators(of: Any, value: Any) -> Any:
    """Enumerators are sent by position and read by index."""
    in_order = sorted(of.values, key=lambda name: of.values[name])
    return in_order[list(of.values).index(str(value))]


@carries("R-10.1.1-12", Enumeration)
def has_no_negative_enumerators(of: Any, value: Any) -> Any:
    """An enumerator with a negative index arrives as the first that has none."""
    return next(name for name, index in of.values.items() if index >= max(0, of.values[str(value)]))


@carries("R-10.1.1-12", Enumeration)
def has_no_enumerations_with_long_indices(of: Any, value: Any) -> Any:
    """If the index type has 64 bits, the first enumerator arrives instead of the one sent."""
    return next(iter(of.values)) if of.index in ("LONGLONG", "ULONGLONG") else value


# attributes


@replaces("_configure", "R-10.1.1-06", clauses=_CLAUSE, also=("R-11.2.1.2-05",))
def configures_after_on_init(self: Base, member: Member, attributes: Mapping[str, str]) -> None:
    """Attributes are set when on_init has returned."""
    Base._configure(self, member, {})
    self._set_attributes(member, attributes)


@breaks("R-10.1.1-06", clauses=_CLAUSE, also=("R-11.2.1.2-05",))
class configures_with_small_numbers(Base):
    """The value of an attribute that is a large integer is cut to 32 bits."""

    def _set_attributes(self, member: Member, attributes: Mapping[str, str]) -> None:
        super()._set_attributes(member, {name: self._cut(value) for name, value in attributes.items()})

    def _cut(self, value: str) -> str:
        number = read_spelled(value)
        return str(number % 2**32) if isinstance(number, int) and not isinstance(number, bool) else value


@replaces("_set_attributes", "R-10.1.1-06", clauses=_CLAUSE, also=("R-11.2.1.2-05",))
def forgets_attributes_with_lists(self: Base, member: Member, attributes: Mapping[str, str]) -> None:
    """Only attributes with simple values are set."""
    Base._set_attributes(self, member, {name: value for name, value in attributes.items() if value[:1] != "["})


# other ways of doing it right


@variant_of("10.1.1")
class copies_values_deeply(ChangingLink):
    """Values are copied part by part."""

    change = staticmethod(lambda of, value: list(value) if isinstance(value, list) else value)


@variant_of("10.1.1")
class marshals_values(ChangingLink):
    """Values travel as text."""

    change = staticmethod(lambda of, value: read_spelled(spell(value)))


@replaces("_set_attributes", clauses=("10.1.1",))
def spells_attributes_anew(self: Base, member: Member, attributes: Mapping[str, str]) -> None:
    """Values of attributes are spelled in another way before they are set."""
    Base._set_attributes(
        self,
        member,
        {
            name: value.replace(",", " , ") if value[:1] == "[" and '"' not in value else value
            for name, value in attributes.items()
        },
    )


CARRIED: Mapping[str, Row] = {
    "cuts_integers_to_32_bits": Row(
        "R-10.1.1-07",
        "A LONGLONG arrives with its lower 32 bits only.",
        made_to(Integer, _in_bits(32, True), "LONGLONG"),
    ),
    "takes_bytes_for_octets": Row(
        "R-10.1.1-07",
        "A negative BYTE arrives as the unsigned number of the same bits.",
        made_to(Integer, _in_bits(8, False), "BYTE"),
    ),
    "has_no_great_unsigned_integers": Row(
        "R-10.1.1-07",
        "ULONGLONG goes through a signed integer of 64 bits.",
        made_to(Integer, _in_bits(64, True), "ULONGLONG"),
    ),
    "sends_integers_as_doubles": Row(
        "R-10.1.1-07",
        "Integers go through a double, as in JSON for JavaScript.",
        made_to(Integer, lambda of, value: int(float(value))),
    ),
    "sends_doubles_as_floats": Row("R-10.1.1-08", "DOUBLE goes through single precision.", _through(_single, "DOUBLE")),
    "knows_one_zero": Row("R-10.1.1-08", "Minus zero arrives as zero.", _through(lambda number: number + 0.0)),
    "flushes_subnormals": Row(
        "R-10.1.1-08",
        "A subnormal FLOAT arrives as zero.",
        _through(lambda number: number if abs(number) >= 2**-126 else 0.0, "FLOAT"),
    ),
    "has_no_infinity": Row(
        "R-10.1.1-08",
        "Infinities, and the largest finite numbers, arrive as 1e308.",
        _through(lambda number: min(max(number, -1e308), 1e308), "DOUBLE"),
    ),
    "knows_one_nan": Row(
        "R-10.1.1-08",
        "Every NaN arrives as the same one; the vendor declares that NaNs arrive unchanged.",
        made_to(Float, _one_nan),
        readings={"nan": "exact"},
    ),
    "cuts_characters_to_16_bits": Row(
        "R-10.1.1-09",
        "A CHAR32 beyond the Basic Multilingual Plane loses its upper bits.",
        made_to(Char, _in_bits(16, False)),
    ),
    "cannot_send_nul": Row(
        "R-10.1.1-09", "The character NUL arrives as a blank.", made_to(Char, lambda of, value: value or 0x20)
    ),
    "knows_only_true": Row("R-10.1.1-10", "Every boolean arrives as true.", made_to(Boolean, lambda of, value: True)),
    "sends_booleans_as_integers": Row(
        "R-10.1.1-10", "Booleans arrive as 0 and 1.", made_to(Boolean, lambda of, value: int(value))
    ),
    "leaves_room_for_nul": Row(
        "R-10.1.1-11",
        "A string of exactly its bound loses the last character.",
        _text(lambda of, text: text[: of.size - 1] if of.size > 1 else text),
    ),
    "strips_blanks": Row("R-10.1.1-11", "Strings lose trailing blanks.", _text(lambda of, text: text.rstrip(" "))),
    "counts_characters_in_an_octet": Row(
        "R-10.1.1-11", "No string is longer than 255 characters.", _text(lambda of, text: text[:255])
    ),
    "cuts_strings_after_a_thousand_characters": Row(
        "R-10.1.1-11", "No string is longer than 1,000 characters.", _text(lambda of, text: text[:1000])
    ),
    "counts_characters_in_16_bits": Row(
        "R-10.1.1-11", "No string is longer than 65,535 characters.", _text(lambda of, text: text[:0xFFFF])
    ),
    "refuses_long_strings": Row(
        "R-10.1.1-11",
        "A string of more than 65,535 characters is refused.",
        _text(_sendable),
        also=("R-10.1.2-02", "R-10.1.2-09", "R-10.1.5.1-01", "R-10.1.5.1-13"),
    ),
    "sends_strings_in_ucs_2": Row(
        "R-10.1.1-11",
        "Characters beyond the Basic Multilingual Plane arrive as question marks when they are in strings.",
        _text(lambda of, text: "".join(c if ord(c) <= 0xFFFF else "?" for c in text)),
    ),
    "translates_line_ends": Row(
        "R-10.1.1-11",
        "Carriage return and line feed arrive as a line feed.",
        _text(lambda of, text: text.replace("\r\n", "\n")),
    ),
    "has_no_empty_string": Row(
        "R-10.1.1-11", "An empty string arrives as ``null``.", _text(lambda of, text: text or "null")
    ),
}
register_carried(CARRIED)
