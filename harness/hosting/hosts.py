"""Hosts: give scenarios to the host behind an endpoint and get an answer to each, even if the host crashes or hangs.

    with Hosts(locate("reference-py")) as hosts:
        print(hosts.welcome.product)
        for answer in hosts.run(Run(number, scenario) for number, scenario in enumerate(scenarios)):
            match answer.reply:
                case Traced(): ...
                case Refused() | Incident(): ...

One host is active at a time. It is replaced after an incident, and after an answer that names stuck threads; the
messages that were on their way to it are sent again to its successor.
"""

from __future__ import annotations

import itertools
import os
import sys
import time
from collections import Counter, deque
from collections.abc import Generator, Iterable, Sequence
from contextlib import suppress
from typing import Self

import msgspec

from ucm_cts.adapters.contract import messages as m
from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.trace import Event
from ucm_cts.adapters.sdk.python.host import ASKED_FOR_MODULES
from ucm_cts.adapters.sdk.python.loading import CannotLoad, load
from ucm_cts.harness.hosting.host_channels import HostUnavailable, Opener, TemplateProcess
from ucm_cts.harness.hosting.host_watch import (
    Deadline,
    Host,
    HostIncident,
    InProcessHost,
    Limits,
    Usage,
    WatchedHost,
)
from ucm_cts.harness.hosting.locate import Endpoint, WrongUse
from ucm_cts.harness.hosting.pace import Pace, waits
from ucm_cts.harness.hosting.remote_hosts import Connector
from ucm_cts.harness.hosting.sandbox import GIVEN_UP, why_none
from ucm_cts.harness.hosting.view import view_of
from ucm_cts.harness.hosting.virtual_time import LIBRARY
from ucm_cts.harness.results.foreign import one_line
from ucm_cts.harness.results.values import Incident, Isolation

__all__ = ["Answer", "HostUnavailable", "Hosts", "Limits"]

_SHOWN = 80

_NARROW = 4
"""How many messages are on their way to a product that may be slow, so that others may take the next ones."""

_FORK_SECONDS = 2.0
"""How long the fork of a host may take, at least."""

LONGEST = 4
"""A run that sends its events as they happen may take so many times what it is allowed, as long as they come."""


class Answer(msgspec.Struct, frozen=True):
    """The result of the ``Run`` message with ``id``.

    ``id``: of the message.
    ``reply``: the trace, a refusal, or an incident.
    ``happened``: events that a streamed run sent ahead: after an incident, the known part of the trace.
    ``host``: the number of the host.
    ``printed``: what the host printed meanwhile.
    ``sent``, ``received``: when the host got the message, and when its answer was there, in nanoseconds of ``time.monotonic_ns``.
    """

    id: int
    reply: m.Traced | m.Refused | Incident
    happened: tuple[Event, ...] = ()
    host: int = 0
    sent: int = 0
    received: int = 0
    printed: str = ""


class Hosts:
    """The hosts behind ``endpoint``, one at a time. Close it, or use it in a ``with`` statement: nothing stays behind.

    ``welcome``: what the first host must say of the product, if that is known.
    ``core``: the number of the core that hosts are kept to when they are to have one only.
    ``pace``: of the product; other hosts may share it.
    Raises ``WrongUse`` from ``welcome`` and ``run`` if the endpoint leads to no adapter, ``HostUnavailable`` if no first
    host can be had.
    """

    def __init__(
        self,
        endpoint: Endpoint,
        limits: Limits | None = None,
        welcome: m.Welcome | None = None,
        core: int = 0,
        pace: Pace | None = None,
    ) -> None:
        self._endpoint = endpoint
        self.pace = pace or Pace()
        self._core = core
        self.limits = limits or Limits()
        self._opener: Opener | None = None
        self._host: Host | None = None
        self._welcome = welcome
        self._opened = self._latest = 0
        self._is_over = False
        self.left_behind: Counter[str] = Counter()
        """The command lines of processes that hosts left behind, which were ended, and how many of each."""

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:
        self.close()

    @property
    def welcome(self) -> m.Welcome:
        """The product behind the endpoint; starts a host if there has not been one."""
        if self._welcome is None:
            self._open()
            assert self._welcome
        return self._welcome

    def run(self, runs: Iterable[m.Run], window: int = 32) -> Generator[Answer, None, None]:
        """The answers to ``runs``, in order; up to ``window`` messages are on their way at a time, fewer until its pace is known.

        Between two answers the caller may ``run_again``: what was on its way is then sent again.
        If there is no host any more, what remains is answered by incidents of kind ``unreachable``.
        """
        assert window > 0
        waiting: deque[m.Run] = deque()
        when: deque[int] = deque()
        source = iter(runs)
        current: Host | None = None
        sent = 0  # how many of those waiting have been sent to the current host
        try:
            while True:
                most = window if self.pace.is_known else min(window, _NARROW)
                waiting.extend(itertools.islice(source, max(0, most - len(waiting))))
                if not waiting:
                    return
                if self._host is None:
                    try:
                        self._open()
                    except HostUnavailable as error:
                        if self._welcome is None:
                            raise
                        lost = Incident("unreachable", error.incident.detail, error.incident.stacks)
                        for run in itertools.chain(tuple(waiting), source):
                            yield Answer(run.id, lost)
                        waiting.clear()
                        return
                    assert self._host
                if self._host is not current:
                    current, sent = self._host, 0
                    when.clear()
                for run in itertools.islice(waiting, sent, None):
                    when.append(time.monotonic_ns())
                    current.submit(m.encode(run))
                sent = len(waiting)
                host = self._opened
                answer = self._receive(waiting[0])
                before, began, self._latest = self._latest, when.popleft(), time.monotonic_ns()
                if isinstance(answer.reply, m.Traced):
                    at_most = (self._latest - max(began, before)) / 1e9
                    self.pace.note(waiting[0].scenario, answer.reply.events, at_most)
                answer = msgspec.structs.replace(answer, host=host, sent=began, received=self._latest)
                waiting.popleft()
                sent -= 1
                yield answer
        finally:
            if waiting:  # the caller has stopped asking for these answers
                self.discard()

    def run_again(self, run: m.Run, one_core: bool = False, stream: bool = True, first: Sequence[m.Run] = ()) -> Answer:
        """Run one scenario on a fresh host, perhaps on ``one_core`` only; by default it sends each event as it happens.

        ``first``: what the host runs before. If it does not answer one of these, the scenario gets a host of its own.
        May be called between two answers of a ``run`` in progress, which goes on with a fresh host.
        """
        if first:
            *others, answer = self._run_alone([*first, run], one_core)
            if len(others) == len(first) and all(isinstance(one.reply, m.Traced) for one in others):
                return answer
        (answer,) = self._run_alone([msgspec.structs.replace(run, stream=stream)], one_core)
        return answer

    def _run_alone(self, runs: Sequence[m.Run], one_core: bool) -> list[Answer]:
        """The answers of a fresh host; the last one is to what was lost with the host."""
        answers: list[Answer] = []
        self.discard()
        try:
            if one_core:
                with suppress(HostUnavailable):  # the run itself reports that no host can be had
                    self._open()
                    assert self._host
                    self._host.keep_to_one_core(self._core)
            for answer in self.run(runs):
                answers.append(answer)
                if not isinstance(answer.reply, m.Traced) or answer.reply.stuck:
                    break
        finally:
            self.discard()
        return answers

    @property
    def isolation(self) -> Isolation:
        """Where the adapter runs."""
        if self._endpoint.in_process:
            return "none"
        if self._endpoint.kind in ("tcp", "unix"):
            return "remote"
        return "process" if self.no_sandbox else "bubblewrap"

    @property
    def no_sandbox(self) -> str:
        """Why local hosts run without a sandbox; empty if they have one, or are not local."""
        if self._endpoint.in_process or self._endpoint.kind in ("tcp", "unix"):
            return ""
        return why_none() if self._endpoint.sandbox else GIVEN_UP

    @property
    def usage(self) -> Usage | None:
        """What the process of the current host holds; None if there is no host, or none on this machine."""
        return self._host.usage() if self._host is not None else None

    def loaded_files(self) -> frozenset[str]:
        """The files that the current host has loaded as code; a host is started if there is none.

        Libraries are those that the system names. Modules of Python, which the system does not know, are those that the host names.
        """
        if self._host is None:
            with suppress(HostUnavailable):
                self._open()
        return self._host.loaded_files() | self._modules() if self._host is not None else frozenset()

    def _modules(self) -> frozenset[str]:
        """The files of the modules that the current host says it has loaded."""
        if self._endpoint.kind != "python" or self._endpoint.in_process or self._host is None:
            return frozenset()
        self._host.submit(ASKED_FOR_MODULES.rstrip())
        try:
            files = msgspec.json.decode(self._host.receive(Deadline.after(self.limits.seconds)), type=list[str])
        except HostIncident:
            self._host = None
            return frozenset()
        except (msgspec.MsgspecError, UnicodeDecodeError, RecursionError):
            self.discard()  # what else it has to say answers nothing
            return frozenset()
        return frozenset(file for file in files if "\0" not in file and os.path.isabs(file))

    def close(self) -> None:
        """End the host and everything that was started for it."""
        self.discard()
        if self._opener:
            self._opener.close()
            self.left_behind = self._opener.left_behind
            self._opener = None

    def end_all(self) -> None:
        """Kill the host and everything that was started for it; there is no other host afterwards. Another thread may be waiting for an
        answer, or start a host.
        """
        self._is_over = True
        if self._opener is not None:
            self._opener.end_all()

    def _open(self) -> None:
        self.discard()
        host = self._new_host()
        try:
            welcome = self._greet(host)
        except HostIncident as error:
            hint = self._opener.hint(error.incident.stacks) if self._opener is not None else ""
            raise HostUnavailable(_explained(error.incident, self._endpoint, hint)) from error
        except BaseException:
            host.close()
            raise
        if self._welcome is not None and welcome != self._welcome:
            host.close()
            raise HostUnavailable(Incident("unreachable", _changed(self._welcome, welcome)))
        self._host, self._welcome = host, welcome
        self._opened += 1

    def _new_host(self) -> Host:
        if self._endpoint.in_process:
            try:
                return InProcessHost(load(self._endpoint.target))
            except CannotLoad as error:
                raise WrongUse(f"'{self._endpoint.text}': {error}") from error
        if self._opener is None:
            self._opener = _opener(self._endpoint, self.limits.memory)
        channel = self._opener.open(max(self.limits.seconds, _FORK_SECONDS))
        self.left_behind = self._opener.left_behind
        if self._is_over:
            channel.close(orderly=False)
            raise HostUnavailable(Incident("unreachable", "no host is wanted any more"))
        return WatchedHost(channel, self.limits)

    def _greet(self, host: Host) -> m.Welcome:
        host.submit(m.encode(m.Hello(m.PROTOCOL)))
        message = _decode(host, host.receive(Deadline.after(self.limits.welcome_seconds)))
        if isinstance(message, m.Refused):
            host.fail("refused", message.reason)
        if not isinstance(message, m.Welcome):
            host.fail("protocol", f"{_tag(message)} where welcome is due")
        if message.protocol != m.PROTOCOL:
            host.fail("protocol", f"the host speaks protocol {message.protocol}, the harness {m.PROTOCOL}")
        return message

    def _receive(self, run: m.Run) -> Answer:
        assert self._host
        happened: list[Event] = []
        try:
            reply = self._receive_reply(self._host, run, happened)
        except HostIncident as error:
            self._host = None
            return Answer(run.id, error.incident, tuple(happened))
        except BaseException:
            self.discard()
            raise
        printed = self._host.printed()
        if isinstance(reply, m.Traced) and reply.stuck:
            self.discard()
        return Answer(run.id, reply, tuple(happened), printed=printed)

    def _receive_reply(self, host: Host, run: m.Run, happened: list[Event]) -> m.Traced | m.Refused:
        allowed = self.allowed(run.scenario)
        deadline, last = Deadline.after(allowed), Deadline.after(LONGEST * allowed)
        while True:
            message = _decode(host, host.receive(deadline))
            if isinstance(message, m.Welcome) or (isinstance(message, m.Happened) and not run.stream):
                host.fail("protocol", f"{_tag(message)} where trace is due")
            if message.id != run.id and not (isinstance(message, m.Refused) and message.id is None):
                host.fail("protocol", f"{_tag(message)} has id {message.id} where {run.id} is due")
            if not isinstance(message, m.Happened):
                return message
            happened.append(message.event)
            deadline = min(Deadline.after(allowed), last, key=lambda one: one.end)  # it is slow, and goes on

    def allowed(self, scenario: s.Scenario) -> float:
        """How many seconds ``scenario`` may take."""
        return self.limits.seconds + waits(scenario) + self.pace.more_for(len(scenario.steps))

    def start_fresh(self) -> None:
        """End the host, if there is one, and start another. Raises ``HostUnavailable`` and ``WrongUse``."""
        self._open()

    def discard(self) -> None:
        """End the host, if there is one; the next run gets a fresh one."""
        host, self._host = self._host, None
        if host:
            host.close()


def _decode(host: Host, line: bytes) -> m.FromHost:
    try:
        return m.from_host_decoder().decode(line)
    except msgspec.ValidationError as error:
        host.fail("protocol", str(error))
    except (msgspec.DecodeError, UnicodeDecodeError, RecursionError):
        shown = line[:_SHOWN].decode(errors="replace") + ("…" if len(line) > _SHOWN else "")
        host.fail("garbage", f"not a JSON message: {shown!r}")


def _tag(message: m.FromHost) -> str:
    return str(type(message).__struct_config__.tag)


def _changed(before: m.Welcome, after: m.Welcome) -> str:
    """How a host differs from the first one of the run."""
    named, now = (one_line(f"{w.product} {w.version}", 80) for w in (before, after))
    if named == now:
        return f"the host says other things of '{now}' than the first host of this run; it must not change during a run"
    return f"the host is of '{now}', and the first host of this run was of '{named}'; a product must not change during a run"


def _explained(incident: Incident, endpoint: Endpoint, hint: str) -> Incident:
    problem = f"'{endpoint.text}' does not answer hello: {incident.kind}, {incident.detail}"
    return msgspec.structs.replace(incident, detail=f"{problem}; {hint}" if hint else problem)


def _opener(endpoint: Endpoint, memory: int) -> Opener:
    """The opener of ``endpoint``, which is not an in-process one. ``memory``: MiB that files of its hosts may take."""
    if endpoint.kind in ("tcp", "unix"):
        return Connector(endpoint)
    serving = "virtual_time" if endpoint.virtual_time else "host"
    module = "ucm_cts.adapters.sdk.python." + (serving if endpoint.kind == "python" else "spawner")
    preloaded = [str(LIBRARY)] if endpoint.virtual_time and endpoint.kind == "executable" else []
    options = [f"--preload={library}" for library in preloaded]
    command = [sys.executable, "-X", "faulthandler", "-m", module, endpoint.target, *options]
    if not endpoint.sandbox or why_none():
        return TemplateProcess(command, endpoint.text)
    needed = [endpoint.target, *preloaded] if os.path.isabs(endpoint.target) else []
    return TemplateProcess(command, endpoint.text, view_of(needed, hidden=endpoint.hidden, mebibytes=memory))
