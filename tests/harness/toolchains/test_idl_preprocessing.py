"""IDL files are read as a preprocessor leaves them, each line at its place; hostile directives cost little."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ucm_cts.harness.toolchains.idl.language.preprocessing import DEEPEST_INCLUDES, preprocessed
from ucm_cts.harness.toolchains.idl.language.reading import NotIdl, read_files, read_idl
from ucm_cts.harness.toolchains.idl.omniidl import opinion
from ucm_cts.reference_models.mapping.idl.declarations import Typedef


def left(text: str) -> list[str]:
    """The lines of ``text`` that are left, each with one blank between words."""
    done = preprocessed({"a.idl": text})
    assert not done.problems
    lines = [" ".join(line.split()) for line in done.texts["a.idl"].split("\n")]
    assert len(lines) == text.replace("\r\n", "\n").count("\n") + 1
    return lines


CONDITIONS = [
    ("0", False),
    ("1", True),
    ("A", False),
    ("N", True),
    ("defined A", False),
    ("defined(N) && !defined ( A )", True),
    ("N == 3 || UNKNOWN", True),
    ("N*2+1==7", True),
    ("(N > 3) != (N >= 3)", True),
    ("N < 3 ? 1 : 0", False),
    ("-1 < 0 && ~0 == -1", True),
    ("0x10L == 020 && 16u == 0b10000", True),
    ("1 << 2 >> 1 == 2", True),
    ("-7 / 2 == -3 && -7 % 2 == -1", True),
    ("0 && 1 / 0", False),
    ("SQUARE(N) == 9", True),
    ("true && !false", True),
    ("'a' == 97", True),
    ("1 | 0 ^ 1 & 0", True),
    ("!!N /* a comment */", True),
    ("N \\\n== 3", True),
]


@pytest.mark.parametrize(("condition", "holds"), CONDITIONS)
def test_conditions_hold_as_in_cpp(condition: str, holds: bool) -> None:
    text = f"#define N 3\n#define SQUARE(x) ((x) * (x))\n#if {condition}\nyes\n#else\nno\n#endif"
    assert ("yes" in left(text), "no" in left(text)) == (holds, not holds)


def test_one_branch_is_taken() -> None:
    text = "#define B\n#ifdef A\na\n#elif defined B\nb\n# if 0\nnever\n# else\nc\n# endif\n#elif B B B\n#else\nd\n#endif\ne"
    assert [line for line in left(text) if line] == ["b", "c", "e"]
    assert [line for line in left("#ifndef A\na\n#elifdef B\nb\n#endif\n#if 0\n#else\nc\n#endif") if line] == ["a", "c"]


MACROS = [
    ("#define N 16\nstring<N> N_1 \"N\" 'N' // N", ["", "string< 16 > N_1 \"N\" 'N'"]),
    ("#define A B\n#define B A\nA B", ["", "", "A B"]),
    ("#define N 1\nN\n#undef N\nN\n#define N 2\nN", ["", "1", "", "N", "", "2"]),
    ("#define F(x, y) y x\nF(a,\n  (b, c))\nF", ["", "(b, c) a", "", "F"]),
    ("#define F (x)\nF(1)", ["", "(x) (1)"]),
    ("#define S(x) #x\n#define J(a, b) a##b\nS(a \"b\") J(c, d)", ["", "", '"a \\"b\\"" cd']),
    ("#define V(a, ...) a(__VA_ARGS__)\nV(1, 2, 3)", ["", "1(2, 3)"]),
    ("#define E() x\nE() E( )", ["", "x x"]),
    ("#define N /* a\ncomment */ 3\nN", ["", "", "3"]),
    ("// goes on \\\nnot here\nhere", ["", "", "here"]),
    ("\ufeff/* a\n*/ #define N 3\r\nN\r\n#pragma N\n#\n# 1 \"x\"\n#line 7\n#warning no\nN", ["", "", "3", *[""] * 5, "3"]),
    ("a\n  b /* c\nd */ e \\\nf", ["a", "b", "e", "f"]),
]  # fmt: skip


@pytest.mark.parametrize(("text", "lines"), MACROS)
def test_macros_are_replaced_where_they_stand(text: str, lines: list[str]) -> None:
    assert left(text) == lines


REFUSED = [
    ("a\n#if 1\n", 2),
    ("\n#endif", 2),
    ("#else\n", 1),
    ("#if 1\n#else\n#elif 1\n#endif", 3),
    ("#if\n#endif", 1),
    ("#if (1\n#endif", 1),
    ("#if 1 +\n#endif", 1),
    ("#if 1 2\n#endif", 1),
    ("#if 09\n#endif", 1),
    ("#ifdef\n#endif", 1),
    ("\n\n#error this is no IDL", 3),
    ("#define\n", 1),
    ("#define F(1) x\n", 1),
    ("#define F(x) x\n\nF(1, 2)", 2),
    ("#define F(x) x\nF(1", 2),
    ("#if 0\n/*\n#endif", 2),
]


@pytest.mark.parametrize(("text", "line"), REFUSED)
def test_wrong_directives_are_refused_with_their_line(text: str, line: int) -> None:
    with pytest.raises(NotIdl) as refused:
        read_idl(text, "a.idl")
    assert (refused.value.problem.file, refused.value.problem.line) == ("a.idl", line)


HOSTILE = [
    "#define A0 x x\n" + "".join(f"#define A{n + 1} A{n} A{n}\n" for n in range(60)) + "A60\n",
    "#define F(x) x x x x\n" + "F(" * 40 + "y" + ")" * 40,
    "#define F(x) x\n" + "F(" * 5000 + "y" + ")" * 5000,
    "".join(f"#define A{n + 1} A{n}\n" for n in range(5000)) + "A5000\n",
    "#define C(a) a##a\n#define D0(x) C(x)\n" + "".join(f"#define D{n + 1}(x) D{n}(C(x))\n" for n in range(40)) + "D40(ab)",
    "#if 1\n" * 10000,
    "#if " + "(" * 5000 + "1" + ")" * 5000 + "\n#endif",
    "#if " + "(" * 900 + "1" + ")" * 900 + "\n#endif",
    "#if " + "9" * 90000 + "\n#endif",
    "#if " + "1 ? " * 900 + "\n#endif",
    "#if " + "defined " * 50000,
]  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("text", HOSTILE, ids=range(len(HOSTILE)))
def test_hostile_directives_are_refused_in_one_line(text: str) -> None:
    with pytest.raises(NotIdl) as refused:
        read_idl(text, "a.idl")
    assert len(str(refused.value)) < 200
    assert "\n" not in str(refused.value)


@pytest.mark.native
def test_files_go_on_with_the_macros_of_those_that_they_include() -> None:
    files = {
        "b.idl": "typedef string<N> t;",
        "m/c.idl": '#ifndef C\n#define C\n#define N 3\n#include "../a.idl"\n#endif',
        "a.idl": '#include "m/c.idl"\n#include "b.idl"\n#include "c.idl"\ntypedef t u;',
    }
    for order in (files, dict(reversed(files.items()))):
        read = read_files(order)
        assert not read.problems
        assert not read.missing
        assert {name: [d.name for d in read.declarations[name]] for name in files} == {
            "b.idl": ["t"],
            "m/c.idl": [],
            "a.idl": ["u"],
        }
        assert opinion(order).verdict == "agreed"


def test_files_that_no_other_includes_know_nothing_of_one_another() -> None:
    guarded = "#ifndef GUARD\n#define GUARD\ntypedef long {};\n#endif"
    read = read_files({"a.idl": guarded.format("a"), "b.idl": guarded.format("b")})
    assert [d.name for one in read.declarations.values() for d in one] == ["a", "b"]
    hidden = {"a.idl": '#if 0\n#include "b.idl"\n#include "gone.idl"\n#endif', "b.idl": "typedef long b;"}
    assert read_files(hidden).missing == ()
    assert isinstance(read_files(hidden).declarations["b.idl"][0], Typedef)


def test_a_file_that_another_one_hides_is_not_there() -> None:
    guarded = "#ifndef GUARD\n#define GUARD\ntypedef long b;\n#endif"
    files = {"a.idl": '#define GUARD\n#include "b.idl"\n', "b.idl": guarded}
    assert read_files(files).declarations == {"a.idl": (), "b.idl": ()}


@pytest.mark.parametrize(("count", "refused"), [(DEEPEST_INCLUDES, 0), (DEEPEST_INCLUDES + 1, 1)])
def test_files_may_include_one_another_as_deep_as_compilers_read(count: int, refused: int) -> None:
    files = {f"{n}.idl": f'#include "{n + 1}.idl"\ntypedef long t{n};' for n in range(count)}
    assert len(read_files(files).problems) == refused


WORDS = st.sampled_from(
    ["#if", "#ifdef", "#else", "#endif", "#elif", "#define", "#undef", "#include", "a", "b", "(", ")", ",", "1", "##",
     "#", "\n", "\n", "\n#", "\\\n", '"', "'", "/*", "*/", "//", "defined", "&&", "!", "...", "typedef long t;"]
)  # fmt: skip


@settings(max_examples=150, deadline=None, derandomize=True, database=None)
@given(st.lists(WORDS, max_size=40).map(" ".join), st.lists(WORDS, max_size=20).map("".join))
def test_no_directive_ends_the_reader(text: str, other: str) -> None:
    files = {"a.idl": text, "a": other}
    done = preprocessed(files)
    assert done.texts.keys() | done.problems.keys() == files.keys()
    for name in done.texts:
        assert done.texts[name].count("\n") == files[name].count("\n")
