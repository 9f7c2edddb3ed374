"""The published results are what README and docs say of them."""

from __future__ import annotations

import pytest
from files import ROOT

from ucm_cts.adapters.mutants.toolchain.registry import mutants as wrong_tool_chains
from ucm_cts.harness.catalogue.profiles import TOOLCHAIN_PROFILES
from ucm_cts.harness.report.published import by_product, read_published
from ucm_cts.harness.selftest.kill_record import read_record

TOOLCHAIN = "ucm-cts-toolchain-0.1.0"


def test_published_self_tests_are_proved_as_detection_says() -> None:
    frameworks, toolchains = (
        read_record(ROOT / f"results/detection/{of}.jsonl") for of in ("frameworks", "toolchains")
    )
    assert frameworks.is_proved
    assert toolchains.is_proved
    assert {mutant.name for mutant in toolchains.mutants} <= wrong_tool_chains().keys()
    assert len([cheat for cheat in frameworks.cheats if not cheat.requirements]) == 8, "that no observation can show"


@pytest.mark.parametrize("profile", TOOLCHAIN_PROFILES)
def test_the_reference_tool_chain_is_published_as_conformant(profile: str) -> None:
    (result,) = (r for r in by_product(read_published(ROOT / "results"))[TOOLCHAIN] if r.profile == profile)
    assert result.verdict == "conformant"
    assert result.requirements
    assert {entry.verdict for entry in result.requirements} <= {"pass", "not applicable"}
