"""What each profile of tool chains asks."""

from __future__ import annotations

from ucm_cts.harness.catalogue import in_the_making
from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.stating.statement import Statement
from ucm_cts.harness.toolchains.acceptance import Acceptance
from ucm_cts.harness.toolchains.campaign import Examination


def examination_for(profile: str, statement: Statement, expression: str = "") -> Examination:
    """What ``profile`` asks, as far as it concerns ``expression`` and what the vendor states. Raises ``WrongUse``."""
    unfinished = in_the_making(profile)
    if unfinished:
        raise WrongUse(unfinished)
    return Acceptance(statement, expression)
