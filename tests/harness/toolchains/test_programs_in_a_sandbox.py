"""Programs that read what a tool chain has generated run in a sandbox, as the tool chain does."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from ucm_cts.harness import toolchains
from ucm_cts.harness.hosting.sandbox import why_none
from ucm_cts.harness.toolchains.cpp.compiling import Compiler, Headers, compile_text
from ucm_cts.harness.toolchains.cpp.linking import linked
from ucm_cts.harness.toolchains.idl.omniidl import opinion

pytestmark = pytest.mark.skipif(bool(why_none()), reason=f"no sandbox here: {why_none()}")

OUTSIDE = os.readlink("/proc/self/ns/pid")
SAYS = "$(readlink /proc/self/ns/pid)"


@pytest.fixture
def programs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with programs that say in which namespace of processes they are."""
    folder = tmp_path / "bin"
    folder.mkdir()
    monkeypatch.setenv("PATH", f"{folder}{os.pathsep}{os.environ['PATH']}")
    for name, text in (
        ("omniidl", f'echo "0:1: {SAYS}"; exit 1'),
        ("ar", f'echo "{SAYS}" > "$2"'),
        ("g++", f'echo "<R-1>:1: error: {SAYS}" >&2; for last; do :; done; [ -d "${{last%/*}}" ] && : > "$last"'),
    ):
        (folder / name).write_text(f"#!/bin/sh\n{text}\n")
        (folder / name).chmod(0o755)
    return folder


def is_elsewhere(said: str) -> bool:
    return said.strip().startswith("pid:[") and said.strip() != OUTSIDE


@pytest.mark.usefixtures("programs")
def test_omniidl_runs_in_a_sandbox() -> None:
    (problem,) = opinion({"a.idl": "typedef octet t;"}).problems
    assert is_elsewhere(problem.text)
    (problem,) = opinion({"a.idl": "typedef octet t;"}, sandbox=False).problems
    assert problem.text == OUTSIDE


@pytest.mark.usefixtures("programs")
def test_ar_runs_in_a_sandbox(tmp_path: Path) -> None:
    generated, made = tmp_path / "generated", tmp_path / "made"
    for folder in (generated, made):
        folder.mkdir()
    (generated / "a.cpp").write_text("int a;\n")
    (archive,) = linked(Headers(generated, ()), "cpp11", Compiler(), made).words
    assert is_elsewhere(Path(archive).read_text())


@pytest.mark.usefixtures("programs")
def test_compilers_run_in_a_sandbox(tmp_path: Path) -> None:
    (error,) = compile_text("int a;\n", tmp_path, Headers(tmp_path, ()), "cpp11", Compiler()).errors
    assert is_elsewhere(error.message)


def test_nothing_of_tool_chains_starts_programs_in_another_way() -> None:
    folder = Path(toolchains.__file__).parent
    starting = [str(p.relative_to(folder)) for p in folder.rglob("*.py") if "import subprocess" in p.read_text()]
    assert starting == ["commands/bounded.py"]
