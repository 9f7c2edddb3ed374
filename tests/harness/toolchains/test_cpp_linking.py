"""The source files beside generated headers that are linked: needed ones, or those that the vendor names."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import pytest
from mapping_subjects import NO_HEADERS, model

from ucm_cts.adapters.reference.toolchain.program import reference
from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.results.statement import default_statement
from ucm_cts.harness.toolchains.commands.description import Command, ToolChain, read_toolchain
from ucm_cts.harness.toolchains.commands.processing import CommandLine
from ucm_cts.harness.toolchains.cpp.comparing import compare
from ucm_cts.harness.toolchains.cpp.compiling import LAYOUT, Compiler, Layout, compile_text
from ucm_cts.harness.toolchains.differences import Comparison
from ucm_cts.harness.toolchains.examinations import examination_for
from ucm_cts.harness.toolchains.renaming import Renaming

pytestmark = pytest.mark.native

DEMONSTRATION = '#include "constants.hpp"\nint main() { return 0; }\n'
UNFINISHED = "void to_be_written();\nvoid body() { to_be_written(); }\n"
NOT_CODE = "your code goes here\n"


def generated() -> dict[str, str]:
    files = dict(reference().generators["cpp03"](model("constants")))
    assert "constants.cpp" in files
    return files


def compared(files: dict[str, str], layout: Layout = LAYOUT) -> Comparison:
    return compare(model("constants"), files, "cpp03", {}, Compiler(), layout)


def test_unneeded_sources_are_remarks_only() -> None:
    found = compared({**generated(), "main.cpp": DEMONSTRATION, "body.cc": UNFINISHED, "skeleton/body.cxx": NOT_CODE})
    assert found.differences == ()
    (remark,) = found.remarks
    assert remark.startswith("skeleton/body.cxx does not compile (line 1: ")


def test_a_source_that_is_needed_must_compile() -> None:
    files = generated()
    files["constants.cpp"] += NOT_CODE
    (difference,) = compared(files).differences
    assert difference.requirement == "R-13.10-01"
    assert "undefined reference" in difference.observed
    assert "constants.cpp does not compile (line " in difference.observed


def test_sources_that_are_named_are_linked() -> None:
    files = {**generated(), "main.cpp": DEMONSTRATION}
    assert compared(files, Layout(sources=("constants.cpp",))).differences == ()
    for sources, problem in ((("**/*.cpp",), "multiple definition of"), ((), "undefined reference to")):
        (difference,) = compared(files, Layout(sources=sources)).differences
        assert difference.requirement == "R-13.10-01"
        assert problem in difference.observed


def test_libraries_are_linked_after_everything_else(tmp_path: Path) -> None:
    files = generated()
    for name, text in files.items():
        (tmp_path / name).write_text(text)
    subprocess.run(["g++", "-std=c++03", "-c", "constants.cpp"], cwd=tmp_path, check=True)
    subprocess.run(["ar", "rcs", "libruntime.a", "constants.o"], cwd=tmp_path, check=True)
    runtime = Layout(sources=(), libraries=(f"-L{tmp_path}", "-lruntime"))
    assert compared(files, runtime).differences == ()


@pytest.mark.parametrize(
    ("lines", "sources"), [("", None), ("sources = []\n", ()), ('sources = ["*.cc"]\n', ("*.cc",))]
)
def test_the_description_names_sources_and_libraries(
    tmp_path: Path, lines: str, sources: tuple[str, ...] | None
) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(
        'product = "p"\nversion = "1"\n[cpp11]\ncommand = ["c", "{model}", "{out}"]\n'
        f'libraries = ["lib/mine.a", "-lm", "/opt/x.a"]\n{lines}'
    )
    described = read_toolchain(path).cpp11
    assert described is not None
    assert described.sources == sources
    assert described.libraries == (str(tmp_path / "lib/mine.a"), "-lm", "/opt/x.a")


def test_a_compiler_beside_the_description_is_found(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(
        'product = "p"\nversion = "1"\n[cpp11]\ncommand = ["c", "{model}", "{out}"]\ncompiler = ["./c++", "-I./x"]\n'
    )
    described = read_toolchain(path).cpp11
    assert described is not None
    assert described.compiler == (str(tmp_path / "c++"), "-I./x")


def test_without_any_compiler_the_profile_is_not_begun(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "/nowhere")
    with pytest.raises(WrongUse, match=re.escape("no compiler 'g++' can be run; install it, or name another")):
        examination_for("cpp03", default_statement(), Renaming(0))


@pytest.mark.parametrize("include", [("include",), ("include", "."), (".", "include"), ("include", "include/inner")])
def test_headers_are_found_below_any_folder(include: tuple[str, ...]) -> None:
    inner = {f"include/inner/{name}": text for name, text in generated().items()}
    name = "include/inner/constants.hpp"
    inner[name] = re.sub(r'#include "(ucm_support.hpp)"', r"#include <inner/\1>", inner[name])
    if include == (".", "include"):
        inner["inner/constants.hpp"] = "#error another header of that name\n"
    headers = ("include/**/*.hpp",)
    assert compared(inner, Layout(include=include, headers=headers)).differences == ()


def test_files_with_names_of_other_encodings_are_read(tmp_path: Path) -> None:
    generator = tmp_path / "generator"
    generator.write_text("#!/bin/sh\necho '#pragma once' > \"$2/$(printf '\\377\\376').hpp\"\n")
    generator.chmod(0o755)
    command = Command(command=(str(generator), "{model}", "{out}"))
    made = CommandLine(ToolChain("p", "1", cpp11=command)).process("cpp11", "m", "<m/>")
    assert made.files == {"\\xff\\xfe.hpp": "#pragma once\n"}


def test_old_compilers_are_told_that_long_long_is_permitted(tmp_path: Path) -> None:
    allowed = Compiler(("g++", "-Wno-long-long"))
    assert compile_text("long x = 1LL;\n", tmp_path, NO_HEADERS, "cpp03", Compiler()).errors
    assert not compile_text("long x = 1LL;\n", tmp_path, NO_HEADERS, "cpp03", allowed).errors
