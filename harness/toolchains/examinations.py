"""The examination of each profile of tool chains."""

from __future__ import annotations

import functools
from collections.abc import Callable, Collection, Mapping

from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.harness.catalogue.requirements import in_the_making, requirements_of
from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.results.statement import Statement
from ucm_cts.harness.statement.applicability import why_not
from ucm_cts.harness.toolchains.acceptance import RULE_FOR, RULES, Acceptance
from ucm_cts.harness.toolchains.campaign import TASKS, Examination
from ucm_cts.harness.toolchains.commands.description import Command, Task
from ucm_cts.harness.toolchains.corpus.decoration import DECORATION_OF_CPP, DECORATION_OF_IDL
from ucm_cts.harness.toolchains.corpus.documentation import DOCUMENTATION, PART
from ucm_cts.harness.toolchains.corpus.selection import questions
from ucm_cts.harness.toolchains.cpp import applicability
from ucm_cts.harness.toolchains.cpp.comparing import compare as compare_cpp
from ucm_cts.harness.toolchains.cpp.compiling import Compiler, Layout, can_be_run
from ucm_cts.harness.toolchains.cpp.linking import is_code
from ucm_cts.harness.toolchains.cpp.probes.check import CHECKS, GENERATED, HEADERS
from ucm_cts.harness.toolchains.differences import Comparison
from ucm_cts.harness.toolchains.generation import Generation, documentation_models, mapping_models
from ucm_cts.harness.toolchains.idl.comparing import CHECKS as IDL_CHECKS
from ucm_cts.harness.toolchains.idl.comparing import compare as compare_idl
from ucm_cts.harness.toolchains.idl.declared_support import not_applicable
from ucm_cts.harness.toolchains.idl.omniidl import Opinion, opinion
from ucm_cts.harness.toolchains.renaming import Renaming
from ucm_cts.reference_models.mapping.cpp.expected import Standard
from ucm_cts.reference_models.mapping.cpp.mapping import expected_cpp
from ucm_cts.reference_models.mapping.idl.expectations import STANDS_FOR
from ucm_cts.reference_models.mapping.idl.mapping import expected_idl

DOCUMENTATION_CHECKS = {
    DOCUMENTATION[
        1
    ]: "The code that is generated is the same whatever the standard property says of components, comments apart.",
}

TOOLCHAIN_CHECKS = {**RULES, **IDL_CHECKS, **CHECKS, **DOCUMENTATION_CHECKS}
"""The rules that the catalogue names for tool chains, and what each says."""


def stand_for() -> Mapping[str, frozenset[str]]:
    """The requirements that each of them stands for."""
    of_models = {rule: frozenset(q.requirement for q in questions() if RULE_FOR[q.due] == rule) for rule in RULES}
    of_idl = {rule: frozenset(requirements) for rule, requirements in STANDS_FOR.items()}
    of_documentation = {DOCUMENTATION[1]: frozenset({DOCUMENTATION[0]})}
    return {**of_models, **of_idl, **applicability.stand_for(), **of_documentation}


def examination_for(
    profile: str,
    statement: Statement,
    renaming: Renaming,
    expression: str = "",
    command: Command | None = None,
    models: Collection[str] | None = None,
    untouched: str = "",
    sandbox: bool = True,
    network: bool = True,
) -> Examination:
    """What ``profile`` asks, with models in ``renaming``, as far as it concerns ``expression`` and what the vendor states.

    ``command`` says of generated C++ which compiler takes it, and where its headers are. Code is generated from ``models`` only, if
    they are named. ``untouched`` is why no compiler may read what was generated, and nothing of it may run; empty if that may be.
    ``sandbox``: compilers, omniidl, and what they make, run in one, where ``network`` says whether there is a network. Raises ``WrongUse``.
    """
    unfinished = in_the_making(profile)
    if unfinished:
        raise WrongUse(unfinished)
    task = TASKS[profile]
    models = _asked(task, statement, models)
    if task == "check":
        return Acceptance(statement, renaming, expression)
    if task == "idl":
        second_opinion = (
            functools.partial(_no_opinion, untouched)
            if untouched
            else functools.partial(opinion, sandbox=sandbox, network=network)
        )
        compare = functools.partial(_compare_idl, statement.readings, second_opinion)
        return Generation(
            compare,
            ("R-12-01", "idl_generated"),
            DECORATION_OF_IDL,
            renaming,
            expression,
            models,
            {**not_applicable(statement), **_unclaimed(profile, statement)},
            _may_be_refused(statement, IMPOSSIBLE_IN_IDL),
            meets=statement.meets,
        )
    standard: Standard = "cpp03" if task == "cpp03" else "cpp11"
    how = command or Command(command=())
    if not untouched and not can_be_run(_compiler(how).command[0]):
        compiler = _compiler(how).command[0]
        raise WrongUse(
            f"no compiler '{compiler}' can be run; install it, or name another: compiler = [...] in [{task}]"
        )
    compare = functools.partial(_compare_cpp, standard, statement.readings, how, _compiler(how, sandbox, network))
    if untouched:
        compare = functools.partial(_compare_nothing, standard, statement.readings, untouched)
    not_asked = {**applicability.not_applicable(statement), **_unclaimed(profile, statement)}
    refusable = _may_be_refused(statement, IMPOSSIBLE_IN_CPP)
    is_of_cpp = functools.partial(is_code, _layout(how))
    return Generation(
        compare,
        GENERATED,
        DECORATION_OF_CPP,
        renaming,
        expression,
        models,
        not_asked,
        refusable,
        is_of_cpp,
        statement.meets,
    )


WITH_NATIVES = frozenset({"idl_natives"})
"""Models with native types, which the core leaves out (interpretation idl-native-sizes)."""


def _asked(task: Task, statement: Statement, models: Collection[str] | None) -> Collection[str]:
    """The models that code is generated from, by name."""
    names = frozenset(mapping_models() if models is None else models)
    if models is None and statement.meets(PART):
        names |= documentation_models().keys()
    return names if task == "idl" and statement.meets("native-types=supported") else names - WITH_NATIVES


def _unclaimed(profile: str, statement: Statement) -> Mapping[str, str]:
    """The requirements of a part that the vendor does not claim, and who says so."""
    reasons = {r.id: why_not(r, statement) for r in requirements_of(profile) if r.part}
    return {requirement: why[1] for requirement, why in reasons.items() if why is not None}


IMPOSSIBLE_IN_IDL: Mapping[str, tuple[str, str]] = {
    "large_constants": ("idl-ulonglong=unsigned-long", "idl-ulonglong"),
    "multiples": ("idl-policy-getters=definition", "idl-policy-getters"),
}
"""Models of which a reading makes no IDL, or leaves open what it makes: that reading, and its interpretation."""

IMPOSSIBLE_IN_CPP: Mapping[str, tuple[str, str]] = {"multiples": ("cpp-get-tp-name=definition", "policy-getter-names")}
"""The same for C++."""


def _may_be_refused(statement: Statement, impossible: Mapping[str, tuple[str, str]]) -> Mapping[str, str]:
    """The models that the vendor may refuse by what is declared, and the interpretation that allows it."""
    return {name: allowed_by for name, (reading, allowed_by) in impossible.items() if statement.meets(reading)}


def _compare_idl(
    readings: Mapping[str, str],
    second_opinion: Callable[[Mapping[str, str]], Opinion],
    model: Model,
    files: Mapping[str, str],
) -> Comparison:
    return compare_idl(expected_idl(model), files, readings, second_opinion)


def _no_opinion(why: str, files: Mapping[str, str]) -> Opinion:
    return Opinion("none", reason=why)


def _compare_nothing(
    standard: Standard, readings: Mapping[str, str], why: str, model: Model, files: Mapping[str, str]
) -> Comparison:
    expected = expected_cpp(model, standard, readings).expected
    unjudged = dict.fromkeys((HEADERS[standard], *(e.requirement for e in expected)), why)
    return Comparison({}, (), unjudged=unjudged)


def _compare_cpp(
    standard: Standard,
    readings: Mapping[str, str],
    how: Command,
    compiler: Compiler,
    model: Model,
    files: Mapping[str, str],
) -> Comparison:
    return compare_cpp(model, files, standard, readings, compiler, _layout(how))


def _layout(how: Command) -> Layout:
    return Layout(how.include, how.headers, how.sources, how.libraries)


def _compiler(how: Command, sandbox: bool = True, network: bool = True) -> Compiler:
    return Compiler(how.compiler or Compiler().command, sandbox=sandbox, network=network)
