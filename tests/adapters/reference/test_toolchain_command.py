"""``ucm-cts-toolchain`` and its mutants at the command line: statuses, diagnostics, files; never a traceback."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

LEGAL = '<ContractModule name="m"><PrimitiveInteger name="t" kind="LONG"/></ContractModule>\n'
BROKEN = '<ContractModule name="m">\n  <Structure name="s"/>\n</ContractModule>\n'


@pytest.fixture
def models(tmp_path: Path) -> Path:
    (tmp_path / "legal.xml").write_text(LEGAL)
    (tmp_path / "broken.xml").write_text(BROKEN)
    (tmp_path / "no.xml").write_text("<ContractModule")
    return tmp_path


def reported(where: Path, *arguments: str, module: str = "reference.toolchain") -> tuple[int, str, str]:
    command = [sys.executable, "-m", f"ucm_cts.adapters.{module}", *arguments]
    done = subprocess.run(command, cwd=where, capture_output=True, text=True, check=False)
    assert "Traceback" not in done.stderr
    return done.returncode, done.stdout, done.stderr


def test_a_legal_model_is_accepted_without_a_word(models: Path) -> None:
    assert reported(models, "check", "legal.xml") == (0, "", "")


def test_diagnostics_name_file_line_remedy_requirement_and_clause(models: Path) -> None:
    status, out, err = reported(models, "check", "legal.xml", "broken.xml", "no.xml")
    assert (status, err) == (1, "")
    first, second = out.splitlines()
    assert first.startswith("broken.xml:2: error: ")
    assert first.endswith("[R-9.2.4.3-02, clause 9.2.4.3]")
    assert second.startswith("no.xml:1: error: ")


@pytest.mark.parametrize("task", ["idl", "cpp11", "cpp03"])
def test_files_are_made_of_legal_models_only(models: Path, task: str) -> None:
    assert reported(models, task, "legal.xml", "--out", "made/here") == (0, "", "")
    assert any("int32_t" in p.read_text() or "long" in p.read_text() for p in (models / "made" / "here").rglob("*.*"))
    status, out, _ = reported(models, task, "broken.xml", "--out", "other")
    assert status == 1
    assert "broken.xml:2: error: " in out
    assert not (models / "other").exists()


@pytest.mark.parametrize(
    ("arguments", "problem"),
    [
        (["check", "nothing.xml"], "nothing.xml cannot be read"),
        (["check"], "Missing argument"),
        (["idl", "legal.xml"], "--out"),
        (["idl", "legal.xml", "--out", "legal.xml"], "legal.xml"),
        (["java", "legal.xml"], "No such command"),
    ],
)
def test_wrong_use_gives_a_message(models: Path, arguments: list[str], problem: str) -> None:
    status, _, err = reported(models, *arguments)
    assert status == 2
    assert problem in err


def test_a_mutant_is_a_program_like_the_reference(models: Path) -> None:
    name = "without_structures_have_fields"
    assert reported(models, name, "check", "broken.xml", module="mutants.toolchain") == (0, "", "")
    status, _, err = reported(models, "no_such_mutant", "check", "broken.xml", module="mutants.toolchain")
    assert status == 2
    assert err.startswith("no tool chain is called 'no_such_mutant'")
