"""The standard property of 10.2 on whole tool chains: the reference keeps all, each mutant breaks what it says, no variant is failed."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator, Mapping
from pathlib import Path

import pytest
from command_line import report_of, ucm_cts
from lxml import etree

from ucm_cts.adapters.mutants.toolchain.registry import Mutant, Variant, mutants, variants
from ucm_cts.adapters.reference.toolchain.program import Program, reference
from ucm_cts.harness.catalogue.profiles import TOOLCHAIN_PROFILES
from ucm_cts.harness.results.statement import Statement, default_statement
from ucm_cts.harness.selftest.toolchains import all_subjects, declaring, examine_toolchain
from ucm_cts.harness.toolchains.acceptance import Acceptance, lines_of_consequences
from ucm_cts.harness.toolchains.campaign import ToolChainCampaign, ToolChainPlan
from ucm_cts.harness.toolchains.commands.processing import InProcess
from ucm_cts.harness.toolchains.corpus.documentation import PARAMETERS, PART, PROPERTY, WITHOUT
from ucm_cts.harness.toolchains.corpus.selection import Question, questions
from ucm_cts.harness.toolchains.examinations import examination_for
from ucm_cts.harness.toolchains.generation import documentation_models
from ucm_cts.harness.toolchains.renaming import Renaming

REFERENCE = reference()
OWN = [q for q in questions() if PART in q.under]
OPTIONAL, REQUIRED, BARE = "property-values=optional", "property-values=required", "text-values=bare"
IDS = {"R-10.2-10", "R-10.2-11", "R-10.2-12"}
CLAIMING = [one for one in (*mutants().values(), *variants().values()) if one.claims]
GENERATING = [
    pytest.param(one.name, id=one.name, marks=[pytest.mark.native] if one.task.startswith("cpp") else [])
    for one in CLAIMING
    if one.task != "check"
]


def under(*readings: str) -> list[Question]:
    """What is asked of those who claim the part and declare ``readings``."""
    statement = declaring(readings, (PART,))
    return [q for q in OWN if all(map(statement.meets, q.under))]


def verdicts(program: Program, statement: Statement, profile: str = "pim") -> Mapping[str, str]:
    """The verdicts on the requirements of the part."""
    words = "r-9.1.2-10 or r-9.2.9.4 or r-9.2.5.1 or r-9.5.1 or r-10.2" if profile == "pim" else "r-10.2"
    examination = examination_for(profile, statement, Renaming(), words)
    plan = ToolChainPlan("it", "1", profile, statement, jobs=1)
    campaign = ToolChainCampaign(InProcess(program), examination, plan)
    for _ in campaign.process():
        pass
    campaign.judge()
    return {r.id: r.verdict for r in campaign.report().requirements if r.id.startswith("R-10.2")}


@pytest.mark.parametrize("readings", [(), (OPTIONAL,)])
def test_the_reference_tool_chain_answers_as_it_must(readings: tuple[str, ...]) -> None:
    asked = under(*readings)
    twins = {q.name: q.text for q in asked}
    for q in asked:
        reported = REFERENCE.check(q.text.encode(), "model.xml")[1]
        assert bool(reported) == (q.due == "refuse"), f"{q.name}: {reported}"
        assert {one.line for one in reported} <= lines_of_consequences(q, twins), q.name
    assert verdicts(REFERENCE, declaring(readings, (PART,))) == dict.fromkeys(IDS, "pass")


def test_each_carrier_each_parameter_and_each_way_is_asked_about() -> None:
    asked = [(q, etree.fromstring(q.text.encode())) for q in under()]
    carriers = {
        str(parent.tag)
        for _, root in asked
        for one in root.iter("Annotation")
        if one.get("annotationDefinition") == PROPERTY and (parent := one.getparent()) is not None
    }
    assert carriers == {"ComponentType", "AtomicComponentImplementation", "CompositeComponentImplementation"}
    values = [(q, str(v.get("value"))) for q, root in asked for v in root.iter("ConfigurationParameterValue")]
    assert max(len(value) for _, value in values) == 10_002, "10,000 characters and the quotes"
    for parameter in PARAMETERS:
        for way in ("is_empty", "is_long"):
            assert len([q for q, _ in asked if q.name.startswith(f"{parameter}_{way}/")]) == 6
        assert any(q.name.startswith(f"property_sets_{parameter}_in_another_case/") for q, _ in asked)
    others = {q.name.partition("/")[0] for q in {*under(OPTIONAL), *under(REQUIRED), *under(BARE)} - {*under()}}
    assert len(others) == 10 + 12


def test_a_run_changes_neither_the_names_of_the_property_nor_its_texts() -> None:
    for q in under(BARE):
        before, after = (etree.fromstring(text.encode()) for text in (q.text, Renaming(7).apply(q.text)))
        for one, other in zip(before.iter(), after.iter(), strict=True):
            if one.tag in ("Annotation", "ConfigurationParameterValue", "ConfigurationParameter"):
                assert str(other.get("configurationParameter")).partition(".")[0] in ("None", PROPERTY)
                assert len(str(one.get("value"))) <= len(str(other.get("value")))
            if '"' in str(one.get("value")):
                assert one.attrib == other.attrib or ".author" in str(one.attrib)


# who does not claim it


def test_nothing_is_asked_of_who_does_not_claim_it() -> None:
    examination = Acceptance(default_statement(), Renaming())
    assert not {q.name for q in OWN} & {name for name, _ in examination.models}
    why = "without a statement it holds that properties = false"
    assert {r: said for r, said in examination.not_applicable.items() if r in IDS} == {
        requirement: f"it is never asked: {why}" for requirement in IDS
    }
    assert set(verdicts(REFERENCE, default_statement()).values()) == {"not applicable"}
    generation = examination_for("idl", default_statement(), Renaming())
    assert not documentation_models().keys() & {name for name, _ in generation.models}
    assert generation.not_applicable["R-10.2-13"] == why
    assert verdicts(REFERENCE, default_statement(), "idl") == {"R-10.2-13": "not applicable"}


@pytest.mark.parametrize("full", [False, True])
def test_a_short_statement_does_not_speak_of_it(here: Path, full: bool) -> None:
    (here / "mine.toml").write_text(
        'product = "mine"\nversion = "1"\n[check]\ncommand = ["ucm-cts-toolchain", "check", "{models}"]\n'
        '[idl]\ncommand = ["ucm-cts-toolchain", "idl", "{model}", "--out", "{out}"]\n'
    )
    assert ucm_cts("ics", "--toolchain", "mine.toml", *(("--full",) if full else ())).status == 0
    written = tomllib.loads((here / "ucm-cts-ics.toml").read_text())
    assert written.get("capabilities") == ({PART: False} if full else None)
    assert written["readings"].get("property-values") == ("observed" if full else None)


@pytest.mark.parametrize("is_claimed", [False, True])
def test_a_report_shows_the_claim_and_the_difference(here: Path, is_claimed: bool) -> None:
    command = f'["{WRONG}", "{{model}}", "{{out}}"]'
    (here / WRONG).write_text(WRONG_PROGRAM)
    (here / WRONG).chmod(0o755)
    (here / "mine.toml").write_text(f'product = "mine"\nversion = "1"\n[idl]\ncommand = {command}\n')
    (here / "ics.toml").write_text(f"[capabilities]\nproperties = {str(is_claimed).lower()}\n")
    options = ("--toolchain", "mine.toml", "--profile", "idl", "--ics", "ics.toml", "-k", "R-10.2-13", "--out", "out")
    outcome = ucm_cts("run", *options, "--no-sandbox")
    (result,) = [r for r in report_of(here / "out")["requirements"] if r["id"] == "R-10.2-13"]
    page = " ".join(etree.HTML((here / "out" / "report.html").read_text()).itertext())
    assert ("1 of 1 parts claimed" in page) == is_claimed
    if not is_claimed:
        assert result["verdict"] == "not applicable"
        return
    assert (outcome.status, result["verdict"]) == (1, "fail")
    assert result["findings"][0]["observed"] == 'added: const string made_by = "x" ;'
    assert "of.idl:1" in page


WRONG = "./wrong"
WRONG_PROGRAM = """#!/bin/sh
grep -q component_description_prop.vendor "$1" && echo 'const string made_by = "x"; // not so' > "$2/of.idl"
echo 'module m { };' >> "$2/of.idl"
"""


# wrong tool chains, and right ones


@pytest.mark.slow
@pytest.mark.parametrize("one", [one for one in CLAIMING if one.task == "check"], ids=lambda one: one.name)
def test_checkers_fail_what_they_break_and_nothing_else(one: Mutant | Variant) -> None:
    found = verdicts(one.derive(REFERENCE), declaring(one.declares, one.claims))
    broken = set(one.breaks) if isinstance(one, Mutant) else set()
    assert {requirement for requirement, verdict in found.items() if verdict == "fail"} == broken
    assert broken or set(found.values()) == {"pass"}


@pytest.mark.parametrize("name", GENERATING)
def test_generators_fail_what_they_break_and_nothing_else(name: str) -> None:
    result = examine_toolchain(all_subjects()[name])
    broken = (
        [kill.requirement for kill in result.kills] if name in mutants() else [k.requirement for k in result.failed]
    )
    assert broken == (["R-10.2-13"] if name in mutants() else [])
    assert name in mutants() or not result.trouble


def test_each_requirement_has_mutants_and_each_generator_has_some() -> None:
    wrong = [one for one in CLAIMING if isinstance(one, Mutant)]
    assert {(r, one.task) for one in wrong for r in one.breaks} == {
        *((requirement, "check") for requirement in IDS),
        *(("R-10.2-13", profile) for profile in TOOLCHAIN_PROFILES[1:]),
    }


# what generated code is compared with


class _Answering:
    """A program that makes files of the model without documentation, and others of documented ones."""

    def __init__(self, plain: Mapping[str, str] | None, documented: Mapping[str, str] | None) -> None:
        self._plain, self._documented = plain, documented

    def program(self) -> Program:
        def generate(model: object) -> Mapping[str, str]:
            files = self._documented if "component_description_prop.vendor" in str(model) else self._plain
            if files is None:
                raise ValueError
            return files

        return Program(REFERENCE.read, REFERENCE.rules, {**REFERENCE.generators, "idl": generate})


def _judged(plain: Mapping[str, str] | None, documented: Mapping[str, str] | None) -> Iterator[str]:
    examination = examination_for("idl", declaring((), (PART,)), Renaming(), "r-10.2")
    processor = InProcess(_Answering(plain, documented).program())
    responses = {name: processor.process("idl", name, text) for name, text in examination.models}
    for fact in examination.judge(responses, dict.fromkeys(responses, ())):
        assert fact.models[0] == WITHOUT
        yield fact.finding.observed if fact.finding else fact.undecided


def test_what_decides_nothing_and_what_is_missing() -> None:
    code = {"m.idl": "interface a { };"}
    assert [*_judged(code, code)] == ["", ""]
    assert [*_judged({}, code)] == [f"no code is made of {WITHOUT}"] * 2
    assert [*_judged(code, {})] == ["no file was written"] * 2
    crash = [*_judged(code, None)]
    assert len(crash) == 2
    assert all(re.match("crash: ValueError", one) for one in crash)
