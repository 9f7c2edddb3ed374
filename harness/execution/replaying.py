"""Answers from the record of an earlier run, so that a campaign judges that run again without the product.

What a campaign asks for is compared with what the record holds. Where they part, or a trace cannot be true, that is a problem, nothing
is judged there, and the replay goes on with the next scenario that both have. ``Departure`` ends it where nothing fits any more.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Generator, Iterable, Iterator
from contextlib import AbstractContextManager, nullcontext
from typing import Literal, TypeVar

import msgspec

from ucm_cts.adapters.contract.messages import Welcome
from ucm_cts.adapters.contract.scenario import Scenario, operation
from ucm_cts.adapters.contract.trace import Trace
from ucm_cts.harness.execution import record as r
from ucm_cts.harness.execution.alignment import Alignment, Placed
from ucm_cts.harness.execution.calls_apart import with_calls_apart
from ucm_cts.harness.execution.confirmation import TROUBLE
from ucm_cts.harness.execution.disguise import revealed_by
from ucm_cts.harness.execution.driving import Allowance, Answer, Circumstances, Disguising, lasting
from ucm_cts.harness.execution.plausibility import Plausibility
from ucm_cts.harness.hosting.host_watch import Limits, Usage
from ucm_cts.harness.results.foreign import one_line
from ucm_cts.harness.results.tally import Cause
from ucm_cts.harness.results.values import Incident, Isolation

T = TypeVar("T")

MOST_MISSING, MOST_OTHERS = 20, 3
"""After so many scenarios in a row that are missing, or are others, the record is of something else."""

IMPOSSIBLE = Incident("contradiction", "the recorded trace cannot be true")
"""In place of a trace that is not judged."""


class Departure(Exception):
    """The record is not of the run that is judged again. The message is one line."""


class Replay(Disguising):
    """Answers what a campaign asks for from ``record``, as a driver answered then. ``problems`` tells what cannot be true."""

    def __init__(self, record: r.Record, seed: int, limits: Limits) -> None:
        super().__init__(seed)
        self.adapter = record.heading.adapter
        self._record = record
        self._heading = record.heading
        self._entries = Alignment(record.entries)
        self._drawn_for: r.Entry | None = None
        self._in_a_row = 0
        self._is_out_of_step = False
        self._second_looks = 0
        self._untraced = 0
        self._gaps = 0
        self._contentions = 0
        self.is_drawing = False
        """Do the scenarios that are asked for follow from the traces before?"""
        self._words: dict[str, str] | None = None
        self._plausible = Plausibility(record.heading.isolation, limits)

    @property
    def problems(self) -> list[str]:
        """What cannot be true, a line each."""
        return self._plausible.problems

    @property
    def unshown(self) -> tuple[str, ...]:
        """What the record says and no trace in it shows, as clauses that begin with "that"."""
        looks = (
            f"that {self._untraced} of {self._second_looks} second looks gave no trace: one may have shown a failure"
        )
        gaps = f"that the machine stood still {self._gaps} times: a failure at that time that depends on time does not count"
        short = f"that the machine had too few processors {self._contentions} times: lateness that was seen once then does not count"
        said = ((looks, self._untraced), (gaps, self._gaps), (short, self._contentions))
        return tuple(text for text, is_so in said if is_so)

    @property
    def identity(self) -> Welcome:
        """The implementation under test."""
        return self._heading.identity

    @property
    def adapter_file(self) -> str:
        """The file that the adapter was loaded from."""
        return self._heading.adapter_file

    @property
    def isolation(self) -> Isolation:
        """Where the code of the product ran."""
        return self._heading.isolation

    @property
    def warnings(self) -> tuple[str, ...]:
        """What the vendor should know of the adapter."""
        return self._heading.warnings

    @property
    def started(self) -> str:
        """When the run began."""
        return self._heading.started

    @property
    def gaps(self) -> Replay:
        """Itself: it knows when the machine stood still, or had too few processors."""
        return self

    def longest(self, trace: Trace) -> int:
        """Milliseconds that the machine stood still while ``trace`` came about, as the record says."""
        found = self._told(r.Stood, trace)
        self._gaps += found > 0
        return found

    def contended(self, trace: Trace) -> int:
        """Milliseconds for which threads waited for a processor while ``trace`` came about, as the record says."""
        found = self._told(r.Contended, trace)
        self._contentions += found >= TROUBLE
        self._plausible.take_contention(found, trace)
        return found

    def _told(self, kind: type[r.Stood | r.Contended], trace: Trace) -> int:
        entry = self._entries.head if trace else None
        if not isinstance(entry, kind):
            return 0
        self._entries.pop()
        return entry.milliseconds

    def run(self, cases: Iterable[tuple[str, Scenario]], insist: bool = False) -> Iterator[Answer]:
        """The recorded answers to ``cases``. Raises ``Departure`` where nothing fits any more."""
        source = iter(cases)
        waiting: deque[tuple[str, Scenario, Scenario]] = deque()
        self._drawn_for = None  # the run before may have met the first entry of this one

        def draw() -> bool:
            case = next(source, None)
            if case is not None:
                waiting.append((*case, self.disguise.scenario(case[1])))
            return case is not None

        while True:
            entry = self._entries.head
            is_new, self._drawn_for = entry is not self._drawn_for, entry
            for _ in range(entry.drawn) if isinstance(entry, r.Answered) and is_new else ():
                if not draw():
                    break  # the entry is of what is run next, or surplus
                if len(waiting) > r.MOST_AHEAD:
                    raise Departure(f"more than {r.MOST_AHEAD} scenarios were asked for at a time")
            if not waiting and not draw():
                return
            yield self._answer(*waiting.popleft())

    def _answer(self, name: str, scenario: Scenario, disguised: Scenario) -> Answer:
        """The recorded answer; if it is not believed, one that says so."""
        placed, problem = self._due(name)
        if placed is None:
            self._is_out_of_step = True
            return self._doubted(Answer(name, scenario, disguised, (), IMPOSSIBLE), problem, MOST_MISSING)
        answered = placed.entry
        assert isinstance(answered, r.Answered)
        if answered.apart:
            scenario = with_calls_apart(scenario)
            disguised = self.disguise.scenario(scenario)
        nothing = Answer(name, scenario, disguised, (), IMPOSSIBLE)
        problem = problem or self._unlike(answered, disguised)
        if problem:
            return self._doubted(nothing, problem, MOST_OTHERS)
        self._in_a_row = 0
        trace = self._record.trace(answered, placed.last)
        answer = Answer(name, scenario, disguised, trace, answered.incident, answered.is_whole, stuck=answered.stuck)
        return answer if self._plausible.take_answer(answered.at, answer) else nothing

    def _due(self, name: str) -> tuple[Placed | None, str]:
        """The entry of the answer that is due, and what is wrong with its place. Raises ``Departure`` at the end of the record."""
        if not self._entries.has(name):
            if self._entries.has_answers:
                return None, f"the answer to {_shown(name)} is missing from the record"
            raise Departure(
                f"the answer to {_shown(name)}, and all that follow, are missing: {_instead(self._entries.head)}"
            )
        while not isinstance(entry := self._entries.head, r.Answered | None):
            if not self.problems:  # else it may belong to what is not judged
                self._plausible.tell(f"{_where(entry)} stands where the answer to {_shown(name)} is due")
            self._entries.pop()
        before = frozenset(self._entries.set_aside)
        in_place = self._entries.bring(name)
        for one in self._entries.set_aside:
            if one not in before:
                self._plausible.tell(
                    f"the answer to {_shown(one)} stands where {_shown(name)} is due: it is surplus, or in another order"
                )
        placed = self._entries.pop()
        return placed, "" if in_place else f"the answer to {_shown(name)} stands in another place than it is due"

    def _doubted(self, answer: Answer, problem: str, most_in_a_row: int) -> Answer:
        """Tell the ``problem`` of an ``answer`` without a believable trace, and return it.

        Raises ``Departure`` where earlier problems explain this one: among drawn scenarios, or after ``most_in_a_row``.
        """
        if self.is_drawing and self.problems:
            raise Departure(
                f"drawn scenarios were compared up to {_shown(answer.name)}: they follow from the traces before"
            )
        self._plausible.tell(problem)
        self._in_a_row += 1
        if self._in_a_row >= most_in_a_row:
            raise Departure(f"{self._in_a_row} scenarios in a row are missing or others; what follows was not compared")
        return answer

    def again(self, name: str, scenario: Scenario, circumstances: Circumstances) -> Answer:
        """The recorded second look; without a trace if there is none that is believed."""
        scaled = lasting(scenario, circumstances.patience)
        disguised = self.disguise.scenario(scaled)
        nothing = Answer(name, scaled, disguised, ())
        entry = self._entries.head
        if isinstance(entry, r.Repeated) and entry.name == name:
            placed: Placed | None = self._entries.pop()
        else:
            placed = self._entries.take_second_look(name) if self.problems else None
        if placed is None:
            if not self.problems:  # else this one may follow from what is not judged
                self._plausible.tell(f"a second look at a scenario is missing, {_shown(name)}: {_instead(entry)}")
            return nothing
        entry = placed.entry
        assert isinstance(entry, r.Repeated)
        problem = self._unlike(entry, disguised)
        if Circumstances(entry.patience, entry.one_core, entry.after) != circumstances:
            problem = f"the second look at {_shown(name)} was in other circumstances than those that are due"
        if problem:
            self._plausible.tell(problem)
            return nothing
        trace = self._record.trace(entry, placed.last)
        self._second_looks += 1
        self._untraced += not trace
        return self._believed(entry.at, Answer(name, scaled, disguised, trace, stuck=entry.stuck), "again")

    def many_times(self, name: str, scenario: Scenario) -> Generator[tuple[Answer, Usage | None], None, None]:
        """The recorded series of runs on one host; it ends where the record has no more of it."""
        while True:
            disguised = self.disguise.scenario(scenario)
            entry = self._entries.head
            if isinstance(entry, r.SeriesCut):
                self._entries.pop()
                return
            if not isinstance(entry, r.InSeries) or entry.name != name:
                self._plausible.tell(f"a run of a series on one host is missing, {_shown(name)}: {_instead(entry)}")
                return
            last = self._entries.pop().last
            problem = self._unlike(entry, disguised)
            if problem:
                self._plausible.tell(problem)
                return
            answer = Answer(name, scenario, disguised, self._record.trace(entry, last))
            held = Usage(entry.usage.threads, entry.usage.files) if entry.usage is not None else None
            yield self._believed(entry.at, answer, "series"), held

    def usages(self, seconds: float) -> Iterator[Usage]:
        """What the process of the host held last."""
        while isinstance(entry := self._entries.head, r.Counted):
            self._entries.pop()
            yield Usage(entry.usage.threads, entry.usage.files)

    def allow(self, seconds: float) -> Allowance:
        """Time that was used up where the record says so, if its other times show it."""
        return _RecordedSeconds(self, seconds)

    def is_used_up(self, since: float, seconds: float) -> bool:
        """Does the record say so here? It is a problem if no ``seconds`` can have passed since ``spent`` was ``since``."""
        entry = self._entries.head
        if not isinstance(entry, r.UsedUp):
            return False
        self._entries.pop()
        self._plausible.take_used_up(entry.at, since, seconds)
        return True

    @property
    def spent(self) -> float:
        """Milliseconds that the entries taken so far account for."""
        return self._plausible.spent

    def tries(self) -> AbstractContextManager[None]:
        """Nothing is tried again."""
        return nullcontext()

    def keep(self, cause: Cause, answer: Answer) -> None:
        """Nothing is recorded again."""

    def shorter(self) -> Iterator[tuple[Cause, Answer]]:
        """The shorter scenarios that were found, to be revealed before the next one is asked for."""
        while isinstance(entry := self._entries.head, r.Shorter):
            last = self._entries.pop().last
            try:
                disguised = msgspec.json.decode(self._record.scenario(entry), type=Scenario)
                if list(map(operation, disguised.steps)) != list(map(operation, entry.plain.steps)):
                    raise Departure(f"{_where(entry)} is not the scenario that it was made of")
                answer = Answer(
                    entry.name,
                    entry.plain,
                    disguised,
                    self._record.trace(entry, last),
                    entry.incident,
                    entry.is_whole,
                    stuck=entry.stuck,
                )
                if not self._plausible.take_answer(entry.at, answer):
                    continue
                self._words = entry.words
                yield entry.cause, answer
            except (msgspec.MsgspecError, UnicodeError, RecursionError):
                raise Departure(f"{_where(entry)} cannot be read") from None
            finally:
                self._words = None

    def end(self) -> None:
        """All must have been asked for. Raises ``Departure`` if the record goes on."""
        if self._entries.head is not None:
            raise Departure(f"the record goes on after the end of the run, with {_where(self._entries.head)}")

    def reveal(self, value: T) -> T:
        """``value`` in the script's own names."""
        return super().reveal(value) if self._words is None else revealed_by(self._words, value)

    def _unlike(self, entry: r.Performed, disguised: Scenario) -> str:
        """What is wrong with the scenario of ``entry``, where ``disguised`` is due; empty if nothing is."""
        if self._record.scenario(entry) == msgspec.json.encode(disguised):
            return ""
        if self._is_out_of_step:
            raise Departure(
                f"from {_where(entry)} on nothing was compared: names are drawn in the order in which scenarios are asked for"
            )
        return f"{_where(entry)} is another scenario than the one of this suite, profile, statement and seed"

    def _believed(self, at: int, answer: Answer, source: Literal["again", "series"]) -> Answer:
        if self._plausible.take_further(at, answer, source):
            return answer
        return Answer(answer.name, answer.scenario, answer.disguised, ())


class _RecordedSeconds:
    def __init__(self, replay: Replay, seconds: float) -> None:
        self._replay = replay
        self._seconds = seconds
        self._since = replay.spent
        self._is_over = False

    def is_used_up(self) -> bool:
        self._is_over = self._is_over or self._replay.is_used_up(self._since, self._seconds)
        return self._is_over


def _shown(name: str) -> str:
    return f"'{one_line(name, 80)}'"


def _instead(entry: r.Entry | None) -> str:
    return f"there is {_where(entry)}" if entry is not None else "the record ends"


def _where(entry: r.Entry) -> str:
    """An entry, in words."""
    if isinstance(entry, r.Performed):
        kind = {r.Repeated: "the second look at ", r.InSeries: "the series of "}.get(type(entry), "")
        return f"{kind}{_shown(entry.name)}"
    return f"an entry of kind '{entry.__struct_config__.tag}'"
