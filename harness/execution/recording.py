"""Records a run while it goes on: whatever a campaign asks of its driver, and every answer, in order.

Only what decides is recorded. What the search for shorter scenarios tries is left out, but for what it finds.
"""

from __future__ import annotations

import datetime
import itertools
import time
from collections import deque
from collections.abc import Generator, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import replace

import msgspec

from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.adapters.contract.trace import Event, Trace
from ucm_cts.harness.execution import record as r
from ucm_cts.harness.execution.clock_gaps import ClockGaps
from ucm_cts.harness.execution.driver import Driver
from ucm_cts.harness.execution.driving import Allowance, Answer, Circumstances, Seconds
from ucm_cts.harness.execution.record import Record, RecordError, decoded, encoded
from ucm_cts.harness.execution.replaying import Departure, Replay
from ucm_cts.harness.hosting.host_watch import Limits, Usage
from ucm_cts.harness.hosting.locate import Endpoint
from ucm_cts.harness.results.foreign import LONGEST_STACKS, clean
from ucm_cts.harness.results.tally import Cause
from ucm_cts.harness.results.values import Incident

__all__ = ["Departure", "Record", "RecordError", "Recorder", "RecordingDriver", "Replay", "decoded", "encoded"]

_AFTER_TIME = b'"thread"'
"""What follows number and time in every event on the wire."""


class Recorder:
    """What happened so far, compactly."""

    def __init__(self) -> None:
        self._began = time.monotonic()
        self._started = datetime.datetime.now(datetime.UTC).isoformat(timespec="seconds")
        self._events: dict[bytes, int] = {}
        self._scenarios: dict[bytes, int] = {}
        self._entries: list[r.AnyEntry] = []
        self._last = 0
        self._suspended = 0

    @property
    def now(self) -> int:
        """Milliseconds since the recording began."""
        return int((time.monotonic() - self._began) * 1000)

    def add(self, entry: r.AnyEntry) -> None:
        """Add ``entry``, unless recording is suspended. What a process holds replaces what it held before."""
        if self._suspended:
            return
        if isinstance(entry, r.Counted) and self._entries and isinstance(self._entries[-1], r.Counted):
            self._entries.pop()
        self._entries.append(entry)

    @property
    def is_suspended(self) -> bool:
        """Nothing is added now."""
        return bool(self._suspended)

    @contextmanager
    def suspended(self) -> Iterator[None]:
        """Within it, nothing is added."""
        self._suspended += 1
        try:
            yield
        finally:
            self._suspended -= 1

    def scenario(self, disguised: Scenario) -> int:
        """The place of ``disguised`` among the scenarios."""
        return r.places_of(self._scenarios, [msgspec.json.encode(disguised)])[0]

    def trace(self, trace: Trace) -> tuple[tuple[int, ...], tuple[int, ...]]:
        """The events and the times of ``trace`` as an entry has them."""
        events = r.places_of(self._events, [_without_time(event) for event in trace])
        clock = [self._last, *(event.t for event in trace)]
        self._last = clock[-1]
        return events, tuple(after - before for before, after in itertools.pairwise(clock))

    def record(self, driver: Driver) -> Record:
        """The record of the run of ``driver``, which has ended."""
        identity = driver.identity
        heading = r.Heading(
            r.FORMAT,
            driver.seed,
            identity,
            clean(driver.adapter),
            self._started,
            driver.isolation,
            clean(driver.adapter_file),
            tuple(clean(warning) for warning in driver.warnings),
        )
        events = msgspec.json.decode(b"[" + b",".join(self._events) + b"]", type=tuple[Event, ...])
        return Record(heading, events, tuple(map(msgspec.Raw, self._scenarios)), tuple(self._entries))


def _without_time(event: Event) -> bytes:
    whole = msgspec.json.encode(event)
    return whole[: whole.index(b'"n":')] + b'"n":0,"t":0,' + whole[whole.index(_AFTER_TIME) :]


class _RecordedGaps(ClockGaps):
    def __init__(self, recorder: Recorder) -> None:
        super().__init__()
        self._recorder = recorder

    def longest(self, trace: Trace) -> int:
        found = super().longest(trace)
        if found:
            self._recorder.add(r.Stood(self._recorder.now, found))
        return found

    def contended(self, trace: Trace) -> int:
        found = super().contended(trace)
        if found:
            self._recorder.add(r.Contended(self._recorder.now, found))
        return found


class _RecordedSeconds(Seconds):
    def __init__(self, seconds: float, recorder: Recorder) -> None:
        super().__init__(seconds)
        self._recorder = recorder
        self._is_told = False

    def is_used_up(self) -> bool:
        is_over = self._is_told or super().is_used_up()
        if is_over and not self._is_told:
            self._recorder.add(r.UsedUp(self._recorder.now))
            self._is_told = True
        return is_over


class RecordingDriver(Driver):
    """A driver that tells ``recorder`` all that a campaign asks of it, and each answer."""

    def __init__(self, endpoint: Endpoint, seed: int, limits: Limits | None = None) -> None:
        super().__init__(endpoint, seed, limits)
        self.recorder = Recorder()
        self.gaps = _RecordedGaps(self.recorder)

    @property
    def record(self) -> Record:
        """The record of the run, which has ended."""
        return self.recorder.record(self)

    def run(self, cases: Iterable[tuple[str, Scenario]], insist: bool = False) -> Iterator[Answer]:
        waiting: deque[Scenario] = deque()
        drawn = 0

        def counted() -> Iterator[tuple[str, Scenario]]:
            nonlocal drawn
            for name, scenario in cases:
                waiting.append(scenario)
                drawn += 1
                yield name, scenario

        for given in super().run(counted(), insist):
            answer, recorder = replace(given, incident=_cleaned(given.incident)), self.recorder
            plain = waiting.popleft()
            if not recorder.is_suspended:
                place, trace = recorder.scenario(answer.disguised), recorder.trace(answer.trace)
                entry = r.Answered(recorder.now, answer.name, place, *trace, answer.stuck)
                more = {"incident": answer.incident, "is_whole": answer.is_whole, "apart": answer.scenario != plain}
                recorder.add(msgspec.structs.replace(entry, drawn=drawn, **more))
            drawn = 0
            yield answer

    def again(self, name: str, scenario: Scenario, circumstances: Circumstances) -> Answer:
        answer, recorder = super().again(name, scenario, circumstances), self.recorder
        if not recorder.is_suspended:
            place, trace = recorder.scenario(answer.disguised), recorder.trace(answer.trace)
            patience, one_core, after = float(circumstances.patience), circumstances.one_core, circumstances.after
            recorder.add(r.Repeated(recorder.now, name, place, *trace, answer.stuck, patience, one_core, after))
        return answer

    def many_times(self, name: str, scenario: Scenario) -> Generator[tuple[Answer, Usage | None], None, None]:
        recorder = self.recorder
        for answer, usage in super().many_times(name, scenario):
            place, trace = recorder.scenario(answer.disguised), recorder.trace(answer.trace)
            held = r.Usage(usage.threads, usage.files) if usage is not None else None
            recorder.add(r.InSeries(recorder.now, name, place, *trace, answer.stuck, held))
            yield answer, usage
        recorder.add(r.SeriesCut(recorder.now))

    def usages(self, seconds: float) -> Iterator[Usage]:
        for usage in super().usages(seconds):
            self.recorder.add(r.Counted(self.recorder.now, r.Usage(usage.threads, usage.files)))
            yield usage

    def allow(self, seconds: float) -> Allowance:
        return _RecordedSeconds(seconds, self.recorder)

    @contextmanager
    def tries(self) -> Iterator[None]:
        with self.recorder.suspended():
            yield

    def keep(self, cause: Cause, answer: Answer) -> None:
        recorder = self.recorder
        place, trace = recorder.scenario(answer.disguised), recorder.trace(answer.trace)
        words = self.disguise.words_in((answer.disguised, answer.trace, answer.incident))
        entry = r.Shorter(recorder.now, answer.name, place, *trace, answer.stuck, cause, answer.scenario, words)
        recorder.add(msgspec.structs.replace(entry, incident=answer.incident, is_whole=answer.is_whole))


def _cleaned(incident: Incident | None) -> Incident | None:
    """``incident`` with texts that can be written: what a host printed when it died may be anything."""
    if incident is None:
        return None
    detail, stacks = clean(incident.detail), clean(incident.stacks, LONGEST_STACKS)
    return msgspec.structs.replace(incident, detail=detail, stacks=stacks)
