"""README and docs are correct: links have targets, and what they name exists."""

from __future__ import annotations

import importlib
import json
import re
import shlex
import shutil
import sys
from importlib.metadata import entry_points
from pathlib import Path
from typing import get_args

import click
import pytest
from command_line import report_of, ucm_cts
from files import ROOT
from pages import (
    PAGES,
    column,
    commands,
    marked,
    prose,
    shell,
    spans,
    text_of,
)

import ucm_cts as package
from ucm_cts.harness.catalogue.requirements import load_requirements
from ucm_cts.harness.cli.commands import cli
from ucm_cts.harness.results.values import Isolation, Verdict

pytestmark = pytest.mark.usefixtures("here")
ROOMS = {"suite", "reference_models", "harness", "adapters", "docs", "src", "tests"}
TOX = (ROOT / "tox.ini").read_text()
each_page = pytest.mark.parametrize("page", PAGES, ids=[str(page.relative_to(ROOT)) for page in PAGES])


@each_page
def test_links_lead_somewhere(page: Path) -> None:
    for target in re.findall(r"\]\(([^)]+)\)", prose(page)):
        path, _, anchor = target.partition("#")
        there = page.parent / path if path else page
        assert "://" in path or there.is_file() or any(there.glob("*")), target
        headings = re.findall(r"(?m)^#+ (.+)$", prose(there)) if anchor else ()
        assert not anchor or anchor in {re.sub(r"[^\w -]", "", h.lower()).replace(" ", "-") for h in headings}, target


@pytest.mark.parametrize("page", sorted((ROOT / "docs").glob("*.md")), ids=lambda page: page.name)
def test_page_begins_with_five_lines_of_summary(page: Path) -> None:
    title, empty, *lines = page.read_text().splitlines()
    assert title.startswith("# ")
    assert not empty
    assert lines.index("") == 5


@each_page
def test_excerpts_are_from_their_files(page: Path) -> None:
    for name, excerpt in re.findall(r"(?ms)^<!-- from: (\S+) -->\n```\w+\n(.*?)^```$", page.read_text()):
        assert excerpt in text_of(name)


@each_page
def test_named_things_exist(page: Path) -> None:
    for span in spans(page):
        if re.fullmatch(r"[\w.*-]+(/[\w.*-]*)+", span) and span.split("/")[0] in ROOMS:
            assert any(ROOT.glob(span.rstrip("/"))) or any(page.parent.glob(span)), span
    assert set(re.findall(r"R-\d[\d.]*-\d+", page.read_text())) <= {r.id for r in load_requirements()}
    for name in re.findall(r"\btox -e (\w+)", page.read_text()):
        assert f"[testenv:{name}]" in TOX, name


def test_every_module_has_a_purpose() -> None:
    lines = shell(f"{shlex.quote(sys.executable)} {ROOT}/docs/modules.py").splitlines()
    assert [line for line in lines if len(line.split()) < 3 or not line.endswith(".")] == []
    assert any(line.startswith("harness/results/tally.py ") for line in lines)


def test_former_module_of_the_python_host_still_serves() -> None:
    command = (
        "echo x | python -m ucm_cts.adapters.python.host ucm_cts.adapters.mutants.python:serialises_calls 2> warning"
    )
    assert json.loads(shell(command))["type"] == "refused"
    assert Path("warning").read_text().endswith("is deprecated: use ucm_cts.adapters.sdk.python.host\n")


def test_tables_name_existing_things() -> None:
    for folder, _, holds in column("docs/design.md", r"`(\w+/)` \| (.+) \| (.+)"):
        for span in re.findall(r"`([^`]+)`", holds):
            assert any((ROOT / folder).glob(span.rstrip("/"))), f"{folder}{span}"
    values = column("docs/design.md", r"(`\w[^|]*`) \| `(\w+/[^|]*)\.py`")
    assert len(values) > 5
    for names, path in values:
        module = importlib.import_module(f"ucm_cts.{path.replace('/', '.')}")
        assert [name for name in re.findall(r"\w+", names) if not hasattr(module, name)] == []
    assert set(column("docs/verdicts.md", "`(.+?)`")) == {*get_args(Verdict), *get_args(Isolation)}
    (short,) = column("docs/commands.md", r"(.+), \.\.\. \| takes a bundled adapter.*")
    assert set(re.findall(r"`(.+?)`", short)) <= entry_points(group="ucm_cts.adapters").names


@pytest.mark.parametrize("command", commands("ucm-cts "))
def test_command_is_one(command: str) -> None:
    name, *arguments = shlex.split(command)[1:]
    assert name in cli.commands
    if arguments:
        cli.commands[name].make_context(name, arguments)


def test_pytest_command_is_the_one_that_test_pytest_plugin_runs() -> None:
    assert commands("pytest --pyargs") == ["pytest --pyargs ucm_cts.suite --iut ADAPTER"]


def test_commands_page_is_that_of_the_commands() -> None:
    printed = shell(f"{shlex.quote(sys.executable)} {ROOT}/docs/commands.py")
    assert printed.startswith("## Commands\n")
    assert text_of("docs/commands.md").partition("## Commands\n")[2] == printed.removeprefix("## Commands\n")
    assert {o for command in cli.commands.values() for p in command.params for o in options_of(p)} == {
        span.split()[0] for span in column("docs/commands.md", "`(-.+?)`")
    }


def options_of(parameter: click.Parameter) -> list[str]:
    return parameter.opts if isinstance(parameter, click.Option) else []


@pytest.mark.parametrize("name", ["", *cli.commands])
def test_help_is_complete(name: str) -> None:
    command = cli.commands[name] if name else cli
    context = click.Context(command)
    assert not name or not command.get_short_help_str(62).endswith("..."), "the list of commands would cut it off"
    for option in (p for p in command.params if isinstance(p, click.Option)):
        assert option.help, option.opts
    assert "harness" not in command.get_help(context).lower(), "a word of those who develop UCM-CTS"


@pytest.mark.native
def test_certify_command_leaves_the_files_of_the_readme(here: Path) -> None:
    (command,) = re.findall(r"(?ms)^\[testenv:certify\]$[^\[]*?^commands = (.+?)$", TOX)
    assert marked("README.md", "certify command").rstrip().endswith(" && pipx run tox -e certify")
    for hole, value in {"{tox_root}": str(here), "{/}": "/", "{posargs}": ""}.items():
        command = command.replace(hole, value)
    outcome = ucm_cts(*shlex.split(command)[1:])
    assert (outcome.status, outcome.err) == (0, "")
    (folder,) = re.findall(r"`(reports/[^`]+)/`", text_of("README.md"))
    for name in re.findall(r"`(report\.\w+|junit\.xml)`", text_of("README.md")):
        assert (here / folder / name).is_file()
    assert report_of(here / folder)["suite_version"] == package.__version__


def test_ci_runs_the_test_command_of_the_readme(here: Path) -> None:
    calls, stubs = here / "calls", here / "stubs"
    stubs.mkdir()
    for name in ("apt-get", "pipx"):
        (stubs / name).write_text(f'#!/bin/sh\necho {name} "$@" >> {calls}\n')
        (stubs / name).chmod(0o755)
    shutil.copytree(ROOT / ".ci", here / "clone" / ".ci")
    shutil.copy(ROOT / "README.md", here / "clone")
    printed = shell("clone/.ci/run", PATH=f"{stubs}:/usr/bin:/bin")
    command = marked("README.md", "test command")
    assert printed == f"+ {command}"
    assert calls.read_text().splitlines() == command.strip().split(" && ")
