"""Channels to hosts, and the hosts that a template forks as processes. ``host_watch`` watches them."""

from __future__ import annotations

import json
import os
import re
import select
import signal
import socket
import time
from collections import Counter
from contextlib import suppress
from dataclasses import dataclass
from typing import Protocol

import psutil

from ucm_cts.adapters.sdk.python.template import NO_CONTROL
from ucm_cts.harness.hosting.last_words import Listener
from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.hosting.process_tree import is_stopped, resident
from ucm_cts.harness.hosting.sandbox import Started, start
from ucm_cts.harness.hosting.view import View
from ucm_cts.harness.results.foreign import clean, one_line
from ucm_cts.harness.results.values import Incident, IncidentKind

START_SECONDS = 60.0
"""How long an adapter may take to be loaded."""

_GLANCE_SECONDS = 0.2
_LONGEST_LINE = 1 << 16
_CONTROL_CHANNEL = "the control channel of its host; an adapter leaves descriptors alone that it has not opened"
_FAREWELL_SECONDS = 0.5
_KILLED_SECONDS = 1.0
_LAST_LINES = 20
_GONE = -1
"""In place of the number of a process that has ended before it could be found."""


class HostUnavailable(Exception):
    """No host can be started or reached at an endpoint; ``incident`` says why, the text has its last lines."""

    def __init__(self, incident: Incident) -> None:
        printed = incident.stacks.strip().splitlines()
        shown = [one_line(line) for line in printed[-_LAST_LINES:]]
        if len(printed) > len(shown):
            shown.insert(0, f"({len(printed) - len(shown)} more lines)")
        super().__init__("\n".join([clean(incident.detail), *shown]))
        self.incident = incident


@dataclass(frozen=True)
class Loaded:
    """What was there before the first host: the number of ``processes`` and the ``memory`` in MiB that they hold together."""

    processes: int = 0
    memory: int = 0


class Channel(Protocol):
    """The file descriptors of one host, and the operations on its process."""

    source: int
    target: int
    error: int | None
    pid: int | None
    notices: int | None
    """Readable when ``status`` may have changed."""

    loaded: Loaded

    def processes(self) -> frozenset[psutil.Process]:
        """All processes behind the endpoint, if they are ours: those of ``loaded``, the host, and what it has started."""

    def signal(self, number: int) -> None:
        """Send a signal to the host, if it is a process of ours that still runs."""

    def status(self, seconds: float) -> int | None:
        """How the host ended, negative for a signal; None if it has not, after waiting for ``seconds``."""

    def close(self, orderly: bool) -> None:
        """Let the host go. ``orderly`` lets it end by itself for a moment; otherwise it is killed."""

    def end_all(self) -> None:
        """Kill the host and everything else behind the endpoint, if these are processes of ours."""


class Opener(Protocol):
    """Makes fresh hosts behind one endpoint.

    ``left_behind``: the command lines of processes that hosts left behind, which were ended, and how many of each.
    """

    left_behind: Counter[str]

    def open(self, seconds: float) -> Channel:
        """A fresh host, within ``seconds`` if the adapter is loaded.

        Raises ``HostUnavailable``, and ``WrongUse`` if the endpoint leads to no adapter.
        """

    def hint(self, text: str) -> str:
        """Why a sandbox may be the reason for what ``text`` says; empty if nothing says so."""

    def end_all(self) -> None:
        """Kill all hosts and the process that forks them, if these are processes of ours."""

    def close(self) -> None:
        """End all hosts and the process that forks them."""


class ControlBroken(OSError):
    """What came over the control channel is not from the template."""


_NOTICE = re.compile(
    r"forked (?P<forked>[1-9]\d{0,9})|ended (?P<ended>[1-9]\d{0,9}) (?P<status>-?\d{1,5}) (?P<strays>\[.*\])"
)


class TemplateProcess:
    """Client of ``adapters.python.template``; started on demand, and once more if it has ended."""

    def __init__(self, command: list[str], name: str, view: View | None = None) -> None:
        """``view``: what the sandbox of all hosts sees; None for no sandbox."""
        self.left_behind: Counter[str] = Counter()
        self._command = command
        self._name = name
        self._view = view
        self._started: Started | None = None
        self.loaded = Loaded()
        self._control: socket.socket | None = None
        self._listener: Listener | None = None
        self._unread = b""
        self._forked: list[int] = []
        self._ended: dict[int, int] = {}
        self._hosts: set[int] = set()

    def open(self, seconds: float) -> Channel:
        for last in (False, True):
            if self._control is None:
                self._start(seconds)
            try:
                return self._fork(seconds)
            except (OSError, EOFError) as error:
                self._stop()
                if last:
                    raise self._unavailable("unreachable", f"'{self._name}' gives no hosts: {error}") from error
        raise AssertionError

    def close(self) -> None:
        self._stop()

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

    def processes(self) -> frozenset[psutil.Process]:
        """Everything behind the endpoint."""
        return self._started.processes() if self._started is not None else frozenset()

    def end_all(self) -> None:
        """End at once what was started; the next host comes from a new template."""
        if self._started is not None:
            self._stop(at_once=True)

    def _start(self, seconds: float) -> None:
        """Load the adapter. A process that is stopped gets ``seconds``."""
        self._listener = Listener()
        ours, theirs = socket.socketpair()
        with theirs:
            control = theirs.fileno()
            try:
                self._started = start(
                    [*self._command, "--control", str(control)],
                    self._view,
                    pass_fds=[control],
                    out=self._listener.target,
                    error=self._listener.target,
                )
            except BaseException:
                ours.close()
                self._listener.close()
                raise
            self._listener.close_target()
        self._control, self._unread, self._forked, self._ended = ours, b"", [], {}
        try:
            first = self._read_first(seconds)
        except ControlBroken:
            first = "?"
        except (OSError, EOFError):
            first = ""
        except BaseException:
            self._stop()
            raise
        word, _, said = (first or "").partition(" ")
        text = _text(said)
        if first == "ready":
            helpers = self._started.processes()
            self.loaded = Loaded(len(helpers), resident(helpers, 0))
            return
        stopped = is_stopped(self._started.pid)
        lives = first == "" and not self._ends_soon()
        status = self._stop()
        if first is None:
            how = f": it is stopped (SIGSTOP), for {seconds:g} s" if stopped else f" within {START_SECONDS:g} s"
            raise self._unavailable("unreachable", f"'{self._name}' was not loaded{how}")
        if word == "failed" and text is not None:
            raise WrongUse(self._explained(f"'{self._name}': {text}"))
        if first or lives or status == NO_CONTROL:
            what = "writes to" if first else "has closed"
            raise self._unavailable("unreachable", f"'{self._name}' {what} {_CONTROL_CHANNEL}")
        how = _ending(status)
        raise self._unavailable("unreachable", f"'{self._name}' ended while it was loaded: {how}")

    def _read_first(self, seconds: float) -> str | None:
        """The first line of the template; None if it does not come in time."""
        assert self._started
        begun = time.monotonic()
        while time.monotonic() < begun + START_SECONDS:
            line = self._read_line(min(time.monotonic() + _GLANCE_SECONDS, begun + START_SECONDS))
            if line is not None:
                return line
            if time.monotonic() > begun + seconds and is_stopped(self._started.pid):
                return None
        return None

    def _fork(self, seconds: float) -> Channel:
        assert self._control
        assert self._started
        host_in, target = os.pipe()
        source, host_out = os.pipe()
        error, host_error = os.pipe()
        try:
            socket.send_fds(self._control, [b"fork\n"], [host_in, host_out, host_error])
            deadline = time.monotonic() + seconds
            while not self._forked:
                if not self._read_notices(deadline):
                    stopped = "is stopped (SIGSTOP)" if is_stopped(self._started.pid) else "does not answer"
                    raise TimeoutError(f"the process that forks them {stopped}, for {seconds:g} s")
            number = self._forked.pop()
            pid = self._started.child(number)
            while pid is None and number not in self._ended:  # else it has ended already
                if not self._read_notices(deadline):
                    raise ControlBroken(f"the adapter writes to {_CONTROL_CHANNEL}")
        except BaseException:
            for descriptor in (target, source, error):
                os.close(descriptor)
            raise
        finally:
            for descriptor in (host_in, host_out, host_error):
                os.close(descriptor)
        return HostProcess(self, number, _GONE if pid is None else pid, source, target, error)

    def _read_notices(self, deadline: float) -> bool:
        line = self._read_line(deadline)
        if line is None:
            return False
        notice = _NOTICE.fullmatch(line)
        strays = _texts(notice["strays"]) if notice and notice["strays"] else ()
        if notice is None or strays is None:
            raise ControlBroken(f"the adapter writes to {_CONTROL_CHANNEL}")
        if notice["forked"]:
            self._forked.append(int(notice["forked"]))
            self._hosts.add(self._forked[-1])
        else:
            self._ended[int(notice["ended"])] = int(notice["status"])
            self.left_behind.update(map(one_line, strays))
        return True

    def _read_line(self, deadline: float) -> str | None:
        assert self._control
        while b"\n" not in self._unread:
            if len(self._unread) > _LONGEST_LINE:
                raise ControlBroken(f"the adapter writes to {_CONTROL_CHANNEL}")
            if not _is_readable(self._control.fileno(), max(deadline - time.monotonic(), 0)):
                return None
            data = self._control.recv(4096)
            if not data:
                raise EOFError("the process that forks them has ended")
            self._unread += data
        line, _, self._unread = self._unread.partition(b"\n")
        return line.decode(errors="replace")

    def _stop(self, at_once: bool = False) -> int:
        if self._control:
            self._control.close()
            self._control = None
        started, self._started = self._started, None
        if started is None:
            return 0
        if at_once or not _has_ended(started.pid, _FAREWELL_SECONDS):
            for one in started.processes():  # it cannot end them any more
                with suppress(psutil.Error):
                    one.kill()
        status, strays = started.end()
        if self._listener is not None:
            self._listener.close()
        self.left_behind.update(one_line(name) for number, name in strays.items() if number not in self._hosts)
        return status

    def _ends_soon(self) -> bool:
        return self._started is None or _has_ended(self._started.pid, _FAREWELL_SECONDS)

    def hint(self, text: str) -> str:
        return self._view.hint(text) if self._view is not None else ""

    def _explained(self, problem: str) -> str:
        """``problem``, and what the sandbox may have to do with it."""
        hint = self.hint(problem)
        return f"{problem}; {hint}" if hint else problem

    def _unavailable(self, kind: IncidentKind, detail: str) -> HostUnavailable:
        printed = self._listener.text() if self._listener is not None else ""
        hint = self.hint(printed)
        return HostUnavailable(Incident(kind, f"{detail}; {hint}" if hint else detail, printed))


def _has_ended(pid: int, seconds: float) -> bool:
    """Whether process ``pid``, a child of ours, ends within ``seconds``."""
    try:
        handle = os.pidfd_open(pid)
    except OSError:
        return True
    try:
        return _is_readable(handle, seconds)
    finally:
        os.close(handle)


def _is_readable(descriptor: int, seconds: float) -> bool:
    """Whether ``descriptor`` can be read, or has come to its end, within ``seconds``. A process may have thousands of them."""
    poll = select.poll()
    poll.register(descriptor, select.POLLIN)
    return bool(poll.poll(seconds * 1000))


def _ending(status: int) -> str:
    return signal.Signals(-status).name if status < 0 else f"exit status {status}"


def _text(said: str) -> str | None:
    """The text that ``said`` holds as JSON; None if it holds none."""
    with suppress(ValueError, RecursionError):
        text = json.loads(said)
        return text if isinstance(text, str) else None
    return None


def _texts(said: str) -> tuple[str, ...] | None:
    """The texts that ``said`` holds as a list of JSON; None if it holds anything else."""
    with suppress(ValueError, RecursionError):
        texts = json.loads(said)
        return tuple(texts) if all(isinstance(text, str) for text in texts) else None
    return None


class HostProcess:
    """A host forked by a template."""

    def __init__(self, template: TemplateProcess, number: int, pid: int, source: int, target: int, error: int) -> None:
        """``number`` is the process in the eyes of the template, ``pid`` in ours."""
        self._template = template
        self._open = True
        self.pid: int | None = pid
        self._pid = number
        self.source = source
        self.target = target
        self.error: int | None = error
        self.notices: int | None = template.notices
        self.loaded = template.loaded

    def processes(self) -> frozenset[psutil.Process]:
        return self._template.processes()

    def signal(self, number: int) -> None:
        self._template.kill(self._pid, number)

    def status(self, seconds: float) -> int | None:
        return self._template.status(self._pid, seconds)

    def end_all(self) -> None:
        self._template.end_all()

    def close(self, orderly: bool) -> None:
        if not self._open:
            return
        self._open = False
        os.close(self.target)
        os.close(self.source)  # else a host with much to say waits until someone reads it
        try:
            if not orderly or self.status(_FAREWELL_SECONDS) is None:
                self.signal(signal.SIGKILL)
                self.status(_KILLED_SECONDS)
        finally:
            self._template.forget(self._pid)
            if self.error is not None:
                os.close(self.error)
