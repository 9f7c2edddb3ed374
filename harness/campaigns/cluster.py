"""Dask distributed, the engine: on this machine, or at the address of a scheduler. It decides when and where a unit is done.

Everything between the command and workers of its own is encrypted and authenticated with keys of the moment: the code under test shares
the network of this machine, and could else give workers something to do.
"""

from __future__ import annotations

import logging
import math
import queue
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from ucm_cts.harness.campaigns.agenda import Due
from ucm_cts.harness.campaigns.units import encoded
from ucm_cts.harness.campaigns.working import UnitFailed, carry_out
from ucm_cts.harness.certificates.suite_build import suite_digest
from ucm_cts.harness.hosting.extras import need
from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.results.foreign import one_line

if TYPE_CHECKING:
    from distributed import Client, Future

CORE = "core"
"""The Dask resource that a worker has one of for each core; a unit that depends on time takes one."""

AHEAD = 2
"""How many units are asked for, for each thread of a worker: one that is done, and the next one."""

SECONDS_TO_CONNECT = 10
"""How long a scheduler may take to answer at first."""

SECONDS_FOR_WORKERS = 60
"""How long the first worker may take to appear."""

SECONDS_BETWEEN_COUNTS = 5.0
"""So often workers are counted."""

SECONDS_FOR_AN_ANSWER = 60
"""How long a result may take from the worker that has it."""

START = "dask worker ADDRESS --nthreads 1 --resources core=1"
"""How a worker is started that takes units which depend on time."""


class SchedulerLost(Exception):
    """The scheduler cannot be reached any more."""


class WorkersDied(Exception):
    """Workers died again and again, each time with the unit."""


@contextmanager
def embedded(workers: int, dashboard: str = "127.0.0.1:0") -> Iterator[Client]:
    """So many workers on this machine, each a process with one thread. Raises ``WrongUse``."""
    need("campaigns", "a campaign")
    import dask
    from distributed import Client, LocalCluster
    from distributed.security import Security

    with (
        tempfile.TemporaryDirectory(prefix="ucm-cts-campaign-") as scratch,
        dask.config.set({"distributed.admin.large-graph-warning-threshold": "1 GiB"}),
        LocalCluster(
            n_workers=workers,
            threads_per_worker=1,
            processes=True,
            host="127.0.0.1",
            security=Security.temporary(),
            resources={CORE: 1},
            memory_limit=0,
            local_directory=scratch,
            dashboard_address=dashboard,
            silence_logs=logging.CRITICAL + 1,
        ) as cluster,
        Client(cluster, set_as_default=False) as client,
    ):
        yield client


@contextmanager
def at(address: str) -> Iterator[Client]:
    """The cluster whose scheduler is at ``address``. Keys for ``tls://`` are taken from Dask's configuration. Raises ``WrongUse``."""
    need("campaigns", "a campaign")
    from distributed import Client

    try:
        client = Client(address, timeout=SECONDS_TO_CONNECT, set_as_default=False)
    except (OSError, ValueError, TimeoutError, TypeError) as error:
        raise WrongUse(
            f"there is no Dask scheduler at '{address}': {str(error).splitlines()[0]}; start one with 'dask scheduler', or leave out "
            "--scheduler"
        ) from None
    try:
        yield client
    finally:
        client.close(timeout=5)


def check_workers(client: Client, some_are_timed: bool) -> None:
    """Raise ``WrongUse`` if there are no workers, or none that could do what depends on time."""
    try:
        client.wait_for_workers(1, timeout=SECONDS_FOR_WORKERS)
    except TimeoutError:
        raise WrongUse(f"no worker has come within {SECONDS_FOR_WORKERS} s; start some: {START}") from None
    _check_suites(client)
    workers = client.scheduler_info(n_workers=-1)["workers"].values()
    if some_are_timed and not any(worker.get("resources", {}).get(CORE, 0) >= 1 for worker in workers):
        raise WrongUse(
            f"no worker has the resource '{CORE}', which units that depend on time take, so that each has a core of its own; start "
            f"workers so: {START}"
        )


def _check_suites(client: Client) -> None:
    """Raise ``WrongUse`` if a worker lacks ucm-cts, or has another build: it would die of the first unit, and tell nobody."""

    def found() -> str:  # travels by value: nothing of ucm-cts needs to be there
        try:
            from ucm_cts.harness.campaigns.working import carry_out  # noqa: F401
            from ucm_cts.harness.certificates.suite_build import suite_digest
        except ImportError as error:
            return str(error)
        return suite_digest()

    for worker, said in client.run(found).items():
        if said != suite_digest():
            what = (
                "another build of ucm-cts" if len(said) == 64 else f"no ucm-cts with campaigns ({one_line(said, 100)})"
            )
            raise WrongUse(f"the worker {worker} has {what}; install this one there, with the same version of Python")


class DaskWorkers:
    """Asks workers for units, and yields what they answer."""

    def __init__(self, client: Client, hidden: Sequence[str] = (), work: Callable[..., Any] = carry_out) -> None:
        """``work`` is called with an encoded unit, the results that it takes, and ``hidden``."""
        self._client = client
        self._hidden = tuple(hidden)
        self._work = work
        self._ended: queue.SimpleQueue[Future[Any]] = queue.SimpleQueue()
        self._asked: dict[str, Due] = {}
        self._most = 0
        self._counted = self._seen = -math.inf

    @property
    def room(self) -> int:
        """For how many more units there is room now. Raises ``SchedulerLost``."""
        if time.monotonic() - self._counted > SECONDS_BETWEEN_COUNTS:
            self._count()
        return max(self._most, 1) - len(self._asked)

    @property
    def asked(self) -> int:
        """How many units are asked for and not answered."""
        return len(self._asked)

    def ask(self, due: Due, needed: Sequence[bytes]) -> None:
        """Ask for ``due``, which takes the results ``needed``."""
        key = f"{due.unit.__struct_config__.tag}-{due.address}"
        future = self._client.submit(
            self._work,
            encoded(due.unit),
            tuple(needed),
            self._hidden,
            key=key,
            resources={CORE: 1} if due.unit.timed else None,
            retries=1,
            pure=False,
        )
        self._asked[key] = due
        future.add_done_callback(self._ended.put)

    def answer(self) -> tuple[Due, bytes | Exception]:
        """The next answer: a result, ``UnitFailed`` or ``WorkersDied``. Raises ``SchedulerLost``."""
        from distributed import KilledWorker

        while True:
            try:
                future = self._ended.get(timeout=SECONDS_BETWEEN_COUNTS)
                break
            except queue.Empty:
                self._count()
        try:
            result: bytes = future.result(timeout=SECONDS_FOR_AN_ANSWER)
        except KilledWorker as error:
            return self._asked.pop(str(future.key)), WorkersDied(
                f"its workers died, {error.allowed_failures + 1} times"
            )
        except UnitFailed as error:
            return self._asked.pop(str(future.key)), error
        except Exception as error:  # noqa: BLE001 - one unit's trouble is not that of the others
            if future.status != "error":
                raise SchedulerLost(type(error).__name__) from None
            return self._asked.pop(str(future.key)), UnitFailed(
                f"UCM-CTS itself failed: {type(error).__name__}: {error}"
            )
        return self._asked.pop(str(future.key)), result

    def _count(self) -> None:
        """How many threads do workers have? Raises ``SchedulerLost`` if there is no scheduler any more, or have been no workers for long."""
        try:
            threads = sum(self._client.nthreads().values())
        except Exception as error:  # noqa: BLE001 - whatever Dask has met: it does not answer
            raise SchedulerLost(type(error).__name__) from None
        self._counted = time.monotonic()
        self._most = max(self._most, AHEAD * threads)
        if threads:
            self._seen = self._counted
        elif self._counted - self._seen > SECONDS_FOR_WORKERS:
            raise SchedulerLost(f"no worker has been there for {SECONDS_FOR_WORKERS} s")
