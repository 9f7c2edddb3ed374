"""The report that a campaign makes of the parts of a run is that of one run, but for times; so is the matrix of a self-test."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import msgspec
import pytest
from campaigns import without_times
from command_line import report_of, ucm_cts

from ucm_cts.harness.campaigns.plan import read_plan
from ucm_cts.harness.campaigns.planning import Work, work_of
from ucm_cts.harness.campaigns.units import encoded
from ucm_cts.harness.campaigns.working import Done, UnitFailed, carry_out, unpacked
from ucm_cts.harness.catalogue.requirements import requirements_of
from ucm_cts.harness.report.json_report import to_json
from ucm_cts.harness.results.foreign import clean_report
from ucm_cts.harness.results.values import FrameworkReport

pytestmark = pytest.mark.usefixtures("here")

SEED = 7
LIMITS = {"timeout": 3, "incident-time": 20}


def planned(adapter: str, select: str, scenarios: int) -> Work:
    settings = "".join(f"{key} = {value}\n" for key, value in LIMITS.items())
    Path("plan.toml").write_text(
        f'scenarios = {scenarios}\nseeds = [{SEED}]\n[products.p]\nadapter = "{adapter}"\nvirtual-time = true\n'
        f'select = "{select}"\n{settings}'
    )
    return work_of(read_plan(Path("plan.toml")))


def joined(adapter: str, select: str, scenarios: int) -> tuple[int, FrameworkReport]:
    (run,) = planned(adapter, select, scenarios).runs
    results = [carry_out(encoded(part)) for part in run.parts]
    report = unpacked(carry_out(encoded(run.conclusion(())), results)).report
    assert report is not None
    return len(results), report


def as_json(report: FrameworkReport) -> Any:
    return json.loads(to_json(clean_report(report), requirements_of(report.profile)))


CASES = {
    "reference-py": ("R-11.2.2.1 or 11.1.2", 60, "conformant"),
    "subjects:any_proxy_will_do": ("11.1.3", 15, "not conformant"),
    "subjects:Crashing": ("R-11.2.1.2", 15, "not conformant"),
}
"""By adapter: what is selected, how many scenarios make a unit, and the verdict."""


@pytest.mark.parametrize("adapter", CASES)
def test_report_of_many_parts_is_that_of_one_run(adapter: str) -> None:
    select, scenarios, verdict = CASES[adapter]
    limits = [word for key, value in LIMITS.items() for word in (f"--{key}", str(value))]
    ucm_cts("run", adapter, "-k", select, "--virtual-time", "--seed", str(SEED), "--explore", "0s", *limits)
    of_one = report_of(Path("ucm-cts-report"))
    parts, report = joined(adapter, select, scenarios)
    assert parts > 3
    assert of_one["verdict"] == verdict
    assert without_times(as_json(report)) == without_times(of_one)


def test_lost_part_makes_the_report_incomplete_and_costs_no_other() -> None:
    (run,) = planned("reference-py", "R-11.2.2.1", 100).runs
    lost, *kept = run.parts
    results = [carry_out(encoded(part)) for part in kept]
    report = unpacked(carry_out(encoded(run.conclusion([lost])), results)).report
    assert report is not None
    assert report.incomplete == f"1 of {len(run.parts)} parts gave no result"
    assert report.verdict == "inconclusive"
    assert report.scenarios == sum(len_of(one) for one in map(unpacked, results))


def len_of(done: Done) -> int:
    assert done.part is not None
    return done.part.report.scenarios


def test_another_product_statement_or_suite_on_a_worker_is_refused() -> None:
    (run,) = planned("reference-py", "R-11.2.2.1-01", 100).runs
    for changed, told in (
        ({"suite": "0"}, "another build of ucm-cts than the one that read the plan; install the same one"),
        ({"product": "0"}, "the product 'reference-py' differs on this worker"),
        ({"stated": "0"}, "its statement differs on this worker"),
    ):
        other = msgspec.structs.replace(run.run, **changed)
        with pytest.raises(UnitFailed, match=told):
            carry_out(encoded(msgspec.structs.replace(run.parts[0], run=other)))


def test_trial_of_a_mutant_is_that_of_the_self_test() -> None:
    Path("plan.toml").write_text('[self-test]\nnames = ["never_serves"]\nquick = true\n')
    (unit,) = work_of(read_plan(Path("plan.toml"))).first()
    mutant = unpacked(carry_out(encoded(unit))).mutant
    ucm_cts("selftest", "never_serves", "--quick", "--jobs", "1")
    (of_self_test,) = json.loads(Path("ucm-cts-selftest/matrix.json").read_text())["mutants"]
    assert without_times(json.loads(msgspec.json.encode(mutant))) == without_times(of_self_test)
