"""Typed values in whole runs: drawn from the seed, kept by the disguise, shrunk when they fail, refused where they do not fit."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import msgspec
import pytest
from command_line import within

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.harness.catalogue.documents import DocumentError
from ucm_cts.harness.execution.campaign import Campaign
from ucm_cts.harness.execution.disguise import Disguise
from ucm_cts.harness.execution.driver import Driver
from ucm_cts.harness.hosting.locate import locate
from ucm_cts.harness.purposes.data.scenarios import data_purposes
from ucm_cts.harness.purposes.scripts import Script, problems, read_scripts
from ucm_cts.harness.purposes.selection import load_purposes, select
from ucm_cts.harness.results.values import ReportedFinding

PURPOSES = data_purposes()


@pytest.mark.parametrize("purpose", PURPOSES, ids=[purpose.id for purpose in PURPOSES])
def test_drawn_scenarios_are_the_same_but_for_more_values(purpose: object) -> None:
    assert dataclasses.is_dataclass(purpose)
    (purpose,) = [one for one in PURPOSES if one is purpose]
    assert purpose.draw is not None
    drawn, again, other = purpose.draw(7, {}), purpose.draw(7, {}), purpose.draw(8, {})
    assert drawn == again
    assert drawn != other or purpose.requirements == ("R-10.1.1-10",)
    assert [name for name, _ in drawn] == [name for name, _ in purpose.scenarios]
    for _, scenario in (*drawn, *purpose.scenarios):
        script = msgspec.convert({"scenario": "saved", **msgspec.to_builtins(scenario)}, Script)
        assert problems(script) == []


def test_the_disguise_keeps_values() -> None:
    for purpose in PURPOSES:
        for _, scenario in purpose.scenarios:
            disguise = Disguise(5, "{port}_{element}")
            hidden = disguise.scenario(scenario)
            assert disguise.reveal(hidden).components == scenario.components
            assert values_of(hidden) == values_of(scenario)


def values_of(scenario: s.Scenario) -> list[object]:
    actions = [a for d in scenario.components.values() for plan in d.plan.values() for a in plan]
    given = [a.arguments for a in actions if isinstance(a, s.CallMethod)]
    attributes = [value for d in scenario.components.values() for value in d.attributes.values()]
    return [*given, *attributes]


def failures(name: str, words: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> list[ReportedFinding]:
    """What is found in the framework ``subjects:name``, shortened."""
    within(tmp_path, monkeypatch)
    purposes = select(load_purposes("core"), words)
    with Driver(locate(f"subjects:{name}", in_process=True), seed=4) as driver:
        campaign = Campaign(driver, "core")
        services_only = [dataclasses.replace(p, scenarios=p.scenarios[:1], draw=None) for p in purposes]
        for _ in campaign.check(services_only):
            pass
        list(campaign.shorten())
        return [f for r in campaign.report().requirements for f in r.findings]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "words", "smallest"),
    [
        ("cuts_integers_to_32_bits", "data/integers", "LONGLONG 2147483648"),
        ("leaves_room_for_nul", "data/strings", f'CHAR8 string "{"a" * 16}"'),
        ("turns_sequences_round", "data/sequences", "sequence [0, 1]"),
    ],
)
def test_the_smallest_value_that_fails_is_shown(
    name: str, words: str, smallest: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    found = {f.finding.cause: f for f in failures(name, words, tmp_path, monkeypatch)}
    shown = next(f for cause, f in found.items() if cause.endswith("as IN argument") and smallest.split()[0] in cause)
    assert smallest in shown.finding.expected
    assert shown.execution is not None
    assert len(shown.execution.scenario.components) == 2
    assert not (tmp_path / ".hypothesis").exists()


SCRIPT = """\
scenario: one
interfaces:
  store: {methods: {put: {
    parameters: [{name: key, direction: IN, of: {type: integer, kind: UBYTE}},
                 {name: old, direction: RETURN, of: {type: boolean}}],
    raises: [{type: structure, name: full, fields: {size: {type: integer, kind: ULONG}}}]}}}
components:
  server:
    provides: [in.api]
    ports: {in.api: store}
    plan:
      method:
        - {do: answer, method: put, results: [true]}
  client:
    requires: [out.api]
    ports: {out.api: store}
    plan:
      on_startup:
        - {do: call_method, port: out.api, method: put, arguments: [7]}
steps:
  - {op: start}
"""

BAD = {
    "value that does not fit": (SCRIPT.replace("[7]", "[700]"), 19, "700 is no UBYTE"),
    "too many arguments": (SCRIPT.replace("[7]", "[7, 8]"), 19, "put has 1 arguments"),
    "unknown method": (SCRIPT.replace("method: put, arguments", "method: get, arguments"), 19, "no method 'get'"),
    "result that does not fit": (SCRIPT.replace("[true]", "[1]"), 13, "1 is no BOOLEAN"),
    "no result": (SCRIPT.replace("[true]", "[]"), 13, "put has 1 results"),
    "answer of nothing": (SCRIPT.replace("answer, method: put", "answer, method: get"), 13, "method 'get'"),
    "unknown exception": (SCRIPT.replace("results: [true]", "exception: odd, results: [1]"), 13, "raises no 'odd'"),
    "wrong exception": (SCRIPT.replace("results: [true]", "exception: full, results: [-1]"), 13, "-1 is no ULONG"),
}


@pytest.mark.parametrize(("text", "line", "word"), BAD.values(), ids=BAD.keys())
def test_values_that_do_not_fit_are_refused_with_file_and_line(tmp_path: Path, text: str, line: int, word: str) -> None:
    path = tmp_path / "script.yaml"
    path.write_text(SCRIPT)
    assert [script.scenario for script in read_scripts(path)] == ["one"]
    path.write_text(text)
    with pytest.raises(DocumentError) as caught:
        read_scripts(path)
    assert str(caught.value).startswith(f"{path}:{line}: "), caught.value
    assert word.lower() in str(caught.value).lower()
