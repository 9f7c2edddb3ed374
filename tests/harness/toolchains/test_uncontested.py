"""Models for generators are not held against tool chains that refuse what the text leaves open."""

from __future__ import annotations

import itertools
from collections.abc import Collection

import pytest

from ucm_cts.adapters.mutants.toolchain.registry import variants
from ucm_cts.adapters.reference.toolchain.program import Program, reference
from ucm_cts.harness.results.statement import Statement
from ucm_cts.harness.results.values import ToolChainReport
from ucm_cts.harness.selftest.toolchains import declaring
from ucm_cts.harness.toolchains.campaign import ToolChainCampaign, ToolChainPlan
from ucm_cts.harness.toolchains.commands.processing import InProcess
from ucm_cts.harness.toolchains.corpus.uncontested import CONTESTED, PREFIX, uncontested, understood
from ucm_cts.harness.toolchains.examinations import WITH_NATIVES, examination_for
from ucm_cts.harness.toolchains.generation import OPEN, mapping_models
from ucm_cts.harness.toolchains.renaming import Renaming

OF_MODELS = [name for name, one in variants().items() if one.task == "check"]
CERTAIN = "reads_only_what_is_certain"
EVERYTHING = tuple(one.reading for one in CONTESTED)


def report_on(
    program: Program, statement: Statement, profile: str, models: Collection[str] | None = None
) -> ToolChainReport:
    examination = examination_for(profile, statement, Renaming(), models=models)
    campaign = ToolChainCampaign(
        InProcess(program), examination, ToolChainPlan("some tool chain", "", profile, statement, jobs=1)
    )
    for _ in campaign.process():
        pass
    campaign.judge()
    return campaign.report()


@pytest.mark.parametrize("name", OF_MODELS)
def test_whoever_reads_clause_9_in_a_permitted_way_accepts_the_models_without_what_is_contested(name: str) -> None:
    variant = variants()[name]
    program, meets = variant.derive(reference()), declaring(variant.declares).meets
    for model, text in mapping_models().items():
        if model not in WITH_NATIVES and not model.startswith(OPEN):
            assert program.check(uncontested(text, meets)[0].encode(), model)[1] == [], model


@pytest.mark.parametrize("contested", CONTESTED, ids=lambda one: one.interpretation)
def test_models_hold_what_is_contested_and_lose_nothing_else(contested: object) -> None:
    others = [one.reading for one in CONTESTED if one is not contested]
    changed = {name: uncontested(text, others.__contains__) for name, text in mapping_models().items()}
    assert any(allowed_by for _, allowed_by in changed.values())
    assert all(bool(allowed_by) == (mapping_models()[name] != text) for name, (text, allowed_by) in changed.items())


def test_models_stay_as_they_are_for_whoever_declares_to_accept_all() -> None:
    assert all(uncontested(text, EVERYTHING.__contains__) == (text, ()) for text in mapping_models().values())


def test_what_is_left_is_a_legal_model_whatever_is_declared() -> None:
    program = reference()
    for met in itertools.product((False, True), repeat=len(CONTESTED)):
        declared = tuple(one.reading for one, is_met in zip(CONTESTED, met, strict=True) if is_met)
        for also in ((), ("text-values=bare",)):
            meets = {*declared, *also}.__contains__
            for model, text in mapping_models().items():
                left = uncontested(understood(text, meets), meets)[0]
                assert program.check(left.encode(), model)[1] == [], (model, declared, also)


@pytest.mark.parametrize("claims", [(), ("properties",)])
def test_who_takes_quotes_for_a_part_of_the_text_conforms(claims: tuple[str, ...]) -> None:
    program = variants()["bare_text"].derive(reference())
    report = report_on(program, declaring(("text-values=bare",), claims), "idl")
    assert [r.id for r in report.requirements if r.verdict in ("fail", "error", "inconclusive")] == []


@pytest.mark.parametrize("profile", ["idl", "cpp11"])
def test_who_refuses_what_is_contested_passes_by_the_rest(profile: str) -> None:
    program, models = variants()[CERTAIN].derive(reference()), ("modules", "idl_templates")
    report = report_on(program, declaring(variants()[CERTAIN].declares), profile, models)
    assert [r.id for r in report.requirements if r.verdict in ("fail", "error")] == []
    assert report.effort.measures["models that may be refused"] == len(models)


def test_who_takes_quotes_for_a_part_of_the_text_gets_none() -> None:
    quoted = [
        dict(examination_for("idl", declaring(d), Renaming()).models)["constants"] for d in ((), ("text-values=bare",))
    ]
    assert ["good morning" in text for text in quoted] == [True, False]


def test_who_refuses_without_need_fails() -> None:
    program = variants()[CERTAIN].derive(reference())
    report = report_on(program, declaring(EVERYTHING), "idl", ("modules", "idl_combined", "data_types"))
    assert [r.id for r in report.requirements if r.verdict == "fail"] == ["R-12-01"]


def test_the_rest_is_not_judged_if_the_whole_was() -> None:
    examination = examination_for("idl", declaring(()), Renaming(), models=("modules",))
    assert [name for name, _ in examination.models] == ["modules", f"{PREFIX}modules"]
    report = report_on(reference(), declaring(()), "idl", ("modules",))
    assert report.effort.measures["models generated from"] == 1
