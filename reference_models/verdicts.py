"""What a monitor makes of one trace: requirements exercised, violations found, rows of the table visited."""

from __future__ import annotations

from dataclasses import dataclass, field

from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.reference_models.findings import Arrow, Finding
from ucm_cts.reference_models.model.expected_callbacks import ExpectedCallbacks, Fit
from ucm_cts.reference_models.model.ics import Ics
from ucm_cts.reference_models.model.life_cycle import Row


@dataclass(slots=True)
class RowTally:
    """How one row of the life-cycle table fared in one trace."""

    exercised: int = 0
    violated: int = 0
    readings: set[str] = field(default_factory=set)


@dataclass(slots=True)
class Verdicts:
    """The judgement of one trace in the making."""

    scenario: Scenario
    expected: ExpectedCallbacks
    exercises: dict[str, int] = field(default_factory=dict)
    findings: list[Finding] = field(default_factory=list)
    tallies: dict[int, tuple[Row, RowTally]] = field(default_factory=dict)
    fits: dict[Fit, int] = field(default_factory=dict)
    ics: Ics = field(default_factory=Ics)
    readings: dict[str, set[str]] = field(default_factory=dict)
    measures: dict[str, int] = field(default_factory=dict)

    def measured(self, what: str, amount: int = 1) -> None:
        """Something worth adding up over a run: how much effort was behind verdicts."""
        self.measures[what] = self.measures.get(what, 0) + amount

    def observed(self, option: str, value: str) -> bool:
        """The framework took reading ``value`` of ``option``; False if its vendor declared another one."""
        self.readings.setdefault(option, set()).add(value)
        return self.ics.permits(option, value)

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
