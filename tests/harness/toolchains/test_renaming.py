"""Renaming gives models other names and spellings and changes nothing else."""

from __future__ import annotations

import re

import pytest
from lxml import etree

from ucm_cts.adapters.contract.metamodel.reading import read_model
from ucm_cts.adapters.contract.metamodel.writing import Dialect
from ucm_cts.adapters.reference.toolchain.program import reference
from ucm_cts.harness.results.statement import default_statement
from ucm_cts.harness.toolchains.acceptance import renamed
from ucm_cts.harness.toolchains.corpus.selection import questions
from ucm_cts.harness.toolchains.examinations import examination_for
from ucm_cts.harness.toolchains.renaming import Renaming, drawn_name, printed_names

ASKED = [q for q in questions() if all(map(default_statement().meets, q.under))]
PROGRAM = reference()
PRINTED = Dialect(
    tags={
        "PortType": "TemplatedPort",
        "ConnectorPort": "ConnectorPortDefinition",
        "AbstractDataType": "DataTypeTemplateParameter",
        "AbstractInterface": "InterfaceTypeTemplateParameter",
        "PrimitiveInteger": "PrimitiveType",
        "AnnotationDefinition": "PropertyDefinition",
        "InteractionModule": "InteractionDefinitionModule",
    },
    attributes={"PrimitiveInteger.kind": "aliasedPrimitive", "maxSize": "size", "charBase": "baseChar"},
    literals={"anyNumber": "anyNumer", "PROVIDED": "provided", "REQUIRED": "required", "DATA": "data"},
    short_strings=True,
    delegation_attributes=True,
)


@pytest.mark.slow
@pytest.mark.parametrize("renaming", [Renaming(7), Renaming(7, PRINTED)], ids=["names", "names and spelling"])
def test_a_renamed_model_gets_the_answer_of_the_plain_one(renaming: Renaming) -> None:
    for plain, other in zip(ASKED, renamed(ASKED, renaming), strict=True):
        answers = [{d.requirement for d in PROGRAM.check(q.text.encode(), "m")[1]} for q in (plain, other)]
        assert answers[0] == answers[1], f"{plain.name}\n{other.text}"


def test_no_name_is_left_but_those_that_are_printed() -> None:
    kept = printed_names() | {"core"}
    for q in renamed(ASKED, Renaming(3)):
        try:
            root = etree.fromstring(q.text.encode())
        except etree.XMLSyntaxError:
            continue
        for element in root.iter("Structure", "Interface", "ComponentType", "PortType", "ContractModule"):
            name = str(element.get("name", ""))
            assert not name.strip() or name in kept or re.search(r"_[a-z]{4}$", name), (q.name, name)


def test_names_differ_from_run_to_run_and_hold_within_one() -> None:
    assert drawn_name("a", 1) == drawn_name("a", 1) != drawn_name("a", 2)
    assert drawn_name("Name", 1).lower() == drawn_name("name", 1).lower()
    assert (drawn_name("", 1), drawn_name("LONG", 1), drawn_name("core", 1)) == ("", "LONG", "core")


def test_references_follow_their_names() -> None:
    text = (
        '<ContractModule name="m"><Enumeration name="e" indexType="BYTE"><Enumerator name="x" value="1"/></Enumeration>'
        '<Constant name="c" type="::m::e" value="x"/><Constant name="d" type="::m::e" value="c"/></ContractModule>'
    )
    model = read_model(Renaming(5).apply(text).encode(), "m").model
    (module,) = model.modules
    enumeration, (first, second) = module.data_types[0], module.constants  # type: ignore[union-attr]
    assert first.type == f"::{module.name}::{enumeration.name}"
    assert first.value == enumeration.enumerators[0].name  # type: ignore[union-attr]
    assert second.value == first.name


def test_strings_and_delegations_are_written_in_either_printed_way() -> None:
    text = (
        '<Model><StringType name="s" charBase="CHAR32" maxSize="4"/><StringType name="t" charBase="C"/>'
        '<PortDelegation port="p"><ConnectionEnd name="e" part="a" port="q"/></PortDelegation>'
        '<PortDelegation port="p"><ConnectionEnd part="a"/><ConnectionEnd part="b"/></PortDelegation></Model>'
    )
    other = Renaming(None, Dialect(short_strings=True, delegation_attributes=True)).apply(text)
    assert other == (
        '<Model><String32 name="s" maxSize="4"/><StringType name="t" charBase="C"/>'
        '<PortDelegation port="p" internalPart="a" internalPort="q"/>'
        '<PortDelegation port="p"><ConnectionEnd part="a"/><ConnectionEnd part="b"/></PortDelegation></Model>'
    )


def test_text_that_is_no_xml_is_unchanged() -> None:
    assert Renaming(5).apply("<a><b></a>") == "<a><b></a>"


@pytest.mark.parametrize(
    "end",
    [
        '<ConnectionEnd part="a" port="q"/>',
        '<ConnectionEnd name="" part="a" port="q"/>',
        '<ConnectionEnd name="e" part="a"/>',
        '<ConnectionEnd name="e" part="a" port="q" role="r"/>',
        '<ConnectionEnd name="e" part="a" port="q"><SimpleComment>c</SimpleComment></ConnectionEnd>',
        '<ConnectionEnd name="e" part="a" port="q"><Port name="p"/></ConnectionEnd>',
    ],
)
def test_an_end_is_left_as_it_is_if_more_than_its_name_would_be_lost(end: str) -> None:
    text = f'<PortDelegation port="p">{end}</PortDelegation>'
    assert Renaming(None, Dialect(delegation_attributes=True)).apply(text) == text


@pytest.mark.parametrize("profile", ["idl", "cpp11"])
def test_words_of_languages_are_asked_as_they_are(profile: str) -> None:
    models = dict(examination_for(profile, default_statement(), Renaming(seed=3)).models)
    assert 'name="default"' in models["open_keywords"]
    assert 'name="xor"' in models["open_keywords"]
    assert 'name="records_t"' not in models["interfaces"]
