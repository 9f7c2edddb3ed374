"""Sends scenarios to a host, disguised and pipelined, and runs them again after an incident."""

from __future__ import annotations

import itertools
import time
from collections import deque
from collections.abc import Generator, Iterable, Iterator, Sequence
from concurrent.futures import Future
from contextlib import AbstractContextManager, closing, nullcontext
from dataclasses import dataclass, replace
from typing import Self

import msgspec

from ucm_cts.adapters.contract.messages import Refused, Run, Traced, Welcome
from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.harness.execution.aside import Aside
from ucm_cts.harness.execution.calls_apart import with_calls_apart
from ucm_cts.harness.execution.clock_gaps import ClockGaps
from ucm_cts.harness.execution.driving import (
    Allowance,
    Answer,
    Circumstances,
    Disguising,
    Seconds,
)
from ucm_cts.harness.execution.host_clock import HostClock
from ucm_cts.harness.execution.integrity import believable, contradiction
from ucm_cts.harness.execution.second_looks import SecondLooks
from ucm_cts.harness.hosting.host_watch import Usage
from ucm_cts.harness.hosting.hosts import Answer as HostAnswer
from ucm_cts.harness.hosting.hosts import Hosts, Limits
from ucm_cts.harness.hosting.locate import Endpoint, file_named, namesakes
from ucm_cts.harness.results.incidents import IncidentTime
from ucm_cts.harness.results.tally import Cause
from ucm_cts.harness.results.unanswered_calls import is_left_open
from ucm_cts.harness.results.values import FRAMEWORK_INCIDENTS, Execution, Incident, IncidentKind, Isolation

__all__ = ["Answer", "Circumstances", "Driver", "Limits"]

MOST_UNTRIED = 32
"""How many scenarios in a row are left out before the answers to them, and to those before them, are given."""

_BETWEEN_COUNTS = 0.02
_SHOWN = 5
"""How many kinds of processes a warning names."""

_HOST_IS_GONE: frozenset[IncidentKind] = FRAMEWORK_INCIDENTS | {"flood", "garbage", "protocol"}


class Driver(Disguising):
    """Runs scenarios on the implementation behind ``endpoint``; names and payloads are drawn from ``seed``.

    Use it in a ``with`` statement: from then until its end it has hosts, and ``gaps`` notes when the machine stood still.
    ``jobs``: how many hosts there may be at once; all but one take scenarios that wait, and of a slow product those that do not,
    unless they meet many incidents.
    """

    def __init__(self, endpoint: Endpoint, seed: int, limits: Limits | None = None, jobs: int = 1) -> None:
        super().__init__(seed)
        self._hosts = Hosts(endpoint, limits)
        self._endpoint = endpoint
        self.adapter = endpoint.text
        self.gaps = ClockGaps()
        self._numbers = itertools.count()
        self._second_looks = SecondLooks(self._hosts, self._numbers)
        self._incident_time = IncidentTime(self._hosts.limits.incident_seconds)
        self._is_near = endpoint.kind in ("python", "executable") and not endpoint.virtual_time
        self._clocks: dict[int, HostClock] = {}
        self._aside = Aside(endpoint, self._hosts, jobs - 1)
        self._begun: dict[int, _Case] = {}  # by the identity of the scenario, which names need not have
        self._left_waiting = 0
        self._calls_apart = False

    def __enter__(self) -> Self:
        if not self._endpoint.virtual_time:  # which does not depend on the machine
            self.gaps.start()
        return self

    def __exit__(self, *error: object) -> None:
        self.gaps.close()
        self._end_side_hosts()
        self._hosts.close()

    @property
    def identity(self) -> Welcome:
        """The implementation under test. Starts a host; raises ``WrongUse`` or ``HostUnavailable`` if there is none."""
        return self._hosts.welcome

    @property
    def adapter_file(self) -> str:
        """The file that the adapter is loaded from; empty for one on another machine."""
        return file_named(self._endpoint)

    @property
    def isolation(self) -> Isolation:
        """Where the code behind the endpoint runs."""
        return self._hosts.isolation

    def loaded_files(self) -> frozenset[str]:
        """The files that a host has loaded as code by now: the product's libraries, as far as hosts are on this machine."""
        return self._hosts.loaded_files()

    @property
    def warnings(self) -> tuple[str, ...]:
        """What the vendor should know of the adapter, a sentence each."""
        left = self._hosts.left_behind + self._aside.left_behind
        others = tuple(namesakes(self._endpoint, self.adapter_file))
        shadowed = f"the adapter is {self.adapter_file}; another of its name is {', '.join(others)}"
        behind = f"hosts left {left.total()} processes behind, which were ended: {', '.join(sorted(left)[:_SHOWN])}"
        waiting = (
            f"in {self._left_waiting} scenarios calls of what is removed or not started waited for ever, "
            "which the text leaves open; they fail nothing"
        )
        exposed = f"isolation: process; hosts could reach the harness and its files, because {self._hosts.no_sandbox}"
        unreal = "virtual time: waits took no time, so this run does not show how punctual the product is"
        said = (
            (unreal, self._endpoint.virtual_time),
            (exposed, bool(self._hosts.no_sandbox)),
            (shadowed, bool(others)),
            (behind, bool(left)),
            (waiting, bool(self._left_waiting)),
        )
        return tuple(text for text, is_so in said if is_so)

    def run(self, cases: Iterable[tuple[str, Scenario]], insist: bool = False) -> Iterator[Answer]:
        """The answers to ``cases`` (name, scenario), in order; many are on their way at a time.

        When the time for incidents is used up, some are answered as ``untried``, unless the caller does ``insist``.
        ``cases`` may be endless: few of them are drawn for an answer.
        """
        source = iter(cases)
        returned: deque[_Case] = deque()
        waiting: deque[_Case] = deque()
        more = True
        has_failed = False

        def runs() -> Iterator[Run]:
            nonlocal more
            left_out = 0
            while left_out < MOST_UNTRIED and sum(case.ahead is not None for case in waiting) < self._aside.most_ahead:
                case = returned.popleft() if returned else self._next(source)
                if case is None:
                    more = False
                    return
                begun = case.ahead
                if self._calls_apart and case.plain is None:
                    case = self._apart(case)
                is_tried = insist or (case.ahead is not None and case.ahead.done() and not case.ahead.cancelled())
                untried = None if is_tried else self._incident_time.not_tried(case.scenario)
                if begun is not None and (untried is not None or case.ahead is None):
                    begun.cancel()
                reply = (case.ahead or self._ahead(case)) if untried is None else None
                waiting.append(replace(case, untried=untried, ahead=reply))
                left_out = left_out + 1 if untried is not None else 0
                if untried is None and reply is None:
                    yield case.run

        def elsewhere() -> Iterator[Answer]:
            """The answers to those that the pipeline's own host does not get, until one cannot be had."""
            nonlocal has_failed
            while waiting and (waiting[0].untried is not None or waiting[0].ahead is not None):
                case = waiting.popleft()
                if case.untried is not None:
                    yield Answer(case.name, case.scenario, case.run.scenario, (), case.untried)
                    continue
                answer = self._answered_ahead(case, insist)
                if answer is None:
                    self._fail_aside()
                    has_failed = True
                    waiting.appendleft(case)
                    return
                if answer.incident is not None and self._aside.has_too_many_incidents():
                    self._end_side_hosts()  # from here on there is one host again
                self._note(answer)
                yield answer

        try:
            while more or returned:
                lost = has_failed = False
                with closing(self._hosts.run(runs())) as replies:
                    began = time.monotonic()
                    for reply in replies:
                        took = time.monotonic() - began
                        yield from elsewhere()
                        if has_failed or (waiting and waiting[0].ahead is not None):
                            break
                        case = waiting.popleft()
                        began = time.monotonic()
                        answer = self._examine(case, reply, insist)
                        self._note(answer)
                        lost = isinstance(reply.reply, Incident) and reply.reply.kind in _HOST_IS_GONE
                        if lost or answer.disguised is not case.run.scenario:
                            self._spend(took + time.monotonic() - began, answer)
                        yield answer
                        if lost:
                            break
                        began = time.monotonic()
                if not has_failed:
                    yield from elsewhere()
                is_there = self._aside.is_there and not has_failed
                left = [case if is_there else replace(case, ahead=None) for case in waiting]
                returned.extendleft(reversed(left))  # these were sent to a host that has ended
                waiting.clear()
        finally:
            for case in (*waiting, *returned):
                if case.ahead is not None:
                    case.ahead.cancel()

    def _spend(self, seconds: float, answer: Answer) -> None:
        """So much time has gone by for the incident of ``answer``, if it has one."""
        if answer.incident is not None:
            self._incident_time.spend(seconds, answer.disguised, answer.incident, answer.trace)

    def _note(self, answer: Answer) -> None:
        """What later runs depend on."""
        self._second_looks.note(answer)
        self._incident_time.note_skips(answer.disguised, answer.trace if answer.incident is None else ())

    @property
    def has_side_hosts(self) -> bool:
        """Are there side hosts, or may there be some?"""
        return self._aside.number > 0

    def may_begin(self, scenario: Scenario) -> bool:
        """May side hosts take ``scenario``?"""
        return self._aside.may_take(scenario)

    def begin(self, cases: Sequence[tuple[str, Scenario]]) -> None:
        """Let side hosts begin with ``cases``, each of which they may, before a ``run`` asks for them."""
        self._aside.expect(scenario for _, scenario in cases)
        for name, scenario in cases:
            if id(scenario) not in self._begun:
                new = self._case(name, scenario)
                self._begun[id(scenario)] = replace(new, ahead=self._ahead(new, is_due=False))

    def _ahead(self, case: _Case, is_due: bool = True) -> Future[HostAnswer] | None:
        """The answer of a side host to come; None if the scenario is not for them."""
        side = self._aside.hosts_for(case.run.scenario)
        return side.submit(case.run, is_due) if side is not None else None

    def _answered_ahead(self, case: _Case, insist: bool) -> Answer | None:
        """What a side host has answered; None if something else than the product kept it from answering."""
        assert case.ahead is not None
        try:
            reply = case.ahead.result()
        except Exception:  # noqa: BLE001 - the pipeline's own host is asked
            return None
        if isinstance(reply.reply, Incident) and reply.reply.kind not in _HOST_IS_GONE:
            return None
        began = time.monotonic()
        answer = self._examine(case, reply, insist)
        self._spend((reply.received - reply.sent) / 1e9 + time.monotonic() - began, answer)
        return answer

    def _end_side_hosts(self) -> None:
        self._aside.end()
        self._second_looks.forget()

    def _fail_aside(self) -> None:
        """What side hosts have begun will not be answered; others may follow."""
        self._aside.fail()
        self._second_looks.forget()
        self._begun = {scenario: replace(case, ahead=None) for scenario, case in self._begun.items()}

    def _next(self, source: Iterator[tuple[str, Scenario]]) -> _Case | None:
        case = next(source, None)
        if case is None:
            return None
        if (begun := self._begun.pop(id(case[1]), None)) is None:
            return self._case(*case)
        return replace(begun, name=case[0], ahead=begun.ahead if self._aside.is_there else None)

    def _case(self, name: str, scenario: Scenario) -> _Case:
        return _Case(name, scenario, Run(next(self._numbers), self.disguise.scenario(scenario)))

    def _apart(self, case: _Case) -> _Case:
        """``case`` with its calls on threads of their own."""
        apart = with_calls_apart(case.scenario)
        return replace(case if apart is case.scenario else self._case(case.name, apart), plain=case.scenario)

    def again(self, name: str, scenario: Scenario, circumstances: Circumstances) -> Answer:
        """The same scenario run once more, in other ``circumstances``, as it was run before: on a fresh host that has run some
        ordinary scenarios, and not streamed. So no host can tell that it is a second look.

        The trace is empty if there is none that can be believed. May be called between two answers of a ``run``.
        """
        return self._second_looks.take(name, scenario, circumstances, self.disguise)

    def look_ahead(self, cases: Iterable[tuple[str, Scenario]], circumstances: Circumstances) -> None:
        """Lets side hosts take those of ``cases`` that mostly wait."""
        for name, scenario in cases:
            side = self._aside.hosts_for(scenario)
            if side is not None:
                self._second_looks.begin(name, scenario, circumstances, self.disguise, side)

    def many_times(self, name: str, scenario: Scenario) -> Generator[tuple[Answer, Usage | None], None, None]:
        """``scenario`` again and again on one fresh host, each time with what the host's process holds afterwards.

        Close the iterator between two answers of a ``run``. It ends at the first answer without a trace.
        """
        self._hosts.discard()
        try:
            while True:
                disguised = self.disguise.scenario(scenario)
                (answer,) = self._hosts.run([Run(next(self._numbers), disguised)])
                if not isinstance(answer.reply, Traced) or answer.reply.stuck:
                    return
                yield Answer(name, scenario, disguised, answer.reply.events), self._hosts.usage
        finally:
            self._hosts.discard()

    def usages(self, seconds: float) -> Iterator[Usage]:
        """What the process of the current host holds, again and again within so many ``seconds``."""
        until = time.monotonic() + seconds
        while time.monotonic() < until:
            time.sleep(_BETWEEN_COUNTS)
            usage = self._hosts.usage
            if usage is not None:
                yield usage

    def allow(self, seconds: float) -> Allowance:
        """So many ``seconds`` from now."""
        return Seconds(seconds)

    def tries(self) -> AbstractContextManager[None]:
        """Within it, scenarios are tried whose answers decide nothing, as when a failure is shortened."""
        return nullcontext()

    def keep(self, cause: Cause, answer: Answer) -> None:
        """The ``answer`` of a try with which the report shows the failure ``cause``. A recorder notes it."""

    def _examine(self, case: _Case, reply: HostAnswer, insist: bool) -> Answer:
        """What the host's ``reply`` says of ``case``; perhaps it is run again, as it is or with its calls apart."""
        run, answer = case.run, Answer(case.name, case.scenario, case.run.scenario, (), printed=reply.printed)
        if isinstance(reply.reply, Traced):
            answer = replace(answer, trace=reply.reply.events, stuck=reply.reply.stuck)
            stuck = set(reply.reply.stuck)
            problem = contradiction(run.scenario, answer.trace, stuck) or self._out_of_time(reply)
            if problem is not None:
                return replace(answer, incident=Incident("contradiction", problem))
            if stuck <= set((case.plain or case.scenario).may_stay):
                return answer
            if is_left_open(Execution("", run.scenario, answer.trace)):
                self._left_waiting += 1
                return answer
            if case.plain is not None:  # apart, calls have less patience than they may have
                return self._run_again(self._case(case.name, case.plain), None)
            never = f"threads that never came back: {', '.join(reply.reply.stuck)}"
            return replace(answer, incident=Incident("hang", never), is_whole=True)
        if isinstance(reply.reply, Refused):
            return replace(answer, incident=Incident("refused", reply.reply.reason))
        if reply.reply.kind not in FRAMEWORK_INCIDENTS:
            return replace(answer, incident=reply.reply)
        if not insist and not self._incident_time.is_worth_confirming(run.scenario, reply.reply.kind):
            return replace(answer, incident=reply.reply)
        return self._run_again(case, reply.reply)

    def _out_of_time(self, answer: HostAnswer) -> str | None:
        """Why the times of the trace cannot be true; None if they can."""
        clock = self._clocks.setdefault(answer.host, HostClock(self._is_near, in_order=answer.host >= 0))
        events = answer.reply.events if isinstance(answer.reply, Traced) else ()
        return clock.contradiction(events, answer.sent, answer.received)

    def _run_again(self, case: _Case, first: Incident | None) -> Answer:
        """Run the scenario once more and have each event sent as it happens, to find what led to the ``first`` incident, if any.

        A run that takes longer than it may and ends all the same was no hang: its trace counts. If the scenario hangs in a
        call that the text leaves open it is run with its calls apart, and so are all that follow.
        """
        run, answer = case.run, Answer(case.name, case.scenario, case.run.scenario, ())
        began = time.monotonic()
        second = self._hosts.run_again(run)
        took = time.monotonic() - began
        answer = replace(answer, printed=second.printed)
        self._incident_time.spend_confirming(took)
        is_slow = first is not None and first.kind == "hang" and took > self._hosts.allowed(run.scenario)
        if isinstance(second.reply, Traced) and (first is None or is_slow):
            return self._examine(case, second, insist=False)
        if isinstance(second.reply, Incident) and (first is None or second.reply.kind == first.kind):
            happened = believable(run.scenario, second.happened)
            apart = self._apart(case)
            if (
                first is not None
                and apart.scenario is not case.scenario
                and second.reply.kind == "hang"
                and is_left_open(Execution("", run.scenario, happened))
            ):
                self._calls_apart = True
                return self._examine(apart, self._hosts.run_again(apart.run), insist=False)
            stacks = second.reply.stacks or (first.stacks if first is not None else "")
            return replace(answer, trace=happened, incident=msgspec.structs.replace(second.reply, stacks=stacks))
        if first is None:
            return self._examine(case, second, insist=True)
        return replace(answer, incident=msgspec.structs.replace(first, reproduced=False))


@dataclass(frozen=True)
class _Case:
    """One scenario in the pipeline: the message for the host, or the reason for leaving it out.

    ``plain``: where its calls are apart, the scenario as it is written.
    ``ahead``: the answer of a side host to come.
    """

    name: str
    scenario: Scenario
    run: Run
    untried: Incident | None = None
    plain: Scenario | None = None
    ahead: Future[HostAnswer] | None = None
