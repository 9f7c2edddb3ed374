"""Who declares one value of an option and does what another one says is found out.

The subjects are those that take the other value; what they declare is changed.
"""

from __future__ import annotations

import functools
from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import NamedTuple

import pytest

from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.contract.metamodel.reading import read_model
from ucm_cts.adapters.mutants.toolchain.registry import Variant, variants
from ucm_cts.adapters.reference.toolchain.program import reference
from ucm_cts.harness.catalogue.requirements import (
    load_interpretations,
    load_options,
)
from ucm_cts.harness.selftest.consulted import consulted_for
from ucm_cts.harness.selftest.toolchains import declaring
from ucm_cts.harness.toolchains.campaign import ToolChainCampaign, ToolChainPlan
from ucm_cts.harness.toolchains.commands.processing import InProcess
from ucm_cts.harness.toolchains.corpus.selection import questions
from ucm_cts.harness.toolchains.cpp.comparing import compare as compare_cpp
from ucm_cts.harness.toolchains.cpp.compiling import Compiler
from ucm_cts.harness.toolchains.examinations import examination_for
from ucm_cts.harness.toolchains.generation import mapping_models
from ucm_cts.harness.toolchains.idl.comparing import compare as compare_idl
from ucm_cts.harness.toolchains.renaming import Renaming
from ucm_cts.reference_models.mapping.cpp.expected import Standard
from ucm_cts.reference_models.mapping.idl.mapping import expected_idl

OBSERVED = "observed"
PROFILES = {option: entry.profile for entry in load_interpretations() for option in entry.options}
REFERENCE = replace(reference(), read=functools.lru_cache(8192)(read_model))
TASKS = {"pim": ("check",), "idl": ("idl",), "cpp": ("cpp11", "cpp03")}


class False_(NamedTuple):
    """A tool chain that takes the value ``taken`` of ``option`` and is said to take ``declared``."""

    subject: Variant
    option: str
    taken: str
    declared: str


def false_declarations(profile: str) -> Iterator[False_]:
    """One subject for each two values of each option of ``profile``. The default is never declared: it claims least."""
    for option, values in load_options().items():
        if PROFILES[option] != profile:
            continue
        for taken in values:
            takers = [v for v in variants().values() if v.task in TASKS[profile] and f"{option}={taken}" in v.declares]
            if option == "cpp-enum":
                takers = [v for v in takers if v.task == "cpp11"]
            for declared in values[1:]:
                if takers and taken != OBSERVED != declared and declared != taken:
                    yield False_(takers[-1] if option.startswith("cpp03") else takers[0], option, taken, declared)


ALLOWED: Mapping[tuple[str, str, str], str] = {
    ("idl-output", "psm", "both"): "what clause 9 shows may stand beside what clause 12 says",
    ("idl-enumerator-order", "kept", "free"): "an order that is kept is one of all",
    ("cpp-bodies", "typed", "generic"): "nothing is asked of typed classes then",
    ("cpp-hyphen", "underscore", "other"): "an underscore is something, too",
    ("declarations-elsewhere", "refused", "extension"): "nothing is asked of an extension",
    ("cpp03-float-constants", "source", "header"): "nothing is asked where a header may define them",
}
"""Option, value taken, value declared: why the former does what the latter says."""


def cases(profile: str) -> list[object]:
    return [
        pytest.param(case, id=f"{case.option}={case.declared}-{case.subject.name}")
        for case in false_declarations(profile)
        if case[1:] not in ALLOWED
    ]


def shown(case: False_) -> list[str]:
    """The models that show what ``case`` declares falsely: first what is generated otherwise than usual, and of that the small ones."""
    consulted = consulted_for(case.subject.task)
    of_option = [name for name, options in consulted.items() if case.option in options] or list(consulted)
    usual, made = (p.generators[case.subject.task] for p in (REFERENCE, case.subject.derive(REFERENCE)))
    return sorted(of_option, key=lambda name: usual(model_of(name)) == made(model_of(name)))


@functools.cache
def model_of(name: str) -> Model:
    return read_model(mapping_models()[name].encode(), name).model


@pytest.mark.slow
@pytest.mark.parametrize("case", cases("pim"))
def test_a_checker_that_does_otherwise_than_declared_is_found_out(case: False_) -> None:
    asked = [q.name for q in questions() if f"{case.option}={case.declared}" in q.under]
    assert failing(case, " or ".join(asked)) or failing(case)  # what is minimal often shows among all models only


def failing(case: False_, expression: str = "") -> list[str]:
    """The requirements that a checker fails; ``expression`` selects models."""
    others = [one for one in case.subject.declares if not one.startswith(f"{case.option}=")]
    statement = declaring((*others, f"{case.option}={case.declared}"), case.subject.claims)
    examination = examination_for("pim", statement, Renaming(), expression)
    program = InProcess(case.subject.derive(REFERENCE))
    campaign = ToolChainCampaign(program, examination, ToolChainPlan(case.subject.name, "", "pim", statement, jobs=1))
    for _ in campaign.process():
        pass
    campaign.judge()
    return [result.id for result in campaign.report().requirements if result.verdict == "fail"]


@pytest.mark.slow
@pytest.mark.parametrize("case", cases("idl"))
def test_idl_that_is_otherwise_than_declared_is_found_out(case: False_) -> None:
    program = case.subject.derive(reference())
    for name in shown(case):
        model = model_of(name)
        if compare_idl(expected_idl(model), program.generators["idl"](model), {case.option: case.declared}).differences:
            return
    pytest.fail("it is spared")


@pytest.mark.native
@pytest.mark.parametrize("case", cases("cpp"))
def test_cpp_that_is_otherwise_than_declared_is_found_out(case: False_) -> None:
    standard: Standard = "cpp03" if case.subject.task == "cpp03" else "cpp11"
    program = case.subject.derive(reference())
    for name in shown(case)[:3]:
        model = model_of(name)
        files = program.generators[standard](model)
        if compare_cpp(model, files, standard, {case.option: case.declared}, Compiler()).differences:
            return
    pytest.fail("it is spared")
