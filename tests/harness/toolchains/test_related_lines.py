"""The lines that a diagnostic may name: those related to a change."""

from __future__ import annotations

import pytest

from ucm_cts.harness.toolchains.corpus.selection import differing_lines
from ucm_cts.harness.toolchains.related_lines import related_lines

MODEL = """\
<Model>
  <ComponentModule name="components">
    <ComponentType name="box">
      <Port name="front">
        <PortTypeSpec
            type="::interactions::socket"/>
      </Port>
    </ComponentType>
    <ComponentType name="crate"/>
    <CompositeComponentImplementation name="home" type="box">
      <Part name="one" instanceOf="crate"/>
    </CompositeComponentImplementation>
  </ComponentModule>
  <InteractionModule name="interactions">
    <PortType name="socket"/>
    <PortType name="plug"/>
  </InteractionModule>
</Model>
"""


def lines_after(*swaps: tuple[str, str]) -> frozenset[int]:
    """What has to do with these changes of the model."""
    text = MODEL
    for old, new in swaps:
        assert text.count(old) == 1
        text = text.replace(old, new)
    return related_lines(text, differing_lines(MODEL, text), MODEL, differing_lines(text, MODEL))


@pytest.mark.parametrize(
    ("swap", "there", "elsewhere"),
    [
        (('<PortType name="socket"/>', '<PortType name="hole"/>'), {3, 4, 5, 6, 10, 11, 14, 15}, {9, 16}),
        (('type="::interactions::socket"', 'type="plug"'), {3, 4, 5, 6, 10, 11, 15, 16}, {9}),
        (('<ComponentType name="crate"/>', '<ComponentType name="crate" refines="crate"/>'), {9, 10, 11}, {3, 4, 15}),
        (('<Part name="one" instanceOf="crate"/>', ""), {9, 10}, {4, 15}),
    ],
    ids=["declaration", "reference", "name", "emptied"],
)
def test_changed_lines_and_lines_with_shared_names(swap: tuple[str, str], there: set[int], elsewhere: set[int]) -> None:
    lines = lines_after(swap)
    assert there <= lines
    assert not elsewhere & lines


def test_an_element_that_was_emptied_counts_although_only_its_end_moved() -> None:
    spec = '\n        <PortTypeSpec\n            type="::interactions::socket"/>'
    lines = lines_after((spec, ""))
    assert {4, 13} <= lines
    assert not {7, 14} & lines


def test_all_lines_of_text_that_is_no_xml() -> None:
    assert related_lines("<a>\n<b>\n", frozenset({1})) == {1, 2, 3}


def test_what_refers_to_an_edited_declaration_through_others() -> None:
    lines = lines_after(('<PortType name="plug"/>', '<PortType name="plug" extends="nothing"/>'))
    assert 16 in lines
    assert not {3, 5, 9, 10} & lines, "nothing refers to it"
    lines = lines_after(('<ComponentType name="box">', '<ComponentType name="box" refines="nothing">'))
    assert {3, 10, 11} <= lines
    assert not {9, 16} & lines


def test_names_that_the_edit_took_away() -> None:
    lines = lines_after(('<ComponentType name="crate"/>', ""))
    assert {10, 11} <= lines
    assert not {3, 4, 15} & lines
