"""The reference model of the C++ mapping (13) and its requirements."""

from __future__ import annotations

import msgspec
import pytest
from mapping_subjects import PROFILES, expectations, model

from ucm_cts.adapters.contract.metamodel.reading import read_model
from ucm_cts.adapters.reference.toolchain.program import reference
from ucm_cts.harness.catalogue.requirements import SUITE, load_interpretations, load_requirements
from ucm_cts.harness.results.statement import default_statement
from ucm_cts.harness.toolchains.cpp.applicability import not_applicable, stand_for
from ucm_cts.harness.toolchains.cpp.probes.check import CHECKS
from ucm_cts.reference_models.mapping.cpp import claims
from ucm_cts.reference_models.mapping.cpp.claims import Claim
from ucm_cts.reference_models.mapping.cpp.classes import Named
from ucm_cts.reference_models.mapping.cpp.expected import ExpectedCpp, Standard
from ucm_cts.reference_models.mapping.cpp.mapping import expected_cpp


def of(expected: ExpectedCpp, requirement: str) -> list[Claim]:
    return [e.claim for e in expected.expected if e.requirement == requirement]


def contract(text: str, standard: Standard = "cpp11", **readings: str) -> ExpectedCpp:
    reading = read_model(f'<ContractModule name="m">{text}</ContractModule>'.encode(), "m.xml")
    return expected_cpp(reading.model, standard, {name.replace("_", "-"): value for name, value in readings.items()})


def test_each_rule_stands_for_the_requirements_of_the_catalogue() -> None:
    catalogued = {(r.id, rule) for r in load_requirements() for rule in r.rules if rule in CHECKS}
    assert {(requirement, rule) for rule, stood in stand_for().items() for requirement in stood} == catalogued
    assert set(stand_for()) == set(CHECKS)


@pytest.mark.parametrize("standard", PROFILES)
def test_nothing_is_expected_that_the_profile_does_not_have(standard: Standard) -> None:
    profile_of = {r.id: r.profile for r in load_requirements()}
    for path in sorted((SUITE / "models" / "mapping").glob("*.xml")):
        for expected in expectations(path.stem, standard).expected:
            assert profile_of[expected.requirement] in PROFILES[standard], expected


def test_expectations_name_element_and_line() -> None:
    (short,) = (e for e in expectations("data_types").expected if e.requirement == "R-13.1-02")
    assert (short.element, short.claim) == ("::data_types::short_t", claims.Is("::data_types::short_t", ("int16_t",)))
    lines = (SUITE / "models" / "mapping" / "data_types.xml").read_text().splitlines()
    assert '"short_t"' in lines[short.line - 1]


@pytest.mark.parametrize(
    ("option", "value", "requirement", "seen"),
    [
        ("cpp-byte", "int8_t", "R-13.1-01", claims.Is("::data_types::byte_t", ("int8_t",))),
        ("cpp-byte", "observed", "R-13.1-01", claims.Is("::data_types::byte_t", ("uint8_t", "int8_t"))),
        ("cpp-enum", "enum-class", "R-13.2.3-01", claims.EnumForm("::data_types::shape_t", ("enum-class",))),
        ("cpp-enum-type", "uint32_t", "R-13.2.3-04", claims.Underlying("::data_types::shape_t", ("uint32_t",))),
    ],
)
def test_readings_decide(option: str, value: str, requirement: str, seen: Claim) -> None:
    assert seen in of(expected_cpp(model("data_types"), "cpp11", {option: value}), requirement)


SIGNED = (
    '<Enumeration name="e" indexType="SHORT"><Enumerator name="below" value="-1"/><Enumerator name="above" value="1"/>'
    "</Enumeration>"
)


@pytest.mark.parametrize(
    ("value", "stored"),
    [
        ("index-type", {"int16_t"}),
        ("uint32_t", {"uint32_t", "int32_t", "int16_t"}),
        ("observed", {"uint32_t", "int32_t", "int16_t"}),
    ],
)
def test_values_below_zero_need_no_type_without_sign(value: str, stored: set[str]) -> None:
    (seen,) = of(contract(SIGNED, "cpp11", cpp_enum_type=value), "R-13.2.3-04")
    assert isinstance(seen, claims.Underlying)
    assert set(seen.types) == stored
    ordered = of(contract(SIGNED, "cpp03", cpp_enum_type=value), "R-13.10.2-10")
    assert bool(ordered) == (value != "uint32_t")


def test_policies_of_one_definition_share_getters_that_are_named_after_it() -> None:
    def of_kitchen_scale(expected: ExpectedCpp) -> tuple[list[str], claims.Startup]:
        (abstract,) = (one for one in expected.abstract if one.owner.endswith("Kitchen_Scale"))
        startups = [c for c in of(expected, "R-13.7-12") if isinstance(c, claims.Startup)]
        (startup,) = (c for c in startups if c.owner == abstract.owner)
        return [getter.name for getter in abstract.getters if "get_tp_" in getter.name], startup

    apart, all_connections = of_kitchen_scale(expectations("multiples", cpp_policy_connections="on_startup"))
    named_after_it = expectations("multiples", cpp_policy_connections="on_startup", cpp_get_tp_name="definition")
    shared, fewer_connections = of_kitchen_scale(named_after_it)
    assert len(apart) == 4
    assert shared == ["get_tp_started_starting", "get_tp_finished_finishing", "get_tp_finished_restarting"]
    assert all_connections.least == all_connections.most == fewer_connections.most == fewer_connections.least + 1


def test_other_readings_decide_names() -> None:
    suffix = expectations("ports", cpp_component_class="suffix")
    assert claims.Declares("::ports_application::people::Hermit_Impl_Abstract") in of(suffix, "R-13.7-03")
    definition = expectations("policies", cpp_get_tp_name="definition")
    assert "get_tp_self_executing_self_execution_api" in {c.method for c in of(definition, "R-13.7-17")}
    letter = expectations("policies", cpp_policy_getters="policy")
    assert [c.method for c in of(letter, "R-13.7-17")] == ["get_tp_Watch_clock_api"]
    assert of(expectations("constants", "cpp03", cpp03_float_constants="header"), "R-13.10-05") == []


def test_hyphens_are_underscores_unless_declared_otherwise() -> None:
    assert claims.Namespace("::application::with_hyphen") in of(expectations("modules"), "R-13.3-01")
    other = expectations("modules", cpp_hyphen="other")
    assert claims.Namespace("::application::with_hyphen") not in of(other, "R-13.3-01")
    assert claims.Namespace("::application::empty") in of(other, "R-13.3-01")


def test_parameters_are_passed_by_their_kinds() -> None:
    passed = {(c.method, c.position): c.types for c in of(expectations("interfaces"), "R-13.6.1-05")}
    assert passed[("textual", 1)] == ("const ::interfaces::text_t&",)
    assert passed[("chosen", 1)] == ("::interfaces::level_t", "const ::interfaces::level_t&")
    primitive = of(expectations("interfaces"), "R-13.6.1-04")
    assert {c.types for c in primitive if isinstance(c, claims.Passed)} == {
        ("::interfaces::long_t",),
        ("::interfaces::double_t",),
    }


def test_inherited_members_come_first() -> None:
    joined = next(
        c for c in of(expectations("interfaces"), "R-13.6-03") if c.owner == Named("::interfaces::Abstract_joined")
    )
    assert isinstance(joined, claims.Implemented)
    abstract = {a.key: a for a in expectations("interfaces").abstract}[joined.key]
    assert [m.name for m in abstract.methods][abstract.inherited :] == ["at_joined"]
    assert sorted(m.name for m in abstract.methods) == ["at_joined", "at_left", "at_right", "at_root"]


def test_getters_are_for_provided_port_elements() -> None:
    getters = {c.method for c in of(expectations("ports"), "R-13.7-14")}
    assert getters == {"get_left_back", "get_right_back", "get_left_in"}
    inherited = {c.method for c in of(expectations("refinement"), "R-13.7-14")}
    assert inherited == {"get_control_api", "get_north_api"}


@pytest.mark.parametrize(
    "text",
    [
        '<PrimitiveInteger name="class" kind="LONG"/>',
        '<NativeType name="handle_t" maxSize="8"/>',
        '<PrimitiveFloat name="ld_t" kind="LONGDOUBLE"/>',
        '<AbstractDataType name="t"/><Sequence name="s" type="t" indexType="LONG" maxSize="-1"/>',
    ],
)
def test_names_without_a_specified_spelling_are_not_checked(text: str) -> None:
    kinds = {type(e.claim) for e in contract(text).expected}
    assert kinds <= {claims.Namespace, claims.Declares}


@pytest.mark.parametrize(
    ("kind", "value", "cpp"),
    [
        ("LONG", "-12", "static_cast< ::m::t >(- 12)"),
        ("LONG", "1 &lt;&lt; 4 | 0x0F", "static_cast< ::m::t >(1 << 4 | 0x0F)"),
        ("LONG", "1.5e-3", "static_cast< ::m::t >(1.5e-3)"),
        ("LONG", "somewhere::else", ""),
    ],
)
def test_values_of_constants_become_cpp(kind: str, value: str, cpp: str) -> None:
    expected = contract(f'<PrimitiveInteger name="t" kind="{kind}"/><Constant name="c" type="t" value="{value}"/>')
    assert [c.value for c in of(expected, "R-13.2.7-02") if isinstance(c, claims.ConstantIs)] == ([cpp] if cpp else [])


def test_options_of_clause_13_begin_alike() -> None:
    """So that they do not get in the way of those of the IDL mapping."""
    assert all(option.startswith("cpp") for i in load_interpretations() if i.profile == "cpp" for option in i.options)


@pytest.mark.parametrize("task", PROFILES)
def test_forward_references_are_generated_in_order(task: str) -> None:
    header = reference().generators[task](model("data_types"))["data_types.hpp"]
    assert header.index("class point_t {") < header.index("path_t;") < header.index("class segment_t {")


def test_constants_in_headers_make_source_requirements_not_applicable() -> None:
    default = default_statement()
    other = msgspec.structs.replace(default, readings=default.readings | {"cpp03-float-constants": "header"})
    assert "R-13.10-05" not in not_applicable(default)
    assert "R-13.10-05" in not_applicable(other)


def test_shape_of_structures_is_asked_of_who_declares_accessors() -> None:
    default = default_statement()
    declared = msgspec.structs.replace(default, readings=default.readings | {"cpp-struct": "accessors"})
    assert list(not_applicable(default)) == ["R-13.2.1-04"]
    assert not_applicable(declared) == {}


def test_too_large_values_are_not_made() -> None:
    array = '<PrimitiveFloat name="t" kind="DOUBLE"/><Array name="a" type="t"><ArrayDimension indexType="LONG" size="{}"/></Array>'
    structure = '<Structure name="s"><StructureField name="f" type="a"/></Structure>'
    small, large = (contract(array.format(size) + structure) for size in (10, 1_000_000))
    assert of(small, "R-13.2.1-03")
    assert not of(large, "R-13.2.1-03")
    assert of(large, "R-13.2.4-02") == [claims.Sizes("::m::a", (1_000_000,))]
