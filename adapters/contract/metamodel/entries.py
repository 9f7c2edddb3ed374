"""Which elements may stand where in a model, and how the values of their attributes are converted."""

from __future__ import annotations

import functools
import re
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

from ucm_cts.adapters.contract.metamodel.common import Element
from ucm_cts.adapters.contract.metamodel.contracts import StringType
from ucm_cts.adapters.contract.metamodel.modules import MODULES, Model
from ucm_cts.adapters.contract.metamodel.spelling import (
    SHORT_STRINGS,
    SPELLINGS,
    TRUTHS,
    Spelling,
    contained,
)


class _Numbers(dict[str, int]):
    """What numerals mean; those that were met are remembered. Raises ``ValueError``."""

    def __missing__(self, text: str) -> int:
        if not _NUMBER.fullmatch(text):
            raise ValueError(text)
        number = int(text)
        if len(self) < _REMEMBERED:
            self[text] = number
        return number


_NUMBER = re.compile(r"[+-]?[0-9]{1,20}")
_REMEMBERED = 10_000
_NUMBERS = _Numbers()

Converter = Callable[[str], object]


class Entry(NamedTuple):
    """A class at one place: ``field`` of what is around it takes it, ``inside`` is what may stand in it, by tag.

    An element with ``given`` attributes, counting its line, has all that are required; -1 if that does not say so.
    ``texts`` are the fields that hold text as it stands.
    """

    spelling: Spelling
    tag: str
    field: str
    build: Callable[..., Element]
    fields: frozenset[str]
    required: frozenset[str]
    given: int
    converters: tuple[tuple[str, Converter], ...]
    texts: tuple[str, ...]
    inside: dict[str, Entry]


def _string_of(chars: str, **values: Any) -> StringType:
    return StringType(char_base=chars, **values)


def _entries() -> dict[str, Entry]:
    """What may be outermost."""
    insides: dict[type[Element], dict[str, Entry]] = {cls: {} for cls in SPELLINGS}
    for outer, inside in insides.items():
        for inner, field in contained(outer).items():
            inside.update(_spelled(inner, field, insides))
    root = dict(_spelled(Model, "model", insides))
    for module in MODULES:
        root.update(_spelled(module, "modules", insides))
    return root


def _spelled(cls: type[Element], field: str, insides: Mapping[type[Element], dict[str, Entry]]) -> dict[str, Entry]:
    spelling = SPELLINGS[cls]
    converters: list[tuple[str, Converter]] = [(f, words.__getitem__) for f, words in spelling.literals.items()]
    converters += [(f, _NUMBERS.__getitem__) for f in spelling.numbers]
    converters += [(f, TRUTHS.__getitem__) for f in spelling.truths]
    converted = {field for field, _ in converters}
    texts = [field for field in spelling.attributes.values() if field not in converted]
    entry = Entry(
        spelling=spelling,
        tag=spelling.tag,
        field=field,
        build=cls,
        fields=frozenset(spelling.attributes.values()) | spelling.contained.keys(),
        required=spelling.required,
        given=len(spelling.required) + 1 if len(spelling.required) == len(spelling.attributes) else -1,
        converters=tuple(converters),
        texts=tuple(texts),
        inside=insides[cls],
    )
    found = {tag: entry._replace(tag=tag) for tag in (spelling.tag, *spelling.other_tags)}
    if cls is StringType:
        for tag, chars in SHORT_STRINGS.items():
            found[tag] = entry._replace(
                tag=tag,
                build=functools.partial(_string_of, chars),
                fields=entry.fields - {"char_base"},
                required=entry.required - {"char_base"},
                given=-1,
            )
    return found


OUTERMOST = _entries()
