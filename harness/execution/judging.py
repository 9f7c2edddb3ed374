"""Judges the answers of a driver, in their order: here, or for the most part in a process on another core."""

from __future__ import annotations

import functools
import multiprocessing
import os
import signal
import sys
import threading
import time
from collections import deque
from collections.abc import Iterable, Iterator, Sequence
from concurrent.futures import Future
from contextlib import suppress
from multiprocessing.connection import Connection
from queue import SimpleQueue
from typing import Self

import msgspec

from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.adapters.contract.trace import Trace
from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.catalogue.requirements import load_life_cycle
from ucm_cts.harness.execution.driving import Answer
from ucm_cts.reference_models.findings import Finding
from ucm_cts.reference_models.model.ics import Ics
from ucm_cts.reference_models.model.life_cycle import Row
from ucm_cts.reference_models.monitor import Monitor
from ucm_cts.reference_models.verdicts import RowTally, Verdicts

Judged = tuple[Answer, Verdicts | None]
"""An answer, and the verdicts on its trace; None after an incident."""

A_BATCH = 32
"""How many answers go to the other process at a time."""

SOON = 0.2
"""Seconds after which answers are judged although they are fewer."""

MOST_BATCHES = 8
"""When so many are there, answers are judged here."""


class Judge:
    """Judges in the calling thread, with ``monitor``."""

    def __init__(self, ics: Ics) -> None:
        self.monitor = Monitor(load_life_cycle(), ics)

    def judged(self, answers: Iterable[Answer], at_once: bool = True) -> Iterator[Judged]:
        """All ``answers``, in their order, with the verdicts on their traces; ``at_once``: before the next answer is asked for."""
        return map(self._judged, answers)

    def _judged(self, answer: Answer) -> Judged:
        return answer, self.monitor.judge(answer.disguised, answer.trace) if answer.incident is None else None


class SideJudge(Judge):
    """Has a process beside this one judge, too. The verdicts are the same: they follow from scenario and trace alone.

    Verdicts come a while after their answers, so a run that is recorded has none. Make it before there are other threads, as the process
    is a fork of this one; use it in a ``with`` statement. It ends with this process.
    """

    def __init__(self, ics: Ics) -> None:
        super().__init__(ics)
        self._process = _Process(self.monitor)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:
        self._process.close()

    def judged(self, answers: Iterable[Answer], at_once: bool = True) -> Iterator[Judged]:
        return super().judged(answers) if at_once else self._judged_in_batches(answers)

    def _judged_in_batches(self, answers: Iterable[Answer]) -> Iterator[Judged]:
        batches: deque[tuple[list[Answer], Future[bytes] | list[Judged]]] = deque()
        batch: list[Answer] = []
        began = time.monotonic()
        interrupt: KeyboardInterrupt | None = None
        for answer in _until_interrupted(answers):
            if isinstance(answer, KeyboardInterrupt):
                interrupt = answer  # nothing that was answered is lost
                break
            batch.append(answer)
            is_late = time.monotonic() - began > SOON
            if is_late or len(batch) == A_BATCH:
                aside = not is_late and len(batches) < MOST_BATCHES
                batches.append((batch, self._begun(batch) if aside else self._judged_here(batch)))
                batch, began = [], time.monotonic()
            while batches and (is_late or isinstance(done := batches[0][1], list) or done.done()):
                yield from self._end(*batches.popleft())
        for one in batches:
            yield from self._end(*one)
        yield from super().judged(batch)
        if interrupt is not None:
            raise interrupt

    def _begun(self, batch: Sequence[Answer]) -> Future[bytes]:
        return self._process.submit([(answer.disguised, answer.trace) for answer in batch if answer.incident is None])

    def _judged_here(self, batch: Sequence[Answer]) -> list[Judged]:
        return list(super().judged(batch))

    def _end(self, batch: Sequence[Answer], begun: Future[bytes] | list[Judged]) -> Iterable[Judged]:
        if isinstance(begun, list):
            return begun
        content = begun.result()
        if not content:
            return self._judged_here(batch)
        results = iter(_DECODER.decode(content))
        return [(answer, next(results).verdicts() if answer.incident is None else None) for answer in batch]


def _until_interrupted(answers: Iterable[Answer]) -> Iterator[Answer | KeyboardInterrupt]:
    """``answers``, and the interrupt that ends them, if one does."""
    try:
        yield from answers
    except KeyboardInterrupt as interrupt:
        yield interrupt


def may_judge_aside() -> bool:
    """Is there another core, and a system on which a process can be a fork of this one?"""
    return sys.platform == "linux" and len(os.sched_getaffinity(0)) > 1


class _Row(Value, frozen=True):
    """How one row of the life-cycle table fared, as in ``RowTally``."""

    exercised: int
    violated: int
    readings: tuple[str, ...]


class _Result(Value, frozen=True):
    """``Verdicts`` of a trace that is over, as a value. ``rows``: by their ids."""

    exercises: dict[str, int]
    findings: tuple[Finding, ...]
    rows: dict[str, _Row]
    readings: dict[str, tuple[str, ...]]
    measures: dict[str, int]

    def verdicts(self) -> Verdicts:
        """The verdicts."""
        rows = _rows()
        tallies = {
            id(rows[name]): (rows[name], RowTally(one.exercised, one.violated, set(one.readings)))
            for name, one in self.rows.items()
        }
        readings = {option: set(values) for option, values in self.readings.items()}
        return Verdicts(self.exercises, list(self.findings), tallies, {}, readings, self.measures)


@functools.cache
def _rows() -> dict[str, Row]:
    return {row.id: row for row in load_life_cycle().rows}


def _result(verdicts: Verdicts) -> _Result:
    return _Result(
        verdicts.exercises,
        tuple(verdicts.findings),
        {name: _Row(one.exercised, one.violated, tuple(one.readings)) for name, one in verdicts.rows.items()},
        {option: tuple(values) for option, values in verdicts.readings.items()},
        verdicts.measures,
    )


_DECODER = msgspec.json.Decoder(list[_Result])
_BATCH = msgspec.json.Decoder(list[tuple[Scenario, Trace]])


class _Process:
    """A process that judges batches, one after the other. A future is empty if it did not: it may have been killed, for want of memory.

    One thread writes to it and one reads, so that neither end ever waits for the other to read.
    """

    def __init__(self, monitor: Monitor) -> None:
        context = multiprocessing.get_context("fork")
        self._ours, theirs = context.Pipe()
        self._process = context.Process(target=_serve, args=(monitor, self._ours, theirs), daemon=True)
        self._process.start()
        theirs.close()
        self._batches: SimpleQueue[tuple[bytes, Future[bytes]] | None] = SimpleQueue()
        self._asked: SimpleQueue[Future[bytes] | None] = SimpleQueue()
        self._threads = [threading.Thread(target=one, daemon=True) for one in (self._write, self._read)]
        for thread in self._threads:
            thread.start()

    def submit(self, batch: Sequence[tuple[Scenario, Trace]]) -> Future[bytes]:
        """Judge it when those before are judged."""
        future: Future[bytes] = Future()
        self._batches.put((msgspec.json.encode(batch), future))
        return future

    def close(self) -> None:
        """End the process. What it has not judged will not be judged."""
        self._process.kill()
        self._batches.put(None)
        for thread in self._threads:
            thread.join()
        self._process.join()
        self._process.close()
        self._ours.close()

    def _write(self) -> None:
        while (asked := self._batches.get()) is not None:
            batch, future = asked
            self._asked.put(future)
            with suppress(OSError):  # it has ended, which reading shows
                self._ours.send_bytes(batch)
        self._asked.put(None)

    def _read(self) -> None:
        while (future := self._asked.get()) is not None:
            result = b""
            with suppress(OSError, EOFError):
                result = self._ours.recv_bytes()
            future.set_result(result)


def _serve(monitor: Monitor, theirs: Connection, ours: Connection) -> None:
    """What the process does: judge scenarios with their traces, a ``_Result`` for each, until the process of which it is a fork ends."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # whoever interrupts the run means the other one
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    theirs.close()
    with suppress(OSError, EOFError):
        while True:
            content = ours.recv_bytes()
            try:
                batch = _BATCH.decode(content)
                results = [_result(monitor.judge(*one)) for one in batch]
            except Exception:  # noqa: BLE001 - the other process will meet and tell it
                ours.send_bytes(b"")
                continue
            ours.send_bytes(msgspec.json.encode(results))
