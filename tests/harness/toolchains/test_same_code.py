"""Code in generated files is compared without comments, layout and order."""

from __future__ import annotations

import pytest

from ucm_cts.harness.toolchains.same_code import first_change, pieces

CODE = """#ifndef A_HPP
#define A_HPP
#include "b.hpp"
namespace m { // a remark
struct s { const char* text = "a // b"; };
long f(int number);
}
#endif
"""


def changed(other: str, file: str = "a.hpp") -> str:
    change = first_change(pieces({"a.hpp": CODE}), pieces({file: other}))
    return "" if change is None else f"{'+' if change.is_new else '-'}{change.piece.line} {change.piece.text}"


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("", ""),
        ("// a remark", "/* another\n one */"),
        ("long f(int number);", "long\n  f ( int number ) /* ; { */ ;"),
        ("#ifndef A_HPP\n#define A_HPP", "#ifndef X_1\n#define X_1"),
        ('"b.hpp"', '"c.hpp"'),
        ("namespace", '#line 12 "model.xml"\nnamespace'),
        ("struct s", "struct /* ends */ s"),
        ("\n", "\r\n"),
    ],
)
def test_the_same_code(old: str, new: str) -> None:
    assert changed(CODE.replace(old, new)) == ""
    assert changed(CODE, "version_2.hpp") == ""


def test_order_means_nothing() -> None:
    first, second = 'struct s { const char* text = "a // b"; };\n', "long f(int number);\n"
    assert changed(CODE.replace(first + second, second + first)) == ""
    parts = {"b.hpp": "int b;", "a.hpp": "int a;"}
    assert first_change(pieces(parts), pieces({"b.hpp": "int a;", "a.hpp": "int b;"})) is None


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("a // b", "a // c", '+5 const char * text = "a // c" ;'),
        ("#include", '#define VERSION "2"\n#include', '+3 #define VERSION "2"'),
        ("#include", "#if VERSION > 1\n#endif\n#include", "+3 #if VERSION > 1"),
        ("#ifndef", "// 2 \\\n#ifndef", "-1 #ifndef"),
        ("// a remark", "/* a remark", "+4 this comment does not end; close it"),
        ("long f(int number);\n", "", "-6 long f ( int number ) ;"),
        ("long f(int number);", "long f(int number); long f(int number);", "+6 long f ( int number ) ;"),
        ("}\n#endif", "}\nint\n#endif", "+8 int"),
        ("struct s", "struct s_", "+5 struct s_ {"),
    ],
)
def test_other_code(old: str, new: str, said: str) -> None:
    assert changed(CODE.replace(old, new)) == said
