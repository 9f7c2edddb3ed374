"""The verdicts on one trace: requirements exercised, violations found, rows of the life-cycle table visited."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from ucm_cts.reference_models.conclusions import Broken, Concluded, Kept, Measured, Suspended, Taken
from ucm_cts.reference_models.findings import Finding
from ucm_cts.reference_models.model.expected_callbacks import Fit
from ucm_cts.reference_models.model.life_cycle import Row
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.runtime import Member
from ucm_cts.reference_models.properties.declaration import Bound


@dataclass(slots=True)
class RowTally:
    """How one row of the life-cycle table fared in one trace."""

    exercised: int = 0
    violated: int = 0
    readings: set[str] = field(default_factory=set)


@dataclass(slots=True)
class Verdicts:
    """The verdicts on one trace.

    ``exercises``: how often the condition of each requirement arose.
    ``readings``: which readings the framework took, by option.
    ``measures``: amounts worth adding up over a run.
    ``tallies``, ``fits``: how rows of the life-cycle table fared.
    ``suspended``: members whose state is not known after the event being read.
    """

    exercises: dict[str, int] = field(default_factory=dict)
    findings: list[Finding] = field(default_factory=list)
    tallies: dict[int, tuple[Row, RowTally]] = field(default_factory=dict)
    fits: dict[Fit, int] = field(default_factory=dict)
    readings: dict[str, set[str]] = field(default_factory=dict)
    measures: dict[str, int] = field(default_factory=dict)
    suspended: list[Member] = field(default_factory=list)

    def evaluate(self, runtime: ObservedRuntime, properties: tuple[Bound, ...], *details: object) -> None:
        """Add what ``properties`` conclude from ``details``."""
        exercises = self.exercises
        for evaluate, one in properties:
            concluded = evaluate(one, runtime, *details)
            if not concluded:  # most properties have nothing to say
                continue
            if type(concluded) is str:
                exercises[concluded] = exercises.get(concluded, 0) + 1
            else:
                self.add(concluded)

    def evaluate_with(self, runtime: ObservedRuntime, properties: tuple[Bound, ...], detail: object) -> None:
        """The same with one detail, for the moments that come often: a call with a fixed number of arguments takes half the time."""
        exercises = self.exercises
        for evaluate, one in properties:
            concluded = evaluate(one, runtime, detail)
            if not concluded:
                continue
            if type(concluded) is str:
                exercises[concluded] = exercises.get(concluded, 0) + 1
            elif type(concluded) is Fit:
                self.fits[concluded] = self.fits.get(concluded, 0) + 1
            else:
                self.add(concluded)

    def add(self, concluded: Concluded) -> None:
        """Add what a property concludes."""
        add_one = _ADD.get(type(concluded))
        if add_one is not None:
            add_one(self, concluded)
            return
        exercises = self.exercises
        for one in concluded:  # type: ignore[union-attr]
            if type(one) is str:
                exercises[one] = exercises.get(one, 0) + 1
            elif type(one) is Fit:
                self.fits[one] = self.fits.get(one, 0) + 1
            else:
                _ADD[type(one)](self, one)

    def _keep(self, requirement: Kept) -> None:
        self.exercises[requirement] = self.exercises.get(requirement, 0) + 1

    def _fail(self, finding: Finding) -> None:
        """A requirement was violated: it was exercised, too."""
        self._keep(finding.requirement)
        self.findings.append(finding)

    def _take(self, taken: Taken) -> None:
        self.readings.setdefault(taken.option, set()).add(taken.value)

    def _measure(self, measured: Measured) -> None:
        self.measures[measured.what] = self.measures.get(measured.what, 0) + measured.amount

    def _fit(self, fit: Fit) -> None:
        self.fits[fit] = self.fits.get(fit, 0) + 1

    def _break(self, broken: Broken) -> None:
        tally = self._tally(broken.row)
        tally.exercised += 1
        tally.violated += 1

    def _suspend(self, suspended: Suspended) -> None:
        self.suspended.append(suspended.member)

    def _tally(self, row: Row) -> RowTally:
        known = self.tallies.get(id(row))
        if known is None:
            known = self.tallies[id(row)] = (row, RowTally())
        return known[1]

    def close(self) -> None:
        """The trace is over: add up what the fits exercised."""
        for fit, times in self.fits.items():
            tally = self._tally(fit.row)
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


_ADD: dict[type[Any], Callable[[Verdicts, Any], None]] = {
    str: Verdicts._keep,
    Finding: Verdicts._fail,
    Taken: Verdicts._take,
    Measured: Verdicts._measure,
    Fit: Verdicts._fit,
    Broken: Verdicts._break,
    Suspended: Verdicts._suspend,
}
