"""The jobs of docs/ci.md: their script lines run here, as each system runs them, for a good and for a worse framework."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import duckdb
import pytest
import yaml
from files import ROOT, guide_files
from lxml import etree

PAGE = ROOT / "docs" / "ci.md"
ADAPTER = """from ucm_cts.adapters.{module} import {name}


class MyAdapter({name}):
    product, version = "My framework", "{version}"
"""
GOOD = ADAPTER.format(module="reference.python.adapter", name="ReferenceAdapter", version="1.0")
WORSE = ADAPTER.format(module="mutants.python", name="stops_in_startup_order", version="1.1")


def job(name: str) -> Any:
    """The one job of the file ``name`` on the page."""
    document = yaml.safe_load(guide_files(PAGE)[name])
    (found,) = document.get("jobs", document).values()
    return found


def shell(text: str, environment: Mapping[str, str]) -> subprocess.CompletedProcess[str]:
    """``text`` as the runners execute it: bash that ends at the first failure. pip has nothing to install here."""
    places = {
        "PATH": f"{Path('stubs').absolute()}{os.pathsep}{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    }
    command = ["bash", "--noprofile", "--norc", "-eo", "pipefail", "-c", text]
    return subprocess.run(
        command, env={**os.environ, **places, **environment}, capture_output=True, text=True, check=False
    )


def push(adapter: str, steps: list[str], environment: Mapping[str, str]) -> list[subprocess.CompletedProcess[str]]:
    """What ``steps`` do after ``adapter`` was pushed; those after one that fails are not run."""
    Path("my_package").mkdir(exist_ok=True)
    Path("my_package/my_adapter.py").write_text(adapter)
    shutil.rmtree("ucm-report", ignore_errors=True)
    done = []
    for step in steps:
        done.append(shell(step, environment))
        if done[-1].returncode:
            break
    return done


@pytest.fixture
def pip(here: Path) -> Path:
    """The file into which a stub of pip writes what it is called with."""
    (here / "stubs").mkdir()
    (here / "stubs" / "pip").write_text(f'#!/bin/sh\necho "$@" >> {here}/pip\n')
    (here / "stubs" / "pip").chmod(0o755)
    return here / "pip"


def check(first: list[Any], second: list[Any], pip: Path, versions: list[str]) -> None:
    """The first push is good, the second has a regression, and the history has ``versions``."""
    assert all(done.returncode == 0 for done in first), first
    assert second[-1].returncode == 1, second
    assert "REGRESSED" in second[-1].stdout
    assert re.search(r"(?m)^    R-11\.\S+  pass -> fail", second[-1].stdout)
    assert etree.parse("ucm-changes.xml").findall(".//failure")
    assert Path("ucm-report/report.html").is_file()
    (installed,) = set(pip.read_text().splitlines())
    extra = re.fullmatch(r"install ucm-cts\[(\w+)\] \.", installed)
    assert extra
    assert extra[1] in tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["optional-dependencies"]
    with duckdb.connect("ucm-kept/history.duckdb") as connection:
        assert connection.execute("SELECT version FROM runs").fetchall() == [(version,) for version in versions]
        (query,) = re.findall(r"(?ms)^<!-- sql -->\n```sql\n(.*?)^```$", PAGE.read_text())
        assert connection.execute(query).fetchall() == [(version, 1) for version in versions if version != "1.0"]


@pytest.mark.slow
def test_github_job(pip: Path) -> None:
    steps = job("ucm.yml")["steps"]
    on_main = [step["run"] for step in steps if "run" in step]
    elsewhere = [step["run"] for step in steps if "run" in step and "if" not in step]
    assert len(on_main) == len(elsewhere) + 2
    first, second = push(GOOD, on_main, {}), push(WORSE, elsewhere, {})
    check(first, second, pip, ["1.0"])
    assert "::error title=R-11." in second[-1].stdout
    (saves,) = (step for step in steps if step.get("uses", "").startswith("actions/cache/save"))
    assert saves["if"].startswith("always()"), "a regression on the main branch belongs to the history, too"


@pytest.mark.slow
def test_gitlab_job(pip: Path, here: Path) -> None:
    """Its run is that of the other job, line for line, and here a copy of the report of one."""
    lines = job("gitlab-ci.yml")["script"]
    (certify,) = (line for line in lines if line.startswith("ucm-cts run "))
    assert certify in "\n".join(step.get("run", "") for step in job("ucm.yml")["steps"]).splitlines()
    reports = {}
    for name, adapter in (("good", GOOD), ("worse", WORSE)):
        push(
            adapter, ["ucm-cts run my_package.my_adapter:MyAdapter --explore 0s --out ucm-report || test $? -eq 1"], {}
        )
        reports[name] = shutil.move("ucm-report", here / name)
    main, branch = (rule["variables"] for rule in job("gitlab-ci.yml")["rules"])
    assert job("gitlab-ci.yml")["cache"]["policy"] == "$KEEP"
    good, worse = ("\n".join(lines).replace(certify, f"cp -r {reports[name]} ucm-report") for name in ("good", "worse"))
    first = push(GOOD, [good], main)
    check(first, push(WORSE, [worse], branch), pip, ["1.0"])
    check(first, push(WORSE, [worse], main), pip, ["1.0", "1.1"])
    assert '"version":"1.0"' in Path("ucm-kept/baseline/report.json").read_text().replace(" ", ""), "the good one stays"


def test_what_the_jobs_name_is_what_the_commands_write() -> None:
    github, gitlab = job("ucm.yml"), job("gitlab-ci.yml")
    text = " ".join(step.get("run", "") for step in github["steps"])
    kept = [step["with"]["path"] for step in github["steps"] if "path" in step.get("with", {})]
    assert kept == ["ucm-kept", "ucm-kept", "ucm-report"]
    assert gitlab["cache"]["paths"] + gitlab["artifacts"]["paths"] == ["ucm-kept/", "ucm-report/"]
    for place in (*kept, *gitlab["artifacts"]["reports"]["junit"]):
        assert place in text
        assert place in " ".join(gitlab["script"])
