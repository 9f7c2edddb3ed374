"""Diagnostics of every compiler are read, and its crashes are reported."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import pytest
from mapping_subjects import NO_HEADERS, model

from ucm_cts.adapters.reference.toolchain.program import reference
from ucm_cts.harness.toolchains.cpp import compiling
from ucm_cts.harness.toolchains.cpp.comparing import compare
from ucm_cts.harness.toolchains.cpp.compiling import Compiler, Error, NoCompiler, compile_text

pytestmark = pytest.mark.native


def test_errors_are_read_as_json() -> None:
    reported = (
        '[{"kind": "error", "message": "no", "children": [{"kind": "note", "message": "here",'
        ' "locations": [{"caret": {"file": "/a.hpp", "line": 3}}]}],'
        ' "locations": [{"caret": {"file": "R-13.1-01#4", "line": 1}}]},'
        ' {"kind": "warning", "message": "w", "children": [], "locations": []}]'
    )
    assert compiling._read_json(reported) == [Error("R-13.1-01#4", 1, "no", False, (("/a.hpp", 3),))]
    assert compiling._read_json("no json") is None


@pytest.mark.parametrize(
    ("reported", "error"),
    [
        ("R-13.1-01#4:1:2: error: no such type", Error("R-13.1-01#4", 1, "no such type")),
        ("R-13.1-01#4(1): error C2039: no such type", Error("R-13.1-01#4", 1, "no such type")),
        (
            "/a.hpp: In instantiation of 'f':\nR-13.1-01#4:1:2:   required from here\n/a.hpp:7:1: error: bad",
            Error("R-13.1-01#4", 7, "bad", False, (("/a.hpp", 7),)),
        ),
        (
            "/a.hpp:7:1: error: bad\nR-13.1-01#4:1:2: note: in instantiation of 'f' requested here",
            Error("R-13.1-01#4", 7, "bad", False, (("/a.hpp", 7),)),
        ),
        (
            "/a.hpp:1:1: fatal error: x.hpp: No such file",
            Error("/a.hpp", 1, "x.hpp: No such file", True, (("/a.hpp", 1),)),
        ),
        ("a.o: undefined reference to `x'", Error("", 0, "undefined reference to `x'")),
    ],
)
def test_errors_are_read_as_text(reported: str, error: Error) -> None:
    assert compiling.read_errors(reported) == [error]


def test_a_template_s_error_counts_for_the_probe_that_uses_it(tmp_path: Path) -> None:
    text = (
        'template <class T> void f(T t) { t.nope(); }\n#line 1 "R-13.1-01#7"\nvoid a() { f(1); }\n'
        '#line 1 "R-13.1-02#8"\nvoid b() { ::nowhere::x(); }\n'
    )
    compiled = compile_text(text, tmp_path, NO_HEADERS, "cpp03", Compiler())
    assert {error.file for error in compiled.errors} == {"R-13.1-01#7", "R-13.1-02#8"}


def test_extensions_are_errors(tmp_path: Path) -> None:
    assert compile_text("long long x;\n", tmp_path, NO_HEADERS, "cpp03", Compiler()).errors
    assert not compile_text("long long x;\n", tmp_path, NO_HEADERS, "cpp11", Compiler()).errors


def test_a_compiler_that_does_not_end_is_stopped(tmp_path: Path) -> None:
    slow = tmp_path / "slow"
    slow.write_text("#!/bin/sh\nsleep 60\n")
    slow.chmod(0o755)
    compiled = compile_text("", tmp_path, NO_HEADERS, "cpp11", Compiler((str(slow),), seconds=0.2))
    assert compiled.ended_early
    assert "no end" in compiled.problem


def test_compilers_without_json_are_understood(tmp_path: Path) -> None:
    other = tmp_path / "clang"
    other.write_text(
        '#!/bin/sh\ncase "$*" in\n*-fmax-errors*) echo "clang: error: unknown argument: \'-fmax-errors=0\'" >&2; exit 1;;\n'
        """*-ferror-limit=0*) sed -n 's/^#line 1 "\\(.*\\)"$/\\1:1:1: error: no/p' probes.cpp >&2; exit 1;;\nesac\n"""
    )
    other.chmod(0o755)
    compiled = compile_text('#line 1 "R-13.1-01#3"\n', tmp_path, NO_HEADERS, "cpp11", Compiler((str(other),)))
    assert compiled.errors == (Error("R-13.1-01#3", 1, "no"),)


def test_a_missing_compiler_is_reported(tmp_path: Path) -> None:
    with pytest.raises(NoCompiler, match="no program 'no-such-compiler'"):
        compile_text("", tmp_path, NO_HEADERS, "cpp11", Compiler(("no-such-compiler",)))


def test_a_compiler_that_a_header_keeps_busy_is_not_asked_any_more(tmp_path: Path) -> None:
    (tmp_path / "asked").touch()
    slow = tmp_path / "slow"
    slow.write_text(f"#!/bin/sh\necho asked >> {tmp_path}/asked\nsleep 60\n")
    slow.chmod(0o755)
    files = {f"header_{number}.hpp": "#pragma once\n" for number in range(6)}
    comparison = compare(model("modules"), files, "cpp11", {}, Compiler((str(slow),), seconds=0.3))
    assert {d.requirement for d in comparison.differences} == {"R-13-04"}
    for requirement in ("R-13.3-01", "R-13.6-04"):
        assert "no end after 0.3 s" in comparison.unjudged[requirement]
    assert (tmp_path / "asked").read_text().count("asked") <= 2


def test_headers_that_do_not_compile_hide_nothing_silently() -> None:
    files = {"m.hpp": '#include "not_there.hpp"\n'}
    comparison = compare(model("modules"), files, "cpp11", {}, Compiler())
    assert {d.requirement for d in comparison.differences} == {"R-13-04"}
    assert comparison.exercised == {"R-13-04": 1}
    assert "R-13.3-01" in comparison.unjudged


def test_a_crash_of_a_probe_program_names_the_check() -> None:
    files = dict(reference().generators["cpp11"](model("refinement")))
    name = "refinement_application.hpp"
    files["ucm_support.hpp"] = files["ucm_support.hpp"].replace(
        "ref(reference) {}", "ref(reference) { __builtin_trap(); }"
    )
    assert name in files
    broken = compare(model("refinement"), files, "cpp11", {}, Compiler()).differences
    assert any("signal" in d.observed for d in broken)


def test_without_libclang_nothing_is_judged_that_needs_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "clang.py").write_text("raise ImportError\n")
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join([str(tmp_path), *sys.path]))
    files = {**reference().generators["cpp11"](model("modules")), "note.txt": "not compared before"}
    comparison = compare(model("modules"), files, "cpp11", {}, Compiler())
    assert comparison.differences == ()
    assert "R-13.6-04" not in comparison.exercised
    assert "libclang cannot be used" in comparison.unjudged["R-13.6-04"]


@pytest.mark.parametrize("forged", ["R-13.3-01#abc", "R-13.3-01#0"])
def test_headers_cannot_name_a_probe(forged: str) -> None:
    files = dict(reference().generators["cpp11"](model("modules")))
    files["platform.hpp"] += f'#line 1 "{forged}"\nnonsense x;\n'
    comparison = compare(model("modules"), files, "cpp11", {}, Compiler())
    assert {d.requirement for d in comparison.differences} == {"R-13-04"}


@pytest.mark.parametrize("name", ["my\nown.hpp", "\udcff\udcfe.hpp"])
def test_a_header_that_cannot_be_included_is_reported(name: str) -> None:
    files = {**reference().generators["cpp11"](model("modules")), name: "#pragma once\n"}
    comparison = compare(model("modules"), files, "cpp11", {}, Compiler())
    (difference,) = comparison.differences
    assert (difference.requirement, difference.observed) == ("R-13-04", "no #include can name it")
    str(difference).encode()
