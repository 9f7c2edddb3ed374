"""``ucm-cts run --toolchain``: verdicts and pages of conformant, wrong, crashing and hanging tool chains."""

from __future__ import annotations

import html
import json
import os
import re
import subprocess
import sys
import tomllib
from pathlib import Path
from typing import Any

import pytest
from command_line import Outcome, ucm_cts
from files import SUPPORT

from ucm_cts.harness.results.statement import default_statement
from ucm_cts.harness.toolchains.acceptance import Answer, judge
from ucm_cts.harness.toolchains.corpus.selection import Question, differing_lines
from ucm_cts.harness.toolchains.declarations import asked_of_declared

pytestmark = [pytest.mark.slow, pytest.mark.usefixtures("here")]

REFERENCE = "ucm_cts.adapters.reference.toolchain"
FAKE = SUPPORT / "fake_toolchain.py"
CASE = "R-9.2.4.3-02"
"""The models of one requirement are enough to tell behaviours apart."""


def describe(path: Path, command: list[str], **more: object) -> Path:
    rows = [f"{key} = {json.dumps(value)}" for key, value in more.items()]
    text = ['product = "fake"', 'version = "1"', *rows, "[check]", f"command = {json.dumps(command)}"]
    path.write_text("\n".join(text) + "\n")
    return path


def run_fake(here: Path, behaviour: str, **more: object) -> tuple[Outcome, dict[str, Any]]:
    command = [sys.executable, str(FAKE), behaviour, "check", "{model}"]
    toolchain = describe(here / "fake.toml", command, **more)
    outcome = ucm_cts("run", "--toolchain", toolchain, "-k", CASE, "--out", "out")
    assert "Traceback" not in outcome.out + outcome.err
    return outcome, json.loads((here / "out" / "report.json").read_text())


def verdicts(report: dict[str, Any], rule: str = "") -> set[str]:
    """Of the requirements that were asked about."""
    return {
        r["verdict"]
        for r in report["requirements"]
        if (r["exercised"] or r["findings"] or "twin" in r["reason"] or "no answer" in r["reason"])
        and (not rule or any(f["rule"] == rule for f in r["findings"]))
    }


def test_a_tool_chain_that_accepts_everything_fails_broken_models(here: Path) -> None:
    outcome, report = run_fake(here, "accepts_everything")
    assert outcome.status == 1
    assert verdicts(report, "broken_models_refused") == {"fail"}
    assert not verdicts(report, "legal_models_accepted")


def test_a_tool_chain_that_refuses_everything_passes_nothing(here: Path) -> None:
    outcome, report = run_fake(here, "refuses_everything")
    assert outcome.status == 1
    assert verdicts(report) <= {"fail", "inconclusive"}
    assert verdicts(report, "legal_models_accepted") == {"fail"}
    assert not verdicts(report, "broken_models_refused")


def test_refusing_for_another_reason_is_no_pass() -> None:
    lines = ['<ContractModule name="m">', '<PrimitiveBoolean name="b"/>', '<Structure name="s">']
    legal = "\n".join([*lines, '<StructureField name="f" type="t"/>', "</Structure>", "</ContractModule>"])
    broken = "\n".join([*lines, "</Structure>", "</ContractModule>"])
    twin = Question("twin", "R-9.2.4.3-02", "accept", legal)
    asked = Question("asked", "R-9.2.4.3-02", "refuse", broken, "", "twin", differing_lines(legal, broken))
    for line, outcome in ((2, "undecided"), (3, "kept"), (4, "kept")):
        answers = {"twin": Answer(True), "asked": Answer(False, frozenset((line,)), f"model.xml:{line}: no")}
        _, judgement = judge([twin, asked], answers)
        assert judgement.outcome == outcome, line
    _, judgement = judge([twin, asked], {"twin": Answer(True), "asked": Answer(False)})
    assert judgement.outcome == "kept", "a tool that names no lines is taken at its word"


@pytest.mark.parametrize(("behaviour", "reported"), [("dies", "SIGABRT"), ("hangs", "no end after")])
def test_crash_or_hang_fails_and_the_run_continues(here: Path, behaviour: str, reported: str) -> None:
    outcome, report = run_fake(here, behaviour, seconds=0.4 if behaviour == "hangs" else 20)
    assert outcome.status == 1
    findings = [f for r in report["requirements"] for f in r["findings"]]
    assert findings
    assert all(reported in f["observed"] for f in findings)


@pytest.mark.parametrize(("behaviour", "reported"), [("floods", "MiB of output"), ("ends_oddly", "exit status 70")])
def test_tool_without_an_answer_is_inconclusive(here: Path, behaviour: str, reported: str) -> None:
    outcome, report = run_fake(here, behaviour)
    assert outcome.status == 1
    assert verdicts(report) == {"inconclusive"}
    assert any(reported in r["reason"] for r in report["requirements"])


@pytest.mark.parametrize("behaviour", ["leaves_a_child", "prints_rubbish", "tells_the_time", "points_to_ends"])
def test_odd_manners_do_not_matter(here: Path, behaviour: str) -> None:
    _, report = run_fake(here, behaviour)
    assert verdicts(report) == {"pass"}


def test_a_refused_model_root_is_no_failure(here: Path) -> None:
    command = [sys.executable, str(FAKE), "refuses_the_root", "check", "{model}"]
    ucm_cts("run", "--toolchain", describe(here / "fake.toml", command), "-k", "R-9.4.2.1-04", "--out", "out")
    report = json.loads((here / "out" / "report.json").read_text())
    assert "fail" not in {r["verdict"] for r in report["requirements"]}


def test_memory_is_that_of_all_its_processes(here: Path) -> None:
    _, report = run_fake(here, "has_a_greedy_child", memory=150)
    findings = [f for r in report["requirements"] for f in r["findings"]]
    assert findings
    assert all("MiB of memory" in f["observed"] for f in findings)


def test_warnings_of_a_checker_of_several_models_refuse_nothing(here: Path) -> None:
    script = here / "warns.sh"
    script.write_text(
        "#!/bin/sh\n"
        f'for m in "$@"; do echo "$m:1: warning: I say so of every model"; done\n'
        f'exec {sys.executable} -m ucm_cts.adapters.reference.toolchain check "$@"\n'
    )
    script.chmod(0o755)
    ucm_cts("run", "--toolchain", describe(here / "w.toml", ["./warns.sh", "{models}"]), "-k", CASE, "--out", "out")
    assert verdicts(json.loads((here / "out" / "report.json").read_text())) == {"pass"}


def test_a_failure_shows_the_model_and_how_to_try_again(here: Path) -> None:
    outcome, report = run_fake(here, "accepts_everything")
    finding = next(f for r in report["requirements"] for f in r["findings"])
    saved = here / "out" / finding["model"]
    assert saved.read_text().startswith("<")
    assert finding["status"] == 0
    page = (here / "out" / "report.html").read_text()
    assert 'class="added"' in page
    assert "lines in which it differs" in page
    assert finding["scenario"] in page
    assert "models" in outcome.out
    junit = (here / "out" / "junit.xml").read_text()
    assert f"{FAKE} accepts_everything check {finding['model']}" in junit


@pytest.mark.parametrize(("task", "arguments"), [("check", "{model}"), ("idl", "{model} {out}")])
def test_the_command_of_a_failure_runs_in_the_folder_of_the_report(here: Path, task: str, arguments: str) -> None:
    tool = here / "tool.sh"
    tool.write_text('#!/bin/sh\ntest -f "$1" && test -d "${2:-.}" && echo "$1:1: note"\n')
    tool.chmod(0o755)
    words = json.dumps(["./tool.sh", *arguments.split()])
    (here / "t.toml").write_text(f'product = "p"\nversion = "1"\n[{task}]\ncommand = {words}\n')
    profile = "pim" if task == "check" else task
    selected = CASE if task == "check" else "constants"
    assert ucm_cts("run", "--toolchain", "t.toml", "--profile", profile, "-k", selected, "--out", "out").status == 1
    junit = html.unescape((here / "out" / "junit.xml").read_text())
    reported = re.findall(r"again, in the folder of this report: +(.+)", junit)
    assert reported
    for command in reported[:3]:
        done = subprocess.run(["sh", "-c", command], cwd=here / "out", capture_output=True, text=True, check=False)
        assert (done.returncode, done.stderr) == (0, ""), command
        assert re.fullmatch(r"failures/R-\S+\.xml:1: note\n", done.stdout)


def test_a_model_is_no_scenario_to_replay(here: Path) -> None:
    (here / "R-9.2.4.3-02.xml").write_text("<Model/>")
    outcome = ucm_cts("replay", "R-9.2.4.3-02.xml", "reference-py")
    assert (outcome.status, outcome.err.count("\n")) == (2, 1)
    assert "is a model and no scenario" in outcome.err


def test_a_statement_claims_the_tasks_of_the_tool_chain(here: Path) -> None:
    toolchain = describe(here / "t.toml", ["true", "{model}"])
    assert ucm_cts("ics", "--toolchain", toolchain, "--out", "ics.toml").status == 0
    stated = tomllib.loads((here / "ics.toml").read_text())
    assert stated["profiles"] == ["pim"]
    assert not [option for option in stated["readings"] if option.startswith(("idl-", "cpp-"))]
    asked = asked_of_declared()
    assert {option: default_statement().readings[option] for option in stated["readings"]} == stated["readings"]
    assert stated["readings"].keys() <= asked.keys()
    assert "R-9.5.3.5-03" in asked["abstract-actual-types"]
    assert ucm_cts("ics", "--toolchain", toolchain, "--out", "ics.toml", "--full", "--force").status == 0
    assert len(tomllib.loads((here / "ics.toml").read_text())["readings"]) > len(stated["readings"])
    outcome = ucm_cts("ics", "--toolchain", toolchain, "--out", "ics.toml", "--profile", "idl", "--force")
    assert (outcome.status, outcome.err.count("\n")) == (2, 1)
    (here / "none.toml").write_text('product = "p"\nversion = "1"\n')
    outcome = ucm_cts("ics", "--toolchain", "none.toml", "--out", "other.toml")
    assert (outcome.status, outcome.err.count("\n")) == (2, 1)
    assert "says of no task how it is done" in outcome.err


@pytest.mark.parametrize(
    ("text", "reported"),
    [
        ('version = "1"\n[check]\ncommand = ["true", "{model}"]', "missing required field `product`"),
        ('product = "p"\nversion = "1"\n[check]\ncommand = "true {model}"', "a command is a list"),
        (
            'product = "p"\nversion = "1"\n[check]\ncommand = ["true", "{model}"]\nrefuse = [2]',
            "did you mean 'refuses'?",
        ),
        ('product = "p"\nversion = "1"\n[dialect.tags]\nStructur = "Struct"', "did you mean 'Structure'?"),
        ('product = "p"\nversion = "1"\n[dialect.attributes]\n"Structure.nam" = "x"', "did you mean"),
        ('product = "p"\nversion = "1"\n[check]\ncommand = ["true"]', "does not name {model}"),
        ('product = "p"\nversion = "1"\n[check]\ncommand = []', "is empty"),
        ('product = "p"\nversion = "1"\n[check]\ncommand = ["true", "{model}", "{models}"]', "{model} and {models}"),
        ('product = "p"\nversion = "1"\n[check]\ncommand = ["true", "-i{models}"]', "as a word of its own"),
        ('product = "p"\nversion = "1"\n[idl]\ncommand = ["true", "{models}", "{out}"]', "only checkers take several"),
        (
            'product = "p"\nversion = "1"\n[check]\ncommand = ["true", "{model}"]\nheaders = ["x.hpp"]',
            "it belongs in [cpp11] or [cpp03]",
        ),
        ('product = "p"\nversion = "1"\n[idl]\ncommand = ["true", "{model}"]', "does not name {out}"),
        ('product = "p"\nversion = "1"\n[check]\ncommand = ["true", "{model}"]\nrefuses = [0]', "0 accepts it"),
        (
            'product = "p"\nversion = "1"\n[check]\ncommand = ["true", "{model}"]\ndiagnostic = "("',
            "no regular expression",
        ),
        ('product = "p"\nversion = "1"\n[check]\ncommand = ["true", "{model}"]\ndiagnostic = "x"', "(?P<line>...)"),
        ('product = "p"\nversion = "1"\n[check]\ncommand = ["no-such-tool", "{model}"]', "no program 'no-such-tool'"),
        (
            'product = "p"\nversion = "1"\n[cpp11]\ncommand = ["true", "{model}", "{out}"]\ncompiler = ["nonesuch++"]',
            "no compiler 'nonesuch++' can be run; correct 'compiler'",
        ),
        (
            'product = "p"\nversion = "1"\n[chekc]\ncommand = ["true", "{model}"]',
            "there is no key 'chekc'; did you mean 'check'?",
        ),
        ('product = "p"\nversion = "1"\n', "does not say how 'check' is done"),
        (
            'product = "p"\nversion = "1"\n[cpp11]\ncommand = ["true", "{model}", "{out}"]\ncompiler = "g++"',
            "compiler is a list: write each word in quotes",
        ),
        ('product = "p"\nversion = "1"\n[check]\ncommand = ["true", "{model}"]\nrefuses = 2', "refuses is a list"),
        (
            'product = "p"\nversion = "1"\n[check]\ncommand = ["true", "{model}"]\nrefuses = [1, 1000, -9]',
            "wrong.toml:5: refuses lists exit statuses, which are from 1 to 255",
        ),
        (
            'product = "p"\nversion = "1"\n[check]\ncommand = ["true", "a\\u0000b", "{model}"]',
            "wrong.toml:4: a command holds the character U+0000",
        ),
        ('product = "p"\nversion = "1"\n[dialect]\nshort-strings = true', "did you mean 'short_strings'?"),
        (
            'product = "p"\nversion = "1"\n[dialect.tags]\nAlias = "a b"',
            "wrong.toml:4: 'a b' for Alias is no name of XML",
        ),
        ('product = "p"\nversion = "1"\n[dialect.tags]\nAlias = "1x"', "'1x' for Alias is no name of XML"),
        ('product = "p"\nversion = "1"\n[dialect.tags]\nAlias = ""', "'' for Alias is no name of XML"),
        ('product = "p"\nversion = "1"\n[dialect.tags]\nAlias = "x:y"', "'x:y' for Alias is no name of XML"),
        ('product = "p"\nversion = "1"\n[dialect.attributes]\nname = "a b"', "'a b' for name is no name of XML"),
        ('product = "p"\nversion = "1"\n[dialect.attributes]\nname = ""', "'' for name is no name of XML"),
        (
            'product = "p"\nversion = "1"\n[dialect.attributes]\nname = "type"',
            "wrong.toml:4: name and type of Alias are both called 'type'",
        ),
        ('product = "p"\nversion = "1"\n[dialect.literals]\nLONG = "a\\u0001"', "a character that is not printed"),
        ("product = ", "not TOML"),
    ],
)
def test_wrong_descriptions_are_wrong_use(here: Path, text: str, reported: str) -> None:
    (here / "wrong.toml").write_text(text)
    profile = "cpp11" if "[cpp11]" in text else "pim"
    outcome = ucm_cts("run", "--toolchain", "wrong.toml", "--profile", profile)
    assert outcome.status == 2
    assert reported in outcome.err
    assert "wrong.toml" in outcome.err
    assert outcome.err.count("\n") == 1


def test_a_description_is_a_plain_file(here: Path) -> None:
    os.mkfifo(here / "pipe.toml")
    outcome = ucm_cts("run", "--toolchain", "pipe.toml")
    assert outcome.status == 2
    assert "pipe.toml: is no plain file" in outcome.err


def test_options_for_adapters_are_wrong_use(here: Path) -> None:
    toolchain = describe(here / "t.toml", ["true", "{model}"])
    assert "ADAPTER is for frameworks" in ucm_cts("run", "reference-py", "--toolchain", toolchain).err
    assert "--repeat is for frameworks" in ucm_cts("run", "--toolchain", toolchain, "--repeat", "2").err
    assert "is of frameworks" in ucm_cts("run", "--toolchain", toolchain, "--profile", "core").err
    assert "--toolchain" in ucm_cts("run", "--profile", "pim").err
    assert "cannot be read" in ucm_cts("run", "--toolchain", "nothing.toml").err


def test_a_checker_that_accepts_everything_has_one_cause(here: Path) -> None:
    command = [sys.executable, "-c", "", "{models}"]
    outcome = ucm_cts("run", "--toolchain", describe(here / "deaf.toml", command), "-k", "9.2.4", "--out", "out")
    report = json.loads((here / "out" / "report.json").read_text())
    failed = [r for r in report["requirements"] if r["verdict"] == "fail"]
    assert len(failed) > 10
    assert all(len(r["findings"]) == 1 for r in failed)
    assert f"and {len(failed) - 1} more requirements that fail for causes shown above" in outcome.out
    measures = report["measures"]
    assert measures["legal models accepted"] == measures["legal models"]
    assert "broken models refused" not in measures
    assert f"refuses what is broken: 0 of {measures['broken models']:,} models" in outcome.out
    assert len((here / "out" / "report.html").read_bytes()) < 1_000_000


def test_what_no_broken_model_can_fail_does_not_pass(here: Path) -> None:
    described = describe(here / "toolchain.toml", [sys.executable, "-m", REFERENCE, "check", "{models}"])
    ucm_cts("run", "--toolchain", described, "-k", "R-9.2.7.1-04", "--out", "out")
    report = json.loads((here / "out" / "report.json").read_text())
    (inherited,) = [r for r in report["requirements"] if r["id"] == "R-9.2.7.1-04"]
    assert inherited["verdict"] == "not applicable"
    assert inherited["exercised"]
    assert inherited["reason"].startswith("accepted side only")
    assert "inherited-names = observed" in inherited["reason"]
