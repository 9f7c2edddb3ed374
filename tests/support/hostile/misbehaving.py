"""Adapters whose framework misbehaves when it is asked for the component ``trigger``; each says how."""

from __future__ import annotations

import ctypes
import os
import signal
import sys
import threading
import time
from collections.abc import Mapping, Sequence
from typing import Any

from ucm_cts.adapters.contract.adapter import ContainerHandle
from ucm_cts.adapters.contract.programming_model import Implementation
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter


class _Hostile(ReferenceAdapter):
    def add_component(self, container: ContainerHandle, implementation: str, attributes: Mapping[str, str]) -> Any:
        if implementation == "trigger":
            return self.misbehave()
        return super().add_component(container, implementation, attributes)

    def misbehave(self) -> Any:
        raise NotImplementedError


class ReadsNullPointer(_Hostile):
    """Dies of a segmentation fault in native code."""

    def misbehave(self) -> Any:
        ctypes.string_at(0)


class Aborts(_Hostile):
    """Aborts."""

    def misbehave(self) -> Any:
        os.abort()


class IsKilled(_Hostile):
    """Is killed, as by the kernel when memory is short."""

    def misbehave(self) -> Any:
        os.kill(os.getpid(), signal.SIGKILL)


class Hangs(_Hostile):
    """Never comes back from a call."""

    def misbehave(self) -> Any:
        threading.Event().wait()


class Dawdles(_Hostile):
    """Comes back after 0.6 seconds in which it runs; seconds in which it is stopped do not count."""

    def misbehave(self) -> Any:
        for _ in range(12):
            time.sleep(0.05)
        return 1


class HangsNatively(_Hostile):
    """Never comes back from native code, which does not let go of the interpreter either."""

    def misbehave(self) -> Any:
        ctypes.PyDLL(None).pause()


class HangsOnWorkers(_Hostile):
    """Never comes back from a call made on a worker thread."""

    def misbehave(self) -> Any:
        threading.Event().wait()


class EatsMemory(_Hostile):
    """Takes more and more memory."""

    def misbehave(self) -> Any:
        hoard = []
        while True:
            hoard.append(bytearray(b"x" * (1 << 20)))
            time.sleep(0.0005)


class Leaves(_Hostile):
    """Ends the process, politely."""

    def misbehave(self) -> Any:
        os._exit(0)


class LeavesWithThree(_Hostile):
    """Ends the process with a status."""

    def misbehave(self) -> Any:
        os._exit(3)


class LeavesChildren(_Hostile):
    """Crashes and leaves a process behind that holds all descriptors open."""

    def misbehave(self) -> Any:
        if os.fork() == 0:
            time.sleep(600)
        os.abort()


class Prints(_Hostile):
    """Prints to standard output, where others would put the protocol, from Python and from below."""

    def misbehave(self) -> Any:
        print('{"type":"trace","id":1,"events":[]}')
        os.write(1, b"more of it\n")
        return super().add_component(self.manager, "calm", {})

    def create_runtime(self, implementations: Sequence[Implementation]) -> Any:
        self.manager = super().create_runtime(implementations)
        return self.manager


class FloodsStandardError(Prints):
    """Writes two megabytes to standard error before it returns."""

    def misbehave(self) -> Any:
        for _ in range(2000):
            sys.stderr.write("x" * 1000 + "\n")
        return super().misbehave()


class GivesTextForAnId(_Hostile):
    """Returns a component id that is no integer."""

    def misbehave(self) -> Any:
        return "number one"


class ExitsByException(_Hostile):
    """Calls ``sys.exit`` instead of raising a declared exception."""

    def misbehave(self) -> Any:
        sys.exit(5)


class HasNoRuntime(ReferenceAdapter):
    """Cannot set up its framework."""

    def create_runtime(self, implementations: Sequence[Implementation]) -> Any:
        raise OSError("the licence server does not answer")
