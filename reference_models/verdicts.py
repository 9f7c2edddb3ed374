"""Where rules write down what they saw: requirements exercised, violations found, rows of the table visited."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import Literal

from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.reference_models.findings import Arrow, Finding
from ucm_cts.reference_models.model.expected_callbacks import Duties, Fit
from ucm_cts.reference_models.model.ics import Claims
from ucm_cts.reference_models.model.life_cycle import Row

Moment = Literal[
    "ended",
    "entered",
    "called",
    "answered",
    "replied",
    "noted",
    "began",
    "over",
    "served",
    "waited",
    "linked",
    "delivered",
    "completed",
    "told",
    "closed",
]
"""When a rule looks: an operation ended; a body was entered by a callback, or by a business call; a stimulus of the test
came back; a body's own call came back; a fragment's query came back. Where components have policies: an execution began,
or was over; a call that had to wait came back, or never did; a wait of the scenario ran out of patience. Where port
elements have interfaces or policies (interactions.py): a step for connectors ended; a method of a body was entered; a
body's call of a method came back; something was counted, measured or read back; the trace is over."""


Where = Literal["", "policies", "interactions", "fragments", "attributes"]
"""In which scenarios a rule has something to look at: in all; where components have policies; where interactions are
followed, because port elements have interfaces or components policies; where components are fragments, or have attributes.
"""


@dataclass(frozen=True)
class Rule:
    """A named check and the requirements it stands for; ``check`` takes what the judge offers at ``moment``.

    ``at`` names the operations, for ``entered`` the hooks, for ``called`` who called, that it looks at; empty stands for all. What a ``timed`` rule
    finds depends on how long something took, so that a machine that stood still may be to blame. With ``where`` it has
    nothing to look at in other scenarios than those in which that is followed.
    """

    name: str
    moment: Moment
    stands_for: tuple[str, ...]
    at: tuple[str, ...]
    check: Callable[..., None]
    timed: bool = False
    where: Where = ""


RULES: dict[str, Rule] = {}
"""All rules by name, filled as the rule modules are imported."""


def rule(
    moment: Moment, *stands_for: str, at: tuple[str, ...] = (), timed: bool = False, where: Where = ""
) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """Register the decorated function, under its own name, as a rule that looks at ``moment``."""

    def register(check: Callable[..., None]) -> Callable[..., None]:
        RULES[check.__name__] = Rule(check.__name__, moment, stands_for, at, check, timed, where)
        return check

    return register


def in_order_of(modules: Iterable[str]) -> None:
    """Put the rules into the order of the ``modules`` that have them, whichever was imported first."""
    place = {module: number for number, module in enumerate(modules)}
    for name in sorted(RULES, key=lambda name: place.get(RULES[name].check.__module__, len(place))):
        RULES[name] = RULES.pop(name)


def checks(moment: Moment, at: str = "", followed: frozenset[Where] = frozenset()) -> tuple[Callable[..., None], ...]:
    """The checks of all rules that look at this operation or hook at ``moment``, where so much is ``followed``."""
    return tuple(
        r.check
        for r in RULES.values()
        if r.moment == moment and (not r.at or at in r.at) and (not r.where or r.where in followed)
    )


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
    duties: Duties
    exercises: dict[str, int] = field(default_factory=dict)
    findings: list[Finding] = field(default_factory=list)
    tallies: dict[int, tuple[Row, RowTally]] = field(default_factory=dict)
    fits: dict[Fit, int] = field(default_factory=dict)
    claims: Claims = field(default_factory=Claims)
    readings: dict[str, set[str]] = field(default_factory=dict)
    measures: dict[str, int] = field(default_factory=dict)

    def measured(self, what: str, amount: int = 1) -> None:
        """Something worth adding up over a run: how much effort was behind verdicts."""
        self.measures[what] = self.measures.get(what, 0) + amount

    def observed(self, option: str, value: str) -> bool:
        """The framework took reading ``value`` of ``option``; False if its vendor declared another one."""
        self.readings.setdefault(option, set()).add(value)
        return self.claims.permits(option, value)

    def exercised(self, *requirements: str) -> None:
        """The requirements' condition really arose, and they were kept."""
        exercises = self.exercises
        for requirement in requirements:
            exercises[requirement] = exercises.get(requirement, 0) + 1

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
        self.exercised(requirement)
        self.findings.append(Finding(requirement, rule, cause, expected, observed, events, step, instead))

    def row(self, row: Row) -> RowTally:
        """The tally of ``row``."""
        known = self.tallies.get(id(row))
        if known is None:
            known = self.tallies[id(row)] = (row, RowTally())
        return known[1]

    def broken(self, row: Row) -> None:
        """An instance went a way that ``row`` forbids."""
        tally = self.row(row)
        tally.exercised += 1
        tally.violated += 1

    def fitted(self, fit: Fit) -> None:
        """An instance went a way that its row permits."""
        self.fits[fit] = self.fits.get(fit, 0) + 1

    def close(self) -> None:
        """The trace is over: add up what the fits exercised."""
        for fit, times in self.fits.items():
            tally = self.row(fit.row)
            tally.exercised += times
            if len(fit.readings) == 1:
                tally.readings.add(fit.readings[0])
            for requirement in fit.exercised:
                self.exercises[requirement] = self.exercises.get(requirement, 0) + times
        self.fits.clear()

    @property
    def rows(self) -> dict[str, RowTally]:
        """All tallies, by the rows' ids."""
        return {row.id: tally for row, tally in self.tallies.values()}
