"""Conducting: what is kept is not asked for again, and nothing is lost when workers die, parts fail or the disk is full."""

from __future__ import annotations

import errno
from collections import Counter
from collections.abc import Callable, Sequence
from pathlib import Path

import pytest

from ucm_cts.harness.campaigns import store as storing
from ucm_cts.harness.campaigns.agenda import Agenda, Due
from ucm_cts.harness.campaigns.cluster import WorkersDied
from ucm_cts.harness.campaigns.conducting import conduct
from ucm_cts.harness.campaigns.planning import RunOfPlan, Work
from ucm_cts.harness.campaigns.store import NotKept, Store
from ucm_cts.harness.campaigns.units import Conclusion, PlannedRun, Slice, Unit, address
from ucm_cts.harness.campaigns.working import UnitFailed

Does = Callable[[Unit, int], bytes | Exception]
"""What workers answer to a unit that is asked for the n-th time; n is 1 at first."""


def run_of(seed: int, parts: int = 3) -> RunOfPlan:
    run = PlannedRun("s", "p", "i", "a", "", (), "container", seed, "", 0, False, True, 5.0, 1024, 60.0)
    return RunOfPlan(f"p/container/seed-{seed}", "p", run, tuple(Slice(run, n, n + 1, False) for n in range(parts)), ())


class Scripted:
    """Workers that do what a test says, in the order in which they were asked."""

    def __init__(self, does: Does = lambda unit, times: b"done", most: int = 4) -> None:
        self.does, self.most = does, most
        self.asked_for: list[Due] = []
        self.given: dict[str, Sequence[bytes]] = {}
        self.at_once: list[int] = []
        self._now: list[Due] = []

    @property
    def room(self) -> int:
        return self.most - len(self._now)

    @property
    def asked(self) -> int:
        return len(self._now)

    def ask(self, due: Due, needed: Sequence[bytes]) -> None:
        self.asked_for.append(due)
        self.given[due.address] = needed
        self._now.append(due)

    def answer(self) -> tuple[Due, bytes | Exception]:
        self.at_once.append(len(self._now))
        due = self._now.pop(0)
        return due, self.does(due.unit, Counter(one.address for one in self.asked_for)[due.address])


def conducted(folder: Path, workers: Scripted, *runs: RunOfPlan) -> Agenda:
    store = Store(folder / "units")
    agenda = Agenda(Work(runs, {}), store.has)
    conduct(agenda, agenda.begin(), store, workers)
    return agenda


def test_run_is_concluded_once_with_the_results_of_its_parts_in_order(tmp_path: Path) -> None:
    run = run_of(1)
    workers = Scripted(lambda unit, times: f"{unit.first}".encode() if isinstance(unit, Slice) else b"end")
    agenda = conducted(tmp_path, workers, run)
    assert [type(due.unit) for due in workers.asked_for] == [Slice, Slice, Slice, Conclusion]
    assert workers.given[agenda.conclusions[run.name]] == [b"0", b"1", b"2"]
    assert (agenda.number, agenda.done, agenda.before, agenda.lost) == (4, 4, 0, {})


def test_what_is_kept_is_not_asked_for_again(tmp_path: Path) -> None:
    first = Scripted()
    conducted(tmp_path, first, run_of(1))
    again = Scripted()
    agenda = conducted(tmp_path, again, run_of(1), run_of(2))
    assert {due.unit.run.seed for due in again.asked_for if isinstance(due.unit, Slice | Conclusion)} == {2}
    assert (agenda.before, agenda.done) == (4, 4)


def test_unit_of_two_runs_is_done_once(tmp_path: Path) -> None:
    one, other = run_of(1), run_of(1)
    workers = Scripted()
    agenda = conducted(tmp_path, workers, one, RunOfPlan("other", "o", other.run, other.parts, ()))
    assert len(workers.asked_for) == agenda.number == 4
    assert agenda.conclusions["other"] == agenda.conclusions[one.name]


def test_damaged_result_is_made_again(tmp_path: Path) -> None:
    run = run_of(1)
    conducted(tmp_path, Scripted(), run)
    damaged = address(run.parts[1])
    file = tmp_path / "units" / damaged[:2] / damaged
    file.write_bytes(file.read_bytes()[:-1])
    again = Scripted()
    conducted(tmp_path, again, run)
    assert [due.address for due in again.asked_for] == [damaged]


def test_part_that_fails_is_told_and_costs_no_other(tmp_path: Path) -> None:
    run = run_of(1)
    second = run.parts[1]
    workers = Scripted(lambda unit, times: UnitFailed("no host") if unit == second else b"done")
    agenda = conducted(tmp_path, workers, run, run_of(2))
    assert agenda.lost == {address(second): "no host"}
    last = next(due.unit for due in workers.asked_for if due.address == agenda.conclusions[run.name])
    assert isinstance(last, Conclusion)
    assert (last.parts, last.lost) == ((run.parts[0], run.parts[2]), (second,))

    mended = conducted(tmp_path, again := Scripted(), run, run_of(2))
    assert [due.unit for due in again.asked_for] == [second, run.conclusion(())]
    assert not mended.lost


def test_unit_that_kills_its_worker_is_lost_and_what_was_there_besides_is_not(tmp_path: Path) -> None:
    guilty, beside = run_of(1).parts[0], run_of(1).parts[1]

    def does(unit: Unit, times: int) -> bytes | Exception:
        return WorkersDied("its workers died") if unit == guilty or (unit == beside and times == 1) else b"done"

    workers = Scripted(does)
    agenda = conducted(tmp_path, workers, run_of(1))
    assert agenda.lost == {address(guilty): "its workers died"}
    again = [number for number, due in enumerate(workers.asked_for) if due.unit in (guilty, beside)][2:]
    assert [workers.at_once[number] for number in again] == [1, 1]  # each alone, so that nothing else takes the blame


def test_full_disk_ends_the_campaign_and_loses_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    writes = 0

    def write(path: Path, content: bytes) -> None:
        nonlocal writes
        writes += 1
        if writes == 3:
            raise OSError(errno.ENOSPC, "No space left on device")
        path.write_bytes(content)

    monkeypatch.setattr(storing, "write_whole", write)
    with pytest.raises(NotKept, match=r"No space left on device; .* make room and give the same command again"):
        conducted(tmp_path, Scripted(), run_of(1))
    kept = Store(tmp_path / "units").addresses()
    assert len(kept) == 2
    again = Scripted()
    agenda = conducted(tmp_path, again, run_of(1))
    assert not kept & {due.address for due in again.asked_for}
    assert (agenda.before, agenda.done) == (2, 2)
