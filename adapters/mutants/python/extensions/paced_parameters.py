"""Wrong frameworks, clause 10.5.1: policies and their parameters are not taken, or mean something else."""

from __future__ import annotations

import time
from collections.abc import Callable

from ucm_cts.adapters.contract import programming_model as pm
from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.mutants.python.methods import replaces
from ucm_cts.adapters.mutants.python.registry import PACED, Base, Row, breaks, family
from ucm_cts.adapters.reference.python.execution import Trigger
from ucm_cts.adapters.reference.python.members import Member
from ucm_cts.adapters.reference.python.pacing import Pace

CHECKED = {"parameter-values-checked": "refused"}
_SUPPORT = tuple(f"R-10.5.1-{n}" for n in (19, 20, 21, 22))


class _Refuses(Base):
    """Refuses a policy that ``is_refused``."""

    is_refused: Callable[[s.Policy], bool]

    def _check_policies(self, implementation: pm.Implementation) -> None:
        super()._check_policies(implementation)
        if any(self.is_refused(policy) for policy in implementation.policies):
            raise pm.UcmError("the policy is not offered")


def _is(definition: str) -> Callable[[s.Policy], bool]:
    return lambda policy: policy.definition == definition


def _priority(policy: s.Policy) -> int:
    return policy.settings.get(s.PRIORITY.get(policy.definition, ""), 1)


family(
    _Refuses,
    "is_refused",
    {
        "knows_no_periodic_runs": Row(_SUPPORT[0], "The periodic self-executing policy is refused.", _is(s.PERIODIC_SELF_EXECUTING)),
        "knows_no_background": Row(_SUPPORT[1], "The background policy is refused.", _is(s.BACKGROUND)),
        "knows_no_sporadic_calls": Row(_SUPPORT[2], "The sporadic policy is refused.", _is(s.SPORADIC_ACTIVE)),
        "knows_no_periodic_calls": Row(_SUPPORT[3], "The periodic active policy is refused.", _is(s.PERIODIC_ACTIVE)),
        "knows_no_lowest_priority": Row(
            _SUPPORT[0], "Priority 255 is refused.", lambda policy: _priority(policy) == 255, also=_SUPPORT
        ),
        "knows_no_highest_priority": Row(
            _SUPPORT[1], "Priority 1 of a background component is refused.",
            lambda policy: policy.definition == s.BACKGROUND and _priority(policy) == 1,
        ),
        "knows_no_priority_in_between": Row(
            _SUPPORT[2], "Priority 128 is refused.", lambda policy: _priority(policy) == 128, also=_SUPPORT
        ),
        "refuses_zero_undeclared": Row(
            "R-10.5.1-24", "Priority 0 is refused, and accepting it is declared.",
            lambda policy: _priority(policy) == 0, readings={"priority-zero": "accepted"},
        ),
        "knows_no_offset": Row(
            _SUPPORT[0], "An offset other than zero is refused.",
            lambda policy: any(policy.settings.get(name) for name in s.OFFSET.values()), also=_SUPPORT,
        ),
    },
    PACED,
)  # fmt: skip


@breaks("R-10.5.1-24", clauses=PACED, readings=CHECKED)
class takes_any_priority(Base):
    """Priorities that are none are accepted, and refusing them is declared."""

    def _check_settings(self, policy: s.Policy) -> None:
        name = s.PRIORITY.get(policy.definition, "")
        in_range = {**policy.settings, **({name: 1} if name in policy.settings else {})}
        super()._check_settings(s.Policy(policy.definition, policy.port, settings=in_range))


@breaks("R-10.5.1-24", clauses=PACED, readings={"priority-zero": "refused"})
class takes_zero(Base):
    """Priority 0 is accepted, and refusing it is declared."""


@replaces("_check_policies", "R-10.5.1-23", clauses=PACED, also=("R-10.1.3-03",))
def takes_two_policies(self: Base, implementation: pm.Implementation) -> None:
    """A component may have several execution policies; the first one holds."""
    for policy in implementation.policies:
        self._check_settings(policy)


@breaks("R-10.5.1-27", clauses=PACED, also=("R-10.5.2-02", "R-10.5.2-21"))
class starves_low_priorities(Base):
    """A periodic component with a priority beyond 200 never runs."""

    def _run_paced(self, member: Member, trigger: Trigger) -> None:
        if _priority(member.execution.extended[0]) <= 200 or member.execution.extended[0].definition == s.BACKGROUND:
            super()._run_paced(member, trigger)


def _without_offset(definition: str) -> type[Pace]:
    def __init__(self: Pace, policy: s.Policy, origin: float) -> None:
        Pace.__init__(self, policy, origin)
        if policy.definition == definition:
            self.first = origin

    return type("WithoutOffset", (Pace,), {"__init__": __init__})


family(
    Base,
    "pace_class",
    {
        "ignores_the_offset_of_runs": Row(
            "R-10.5.1-28",
            "psec_offset is ignored.",
            _without_offset(s.PERIODIC_SELF_EXECUTING),
            also=("R-10.5.2-03", "R-10.5.2-21"),
        ),
        "ignores_the_offset_of_background": Row(
            "R-10.5.1-29", "bsec_offset is ignored.", _without_offset(s.BACKGROUND)
        ),
        "ignores_the_offset_of_calls": Row(
            "R-10.5.1-30",
            "ppac_offset is ignored.",
            _without_offset(s.PERIODIC_ACTIVE),
            also=("R-10.5.2-10", "R-10.5.2-11", "R-10.5.2-21"),
        ),
    },
    PACED,
)


@breaks("R-10.5.1-28", "R-10.5.1-29", "R-10.5.1-30", clauses=PACED, also=("R-10.5.2-03", "R-10.5.2-10", "R-10.5.2-21"))
class halves_offsets(Pace):
    """Half of an offset passes."""

    def __init__(self, policy: s.Policy, origin: float) -> None:
        super().__init__(policy, origin)
        self.first = origin + self.offset / 2


@breaks("R-10.5.1-28", "R-10.5.1-29", clauses=PACED, also=("R-10.5.1-30", "R-10.5.2-03", "R-10.5.2-10", "R-10.5.2-21"))
class counts_offsets_from_the_addition(Base):
    """An offset counts from the time when the first component was added to any container."""

    def add_component(self, implementation: str, attributes: object) -> int:
        self.manager.__dict__.setdefault("added", time.monotonic())
        return super().add_component(implementation, attributes)  # type: ignore[arg-type]

    def _paces(self, member: Member, origin: float) -> dict[str | None, Pace]:
        return super()._paces(member, self.manager.__dict__["added"])


@breaks("R-10.5.1-28", clauses=PACED, also=("R-10.5.1-29", "R-10.5.2-03", "R-10.5.2-21"))
class knows_whole_milliseconds_of_ten(Pace):
    """Offsets are cut to whole steps of 25 milliseconds."""

    def __init__(self, policy: s.Policy, origin: float) -> None:
        super().__init__(policy, origin)
        self.first = origin + int(self.offset / 0.025) * 0.025


@breaks("R-10.5.1-31", clauses=PACED, also=("R-10.5.2-01", "R-10.5.2-02", "R-10.5.2-03", "R-10.5.2-04"))
class has_one_period_for_all(Base):
    """All components have the period of the first one that is started."""

    def _paces(self, member: Member, origin: float) -> dict[str | None, Pace]:
        paces = super()._paces(member, origin)
        for pace in paces.values():
            if pace.policy.definition == s.PERIODIC_SELF_EXECUTING:
                pace.period = self.manager.__dict__.setdefault("period", pace.period)
        return paces
