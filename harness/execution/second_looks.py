"""Runs scenarios again, as they were run before: a host cannot tell that it is a second look."""

from __future__ import annotations

import itertools
from collections import deque
from collections.abc import Iterator
from concurrent.futures import CancelledError, Future
from contextlib import suppress
from dataclasses import dataclass

from ucm_cts.adapters.contract.messages import Run, Traced
from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.harness.execution.disguise import Disguise
from ucm_cts.harness.execution.driving import LONGEST_HISTORY, Answer, Circumstances, lasting
from ucm_cts.harness.execution.integrity import contradiction
from ucm_cts.harness.hosting.hosts import Answer as HostAnswer
from ucm_cts.harness.hosting.hosts import Hosts
from ucm_cts.harness.hosting.side_hosts import SideHosts

_QUICK = 10_000_000
"""Nanoseconds of an ordinary scenario, which can be run before another one at little cost."""


@dataclass(frozen=True)
class _Look:
    """One second look.

    ``scenario``: what is run again.
    ``lasting``: the same, with the time that it is to last now.
    ``run``: the message for the host.
    ``before``: what the host runs before.
    """

    scenario: Scenario
    lasting: Scenario
    run: Run
    before: tuple[Run, ...]


class SecondLooks:
    """The second looks of one driver: on its ``hosts``, with messages that have ``numbers``."""

    def __init__(self, hosts: Hosts, numbers: Iterator[int]) -> None:
        self._hosts = hosts
        self._numbers = numbers
        self._ordinary: deque[Scenario] = deque(maxlen=LONGEST_HISTORY)
        self._begun: dict[tuple[str, Circumstances], tuple[_Look, Future[HostAnswer]]] = {}

    def note(self, answer: Answer) -> None:
        """A scenario was run that may be run before a second look, if it went quickly and without an incident."""
        trace = answer.trace
        is_quick = len(trace) > 1 and trace[-1].t - trace[0].t < _QUICK
        if is_quick and answer.incident is None and not answer.stuck:
            self._ordinary.append(answer.disguised)

    def begin(
        self, name: str, scenario: Scenario, circumstances: Circumstances, disguise: Disguise, side: SideHosts
    ) -> None:
        """Let one of the hosts at the ``side`` take a look that will be asked for, unless one has begun."""
        known, older = self._begun.get((name, circumstances), (None, None))
        if known is not None and known.scenario is scenario:
            return
        if older is not None:
            older.cancel()
        look = self._new(scenario, circumstances, disguise)
        begun = side.submit_again(look.run, circumstances.one_core, look.before)
        self._begun[name, circumstances] = look, begun

    def forget(self) -> None:
        """The hosts at the side have ended."""
        self._begun.clear()

    def take(self, name: str, scenario: Scenario, circumstances: Circumstances, disguise: Disguise) -> Answer:
        """The answer of a second look; its trace is empty if there is none that can be believed."""
        look, begun = self._begun.pop((name, circumstances), (None, None))
        if look is None or look.scenario is not scenario:
            look, begun = self._new(scenario, circumstances, disguise), None
        reply = self._answer(look, circumstances, begun).reply
        nothing = Answer(name, look.lasting, look.run.scenario, ())
        if not isinstance(reply, Traced) or contradiction(look.run.scenario, reply.events, reply.stuck) is not None:
            return nothing
        return Answer(name, look.lasting, look.run.scenario, reply.events, stuck=reply.stuck)

    def _answer(self, look: _Look, circumstances: Circumstances, begun: Future[HostAnswer] | None) -> HostAnswer:
        """That of the host at the side that has ``begun``; if there is none, or no answer, that of the driver's own host."""
        if begun is not None:
            with suppress(Exception, CancelledError):
                return begun.result()
        return self._hosts.run_again(look.run, circumstances.one_core, stream=False, first=look.before)

    def _new(self, scenario: Scenario, circumstances: Circumstances, disguise: Disguise) -> _Look:
        longer = lasting(scenario, circumstances.patience)
        others = itertools.islice(reversed(self._ordinary), circumstances.after)
        before = tuple(Run(next(self._numbers), one) for one in others)
        return _Look(scenario, longer, Run(next(self._numbers), disguise.scenario(longer)), before)
