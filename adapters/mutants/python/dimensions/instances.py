"""Execution policies that hold for some instances only: the first one of an implementation, or those of the manager (10.1.3.2)."""

from __future__ import annotations

from collections.abc import Mapping

from ucm_cts.adapters.mutants.python.methods import alters, does_only_if
from ucm_cts.adapters.mutants.python.registry import POLICIES, Base, breaks, is_below
from ucm_cts.adapters.reference.python.members import Member

_OVERLAPS = ("R-10.1.3.2-06", "R-10.1.3.2-09", "R-10.1.3.2-16")
_RUNS = ("R-10.1.3.2-01", "R-10.1.3.2-03")


class _KnowsFirst(Base):
    """Knows which instance of an implementation was added first in the runtime."""

    def _configure(self, member: Member, attributes: Mapping[str, str]) -> None:
        firsts: dict[str, Member] = self.manager.__dict__.setdefault("first_of", {})
        firsts.setdefault(member.implementation.name, member)
        super()._configure(member, attributes)

    def _is_first(self, member: Member) -> bool:
        return self.manager.__dict__["first_of"].get(member.implementation.name) is member


@breaks(*_OVERLAPS, clauses=POLICIES)
class protects_first_instances(_KnowsFirst):
    """Only the first instance of an implementation is protected."""

    def _is_protected(self, member: Member) -> bool:
        return super()._is_protected(member) and self._is_first(member)


@alters("_is_protected", *_OVERLAPS, clauses=POLICIES)
def protects_nothing_below(self: Base, is_protected: bool, _member: Member) -> bool:
    """Components of sub-containers are not protected."""
    return is_protected and not is_below(self)


@breaks(*_RUNS, clauses=POLICIES)
class runs_first_instances(_KnowsFirst):
    """Of the instances of a self-executing implementation only the first one runs."""

    def _begin_execution(self, member: Member) -> None:
        if self._is_first(member):
            super()._begin_execution(member)


@does_only_if("_begin_execution", *_RUNS, clauses=POLICIES)
def runs_nothing_below(self: Base, _member: Member) -> bool:
    """Self-executing components of sub-containers do not run."""
    return not is_below(self)
