"""Models that a framework ships are compared with the parts of 10.2 to 10.5 that its vendor claims."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

import pytest

from ucm_cts.adapters.contract.metamodel.common import without_lines
from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.contract.metamodel.reading import read_model
from ucm_cts.adapters.contract.metamodel.writing import write_model
from ucm_cts.adapters.reference.cpp import STATEMENT
from ucm_cts.adapters.reference.toolchain.program import reference
from ucm_cts.harness.catalogue.requirements import CLAIMABLE, claims_of, load_requirements
from ucm_cts.harness.models.core_models import CHECKS, CORE, EXTENSION_MODELS, EXTENSIONS, compare
from ucm_cts.harness.selftest.models_killing import all_models, examine_models
from ucm_cts.harness.statement.files import read_statement
from ucm_cts.harness.toolchains.corpus.schema import violations

OF_MODELS = {r.id: r.part for r in load_requirements() if r.part and set(r.rules) & CHECKS.keys()}
"""The part of each requirement of 10.2 to 10.5 that models show."""

TIME = "::container_services::clock_service::clock_api::ucm_timeval_t"


def statuses(paths: Sequence[Path], *parts: str, claims: dict[str, str] | None = None) -> dict[str, str]:
    """What becomes of the requirements of 10.2 to 10.5 that are compared."""
    results = compare(paths, claims or {}, parts).results
    return {r.requirement: r.status for r in results if r.requirement in OF_MODELS}


def broken(paths: Sequence[Path], *parts: str, claims: dict[str, str] | None = None) -> set[str]:
    return {requirement for requirement, status in statuses(paths, *parts, claims=claims).items() if status == "broken"}


def rewritten(folder: Path, *replacements: tuple[str, str], of: str = "*") -> list[Path]:
    """Our models with every ``replacements`` made in those of the extensions that ``of`` matches; each is found somewhere."""
    found = dict.fromkeys(replacements, 0)
    for path in EXTENSIONS.glob("*.xml"):
        text = path.read_text()
        for replacement in replacements if path.match(f"{of}.xml") else ():
            text, times = re.subn(*replacement, text, flags=re.DOTALL)
            found[replacement] += times
        (folder / path.name).write_text(text)
    assert all(found.values()), found
    return [CORE, folder]


# right models


def test_all_that_models_show_is_compared() -> None:
    listed = {r.id for r in load_requirements() if r.part and r.observed.startswith("Model check")}
    assert listed == OF_MODELS.keys() == statuses([], *CLAIMABLE).keys()
    assert set(statuses([], *CLAIMABLE).values()) == {"absent"}


def test_our_own_models_keep_everything() -> None:
    assert set(statuses([CORE, EXTENSIONS], *CLAIMABLE).values()) == {"kept"}
    assert statuses([CORE, EXTENSIONS]) == {}


@pytest.mark.parametrize("part", CLAIMABLE)
def test_a_part_is_compared_alone(part: str) -> None:
    expected = {requirement for requirement, of in OF_MODELS.items() if part in claims_of(of)}
    assert expected
    assert statuses([CORE, EXTENSIONS], part) == dict.fromkeys(expected, "kept")
    assert set(statuses([CORE], part).values()) <= {"broken", "absent"}
    assert "broken" in statuses([CORE], part).values()


def test_lwucm_ships_models_that_keep_everything() -> None:
    statement = read_statement(STATEMENT)
    kept = statuses(statement.model_paths, *CLAIMABLE, claims=dict(statement.readings) | {"extension-root": "core"})
    assert kept == dict.fromkeys(OF_MODELS, "kept")


@pytest.mark.parametrize("folders", [(CORE, EXTENSIONS), (STATEMENT.parent / "framework" / "models",)])
def test_models_are_legal(folders: tuple[Path, ...]) -> None:
    readings = [read_model(path.read_bytes(), path.name) for f in folders for path in sorted(f.glob("*.xml"))]
    assert [problem for reading in readings for problem in reading.problems] == []
    whole = write_model(Model(modules=tuple(m for reading in readings for m in without_lines(reading.model).modules)))
    assert violations(whole) == []
    assert [str(diagnostic) for diagnostic in reference().check(whole, "whole.xml")[1]] == []


# wrong models


@pytest.mark.slow
def test_each_requirement_is_broken_by_spoilt_models_and_by_no_other() -> None:
    assert OF_MODELS.keys() - {"R-10.5.1-18"} <= {*all_models()}
    killed = set()
    for requirement in (r for r in all_models() if r in OF_MODELS):
        result = examine_models(requirement)
        assert result.is_killed, requirement
        assert not result.spills, requirement
        killed.update(kill.requirement for kill in result.kills)
    assert killed == OF_MODELS.keys()


def test_references_lead_to_the_core(tmp_path: Path) -> None:
    path = rewritten(tmp_path, ("::return_codes::", "::other_codes::"), (TIME, "::other::ucm_timeval_t"))
    assert {"R-10.4.1.1-15", "R-10.4.2.1-05", "R-10.3.1-09", "R-10.5.1-03"} <= broken(path, *CLAIMABLE)


def test_what_is_not_claimed_may_be_missing_or_wrong(tmp_path: Path) -> None:
    submodule = '(<NonfunctionalAspectModule name="ott_timer">.*?)(?=<NonfunctionalAspectModule name="itt_timer">)'
    path = rewritten(tmp_path, (submodule, ""), of="timers")
    assert broken(path, "index-timers") == set()
    assert broken(path, "index-timers", "object-timers") == {"R-10.3-07", "R-10.3.1-03"}
    path = rewritten(tmp_path, ("bsec_offset", "offset"), of="execution_policies")
    assert broken(path, "periodic_self-executing_component") == set()
    assert broken(path, *CLAIMABLE) == {"R-10.5.1-06", "R-10.5.1-08"}


def test_port_elements_of_extended_policies_stay_with_their_base(tmp_path: Path) -> None:
    more = '<PortElement name="self-execution_api" kind="PROVIDED" interface="::a::b"/>'
    path = rewritten(tmp_path, ('(?=<ConfigurationParameter name="spac_priority")', more), of="execution_policies")
    assert broken(path, *CLAIMABLE) == {"R-10.5.1-18"}
    assert broken(path, "background_self-executing_component") == set()


def test_a_bound_item_is_found_whatever_the_order(tmp_path: Path) -> None:
    turned = (r"(<ItemBinding[^>]*>)(\s*)(<ItemBinding[^>]*>)", r"\3\2\1")
    assert broken(rewritten(tmp_path, turned, of="request_response"), "request-response") == set()
    crossed = (
        r'(interactionItem="[^"]*)request_data"(.*?)(interactionItem="[^"]*)response_data"',
        r'\1response_data"\2\3request_data"',
    )
    path = rewritten(tmp_path, crossed, of="request_response")
    assert broken(path, "request-response") == {"R-10.4.1.1-28", "R-10.4.1.1-29"}


# readings without an option

SPELLINGS = {
    "annotations": ("PropertyDefinition", "AnnotationDefinition"),
    "sizes and base characters": ('charBase="CHAR8" maxSize="-1"', 'size="-1" baseChar="CHAR8"'),
    "short strings": ('<StringType (name="[a-z_]*") charBase="CHAR8" maxSize="-1"/>', r"<String8 \1/>"),
    "strings without a bound": (' maxSize="-1"', ""),
    "primitive types": ("PrimitiveInteger", "PrimitiveType"),
    "port types": ("TemplatedPort", "PortType"),
    "connector ports": ("ConnectorPortDefinition", "ConnectorPort"),
    "abstract data types": ("DataTypeTemplateParameter", "AbstractDataType"),
    "anyNumer": ("anyNumber", "anyNumer"),
    "paths from core": ('"::(return_codes|container_services|component_execution_policies)', r'"::core::\1'),
    "paths from core without colons": ('"::(container_services|component_execution_policies)', r'"core::\1'),
    "paths of timers from core": ('"::timer::', '"::core::timer::'),
    "an index by its type": ('indexType="BYTE"', 'indexType="timer_enum_index_t"'),
    "empty default values": ('mode="READ"', 'mode="READ" defaultValue=""'),
    "small letters": ('"(IN|OUT|RETURN|PROVIDED|REQUIRED|DATA|READ)"', lambda m: m.group(0).lower()),
    "native types": ("</ContractModule>", '<NativeType name="more"/></ContractModule>'),
}


@pytest.mark.parametrize("replacement", SPELLINGS.values(), ids=SPELLINGS.keys())
def test_spelling_is_accepted(replacement: tuple[str, str], tmp_path: Path) -> None:
    assert statuses(rewritten(tmp_path, replacement), *CLAIMABLE) == dict.fromkeys(OF_MODELS, "kept")


def test_unused_index_type_may_be_missing(tmp_path: Path) -> None:
    path = rewritten(tmp_path, ('<PrimitiveInteger name="timer_enum_index_t"[^>]*>', ""), of="timers")
    left = {r: status for r, status in statuses(path, *CLAIMABLE).items() if status != "kept"}
    assert left == {"R-10.3.2-12": "left out"}


OWN_BOOLEAN = ('type="::timer::itt_timer::ucm_itt::timer_bool_t"', 'type="own_bool_t"')
BOOLEANS = {
    "a boolean": ('<PrimitiveBoolean name="own_bool_t"/>', set()),
    "an alias": ('<PrimitiveBoolean name="b"/><Alias name="own_bool_t" type="b"/>', set()),
    "an integer": ('<PrimitiveInteger name="own_bool_t" kind="BYTE"/>', {"R-10.3.1-13"}),
    "aliases in a circle": ('<Alias name="own_bool_t" type="b"/><Alias name="b" type="own_bool_t"/>', {"R-10.3.1-13"}),
    "nothing": ("", {"R-10.3.1-13"}),
}


@pytest.mark.parametrize(("declared", "expected"), BOOLEANS.values(), ids=BOOLEANS.keys())
def test_the_answer_of_an_object_timer_leads_to_a_boolean(declared: str, expected: set[str], tmp_path: Path) -> None:
    module = ('(<ContractModule name="ucm_ott">)', rf"\1{declared}")
    assert broken(rewritten(tmp_path, OWN_BOOLEAN, module, of="timers"), "object-timers") == expected


def test_the_printed_boolean_must_be_declared_for_object_timers_alone(tmp_path: Path) -> None:
    path = rewritten(tmp_path, ('<PrimitiveBoolean name="timer_bool_t"/>', ""), of="timers")
    assert broken(path, "object-timers") == {"R-10.3.1-13"}
    assert broken(path, "index-timers", "object-timers") == {"R-10.3.2-11"}


def test_a_declared_result_of_repeated_timers_must_be_there() -> None:
    claims = {"repeated-result": "timer"}
    assert broken([CORE, EXTENSIONS], "object-timers", claims=claims) == {"R-10.3.1-15"}


def test_every_file_is_declared() -> None:
    assert {d.file for d in EXTENSION_MODELS.catalogue.declarations} == {p.name for p in EXTENSIONS.glob("*.xml")}
