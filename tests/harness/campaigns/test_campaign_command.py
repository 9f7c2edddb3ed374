"""``ucm-cts campaign`` on a cluster: what it writes, and that it goes on where it was killed."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import pytest
from campaigns import Disturbed, kept, outcome_in, workers_of
from command_line import ucm_cts
from distributed import LocalCluster

from ucm_cts.harness.campaigns import cluster
from ucm_cts.harness.history.store import read

PLAN = """\
scenarios = 20
seeds = [1, 2]

[products.right]
adapter = "reference-py"
virtual-time = true
select = "11.1.3"

[products.wrong]
adapter = "ucm_cts.adapters.mutants.python:any_proxy_will_do"
virtual-time = true
select = "R-11.2.2.1-06"
seeds = [1]

[self-test]
names = ["any_proxy_will_do"]
quick = true
"""


@pytest.fixture
def plan(here: Path) -> Path:
    path = here / "plan.toml"
    path.write_text(PLAN)
    return path


@pytest.fixture
def scheduler(here: Path) -> Iterator[str]:
    """The address of a scheduler with one worker, both in this process."""
    with LocalCluster(
        n_workers=1,
        threads_per_worker=1,
        processes=False,
        protocol="tcp",
        host="127.0.0.1",
        resources={"core": 1},
        dashboard_address=None,
    ) as local:
        yield local.scheduler_address


def test_campaign_writes_reports_matrix_history_and_a_page(plan: Path, scheduler: str) -> None:
    ran = ucm_cts("campaign", plan, "--scheduler", scheduler, "--database", "history.duckdb")
    assert (ran.status, ran.err) == (1, ""), ran  # one product is wrong
    summary = json.loads(Path("ucm-cts-campaign/campaign.json").read_text())
    assert [(run["name"], run["verdict"]) for run in summary["runs"]] == [
        ("right/container/seed-1", "conformant"),
        ("right/container/seed-2", "conformant"),
        ("wrong/container/seed-1", "not conformant"),
    ]
    assert [(one["mutants"], one["killed"]) for one in summary["self_tests"]] == [(1, 1)]
    assert (summary["left"], summary["lost"]) == (0, [])
    page = Path("ucm-cts-campaign/index.html").read_text()
    for run in summary["runs"]:
        assert f'href="{run["report"]}"' in page
        assert (Path("ucm-cts-campaign") / run["report"]).is_file()
    assert not read(Path("history.duckdb")).runs  # parts of a profile are no runs of it

    again = ucm_cts("campaign", plan, "--scheduler", "tcp://127.0.0.1:9")  # nobody is asked for anything
    units = len(kept(Path("ucm-cts-campaign")))
    assert again.status == 1
    assert f"{units} units, {units} of them kept before" in again.out


def test_wrong_cluster_is_refused_with_a_remedy(plan: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cluster, "SECONDS_TO_CONNECT", 1)
    nobody = ucm_cts("campaign", plan, "--scheduler", "tcp://127.0.0.1:9")
    assert nobody.status == 2
    assert "there is no Dask scheduler at 'tcp://127.0.0.1:9'" in nobody.err
    assert "start one with 'dask scheduler', or leave out --scheduler" in nobody.err


def test_workers_without_a_core_to_give_are_refused(plan: Path) -> None:
    with LocalCluster(
        n_workers=1, threads_per_worker=1, processes=False, protocol="tcp", host="127.0.0.1", dashboard_address=None
    ) as local:
        refused = ucm_cts("campaign", plan, "--scheduler", local.scheduler_address)
    assert refused.status == 2
    assert "no worker has the resource 'core'" in refused.err
    assert "dask worker ADDRESS --nthreads 1 --resources core=1" in refused.err


@pytest.mark.slow
def test_killed_workers_and_a_killed_command_change_nothing(plan: Path, here: Path, scheduler: str) -> None:
    ucm_cts("campaign", plan, "--scheduler", scheduler, "--out", here / "calm")
    one = Disturbed(plan, here / "wild", ("--workers", "2"))
    one.kill_worker(3)
    one.kill_client(3)
    said = one.end()
    assert len(one.log) == 2
    assert f"{len(kept(here / 'calm'))} units, 0 without a result" in said
    assert kept(here / "wild") == kept(here / "calm")
    assert outcome_in(here / "wild") == outcome_in(here / "calm")
    assert not workers_of(one.going())
