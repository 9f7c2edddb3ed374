"""The units of a plan: every purpose once, and an address that changes with all that decides a result and with nothing else."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from ucm_cts.harness.campaigns.plan import read_plan
from ucm_cts.harness.campaigns.planning import Work, work_of
from ucm_cts.harness.campaigns.products import purposes_of, statement_at
from ucm_cts.harness.campaigns.units import Slice, address, decoded, encoded

PLAN = """\
scenarios = {scenarios}
[products.{name}]
adapter = "{adapter}"
seeds = {seeds}
virtual-time = {virtual}
statement = "{statement}"
timeout = {timeout}
"""
USUAL = {
    "scenarios": 300,
    "name": "p",
    "adapter": "reference-py",
    "seeds": [1],
    "virtual": "true",
    "statement": "ics.toml",
    "timeout": 5,
}


@pytest.fixture(autouse=True)
def _statement(here: Path) -> None:
    (here / "ics.toml").write_text("[ixit]\npatience = 400\n")


def work(**changed: object) -> Work:
    Path("plan.toml").write_text(PLAN.format(**{**USUAL, **changed}))
    return work_of(read_plan(Path("plan.toml")))


def addresses(**changed: object) -> frozenset[str]:
    return frozenset(map(address, work(**changed).first()))


def test_every_purpose_of_a_run_is_in_one_part() -> None:
    (run,) = work().runs
    purposes = purposes_of(run.run, statement_at("ics.toml", "reference-py", True))
    assert [place for part in run.parts for place in range(part.first, part.end)] == list(range(len(purposes)))
    lengths = [sum(len(p.scenarios) for p in purposes[part.first : part.end]) for part in run.parts]
    assert len(lengths) > 5
    assert all(length <= 300 or part.end == part.first + 1 for length, part in zip(lengths, run.parts, strict=True))


def test_same_plan_has_the_same_addresses_whatever_its_products_are_called() -> None:
    assert addresses() == addresses() == addresses(name="other")
    assert addresses() < addresses(seeds=[1, 2])


@pytest.mark.parametrize(
    "changed",
    [
        {"seeds": [2]},
        {"virtual": "false"},
        {"timeout": 4},
        {"adapter": "ucm_cts.adapters.mutants.python:calls_once"},
        {"statement": ""},
    ],
    ids=str,
)
def test_whatever_decides_a_result_changes_every_address(changed: dict[str, object]) -> None:
    assert not addresses() & addresses(**changed)


def test_another_content_of_the_statement_changes_every_address() -> None:
    before = addresses()
    Path("ics.toml").write_text("[ixit]\npatience = 401\n")
    assert not before & addresses()


def test_another_content_of_the_adapter_changes_every_address(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(Path.cwd()))
    adapter = "from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter as Mine\n"
    Path("my_adapter.py").write_text(adapter)
    before = addresses(adapter="my_adapter:Mine")
    Path("my_adapter.py").write_text(f"{adapter}# another version\n")
    assert not before & addresses(adapter="my_adapter:Mine")


def test_units_travel_without_loss_and_name_nothing_of_this_machine() -> None:
    for unit in work().first():
        assert decoded(encoded(unit)) == unit
        assert str(Path.cwd()).encode() not in encoded(unit)
        assert b"/" not in encoded(unit).replace(b"plan.toml", b"")


def test_folder_of_the_plan_does_not_matter() -> None:
    before = addresses()
    Path("elsewhere").mkdir()
    shutil.copy("ics.toml", "elsewhere")
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir("elsewhere")
        assert addresses() == before


def test_only_what_depends_on_time_takes_a_core() -> None:
    real = [unit for unit in work(virtual="false").first() if isinstance(unit, Slice)]
    assert {unit.timed for unit in real} == {True, False}
    assert not any(unit.timed for unit in work().first())
