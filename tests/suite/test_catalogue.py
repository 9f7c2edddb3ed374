"""The catalogue, the table, the interpretations, the rules and the scenarios name each other correctly and completely."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from ucm_cts.harness.catalogue.profiles import PARTS, PROFILES, TOOLCHAIN_PROFILES
from ucm_cts.harness.catalogue.requirements import (
    Requirement,
    claims_of,
    declarable,
    in_the_making,
    load_capabilities,
    load_interpretations,
    load_life_cycle,
    load_options,
    load_requirements,
    requirements_of,
    unfinished_parts,
)
from ucm_cts.harness.execution.leftovers import FREED, HOST_CHECKS
from ucm_cts.harness.models.core_models import CHECKS, checked
from ucm_cts.harness.purposes.derived.life_cycle import generated_purposes
from ucm_cts.harness.purposes.selection import load_purposes
from ucm_cts.harness.toolchains.examinations import TOOLCHAIN_CHECKS, stand_for
from ucm_cts.reference_models.properties.table import PROPERTIES

REQUIREMENTS = {r.id: r for r in load_requirements()}
STANDS_FOR = (
    {rule.name: rule.stands_for for rule in PROPERTIES.values()}
    | checked()
    | stand_for()
    | dict.fromkeys(HOST_CHECKS, (FREED,))
)
INTERPRETATIONS = {i.id: i for i in load_interpretations()}

NOT_FROM_THE_TABLE = {
    "initialized/connect/container started",
    "configured/connect/container started",
    "initialized/disconnect/container started",
    "configured/disconnect/container started",
    "configured/disconnect/another connection remains",
    "configured/start/all configured after reconnecting",
    "initialized/remove_component/attached",
    "configured/remove_component/attached",
    "initialized/remove_provider/attached",
    "configured/remove_provider/attached",
    "ready/remove_provider/attached",
}
"""Rows that the search does not reach, because the first reading of each row is taken and no connector is used; scripts or
variants reach them."""


def test_ids_are_unique_and_follow_their_clause() -> None:
    assert len(REQUIREMENTS) == len(load_requirements())
    for requirement in REQUIREMENTS.values():
        assert requirement.id.startswith(f"R-{requirement.clause}-"), requirement.id


def test_each_requirement_is_tested_or_says_why_not() -> None:
    problems = [problem for requirement in REQUIREMENTS.values() for problem in _problems(requirement)]
    assert not problems


def _problems(requirement: Requirement) -> Iterator[str]:
    if [bool(requirement.rules), bool(requirement.pending), bool(requirement.untestable)].count(True) != 1:
        yield f"{requirement.id}: not one of rules, pending and untestable"
    if bool(requirement.observed) == bool(requirement.untestable):
        yield f"{requirement.id}: what is observed, or why nothing is"
    for rule in requirement.rules:
        if requirement.id not in STANDS_FOR[rule]:
            yield f"{requirement.id}: {rule} does not stand for it"
    for interpretation in requirement.interpretations:
        if interpretation not in INTERPRETATIONS:
            yield f"{requirement.id}: no interpretation {interpretation}"


def test_interpretations_are_unique_and_each_value_is_named_once() -> None:
    assert len(INTERPRETATIONS) == len(load_interpretations())
    for interpretation in INTERPRETATIONS.values():
        for option, values in interpretation.options.items():
            assert len(set(values)) == len(values) > 1, option


def test_every_option_belongs_to_a_tested_requirement() -> None:
    """Otherwise a vendor could declare a reading that nothing depends on."""
    read = {interpretation for r in REQUIREMENTS.values() if r.rules for interpretation in r.interpretations}
    assert not [i.id for i in declarable() if i.options and i.id not in read]


def test_parts_in_the_making_let_nothing_be_declared() -> None:
    """Their requirements and decisions are there; no run asks for them, and nobody can claim them."""
    own = {i.id for i in INTERPRETATIONS.values() if i.profile == "extensions"}
    extended = [r for r in REQUIREMENTS.values() if r.profile == "extensions"]
    assert own
    assert own <= {i for r in extended for i in r.interpretations}
    assert all(r.part for r in extended)
    of_tool_chains = {family for profile in TOOLCHAIN_PROFILES for family in PARTS[profile]}
    beyond = [r for r in REQUIREMENTS.values() if r.part and r.profile != "extensions"]
    assert {r.part for r in beyond} == {"properties"}
    assert {r.profile for r in beyond} <= of_tool_chains
    asked = [r for r in extended if r in requirements_of("extensions")]
    claimable = {c.id for c in load_capabilities().capabilities if c.profile == "extensions"}
    assert {part for r in asked for part in claims_of(r.part)} - unfinished_parts() == claimable
    named = {option for r in asked for i in r.interpretations for option in INTERPRETATIONS[i].options}
    assert {option for i in own for option in INTERPRETATIONS[i].options} & load_options().keys() <= named


@pytest.mark.parametrize("profile", PROFILES)
def test_offered_profile_has_nothing_pending(profile: str) -> None:
    assert any(r.profile in PARTS[profile] for r in REQUIREMENTS.values())
    assert in_the_making(profile) == ""


def test_rules_stand_for_known_requirements_that_name_them() -> None:
    assert not PROPERTIES.keys() & CHECKS.keys()
    assert STANDS_FOR.keys() == PROPERTIES.keys() | CHECKS.keys() | TOOLCHAIN_CHECKS.keys() | HOST_CHECKS.keys()
    for rule, requirements in STANDS_FOR.items():
        for requirement in requirements:
            assert rule in REQUIREMENTS[requirement].rules, f"{requirement} does not name {rule}"


def test_table_names_known_requirements_and_readings() -> None:
    table = load_life_cycle()
    assert len({row.id for row in table.rows}) == len(table.rows)
    assert {row.requirement for row in table.rows} == set(PROPERTIES["outcomes"].stands_for)
    duties = {x for d in table.duties for x in (d.missing, d.unexpected)} | {table.order, table.fragments}
    assert duties <= set(PROPERTIES["callbacks"].stands_for)
    for outcome in (o for row in table.rows for o in row.outcomes):
        if outcome.reading:
            option, _, reading = outcome.reading.partition("=")
            assert any(reading in i.options.get(option, ()) for i in INTERPRETATIONS.values()), outcome.reading


def test_every_row_has_a_generated_scenario() -> None:
    table = load_life_cycle()
    reached = {purpose.id for purpose in generated_purposes(table)}
    assert {row.id for row in table.rows} - reached == NOT_FROM_THE_TABLE


def test_purposes_name_testable_requirements_and_are_unique() -> None:
    purposes = load_purposes("container")
    assert len({p.id for p in purposes}) == len(purposes)
    for purpose in purposes:
        assert purpose.requirements
        for requirement in purpose.requirements:
            assert REQUIREMENTS[requirement].rules, f"{purpose.id}: {requirement}"


@pytest.mark.parametrize("clause", ["10", "11", "12.10"])
def test_levels_of_the_platform_say_what_decides(clause: str) -> None:
    """What a product can contradict is an obligation; what is derived gives its reason and is tested, or will be."""
    of_clause = [r for r in REQUIREMENTS.values() if r.clause == clause or r.clause.startswith(f"{clause}.")]
    assert not [r.id for r in of_clause if r.level == "statement" and (r.rules or r.pending)]
    assert {r.id for r in of_clause if r.level == "may" and r.rules} <= {"R-10.1.3.2-20", "R-10.1.6.1-07"}
    assert not [r.id for r in of_clause if r.derived and not (r.rules or r.pending)]
