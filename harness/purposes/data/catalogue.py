"""The types that are carried to check clause 10.1.1, by the requirement that each is to exercise."""

from __future__ import annotations

from dataclasses import dataclass

from ucm_cts.adapters.contract import data_types as d

KINDS: tuple[d.IntegerKind, ...] = ("BYTE", "SHORT", "LONG", "LONGLONG", "UBYTE", "USHORT", "ULONG", "ULONGLONG")

LONG, ULONG = d.Integer("LONG"), d.Integer("ULONG")
SHORT, UBYTE = d.Integer("SHORT"), d.Integer("UBYTE")
LONGLONG, ULONGLONG = d.Integer("LONGLONG"), d.Integer("ULONGLONG")
FLOAT, DOUBLE = d.Float("FLOAT"), d.Float("DOUBLE")
NAME = d.String("CHAR8", 16)

COLOUR = d.Enumeration("colour", "ULONG", {"red": 0, "green": 1, "blue": 2})
WITH_GAPS = d.Enumeration("with_gaps", "LONG", {"none": 0, "few": 10, "many": 11, "all": 2**31 - 1})
NEGATIVE = d.Enumeration("negative", "BYTE", {"lowest": -128, "below": -1, "zero": 0, "above": 1, "highest": 127})
DISORDERED = d.Enumeration("disordered", "USHORT", {"third": 3, "first": 1, "last": 65535, "second": 2})
LONELY = d.Enumeration("lonely", "UBYTE", {"only": 7})
SHORTER = d.Enumeration("shorter", "SHORT", {"least": -(2**15), "middle": 0, "most": 2**15 - 1})
LONGER = d.Enumeration("longer", "LONGLONG", {"least": -(2**31), "middle": 0, "most": 2**31 - 1})
LONGEST = d.Enumeration("longest", "ULONGLONG", {"none": 0, "some": 77, "most": 2**31 - 1})

POINT = d.Structure("point", {"x": LONG, "y": LONG, "z": LONG})
MIXED = d.Structure(
    "mixed",
    {
        "small": SHORT,
        "great": ULONGLONG,
        "precise": DOUBLE,
        "letter": d.Char("CHAR32"),
        "flag": d.Boolean(),
        "name": NAME,
        "colour": COLOUR,
        "rough": FLOAT,
        "octet": UBYTE,
    },
)
SINGLE = d.Structure("single", {"only": LONGLONG})

_SHAPES = d.Enumeration(
    "shape_kind", "ULONG", {"nothing": 0, "number": 1, "text": 5, "ratio": 9, "other": 10, "more": 4}
)
SHAPE = d.Union(
    "shape",
    _SHAPES,
    (
        d.UnionCase("count", LONG, ("number",)),
        d.UnionCase("label", NAME, ("text",)),
        d.UnionCase("rate", DOUBLE, ("ratio",)),
        d.UnionCase("rest", d.Integer("LONGLONG"), ("other", "more"), default=True),
    ),
)
SIDES = d.Union("sides", COLOUR, tuple(d.UnionCase(f"when_{name}", ULONG, (name,)) for name in COLOUR.values))
ALL_DEFAULT = d.Union("all_default", COLOUR, (d.UnionCase("any", FLOAT, ("red",), default=True),))

LINE = d.Structure("line", {"start": POINT, "stop": POINT, "marks": d.Sequence(LONG, 4)})
FIGURE = d.Union(
    "figure",
    COLOUR,
    (
        d.UnionCase("dot", POINT, ("red",)),
        d.UnionCase("path", d.Sequence(POINT, 3), ("green",)),
        d.UnionCase("frame", d.Array(SHAPE, (2,)), ("blue",), default=True),
    ),
)
TABLE = d.Array(d.Structure("cell", {"title": NAME, "entries": d.Sequence(ULONG, 3)}), (2, 2))
LISTS = d.Sequence(d.Sequence(LONG, 3))
_LEVEL_4 = d.Array(d.Structure("level_5", {"texts": d.Sequence(NAME, 2)}), (2,))
DEEP = d.Structure(
    "level_1",
    {
        "name": NAME,
        "below": d.Sequence(
            d.Union(
                "level_3",
                COLOUR,
                (
                    d.UnionCase("here", ULONG, ("red",)),
                    d.UnionCase("deeper", _LEVEL_4, ("blue",), default=True),
                ),
            ),
            3,
        ),
    },
)


@dataclass(frozen=True)
class TypesUnderTest:
    """Types of one sort: their requirement, and a name for each."""

    sort: str
    requirement: str
    types: dict[str, d.AnyType]


CATALOGUE = (
    TypesUnderTest("integers", "R-10.1.1-07", {kind.lower(): d.Integer(kind) for kind in KINDS}),
    TypesUnderTest("floating-point numbers", "R-10.1.1-08", {"float": FLOAT, "double": DOUBLE}),
    TypesUnderTest("characters", "R-10.1.1-09", {"char8": d.Char("CHAR8"), "char32": d.Char("CHAR32")}),
    TypesUnderTest("booleans", "R-10.1.1-10", {"boolean": d.Boolean()}),
    TypesUnderTest(
        "strings",
        "R-10.1.1-11",
        {
            "narrow": d.String("CHAR8"),
            "wide": d.String("CHAR32"),
            "narrow up to 16": NAME,
            "wide up to 16": d.String("CHAR32", 16),
            "single": d.String("CHAR8", 1),
        },
    ),
    TypesUnderTest(
        "enumerations",
        "R-10.1.1-12",
        {e.name: e for e in (COLOUR, WITH_GAPS, NEGATIVE, DISORDERED, LONELY, SHORTER, LONGER, LONGEST)},
    ),
    TypesUnderTest("structures", "R-10.1.1-13", {s.name: s for s in (POINT, MIXED, SINGLE)}),
    TypesUnderTest("unions", "R-10.1.1-14", {u.name: u for u in (SHAPE, SIDES, ALL_DEFAULT)}),
    TypesUnderTest(
        "arrays",
        "R-10.1.1-15",
        {
            "row": d.Array(LONG, (5,)),
            "matrix": d.Array(SHORT, (2, 3)),
            "square": d.Array(ULONG, (3, 3)),
            "cube": d.Array(UBYTE, (2, 3, 2)),
            "names": d.Array(NAME, (3,)),
            "numbers": d.Array(DOUBLE, (2, 2)),
        },
    ),
    TypesUnderTest(
        "sequences",
        "R-10.1.1-16",
        {
            "up to 5": d.Sequence(LONG, 5),
            "unbounded": d.Sequence(ULONG),
            "names": d.Sequence(NAME, 3),
            "numbers": d.Sequence(DOUBLE, 4),
            "up to 1": d.Sequence(LONGLONG, 1),
            "flags": d.Sequence(d.Boolean(), 17),
            "measures": d.Sequence(DOUBLE, 25),
            "rough measures": d.Sequence(FLOAT, 25),
        },
    ),
    TypesUnderTest(
        "aliases",
        "R-10.1.1-17",
        {
            "number": d.Alias("number", ULONG),
            "number again": d.Alias("number_again", d.Alias("number", ULONG)),
            "title": d.Alias("title", NAME),
            "precise": d.Alias("precise", DOUBLE),
            "tint": d.Alias("tint", COLOUR),
            "place": d.Alias("place", POINT),
            "row": d.Alias("row", d.Array(LONG, (3,))),
            "list": d.Alias("list", d.Sequence(d.Alias("number", ULONG), 3)),
        },
    ),
    TypesUnderTest(
        "nested types",
        "R-10.1.1-18",
        {"line": LINE, "figure": FIGURE, "table": TABLE, "lists": LISTS, "deep": DEEP},
    ),
)
"""All types of 9.2 but native ones."""
