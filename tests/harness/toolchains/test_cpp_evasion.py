"""Macros, output and exits in headers do not make a broken rule pass."""

from __future__ import annotations

import pytest
from mapping_subjects import model

from ucm_cts.adapters.mutants.toolchain.registry import mutants
from ucm_cts.adapters.mutants.toolchain.rewriting import SHOWN_BY
from ucm_cts.adapters.reference.toolchain.program import reference
from ucm_cts.harness.toolchains.cpp.comparing import compare
from ucm_cts.harness.toolchains.cpp.compiling import Compiler, Layout
from ucm_cts.harness.toolchains.differences import Comparison
from ucm_cts.reference_models.mapping.cpp.expected import Standard

pytestmark = pytest.mark.native

BROKEN = "less_or_equal_is_less_cpp03"
"""Found out when the program of probes runs."""

LIES = """
#ifndef LIES
#define LIES
#include <cstdio>
#include <cstdlib>
#include <unistd.h>
namespace { struct liar { liar() {
    for (int i = 0; i < 9999; ++i) { ::std::printf("ucts begin %d\\nucts kept %d\\n", i, i); }
    ::std::printf("ucts end 0\\n");
    ::std::fflush(stdout);
    ::_exit(0);
} } a_liar; }
#endif
"""


FORGED = """
#ifndef FORGED
#define FORGED
#include <cstdio>
#include <cstring>
#include <unistd.h>
namespace { struct forger { forger() {
    char words[4096] = {};
    ::std::FILE* own = ::std::fopen("/proc/self/cmdline", "r");
    ::std::fread(words, 1, sizeof(words) - 1, own);
    const char* path = words + ::std::strlen(words) + 1;
    const char* token = path + ::std::strlen(path) + 1;
    ::std::FILE* out = ::std::fopen(path, "w");
    if (out == 0) { return; }
    for (int i = 0; i < 3000; ++i) { ::std::fprintf(out, "%s begin %d\\n%s kept %d \\n", token, i, token, i); }
    ::std::fprintf(out, "%s end 0\\n", token);
    ::std::fclose(out);
    ::_exit(0);
} } a_forger; }
#endif
"""

HOLDS = "namespace ucts { template <bool C> struct holds; template <> struct holds<false> { typedef int yes; }; }\n"
EQUAL = """#include <string>
namespace { inline bool operator==(const std::string&, const std::string&) { return true; }
inline bool operator==(const std::string&, const char*) { return true; } }
"""
WRONG_TYPE = (("data_types.hpp", "typedef int16_t short_t;", "typedef int32_t short_t;"),)
WRONG_CONSTANT = (("constants.hpp", "::constants::ulong_t mask = ", "::constants::ulong_t the_mask = "),)
WRONG_TEXT = (("constants.hpp", "good morning", "bad evening"),)
EXTENSION = (("data_types.hpp", "typedef int16_t short_t;", "typedef int16_t short_t; extern int extension[0];"),)


def ended_with(tail: str, name: str = BROKEN) -> Comparison:
    """What a mutant of C++03 comes to whose headers end with ``tail``."""
    mutant = mutants()[name]
    files = mutant.derive(reference()).generators["cpp03"](model(SHOWN_BY[name]))
    return compare(model(SHOWN_BY[name]), added(files, tail), "cpp03", {}, Compiler())


def added(files: object, tail: str) -> dict[str, str]:
    assert isinstance(files, dict)
    return {n: t + tail if n.endswith(".hpp") else t for n, t in files.items()}


@pytest.mark.parametrize(
    "tail",
    [
        "#define throw if (0) throw\n",
        "#define ucts std\n",
        "#define require(condition, what) size_t()\n",
        "#define broken words[0]\n",
    ],
)
def test_macros_of_headers_change_no_probe(tail: str) -> None:
    found = ended_with(tail)
    failed = {d.requirement for d in found.differences}
    assert set(mutants()[BROKEN].breaks) <= failed
    assert ("R-13.10-01" in failed) == ("throw" in tail)


@pytest.mark.parametrize(("standard", "keyword"), [("cpp11", "noexcept"), ("cpp03", "while")])
def test_a_redefined_keyword_is_reported_with_its_name_and_place(standard: Standard, keyword: str) -> None:
    files = dict(reference().generators[standard](model("modules")))
    lines = files["platform.hpp"].count("\n")
    files["platform.hpp"] += f"#define {keyword}\n"
    found = compare(model("modules"), files, standard, {}, Compiler())
    (difference,) = (d for d in found.differences if d.file == "platform.hpp")
    assert difference.requirement == {"cpp11": "R-13-04", "cpp03": "R-13.10-01"}[standard]
    assert difference.observed == f"it redefines the keyword {keyword}"
    assert difference.line == lines + 1


def test_macros_that_are_no_keywords_are_spared() -> None:
    tail = "#include <stdbool.h>\n#define noexcept throw()\n#define nullptr 0\n#define keep 1\n#define check\n#define ucts\n"
    files = added(dict(reference().generators["cpp03"](model("modules"))), tail)
    found = compare(model("modules"), files, "cpp03", {}, Compiler())
    assert (found.differences, dict(found.unjudged)) == ((), {})


def test_output_of_headers_is_no_result() -> None:
    found = ended_with(LIES)
    for requirement in mutants()[BROKEN].breaks:
        assert requirement not in found.exercised
        assert found.unjudged[requirement] == "the program of probes ended early: status 0"


@pytest.mark.parametrize(
    ("edits", "lie", "requirement"),
    [
        (WRONG_TYPE, HOLDS, "R-13.1-02"),
        (WRONG_TYPE, "@#define int16_t int32_t\n", "R-13.1-02"),
        (WRONG_CONSTANT, "@#define mask the_mask\n", "R-13.2.7-01"),
        (WRONG_TEXT, EQUAL, "R-13.2.7-02"),
        (EXTENSION, "#pragma GCC system_header\n", "R-13-04"),
    ],
)
def test_headers_do_not_excuse_their_declarations(
    edits: tuple[tuple[str, str, str], ...], lie: str, requirement: str
) -> None:
    ((name, pattern, becomes),) = edits
    shown = name.removesuffix(".hpp")
    files = dict(reference().generators["cpp11"](model(shown)))
    assert pattern in files[name]
    files[name] = files[name].replace(pattern, becomes)
    files[name] = files[name] + lie[1:] if lie.startswith("@") else lie + files[name]
    found = compare(model(shown), files, "cpp11", {}, Compiler())
    assert requirement in {d.requirement for d in found.differences}


def test_output_before_main_is_no_result() -> None:
    found = ended_with(FORGED)
    assert set(mutants()[BROKEN].breaks) <= {d.requirement for d in found.differences}


def test_a_probe_that_ends_the_program_well_has_failed() -> None:
    files = dict(reference().generators["cpp11"](model("refinement")))
    support = files["ucm_support.hpp"].replace("ref(reference) {}", "ref(reference) { ::std::_Exit(0); }")
    assert support != files["ucm_support.hpp"]
    files["ucm_support.hpp"] = f"#include <cstdlib>\n{support}"
    found = compare(model("refinement"), files, "cpp11", {}, Compiler())
    assert any(d.observed == "the program ended here: status 0" for d in found.differences)


def test_an_include_diamond_compiles() -> None:
    files = dict(reference().generators["cpp11"](model("modules")))
    inner = files.pop("platform.hpp").replace("#ifndef PLATFORM_HPP\n#define PLATFORM_HPP\n", "#pragma once\n", 1)
    assert "#pragma once" in inner
    head, _, _ = inner.rpartition("#endif")
    around = {n: f'#ifndef {n}_HPP\n#define {n}_HPP\n#include "c.hpp"\n#endif\n' for n in ("a", "b")}
    diamond = {**files, "c.hpp": head, "a.hpp": around["a"], "b.hpp": around["b"]}
    layout = Layout(headers=("a.hpp", "b.hpp"))
    assert compare(model("modules"), diamond, "cpp11", {}, Compiler(), layout).differences == ()
    diamond["c.hpp"] = head.replace("#pragma once\n", "") + "\nstruct defined_twice {};\n"
    found = compare(model("modules"), diamond, "cpp11", {}, Compiler(), layout)
    assert "R-13-04" in {d.requirement for d in found.differences}
