"""``pytest --pyargs ucm_cts.suite --iut ADAPTER`` as its users run it: in a process and a folder of its own."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest
from command_line import report_of, within
from files import ROOT

from ucm_cts.adapters.contract.adapter import Adapter
from ucm_cts.adapters.contract.messages import Run, Traced, encode, from_host_decoder
from ucm_cts.adapters.mutants.python.subjects import MUTANTS
from ucm_cts.adapters.sdk.python.engine import Engine
from ucm_cts.harness.catalogue.requirements import load_life_cycle
from ucm_cts.harness.execution.disguise import Disguise
from ucm_cts.harness.purposes.selection import load_purposes
from ucm_cts.reference_models.monitor import Monitor

pytestmark = pytest.mark.slow

PURPOSES = {purpose.id.replace(" ", "-"): purpose for purpose in load_purposes("container")}
SUBJECT, REQUIREMENT = "stops_in_startup_order", "R-11.2.2.1-13"
DRAWN = "test_drawn_scenarios"
NODE = re.compile(r"test_clause\[([\d.]+)-(.*)\]")
HEAD = re.compile(r"^(R-\S+): expected \S.*; observed \S.*$", re.MULTILINE)
OTHERS = """
from ucm_cts.adapters.contract.programming_model import UcmError
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter

class NoIds(ReferenceAdapter):
    def add_component(self, *arguments):
        super().add_component(*arguments)
        return "one"

class NeverDestroyed(ReferenceAdapter):
    def destroy(self, manager):
        raise UcmError("no")
"""
FOREIGN = """
import pytest

{more}

@pytest.fixture
def purpose():
    return "mine"

@pytest.fixture
def check():
    return "mine"

@pytest.fixture(scope="session")
def campaign():
    return "mine"

def test_own_fixtures(purpose, check, campaign):
    assert (purpose, check, campaign) == ("mine", "mine", "mine")
"""


@dataclass(frozen=True)
class Session:
    """Exit status, what was printed, and each node's failure, empty if it passed, in the order they ran."""

    status: int
    out: str
    nodes: dict[str, str]

    @property
    def failed(self) -> dict[str, str]:
        return {node: message for node, message in self.nodes.items() if message}


def run_pytest(*arguments: str) -> Session:
    """``pytest arguments...`` in this folder; nothing that goes wrong may show a traceback."""
    Path("nodes.xml").unlink(missing_ok=True)
    command = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", "-q", *arguments]
    env = {name: value for name, value in os.environ.items() if name != "PYTEST_ADDOPTS"}
    done = subprocess.run(
        [*command, f"--junitxml={Path.cwd() / 'nodes.xml'}"], capture_output=True, text=True, check=False, env=env
    )
    assert "Traceback" not in done.stdout + done.stderr
    assert "pluggy" not in done.stdout + done.stderr, done.stdout
    nodes = {}
    for case in ElementTree.parse("nodes.xml").iter("testcase") if Path("nodes.xml").exists() else ():
        name = NODE.sub(r"\2", case.get("name", ""))
        assert name not in nodes, f"{name} ran twice"
        nodes[name] = "".join(problem.text or "" for problem in case)
    return Session(done.returncode, done.stdout + done.stderr, nodes)


def suite(*arguments: str, explore: str = "0s") -> Session:
    return run_pytest("--pyargs", "ucm_cts.suite", "--iut-explore", explore, *arguments)


def broken(adapter: type[Adapter]) -> set[str]:
    """The purposes whose scenarios break a rule, found without driver, host and plugin."""
    engine, monitor = Engine(adapter), Monitor(load_life_cycle())
    disguise = Disguise(1, adapter.port_element_name)
    found = set()
    for name, purpose in PURPOSES.items():
        for scenario in (disguise.scenario(plain) for _, plain in purpose.scenarios):
            traced = from_host_decoder().decode(engine.answer(encode(Run(0, scenario))))
            assert isinstance(traced, Traced)
            if monitor.judge(scenario, traced.events).findings:
                found.add(name)
    return found


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    within(tmp_path, monkeypatch)
    (tmp_path / "others.py").write_text(OTHERS)
    monkeypatch.setenv("PYTHONPATH", str(tmp_path), prepend=os.pathsep)
    return tmp_path


@pytest.fixture(scope="module")
def wrong(tmp_path_factory: pytest.TempPathFactory) -> tuple[Session, Path]:
    """A framework with one defect, and the report on it."""
    folder = tmp_path_factory.mktemp("wrong")
    with pytest.MonkeyPatch.context() as patch:
        within(folder, patch)
        return suite("--iut", f"subjects:{SUBJECT}", "--iut-out", "out"), folder / "out"


# which nodes there are


def test_each_purpose_is_one_node() -> None:
    done = subprocess.run(
        [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", "--pyargs", "ucm_cts.suite",
         "--iut-explore", "0s", "--collect-only", "-q"],
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    nodes = [NODE.fullmatch(line.partition("::")[2]) for line in done.stdout.splitlines() if "::" in line]
    assert sorted(node[2] for node in nodes if node) == sorted(PURPOSES)
    assert all(node and PURPOSES[node[2]].clause == node[1] for node in nodes)


def test_selection() -> None:
    session = suite("--iut", "reference-py", "-k", "restart or many-members")
    expected = {name for name in PURPOSES if "restart" in name or "many-members" in name}
    assert session.status == 0
    assert set(session.nodes) == expected
    assert 2 <= len(expected) < len(PURPOSES)
    of_clause = {name for name, purpose in PURPOSES.items() if purpose.clause.startswith("11.2.1")}
    for spelling in "11.2.1", "11_2_1":
        assert set(suite("--iut", "reference-py", "-k", spelling).nodes) == of_clause != set()


def test_statement_selects_purposes_and_binding_readings(here: Path) -> None:
    (here / "ics.toml").write_text('[readings]\nremove-while-ready = "cascade"\n')
    session = suite("--iut", "reference-py", "--iut-ics", "ics.toml", "-k", "ready/remove_component")
    assert session.status == 1
    assert {HEAD.findall(message)[0] for message in session.failed.values()} == {"R-11.2.3-11"}
    (here / "ics.toml").write_text("[capabilities]\nsimple_message_connector = false\n")
    session = suite(
        "--iut", "reference-py", "--iut-profile", "core", "--iut-ics", "ics.toml", "-k", "10_1_6 or services/"
    )
    assert (session.status, session.failed) == (0, {})
    assert session.nodes
    assert not [node for node in session.nodes if "message" in node]
    (here / "ics.toml").write_text("[readings]\nremove-while-ready = 1\n")
    session = suite("--iut", "reference-py", "--iut-ics", "ics.toml")
    assert session.status == 4
    assert "ERROR: ics.toml:2: remove-while-ready is" in session.out


# what becomes of them


def test_conformant_framework_passes_everywhere(here: Path) -> None:
    session = suite("--iut", "reference-py", "--iut-out", "out", "--iut-seed", "7")
    assert (session.status, session.failed) == (0, {})
    assert set(session.nodes) == set(PURPOSES)
    report = report_of(here / "out")
    assert (report["verdict"], report["seed"]) == ("conformant", 7)
    written = {path.name for path in (here / "out").iterdir()}
    assert written == {"report.html", "report.json", "junit.xml", "failures", "ucm-cts-manifest.json"}


def test_defect_fails_the_nodes_that_show_it_and_no_others(wrong: tuple[Session, Path]) -> None:
    session, _ = wrong
    assert session.status == 1
    assert set(session.nodes) == set(PURPOSES)
    assert set(session.failed) == broken(MUTANTS[SUBJECT].adapter)
    exercising = {name for name, purpose in PURPOSES.items() if REQUIREMENT in purpose.requirements}
    assert exercising
    assert exercising <= set(session.failed)


def test_failure_says_requirement_expected_observed_and_shows_both(wrong: tuple[Session, Path]) -> None:
    for name, message in wrong[0].failed.items():
        assert set(HEAD.findall(message)) == {REQUIREMENT}, name
        assert HEAD.match(message), "the first line is what short summaries show"
        heads, pictures = (
            len(HEAD.findall(message)),
            re.findall(r"^(observed|expected)(?: instead)?$", message, re.MULTILINE),
        )
        assert pictures == ["observed", "expected"] * heads
        assert "✗" in message
        assert "✓" in message
        assert ".py:" not in message, "messages do not show the suite's own code"
        more = re.search(r"^and (\d+) more$", message, re.MULTILINE)
        assert heads <= 3
        assert heads == 3 or not more


def test_failure_says_which_scenario(wrong: tuple[Session, Path]) -> None:
    for name, message in wrong[0].failed.items():
        assert any(scenario in message or scenario == name for scenario, _ in PURPOSES[name].scenarios), name


def test_report_is_that_of_the_command_line(wrong: tuple[Session, Path]) -> None:
    _, out = wrong
    report = report_of(out)
    assert report["verdict"] == "not conformant"
    (result,) = [r for r in report["requirements"] if r["verdict"] == "fail"]
    assert result["id"] == REQUIREMENT
    saved: dict[str, Any] = json.loads((out / result["findings"][0]["replay"]).read_text())
    assert len(saved["steps"]) == 4, "two members, start, stop"


def test_scenarios_are_drawn_in_a_node_of_their_own_and_their_failures_are_remembered(here: Path) -> None:
    arguments = "-k", "drawn or whole-life", "--iut-seed", "1", "--iut-out", "out"
    session = suite("--iut", "reference-py", *arguments, explore="20scenarios")
    assert (session.status, session.failed) == (0, {})
    assert DRAWN in session.nodes
    assert report_of(here / "out")["measures"]["scenarios drawn at random"] == 20
    session = suite("--iut", f"subjects:{SUBJECT}", *arguments, explore="100scenarios")
    assert (session.status, set(session.failed)) == (1, {DRAWN})
    assert set(HEAD.findall(session.failed[DRAWN])) == {REQUIREMENT}
    session = suite("--iut", f"subjects:{SUBJECT}", *arguments, explore="1scenarios")
    assert set(session.failed) == {DRAWN}, "it is tried again"
    session = suite("--iut", "reference-py", "-k", "drawn", explore="often")
    assert (session.status, "'often' is no budget" in session.out) == (4, True)


def test_inconclusive_is_not_green(here: Path) -> None:
    known = {"requirement": "R-11.2.2.2-06", "observed": "*", "reason": "known to us", "expires": "2099-12-31"}
    (here / "known.json").write_text(json.dumps([known]))
    session = suite("--iut", "others:NeverDestroyed", "--iut-out", "out", "--iut-known-failures", "known.json")
    report = report_of(here / "out")
    unknown = {r["id"] for r in report["requirements"] if r["verdict"] == "inconclusive"}
    assert unknown
    assert session.failed == {}, "known failures are no failures"
    assert session.status == 1, f"{unknown} passed without having been exercised"
    assert "UCM conformance is not established" in session.out
    assert {
        line.split()[1].rstrip(":") for line in session.out.splitlines() if line.startswith("inconclusive")
    } == unknown


def test_known_failures_are_expected_until_they_no_longer_occur(here: Path) -> None:
    entry = {"requirement": REQUIREMENT, "observed": "stop *", "reason": "known to us", "expires": "2099-12-31"}
    stale = {**entry, "observed": "start *"}
    for entries, status in ([entry], 0), ([entry, stale], 1):
        (here / "known.json").write_text(json.dumps(entries))
        session = suite("--iut", f"subjects:{SUBJECT}", "--iut-known-failures", "known.json")
        assert (session.status, session.failed) == (status, {})
        assert " xfailed" in session.out
        assert (f"known failure of {REQUIREMENT} no longer occurs (start *): remove it" in session.out) == bool(status)


def test_dishonest_adapter_is_not_the_frameworks_fault(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("LIES", '[["cut", 20, 0]]')
    session = suite("--iut", "hostile.lying", "-k", "restart")
    assert session.status == 1
    assert session.failed
    for message in session.failed.values():
        assert message.startswith("contradiction: ")
        assert "This says nothing about the framework." in message
        assert not HEAD.findall(message)


def test_limits_are_those_of_the_command_line() -> None:
    options = ["--iut-timeout", "0.3", "--iut-memory", "512", "--iut-incident-time", "0.1"]
    session = suite("--iut", "hostile.failing:HangsInStop", "-k", "whole-life or many-members", *options)
    assert session.status == 1
    messages = "\n".join(session.failed.values())
    assert "no answer within 0.3 s" in messages
    assert "untried: not tried: stop had met a hang before" in messages


def test_crash_fails_its_node_and_the_run_goes_on() -> None:
    session = suite("--iut", "subjects:Crashing", "-k", "remove_component or whole-life")
    assert session.status == 1
    assert set(session.nodes) == {name for name in PURPOSES if "remove_component" in name or "whole-life" in name}
    assert 3 < len(session.failed) < len(session.nodes) - 3
    first, *rest = session.failed.values()
    assert set(HEAD.findall(first)) == {"R-12.10-09"}
    assert "it did not end: crash, SIGSEGV" in first
    for message in rest:
        assert "SIGSEGV" in message, "not every crash gets a second look"
        assert set(HEAD.findall(message)) <= {"R-12.10-09"}
    after = list(session.nodes.values())[list(session.nodes.values()).index(first) :]
    assert "" in after, "others pass after a crash"
    assert not session.nodes["whole-life"], "a container started once does not crash"


def test_scenarios_lost_to_the_adapter_are_not_green() -> None:
    session = suite("--iut", "others:NoIds", "-k", "whole-life")
    assert session.status == 1
    assert set(session.failed) == set(session.nodes)
    for message in session.nodes.values():
        assert message.startswith("refused: ")
        assert "add_component" in message


# options


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ("", "say which implementation to test: --iut ADAPTER"),
        ("--iut nobody", "'nobody' names no adapter"),
        ("--iut subjects:Nobody", "module subjects has no Nobody"),
        ("--iut reference-py --iut-out others.py", "cannot be written to 'others.py'"),
        ("--iut reference-py --iut-known-failures none.yaml", "none.yaml: cannot be read"),
    ],
    ids=["no adapter", "unknown", "no class", "out is a file", "no list"],
)
def test_wrong_use_ends_the_session_with_one_clear_line(arguments: str, message: str) -> None:
    session = suite(*arguments.split())
    assert (session.status, session.nodes) == (2, {})
    (line,) = [line for line in session.out.splitlines() if "ucm-cts: " in line]
    assert message in line
    assert len(session.out.splitlines()) <= 5


def test_unknown_profile_is_one_clear_line_too() -> None:
    session = suite("--iut", "reference-py", "--iut-profile", "pim")
    assert session.status in (2, 4)
    assert session.out.count("there is no profile 'pim'") == 1


def test_seed_and_process(here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def calls(*options: str) -> tuple[list[list[str]], set[str]]:
        record = here / f"calls{options[-1]}"
        monkeypatch.setenv("CALL_RECORD", str(record))
        assert suite("--iut", "subjects:Listening", "-k", "attributes", "--iut-seed", "11", *options).status == 0
        lines = [line.split() for line in record.read_text().splitlines()]
        return [words for _, *words in lines], {pid for pid, *_ in lines}

    (here / "conftest.py").write_text(
        "import os\n\n\ndef pytest_configure():\n    open('pid', 'w').write(str(os.getpid()))\n"
    )
    names, hosts = calls("-p", "conftest", "--iut-no-sandbox")
    assert names
    assert (here / "pid").read_text() not in hosts
    again, own = calls("-p", "conftest", "--iut-in-process")
    assert again == names
    assert own == {(here / "pid").read_text()}


# everybody else


def test_plugin_loads_nothing_until_the_suite_is_collected() -> None:
    script = (
        "import sys, ucm_cts.harness.cli.pytest_plugin; print(*(m for m in sys.modules if m.startswith('ucm_cts')))"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout.split()[-2:] == ["ucm_cts.harness.cli", "ucm_cts.harness.cli.pytest_plugin"]
    assert len(done.stdout.split()) == 4


def test_foreign_tests_keep_their_fixtures(here: Path) -> None:
    (here / "test_foreign.py").write_text(FOREIGN.format(more=""))
    session = run_pytest("test_foreign.py")
    assert (session.status, session.nodes) == (0, {"test_own_fixtures": ""})


def test_foreign_tests_may_have_clauses(here: Path) -> None:
    (here / "test_foreign.py").write_text(FOREIGN.format(more="CLAUSES = ('11.1',)"))
    session = run_pytest("test_foreign.py")
    assert (session.status, session.nodes) == (0, {"test_own_fixtures": ""})


def test_suite_runs_from_a_checkout() -> None:
    command = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", "-q", "suite", "--iut", "reference-py"]
    done = subprocess.run([*command, "-k", "whole-life"], cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout
    assert " passed" in done.stdout
