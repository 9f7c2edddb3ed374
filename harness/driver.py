"""Drives scenarios through a host: disguised, pipelined, with a second look at whatever went wrong."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
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
        """The answers to ``cases`` (name, scenario), in order; many are on their way at a time."""
        waiting: deque[tuple[str, Scenario, Run]] = deque()

        def runs() -> Iterator[Run]:
            for number, (name, scenario) in enumerate(cases):
                run = Run(number, self.disguise.scenario(scenario))
                waiting.append((name, scenario, run))
                yield run

        for reply in self._hosts.run(runs()):
            name, scenario, run = waiting.popleft()
            trace, incident = self._examine(run, reply)
            yield Answer(name, scenario, run.scenario, trace, incident)

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
