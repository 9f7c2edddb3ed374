"""Requirements of profile extensions belong to parts, which vendors claim one by one."""

from __future__ import annotations

from pathlib import Path

import pytest

from ucm_cts.harness.catalogue.documents import DocumentError, read
from ucm_cts.harness.catalogue.requirements import (
    CLAIMABLE,
    Requirement,
    claims_of,
    load_capabilities,
    load_requirements,
    requirements_of,
    unfinished_parts,
)

WRITTEN = "- {id: R-10-01, clause: '10', title: t, level: shall, meaning: m, pending: p,\n   "


def test_every_requirement_of_extensions_has_a_part() -> None:
    assert {bool(r.part) for r in load_requirements() if r.profile == "extensions"} == {True}
    assert {part for r in load_requirements() if r.part for part in claims_of(r.part)} == {*CLAIMABLE}


def test_what_parts_have_in_common_applies_with_each_of_them() -> None:
    assert claims_of("timers") == ("index-timers", "object-timers")
    assert len(claims_of("execution")) == 4
    assert claims_of("shared-data") == ("shared-data",)
    for requirement in requirements_of("extensions"):
        if requirement.part:
            claims = {part for need in load_capabilities().of(requirement.id) for part in need.one_of}
            assert {*claims_of(requirement.part)} - unfinished_parts() <= claims


def test_whoever_can_be_asked_can_be_claimed() -> None:
    parts = {c.id for c in load_capabilities().capabilities if c.profile == "extensions"}
    assert parts == {*CLAIMABLE} - unfinished_parts()


@pytest.mark.parametrize(
    ("fields", "problem"),
    [
        ("profile: extensions, part: oddity}", "Invalid enum value 'oddity'"),
        ("profile: core, part: shared-data}", "part shared-data is of profile extensions, not of core; leave it out"),
        ("part: timers}", "part timers is of profile extensions, not of container; leave it out"),
    ],
)
def test_wrong_part_is_refused(fields: str, problem: str, tmp_path: Path) -> None:
    path = tmp_path / "clause.yaml"
    path.write_text(WRITTEN + fields)
    with pytest.raises(DocumentError) as caught:
        read(path, list[Requirement])
    assert str(caught.value).startswith(f"{path}:{1 if 'of profile' in problem else 2}: ")
    assert problem in str(caught.value)
    assert "\n" not in str(caught.value)
