"""Which source files beside generated headers are linked: those that are needed, or those that the vendor names."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest
from test_cpp_compiling import HERE
from test_cpp_mapping import model

from ucm_cts.adapters.toolchain.program import reference
from ucm_cts.harness.toolchains.cpp.comparing import compare
from ucm_cts.harness.toolchains.cpp.compiling import LAYOUT, Compiler, Layout, compile_text
from ucm_cts.harness.toolchains.description import read_toolchain
from ucm_cts.harness.toolchains.differences import Comparison

DEMONSTRATION = '#include "constants.hpp"\nint main() { return 0; }\n'
UNFINISHED = "void to_be_written();\nvoid body() { to_be_written(); }\n"
NOT_CODE = "your code goes here\n"


def generated() -> dict[str, str]:
    files = dict(reference().generators["cpp03"](model("constants")))
    assert "constants.cpp" in files
    return files


def compared(files: dict[str, str], layout: Layout = LAYOUT) -> Comparison:
    return compare(model("constants"), files, "cpp03", {}, Compiler(), layout)


def test_what_is_not_needed_is_not_held_against_the_headers() -> None:
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


def test_old_compilers_of_long_long_are_told_so(tmp_path: Path) -> None:
    allowed = Compiler(("g++", "-Wno-long-long"))
    assert compile_text("long x = 1LL;\n", tmp_path, HERE, "cpp03", Compiler()).errors
    assert not compile_text("long x = 1LL;\n", tmp_path, HERE, "cpp03", allowed).errors
