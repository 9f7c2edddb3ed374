"""Models that a framework ships are compared with 10.1: declaration by declaration, in every printed spelling."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from pathlib import Path

import pytest
from lxml import etree

from ucm_cts.adapters.reference.cpp import STATEMENT
from ucm_cts.harness.catalogue.documents import DocumentError
from ucm_cts.harness.catalogue.requirements import load_interpretations
from ucm_cts.harness.models import core_models
from ucm_cts.harness.models.core_models import CORE, OWN_MODELS, compare
from ucm_cts.harness.selftest.model_variants import ModelVariant, examine_model_variant, model_variants
from ucm_cts.harness.selftest.spoilt_models import Place, declarations, repeating, spoilt_results
from ucm_cts.harness.statement.files import read_statement

DECLARATIONS = declarations()


def having(
    status: str, path: Path | Sequence[Path], claims: Mapping[str, str] = {}, parts: Sequence[str] = ()
) -> set[str]:
    paths = [path] if isinstance(path, Path) else path
    return {r.requirement for r in compare(paths, claims, parts).results if r.status == status}


def test_our_own_models_keep_everything() -> None:
    assert {r.status for r in compare([CORE]).results} == {"kept"}
    assert compare([CORE]) == compare(sorted(CORE.glob("*.xml"), reverse=True))


def test_every_element_is_a_declaration() -> None:
    for models in OWN_MODELS:
        elements = sum(len(list(etree.parse(path).getroot().iter("*"))) for path in models.folder.glob("*.xml"))
        places = [place for places in DECLARATIONS.values() for place in places if place.models is models]
        assert elements == len(places) == len({place.element for place in places})


def test_without_models_everything_is_absent() -> None:
    assert {r.status for r in compare([]).results} == {"absent"}


@pytest.mark.parametrize("requirement", DECLARATIONS)
def test_changed_declaration_breaks_its_requirement_alone(requirement: str) -> None:
    for place, mutation, results in spoilt_results(requirement):
        wrong = {r for r, result in results.items() if result.status in ("broken", "unclear")}
        assert mutation.requirement in wrong, mutation.what
        assert wrong - {mutation.requirement} <= repeating(mutation.requirement), mutation.what
        assert results[mutation.requirement].status == ("broken" if mutation.clear else "unclear"), mutation.what
        assert results[mutation.requirement].expected
        assert results[mutation.requirement].observed
        absent = {r for r, result in results.items() if result.status == "absent" and r in DECLARATIONS}
        assert absent in (set(), requirements_inside(place) - {requirement}), mutation.what


def requirements_inside(place: Place) -> set[str]:
    """The requirements that speak of something inside what stands at ``place``."""
    beside = ((r, other) for r, places in DECLARATIONS.items() for other in places if other.file == place.file)
    return {r for r, other in beside if place.element in other.element.iterancestors()}


@pytest.mark.slow
def test_every_requirement_can_be_broken() -> None:
    outcomes = [results for requirement in DECLARATIONS for _, _, results in spoilt_results(requirement)]
    broken = {r for results in outcomes for r, result in results.items() if result.status == "broken"}
    assert broken == {r for requirements in core_models.checked().values() for r in requirements}


# spellings


def rewritten(folder: Path, *replacements: tuple[str, str], of: str = "*") -> Path:
    """Our models with every ``replacements`` made in the files that ``of`` matches; each is found somewhere."""
    texts = {path.name: path.read_text() for path in CORE.glob("*.xml")}
    for pattern, text in replacements:
        found = 0
        for path in CORE.glob(f"{of}.xml"):
            texts[path.name], times = re.subn(pattern, text, texts[path.name], flags=re.DOTALL)
            found += times
        assert found, pattern
    for name, content in texts.items():
        (folder / name).write_text(content)
    return folder


SPELLINGS = {
    "port types": [("TemplatedPort", "PortType")],
    "connector ports": [("ConnectorPortDefinition", "ConnectorPort")],
    "abstract interfaces": [("InterfaceTypeTemplateParameter", "AbstractInterface")],
    "interface parameters": [("InterfaceTypeTemplateParameter", "InterfaceTemplateParameter")],
    "abstract data types": [("DataTypeTemplateParameter", "AbstractDataType")],
    "primitive types": [("PrimitiveInteger", "PrimitiveType")],
    "aliased primitives": [('kind="(BYTE|U?LONG)"', r'aliasedPrimitive="\1"')],
    "index values": [(' value="', ' indexValue="')],
    "intf": [(" interface=", " intf=")],
    "anyNumer": [('"anyNumber"', '"anyNumer"')],
    "string types": [("<String8 ", '<StringType charBase="CHAR8" '), ("<String32 ", '<StringType charBase="CHAR32" ')],
    "base characters": [("<String8 ", '<StringType size="-1" baseChar="CHAR8" ')],
    "sizes": [("<String8 ", '<String8 maxSize="-1" ')],
    "small letters": [('"(IN|OUT|RETURN|PROVIDED|REQUIRED|DATA)"', lambda m: m.group(0).lower())],
    "full paths": [('"execution_policies_api::', '"::component_execution_policies::execution_policies_api::')],
    "paths from core": [('"::return_codes', '"::core::return_codes')],
    "classes of modules": [
        ("InteractionModule", "InteractionDefinitionModule"),
        (
            r'NonfunctionalAspectModule (name="clock_service".*?</)Non.*?Module',
            r"TechnicalPolicyModule \1TechnicalPolicyModule",
        ),
    ],
    "identifiers": [(' name="', ' identifier="')],
    "identifiers beside names": [(' name="', ' identifier="17" name="')],
    "comments of the meta-model": [("(<(Method|Structure|InteractionRole)[^>/]*>)", r'\1<SimpleComment text="said"/>')],
    "a namespace": [("(<[A-Za-z]*Module name=[^>]*)(>)", r'\1 xmlns="urn:some"\2')],
    "comments": [("(<(Method|Parameter|InvolvedItem)[^>]*>)", r"<!-- said -->\1<?said?>")],
    "further attributes": [("<Method ", '<Method comment="said" ')],
    "further declarations": [("</ContractModule>", '<Structure name="more"/></ContractModule>')],
}
"""What may be written otherwise in any model of clause 10."""


@pytest.mark.parametrize("replacements", SPELLINGS.values(), ids=SPELLINGS.keys())
def test_spelling_is_accepted(replacements: list[tuple[str, str]], tmp_path: Path) -> None:
    results = compare([rewritten(tmp_path, *replacements)]).results
    assert [r for r in results if r.status != "kept"] == []


def test_all_spellings_at_once_in_one_file(tmp_path: Path) -> None:
    for name in (
        "port types",
        "connector ports",
        "abstract interfaces",
        "abstract data types",
        "primitive types",
        "intf",
    ):
        for pattern, text in SPELLINGS[name]:
            for path in tmp_path.glob("*.xml") if list(tmp_path.glob("*.xml")) else CORE.glob("*.xml"):
                (tmp_path / path.name).write_text(re.sub(pattern, text, path.read_text()))
    whole = "".join(re.sub(r"<\?xml.*?\?>", "", p.read_text()) for p in sorted(tmp_path.glob("*.xml")))
    (tmp_path / "all").write_text(f"<UCM>{whole}</UCM>")
    assert {r.status for r in compare([tmp_path / "all"]).results} == {"kept"}


def test_a_module_in_pieces_is_one(tmp_path: Path) -> None:
    opened = "".join(f'<NonfunctionalAspectModule name="{n}">' for n in ("container_services", "clock_service"))
    cut = f"{'</NonfunctionalAspectModule>' * 2}</M><M>{opened}"
    rewritten(tmp_path, ('(<TechnicalAspect name="clock"[^>]*>)', rf"\1{cut}"), of="container*")
    first, second = (tmp_path / "container_services.xml").read_text().split("</M><M>")
    (tmp_path / "container_services.xml").write_text(first)
    (tmp_path / "more.xml").write_text(second)
    assert {r.status for r in compare([tmp_path]).results} == {"kept"}


def test_a_spelling_that_is_never_printed_is_unclear(tmp_path: Path) -> None:
    path = rewritten(tmp_path, ('<Method name="run"', '<Method id="run"'))
    assert having("unclear", path) == {"R-10.1.3.1-10"}
    path = rewritten(tmp_path, (' direction="OUT"', ' way="OUT"'))
    assert having("unclear", path) == {"R-10.1.4.2-21", "R-10.1.4.2-23"}
    assert not having("broken", path)
    path = rewritten(tmp_path, ('(upperMultiplicity)="-1"', r'\1="*"'), of="messages")
    assert having("unclear", path) == {"R-10.1.6.2-09", "R-10.1.6.2-11"}
    path = rewritten(tmp_path, (r'"service_interaction_pattern\.', '"'), of="services")
    assert having("unclear", path) == {"R-10.1.5.2-15", "R-10.1.5.2-16", "R-10.1.5.2-17"}
    assert not having("broken", path)


def test_unrelated_declarations_do_not_excuse_missing_ones(tmp_path: Path) -> None:
    path = rewritten(tmp_path, ('<Method name="run"/>', '<SimpleComment text="run"/>'))
    (path / "more.xml").write_text('<PlatformModule name="more"/>')
    (path / "return_codes.xml").unlink()
    assert having("broken", path) == {"R-10.1.2-03", "R-10.1.3.1-10"}
    assert not having("unclear", path)


# a framework's own models

BESIDE = """
<NonfunctionalAspectModule name="periods">
  <TechnicalPolicyDefinition name="periodic" applicability="onComponent"
                             extends="::core::component_execution_policies::protected_self-executing_component"
                             technicalAspect="::core::component_execution_policies::component_execution_policy">
    <ConfigurationParameter name="period" type="::core::container_services::clock_service::clock_api::ucm_timeval_t"/>
  </TechnicalPolicyDefinition>
</NonfunctionalAspectModule>
"""


def test_lwucm_ships_models_that_keep_everything(tmp_path: Path) -> None:
    statement = read_statement(STATEMENT)
    (tmp_path / "beside.xml").write_text(BESIDE)
    for paths in (statement.model_paths, (*statement.model_paths, tmp_path)):
        comparison = compare(paths, statement.readings)
        assert [r for r in comparison.results if r.status != "kept"] == []
        declared = {o: v for o, v in statement.readings.items() if v != "observed" and o in comparison.readings}
        assert all(comparison.readings[option] == {value} for option, value in declared.items())
        assert declared["core-root"] == "core"


# readings


@pytest.mark.parametrize("variant", model_variants().values(), ids=model_variants().keys())
def test_reading(variant: ModelVariant, tmp_path: Path) -> None:
    result = examine_model_variant(variant.name)
    assert result.is_spared, result
    option, value, paths, parts = variant.option, variant.value, variant.write(tmp_path), variant.parts
    first = core_models._first_values()[option]
    assert value in compare(paths, {option: value}, parts).readings.get(option, {value})
    undeclared = having("broken", paths, parts=parts) - {"R-10.1.4.2-24"}
    if first != "observed":
        assert undeclared == variant.concerned
        return
    assert undeclared == set()
    assert compare(paths, parts=parts).readings[option] == {value}
    for other in values_of(option) - {first, value}:
        if variant.root != "both":  # then each claim holds
            broken = having("broken", paths, {option: other}, parts)
            assert broken
            assert broken & variant.concerned or not variant.concerned


def values_of(option: str) -> set[str]:
    return {value for entry in load_interpretations() for value in entry.options.get(option, ())}


def test_unused_type_may_be_missing(tmp_path: Path) -> None:
    path = rewritten(tmp_path, ('<PrimitiveInteger name="log_severity_enumerator_t"[^>]*>', ""))
    assert (having("left out", path), having("broken", path)) == ({"R-10.1.4.2-45"}, set())


def test_index_type_may_be_missing_only_if_nothing_names_it(tmp_path: Path) -> None:
    declared = ('<PrimitiveInteger name="comm_ecode_enumerator_t"[^>]*>', "")
    assert having("broken", rewritten(tmp_path, declared)) == {"R-10.1.2-08"}
    path = rewritten(tmp_path, declared, ('indexType="comm_ecode_enumerator_t"', 'indexType="BYTE"'))
    assert (having("left out", path), having("broken", path)) == ({"R-10.1.2-08"}, set())


def test_declared_parameters_that_should_not_be_there_are_found(tmp_path: Path) -> None:
    assert having("broken", CORE, {"port-trace-parameters": "none"}) == {"R-10.1-02"}


def test_twins_are_compared_in_no_time(tmp_path: Path) -> None:
    def tree(depth: int, leaf: str) -> str:
        inside = tree(depth - 1, "a") + tree(depth - 1, leaf) if depth else ""
        return f'<Interface name="{leaf if not depth else "x"}">{inside}</Interface>'

    twins = "".join(f'<Enumeration name="comm_ecode">{tree(10, leaf)}</Enumeration>' for leaf in "bc")
    (tmp_path / "twins.xml").write_text(f'<ContractModule name="return_codes">{twins}</ContractModule>')
    assert "R-10.1.2-04" in having("broken", tmp_path)


def test_root(tmp_path: Path) -> None:
    core = tmp_path / "core"
    core.mkdir()
    for path in CORE.glob("*.xml"):
        inner = re.sub(r"<\?xml.*?\?>", "", path.read_text())
        (core / path.name).write_text(f'<InteractionModule name="core">{inner}</InteractionModule>')
    modules = {"R-10.1.2-03", "R-10.1.3.1-02", "R-10.1.4.2-07", "R-10.1.5.2-01", "R-10.1.6.2-01"}
    for paths, met in (([CORE], "none"), ([core], "core"), ([core, CORE], "both")):
        assert compare(paths).readings["core-root"] == {met}
        for claim in ("observed", "none", "core", "both"):
            broken = {r.requirement for r in compare(paths, {"core-root": claim}).results if r.status == "broken"}
            fits = claim in ("observed", met) or met == "both"
            assert broken == (set() if fits else modules), (met, claim)
    (core / "services.xml").write_text((core / "services.xml").read_text().replace('"client"', '"customer"'))
    assert "R-10.1.5.2-01" in {r.requirement for r in compare([core, CORE]).results if r.status == "broken"}


# hostile files

ENTITY = '<!DOCTYPE a [<!ENTITY b SYSTEM "file:///etc/passwd">]>'
LAUGHS = "<!DOCTYPE a [" + "".join(f'<!ENTITY l{n + 1} "{f"&l{n};" * 10}">' for n in range(9)) + "]>"
HOSTILE = {
    "entity": (f"<?xml version='1.0'?>\n<!-- x -->\n{ENTITY}<a>&b;</a>", 3, "take the DOCTYPE out"),
    "entity in an attribute": (f"{LAUGHS}<a b='&l9;'/>", 1, "take the DOCTYPE out"),
    "external document type": ('\n<!DOCTYPE a SYSTEM "http://localhost:9/a.dtd"><a/>', 2, "take the DOCTYPE out"),
    "many comments": ("<!---->" * 50_000, 1, "is not XML"),
    "unknown entity": ("<a>\n&b;</a>", 2, "is not XML"),
    "not closed": ("<a>\n<b>\n</a>", 3, "is not XML"),
    "two roots": ("<a/>\n<b/>", 2, "is not XML"),
    "nothing": ("", 1, "is not XML"),
    "too deep": ("<a>" * 5000 + "</a>" * 5000, 1, "is not XML"),
    "too large": ("<a>" + " " * 5_000_000 + "</a>", None, "split it"),
    "another encoding": ("<?xml version='1.0' encoding='UTF-7'?><a/>", 1, "save it as UTF-8"),
    "UTF-16": ("<a/>".encode("utf-16"), 1, "save it as UTF-8"),
    "not UTF-8": (b"<a>\n\xff</a>", 2, "save it as UTF-8"),
    "a NUL": ("<a>\0</a>", 1, "is not XML"),
}


@pytest.mark.parametrize(("content", "line", "remedy"), HOSTILE.values(), ids=HOSTILE.keys())
def test_hostile_file_is_one_clear_message(content: str | bytes, line: int | None, remedy: str, tmp_path: Path) -> None:
    path = tmp_path / "hostile.xml"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    with pytest.raises(DocumentError) as raised:
        compare([CORE, path])
    message = str(raised.value)
    assert message.startswith(f"{path}:{line}: " if line else f"{path}: ")
    assert remedy in message
    assert "\n" not in message
    assert len(message) < 400


def test_missing_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(DocumentError, match=r"no_such\.xml: cannot be read"):
        compare([tmp_path / "no_such.xml"])


def test_files_of_other_kinds_are_no_core_models(tmp_path: Path) -> None:
    (tmp_path / "page.xml").write_text("<html><body name='return_codes'>&#8364;<p/></body></html>")
    statuses = {r.status for r in compare([tmp_path]).results}
    assert statuses <= {"broken", "absent", "left out", "unclear"}
