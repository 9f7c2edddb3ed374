"""The worked example of clause 12 by hand is conformant, and each difference names requirement, element and places."""

from __future__ import annotations

import re

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mapping_subjects import TELLER, TELLER_IDL, model_of

from ucm_cts.adapters.contract.metamodel.reading import read_model
from ucm_cts.adapters.reference.toolchain.program import reference
from ucm_cts.harness.results.values import Processed
from ucm_cts.harness.selftest.toolchains import declaring
from ucm_cts.harness.toolchains.commands.processing import Response
from ucm_cts.harness.toolchains.differences import Difference
from ucm_cts.harness.toolchains.examinations import examination_for
from ucm_cts.harness.toolchains.generation import mapping_models
from ucm_cts.harness.toolchains.idl.comparing import CHECKS, compare
from ucm_cts.harness.toolchains.idl.language.problems import Problem
from ucm_cts.harness.toolchains.idl.language.scopes import Scope
from ucm_cts.harness.toolchains.idl.language.values import worth as value_of
from ucm_cts.harness.toolchains.idl.omniidl import Opinion, opinion
from ucm_cts.harness.toolchains.idl.standard import printed
from ucm_cts.harness.toolchains.renaming import Renaming
from ucm_cts.reference_models.mapping.idl.declarations import Literal
from ucm_cts.reference_models.mapping.idl.expectations import RULE_OF, STANDS_FOR, Declares, Getter, Templated
from ucm_cts.reference_models.mapping.idl.mapping import expected_idl

EXPECTED = expected_idl(model_of(TELLER))


def differences(text: str, *readings: str) -> list[Difference]:
    declared = {option: value for option, _, value in (reading.partition("=") for reading in readings)}
    return list(compare(EXPECTED, {"bank.idl": text}, declared).differences)


def edited(old: str, new: str) -> str:
    assert TELLER_IDL.count(old) == 1, old
    return TELLER_IDL.replace(old, new)


def test_checks_are_those_that_requirements_name() -> None:
    assert CHECKS.keys() == STANDS_FOR.keys()
    assert {fact.rule for fact in EXPECTED.facts} <= CHECKS.keys()


def test_the_printed_example_is_expected() -> None:
    declared = {fact.path for fact in EXPECTED.facts if isinstance(fact, Declares) and fact.needed}
    assert ("bank", "desk", "TellerComponentImpl_Body") in declared
    assert ("bank_platform", "services") not in declared, "nothing in it can be written"
    getters = {fact.names[0] for fact in EXPECTED.facts if isinstance(fact, Getter)}
    assert getters == {"get_teller_api", "get_tp_ExecPolicy_self-execution_api"}
    templates = {
        fact.path[-1]: fact.required for fact in EXPECTED.facts if isinstance(fact, Templated) and fact.required
    }
    intf = ("bank_platform", "services", "contracts", "service_intf_t")
    message = ("bank_platform", "services", "data", "message_type_t")
    assert templates == {"services": (intf,), "contracts": (intf,), "data": (message,)} or templates["services"] == ()


def test_the_example_by_hand_is_conformant() -> None:
    comparison = compare(EXPECTED, {"bank.idl": TELLER_IDL})
    assert not comparison.differences
    for requirement in ("R-12.7-08", "R-12.7-12", "R-12.8.2-03", "R-12.8.4-02", "R-12.8.4-07", "R-12.8.5-03"):
        assert comparison.exercised[requirement] >= 1
    assert comparison.readings["idl-template-names"] == {"upper"}


EDITS = [
    ("readonly attribute", "attribute", "R-12.8.1-04", "::bank::desk::TellerComponent.id"),
    ("get_teller_api()", "get_teller_api(in long x)", "R-12.8.4-05", "::bank::desk::TellerComponent.teller"),
    ("types::HelloInterface get", "PortElementObject get", "R-12.8.4-06", "::bank::desk::TellerComponent.teller"),
    ("interface PrinterComponent { }", "interface PrinterComponent { PortElementObject get_printer_api(); }",
     "R-12.8.4-07", "::bank::desk::PrinterComponent.printer"),
    ("interface PrinterComponent { }", "interface PrinterComponent { PortElementObject get_asked_client(); }",
     "R-12.8.4-02", "::bank::desk::PrinterComponent.asked"),
    ("get_tp_TellerExecPolicy_", "get_tp_", "R-12.8.5-02", "::bank::desk::TellerComponentImpl.ExecPolicy"),
    ("HelloInterface : PortElementObject", "HelloInterface", "R-12.8.3-02", "::bank::types::HelloInterface"),
    ("trace_intf : PortElementObject", "trace_intf", "R-12.8.3-02", "::bank_platform::policy_mod::api::trace_intf"),
    ("PrinterComponent, ComponentObject", "PrinterComponent", "R-12.8.2-03", "::bank::desk::PrinterComponentImpl"),
    ("<typename MESSAGE_TYPE_T>", "<interface MESSAGE_TYPE_T>", "R-12.7-11", "::bank_platform::services::data"),
    ("module services<interface SERVICE_INTF_T>", "module services", "R-12.7-12", "::bank_platform::services"),
    ("typedef short", "typedef long", "R-12.3.1-02", "::bank::types::id_t"),
]  # fmt: skip


@pytest.mark.parametrize(("old", "new", "requirement", "element"), EDITS, ids=[e[2] for e in EDITS])
def test_an_edit_is_reported_with_requirement_element_and_places(
    old: str, new: str, requirement: str, element: str
) -> None:
    (difference,) = differences(edited(old, new))
    assert (difference.requirement, difference.rule) == (requirement, RULE_OF[requirement])
    assert difference.element == element
    name = element.rpartition("::")[2].rpartition(".")[2]
    assert f'name="{name}"' in TELLER.splitlines()[difference.line_in_model - 1]
    around = TELLER_IDL[: TELLER_IDL.index(old)].count("\n") + 1
    assert difference.file == "bank.idl"
    assert around - 1 <= difference.line <= around + 1
    assert f"[{requirement}]" in str(difference)


@pytest.mark.parametrize(
    ("reading", "failed"),
    [
        ("idl-policy-getters=component-and-instance", False),
        ("idl-policy-getters=instance", True),
        ("idl-policy-getters=definition", True),
        ("idl-template-names=upper", False),
        ("idl-template-names=first", True),
        ("idl-template-propagation=direct", False),
        ("idl-template-propagation=containment", True),
        ("index-annotations=always", False),
    ],
)
def test_declared_readings_are_binding(reading: str, failed: bool) -> None:
    assert bool(differences(TELLER_IDL, reading)) == failed


@pytest.mark.parametrize(
    ("type_", "reading", "failed"),
    [
        ("unsigned long", "observed", set()),
        ("unsigned long", "unsigned-long", set()),
        ("unsigned long", "unsigned-long-long", {"R-12.3.1-08"}),
        ("unsigned long long", "unsigned-long-long", set()),
        ("unsigned long long", "unsigned-long", {"R-12.3.1-08"}),
    ],
)
def test_constants_may_be_too_large_for_the_type_that_the_table_prints(
    type_: str, reading: str, failed: set[str]
) -> None:
    model = read_model(mapping_models()["large_constants"].encode(), "m.xml").model
    files = {n: re.sub("unsigned long long", type_, text) for n, text in reference().generators["idl"](model).items()}
    comparison = compare(expected_idl(model), files, {"idl-ulonglong": reading}, opinion)
    assert {one.requirement for one in comparison.differences} == failed


def test_omniidl_is_believed_of_other_literals() -> None:
    model = read_model(mapping_models()["large_constants"].encode(), "m.xml").model
    files = reference().generators["idl"](model)
    complaint = Opinion("refused", (Problem("model.idl", 1, 1, "Value too large for unsigned short"),))
    assert {d.requirement for d in compare(expected_idl(model), files, {}, lambda _: complaint).differences} == {
        "R-12.1-03"
    }
    too_large = Opinion("refused", (Problem("model.idl", 1, 1, "Integer literal is too large for unsigned long"),))
    assert compare(expected_idl(model), files, {}, lambda _: too_large).differences, (
        "no unsigned long stands for ULONGLONG"
    )


@pytest.mark.parametrize(
    ("profile", "name", "reading"),
    [
        ("idl", "large_constants", "idl-ulonglong=unsigned-long"),
        ("idl", "multiples", "idl-policy-getters=definition"),
        ("cpp11", "multiples", "cpp-get-tp-name=definition"),
    ],
)
def test_who_declares_a_reading_may_refuse_what_it_makes_impossible(profile: str, name: str, reading: str) -> None:
    def broken(*readings: str, model: str = name) -> bool:
        examination = examination_for(profile, declaring(readings), Renaming(), models=(model,))
        processed = Processed(model, profile, "", (), 1, "m.xml:1: error: impossible")
        refused = Response(processed, accepted=False)
        return any(fact.finding is not None for fact in examination.examine(model, refused))

    assert not broken(reading)
    assert broken()
    assert broken(reading, model="interfaces")


def test_a_missing_element_is_reported_once() -> None:
    (difference,) = differences(TELLER_IDL[: TELLER_IDL.index("module bank {")])
    assert (difference.requirement, difference.element) == ("R-12.7-06", "::bank")


def test_nothing_is_missed_in_files_that_cannot_be_read() -> None:
    (difference,) = differences(edited("typedef short id_t;", "typedef short id_t"))
    assert (difference.requirement, difference.file, difference.line) == ("R-12.1-03", "bank.idl", 16)


def test_no_files_are_no_idl_at_all() -> None:
    comparison = compare(EXPECTED, {})
    assert {d.requirement for d in comparison.differences} == {"R-12.7-06"}
    assert "R-12.1-03" not in comparison.exercised


def test_names_of_files_that_are_not_handed_over_are_believed() -> None:
    head = TELLER_IDL.index("module bank_platform")
    text = '#include "ucm/core.idl"\n' + TELLER_IDL[head:]
    assert differences(text) == []
    assert "R-12.1-03" in {d.requirement for d in differences(TELLER_IDL[head:])}


def test_names_that_differ_in_case_are_other_names() -> None:
    (difference,) = differences(TELLER_IDL.replace("PrinterComponent ", "printerComponent "))
    assert difference.requirement in ("R-12.8.1-01", "R-12.1-03")


def test_circles_of_names_end() -> None:
    text = (
        "typedef b a; typedef a b; interface i : j { }; interface j : i { a f(); }; const long c = d; const long d = c;"
    )
    template = "module t<typename T> { typedef T u; }; module t<x::u> x; module y::z<long> y; typedef y::u v;"
    reported = differences(TELLER_IDL + text + template)
    late = {d.observed.split("'")[1] for d in reported if "declared after it" in d.observed}
    assert late == {"b", "j"}, "in a circle something is used before it is declared"
    assert {d.observed.split("'")[1] for d in reported} - late == {"y::z", "y::u"}


def test_all_that_clause_12_prints_belongs_to_a_requirement() -> None:
    requirements = {requirement for requirement, _ in printed()}
    assert requirements == set(STANDS_FOR["idl_standard"])


CALLED_OTHERWISE = (
    ("typedef sequence<Property> Properties;", "typedef sequence<Property, 4> Properties;",
     "R-12.10-29", "typedef sequence<Property> Properties", "typedef sequence<Property, 4> Properties"),
    ("struct Property { string name; string value; };", "struct Property { string value; string name; };",
     "R-12.10-29", "struct Property { string name; string value; }", "struct Property { string value; string name; }"),
    ("exception NOT_FOUND { };", "exception NOT_FOUND { long why; };",
     "R-12.10-31", "exception NOT_FOUND { }", "exception NOT_FOUND { long why; }"),
    ("void on_connect(in string p, in PortElementObject r);", "void on_connect(in string p);",
     "R-12.10-36", "void on_connect(in string, in PortElementObject) in interface Connectable", "void on_connect(in string p)"),
    ("void on_disconnect(in string p); };", "void on_disconnect(in string p); void more(); };",
     "R-12.10-36", "no operation more in interface Connectable", "void more()"),
    ("interface Connectable {", "interface Connectable : PortElementObject {",
     "R-12.10-36", "interface Connectable without ancestors", "PortElementObject"),
)  # fmt: skip

PRINTED = """
struct Property { string name; string value; }; typedef sequence<Property> Properties; exception NOT_FOUND { };
interface Connectable { void on_connect(in string p, in PortElementObject r); void on_disconnect(in string p); };
"""


@pytest.mark.parametrize(
    ("old", "new", "requirement", "expected", "observed"), CALLED_OTHERWISE, ids=[row[4] for row in CALLED_OTHERWISE]
)
def test_differences_of_printed_declarations_are_shown_as_idl(
    old: str, new: str, requirement: str, expected: str, observed: str
) -> None:
    assert PRINTED.count(old) == 1
    assert differences(TELLER_IDL + PRINTED) == []
    (difference,) = differences(TELLER_IDL + PRINTED.replace(old, new))
    assert (difference.requirement, difference.expected, difference.observed) == (requirement, expected, observed)


CALLS = """<ContractModule name="m"><PrimitiveInteger name="t" kind="LONG"/><Interface name="i"><Method name="f">
<Parameter name="a" direction="IN" type="t"/><Parameter name="b" direction="IN" type="t"/></Method></Interface></ContractModule>"""


@pytest.mark.parametrize(
    ("taken", "reading", "broken"),
    [
        ("in t a, in t b", "kept", set()),
        ("in t x, in t y", "free", set()),
        ("in t x, in t y", "kept", {"R-12.6-05"}),
        ("in t b, in t a", "free", {"R-12.6-05"}),
        ("in t x, out t y", "free", {"R-12.6-05"}),
        ("in t x, in short y", "free", {"R-12.6-06"}),
        ("in t x", "free", {"R-12.6-05"}),
    ],
)
def test_names_of_parameters_count_only_if_the_vendor_says_so(taken: str, reading: str, broken: set[str]) -> None:
    text = f"module m {{ typedef long t; interface i {{ void f({taken}); }}; }};"
    reported = compare(expected_idl(model_of(CALLS)), {"m.idl": text}, {"idl-parameter-names": reading}).differences
    assert {one.requirement for one in reported} == broken


@pytest.mark.parametrize(
    ("written", "worth"),
    [
        (r"a\x41\101\u0041\n\?\"\\", 'aAAA\n?"\\'),
        (r"\N{DIGIT ONE}", None),
        (r"\xZZ", None),
        (r"\u", None),
        ("plain", "plain"),
    ],
)
def test_escape_sequences_are_those_of_idl(written: str, worth: str | None) -> None:
    assert value_of(Literal("text", written), Scope()) == worth


LINES = TELLER_IDL.splitlines(keepends=True)


@settings(max_examples=60, deadline=None, derandomize=True, database=None)
@given(st.permutations(range(len(LINES))), st.integers(0, len(LINES)))
def test_no_file_ends_the_comparison(order: list[int], length: int) -> None:
    compare(EXPECTED, {"a.idl": "".join(LINES[n] for n in order[:length])})


@pytest.mark.parametrize("name", ["", "::", "a::", "::::b", "unsigned", "float, octet", "\\\\", "t t t"])
def test_an_index_type_that_is_no_name_is_no_integer(name: str) -> None:
    model = model_of(
        '<ContractModule name="m"><Enumeration name="e" indexType="BYTE"><Enumerator name="a" value="0"/></Enumeration></ContractModule>'
    )
    text = f'module m {{ @IndexType(typeid="{name}") enum e {{ a }}; }};'
    (difference,) = compare(expected_idl(model), {"a.idl": text}).differences
    assert difference.requirement == "R-12.4.1.2-02"
