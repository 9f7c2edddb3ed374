"""What a second worker gains, and how busy a cluster is: ``python -m ucm_cts.harness.bench.campaigns``.

Real units are done in turns by one worker with one processor, by one with two, and by two with two, so that all meet the same machine. A worker and
the hosts that it starts are several processes: one worker that may use two processors does use a part of the second.
For a cluster there are simulated workers, all in this process, whose units wait a second each.
"""

from __future__ import annotations

import argparse
import asyncio
import os
import tempfile
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from rich.console import Console
from rich.table import Table

from ucm_cts.harness.bench.measuring import empty_table
from ucm_cts.harness.campaigns import cluster
from ucm_cts.harness.campaigns.agenda import Agenda
from ucm_cts.harness.campaigns.conducting import conduct
from ucm_cts.harness.campaigns.plan import read_plan
from ucm_cts.harness.campaigns.planning import Work, work_of
from ucm_cts.harness.campaigns.store import Store
from ucm_cts.harness.campaigns.units import Trial
from ucm_cts.harness.selftest.trials import Thoroughness

if TYPE_CHECKING:
    from distributed import Client

_PLAN = """
profiles = ["container"]
scenarios = {scenarios}
seeds = [{seed}]
[products.reference]
adapter = "reference-py"
virtual-time = true
"""


_TWO = "two, two processors"
_SIDES = {"one, one processor": (1, 1), "one, two processors": (1, 2), _TWO: (2, 2)}
"""How many workers, and how many processors they and what they start may use."""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=2, help="how many runs of profile container each side does")
    parser.add_argument("--scenarios", type=int, default=100, help="in one unit")
    parser.add_argument("--simulated-workers", type=int, default=64)
    parser.add_argument("--simulated-units", type=int, default=1_000)
    parser.add_argument("--simulated-seconds", type=float, default=1.0, help="that a simulated unit waits")
    options = parser.parse_args()
    console = Console()
    if options.rounds:
        console.print(_speed_up(console, options.rounds, options.scenarios))
    if options.simulated_units:
        console.print(_busy(options.simulated_workers, options.simulated_units, options.simulated_seconds))


def _speed_up(console: Console, rounds: int, scenarios: int) -> Table:
    """Each round is one run of profile container with a seed of its own, done by each side. The first is not counted: workers derive what all units need."""
    seconds = dict.fromkeys(_SIDES, 0.0)
    units = 0
    with ExitStack() as stack:
        clients = {}
        for side, (workers, processors) in _SIDES.items():
            with _only_on(processors):
                clients[side] = stack.enter_context(cluster.embedded(workers))
        for seed in range(rounds + 1):
            work = _real(seed, scenarios)
            for side in _SIDES if seed % 2 else reversed(_SIDES):
                done, took = _done(work, clients[side])
                if seed:
                    seconds[side] += took
            if seed:
                units += done
                console.print(f"{units} units: " + ", ".join(f"{side} {seconds[side]:.0f} s" for side in _SIDES))
    table = empty_table("A second worker", "workers|units|s|two workers are as fast")
    for side in _SIDES:
        table.add_row(side, f"{units:,}", f"{seconds[side]:.1f}", f"{seconds[side] / seconds[_TWO]:.2f}")
    return table


@contextmanager
def _only_on(processors: int) -> Iterator[None]:
    """What is started meanwhile uses so many processors at most."""
    all_of_them = os.sched_getaffinity(0)
    os.sched_setaffinity(0, sorted(all_of_them)[:processors])
    try:
        yield
    finally:
        os.sched_setaffinity(0, all_of_them)


def _real(seed: int, scenarios: int) -> Work:
    with tempfile.TemporaryDirectory(prefix="ucm-cts-bench-") as folder:
        path = Path(folder) / "plan.toml"
        path.write_text(_PLAN.format(scenarios=scenarios, seed=seed), encoding="utf-8")
        return work_of(read_plan(path))


def _done(work: Work, client: Client) -> tuple[int, float]:
    """The number of units, and the seconds until all of ``work`` was done and kept."""
    with tempfile.TemporaryDirectory(prefix="ucm-cts-bench-") as folder:
        store = Store(Path(folder) / "units")
        agenda = Agenda(work, store.has)
        began = time.perf_counter()
        conduct(agenda, agenda.begin(), store, cluster.DaskWorkers(client))
        took = time.perf_counter() - began
        if agenda.lost:
            raise RuntimeError(f"{len(agenda.lost)} units gave no result: {next(iter(agenda.lost.values()))}")
        return agenda.done, took


def _busy(workers: int, units: int, seconds: float) -> Table:
    how = Thoroughness()
    work = Work((), {(1, f"{n}"): Trial("", f"{n}", how, "", timed=True) for n in range(units)})

    async def wait(unit: bytes, parts: object, hidden: object) -> bytes:
        await asyncio.sleep(seconds)
        return b"done"

    with _simulated(workers) as client, tempfile.TemporaryDirectory(prefix="ucm-cts-bench-") as folder:
        store = Store(Path(folder) / "units")
        agenda = Agenda(work, store.has)
        began, cpu = time.perf_counter(), time.process_time()
        conduct(agenda, agenda.begin(), store, cluster.DaskWorkers(client, work=wait))
        took, cpu = time.perf_counter() - began, time.process_time() - cpu
    title = f"{workers} simulated workers, units of {seconds:g} s"
    table = Table("units", "took, s", "at best, s", "busy, %", "CPU a unit, ms", title=title)
    at_best = -(-units // workers) * seconds
    busy = f"{100 * units * seconds / workers / took:.1f}"
    table.add_row(f"{units:,}", f"{took:.1f}", f"{at_best:.1f}", busy, f"{1000 * cpu / units:.2f}")
    return table


@contextmanager
def _simulated(workers: int) -> Iterator[Client]:
    import dask
    from distributed import Client, LocalCluster

    # what each worker watches of its own machine would be watched here by all of them
    quiet = {"distributed.worker.profile.enabled": False, "distributed.admin.system-monitor.interval": "60s"}
    with (
        dask.config.set(quiet),
        LocalCluster(  # type: ignore[no-untyped-call]
            n_workers=workers,
            threads_per_worker=1,
            processes=False,
            resources={cluster.CORE: 1},
            memory_limit=0,
            dashboard_address=None,
            silence_logs=50,
        ) as local,
        Client(local, set_as_default=False) as client,  # type: ignore[no-untyped-call]
    ):
        yield client


if __name__ == "__main__":
    main()
