"""Channels to hosts: processes forked by a template, and connections. ``host_watch`` watches them."""

from __future__ import annotations

import json
import os
import select
import signal
import socket
import subprocess
import sys
import tempfile
import time
from contextlib import suppress
from typing import Protocol

from ucm_cts.harness.hosting.locate import Endpoint, WrongUse
from ucm_cts.harness.results.foreign import clean, one_line
from ucm_cts.harness.results.values import Incident, IncidentKind

START_SECONDS = 60.0
"""How long an adapter may take to be loaded."""

_RETRY_SECONDS = 1.0
_FAREWELL_SECONDS = 0.5
_LOG_TAIL = 1 << 16
_LAST_LINES = 20


class HostUnavailable(Exception):
    """No host can be started or reached at an endpoint; ``incident`` says why, the text has its last lines."""

    def __init__(self, incident: Incident) -> None:
        printed = incident.stacks.strip().splitlines()
        shown = [one_line(line) for line in printed[-_LAST_LINES:]]
        if len(printed) > len(shown):
            shown.insert(0, f"({len(printed) - len(shown)} more lines)")
        super().__init__("\n".join([clean(incident.detail), *shown]))
        self.incident = incident


class Channel(Protocol):
    """The file descriptors of one host, and the operations on its process."""

    source: int
    target: int
    error: int | None
    pid: int | None
    notices: int | None
    """Readable when ``status`` may have changed."""

    def signal(self, number: int) -> None:
        """Send a signal to the host, if it is a process of ours that still runs."""

    def status(self, seconds: float) -> int | None:
        """How the host ended, negative for a signal; None if it has not, after waiting for ``seconds``."""

    def close(self, orderly: bool) -> None:
        """Let the host go. ``orderly`` lets it end by itself for a moment; otherwise it is killed."""


class Opener(Protocol):
    """Makes fresh hosts behind one endpoint."""

    def open(self) -> Channel:
        """A fresh host. Raises ``HostUnavailable``, and ``WrongUse`` if the endpoint leads to no adapter."""

    def close(self) -> None:
        """End all hosts and the process that forks them."""


def opener(endpoint: Endpoint) -> Opener:
    """The opener of ``endpoint``, which is not an in-process one."""
    if endpoint.kind in ("tcp", "unix"):
        return Connector(endpoint)
    module = "ucm_cts.adapters.sdk.python.host" if endpoint.kind == "python" else "ucm_cts.harness.hosting.spawner"
    return TemplateProcess([sys.executable, "-X", "faulthandler", "-m", module, endpoint.target], endpoint.text)


class TemplateProcess:
    """Client of ``adapters.python.template``; started on demand, and once more if it has ended."""

    def __init__(self, command: list[str], name: str) -> None:
        self._command = command
        self._name = name
        self._process: subprocess.Popen[bytes] | None = None
        self._control: socket.socket | None = None
        self._log = tempfile.TemporaryFile()  # noqa: SIM115 - closed in close
        self._unread = b""
        self._forked: list[int] = []
        self._ended: dict[int, int] = {}

    def open(self) -> Channel:
        for last in (False, True):
            if self._control is None:
                self._start()
            try:
                return self._fork()
            except (OSError, EOFError) as error:
                self._stop()
                if last:
                    raise self._unavailable("unreachable", f"'{self._name}' gives no hosts: {error}") from error
        raise AssertionError

    def close(self) -> None:
        self._stop()
        self._log.close()

    def kill(self, pid: int, number: int) -> None:
        """Let the template send a signal: only its parent knows whether the process number is still in use."""
        if self._control and pid not in self._ended:
            with suppress(OSError):
                self._control.sendall(b"kill %d %d\n" % (pid, number))

    def status(self, pid: int, seconds: float) -> int | None:
        """How the host ended, or None if it has not within ``seconds``; -9 when the template is gone."""
        deadline = time.monotonic() + seconds
        while pid not in self._ended:
            if self._control is None:
                return -signal.SIGKILL
            try:
                if not self._read_notices(deadline):
                    return None
            except (OSError, EOFError):
                return -signal.SIGKILL
        return self._ended[pid]

    def forget(self, pid: int) -> None:
        """The exit status is not needed any more."""
        self._ended.pop(pid, None)

    @property
    def notices(self) -> int:
        """Readable when a host has ended."""
        return self._control.fileno() if self._control else -1

    def _start(self) -> None:
        self._log.seek(0)
        self._log.truncate()
        ours, theirs = socket.socketpair()
        with theirs:
            self._process = subprocess.Popen(
                [*self._command, "--control", str(theirs.fileno())],
                stdin=subprocess.DEVNULL,
                stdout=self._log,
                stderr=self._log,
                pass_fds=[theirs.fileno()],
                start_new_session=True,  # an interrupt at the terminal is for the harness
            )
        self._control, self._unread, self._forked, self._ended = ours, b"", [], {}
        try:
            first = self._read_line(time.monotonic() + START_SECONDS)
        except (OSError, EOFError):
            first = ""
        except BaseException:
            self._stop()
            raise
        if first == "ready":
            return
        status = self._stop()
        if first is None:
            raise self._unavailable("unreachable", f"'{self._name}' was not loaded within {START_SECONDS:g} s")
        if first.startswith("failed "):
            raise WrongUse(f"'{self._name}': {json.loads(first.removeprefix('failed '))}")
        how = signal.Signals(-status).name if status < 0 else f"exit status {status}"
        raise self._unavailable("unreachable", f"'{self._name}' ended while it was loaded: {how}")

    def _fork(self) -> Channel:
        assert self._control
        host_in, target = os.pipe()
        source, host_out = os.pipe()
        error, host_error = os.pipe()
        try:
            socket.send_fds(self._control, [b"fork\n"], [host_in, host_out, host_error])
            deadline = time.monotonic() + START_SECONDS
            while not self._forked:
                if not self._read_notices(deadline):
                    raise TimeoutError("the template does not answer")
        except BaseException:
            for descriptor in (target, source, error):
                os.close(descriptor)
            raise
        finally:
            for descriptor in (host_in, host_out, host_error):
                os.close(descriptor)
        return HostProcess(self, self._forked.pop(), source, target, error)

    def _read_notices(self, deadline: float) -> bool:
        line = self._read_line(deadline)
        if line is None:
            return False
        word, *numbers = line.split()
        if word == "forked":
            self._forked.append(int(numbers[0]))
        elif word == "ended":
            self._ended[int(numbers[0])] = int(numbers[1])
        return True

    def _read_line(self, deadline: float) -> str | None:
        assert self._control
        while b"\n" not in self._unread:
            if not select.select([self._control], [], [], max(deadline - time.monotonic(), 0))[0]:
                return None
            data = self._control.recv(4096)
            if not data:
                raise EOFError("the template has ended")
            self._unread += data
        line, _, self._unread = self._unread.partition(b"\n")
        return line.decode()

    def _stop(self) -> int:
        if self._control:
            self._control.close()
            self._control = None
        process, self._process = self._process, None
        if process is None:
            return 0
        try:
            return process.wait(_FAREWELL_SECONDS)
        except subprocess.TimeoutExpired:
            with suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
            return process.wait()

    def _unavailable(self, kind: IncidentKind, detail: str) -> HostUnavailable:
        self._log.seek(0)
        return HostUnavailable(Incident(kind, detail, self._log.read()[-_LOG_TAIL:].decode(errors="replace")))


class HostProcess:
    """A host forked by a template."""

    def __init__(self, template: TemplateProcess, pid: int, source: int, target: int, error: int) -> None:
        self._template = template
        self._open = True
        self.pid: int | None = pid
        self._pid = pid
        self.source = source
        self.target = target
        self.error: int | None = error
        self.notices: int | None = template.notices

    def signal(self, number: int) -> None:
        self._template.kill(self._pid, number)

    def status(self, seconds: float) -> int | None:
        return self._template.status(self._pid, seconds)

    def close(self, orderly: bool) -> None:
        if not self._open:
            return
        self._open = False
        os.close(self.target)
        try:
            if not orderly or self.status(_FAREWELL_SECONDS) is None:
                self.signal(signal.SIGKILL)
                self.status(_RETRY_SECONDS)
        finally:
            self._template.forget(self._pid)
            os.close(self.source)
            if self.error is not None:
                os.close(self.error)


class Connector:
    """Connects to a host that runs already; retries for a moment, because a replaced host may still be ending."""

    def __init__(self, endpoint: Endpoint) -> None:
        self._endpoint = endpoint

    def open(self) -> Channel:
        deadline = time.monotonic() + _RETRY_SECONDS
        while True:
            try:
                return Connection(self._connect())
            except OSError as error:
                if time.monotonic() > deadline:
                    detail = f"no adapter answers at {self._endpoint.text}: {error.strerror or error}; is the adapter running?"
                    raise HostUnavailable(Incident("unreachable", detail)) from error
            time.sleep(0.05)

    def close(self) -> None:
        """Nothing to end: the host runs on."""

    def _connect(self) -> socket.socket:
        if self._endpoint.kind == "unix":
            connection = socket.socket(socket.AF_UNIX)
            try:
                connection.connect(self._endpoint.target)
            except OSError:
                connection.close()
                raise
            return connection
        host, _, port = self._endpoint.target.rpartition(":")
        connection = socket.create_connection((host, int(port)), timeout=_RETRY_SECONDS)
        connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        return connection


class Connection:
    """A host at the other end of a socket: it can be disconnected, not killed."""

    pid: int | None = None
    error: int | None = None
    notices: int | None = None

    def __init__(self, connection: socket.socket) -> None:
        connection.setblocking(False)
        self._socket = connection
        self.source = connection.fileno()
        self.target = os.dup(self.source)
        self._open = True

    def signal(self, number: int) -> None:
        """A remote host gets no signals."""

    def status(self, seconds: float) -> int | None:
        return None

    def close(self, orderly: bool) -> None:
        if self._open:
            self._open = False
            os.close(self.target)
            self._socket.close()
