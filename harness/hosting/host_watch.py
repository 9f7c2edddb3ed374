"""Watches one host: sends and receives lines, and reports every violation of limits or protocol as an incident."""

from __future__ import annotations

import os
import select
import signal
import time
from collections import deque
from contextlib import suppress
from dataclasses import dataclass
from typing import NoReturn, Protocol

import msgspec

from ucm_cts.adapters.sdk.python.loading import Answer
from ucm_cts.harness.hosting.host_channels import Channel
from ucm_cts.harness.hosting.last_words import LastWords
from ucm_cts.harness.hosting.loaded_files import loaded_by
from ucm_cts.harness.hosting.process_tree import resident
from ucm_cts.harness.results.values import Incident, IncidentKind

_CHUNK = 1 << 16
_MOST_AT_ONCE = 1 << 18
"""Bytes that are read of standard error before other things are attended to."""

_CHECK_SECONDS = 0.05
_CHECK_ALL_SECONDS = 0.25
"""Between two samples of the memory of all processes of a host, each of which reads the system's table of processes."""

_POLL_MILLISECONDS = 50
_LONGEST_ROUND = 0.5
"""Seconds that one round of waiting takes at most, unless the system has not let this process run."""

_STACK_SECONDS = 0.3
_QUIET_SECONDS = 0.05
_END_SECONDS = 0.5
_MIB = 1 << 20
_PAGE = os.sysconf("SC_PAGE_SIZE")


@dataclass(frozen=True)
class Limits:
    """What a host may use.

    ``seconds``: for an answer, without the waits of the scenario.
    ``memory``: MiB of resident memory, of the host and all processes that it has started.
    ``processes``: how many processes a host may have, with itself.
    ``line``: bytes of one message.
    ``welcome_seconds``: from the start until it has sent ``welcome``.
    ``incident_seconds``: of one run for all incidents of its hosts.
    """

    seconds: float = 5.0
    memory: int = 1024
    line: int = 16 * _MIB
    welcome_seconds: float = 20.0
    incident_seconds: float = 60.0
    processes: int = 256


@dataclass(frozen=True)
class Usage:
    """What a host's process holds: ``threads``, and open ``files`` (sockets and pipes count as files)."""

    threads: int
    files: int


class Deadline(msgspec.Struct, frozen=True):
    """A point of time by ``time.monotonic``, and the seconds until then when it was set."""

    end: float
    seconds: float

    @classmethod
    def after(cls, seconds: float) -> Deadline:
        """The deadline ``seconds`` from now."""
        return cls(time.monotonic() + seconds, seconds)


class HostIncident(Exception):
    """The host violated the protocol or a limit, and has been ended."""

    def __init__(self, incident: Incident) -> None:
        super().__init__(f"{incident.kind}: {incident.detail}")
        self.incident = incident


class Host(Protocol):
    """A host as the pipeline sees it; lines are without newline."""

    def submit(self, line: bytes) -> None:
        """Send a message, now or while waiting for answers. Never blocks and never raises."""

    def receive(self, deadline: Deadline) -> bytes:
        """The next message of the host. Raises ``HostIncident``, also when the deadline passes."""

    def fail(self, kind: IncidentKind, detail: str) -> NoReturn:
        """End the host because of its message: raises ``HostIncident``."""

    def printed(self) -> str:
        """What the host has printed since the last call, at most the last part of it."""

    def keep_to_one_core(self, number: int) -> None:
        """Restrict the threads that a local host will start to one core: one for each ``number``, as far as there are so many."""

    def usage(self) -> Usage | None:
        """What its process holds now; None if that cannot be counted."""

    def loaded_files(self) -> frozenset[str]:
        """The files that its processes have loaded as code; none of a host on another machine."""

    def close(self) -> None:
        """Let the host go."""


class WatchedHost:
    """A host behind a channel. Reads and writes at the same time, so that pipelined messages cannot lock up."""

    def __init__(self, channel: Channel, limits: Limits) -> None:
        self._channel = channel
        self._source = channel.source
        self._limits = limits
        self._outgoing = bytearray()
        self._partial = bytearray()
        self._lines: deque[bytes] = deque()
        self._stderr = LastWords()
        self._checked = 0.0
        self._checked_all = time.monotonic()
        self._printed = LastWords()
        self._writing = False
        self._ended = False
        self._poll = select.poll()
        os.set_blocking(channel.source, False)
        os.set_blocking(channel.target, False)
        self._poll.register(channel.source, select.POLLIN)
        if channel.error is not None:
            os.set_blocking(channel.error, False)
            self._poll.register(channel.error, select.POLLIN)
        if channel.notices is not None:
            self._poll.register(channel.notices, select.POLLIN)

    def submit(self, line: bytes) -> None:
        whole = line + b"\n"
        if not self._outgoing and len(whole) <= _CHUNK:  # the common case: it goes out at once
            with suppress(OSError):
                whole = whole[os.write(self._channel.target, whole) :]
            if not whole:
                return
        self._outgoing += whole
        if not self._writing:
            self._flush()

    def receive(self, deadline: Deadline) -> bytes:
        now, end = time.monotonic(), deadline.end
        if self._lines and now < end:
            return self._lines.popleft()
        while True:
            if self._ended and not self._read():  # even if the pipe is held open by a process that got away
                self._fail_ended()
            if now >= end:
                self._fail_hanging(deadline)
            if now >= self._checked + _CHECK_SECONDS:
                self._checked = now
                self._check_memory()
            for ready, _ in self._poll.poll(_POLL_MILLISECONDS):
                if ready == self._source:
                    self._read()
                else:
                    self._attend(ready)
            if self._lines:
                return self._lines.popleft()
            began, now = now, time.monotonic()
            end += max(0.0, now - began - _LONGEST_ROUND)  # a machine that stood still stopped the host, too

    def _attend(self, ready: int) -> None:
        if ready == self._channel.error:
            self._drain()
        elif ready == self._channel.target:
            self._flush()
        elif self._channel.status(0) is not None:
            self._ended = True

    def fail(self, kind: IncidentKind, detail: str) -> NoReturn:
        self._drain()
        text = self._stderr.text()
        self._close(orderly=False)
        raise HostIncident(Incident(kind, detail, text))

    def printed(self) -> str:
        self._drain()
        text = self._printed.text()
        self._printed.clear()
        return text

    def keep_to_one_core(self, number: int) -> None:
        if self._channel.pid is not None:
            with suppress(OSError, AttributeError):  # it is gone, or this system has no such thing
                cores = sorted(os.sched_getaffinity(0))
                os.sched_setaffinity(self._channel.pid, {cores[number % len(cores)]})

    def close(self) -> None:
        self._close(orderly=True)

    def _close(self, orderly: bool) -> None:
        self._channel.close(orderly)

    def _flush(self) -> None:
        try:
            while self._outgoing:
                with memoryview(self._outgoing) as pending:
                    written = os.write(self._channel.target, pending[:_CHUNK])
                del self._outgoing[:written]
        except BlockingIOError:
            pass
        except OSError:  # the host is ending, which the next read shows
            self._outgoing.clear()
        if bool(self._outgoing) != self._writing:
            self._writing = not self._writing
            if self._writing:
                self._poll.register(self._channel.target, select.POLLOUT)
            else:
                self._poll.unregister(self._channel.target)

    def _read(self) -> bool:
        """Read the available bytes; False if there were none."""
        try:
            data = os.read(self._source, _CHUNK)
        except BlockingIOError:
            return False
        except OSError:  # a connection that was reset
            data = b""
        if not data:
            self._fail_ended()
        if not self._partial and data.find(b"\n") == len(data) - 1:  # the common case: just one answer
            self._lines.append(data[:-1])
            return True
        start = len(self._partial)
        self._partial += data
        end = self._partial.rfind(b"\n", start)
        if end >= 0:
            self._lines.extend(bytes(self._partial[:end]).split(b"\n"))
            del self._partial[: end + 1]
        if len(self._partial) > self._limits.line:
            self.fail("flood", f"a line of more than {self._limits.line / _MIB:g} MiB")
        return True

    def _drain(self) -> int:
        """Keep the last bytes of standard error; returns how many were new."""
        new = 0
        with suppress(OSError):
            while self._channel.error is not None and new < _MOST_AT_ONCE:
                data = os.read(self._channel.error, _CHUNK)
                if not data:
                    self._poll.unregister(self._channel.error)
                    os.close(self._channel.error)
                    self._channel.error = None
                new += len(data)
                for kept in (self._stderr, self._printed):
                    kept.add(data)
        return new

    def _check_memory(self) -> None:
        if self._channel.pid is None:
            return
        try:
            with open(f"/proc/{self._channel.pid}/statm") as statm:
                held = int(statm.read().split()[1]) * _PAGE // _MIB
        except (OSError, IndexError):
            return
        if held <= self._limits.memory and self._checked >= self._checked_all + _CHECK_ALL_SECONDS:
            self._checked_all = self._checked
            before, processes = self._channel.loaded, self._channel.processes()
            number = len(processes) - before.processes
            if number > self._limits.processes:
                self._fail_all(f"{number} processes, {self._limits.processes} allowed")
            held = resident(processes, self._limits.memory + before.memory) - before.memory
            if held > self._limits.memory:
                self._fail_all(f"{held} MiB in {number} processes, {self._limits.memory} MiB allowed")
        if held > self._limits.memory:
            self.fail("memory", f"{held} MiB resident, {self._limits.memory} MiB allowed")

    def _fail_all(self, detail: str) -> NoReturn:
        """End the host and everything that was started with it: one process may start others as fast as they are ended."""
        try:
            self.fail("memory", detail)
        finally:
            self._channel.end_all()

    def usage(self) -> Usage | None:
        try:
            threads, files = (len(os.listdir(f"/proc/{self._channel.pid}/{kind}")) for kind in ("task", "fd"))
        except OSError:
            return None
        return Usage(threads, files)

    def loaded_files(self) -> frozenset[str]:
        return loaded_by(process.pid for process in self._channel.processes())

    def _fail_hanging(self, deadline: Deadline) -> NoReturn:
        self._drain()
        self._stderr.clear()
        self._channel.signal(signal.SIGUSR1)
        stop = time.monotonic() + _STACK_SECONDS
        while self._channel.error is not None and time.monotonic() < stop:
            patient = select.poll()
            patient.register(self._channel.error, select.POLLIN)
            wait = _QUIET_SECONDS if self._stderr else stop - time.monotonic()
            if not patient.poll(1000 * max(wait, 0)):
                break
            self._drain()
        self.fail("hang", f"no answer within {deadline.seconds:g} s")

    def _fail_ended(self) -> NoReturn:
        half = f" after {len(self._partial)} bytes of an answer" if self._partial else ""
        if self._channel.pid is None:
            self.fail("exit", f"the connection was closed{half}")
        status = self._channel.status(_END_SECONDS)
        if status is None:
            self.fail("exit", f"closed its output{half}")
        if status < 0:
            self.fail("crash", f"{_signal_name(-status)}{half}")
        self.fail("exit", f"exit status {status}{half}")


class InProcessHost:
    """The adapter inside the harness process, not watched: for debuggers and sanitizers."""

    def __init__(self, answer: Answer) -> None:
        self._answer = answer
        self._questions: deque[bytes] = deque()
        self._lines: deque[bytes] = deque()

    def submit(self, line: bytes) -> None:
        self._questions.append(line)

    def receive(self, deadline: Deadline) -> bytes:
        if not self._lines:
            answer = self._answer(self._questions.popleft(), lambda line: self._lines.append(line.rstrip(b"\n")))
            self._lines.append(answer)
        return self._lines.popleft()

    def fail(self, kind: IncidentKind, detail: str) -> NoReturn:
        raise HostIncident(Incident(kind, detail))

    def printed(self) -> str:
        return ""  # it went to the terminal

    def keep_to_one_core(self, number: int) -> None:
        """Nothing to do: the cores are those of the harness."""

    def usage(self) -> Usage | None:
        """None: the harness itself starts threads in this process."""
        return None

    def loaded_files(self) -> frozenset[str]:
        return loaded_by([os.getpid()])

    def close(self) -> None:
        self._questions.clear()


def _signal_name(number: int) -> str:
    try:
        return signal.Signals(number).name
    except ValueError:
        return f"signal {number}"
