"""Frameworks that fail sometimes; tests set how often (``left``)."""

from __future__ import annotations

import os

from ucm_cts.adapters.mutants.python.registry import Base, bind
from ucm_cts.adapters.reference.python.members import Failures, Member


class Forgets(Base):
    """Does not record what an error is, while there is something to forget."""

    left = 0

    def _log(self, member: Member, severity: str, message: str) -> None:
        if severity == "error" and Forgets.left > 0:
            Forgets.left -= 1
        else:
            super()._log(member, severity, message)


Forgetful = bind("Forgetful", Forgets)


class Slips(Base):
    """Forgets to tell a body that it is removed, while there is something to forget."""

    left = 0

    def _remove(self, member: Member, failures: Failures) -> None:
        if Slips.left > 0:
            Slips.left -= 1
        else:
            super()._remove(member, failures)


Slipping = bind("Slipping", Slips)


class MissesOnOneCore(Base):
    """Does not record what an error is where there is one core only."""

    def _log(self, member: Member, severity: str, message: str) -> None:
        if severity != "error" or len(os.sched_getaffinity(0)) > 1:
            super()._log(member, severity, message)


MissingOnOneCore = bind("MissingOnOneCore", MissesOnOneCore)
