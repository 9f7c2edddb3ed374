"""Adapters that attack their host or the harness once the component ``trigger`` is to be added; each says how."""

from __future__ import annotations

import itertools
import os
import signal
import time
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from ucm_cts.adapters.contract.adapter import ContainerHandle
from ucm_cts.adapters.contract.programming_model import Implementation
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter

_MIB = 1 << 20
_FOREVER = ["/bin/sleep", "600"]


class Attack(ReferenceAdapter):
    """Conformant, but for one attack."""

    manager: Any
    armed = False

    def create_runtime(self, implementations: Sequence[Implementation]) -> Any:
        self.manager = super().create_runtime(implementations)
        return self.manager

    def add_component(self, container: ContainerHandle, implementation: str, attributes: Mapping[str, str]) -> Any:
        if implementation == "trigger":
            self.armed = True
            self.attack()
        return super().add_component(container, implementation, attributes)

    def attack(self) -> None:
        """Nothing yet."""


def _hoard(mib: int) -> None:
    """Take memory and keep it."""
    hoard = bytearray(mib * _MIB)
    hoard[::4096] = b"x" * len(hoard[::4096])
    signal.pause()


def _fork(then: Any, *arguments: Any) -> None:
    if os.fork() == 0:
        try:
            then(*arguments)
        finally:
            os._exit(0)


def _start_daemon(environment: Mapping[str, str]) -> None:
    """Start a process of its own session whose parent is gone; returns when it runs."""
    runs, begun = os.pipe()  # closed as the daemon begins

    def daemon() -> None:
        os.setsid()
        if os.fork() == 0:
            for stream in (0, 1, 2):
                os.dup2(os.open(os.devnull, os.O_RDWR), stream)
            os.closerange(3, begun)
            os.closerange(begun + 1, 64)
            os.execve(_FOREVER[0], _FOREVER, dict(environment))

    _fork(daemon)
    os.close(begun)
    os.read(runs, 1)
    os.wait()


class HasAGreedyChild(Attack):
    """A child takes the memory."""

    def attack(self) -> None:
        _fork(_hoard, 300)
        signal.pause()


class HasModestChildren(Attack):
    """Five children take a fifth more than is allowed, together."""

    def attack(self) -> None:
        for _ in range(5):
            _fork(_hoard, 60)
        signal.pause()


class HasAGreedyDaemon(Attack):
    """A process that has left group, session and parent takes the memory."""

    def attack(self) -> None:
        def daemon() -> None:
            os.setsid()
            _fork(_hoard, 300)

        _fork(daemon)
        signal.pause()


class SharesMemory(Attack):
    """Eight children share the pages of their parent, which is permitted: they hold little more than one."""

    def attack(self) -> None:
        self.hoard = b"x" * (60 * _MIB)
        for _ in range(8):
            _fork(signal.pause)
        time.sleep(0.6)  # the suite samples the memory of all processes in that time


class LeavesAChild(Attack):
    """A child goes on after the host."""

    def attack(self) -> None:
        runs, begun = os.pipe()  # closed as the child begins
        _fork(os.execv, _FOREVER[0], _FOREVER)
        os.close(begun)
        os.read(runs, 1)


class LeavesADaemon(Attack):
    """A daemon goes on after the host."""

    def attack(self) -> None:
        _start_daemon(os.environ)


class LeavesAStranger(Attack):
    """A daemon without any trace of where it comes from goes on after the host."""

    def attack(self) -> None:
        _start_daemon({})


class LeavesAForkAndCrashes(Attack):
    """A fork of the host goes on after a crash."""

    def attack(self) -> None:
        _fork(signal.pause)
        os.abort()


class StopsItself(Attack):
    """The host stands still."""

    def attack(self) -> None:
        os.kill(os.getpid(), signal.SIGSTOP)


class StopsItsParent(Attack):
    """The process that forks hosts stands still, and the host ends."""

    def attack(self) -> None:
        os.kill(os.getppid(), signal.SIGSTOP)
        os._exit(9)


class KillsItsParent(Attack):
    """The process that forks hosts is killed."""

    def attack(self) -> None:
        os.kill(os.getppid(), signal.SIGKILL)
        signal.pause()


class ClosesEverything(Attack):
    """Closes descriptors that are not its own."""

    def attack(self) -> None:
        os.closerange(0, 256)


class RaisesAnInterrupt(Attack):
    """Raises what is no ``Exception``."""

    def attack(self) -> None:
        raise KeyboardInterrupt


class RaisesAnUnprintable(Attack):
    """Raises an exception whose text cannot be had."""

    def attack(self) -> None:
        class Odd(Exception):
            def __str__(self) -> str:
                raise MemoryError

        raise Odd


class RaisesANovel(Attack):
    """Raises an exception with a very long text."""

    def attack(self) -> None:
        raise RuntimeError("x\0\x1b[2J" * _MIB)


class RecursesForEver(Attack):
    """Calls itself without end."""

    def attack(self) -> None:
        self.attack()


class _Lists(Attack):
    def get_components(self, container: ContainerHandle) -> Any:
        return self.listed() if self.armed else super().get_components(container)

    def listed(self) -> Any:
        raise NotImplementedError


class ListsVeryMany(_Lists):
    """Returns 200,000 ids."""

    def listed(self) -> Any:
        return tuple(range(200_000))


class ListsForEver(_Lists):
    """Returns ids without end."""

    def listed(self) -> Iterator[int]:
        return itertools.count(1)


class ListsNothing(_Lists):
    """Returns no list."""

    def listed(self) -> Any:
        return 7


class ListsAnUnprintable(_Lists):
    """Returns an object that cannot be shown."""

    def listed(self) -> Any:
        class Odd:
            def __repr__(self) -> str:
                raise RuntimeError("no")

        return [Odd()]


class ListsANovel(_Lists):
    """Returns an object that takes megabytes to show."""

    def listed(self) -> Any:
        return ["x" * (20 * _MIB)]


class ReadsForEver(Attack):
    """Returns log records without end."""

    def read_log(self, manager: ContainerHandle) -> Any:
        return itertools.repeat(("INFO", "again"))


class PrintsAndBreaks(Attack):
    """Prints, and asks for a debugger, at each start."""

    def start(self, container: ContainerHandle) -> None:
        print("value of x: 42")
        breakpoint()  # noqa: T100
        super().start(container)


class AsksForPdb(Attack):
    """Asks for a debugger at each start, and does not ask whether there is one."""

    def start(self, container: ContainerHandle) -> None:
        import pdb  # noqa: T100

        pdb.set_trace()  # noqa: T100
        super().start(container)
