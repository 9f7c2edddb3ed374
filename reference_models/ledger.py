"""Where rules write down what they saw: requirements exercised, violations found, rows of the table visited."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Literal

from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.reference_models.findings import Arrow, Finding
from ucm_cts.reference_models.life_cycle import LifeCycleTable, Row

Moment = Literal["ended", "entered", "left", "replied", "noted"]
"""When a rule looks: an operation or stimulus ended, a body was entered or left, a body's call came back, a fragment's
query came back."""


@dataclass(frozen=True)
class Rule:
    """A named check and the requirements it stands for; ``check`` takes what the judge offers at ``moment``."""

    name: str
    moment: Moment
    stands_for: tuple[str, ...]
    check: Callable[..., None]


RULES: dict[str, Rule] = {}
"""All rules by name, filled as the rule modules are imported."""


def rule(moment: Moment, *stands_for: str) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """Register the decorated function, under its own name, as a rule that looks at ``moment``."""

    def register(check: Callable[..., None]) -> Callable[..., None]:
        RULES[check.__name__] = Rule(check.__name__, moment, stands_for, check)
        return check

    return register


@dataclass(slots=True)
class RowTally:
    """How one row of the life-cycle table fared in one trace."""

    exercised: int = 0
    violated: int = 0
    readings: set[str] = field(default_factory=set)


@dataclass(slots=True)
class Ledger:
    """The judgement of one trace in the making."""

    scenario: Scenario
    table: LifeCycleTable
    exercises: Counter[str] = field(default_factory=Counter)
    findings: list[Finding] = field(default_factory=list)
    rows: dict[str, RowTally] = field(default_factory=dict)

    def exercised(self, requirement: str) -> None:
        """The requirement's condition really arose, and it was kept."""
        self.exercises[requirement] += 1

    def violated(
        self,
        requirement: str,
        rule: str,
        cause: str,
        expected: str,
        observed: str,
        events: tuple[int, ...] = (),
        step: int | None = None,
        instead: tuple[Arrow, ...] = (),
    ) -> None:
        """The requirement was broken. It was exercised, too."""
        self.exercises[requirement] += 1
        self.findings.append(Finding(requirement, rule, cause, expected, observed, events, step, instead))

    def row(self, row: Row) -> RowTally:
        """The tally of ``row``."""
        tally = self.rows.get(row.id)
        if tally is None:
            tally = self.rows[row.id] = RowTally()
        return tally
