"""What each profile of tool chains asks."""

from __future__ import annotations

from collections.abc import Mapping

from ucm_cts.harness.catalogue import in_the_making
from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.stating.statement import Statement
from ucm_cts.harness.toolchains.acceptance import RULE_FOR, RULES, Acceptance
from ucm_cts.harness.toolchains.campaign import Examination
from ucm_cts.harness.toolchains.corpus import questions
from ucm_cts.harness.toolchains.dressing import Dress

TOOLCHAIN_CHECKS = RULES
"""The rules that the catalogue names for tool chains, and what each says."""


def stand_for() -> Mapping[str, frozenset[str]]:
    """The requirements that each of them stands for."""
    return {rule: frozenset(q.requirement for q in questions() if RULE_FOR[q.due] == rule) for rule in RULES}


def examination_for(profile: str, statement: Statement, dress: Dress, expression: str = "") -> Examination:
    """What ``profile`` asks, with models in ``dress``, as far as it concerns ``expression`` and what the vendor states. Raises ``WrongUse``."""
    unfinished = in_the_making(profile)
    if unfinished:
        raise WrongUse(unfinished)
    return Acceptance(statement, dress, expression)
