"""Drawn names look like a developer's, are identifiers everywhere, and are found in texts without doubt."""

from __future__ import annotations

import itertools
import keyword
import random
import re

import pytest
from files import ROOT

from ucm_cts.harness.execution.naming import LONGEST, Naming
from ucm_cts.harness.execution.revealing import Revealing

MANY = 1500
"""More than a run of profile core needs."""


@pytest.fixture(scope="module")
def names() -> list[str]:
    naming = Naming(random.Random(1))
    return [naming.word() if number % 10 == 0 else naming.name() for number in range(MANY)]


def test_names_are_identifiers_in_several_styles(names: list[str]) -> None:
    for name in names:
        assert re.fullmatch(r"[A-Za-z]+(_[a-z]+)*\d*", name)
        assert len(name) <= LONGEST
        assert not keyword.iskeyword(name)
    for style in (r"[a-z]+_[a-z_]+", r"[a-z]+([A-Z][a-z]+)+", r"([A-Z][a-z]+){2,}", r"[A-Za-z]+\d+"):
        assert sum(re.fullmatch(style, name) is not None for name in names) > MANY / 20, style


def test_no_name_is_inside_another_in_any_spelling(names: list[str]) -> None:
    text = "\n".join(names).casefold()
    assert len(set(text.split())) == MANY
    assert [name for name in names if text.count(name.casefold()) > 1] == []


def test_longer_names_begin_like_shorter_ones() -> None:
    naming = Naming(random.Random(2))
    name = naming.name()
    longer = [naming.longer(name) for _ in range(30)]
    assert len(set(longer)) == 30
    assert all(one.startswith(name) for one in longer)


def test_words_have_nine_letters() -> None:
    naming = Naming(random.Random(3))
    assert all(re.fullmatch("[A-Za-z]{9}", naming.word()) for _ in range(300))


def test_no_name_is_a_word_of_the_suite() -> None:
    """What is revealed holds texts of properties, fields of the protocol, and what reference frameworks say."""
    places = (
        "reference_models",
        "adapters/contract",
        "adapters/reference/python",
        "adapters/sdk/python",
        "suite/requirements",
    )
    files = itertools.chain.from_iterable(sorted((ROOT / place).rglob("*")) for place in places)
    text = "\n".join(one.read_text() for one in files if one.suffix in (".py", ".yaml", ".json")).casefold()
    naming = Naming(random.Random(4))
    drawn = {(naming.name() if number % 3 else naming.word()) for number in range(MANY)}
    assert [name for name in drawn if name.casefold() in text] == []


def test_names_and_numbers_are_revealed_wherever_they_stand() -> None:
    revealing = Revealing()
    for drawn, plain in {
        "pump_desk": "a",
        "pump_desk_again": "b",
        'x::"oilGate7': "in.api",
        "oilGate7": "in",
        "1234567890": "3",
    }.items():
        revealing.add(drawn, plain)
    for drawn, plain in {
        "pump_desk": "a",
        "the pump_desk_again, pump_desk": "the b, a",
        "get_pump_desk_proxy": "get_a_proxy",
        r"\npump_desk": r"\na",
        'x::"oilGate7': "in.api",
        "oilGate77": "in7",
        "OilGate7 Pump_desk": "OilGate7 Pump_desk",
        "no 1234567890, v1234567890, -1234567890": "no 3, v3, -3",
        "12345678901 91234567890": "12345678901 91234567890",
    }.items():
        assert revealing.reveal(drawn) == plain
    revealing.add("PumpZone", "c")
    assert revealing.reveal("pump_desk PumpZone") == "a c"
