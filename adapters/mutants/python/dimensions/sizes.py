"""Frameworks that keep values of some sizes only: attributes, texts, sequences and messages."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.programming_model import UcmError
from ucm_cts.adapters.mutants.python.methods import replaces
from ucm_cts.adapters.mutants.python.registry import CONTAINER, Base, Row, family, is_below
from ucm_cts.adapters.reference.python.connectors import OK, Link
from ucm_cts.adapters.reference.python.members import Member


class _Alters(Base):
    altered: Callable[[str], str]

    def _set_attributes(self, member: Member, attributes: Mapping[str, str]) -> None:
        super()._set_attributes(member, {name: self.altered(value) for name, value in attributes.items()})


_SET = "R-11.2.1.2-05"
family(
    _Alters,
    "altered",
    {
        "attributes_have_4095_characters": Row(
            _SET, "Attribute values end after 4,095 characters.", lambda v: v[:4095]
        ),
        "attributes_have_65535_characters": Row(
            _SET, "Attribute values end after 65,535 characters.", lambda v: v[:65535]
        ),
        "attributes_lose_whole_64k": Row(
            _SET, "Of attribute values the length modulo 65,536 counts.", lambda v: v[: len(v) % 65536]
        ),
        "attributes_lose_pages": Row(
            _SET, "Attribute values of exactly 4,096 characters are empty.", lambda v: "" if len(v) == 4096 else v
        ),
        "attributes_have_less_than_a_mebibyte": Row(
            _SET, "Attribute values end before a mebibyte.", lambda v: v[: 2**20 - 1]
        ),
        "attributes_have_one_character": Row(
            _SET, "Attribute values of one character are empty.", lambda v: v if len(v) > 1 else ""
        ),
        "attributes_repeat_their_first_page": Row(
            _SET,
            "From the 4,097th character on attribute values repeat their beginning.",
            lambda v: v[:4096] + v[: len(v) - 4096] if len(v) > 4096 else v,
        ),
        "attributes_are_one_line": Row(_SET, "Attribute values end at a line end.", lambda v: v.partition("\n")[0]),
        "attributes_are_stripped": Row(_SET, "Attribute values lose blanks at their ends.", str.strip),
        "attributes_are_quoted": Row(
            _SET, "A backslash in an attribute value is doubled.", lambda v: v.replace("\\", "\\\\")
        ),
        "attributes_fold_case": Row(_SET, "Attribute values are in lower case.", str.lower),
    },
    clauses=CONTAINER,
)


@replaces("_set_attributes", _SET)
def sets_no_empty_values(self: Base, member: Member, attributes: Mapping[str, str]) -> None:
    """Attributes whose value is empty are not set."""
    Base._set_attributes(self, member, {name: value for name, value in attributes.items() if value})


@replaces("_set_attributes", "R-11.2.2.1-01")
def refuses_values_of_a_mebibyte(self: Base, member: Member, attributes: Mapping[str, str]) -> None:
    """add_component is refused if an attribute value has a mebibyte."""
    if any(len(value) >= 2**20 for value in attributes.values()):
        raise UcmError("the value is too long")
    Base._set_attributes(self, member, attributes)


@replaces("_set_attributes", _SET)
def halves_long_values_below(self: Base, member: Member, attributes: Mapping[str, str]) -> None:
    """In sub-containers attribute values of 4,096 characters and more lose half."""
    halved = {n: v[: len(v) // 2] if is_below(self) and len(v) >= 4096 else v for n, v in attributes.items()}
    Base._set_attributes(self, member, halved)


def _size(value: Datum) -> int:
    if isinstance(value, list):
        return sum(map(_size, value))
    return len(value) if isinstance(value, str) else 1


@replaces("_emit", "R-10.1.2-10", clauses=("10.1.1", "10.1.2"), also=("R-10.1.6.1-20",))
def loses_messages_of_64k(self: Link, method: str, arguments: Sequence[Datum]) -> str:
    """Messages of more than 65,535 characters or elements are lost, and push returns ok."""
    return OK if sum(map(_size, arguments)) > 65535 and not self.broken else Link._emit(self, method, arguments)


@replaces("_request", "R-10.1.1-11", clauses=("10.1.1",))
def services_cut_texts_at_64k(self: Link, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
    """In calls of services strings end after 65,535 characters."""
    return [_cut(v, 65535) for v in Link._request(self, method, [_cut(v, 65535) for v in arguments])]


@replaces("_request", "R-10.1.1-11", clauses=("10.1.1",))
def services_cut_results_at_4k(self: Link, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
    """In results of services strings end after 4,096 characters."""
    return [_cut(v, 4096) for v in Link._request(self, method, arguments)]


def _cut(value: Datum, limit: int) -> Datum:
    if isinstance(value, list):
        return [_cut(one, limit) for one in value]
    return value[:limit] if isinstance(value, str) else value


@replaces("_request", "R-10.1.1-16", clauses=("10.1.1",))
def services_cut_sequences_at_255(self: Link, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
    """In calls of services sequences end after 255 elements."""
    return Link._request(self, method, [v[:255] if isinstance(v, list) else v for v in arguments])


@replaces("_request", "R-10.1.1-11", clauses=("10.1.1",))
def services_cut_texts_at_a_mebibyte(self: Link, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
    """In calls of services strings end after 1,000,000 characters."""
    return Link._request(self, method, [_cut(value, 1_000_000) for value in arguments])


@replaces("_emit", "R-10.1.1-11", clauses=("10.1.1", "10.1.2"), also=("R-10.1.2-10",))
def messages_lose_the_end_of_a_full_page(self: Link, method: str, arguments: Sequence[Datum]) -> str:
    """In messages a string of exactly 4,096 characters loses the last one."""
    shorter = [v[:-1] if isinstance(v, str) and len(v) == 4096 else v for v in arguments]
    return Link._emit(self, method, shorter)


@replaces("_emit", "R-10.1.1-16", clauses=("10.1.1", "10.1.2"), also=("R-10.1.2-10",))
def messages_cut_sequences_at_4k(self: Link, method: str, arguments: Sequence[Datum]) -> str:
    """In messages sequences end after 4,096 elements."""
    return Link._emit(self, method, [v[:4096] if isinstance(v, list) else v for v in arguments])


@replaces("_log", "R-10.1.4.2-47", clauses=("10.1.4",))
def log_cuts_texts_at_4k(self: Base, member: Member, severity: str, message: str) -> None:
    """Texts of records end after 4,095 characters."""
    Base._log(self, member, severity, message[:4095])


@replaces("_log", "R-10.1.4.2-47", clauses=("10.1.4",))
def log_cuts_texts_at_64k(self: Base, member: Member, severity: str, message: str) -> None:
    """Texts of records end after 65,535 characters."""
    Base._log(self, member, severity, message[:65535])


@replaces("_log", "R-10.1.4.2-53", clauses=("10.1.4",), also=("R-10.1.4.2-47",))
def log_keeps_254_characters(self: Base, member: Member, severity: str, message: str) -> None:
    """Texts of 255 characters lose the last."""
    Base._log(self, member, severity, message[:-1] if len(message) == 255 else message)
