"""Answers from the record of an earlier run, so that a campaign judges that run again without the product.

What a campaign asks for is compared with what the record holds. Where they part the replay ends with ``Departure``; a trace that cannot
be true is a problem and is not judged.
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
from ucm_cts.harness.execution.calls_apart import with_calls_apart
from ucm_cts.harness.execution.disguise import revealed_by
from ucm_cts.harness.execution.driving import Allowance, Answer, Circumstances, Disguising, lasting
from ucm_cts.harness.execution.plausibility import Plausibility
from ucm_cts.harness.hosting.host_watch import Limits, Usage
from ucm_cts.harness.results.foreign import one_line
from ucm_cts.harness.results.tally import Cause
from ucm_cts.harness.results.values import Incident, Isolation

T = TypeVar("T")
AnyPerformed = TypeVar("AnyPerformed", bound=r.Performed)

MOST_AHEAD = 200
"""How many scenarios may be asked for before they are answered."""

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
        self._entries = deque(record.entries)
        self._last = 0
        self._words: dict[str, str] | None = None
        self._plausible = Plausibility(record.heading.isolation, limits)

    @property
    def problems(self) -> list[str]:
        """What cannot be true, a line each."""
        return self._plausible.problems

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
        """Itself: it knows when the machine stood still."""
        return self

    def longest(self, trace: Trace) -> int:
        """Milliseconds that the machine stood still while ``trace`` came about, as the record says."""
        entry = self._entries[0] if trace and self._entries else None
        if not isinstance(entry, r.Stood):
            return 0
        self._entries.popleft()
        return entry.milliseconds

    def run(self, cases: Iterable[tuple[str, Scenario]], insist: bool = False) -> Iterator[Answer]:
        """The recorded answers to ``cases``. Raises ``Departure``."""
        source = iter(cases)
        waiting: deque[tuple[str, Scenario, Scenario]] = deque()

        def draw() -> bool:
            case = next(source, None)
            if case is not None:
                waiting.append((*case, self.disguise.scenario(case[1])))
            return case is not None

        while True:
            entry = self._entries[0] if self._entries else None
            for _ in range(entry.drawn) if isinstance(entry, r.Answered) else ():
                if not draw():
                    break  # the entry is of what is run next, or surplus
                if len(waiting) > MOST_AHEAD:
                    raise Departure(f"more than {MOST_AHEAD} scenarios were asked for at a time")
            if not waiting and not draw():
                return
            name, scenario, disguised = waiting.popleft()
            answered = self._take(r.Answered, name, "the answer to a scenario")
            if answered.apart:
                scenario = with_calls_apart(scenario)
                disguised = self.disguise.scenario(scenario)
            self._compare(answered, name, disguised)
            trace = self._trace(answered)
            answer = Answer(
                name, scenario, disguised, trace, answered.incident, answered.is_whole, stuck=answered.stuck
            )
            if not self._plausible.take_answer(answered.at, answer):
                answer = Answer(name, scenario, disguised, (), IMPOSSIBLE)
            yield answer

    def again(self, name: str, scenario: Scenario, circumstances: Circumstances) -> Answer:
        """The recorded second look. Raises ``Departure`` if there is none."""
        scaled = lasting(scenario, circumstances.patience)
        disguised = self.disguise.scenario(scaled)
        entry = self._take(r.Repeated, name, "a second look at a scenario")
        if Circumstances(entry.patience, entry.one_core, entry.after) != circumstances:
            raise Departure(f"the second look at {_shown(name)} was in other circumstances than those that are due")
        self._compare(entry, name, disguised)
        answer = Answer(name, scaled, disguised, self._trace(entry), stuck=entry.stuck)
        return self._believed(entry.at, answer, "again")

    def many_times(self, name: str, scenario: Scenario) -> Generator[tuple[Answer, Usage | None], None, None]:
        """The recorded series of runs on one host. Raises ``Departure`` if it is cut."""
        while True:
            disguised = self.disguise.scenario(scenario)
            if self._entries and isinstance(self._entries[0], r.SeriesCut):
                self._entries.popleft()
                return
            entry = self._take(r.InSeries, name, "a run of a series on one host")
            self._compare(entry, name, disguised)
            answer = self._believed(entry.at, Answer(name, scenario, disguised, self._trace(entry)), "series")
            yield answer, Usage(entry.usage.threads, entry.usage.files) if entry.usage is not None else None

    def usages(self, seconds: float) -> Iterator[Usage]:
        """What the process of the host held last."""
        while self._entries and isinstance(self._entries[0], r.Counted):
            entry = self._entries.popleft()
            assert isinstance(entry, r.Counted)
            yield Usage(entry.usage.threads, entry.usage.files)

    def allow(self, seconds: float) -> Allowance:
        """Time that was used up where the record says so, if its other times show it."""
        return _RecordedSeconds(self, seconds)

    def is_used_up(self, since: float, seconds: float) -> bool:
        """Does the record say so here? It is a problem if no ``seconds`` can have passed since ``spent`` was ``since``."""
        entry = self._entries[0] if self._entries else None
        if not isinstance(entry, r.UsedUp):
            return False
        self._entries.popleft()
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
        while self._entries and isinstance(self._entries[0], r.Shorter):
            entry = self._entries.popleft()
            assert isinstance(entry, r.Shorter)
            try:
                disguised = msgspec.json.decode(self._record.scenario(entry), type=Scenario)
                if list(map(operation, disguised.steps)) != list(map(operation, entry.plain.steps)):
                    raise Departure(f"{_where(entry)} is not the scenario that it was made of")
                answer = Answer(
                    entry.name,
                    entry.plain,
                    disguised,
                    self._trace(entry),
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
        if self._entries:
            raise Departure(f"the record goes on after the end of the run, with {_where(self._entries[0])}")

    def reveal(self, value: T) -> T:
        """``value`` in the script's own names."""
        return super().reveal(value) if self._words is None else revealed_by(self._words, value)

    def _take(self, kind: type[AnyPerformed], name: str, what: str) -> AnyPerformed:
        entry = self._entries[0] if self._entries else None
        if not isinstance(entry, kind):
            instead = f"there is {_where(entry)}" if entry is not None else "the record ends"
            raise Departure(f"{what} is missing, {_shown(name)}: {instead}")
        self._entries.popleft()
        return entry

    def _compare(self, entry: r.Performed, name: str, disguised: Scenario) -> None:
        if entry.name != name:
            raise Departure(
                f"{_where(entry)} stands where {_shown(name)} is due: scenarios are missing, surplus or in another order"
            )
        if self._record.scenario(entry) != msgspec.json.encode(disguised):
            raise Departure(
                f"{_where(entry)} is another scenario than the one of this suite, profile, statement and seed"
            )

    def _trace(self, entry: r.Performed) -> Trace:
        trace = self._record.trace(entry, self._last)
        self._last = trace[-1].t if trace else self._last
        return trace

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


def _where(entry: r.Entry) -> str:
    """An entry, in words."""
    if isinstance(entry, r.Performed):
        kind = {r.Repeated: "the second look at ", r.InSeries: "the series of "}.get(type(entry), "")
        return f"{kind}{_shown(entry.name)}"
    return f"an entry of kind '{entry.__struct_config__.tag}'"
