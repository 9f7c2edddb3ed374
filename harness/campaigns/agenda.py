"""Which units of a campaign are still to be done, and which can be done now: a run is concluded when all its parts have ended."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

from ucm_cts.harness.campaigns.planning import RunOfPlan, Work
from ucm_cts.harness.campaigns.units import Conclusion, Slice, Unit, address


@dataclass(frozen=True)
class Due:
    """A unit that can be done now. ``needs``: the addresses of the results that it takes."""

    unit: Unit
    address: str
    needs: tuple[str, ...] = ()


@dataclass
class Agenda:
    """The units of ``work``; ``is_kept`` says of an address whether its result is there already.

    ``lost``: why units gave no result, by their addresses. ``before``: how many results were there before.
    """

    work: Work
    is_kept: Callable[[str], bool]
    lost: dict[str, str] = field(default_factory=dict)
    conclusions: dict[str, str] = field(default_factory=dict)
    """The address of each run's conclusion, by the run's name, once its parts have ended."""
    before: int = 0
    done: int = 0
    _left: Counter[str] = field(default_factory=Counter)
    _runs_with: dict[str, list[RunOfPlan]] = field(default_factory=dict)

    def begin(self) -> Iterator[Due]:
        """What can be done at once. Units that several runs share are asked for once."""
        for run in self.work.runs:
            for part in run.parts:
                runs = self._runs_with.setdefault(address(part), [])
                if run not in runs:
                    runs.append(run)
                    self._left[run.name] += 1
        asked: set[str] = set()
        for unit in self.work.first():
            place = address(unit)
            if place in asked:
                continue
            asked.add(place)
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

    def _ended(self, place: str) -> Iterator[Due]:
        for run in self._runs_with.pop(place, ()):
            self._left[run.name] -= 1
            if self._left[run.name] == 0:
                yield from self._conclude(run)

    def _conclude(self, run: RunOfPlan) -> Iterator[Due]:
        conclusion = run.conclusion([part for part in run.parts if address(part) in self.lost])
        place = self.conclusions[run.name] = address(conclusion)
        if self.is_kept(place):
            self.before += 1
        elif conclusion.parts:
            yield Due(conclusion, place, tuple(map(address, conclusion.parts)))
        else:
            self.lost[place] = "none of its parts gave a result"


def name_of(unit: Unit, work: Work) -> str:
    """What ``unit`` is called for people: the run that it is of and which part, or the subject of a trial."""
    if isinstance(unit, Slice | Conclusion):
        run = next((one for one in work.runs if one.run == unit.run), None)
        name = run.name if run is not None else unit.run.adapter
        return (
            f"{name}, purposes {unit.first + 1} to {unit.end}" if isinstance(unit, Slice) else f"{name}, its conclusion"
        )
    return next((f"{subject}, seed {seed}" for (seed, subject), one in work.trials.items() if one == unit), "a trial")
