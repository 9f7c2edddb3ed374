"""The schema, two programs that understand it, and the reader agree about every model of the suite."""

from __future__ import annotations

from pathlib import Path

import pytest
from lxml import etree
from second_schema import second_opinion

from ucm_cts.adapters.contract.metamodel.common import Element
from ucm_cts.adapters.contract.metamodel.contracts import ContractModule
from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.contract.metamodel.reading import read_model
from ucm_cts.adapters.contract.metamodel.spelling import IGNORED, SPELLINGS, Spelling, contained
from ucm_cts.adapters.contract.metamodel.writing import write_model
from ucm_cts.harness.catalogue.requirements import SUITE
from ucm_cts.harness.models.core_models import CORE, EXTENSIONS
from ucm_cts.harness.toolchains.corpus.printed_schema import PRINTED, printed_schema
from ucm_cts.harness.toolchains.corpus.schema import SCHEMA, violations
from ucm_cts.harness.toolchains.corpus.selection import questions

MAPPING = SUITE / "models" / "mapping"
XS = "{http://www.w3.org/2001/XMLSchema}"


def judged(text: str) -> tuple[bool, bool, bool]:
    """Is it as it should be for the schema by lxml, the schema by xmlschema, and the reader?"""
    return (
        not violations(text.encode()),
        second_opinion().is_valid(text),
        not read_model(text.encode(), "m.xml").problems,
    )


@pytest.mark.parametrize(
    "path", [*sorted(CORE.glob("*.xml")), *sorted(EXTENSIONS.glob("*.xml"))], ids=lambda path: path.stem
)
def test_models_of_the_platform_fit(path: Path) -> None:
    assert judged(write_model(read_model(path.read_bytes(), path.name).model).decode()) == (True, True, True)


@pytest.mark.parametrize("path", sorted(MAPPING.glob("*.xml")), ids=lambda path: path.stem)
def test_models_of_the_mappings_fit(path: Path) -> None:
    assert judged(path.read_text()) == (True, True, True)


@pytest.mark.slow
def test_all_agree_about_the_models_of_the_suite() -> None:
    disagreeing = [question.name for question in questions() if len(set(judged(question.text))) > 1]
    assert disagreeing == []


def test_legal_models_fit_unless_something_is_declared() -> None:
    legal = [question for question in questions() if question.due == "accept" and not question.under]
    assert len(legal) > 100
    assert [question.name for question in legal if violations(question.text.encode())] == []


def test_some_models_are_built_wrong() -> None:
    assert any(violations(question.text.encode()) for question in questions() if question.due == "refuse")


# the schema and the table of spellings say the same, although neither is made of the other


def declared() -> dict[str, etree._Element]:
    """What each tag of the schema is: its complex type."""
    files = [etree.parse(path) for path in sorted(SCHEMA.parent.glob("ucm*.xsd"))]
    types = {t.get("name"): t for file in files for t in file.iterfind(f"{XS}complexType")}
    elements = [e for file in files for e in file.iter(f"{XS}element") if e.get("name")]
    return {str(e.get("name")): types[e.get("type")] if e.get("type") else e[-1] for e in elements}


def test_the_schema_has_every_tag() -> None:
    assert set(declared()) == {spelling.tag for spelling in SPELLINGS.values()}


@pytest.mark.parametrize("spelling", SPELLINGS.values(), ids=lambda spelling: spelling.tag)
def test_the_schema_has_every_attribute(spelling: Spelling) -> None:
    inside = declared()[spelling.tag]
    own = {a.get("name"): a.get("use") == "required" for a in inside.iter(f"{XS}attribute")}
    if any(group.get("ref") == "named" for group in inside.iter(f"{XS}attributeGroup")):
        own["name"] = True
    ignored = {attribute for cls, attribute in IGNORED if cls is spelling.cls}
    expected = {name: field in spelling.required for name, field in spelling.attributes.items()}
    assert own == expected | dict.fromkeys(ignored, False)


@pytest.mark.parametrize("spelling", SPELLINGS.values(), ids=lambda spelling: spelling.tag)
def test_the_schema_places_elements(spelling: Spelling) -> None:
    root, place = inside(spelling.cls)
    for inner in SPELLINGS.values():
        child = etree.SubElement(place, inner.tag)
        refused = [
            v for v in violations(etree.tostring(root)) if f"'{inner.tag}': This element is not expected" in v.message
        ]
        refused += [v for v in violations(etree.tostring(root)) if "Element content is not allowed" in v.message]
        assert bool(refused) == (inner.cls not in contained(spelling.cls)), inner.tag
        place.remove(child)


def inside(cls: type[Element]) -> tuple[etree._Element, etree._Element]:
    """A model with an element of this class, and that element."""
    if cls is Model:
        root = etree.Element("Model")
        return root, root
    holders = [outer for outer in SPELLINGS if cls in contained(outer)]
    root, place = inside(Model if Model in holders else holders[0])
    return root, etree.SubElement(place, SPELLINGS[cls].tag)


# the schema of all printed spellings


def printed() -> etree.XMLSchema:
    return etree.XMLSchema(etree.parse(PRINTED / SCHEMA.name))


def test_the_printed_schema_is_made_of_the_canonical_one() -> None:
    files = {path.name: path.read_bytes() for path in PRINTED.glob("*.xsd")}
    assert files == dict(printed_schema()), "run python -m ucm_cts.harness.toolchains.corpus.printed_schema"


def test_models_fit_the_printed_schema_as_they_are_printed() -> None:
    schema = printed()
    for path in (*CORE.glob("*.xml"), *EXTENSIONS.glob("*.xml"), *MAPPING.glob("*.xml")):
        assert schema.validate(etree.parse(path)), (path, schema.error_log)
    legal = [q for q in questions() if q.due == "accept" and not q.under]
    assert [q.name for q in legal if not schema.validate(etree.fromstring(q.text))] == []


@pytest.mark.parametrize("spelling", SPELLINGS.values(), ids=lambda spelling: spelling.tag)
def test_the_printed_schema_takes_every_printed_spelling(spelling: Spelling) -> None:
    schema = printed()
    for tag in (spelling.tag, *spelling.other_tags):
        root, place = inside(spelling.cls)
        place.tag = tag
        for other in spelling.other_attributes:
            place.set(other, "x")
        schema.validate(root)
        unknown = [e.message for e in schema.error_log if "not allowed" in e.message or "not expected" in e.message]
        assert unknown == []


def test_the_printed_schema_refuses_what_stands_in_the_wrong_place() -> None:
    root, place = inside(ContractModule)
    etree.SubElement(place, "PortType", name="p")
    assert not printed().validate(root)
