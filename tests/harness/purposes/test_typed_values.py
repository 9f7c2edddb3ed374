"""Drawn values belong to their type and the vendor's readings; a changed value is found and its type is named."""

from __future__ import annotations

import math
import struct
from collections.abc import Iterator
from typing import get_args

import msgspec
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from ucm_cts.adapters.contract.data_types import (
    Alias,
    AnyType,
    Array,
    Boolean,
    Char,
    Datum,
    Enumeration,
    Float,
    Integer,
    IntegerKind,
    Sequence,
    String,
    Structure,
    Union,
    UnionCase,
    integer_range,
)
from ucm_cts.adapters.contract.data_values import SCALARS, misfit, parts, read_spelled, spell
from ucm_cts.adapters.mutants.python.altering import rebuilt
from ucm_cts.harness.purposes.data.catalogue import load_types
from ucm_cts.harness.purposes.data.corner_values import LONG_SEQUENCE, LONG_STRING, LONGEST_STRING, UNDECLARED, corners
from ucm_cts.harness.purposes.data.typed_values import draw, values
from ucm_cts.reference_models.model.value_transport import (
    Evidence,
    Part,
    differences,
    distance,
    requirement_of,
    requirements_of,
)

TYPES = {f"{sort.sort}: {name}": of for sort in load_types() for name, of in sort.types.items()}
KINDS: tuple[IntegerKind, ...] = get_args(IntegerKind)
LONG, NAME = Integer("LONG"), String("CHAR8", 16)
COLOUR = Enumeration("colour", "ULONG", {"red": 0, "green": 1, "blue": 2})
POINT = Structure("point", {"x": LONG, "y": LONG, "z": LONG})
EVERY_TYPE = pytest.mark.parametrize("of", TYPES.values(), ids=TYPES.keys())
NARROW = {"byte": "unsigned", "bounded-sequence": "full-only", "char32": "bmp", "char8": "byte"}

scalars = st.one_of(
    st.sampled_from([Integer(kind) for kind in KINDS]),
    st.sampled_from([Float("FLOAT"), Float("DOUBLE"), Char("CHAR8"), Char("CHAR32"), Boolean(), COLOUR]),
    st.builds(String, st.sampled_from(["CHAR8", "CHAR32"]), st.integers(-1, 5)),
)


def containers(inner: st.SearchStrategy[AnyType]) -> st.SearchStrategy[AnyType]:
    def union(types: list[AnyType]) -> Union:
        names = list(COLOUR.values)
        cases = [UnionCase(name, of, (name,)) for name, of in zip(names, types, strict=False)]
        return Union("u", COLOUR, (*cases[:-1], msgspec.structs.replace(cases[-1], default=True)))

    return st.one_of(
        st.lists(inner, min_size=1, max_size=3).map(
            lambda types: Structure("s", {f"f{i}": of for i, of in enumerate(types)})
        ),
        st.lists(inner, min_size=1, max_size=3).map(union),
        st.builds(Array, inner, st.lists(st.integers(1, 3), min_size=1, max_size=3).map(tuple)),
        st.builds(Sequence, inner, st.integers(-1, 3)),
        st.builds(Alias, st.just("a"), inner),
    )


types = st.recursive(scalars, containers, max_leaves=5)


@given(st.data(), types)
@settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.too_slow])
def test_values_of_any_type_fit_it_and_arrive_as_they_are(data: st.DataObject, of: AnyType) -> None:
    value = data.draw(values(of))
    assert misfit(of, value) == ""
    travelled = msgspec.json.decode(msgspec.json.encode(value), type=Datum)
    assert list(differences(Part(of, value), travelled)) == []
    assert read_spelled(spell(value)) == value
    assert all(misfit(part, one) == "" for part, one in parts(of, value))
    assert distance(value, travelled) == 0
    assert list(differences(Part(of, value), [value, None]))


@EVERY_TYPE
def test_corners_and_drawn_values_fit_their_type(of: AnyType) -> None:
    found = corners(of)
    assert len({msgspec.json.encode(value) for value in found}) == len(found)
    for value in found + draw(of, 40, "any seed"):
        assert misfit(of, value) == ""
    assert draw(of, 5, "one") == draw(of, 5, "one")
    assert len(found) < 3 or draw(of, 20, "one") != draw(of, 20, "two")


@EVERY_TYPE
def test_readings_limit_drawn_values(of: AnyType) -> None:
    for value in corners(of, NARROW) + draw(of, 40, "any seed", NARROW):
        assert misfit(of, value) == ""
        for part, one in parts(of, value):
            assert is_within_readings(part, one), (part, one)


def is_within_readings(of: AnyType, value: Datum) -> bool:
    match of, value:
        case Integer("BYTE"), int(number):
            return number >= 0
        case Char("CHAR32"), int(point):
            return point <= 0xFFFF
        case String("CHAR32"), str(text):
            return all(ord(c) <= 0xFFFF for c in text)
        case Sequence(), list(elements):
            return of.size < 0 or len(elements) == of.size
    return True


def test_byte_wide_characters_are_drawn_where_declared() -> None:
    drawn = draw(Char("CHAR8"), 300, "seed", NARROW)
    assert max(drawn) > 127
    assert max(draw(Char("CHAR8"), 300, "seed")) <= 127  # type: ignore[type-var]


def test_corners_are_where_values_are_lost() -> None:
    for kind in KINDS:
        low, high = integer_range(kind)
        assert {low, high} <= set(corners(Integer(kind)))  # type: ignore[arg-type]
    assert 2**63 in corners(Integer("ULONGLONG"))
    for float_kind, layout in (("FLOAT", ">f"), ("DOUBLE", ">d")):
        found = [struct.unpack(layout, bytes.fromhex(str(v)))[0] for v in corners(Float(float_kind))]  # type: ignore[arg-type]
        assert {math.inf, -math.inf, 0.0, 1.0} <= set(found)
        assert [str(f) for f in found].count("-0.0") == 1
        assert sum(map(math.isnan, found)) >= 4
        assert any(0 < abs(f) < (2**-126 if float_kind == "FLOAT" else 2**-1022) for f in found)
    assert max(corners(Char("CHAR32"))) == 0x10FFFF  # type: ignore[type-var]
    assert {len(str(text)) for text in corners(String("CHAR8"))} >= {0, 1, LONG_STRING, LONGEST_STRING}
    assert {len(str(text)) for text in corners(NAME)} >= {0, 1, 16}
    assert {len(v) for v in corners(Sequence(LONG, 5))} == {0, 1, 2, 4, 5}  # type: ignore[arg-type]
    assert {256, LONG_SEQUENCE} <= {len(v) for v in corners(Sequence(LONG))}  # type: ignore[arg-type]


WRONG = {
    "too great": (Integer("UBYTE"), 256),
    "too small": (Integer("ULONG"), -1),
    "no integer": (LONG, True),
    "no boolean": (Boolean(), 1),
    "a surrogate": (Char("CHAR32"), 0xD800),
    "beyond Unicode": (Char("CHAR32"), 0x110000),
    "too wide": (Char("CHAR8"), 256),
    "NUL in a string": (String("CHAR8"), "a\0"),
    "too long": (NAME, "x" * 17),
    "too few digits": (Float("DOUBLE"), "7f800000"),
    "capital digits": (Float("FLOAT"), "7F800000"),
    "a signalling NaN": (Float("FLOAT"), "7f800001"),
    "no enumerator": (COLOUR, "yellow"),
    "too few fields": (POINT, [1, 2]),
    "a wrong field": (POINT, [1, 2, "3"]),
    "no case": (Union("u", COLOUR, (UnionCase("c", LONG, ("red",)),)), ["blue", 1]),
    "another case": (Union("u", COLOUR, (UnionCase("c", LONG, ("red",)),)), ["red", "1"]),
    "another shape": (Array(LONG, (2, 2)), [[1, 2, 3, 4]]),
    "too many elements": (Sequence(LONG, 1), [1, 2]),
    "a wrong element": (Alias("a", Sequence(NAME)), ["a", 1]),
}


@pytest.mark.parametrize(("of", "value"), WRONG.values(), ids=WRONG.keys())
def test_wrong_values_of_a_type_are_reported(of: AnyType, value: object) -> None:
    assert misfit(of, value)


def blame(of: AnyType, sent: Datum, got: object, *carried_well: tuple[AnyType, Datum]) -> list[str]:
    evidence = Evidence()
    for one in carried_well:
        evidence.add(*one)
    return [evidence.broken_by(d.part) for d in differences(Part(of, sent), got)]


def test_the_innermost_type_that_differs_is_found() -> None:
    line = Structure("line", {"ends": Array(POINT, (2,)), "name": NAME})
    sent: Datum = [[[1, 2, 3], [4, 5, 6]], "n"]
    assert blame(line, sent, [[[1, 2, 3], [4, 5, 7]], "n"]) == ["R-10.1.1-07"]
    assert blame(line, sent, [[[1, 2, 3], [4, 6, 5]], "n"]) == ["R-10.1.1-13"]
    assert blame(line, sent, [[[4, 5, 6], [1, 2, 3]], "n"]) == ["R-10.1.1-15"]
    assert blame(line, sent, [[[6, 5, 4], [3, 2, 1]], "n"]) == ["R-10.1.1-15"]
    assert blame(line, sent, [[[1, 2, 3]], "n"]) == ["R-10.1.1-15"]
    assert blame(line, sent, ["n", [[1, 2, 3], [4, 5, 6]]]) == ["R-10.1.1-13"]
    assert blame(Sequence(NAME), ["a", "b"], ["a"]) == ["R-10.1.1-16"]
    assert blame(Boolean(), True, 1) == ["R-10.1.1-10"]
    assert blame(COLOUR, "red", "blue") == ["R-10.1.1-12"]


def test_the_enclosing_type_is_found_where_its_value_alone_is_carried_well() -> None:
    points = Sequence(POINT)
    well: tuple[AnyType, Datum] = (LONG, 9)
    assert blame(POINT, [1, 2, 9], [1, 2, 0], well) == ["R-10.1.1-13"]
    assert blame(points, [[1, 2, 9]], [[1, 2, 0]], well) == ["R-10.1.1-13"]
    assert blame(points, [[1, 2, 9]], [[1, 2, 0]], well, (POINT, [1, 2, 9])) == ["R-10.1.1-18"]
    assert blame(Alias("number", LONG), 9, 0, well) == ["R-10.1.1-17"]
    assert blame(Alias("number", LONG), 9, 0, (LONG, 8)) == ["R-10.1.1-07"]


def test_the_case_of_a_union_is_distinguished_from_its_value() -> None:
    union = Union("u", COLOUR, (UnionCase("n", LONG, ("red",)), UnionCase("t", NAME, ("green", "blue"), default=True)))
    assert blame(union, ["red", 1], ["red", 2]) == ["R-10.1.1-07"]
    assert blame(union, ["red", 1], ["red", "text"]) == ["R-10.1.1-14"]
    assert blame(union, ["green", "a"], ["blue", "a"]) == ["R-10.1.1-14"]


def test_values_exercise_their_parts() -> None:
    assert requirements_of(POINT, [1, 2, 3]) == {"R-10.1.1-13", "R-10.1.1-07"}
    assert requirements_of(Sequence(POINT), []) == {"R-10.1.1-16"}
    assert requirements_of(Sequence(POINT), [[1, 2, 3]]) == {"R-10.1.1-16", "R-10.1.1-18", "R-10.1.1-13", "R-10.1.1-07"}
    for sort in load_types():
        for of in sort.types.values():
            assert any(sort.requirement in requirements_of(of, value) for value in corners(of))


def altered_everywhere(of: AnyType, value: Datum) -> Iterator[tuple[AnyType, Datum]]:
    """``value`` with one scalar in it changed, for each of them."""
    places = sum(isinstance(part, SCALARS) for part, _ in parts(of, value))
    for wanted in range(places):
        met = -1
        changed: AnyType | None = None

        def change(part: AnyType, one: Datum, wanted: int = wanted) -> Datum:
            nonlocal met, changed
            met += isinstance(part, SCALARS)
            if met != wanted or not isinstance(part, SCALARS):
                return one
            others = [other for other in corners(part) if other != one]
            changed = part if others else changed
            return others[0] if others else one

        rebuilt_value = rebuilt(of, value, change)
        if changed is not None:
            yield changed, rebuilt_value


@EVERY_TYPE
def test_each_changed_place_is_found(of: AnyType) -> None:
    for value in corners(of)[:4]:
        for part, changed in altered_everywhere(of, value):
            (found, *_) = differences(Part(of, value), changed)
            innermost = requirement_of(part, is_innermost=True)
            around = {requirement_of(one.of, is_innermost=True) for one in found.part.around}
            assert requirement_of(found.part.of, is_innermost=True) in {innermost, *around}


def test_undeclared_readings_are_the_first_ones() -> None:
    assert corners(Integer("BYTE"), UNDECLARED) == corners(Integer("BYTE"), {"byte": "signed"})
    assert min(corners(Integer("BYTE"), {"byte": "unsigned"})) == 0  # type: ignore[type-var]


def test_enumerations_of_the_catalogue_have_indices_of_their_kind() -> None:
    for of in TYPES.values():
        if isinstance(of, Enumeration):
            low, high = integer_range(of.index)
            assert all(low <= index <= high for index in of.values.values())
