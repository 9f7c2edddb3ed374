"""Values in the syntax of IDL constants, as the reference tool chain reads them."""

from __future__ import annotations

import contextlib

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ucm_cts.adapters.contract.metamodel.contracts import INTEGER_RANGES
from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.contract.metamodel.names import Names, Scope
from ucm_cts.adapters.contract.metamodel.reading import read_model
from ucm_cts.adapters.reference.toolchain.rules.contracts.constant_syntax import LONGEST, NotAConstant, parsed
from ucm_cts.adapters.reference.toolchain.rules.contracts.constant_values import NoValueOfType, fit

TYPES = """
<ContractModule name="m">
  <PrimitiveInteger name="octet_t" kind="UBYTE"/>
  <PrimitiveInteger name="long_t" kind="LONG"/>
  <PrimitiveFloat name="float_t" kind="FLOAT"/>
  <PrimitiveBoolean name="truth_t"/>
  <PrimitiveChar name="char_t" kind="CHAR8"/>
  <StringType name="five_t" charBase="CHAR8" maxSize="5"/>
  <StringType name="text_t" charBase="CHAR32" maxSize="-1"/>
  <Enumeration name="colour_t" indexType="BYTE"><Enumerator name="red" value="0"/><Enumerator name="light-red" value="1"/></Enumeration>
  <Structure name="open_t"><StructureField name="f" type="long_t"/></Structure>
  <Constant name="seven" type="octet_t" value="7"/>
  <Constant name="chosen" type="colour_t" value="red"/>
  <Constant name="half" type="float_t" value="0.5"/>
  <Constant name="yes" type="truth_t" value="TRUE"/>
  <Constant name="here" type="long_t" value="there"/>
  <Constant name="there" type="long_t" value="here"/>
  <Constant name="broken" type="long_t" value="1 +"/>
  {more}
</ContractModule>
"""


def scope(more: str = "") -> Scope:
    model: Model = read_model(TYPES.replace("{more}", more).encode(), "model").model
    return Names(model).inside(model.modules[0])


HERE = scope()


@pytest.mark.parametrize(
    ("type_", "values"),
    [
        (
            "octet_t",
            [
                "0",
                "255",
                "0xff",
                "0377",
                "-0",
                "seven",
                "::m::seven",
                "seven * (seven - 5)",
                "~-256",
                "1 << 7",
                "seven-6",
            ],
        ),
        ("long_t", ["-2147483648", "-7 / 2 + 3", "-7 % 2 + 1", "6 ^ 3", "6 | 1 & 3", " 12 ", "+5", "--5"]),
        ("float_t", ["1.5", "1e3", ".5", "5.", "-1.5E-3", "7", "half * 3.0", "1.0 / 4.0", "1 + half"]),
        ("truth_t", ["TRUE", "FALSE", "yes"]),
        ("char_t", ["'a'", r"'\n'", r"'\''", r"'\x41'", r"'\101'", "L'a'"]),
        ("five_t", ['""', '"hello"', '"he" "llo"', r'"hi \"x"', r'"\x41bcde"']),
        ("text_t", ['"a string as long as one likes"', 'L"wide"']),
        ("colour_t", ["red", "light-red", "chosen"]),
        ("open_t", ["anything", "{1, 2}", ""]),
        ("nothing_t", ["anything"]),
    ],
)
def test_values_of_types(type_: str, values: list[str]) -> None:
    for value in values:
        fit(value, type_, HERE)


@pytest.mark.parametrize(
    ("type_", "values"),
    [
        ("octet_t", ["-1", "256", "0x100", "0400", "1.5", "TRUE", "'a'", '"1"', "half", "yes", "nowhere", "red"]),
        (
            "octet_t",
            ["1 << 64", "1 << -1", "1 / 0", "1 % 0", "1.5 % 2", "TRUE + 1", "~1.5", "here", "broken", "255 + 1"],
        ),
        ("float_t", ["TRUE", "'1'", "1.0 / 0.0", "1e308 * 1e308 + TRUE", "nowhere", "1.5 | 2"]),
        ("truth_t", ["1", "0.0", "true", "seven", "'T'"]),
        ("char_t", ['"a"', "7", "a"]),
        ("five_t", ['"hello!"', "'a'", "hello", '"hel" "lo!"']),
        ("colour_t", ["blue", "0", '"red"', "seven", "red + 1"]),
    ],
)
def test_values_that_types_do_not_have(type_: str, values: list[str]) -> None:
    for value in values:
        with pytest.raises(NoValueOfType):
            fit(value, type_, HERE)


@pytest.mark.parametrize(
    "text",
    [
        "",
        " ",
        "1 2",
        "08",
        "0x",
        "0xG",
        "1.5.2",
        "1,5",
        "1e",
        "1.5d",
        "(1",
        "1)",
        "1 +",
        "* 1",
        "'ab'",
        "''",
        '"',
        "a b",
        "#",
        "1_0",
    ],
)
def test_values_that_are_no_idl(text: str) -> None:
    with pytest.raises(NotAConstant):
        parsed(text)


def test_products_bind_more_than_sums_and_shifts() -> None:
    fit("1 + 2 * 127", "octet_t", HERE)
    fit("1 << 2 + 5", "octet_t", HERE)
    with pytest.raises(NoValueOfType):
        fit("(1 + 2) * 127", "octet_t", HERE)


def test_constants_that_grow_or_circle_come_to_an_end() -> None:
    doubled = '<Constant name="c0" type="long_t" value="2"/>' + "".join(
        f'<Constant name="c{n}" type="long_t" value="c{n - 1} {sign} c{n - 1}"/>' for n, sign in enumerate("*+" * 40, 1)
    )
    with pytest.raises(NoValueOfType):
        fit("c80", "long_t", scope(doubled))
    for text in ("(" * 400 + "1" + ")" * 400, "-" * 900 + "1", "1" * (LONGEST + 1)):
        with pytest.raises(NotAConstant):
            fit(text, "long_t", HERE)
    with pytest.raises(NoValueOfType):
        fit("+".join("1" * 400), "long_t", HERE)


def test_strings_have_any_length() -> None:
    assert parsed(f'"{"a" * 100_000}"') == ("a" * 100_000, True)
    with pytest.raises(NotAConstant):
        parsed(f'"{"a" * 100_000}" {"+ 1" * LONGEST}')


@given(st.sampled_from(sorted(INTEGER_RANGES)), st.data())
@settings(max_examples=60, deadline=None)
def test_integers_fit_exactly_within_their_range(kind: str, data: st.DataObject) -> None:
    least, most = INTEGER_RANGES[kind]
    number = data.draw(st.integers(least - 3, least + 3) | st.integers(most - 3, most + 3) | st.integers(least, most))
    written = data.draw(st.sampled_from([str(number), f"{'-' * (number < 0)}0x{abs(number):x}", f"({number})"]))
    here = scope(f'<PrimitiveInteger name="drawn_t" kind="{kind}"/>')
    if least <= number <= most:
        fit(written, "drawn_t", here)
    else:
        with pytest.raises(NoValueOfType):
            fit(written, "drawn_t", here)


@given(st.text(alphabet="01279aexXTRUE.+-*/%()<>&|^~'\"\\ :_L", max_size=30))
@settings(max_examples=300, deadline=None)
def test_any_text_is_a_value_or_is_refused(text: str) -> None:
    for type_ in ("long_t", "float_t", "five_t", "colour_t"):
        with contextlib.suppress(NotAConstant, NoValueOfType):
            fit(text, type_, HERE)
