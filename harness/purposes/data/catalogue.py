"""The types that are carried to check clause 10.1.1, by the requirement that each is to exercise."""

from __future__ import annotations

from dataclasses import dataclass

from ucm_cts.adapters.contract.data_types import (
    Alias,
    AnyType,
    Array,
    Boolean,
    Char,
    Enumeration,
    Float,
    Integer,
    IntegerKind,
    Sequence,
    String,
    Structure,
    Union,
    UnionCase,
)

KINDS: tuple[IntegerKind, ...] = ("BYTE", "SHORT", "LONG", "LONGLONG", "UBYTE", "USHORT", "ULONG", "ULONGLONG")

LONG, ULONG = Integer("LONG"), Integer("ULONG")
SHORT, UBYTE = Integer("SHORT"), Integer("UBYTE")
LONGLONG, ULONGLONG = Integer("LONGLONG"), Integer("ULONGLONG")
FLOAT, DOUBLE = Float("FLOAT"), Float("DOUBLE")
NAME = String("CHAR8", 16)

COLOUR = Enumeration("colour", "ULONG", {"red": 0, "green": 1, "blue": 2})
WITH_GAPS = Enumeration("with_gaps", "LONG", {"none": 0, "few": 10, "many": 11, "all": 2**31 - 1})
NEGATIVE = Enumeration("negative", "BYTE", {"lowest": -128, "below": -1, "zero": 0, "above": 1, "highest": 127})
DISORDERED = Enumeration("disordered", "USHORT", {"third": 3, "first": 1, "last": 65535, "second": 2})
LONELY = Enumeration("lonely", "UBYTE", {"only": 7})
SHORTER = Enumeration("shorter", "SHORT", {"least": -(2**15), "middle": 0, "most": 2**15 - 1})
LONGER = Enumeration("longer", "LONGLONG", {"least": -(2**31), "middle": 0, "most": 2**31 - 1})
LONGEST = Enumeration("longest", "ULONGLONG", {"none": 0, "some": 77, "most": 2**31 - 1})

POINT = Structure("point", {"x": LONG, "y": LONG, "z": LONG})
MIXED = Structure(
    "mixed",
    {
        "small": SHORT,
        "great": ULONGLONG,
        "precise": DOUBLE,
        "letter": Char("CHAR32"),
        "flag": Boolean(),
        "name": NAME,
        "colour": COLOUR,
        "rough": FLOAT,
        "octet": UBYTE,
    },
)
SINGLE = Structure("single", {"only": LONGLONG})

_SHAPES = Enumeration("shape_kind", "ULONG", {"nothing": 0, "number": 1, "text": 5, "ratio": 9, "other": 10, "more": 4})
SHAPE = Union(
    "shape",
    _SHAPES,
    (
        UnionCase("count", LONG, ("number",)),
        UnionCase("label", NAME, ("text",)),
        UnionCase("rate", DOUBLE, ("ratio",)),
        UnionCase("rest", Integer("LONGLONG"), ("other", "more"), default=True),
    ),
)
SIDES = Union("sides", COLOUR, tuple(UnionCase(f"when_{name}", ULONG, (name,)) for name in COLOUR.values))
ALL_DEFAULT = Union("all_default", COLOUR, (UnionCase("any", FLOAT, ("red",), default=True),))

LINE = Structure("line", {"start": POINT, "stop": POINT, "marks": Sequence(LONG, 4)})
FIGURE = Union(
    "figure",
    COLOUR,
    (
        UnionCase("dot", POINT, ("red",)),
        UnionCase("path", Sequence(POINT, 3), ("green",)),
        UnionCase("frame", Array(SHAPE, (2,)), ("blue",), default=True),
    ),
)
TABLE = Array(Structure("cell", {"title": NAME, "entries": Sequence(ULONG, 3)}), (2, 2))
LISTS = Sequence(Sequence(LONG, 3))
_LEVEL_4 = Array(Structure("level_5", {"texts": Sequence(NAME, 2)}), (2,))
DEEP = Structure(
    "level_1",
    {
        "name": NAME,
        "below": Sequence(
            Union(
                "level_3",
                COLOUR,
                (
                    UnionCase("here", ULONG, ("red",)),
                    UnionCase("deeper", _LEVEL_4, ("blue",), default=True),
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
    types: dict[str, AnyType]


CATALOGUE = (
    TypesUnderTest("integers", "R-10.1.1-07", {kind.lower(): Integer(kind) for kind in KINDS}),
    TypesUnderTest("floating-point numbers", "R-10.1.1-08", {"float": FLOAT, "double": DOUBLE}),
    TypesUnderTest("characters", "R-10.1.1-09", {"char8": Char("CHAR8"), "char32": Char("CHAR32")}),
    TypesUnderTest("booleans", "R-10.1.1-10", {"boolean": Boolean()}),
    TypesUnderTest(
        "strings",
        "R-10.1.1-11",
        {
            "narrow": String("CHAR8"),
            "wide": String("CHAR32"),
            "narrow up to 16": NAME,
            "wide up to 16": String("CHAR32", 16),
            "single": String("CHAR8", 1),
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
            "row": Array(LONG, (5,)),
            "matrix": Array(SHORT, (2, 3)),
            "square": Array(ULONG, (3, 3)),
            "cube": Array(UBYTE, (2, 3, 2)),
            "names": Array(NAME, (3,)),
            "numbers": Array(DOUBLE, (2, 2)),
        },
    ),
    TypesUnderTest(
        "sequences",
        "R-10.1.1-16",
        {
            "up to 5": Sequence(LONG, 5),
            "unbounded": Sequence(ULONG),
            "names": Sequence(NAME, 3),
            "numbers": Sequence(DOUBLE, 4),
            "up to 1": Sequence(LONGLONG, 1),
            "flags": Sequence(Boolean(), 17),
            "measures": Sequence(DOUBLE, 25),
            "rough measures": Sequence(FLOAT, 25),
        },
    ),
    TypesUnderTest(
        "aliases",
        "R-10.1.1-17",
        {
            "number": Alias("number", ULONG),
            "number again": Alias("number_again", Alias("number", ULONG)),
            "title": Alias("title", NAME),
            "precise": Alias("precise", DOUBLE),
            "tint": Alias("tint", COLOUR),
            "place": Alias("place", POINT),
            "row": Alias("row", Array(LONG, (3,))),
            "list": Alias("list", Sequence(Alias("number", ULONG), 3)),
        },
    ),
    TypesUnderTest(
        "nested types",
        "R-10.1.1-18",
        {"line": LINE, "figure": FIGURE, "table": TABLE, "lists": LISTS, "deep": DEEP},
    ),
)
"""All types of 9.2 but native ones."""
