"""What a guide tells a vendor to do works as printed."""

from __future__ import annotations

import importlib
import json
import re
import shlex
import subprocess
import sys
import tomllib
from pathlib import Path

import msgspec
import pytest
from command_line import blameless, report_of, ucm_cts
from distributed import LocalCluster
from pages import (
    column,
    commands,
    marked,
    shell,
    text_of,
    write_files,
)

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.metamodel.writing import Dialect
from ucm_cts.harness.campaigns.plan import SelfTest, Settings
from ucm_cts.harness.catalogue.requirements import load_life_cycle
from ucm_cts.harness.execution.driver import Driver
from ucm_cts.harness.hosting.locate import locate
from ucm_cts.harness.purposes.scripts import read_scripts, to_scenario
from ucm_cts.harness.toolchains.commands.description import Command, ToolChain
from ucm_cts.reference_models.monitor import Monitor

pytestmark = pytest.mark.usefixtures("here")


@pytest.mark.parametrize(
    ("page", "clause", "example"),
    [
        ("request-response", "10.4.1", "requests.yaml"),
        ("shared-data", "10.4.2", "shared.yaml"),
        ("execution-policies", "10.5", "paced.yaml"),
    ],
)
def test_guide_to_a_part_of_extensions(here: Path, page: str, clause: str, example: str) -> None:
    write_files(f"docs/{page}.md")
    (replayed,) = [c for c in commands("ucm-cts replay") if example in c]
    outcome = ucm_cts(*replayed.split()[1:])
    assert (outcome.status, outcome.err) == (0, "")
    assert "\nno findings" in outcome.out
    (script,) = read_scripts(here / example)
    with Driver(locate("reference-py", in_process=True), 1) as driver:
        (answered,) = driver.run([("an example", to_scenario(script))])
    judged = Monitor(load_life_cycle()).judge(answered.disguised, answered.trace)
    assert set(script.exercises) <= set(judged.exercises)
    (ran,) = [c for c in commands("ucm-cts run") if f"--profile extensions -k {clause}" in c]
    # in virtual time, as other tests keep the processors busy
    assert ucm_cts(*ran.split()[1:], "--explore", "0s", "--virtual-time").status == 0
    assert report_of(here / "ucm-cts-report")["profile"] == "extensions"


def test_campaign_of_the_page(here: Path) -> None:
    write_files("docs/campaigns.md")
    dry, ran = dict.fromkeys(c for c in commands("ucm-cts campaign plan.toml") if "tcp" not in c)
    outcome = ucm_cts(*dry.split()[1:])
    assert (outcome.status, outcome.err) == (0, "")
    with LocalCluster(
        n_workers=1, processes=False, protocol="tcp", host="127.0.0.1", resources={"core": 1}, dashboard_address=None
    ) as cluster:
        outcome = ucm_cts(*ran.split()[1:], "--scheduler", cluster.scheduler_address)
    assert (outcome.status, outcome.err) == (0, "")
    for place in column("docs/campaigns.md", r"`([^`]+/)`"):
        assert any(here.glob(f"ucm-cts-campaign/{re.sub('NAME|PROFILE|N/', '*', place)}")), place
    keys = set(column("docs/campaigns.md", r"(`[a-z].*?)"))
    named = {key for cell in keys for key in re.findall(r"`([a-z-]+)`", cell)}
    known = {field.encode_name for kind in (Settings, SelfTest) for field in msgspec.structs.fields(kind)}
    assert known - {"adapter", "profiles", "seeds", "names", "quick", "whole", "real-time", "sandbox"} <= named


def test_known_failures(here: Path) -> None:
    write_files("docs/known-failures.md")
    options = "-k 11.2.2.1-13 --known-failures known.yaml --out out"
    ucm_cts("run", "subjects:stops_in_startup_order", *options.split())
    (reason,) = re.findall(r"(?m)^  reason: (.+)$", Path("known.yaml").read_text())
    failing = [r for r in report_of(here / "out")["requirements"] if r["verdict"] == "fail"]
    assert {f["waived"] for r in failing for f in r["findings"]} == {reason}


def test_statement(here: Path) -> None:
    write_files("docs/statement.md")
    (writes, runs) = (c.replace("ADAPTER", "reference-py") for c in commands("ucm-cts") if "my-ics.toml" in c)
    outcome = ucm_cts(*shlex.split(runs)[1:], "-k", "R-11.2.3-11", "--out", "out")
    assert (outcome.err, report_of(here / "out")["statement"]["source"]) == ("", "my-ics.toml")
    assert "fail" not in {r["verdict"] for r in report_of(here / "out")["requirements"]}
    assert ucm_cts(*shlex.split(writes)[1:]).status == 2, "it is there already"
    assert ucm_cts(*shlex.split(writes)[1:], "--force", "--full").status == 0
    keys = {key for row in column("docs/statement.md", r"(`.+?`) \| .+ \| .+") for key in re.findall(r"[\w]+", row)}
    assert keys == tomllib.loads((here / "my-ics.toml").read_text()).keys()


def test_toolchain_guide(here: Path) -> None:
    write_files("docs/toolchains.md")
    (command,) = [c for c in commands("ucm-cts run") if "--out pim-report" in c]
    outcome = ucm_cts(*shlex.split(command)[1:], "-k", "R-9.2.4.3-02")
    assert (outcome.err, report_of(here / "pim-report")["product"]) == ("", "My tool chain")
    (result,) = [r for r in report_of(here / "pim-report")["requirements"] if r["id"] == "R-9.2.4.3-02"]
    assert result["verdict"] == "pass"
    (written,) = [c for c in commands("ucm-cts ics") if "my-toolchain.toml" in c]
    assert ucm_cts(*shlex.split(written)[1:]).status == 0
    assert 'product = "My tool chain"' in (here / "ucm-cts-ics.toml").read_text()
    rows = column("docs/toolchains.md", r"(`.+?`.*?) \| .+ \| .+")
    described = {key for row in rows for key in re.findall(r"`\[?([a-z0-9_]+)", row)} - {"pim"}
    fields = {f.name for kind in (ToolChain, Command, Dialect) for f in msgspec.structs.fields(kind)}
    assert described == fields - {"folder", "source", "tags", "attributes", "literals"}


def test_standard_properties_guide(here: Path) -> None:
    write_files("docs/standard-properties.md")
    runs = [command for command in commands("ucm-cts run") if "documenting-ics.toml" in command]
    asked: dict[str, list[str]] = {}
    for command in runs:
        outcome = ucm_cts(*shlex.split(command)[1:])
        assert (outcome.status, outcome.err) == (0, "")
        report = report_of(here / "ucm-cts-report")
        asked[report["profile"]] = [r["id"] for r in report["requirements"] if r["verdict"] == "pass"]
    assert asked == {"pim": ["R-10.2-10", "R-10.2-11", "R-10.2-12"], "idl": ["R-10.2-13"]}


@pytest.mark.slow
def test_python_guide(here: Path) -> None:
    write_files("docs/adapter-python.md")
    assert "ucm-cts run my_adapter:BeansAdapter" in commands("ucm-cts run")
    outcome = ucm_cts("run", "my_adapter:BeansAdapter", "--out", "out")
    assert (outcome.status, outcome.err) == (1, "")
    assert "✗ NOT CONFORMANT  Beans 1.0" in outcome.out
    blameless(report_of(here / "out"))


@pytest.mark.native
@pytest.mark.slow
def test_virtual_time_of_executables(here: Path) -> None:
    """Each requirement that the C++ reference framework keeps in real time it keeps in virtual time, and each arises there."""
    (said,) = {c for c in commands("ucm-cts run") if "reference-cpp" in c and "--virtual-time" in c}
    ran = ucm_cts(*said.split()[1:], "--explore", "0s", "--out", "out")
    assert ran.status == 0, ran.out
    report = report_of(here / "out")
    assert {one["verdict"] for one in report["requirements"]} <= {"pass", "not applicable", "not testable"}
    assert "virtual time" in report["warnings"][0]


def test_python_guide_other_ways(here: Path) -> None:
    write_files("docs/adapter-python.md")
    write_files("docs/scenarios.md")
    (debugged,) = [c for c in commands("ucm-cts replay") if "my_adapter" in c]
    assert "no findings" in shell(debugged.replace("FILE", "example.yaml"))
    (virtual,) = {c for c in commands("ucm-cts run") if "my_adapter" in c and "--virtual-time" in c}
    assert "no findings" in ucm_cts("replay", "example.yaml", "my_adapter:BeansAdapter", "--virtual-time").out
    alike = ("--seed", "1", "--explore", "0s")
    ucm_cts(*virtual.split()[1:], *alike, "--out", "virtual")
    report = report_of(here / "virtual")
    assert "virtual time" in report["warnings"][0]
    ucm_cts("run", "my_adapter:BeansAdapter", *alike, "--out", "real")
    assert blameless(report) == blameless(report_of(here / "real"))
    (served,) = commands("python -m ucm_cts.adapters.sdk.python.host")
    command = [sys.executable, *served.replace(":4000", ":0").split()[1:]]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as server:
        assert server.stdout
        address = server.stdout.readline().removeprefix("listening on ").strip()
        try:
            assert "no findings" in ucm_cts("replay", "example.yaml", address).out
        finally:
            server.terminate()
    (toml,) = re.findall(r"(?ms)^```toml\n(.*?)^```$", text_of("docs/adapter-python.md"))
    ((group, names),) = tomllib.loads(toml)["project"]["entry-points"].items()
    info = here / "beans-1.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: beans\nVersion: 1\n")
    (info / "entry_points.txt").write_text(f"[{group}]\n" + "".join(f"{k} = {v}\n" for k, v in names.items()))
    assert "ucm-cts run beans" in commands("ucm-cts run")
    assert "connected-pair on Beans 1.0" in shell("python -m ucm_cts replay example.yaml beans")


@pytest.mark.slow
def test_example_of_profile_core_serves(here: Path) -> None:
    write_files("docs/adapter-python.md")
    write_files("docs/profile-core.md")
    shell(f"{marked('docs/profile-core.md', 'wired beans').strip()} || test $? -eq 1")
    entries = json.loads(Path("ucm-cts-report/report.json").read_text())["requirements"]
    verdicts = {entry["id"]: entry["verdict"] for entry in entries}
    assert {verdicts[f"R-10.1.5.1-{number}"] for number in ("01", "03", "05", "08")} == {"pass"}
    assert [one for one, verdict in verdicts.items() if verdict == "fail"] == ["R-10.1-01"]


def test_fragment_connectors_of_profile_core(here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write_files("docs/profile-core.md")
    monkeypatch.syspath_prepend(here)
    adapter = importlib.import_module("acme_links").AcmeAdapter
    assert adapter.end_fragments.keys() < {s.SERVICE_CONNECTOR, s.MESSAGE_CONNECTOR}
    assert adapter.__abstractmethods__ == {"create_runtime"}
