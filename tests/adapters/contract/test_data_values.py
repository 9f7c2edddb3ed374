"""Values for people are spelled as in scenarios and reports."""

from __future__ import annotations

import pytest

from ucm_cts.adapters.contract import data_types as d
from ucm_cts.adapters.contract.data_values import misfit, printed


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (True, "true"),
        ((False, [1, True]), "[false, [1, true]]"),
        (None, "nothing"),
        (-(2**70), str(-(2**70))),
        ("ä's", '"ä\'s"'),
        ("\u202e\ud800\0", '"\\u202e\\ud800\\u0000"'),
        ([], "[]"),
    ],
)
def test_a_value_is_told_as_scenarios_spell_it(value: object, text: str) -> None:
    assert printed(value) == text


def test_of_a_long_value_the_beginning_and_the_length_are_told() -> None:
    assert printed("a" * 100, 30) == '"aaaaaaaaa… (100 characters)'
    assert printed([True] * 10, 30) == "[true, tru… (60 characters)"
    assert printed("a" * 28, 30) == f'"{"a" * 28}"'


def test_what_does_not_fit_is_told_likewise() -> None:
    assert misfit(d.Integer("LONG"), True) == "true is no LONG"
    assert misfit(d.Sequence(d.Boolean()), False) == "false is no list"
