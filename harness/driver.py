"""Drives scenarios through a host: disguised, pipelined, with a second look at whatever went wrong."""

from __future__ import annotations

import itertools
import time
from collections import Counter, deque
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from types import TracebackType
from typing import Self, TypeVar

import msgspec

from ucm_cts.adapters.contract.messages import Refused, Run, Traced, Welcome
from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.adapters.contract.trace import Event, Trace
from ucm_cts.harness.disguise import Disguise
from ucm_cts.harness.hosts import Answer as HostAnswer
from ucm_cts.harness.hosts import Hosts, Limits
from ucm_cts.harness.integrity import contradiction
from ucm_cts.harness.locate import Door
from ucm_cts.harness.results import FRAMEWORK_INCIDENTS, Execution, Incident

__all__ = ["Answer", "Driver", "Limits"]

T = TypeVar("T")

SECONDS_FOR_INCIDENTS = 30
"""How long a run may deal with crashes and hangs before it gives up on the scenarios that remain."""

FULL_WAITS, SHORT_WAIT = 2, 0.5
"""After so many hangs were waited out in full, the next ones are given that many seconds: the defect is known by then."""

SECOND_LOOKS = {"hang": 3, "memory": 3, "crash": 50, "exit": 50}
"""How many incidents of a kind are looked at again, each on a fresh host; those of a run that hangs take long."""


@dataclass(frozen=True)
class Answer:
    """One scenario and what came of it. ``trace`` is spelled as ``disguised`` is; after an incident it is what is known."""

    name: str
    scenario: Scenario
    disguised: Scenario
    trace: Trace
    incident: Incident | None = None


class Driver:
    """Runs scenarios on the implementation behind ``door``; names and payloads are drawn from ``seed``."""

    def __init__(self, door: Door, seed: int, limits: Limits | None = None) -> None:
        self._hosts = Hosts(door, limits)
        self.adapter = door.text
        self.seed = seed
        self._disguise: Disguise | None = None
        self._met: Counter[str] = Counter()
        self._spent = 0.0

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self._hosts.close()

    @property
    def identity(self) -> Welcome:
        """Who is tested. Starts a host; raises ``WrongUse`` or ``HostUnavailable`` if there is none."""
        return self._hosts.welcome

    @property
    def disguise(self) -> Disguise:
        """The random spelling of this run."""
        if self._disguise is None:
            self._disguise = Disguise(self.seed, self.identity.port_element_name)
        return self._disguise

    def run(self, cases: Iterable[tuple[str, Scenario]]) -> Iterator[Answer]:
        """The answers to ``cases`` (name, scenario), in order; many are on their way at a time.

        Once incidents have taken ``SECONDS_FOR_INCIDENTS``, what remains is answered as ``unreachable`` without a try.
        """
        waiting: deque[tuple[str, Scenario, Run]] = deque()
        source = iter(cases)
        numbers = itertools.count()

        def runs() -> Iterator[Run]:
            while self._spent < SECONDS_FOR_INCIDENTS:
                case = next(source, None)
                if case is None:
                    return
                name, scenario = case
                run = Run(next(numbers), self.disguise.scenario(scenario))
                waiting.append((name, scenario, run))
                yield run

        began = time.monotonic()
        for reply in self._hosts.run(runs()):
            name, scenario, run = waiting.popleft()
            trace, incident = self._examine(run, reply)
            if incident is not None:
                self._spent += time.monotonic() - began
            yield Answer(name, scenario, run.scenario, trace, incident)
            began = time.monotonic()
        for name, scenario in source:
            reason = f"not run: incidents before it had taken {SECONDS_FOR_INCIDENTS} s"
            yield Answer(name, scenario, scenario, (), Incident("unreachable", reason))

    def allow_second_looks(self) -> None:
        """Incidents are looked at again from now on, however many there have been."""
        self._met.clear()

    def reveal(self, value: T) -> T:
        """``value`` in the script's own names."""
        return self.disguise.reveal(value)

    def revealed(self, answer: Answer) -> Execution:
        """The answer as an execution that people can read."""
        return Execution(
            answer.name,
            answer.scenario,
            self._reveal_trace(answer.trace),
            answer.incident and self.reveal(answer.incident),
        )

    def _reveal_trace(self, trace: Trace) -> Trace:
        return self.reveal(_Whole(trace)).trace

    def _examine(self, run: Run, answer: HostAnswer) -> tuple[Trace, Incident | None]:
        reply = answer.reply
        if isinstance(reply, Traced):
            problem = contradiction(run.scenario, reply.events, bool(reply.stuck))
            if problem is not None:
                return reply.events, Incident("contradiction", problem)
            if reply.stuck:
                return reply.events, Incident("hang", f"threads that never came back: {', '.join(reply.stuck)}")
            return reply.events, None
        if isinstance(reply, Refused):
            return (), Incident("refused", reply.reason)
        if reply.kind not in FRAMEWORK_INCIDENTS:
            return (), reply
        self._met[reply.kind] += 1
        if reply.kind == "hang" and self._met["hang"] == FULL_WAITS:
            limits = self._hosts.limits
            self._hosts.limits = replace(limits, seconds=min(limits.seconds, SHORT_WAIT))
        if self._met[reply.kind] > SECOND_LOOKS[reply.kind]:
            return (), reply
        return self._second_look(run, reply)

    def _second_look(self, run: Run, first: Incident) -> tuple[Trace, Incident]:
        """The same scenario once more, each event sent as it happens: what led to the incident?"""
        second = self._hosts.look_again(run)
        if isinstance(second.reply, Incident) and second.reply.kind == first.kind:
            return _believable(run.scenario, second.happened), msgspec.structs.replace(
                second.reply, stacks=second.reply.stacks or first.stacks
            )
        return (), msgspec.structs.replace(first, reproduced=False)


class _Whole(msgspec.Struct, frozen=True):
    """A trace as one value, so that it can be revealed at once."""

    trace: tuple[Event, ...]


def _believable(scenario: Scenario, events: tuple[Event, ...]) -> Trace:
    """Streamed events as long as they can be true."""
    for length in range(len(events), 0, -1):
        if contradiction(scenario, events[:length], stuck=True) is None:
            return events[:length]
    return ()
