"""Template: a process that has loaded the adapter and forks a new host on request.

Control protocol, one line each over a Unix socket. To the template: ``fork`` together with three descriptors (the
host's input, output and standard error), and ``kill PID SIGNAL``. From it: ``ready`` once, or ``failed`` and
a JSON string saying why; ``forked PID``; and ``ended PID STATUS STRAYS`` (as of
``os.waitstatus_to_exitcode``: negative for a signal; a JSON list with the command line of each process that the host left behind).

Each host leads a process group. What a host leaves behind is killed when it ends, also in other groups and sessions: on Linux
the template adopts it. All are killed when the socket closes.
"""

from __future__ import annotations

import ctypes
import gc
import json
import os
import resource
import selectors
import signal
import socket
import sys
from collections.abc import Callable, Collection
from contextlib import suppress
from typing import NoReturn

_DIE_WITH_PARENT = 1  # PR_SET_PDEATHSIG of Linux
_ADOPT_ORPHANS = 36  # PR_SET_CHILD_SUBREAPER of Linux

NO_CONTROL = 71
"""The exit status of a template whose control channel was closed by what it has loaded."""

_ROUNDS = 50
"""How many times strays are searched for, because those that are killed may have children, which the template adopts."""

_LONGEST_NAME = 80
_MOST_NAMES = 20

BecomeHost = Callable[[int, int], NoReturn]
"""Turns a forked process into a host, given the descriptors to read from and to write to."""


def refuse(control: socket.socket, reason: str) -> NoReturn:
    """Tell the harness that there will be no hosts, end what was started, and end."""
    _end_children(frozenset())
    with suppress(OSError):  # what was loaded may have closed it
        control.sendall(b"failed " + json.dumps(reason).encode() + b"\n")
    sys.exit(2)


def adopt_orphans() -> None:
    """Let processes whose parents have ended become children of this one, where the system can: on Linux."""
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(_ADOPT_ORPHANS, 1, 0, 0, 0)


class Template:
    """Serves ``control`` until the harness closes it. ``become_host`` runs in each forked process and never returns."""

    def __init__(self, control: socket.socket, become_host: BecomeHost) -> None:
        self._control = control
        self._become_host = become_host
        self._hosts: set[int] = set()
        self._helpers: frozenset[int] = frozenset()
        self._process_control = ctypes.CDLL(None).prctl if sys.platform == "linux" else None

    def serve(self) -> None:
        """Fork hosts on request and report their ends. Ends the process if what was loaded has closed the control channel."""
        adopt_orphans()
        self._helpers = frozenset(_children())  # what the adapter started when it was loaded serves all hosts
        wake, woken = os.pipe()
        os.set_blocking(woken, False)
        os.set_blocking(wake, False)
        signal.set_wakeup_fd(woken, warn_on_full_buffer=False)
        signal.signal(signal.SIGCHLD, lambda *_: None)
        resource.setrlimit(resource.RLIMIT_CORE, (0, resource.getrlimit(resource.RLIMIT_CORE)[1]))
        gc.collect()
        gc.freeze()  # so that collections in hosts do not touch, and thereby copy, the template's pages
        with selectors.DefaultSelector() as selector:
            selector.register(wake, selectors.EVENT_READ)
            try:
                selector.register(self._control, selectors.EVENT_READ)
                self._control.sendall(b"ready\n")
                while True:
                    ready = {key.fileobj for key, _ in selector.select()}
                    if wake in ready:
                        with suppress(BlockingIOError):
                            os.read(wake, 4096)
                        self._report_ended()
                    if self._control in ready and not self._obey():
                        return
            except (BrokenPipeError, ConnectionResetError):
                return  # the harness has closed it
            except OSError:
                sys.exit(NO_CONTROL)
            finally:
                for host in self._hosts:
                    _kill_group(host)
                _end_children(frozenset())

    def _obey(self) -> bool:
        text, descriptors, _, _ = socket.recv_fds(self._control, 4096, 3)
        for line in text.decode().splitlines():
            words = line.split()
            if words[0] == "fork":
                self._fork(descriptors)
            elif words[0] == "kill" and int(words[1]) in self._hosts:
                os.kill(int(words[1]), int(words[2]))
        return bool(text)

    def _fork(self, descriptors: list[int]) -> None:
        template = os.getpid()
        host = os.fork()
        if host == 0:
            try:
                self._prepare(template, descriptors[2])
                self._become_host(descriptors[0], descriptors[1])
            finally:
                os._exit(70)
        for descriptor in descriptors:
            os.close(descriptor)
        with suppress(OSError):
            os.setpgid(host, host)
        self._hosts.add(host)
        self._control.sendall(b"forked %d\n" % host)

    def _prepare(self, template: int, error: int) -> None:
        os.setpgid(0, 0)
        if self._process_control:
            self._process_control(_DIE_WITH_PARENT, signal.SIGKILL)
            if os.getppid() != template:
                os._exit(0)
        signal.set_wakeup_fd(-1)
        signal.signal(signal.SIGCHLD, signal.SIG_DFL)
        os.close(self._control.fileno())
        os.dup2(error, 2)
        os.close(error)

    def _report_ended(self) -> None:
        for host in tuple(self._hosts):
            if os.waitid(os.P_PID, host, os.WEXITED | os.WNOHANG | os.WNOWAIT):
                names = {number: name for number, name in self._strays().items() if name}
                _kill_group(host)  # before its number is free again
                _, status = os.waitpid(host, 0)
                self._hosts.remove(host)
                names = {**self._end_strays(), **names}
                shown = json.dumps(list(names.values())[:_MOST_NAMES]).encode()
                self._control.sendall(b"ended %d %d %s\n" % (host, os.waitstatus_to_exitcode(status), shown))

    def _strays(self) -> dict[int, str]:
        """The command lines of processes that hosts have left behind, by their numbers."""
        return _children_but(self._hosts | self._helpers)

    def _end_strays(self) -> dict[int, str]:
        """Kill them, and what they leave behind in their turn; returns them."""
        return _end_children(self._hosts | self._helpers)


def _children_but(others: Collection[int]) -> dict[int, str]:
    """The command lines of the children of this process that are not ``others``."""
    return {number: _command_line(number) for number in _children() if number not in others}


def _end_children(others: Collection[int]) -> dict[int, str]:
    """Kill all children but ``others``, and what becomes a child meanwhile; returns the command lines of those that lived."""
    ended: dict[int, str] = {}
    for _ in range(_ROUNDS):
        strays = _children_but(others)
        if not strays:
            break
        for number, name in strays.items():
            if name:
                ended.setdefault(number, name)
            with suppress(OSError):
                os.kill(number, signal.SIGKILL)
            with suppress(OSError):
                os.waitpid(number, 0)
    return ended


def _children() -> list[int]:
    """The children of this process; none where the system does not list them."""
    found: list[int] = []
    with suppress(OSError):
        for task in os.listdir("/proc/self/task"):
            with suppress(OSError), open(f"/proc/self/task/{task}/children", "rb") as stream:
                found.extend(map(int, stream.read().split()))
    return found


def _command_line(number: int) -> str:
    """The command line of a process, shortened; empty if it has ended by itself."""
    with suppress(OSError), open(f"/proc/{number}/cmdline", "rb") as stream, open("/proc/self/cmdline", "rb") as own:
        line = stream.read(1 << 16)
        if line and line == own.read(1 << 16):
            return "a fork of the host"
        shown = line.replace(b"\0", b" ").decode(errors="replace").strip()[:_LONGEST_NAME]
        return shown or _name_of_living(number)
    return ""


def _name_of_living(number: int) -> str:
    """The name of a process without a command line, as at the moment when it begins another program; empty if it has ended."""
    with suppress(OSError, IndexError), open(f"/proc/{number}/stat", "rb") as stream:
        name, _, state = stream.read().partition(b"(")[2].rpartition(b") ")
        return "" if state[:1] in b"ZX" else name.decode(errors="replace")
    return ""


def _kill_group(host: int) -> None:
    with suppress(ProcessLookupError, PermissionError):
        os.killpg(host, signal.SIGKILL)
