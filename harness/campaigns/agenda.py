"""Which units of a campaign are still to be done, and which can be done now: a run is concluded when all its parts have ended."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

from ucm_cts.harness.campaigns.planning import RunOfPlan, Work
from ucm_cts.harness.campaigns.units import Unit, address


@dataclass(frozen=True)
class Due:
    """A unit that can be done now. ``needs``: the addresses of the results that it takes."""

    unit: Unit
    address: str
    needs: tuple[str, ...] = ()


@dataclass
class Agenda:
    """The units of ``work``; ``is_kept`` says of an address whether its result is there already.

    ``before``: how many results were there when it began; ``done``: how many came since.
    ``lost``: why units gave no result, by their addresses; ``names``: what units are called for people.
    ``conclusions``: the address of the last unit of each run whose parts have ended, by the run's name.
    """

    work: Work
    is_kept: Callable[[str], bool]
    before: int = 0
    done: int = 0
    lost: dict[str, str] = field(default_factory=dict)
    names: dict[str, str] = field(default_factory=dict)
    conclusions: dict[str, str] = field(default_factory=dict)
    _left: Counter[str] = field(default_factory=Counter)
    _runs_with: dict[str, list[RunOfPlan]] = field(default_factory=dict)

    def begin(self) -> Iterator[Due]:
        """What can be done at once. A unit that several runs share is asked for once."""
        for (seed, subject), trial in self.work.trials.items():
            self.names[address(trial)] = f"{subject}, seed {seed}"
        for run in self.work.runs:
            for part in run.parts:
                place = address(part)
                self._runs_with.setdefault(place, []).append(run)
                self.names[place] = f"{run.name}, purposes {part.first + 1} to {part.end}"
                self._left[run.name] += 1
        due = {address(unit): unit for unit in self.work.first()}
        for place, unit in due.items():
            if self.is_kept(place):
                self.before += 1
                yield from self._ended(place)
            else:
                yield Due(unit, place)

    def end(self, due: Due, problem: str = "") -> Iterator[Due]:
        """``due`` has ended, with a result or with a ``problem``. Yields what can be done now."""
        if problem:
            self.lost[due.address] = problem
        else:
            self.done += 1
        yield from self._ended(due.address)

    @property
    def number(self) -> int:
        """How many units there are, the last ones of runs included."""
        return len(self.names) + sum(run.name not in self.conclusions for run in self.work.runs)

    def _ended(self, place: str) -> Iterator[Due]:
        for run in self._runs_with.pop(place, ()):
            self._left[run.name] -= 1
            if self._left[run.name] == 0:
                yield from self._conclude(run)

    def _conclude(self, run: RunOfPlan) -> Iterator[Due]:
        conclusion = run.conclusion([part for part in run.parts if address(part) in self.lost])
        place = self.conclusions[run.name] = address(conclusion)
        is_new = place not in self.names
        self.names[place] = f"{run.name}, its conclusion"
        if not is_new:  # the same run under another name
            return
        if self.is_kept(place):
            self.before += 1
        elif conclusion.parts:
            yield Due(conclusion, place, tuple(map(address, conclusion.parts)))
        else:
            self.lost[place] = "none of its parts gave a result"
