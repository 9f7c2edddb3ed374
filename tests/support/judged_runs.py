"""Runs with their records: judged again, and with entries of the record changed."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import msgspec
from recorded_runs import judged, plan_of, recorded, some_purposes

from ucm_cts.harness.certificates.rejudging import Judged, RunPlan, without_clock
from ucm_cts.harness.execution import record as r
from ucm_cts.harness.execution.recording import Record
from ucm_cts.harness.purposes.scripts import TestPurpose
from ucm_cts.harness.results.values import FrameworkReport

MUTANTS = "ucm_cts.adapters.mutants.python"


class Run(NamedTuple):
    plan: RunPlan
    purposes: tuple[TestPurpose, ...]
    report: FrameworkReport
    record: Record

    def judged(self, record: Record | None = None, **other: Any) -> Judged:
        plan = msgspec.structs.replace(self.plan, **other)
        return judged(record or self.record, plan, self.purposes)


def run_of(adapter: str, *words: str, every: int = 12, **more: Any) -> Run:
    plan = plan_of(adapter, **more)
    purposes = some_purposes(plan, words, every)
    return Run(plan, purposes, *recorded(adapter, plan, purposes))


def is_same(run: Run) -> None:
    again = run.judged()
    assert again.problems == ()
    assert without_clock(again.report) == without_clock(run.report)
    assert again.report.started[:2] == "20"


Entries = list[Any]
Change = Callable[[Entries], object]


def answers(entries: Entries) -> list[int]:
    """Where answers to scenarios of a test purpose with many events are, far apart."""
    found = [n for n, entry in enumerate(entries) if isinstance(entry, r.Answered) and len(entry.events) > 20]
    return found[5 : len(found) // 2 : 9]


def place(entries: Entries, kind: type) -> int:
    return next(n for n, entry in enumerate(entries) if isinstance(entry, kind))


def exchange(entries: Entries, first: int, second: int) -> None:
    entries[first], entries[second] = entries[second], entries[first]


def edit(entries: Entries, number: int, **changes: Any) -> None:
    entries[number] = msgspec.structs.replace(entries[number], **changes)


def cut(entries: Entries, number: int, by: int) -> None:
    entry = entries[number]
    edit(entries, number, events=entry.events[:-by], times=entry.times[:-by])


def later(entries: Entries, number: int, nanoseconds: int) -> None:
    """One trace later than it was, and all others when they were."""
    times, after = entries[number].times, entries[number + 1].times
    edit(entries, number, times=(times[0] + nanoseconds, *times[1:]))
    edit(entries, number + 1, times=(after[0] - nanoseconds, *after[1:]))


def with_trace_of(entries: Entries, number: int, other: int) -> None:
    edit(entries, number, events=entries[other].events, times=entries[other].times)
