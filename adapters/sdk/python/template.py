"""Template: a process that has loaded the adapter and forks a new host on request.

Control protocol, one line each over a Unix socket. To the template: ``fork`` together with three descriptors (the
host's input, output and standard error), and ``kill PID SIGNAL``. From it: ``ready`` once, or ``failed`` and a JSON
string saying why; ``forked PID``; and ``ended PID STATUS`` (as of ``os.waitstatus_to_exitcode``: negative for a
signal). Each host leads a process group, which is killed when the host ends; all are killed when the socket closes.
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
from collections.abc import Callable
from contextlib import suppress
from typing import NoReturn

_DIE_WITH_PARENT = 1  # PR_SET_PDEATHSIG of Linux

BecomeHost = Callable[[int, int], NoReturn]
"""Turns a forked process into a host, given the descriptors to read from and to write to."""


def refuse(control: socket.socket, reason: str) -> NoReturn:
    """Tell the harness that there will be no hosts, and end."""
    control.sendall(b"failed " + json.dumps(reason).encode() + b"\n")
    sys.exit(2)


class Template:
    """Serves ``control`` until the harness closes it. ``become_host`` runs in each forked process and never returns."""

    def __init__(self, control: socket.socket, become_host: BecomeHost) -> None:
        self._control = control
        self._become_host = become_host
        self._hosts: set[int] = set()
        self._process_control = ctypes.CDLL(None).prctl if sys.platform == "linux" else None

    def serve(self) -> None:
        """Fork hosts on request and report their ends."""
        wake, woken = os.pipe()
        os.set_blocking(woken, False)
        os.set_blocking(wake, False)
        signal.set_wakeup_fd(woken, warn_on_full_buffer=False)
        signal.signal(signal.SIGCHLD, lambda *_: None)
        resource.setrlimit(resource.RLIMIT_CORE, (0, resource.getrlimit(resource.RLIMIT_CORE)[1]))
        gc.collect()
        gc.freeze()  # so that collections in hosts do not touch, and thereby copy, the template's pages
        with selectors.DefaultSelector() as selector:
            selector.register(self._control, selectors.EVENT_READ)
            selector.register(wake, selectors.EVENT_READ)
            self._control.sendall(b"ready\n")
            try:
                while True:
                    ready = {key.fileobj for key, _ in selector.select()}
                    if wake in ready:
                        with suppress(BlockingIOError):
                            os.read(wake, 4096)
                        self._report_ended()
                    if self._control in ready and not self._obey():
                        return
            finally:
                for host in self._hosts:
                    _kill_group(host)

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
                _kill_group(host)  # before its number is free again
                _, status = os.waitpid(host, 0)
                self._hosts.remove(host)
                self._control.sendall(b"ended %d %d\n" % (host, os.waitstatus_to_exitcode(status)))


def _kill_group(host: int) -> None:
    with suppress(ProcessLookupError, PermissionError):
        os.killpg(host, signal.SIGKILL)
