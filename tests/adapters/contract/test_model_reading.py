"""Models are read and written in every printed spelling; every problem is reported with its line and a remedy."""

from __future__ import annotations

from pathlib import Path

import pytest

from ucm_cts.adapters.contract.metamodel import aspects, components, contracts, interactions
from ucm_cts.adapters.contract.metamodel.common import Element, SimpleComment, walk, without_lines
from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.contract.metamodel.reading import MOST_PROBLEMS, Problem, read_model
from ucm_cts.adapters.contract.metamodel.spelling import LITERALS, SPELLINGS, TAGS, contained
from ucm_cts.adapters.contract.metamodel.writing import Dialect, write_model
from ucm_cts.harness.models.core_models import CORE, EXTENSIONS


def problems(text: str) -> list[tuple[str, int]]:
    return [(problem.kind, problem.line) for problem in read_model(text.encode(), "m.xml").problems]


def only(text: str) -> Problem:
    (problem,) = read_model(text.encode(), "m.xml").problems
    return problem


def module(inside: str) -> contracts.ContractModule:
    """What a contract module has that contains ``inside``."""
    reading = read_model(f'<ContractModule name="m">{inside}</ContractModule>'.encode(), "m.xml")
    assert not reading.problems
    (read,) = reading.model.modules
    assert isinstance(read, contracts.ContractModule)
    return without_lines(read)


# the tables


def test_every_class_has_a_spelling() -> None:
    def below(cls: type[Element]) -> set[type[Element]]:
        return {cls}.union(*(below(inner) for inner in cls.__subclasses__()))

    abstract = {Element, contracts.Annotable, contracts.DataType}
    assert {cls for cls in below(Element) if cls.__name__ != "Named"} - abstract == set(SPELLINGS)


def test_every_class_can_be_reached() -> None:
    assert {inner for outer in SPELLINGS for inner in contained(outer)} | {Model} == set(SPELLINGS)


def test_each_part_of_an_element_goes_to_one_field() -> None:
    for spelling in SPELLINGS.values():
        fields = {cls: {f for f, held in spelling.contained.items() if issubclass(cls, held)} for cls in SPELLINGS}
        assert all(len(found) <= 1 for found in fields.values()), spelling.tag


def test_no_attribute_is_called_like_a_field_that_holds_elements() -> None:
    """Otherwise an attribute could be written to it; see ``_RENAMED`` in ``reading``."""
    holding = {field for spelling in SPELLINGS.values() for field in spelling.contained} | {"line"}
    assert not holding & {attribute for spelling in SPELLINGS.values() for attribute in spelling.attributes}


def test_no_attribute_means_two_fields() -> None:
    meaning = {pair for spelling in SPELLINGS.values() for pair in spelling.attributes.items()}
    assert len({attribute for attribute, _ in meaning}) == len({field for _, field in meaning}) == len(meaning)


# what is printed


@pytest.mark.parametrize(
    "path", [*sorted(CORE.glob("*.xml")), *sorted(EXTENSIONS.glob("*.xml"))], ids=lambda path: path.stem
)
def test_models_of_the_platform_are_read_and_written(path: Path) -> None:
    reading = read_model(path.read_bytes(), path.name)
    assert reading.problems == ()
    again = read_model(write_model(reading.model), path.name)
    assert again.problems == ()
    assert without_lines(again.model) == without_lines(reading.model)


SAME = {
    "PrimitiveType": ('<PrimitiveType name="t" kind="LONG"/>', '<PrimitiveInteger name="t" kind="LONG"/>'),
    "aliasedPrimitive": (
        '<PrimitiveChar name="t" aliasedPrimitive="CHAR8"/>',
        '<PrimitiveChar name="t" kind="CHAR8"/>',
    ),
    "identifier": ('<PrimitiveBoolean identifier="t"/>', '<PrimitiveBoolean name="t"/>'),
    "identifier beside name": ('<PrimitiveBoolean name="t" identifier="17"/>', '<PrimitiveBoolean name="t"/>'),
    "String8": ('<String8 name="t"/>', '<StringType name="t" charBase="CHAR8"/>'),
    "String32": ('<String32 name="t" maxSize="5"/>', '<StringType name="t" charBase="CHAR32" maxSize="5"/>'),
    "baseChar": (
        '<StringType name="t" size="-1" baseChar="CHAR8"/>',
        '<StringType name="t" charBase="CHAR8" maxSize="-1"/>',
    ),
    "indexValue": (
        '<Enumeration name="t" indexType="LONG"><Enumerator name="a" indexValue="1"/></Enumeration>',
        '<Enumeration name="t" indexType="LONG"><Enumerator name="a" value="1"/></Enumeration>',
    ),
    "@ushort": ('<Enumeration name="t" type="@ushort"/>', '<Enumeration name="t" indexType="USHORT"/>'),
    "ushort": ('<Enumeration name="t" type="ushort"/>', '<Enumeration name="t" indexType="USHORT"/>'),
    "ArrayType": ('<ArrayType name="t" type="a"/>', '<Array name="t" type="a"/>'),
    "SequenceType": (
        '<SequenceType name="t" type="a" indexType="LONG" maxSize="2"/>',
        '<Sequence name="t" type="a" indexType="LONG" maxSize="+2"/>',
    ),
    "DataTypeTemplateParameter": ('<DataTypeTemplateParameter name="t"/>', '<AbstractDataType name="t"/>'),
    "InterfaceTypeTemplateParameter": ('<InterfaceTypeTemplateParameter name="t"/>', '<AbstractInterface name="t"/>'),
    "InterfaceTemplateParameter": ('<InterfaceTemplateParameter name="t"/>', '<AbstractInterface name="t"/>'),
    "PropertyDefinition": ('<PropertyDefinition name="t"/>', '<AnnotationDefinition name="t"/>'),
    "small letters": (
        '<Interface name="t"><Attribute name="a" type="b" mode="read"/></Interface>',
        '<Interface name="t"><Attribute name="a" type="b" mode="READ"/></Interface>',
    ),
    "truths": (
        '<Union name="u" selectorName="s" selectorType="e"><UnionCase name="c" type="t" defaultCase="1"/></Union>',
        '<Union name="u" selectorName="s" selectorType="e"><UnionCase name="c" type="t" defaultCase="true"/></Union>',
    ),
    "comments of XML": ('<!-- said --><Structure name="t"><?said?></Structure>', '<Structure name="t"/>'),
    "an order of kinds": (
        '<Interface name="i"/><Structure name="s"/><Alias name="a" type="s"/>',
        '<Structure name="s"/><Alias name="a" type="s"/><Interface name="i"/>',
    ),
    "attributes in a namespace": (
        '<Structure name="t" xmlns:xsi="urn:x" xsi:name="other" xml:lang="en"/>',
        '<Structure name="t"/>',
    ),
}


@pytest.mark.parametrize(("other", "canonical"), SAME.values(), ids=SAME.keys())
def test_spellings_mean_the_same(other: str, canonical: str) -> None:
    assert module(other) == module(canonical)
    assert len(list(walk(module(other)))) > 1


MODULES_OF_OTHER_NAMES = {
    "InteractionDefinitionModule": "InteractionModule",
    "TechnicalPolicyModule": "NonfunctionalAspectModule",
    "TechnicalAspectModule": "NonfunctionalAspectModule",
}


@pytest.mark.parametrize(("other", "canonical"), MODULES_OF_OTHER_NAMES.items())
def test_modules_have_several_names(other: str, canonical: str) -> None:
    ours = read_model(f'<{other} name="m"><{canonical} name="i"/></{other}>'.encode(), "m.xml")
    assert ours.problems == ()
    assert type(ours.model.modules[0]).__name__ == canonical


def test_ports_of_interactions_have_several_spellings() -> None:
    printed = read_model(
        b"""<InteractionModule name="m" extends="n">
          <TemplatedPort name="p"><PortElement name="e" intf="i" kind="required"/></TemplatedPort>
          <ConnectorDefinition name="c" pattern="p"><ConnectorPortDefinition name="r" portRole="p.r"/></ConnectorDefinition>
          <InteractionPattern name="p"><InteractionItem name="i" nature="data"/></InteractionPattern>
        </InteractionModule>""",
        "m.xml",
    )
    assert printed.problems == ()
    assert without_lines(printed.model.modules[0]) == interactions.InteractionModule(
        name="m",
        patterns=(
            interactions.InteractionPattern(name="p", items=(interactions.InteractionItem(name="i", nature="DATA"),)),
        ),
        connectors=(
            interactions.ConnectorDefinition(
                name="c", pattern="p", ports=(interactions.ConnectorPort(name="r", port_role="p.r"),)
            ),
        ),
        port_types=(
            interactions.PortType(
                name="p", port_elements=(interactions.PortElement(name="e", interface="i", kind="REQUIRED"),)
            ),
        ),
    )


def test_both_encodings_of_delegations_are_kept() -> None:
    read = read_model(
        b"""<ComponentModule name="m"><CompositeComponentImplementation name="c" type="t">
          <Part name="a" instanceOf="t"/><AssemblyPart name="b" instanceof="t"/>
          <PortDelegation port="p"><ConnectionEnd part="a" port="q"/></PortDelegation>
          <PortDelegation name="d" externalPort="p" internalPart="a" internalPort="q"/>
        </CompositeComponentImplementation></ComponentModule>""",
        "m.xml",
    )
    assert read.problems == ()
    composite = without_lines(read.model).modules[0].implementations[0]  # type: ignore[union-attr]
    assert isinstance(composite, components.CompositeComponentImplementation)
    assert [part.instance_of for part in composite.parts] == ["t", "t"]
    assert composite.delegations == (
        components.PortDelegation(port="p", ends=(components.ConnectionEnd(part="a", port="q"),)),
        components.PortDelegation(name="d", port="p", internal_part="a", internal_port="q"),
    )


def test_comments_of_the_model_are_kept() -> None:
    assert module('<SimpleComment text="said"/><SimpleComment Text="more"/>').comments == (
        SimpleComment(text="said"),
        SimpleComment(text="more"),
    )


def test_any_number_is_misspelt_in_prose() -> None:
    read = read_model(
        b'<NonfunctionalAspectModule name="m"><TechnicalAspect name="a" multiplicity="anyNumer"/></NonfunctionalAspectModule>',
        "m.xml",
    )
    assert without_lines(read.model).modules == (
        aspects.NonfunctionalAspectModule(
            name="m", technical_aspects=(aspects.TechnicalAspect(name="a", multiplicity="anyNumber"),)
        ),
    )


def test_a_root_without_name_holds_several_modules() -> None:
    several = read_model(b'<Model>\n<ContractModule name="a"/>\n<ContractModule name="b"/></Model>', "m.xml")
    assert [(m.name, m.line) for m in several.model.modules] == [("a", 2), ("b", 3)]
    assert write_model(several.model).count(b"Model>") == 2
    alone = read_model(b'<Model><ContractModule name="a"/></Model>', "m.xml")
    assert b"Model>" not in write_model(alone.model)


def test_a_namespace_changes_nothing() -> None:
    plain = read_model(b'<ContractModule name="m"><Structure name="s"/></ContractModule>', "m.xml")
    default = b'<ContractModule xmlns="urn:u" name="m"><Structure name="s"/></ContractModule>'
    prefixed = b'<u:ContractModule xmlns:u="urn:u" name="m"><u:Structure name="s"/></u:ContractModule>'
    assert read_model(default, "m.xml") == read_model(prefixed, "m.xml") == plain
    foreign = only('<ContractModule name="m"><v:Structure xmlns:v="urn:v" name="s"/></ContractModule>')
    assert (foreign.kind, foreign.element) == ("unknown element", "Structure")


def test_lines_are_those_of_the_file() -> None:
    lines = "\n" * 70_000
    text = f'<ContractModule name="m">{lines}<Structure\n name="s"/>\n<Structure/></ContractModule>'
    reading = read_model(text.encode(), "m.xml")
    assert [s.line for s in reading.model.modules[0].data_types] == [70_001, 70_003]  # type: ignore[union-attr]
    assert [p.line for p in reading.problems] == [70_003]


# dialects


def test_core_in_another_dialect_is_the_same() -> None:
    dialect = Dialect(
        tags={
            "PortType": "TemplatedPort",
            "ConnectorPort": "ConnectorPortDefinition",
            "PrimitiveInteger": "PrimitiveType",
            "AbstractDataType": "DataTypeTemplateParameter",
        },
        attributes={"name": "identifier", "PrimitiveInteger.kind": "aliasedPrimitive", "interface": "intf"},
        literals={word.upper(): word for word in ("in", "out", "return", "provided", "required", "data", "interface")},
        short_strings=True,
    )
    for path in sorted(CORE.glob("*.xml")):
        model = without_lines(read_model(path.read_bytes(), path.name).model)
        written = write_model(model, dialect)
        assert b" name=" not in written
        assert not any(tag.encode() + b" " in written for tag in (*dialect.tags, "StringType"))
        again = read_model(written, path.name)
        assert (again.problems, without_lines(again.model)) == ((), model)


def test_a_delegation_is_written_in_either_printed_way() -> None:
    delegations = (
        components.PortDelegation(port="p", ends=(components.ConnectionEnd(name="e", part="a", port="q"),)),
        components.PortDelegation(port="p"),
    )
    composite = components.CompositeComponentImplementation(name="c", type="t", delegations=delegations)
    model = Model(modules=(components.ComponentModule(name="m", implementations=(composite,)),))
    written = write_model(model, Dialect(delegation_attributes=True))
    assert b'<PortDelegation port="p" internalPart="a" internalPort="q"/>' in written
    assert b'<PortDelegation port="p"/>' in written
    assert b"ConnectionEnd" not in written
    assert b'<ConnectionEnd name="e" part="a" port="q"/>' in write_model(model)


def test_any_value_survives_writing_and_reading() -> None:
    value = "a<b>&\"'\t\n\r é\u2028\U0001f600"
    model = Model(
        modules=(
            contracts.ContractModule(name="m", constants=(contracts.Constant(name=value, type="t", value=value),)),
        )
    )
    assert without_lines(read_model(write_model(model), "m.xml").model) == model


# what does not fit

WRONG = {
    "unknown element": ('<Structur name="s"/>', "unknown element", "Structur"),
    "misplaced element": ('<Parameter name="p" direction="IN" type="t"/>', "misplaced element", "Method"),
    "unknown attribute": ('<Structure name="s" kind="LONG"/>', "unknown attribute", "kind"),
    "a field's name": ('<Structure name="s" fields="LONG"/>', "unknown attribute", "fields"),
    "a line": ('<Structure name="s" line="LONG"/>', "unknown attribute", "line"),
    "Python's spelling": ('<NativeType name="s" max_size="4" maxSize="4"/>', "unknown attribute", "max_size"),
    "a spelling of another class": ('<PrimitiveInteger name="s" kind="LONG" size="4"/>', "unknown attribute", "size"),
    "two spellings of one": (
        '<PrimitiveInteger name="s" kind="LONG" aliasedPrimitive="BYTE"/>',
        "unknown attribute",
        "kind",
    ),
    "characters of short strings": ('<String8 name="s" charBase="CHAR32"/>', "unknown attribute", "charBase"),
    "no name": ("<Structure/>", "missing attribute", "name"),
    "no type": ('<Alias name="a"/>', "missing attribute", "type"),
    "a word": ('<PrimitiveInteger name="s" kind="INT"/>', "bad literal", "LONGLONG"),
    "a word in small letters": ('<PrimitiveInteger name="s" kind="long"/>', "bad literal", "LONGLONG"),
    "no word": ('<PrimitiveInteger name="s" kind=""/>', "bad literal", "LONGLONG"),
    "letters": ('<NativeType name="s" maxSize="four"/>', "bad number", "four"),
    "underscores": ('<NativeType name="s" maxSize="1_0"/>', "bad number", "1_0"),
    "digits of other scripts": ('<NativeType name="s" maxSize="٤"/>', "bad number", "٤"),
    "no digits": ('<NativeType name="s" maxSize=""/>', "bad number", "maxSize"),
    "too many digits": (f'<NativeType name="s" maxSize="{"9" * 9999}"/>', "bad number", "20 digits"),
    "text": ('<Structure name="s">fields</Structure>', "text", "fields"),
    "text in CDATA": ('<Structure name="s"><![CDATA[fields]]></Structure>', "text", "fields"),
}


@pytest.mark.parametrize(("inside", "kind", "reported"), WRONG.values(), ids=WRONG.keys())
def test_each_problem_is_reported(inside: str, kind: str, reported: str) -> None:
    problem = only(f'<ContractModule name="m">\n{inside}\n</ContractModule>')
    assert (problem.kind, problem.line) == (kind, 2)
    assert reported in problem.message
    assert "\n" not in problem.message
    assert len(problem.message) < 500


def test_truths_are_two() -> None:
    inside = (
        '<Union name="u" selectorName="s" selectorType="e"><UnionCase name="c" type="t" defaultCase="yes"/></Union>'
    )
    problem = only(f'<ContractModule name="m">{inside}</ContractModule>')
    assert problem.message == "UnionCase 'c': defaultCase is 'yes', but must be one of true, false, 1, 0"


def test_all_problems_are_reported() -> None:
    assert problems(
        """<ContractModule>
             <Structure/>
             text
             <Zork><Structure/></Zork>
             <Alias type="t" typo="t"/>
             <PrimitiveInteger name="i" kind="INT"/>
           </ContractModule>"""
    ) == [
        ("missing attribute", 1),
        ("missing attribute", 2),
        ("text", 3),
        ("unknown element", 4),
        ("unknown attribute", 5),
        ("missing attribute", 5),
        ("bad literal", 6),
    ]


def test_correct_parts_are_read_beside_problems() -> None:
    reading = read_model(b'<ContractModule name="m"><Zork/><Structure name="s" kind="LONG"/></ContractModule>', "m.xml")
    assert len(reading.problems) == 2
    assert without_lines(reading.model).modules[0].data_types == (contracts.Structure(name="s"),)  # type: ignore[union-attr]


def test_problems_are_counted() -> None:
    reported = problems(f'<ContractModule name="m">{"<Zork/>" * 10 * MOST_PROBLEMS}</ContractModule>')
    assert len(reported) == MOST_PROBLEMS + 1
    assert reported[-1][0] == "refused"


def test_words_are_known_in_their_canonical_form() -> None:
    for fields in LITERALS.values():
        for words in fields.values():
            assert set(words.values()) <= set(words)


def test_other_tags_are_unique() -> None:
    tags = [tag for spelling in SPELLINGS.values() for tag in (spelling.tag, *spelling.other_tags)]
    assert len(tags) == len(set(tags)) == len(TAGS) - 2
