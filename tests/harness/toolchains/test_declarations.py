"""Names in a model of lxml elements: the targets of references, and additions to the model."""

from __future__ import annotations

import pytest
from lxml import etree

from ucm_cts.harness.toolchains.corpus.declarations import member, path, resolved, spare_like, spare_unlike

MODEL = """\
<Model>
  <ContractModule name="outer">
    <PrimitiveBoolean name="truth"/>
    <Interface name="service"/>
    <ContractModule name="inner">
      <Alias name="other_truth" type="truth"/>
      <PrimitiveInteger name="truth" kind="LONG"/>
    </ContractModule>
  </ContractModule>
  <InteractionModule name="outer">
    <InteractionPattern name="truth"><InteractionRole name="role"/></InteractionPattern>
  </InteractionModule>
</Model>
"""


@pytest.fixture
def alias() -> etree._Element:
    found = etree.fromstring(MODEL).find(".//Alias")
    assert found is not None
    return found


@pytest.mark.parametrize(
    ("reference", "tag", "found"),
    [
        ("truth", "PrimitiveInteger", "::outer::inner::truth"),
        ("truth", "PrimitiveBoolean", "::outer::truth"),
        ("::outer::truth", "PrimitiveBoolean", "::outer::truth"),
        ("::outer::truth", "InteractionPattern", "::outer::truth"),
        ("outer::service", "Interface", "::outer::service"),
        ("::outer::truth", "PrimitiveInteger", ""),
        ("::truth", "PrimitiveBoolean", ""),
        ("service::truth", "PrimitiveBoolean", ""),
    ],
)
def test_references_lead_to_the_nearest_of_their_kind(
    alias: etree._Element, reference: str, tag: str, found: str
) -> None:
    declaration = resolved(alias, reference, tag)
    assert (path(declaration) if declaration is not None else "") == found
    assert declaration is None or declaration.tag == tag


def test_members_are_those_of_their_owner(alias: etree._Element) -> None:
    assert member(alias, "::outer::truth.role", "InteractionPattern", "InteractionRole") is not None
    assert member(alias, "::outer::truth.item", "InteractionPattern", "InteractionRole") is None


def test_new_types_are_of_the_same_kind_or_of_the_other_one(alias: etree._Element) -> None:
    for reference, like, unlike in (
        ("truth", "PrimitiveBoolean", "Interface"),
        ("service", "Interface", "PrimitiveBoolean"),
    ):
        same, other = spare_like(alias, reference), spare_unlike(alias, reference)
        assert same != other
        assert resolved(alias, same, like) is not None
        assert resolved(alias, other, unlike) is not None


def test_a_model_of_one_module_has_no_room_for_another() -> None:
    root = etree.fromstring('<ContractModule name="m"><Interface name="i"/></ContractModule>')
    assert spare_like(root[0], "i") == ""
    assert len(root) == 1
