"""The ordinary pipeline detects cheating adapters for the right reason, within the limits of docs/honesty.md."""

from __future__ import annotations

import re

import pytest
from files import ROOT

from ucm_cts.adapters.mutants.python.subjects import CHEATS, UNSEEN, Cheat
from ucm_cts.harness.selftest.cheat_trials import examine_cheat

pytestmark = pytest.mark.slow


@pytest.mark.parametrize("cheat", CHEATS.values(), ids=CHEATS.keys())
def test_cheat_is_found_out_for_the_right_reason(cheat: Cheat) -> None:
    result = examine_cheat(cheat)
    assert result.is_as_it_should, result


@pytest.mark.parametrize("cheat", UNSEEN.values(), ids=UNSEEN.keys())
def test_undetectable_cheats_stay_undetected(cheat: Cheat) -> None:
    assert not examine_cheat(cheat).came_out


def test_the_page_names_each() -> None:
    page = (ROOT / "docs" / "honesty.md").read_text()
    for cheat in CHEATS.values():
        (named,) = re.findall(rf"(?m)^\| {re.escape(', '.join(cheat.detected_by))} \| (.+) \|$", page)
        assert f"`{cheat.name}`" in named.split(", "), cheat.name
    for cheat in UNSEEN.values():
        assert f"(`{cheat.name}`)" in page, cheat.name
