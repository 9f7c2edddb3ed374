"""What each profile of tool chains asks."""

from __future__ import annotations

import functools
from collections.abc import Mapping

from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.harness.catalogue import in_the_making
from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.stating.statement import Statement
from ucm_cts.harness.toolchains.acceptance import RULE_FOR, RULES, Acceptance
from ucm_cts.harness.toolchains.campaign import TASKS, Examination
from ucm_cts.harness.toolchains.corpus import questions
from ucm_cts.harness.toolchains.cpp import standing
from ucm_cts.harness.toolchains.cpp.probes import CHECKS
from ucm_cts.harness.toolchains.description import Task
from ucm_cts.harness.toolchains.dressing import Dress
from ucm_cts.harness.toolchains.generation import Comparison, Generation
from ucm_cts.harness.toolchains.idl.comparing import CHECKS as IDL_CHECKS
from ucm_cts.harness.toolchains.idl.comparing import compare
from ucm_cts.harness.toolchains.idl.omniidl import opinion
from ucm_cts.reference_models.idl.expectations import STANDS_FOR
from ucm_cts.reference_models.idl.mapping import expected_idl

TOOLCHAIN_CHECKS = {**RULES, **IDL_CHECKS, **CHECKS}
"""The rules that the catalogue names for tool chains, and what each says."""


def stand_for() -> Mapping[str, frozenset[str]]:
    """The requirements that each of them stands for."""
    of_models = {rule: frozenset(q.requirement for q in questions() if RULE_FOR[q.due] == rule) for rule in RULES}
    of_idl = {rule: frozenset(requirements) for rule, requirements in STANDS_FOR.items()}
    return {**of_models, **of_idl, **standing.stand_for()}


def examination_for(profile: str, statement: Statement, dress: Dress, expression: str = "") -> Examination:
    """What ``profile`` asks, with models in ``dress``, as far as it concerns ``expression`` and what the vendor states. Raises ``WrongUse``."""
    unfinished = in_the_making(profile)
    if unfinished:
        raise WrongUse(unfinished)
    match TASKS[profile]:
        case "check":
            return Acceptance(statement, dress, expression)
        case "idl":
            return Generation(functools.partial(_compare_idl, statement), GENERATES["idl"], dress, expression)
        case _:
            raise WrongUse(f"profile '{profile}' is in the making")


GENERATES: Mapping[Task, tuple[str, str]] = {"idl": ("R-12-01", "idl_generated")}
"""The requirement, and its rule, that a tool chain makes files of legal models at all."""


def _compare_idl(statement: Statement, model: Model, files: Mapping[str, str]) -> Comparison:
    return compare(expected_idl(model), files, statement.readings, opinion)
