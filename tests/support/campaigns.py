"""Campaigns of tests: as processes that are disturbed, and what came out of them without times.

``python tests/support/campaigns.py FOLDER`` disturbs a campaign as often as the decision about campaigns says, and compares.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import random
import re
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any

import psutil

from ucm_cts.harness.campaigns.store import Store

TIMES = ("started", "seconds", "seconds_by_clause", "t", "stacks")
"""What two runs of the same do not have in common: times, and what a dying process printed of its memory."""


def without_times(value: Any) -> Any:
    """JSON ``value`` without times."""
    if isinstance(value, dict):
        return {key: without_times(item) for key, item in value.items() if key not in TIMES}
    return [without_times(item) for item in value] if isinstance(value, list) else value


def outcome_in(folder: Path) -> dict[str, Any]:
    """All that a campaign wrote for machines, by file, without times."""
    files = [*folder.rglob("report.json"), *folder.rglob("matrix.json"), folder / "campaign.json"]
    return {str(file.relative_to(folder)): without_times(json.loads(file.read_text())) for file in sorted(files)}


def campaign(plan: Path, out: Path, *options: str) -> subprocess.Popen[str]:
    """``ucm-cts campaign`` as a process of its own, with its own group."""
    command = [sys.executable, "-m", "ucm_cts", "campaign", str(plan), "--out", str(out), *options]
    return subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, start_new_session=True
    )


def kept(out: Path) -> frozenset[str]:
    """The addresses of the units that have a result in ``out``."""
    return Store(out / "units").addresses()


def workers_of(process: subprocess.Popen[str] | psutil.Popen) -> list[psutil.Process]:
    """The workers of a campaign on this machine."""
    with contextlib.suppress(psutil.NoSuchProcess):
        children = psutil.Process(process.pid).children()
        return [child for child in children if any("spawn_main" in word for word in _words(child))]
    return []


def _words(process: psutil.Process) -> list[str]:
    with contextlib.suppress(psutil.Error):
        return process.cmdline()
    return []


def wait_until(done: Callable[[], bool], process: subprocess.Popen[str], seconds: float = 600) -> bool:
    """Wait until something is ``done``; False if ``process`` ended before, or if it takes too long."""
    until = time.monotonic() + seconds
    while not done():
        if process.poll() is not None or time.monotonic() > until:
            return done()
        time.sleep(0.02)
    return True


def kill_group(process: subprocess.Popen[str]) -> None:
    """End a campaign with all that it started, at once."""
    family = [process.pid, *(child.pid for child in psutil.Process(process.pid).children(recursive=True))]
    for pid in family:
        with contextlib.suppress(psutil.NoSuchProcess):
            psutil.Process(pid).kill()
    process.wait()


class Disturbed:
    """A campaign that is disturbed: each method starts it again if it has ended, and disturbs it once."""

    def __init__(self, plan: Path, out: Path, options: Sequence[str], seed: int = 1) -> None:
        self._plan, self._out, self._options = plan, out, options
        self._random = random.Random(seed)
        self._process: subprocess.Popen[str] | None = None
        self.log: list[str] = []
        self.results: dict[str, bytes] = {}

    def going(self) -> subprocess.Popen[str]:
        """The process, which goes on."""
        if self._process is None or self._process.poll() is not None:
            self._process = campaign(self._plan, self._out, *self._options)
        return self._process

    def check(self) -> None:
        """No result that was kept may be gone, or have been made again."""
        for address in kept(self._out):
            content = (self._out / "units" / address[:2] / address).read_bytes()
            assert self.results.setdefault(address, content) == content, f"{address} was made twice"
        assert self.results.keys() <= kept(self._out), "a result is gone"

    def after_some(self, units: int) -> subprocess.Popen[str]:
        """Wait until so many more units have ended."""
        process, before = self.going(), len(kept(self._out))
        assert wait_until(lambda: len(kept(self._out)) >= before + units, process), self.end()
        return process

    def kill_worker(self, units: int) -> None:
        """Kill a worker that is drawn, after so many units."""
        process = self.after_some(units)
        assert wait_until(lambda: bool(workers_of(process)), process)
        self._random.choice(workers_of(process)).kill()
        self._note("worker killed")

    def kill_client(self, units: int) -> None:
        """Kill the command, and with it what it started, after so many units."""
        kill_group(self.after_some(units))
        self._note("client killed")

    def end(self) -> str:
        """Wait for the end. What was printed."""
        said = self.going().communicate()[0]
        self.check()
        return said

    def _note(self, what: str) -> None:
        self.check()
        self.log.append(f"{what} with {len(kept(self._out))} units kept")


@contextlib.contextmanager
def scheduler(port: int) -> Iterator[subprocess.Popen[str]]:
    """A Dask scheduler of its own."""
    command = [
        sys.executable,
        "-m",
        "distributed.cli.dask_scheduler",
        "--host",
        "127.0.0.1",
        "--port",
        str(port),
        "--no-dashboard",
    ]
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, text=True)
    try:
        yield process
    finally:
        process.kill()
        process.wait()


@contextlib.contextmanager
def dask_workers(port: int, number: int, folder: Path) -> Iterator[subprocess.Popen[str]]:
    """Workers for the scheduler at ``port``, as docs/campaigns.md starts them."""
    command = [
        *(sys.executable, "-m", "distributed.cli.dask_worker", f"tcp://127.0.0.1:{port}"),
        *(
            "--nworkers",
            str(number),
            "--nthreads",
            "1",
            "--resources",
            "core=1",
            "--no-dashboard",
            "--memory-limit",
            "0",
        ),
    ]
    process = subprocess.Popen(command, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, text=True)
    try:
        yield process
    finally:
        kill_group(process)


def main() -> None:
    """Disturb a campaign of ``--plan`` below FOLDER, and compare it with an undisturbed one."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--plan", type=Path, required=True)
    parser.add_argument("--worker-kills", type=int, default=20)
    parser.add_argument("--between", type=int, default=10, help="units between two disturbances")
    parser.add_argument("--small", type=Path, help="an empty file system of little size, for the full disk")
    given = parser.parse_args()
    calm, wild = given.folder / "calm", given.folder / "wild"
    first = campaign(given.plan, calm, "--workers", "2")
    print(first.communicate()[0], flush=True)
    one = Disturbed(given.plan, wild, ("--workers", "2"))
    for number in range(given.worker_kills):
        one.kill_worker(given.between)
        print(one.log[-1], flush=True)
        if number in (given.worker_kills // 3, 2 * given.worker_kills // 3):
            one.kill_client(given.between)
            print(one.log[-1], flush=True)
    kill_group(one.going())
    port = 18_786
    for _ in range(2):
        with scheduler(port) as dask, dask_workers(port, 2, given.plan.parent):
            away = Disturbed(given.plan, wild, ("--scheduler", f"tcp://127.0.0.1:{port}"))
            process = away.after_some(given.between)
            dask.send_signal(signal.SIGKILL)
            said = process.communicate(timeout=180)[0]
            assert process.returncode == 3, said
            print(f"scheduler killed with {len(kept(wild))} units kept: {said.strip().splitlines()[-1]}", flush=True)
            one.check()
    if given.small is not None:
        _fill(one, given.plan, wild, given.small, given.between)
    print(one.end(), flush=True)
    same = outcome_in(calm) == outcome_in(wild)
    print(f"{len(kept(wild))} units; as undisturbed: {same}")
    sys.exit(0 if same else 1)


def _fill(one: Disturbed, plan: Path, out: Path, small: Path, units: int) -> None:
    """Let the disk be full: results go to ``small`` meanwhile, which has room for some only."""
    shutil.copytree(out / "units", small / "out" / "units")
    ballast = small / "ballast"
    room = shutil.disk_usage(small).free
    ballast.write_bytes(bytes(max(0, room - units * 12_000)))
    full = campaign(plan, small / "out", "--workers", "2")
    said = full.communicate()[0]
    assert full.returncode == 3, said
    assert re.search("No space left on device", said), said
    print(f"disk full with {len(kept(small / 'out'))} units kept: {said.strip().splitlines()[-1]}", flush=True)
    ballast.unlink()
    for file in (small / "out" / "units").rglob("?" * 64):
        place = out / "units" / file.parent.name / file.name
        place.parent.mkdir(exist_ok=True)
        if not place.exists():
            shutil.copy(file, place)
    one.check()


if __name__ == "__main__":
    main()
