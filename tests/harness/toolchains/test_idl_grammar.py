"""All IDL that clause 12 uses is read, other text is refused at the first wrong place, and hostile texts cost little."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ucm_cts.harness.toolchains.idl.language.reading import (
    DEEPEST,
    LARGEST,
    LONGEST_CHAIN,
    NotIdl,
    read_expression,
    read_files,
    read_idl,
)
from ucm_cts.harness.toolchains.idl.language.scopes import build
from ucm_cts.harness.toolchains.idl.language.values import Worth, worth
from ucm_cts.harness.toolchains.idl.omniidl import missing, opinion, without_annotations
from ucm_cts.reference_models.mapping.idl.declarations import (
    Annotation,
    ArrayOf,
    Attribute,
    Basic,
    Enum,
    Interface,
    Literal,
    Member,
    Module,
    ModuleInstance,
    Named,
    Native,
    Operation,
    Place,
    SequenceOf,
    Struct,
    Text,
    Typedef,
    Union,
)

ACCEPTED = [
    "",
    "module m { };",
    "module m { typedef long t; }; module m { typedef t u; };",
    "typedef unsigned long long a, b[2][3];",
    "typedef sequence<sequence<string<3>>, 4> s;",
    "typedef struct s { long a; } t;",
    "const long c = 256 >> 2; typedef sequence<string<3>> s; typedef long a[8 >> 1];",
    "@int8 typedef octet t; typedef @uint8 octet u;",
    '@IndexType(typeid="unsigned long") typedef sequence<short, 64> s;',
    "@Annotation IndexType { attribute String typeid; }",
    "@annotation range { long min default 0; long max; };",
    "@annotation how { enum kinds { A, B }; const long c = 1; kinds value default A; };",
    "@MemoryFootPrint(1024) native n;",
    'enum e { @DefaultValue(val="0xFF0000") RED, @value(3) GREEN };',
    "enum e { A, B }; union u switch (e) { case A: case ::B: long x; default: string y; };",
    "const long c = -(1 + 2) * 3 << 4 | ~5 & 6 ^ 7 % 8 / 9;",
    "const wstring w = L\"a\" L\"b\\n\"; const char c = '\\''; const wchar d = L'x';",
    "const double d = 1.5e-3; const float f = .5; const double g = 2e10; const octet o = 0x1F; const long l = 017;",
    "exception e { }; exception f { long a, b; @key string c; };",
    "interface i; local interface i { }; abstract interface j { };",
    "interface i : j, ::k::l { readonly attribute long a, b; attribute i c; };",
    "interface i { long long f(in i a, inout long b, out string c) raises (x, m::y); void g(); oneway void h(); };",
    "interface i { typedef long t; const t c = 1; exception e { }; struct s { t a; }; t f() raises (e); };",
    "module t<typename T, interface I, const long N> { typedef sequence<T> s; }; module t<long, i, m::j> n;",
    "module m::t<i> n; alias m::t<i> o;",
    "component c : b { port p q; attribute long x; provides i j; uses i k; }; porttype p { provides i x; };",
    "connector c { mirrorport p q; }; valuetype v { public long x; };",
    "interface _interface { void _local(in long _in); };",
    "typedef long typeid; typedef long port; struct s { long max, uses, component; };",
    '#ifndef A\n#define A\n#include "b.idl"\n#pragma prefix "x"\ntypedef long /* } */ a; // };\n#endif',
    "\ufefftypedef long\r\na;",
]


@pytest.mark.parametrize("text", ACCEPTED)
def test_constructs_are_read(text: str) -> None:
    read_idl(text, "a.idl")


REFUSED = [
    ("typedef long a", 1, 15),
    ("typedef long;", 1, 13),
    ("module m {\n  typedef long a;\n", 2, 18),
    ("struct s {\n  long a\n};", 3, 1),
    ("enum e { A, };", 1, 13),
    ("enum e { };", 1, 10),
    ("typedef short[64] a;", 1, 14),
    ("typedef unsigned longlong a;", 1, 18),
    ("typedef unsigned float a;", 1, 18),
    ("struct interface { long a; };", 1, 8),
    ("struct s { long Boolean; };", 1, 17),
    ("interface i { f(); };", 1, 16),
    ("interface i { void f(long a); };", 1, 22),
    ("interface i { void f(in long); };", 1, 29),
    ("interface i { attribute void a; };", 1, 25),
    ("const long c;", 1, 13),
    ("const long c = ;", 1, 16),
    ("union u switch (e) { };", 1, 22),
    ("typedef a:b c;", 1, 10),
    ("/* no end", 1, 1),
    ('typedef long a;\n"no end\ntypedef long b;', 2, 1),
    ("@ typedef long a b;", 1, 11),
    ("typedef long a; }", 1, 17),
    ("map<long, long> m;", 1, 1),
    ("typedef long \u00e4;", 1, 14),
    ("typedef long a;\n\0", 2, 1),
]


@pytest.mark.parametrize(("text", "line", "column"), REFUSED)
def test_wrong_idl_is_refused_at_its_place(text: str, line: int, column: int) -> None:
    with pytest.raises(NotIdl) as refused:
        read_idl(text, "a.idl")
    problem = refused.value.problem
    assert (problem.file, problem.line, problem.column) == ("a.idl", line, column), problem


def test_declarations_have_text_and_place() -> None:
    text = """module m {
  @int8
  typedef octet t, u[2];
  interface i : ::b::c { readonly attribute m::t a; sequence<t, 3> f(in string<4> x) raises (e); };
};
"""
    here = {"t": Place("a.idl", 3, 17), "u": Place("a.idl", 3, 20), "i": Place("a.idl", 4, 13)}
    (module,) = read_idl(text, "a.idl")
    assert isinstance(module, Module)
    int8 = (Annotation("int8", (), Place("a.idl", 2, 3)),)
    t, u, i = module.body
    assert t == Typedef(name="t", type=Basic("octet"), annotations=int8, place=here["t"])
    assert isinstance(u, Typedef)
    assert u.type == ArrayOf(Basic("octet"), (Literal("integer", "2"),))
    assert u.place == here["u"]
    assert isinstance(i, Interface)
    assert (i.place, i.bases) == (here["i"], ("::b::c",))
    attribute, operation = i.body
    assert isinstance(attribute, Attribute)
    assert (attribute.readonly, attribute.type) == (True, Named("m::t"))
    assert isinstance(operation, Operation)
    assert operation.returns == SequenceOf(Named("t"), Literal("integer", "3"))
    assert operation.raises == ("e",)
    assert operation.parameters[0].type == Text(False, Literal("integer", "4"))


def test_unions_enumerations_templates_and_natives_are_distinguished() -> None:
    union, enum, native, template, instance, struct = read_idl(
        "union u switch (e) { case A: default: long x; }; enum e { A, B }; @f(max=3) native n; "
        "module t<interface I> { }; module t<m::J> o; struct s : b { long a; };"
    )
    assert isinstance(union, Union)
    assert union.cases[0].labels == (Named("A"), None)
    assert isinstance(enum, Enum)
    assert [one.name for one in enum.enumerators] == ["A", "B"]
    assert isinstance(native, Native)
    assert native.annotations[0].arguments[0].name == "max"
    assert isinstance(template, Module)
    assert [(p.kind, p.name) for p in template.parameters] == [("interface", "I")]
    assert isinstance(instance, ModuleInstance)
    assert (instance.name, instance.template, instance.arguments) == ("o", "t", (Named("m::J"),))
    assert isinstance(struct, Struct)
    assert isinstance(struct.members[0], Member)
    assert struct.base == "b"


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1 + 2 * 3", 7),
        ("(1 + 2) * 3", 9),
        ("010", 8),
        ("0xfF", 255),
        ("-7 / 2", -3),
        ("-7 % 4", -3),
        ("1 << 4 | 3", 19),
        ("~0 & 6 ^ 1", 7),
        ("256 >> 2 << 1", 128),
        ('"a >> b"', "a >> b"),
        ("TRUE", True),
        ("1.5e1", 15.0),
        ('"a" "b\\n"', "ab\n"),
        ("'\\x41'", "A"),
        ("1 / 0", None),
        ("1 << 100000", None),
        ('"a" + 1', None),
        ("nothing", None),
    ],
)
def test_expressions_have_the_value_that_idl_gives_them(text: str, value: Worth | None) -> None:
    found = worth(read_expression(text), build({}))
    assert (found, type(found)) == (value, type(value))


HOSTILE = [
    "module m {" * (DEEPEST + 1),
    "typedef " + "sequence<" * 5000 + "long" + ">" * 5000 + " t;",
    "const long c = " + "(" * 5000 + "1" + ")" * 5000 + ";",
    "const long c = " + "1 + " * (LONGEST_CHAIN + 1) + "1;",
    "const long c = " + "-" * 5000 + "1;",
    " " * (LARGEST + 1),
    "/*" * 100000,
    '"' * 100001,
    "@a(" * 5000,
]


@pytest.mark.parametrize("text", HOSTILE, ids=range(len(HOSTILE)))
def test_hostile_texts_are_refused_in_one_line(text: str) -> None:
    with pytest.raises(NotIdl) as refused:
        read_idl(text, "a.idl")
    assert str(refused.value).startswith("a.idl:")
    assert len(str(refused.value)) < 200
    assert "\n" not in str(refused.value)


WORDS = st.sampled_from(
    [
        "module",
        "m",
        "{",
        "}",
        ";",
        "interface",
        "i",
        ":",
        ",",
        "typedef",
        "long",
        "t",
        "struct",
        "<",
        ">",
        "(",
        ")",
        "@",
        "=",
        '"',
        "'",
        "1",
        "::",
        "#",
        "/*",
        "*/",
        "//",
        "\n",
    ]
)


@settings(max_examples=150, deadline=None, derandomize=True, database=None)
@given(st.one_of(st.text(max_size=60), st.lists(WORDS, max_size=40).map(" ".join)))
def test_no_text_ends_the_reader(text: str) -> None:
    files = read_files({"a.idl": text})
    assert bool(files.problems) != ("a.idl" in files.declarations)


def test_files_that_are_included_and_not_there_are_known() -> None:
    files = {"gen/a.idl": '#include "b.idl"\n#include <ucm/core.idl>\n', "gen/b.idl": "typedef long t;"}
    assert read_files(files).missing == ("ucm/core.idl",)


def test_annotations_are_blanked_for_omniidl_in_place() -> None:
    text = '@annotation a { long b; };\n@a(b=")") typedef string<3> t; const string s = "@a";'
    blank = without_annotations(text)
    assert len(blank) == len(text)
    assert blank.index("typedef") == text.index("typedef")
    assert blank.endswith('const string s = "@a";')
    assert "@a(" not in blank


@pytest.mark.native
def test_omniidl_checks_the_idl_that_it_knows() -> None:
    good = {"b.idl": '#include "a.idl"\nmodule m { typedef x::t u; };', "a.idl": "module x { @int8 typedef octet t; };"}
    assert opinion(good).verdict == "agreed"
    wrong = opinion({**good, "b.idl": '#include "a.idl"\nmodule m { typedef x::t u;\n typedef x::nothing v; };'})
    assert wrong.verdict == "refused"
    assert (wrong.problems[0].file, wrong.problems[0].line) == ("b.idl", 3)
    for text in ("module t<typename T> { };", "typedef int8 t;", '#include "c.idl"', "typedef long;"):
        assert opinion({"a.idl": text}).verdict == "none"


def test_a_missing_omniidl_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "")
    assert "not installed" in missing()
    assert opinion({"a.idl": "typedef octet t;"}).verdict == "none"
