"""Wrong frameworks, clause 10.5.2: active components are executed at other times than they are to be, or other times often."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TypeVar

from ucm_cts.adapters.contract import programming_model as pm
from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.mutants.python.registry import PACED, Base, Row, breaks, family
from ucm_cts.adapters.mutants.python.variants.paced import paces_each_port
from ucm_cts.adapters.reference.python.members import Member
from ucm_cts.adapters.reference.python.pacing import Pace

T = TypeVar("T")

_PERIODIC = ("R-10.5.2-10", "R-10.5.2-11", "R-10.5.2-12", "R-10.5.2-21")
_AS_ALL_CALLS = ("R-11.2.1.2-07", "R-11.2.1.1-02")
"""What holds of all calls."""

_SPORADIC = ("R-10.5.2-15", "R-10.5.2-16", "R-10.5.2-17", "R-10.5.2-21")


def _is_sporadic(pace: Pace) -> bool:
    return pace.policy.definition == s.SPORADIC_ACTIVE


class _Invents(Base):
    """Executes components of ``definition`` that nobody calls."""

    definition = s.PERIODIC_ACTIVE

    def _begin_pace(self, member: Member) -> None:
        super()._begin_pace(member)
        policy = member.execution.extended[0]
        if policy.definition == self.definition and policy.port is not None:
            element = member.body.get_portElement(policy.port)
            assert element is not None
            threading.Timer(0.03, self._invent, (member, element)).start()

    def _invent(self, member: Member, element: pm.PortElementObject) -> None:
        if member.execution.paces:
            element.exchange(77)


@breaks("R-10.5.2-08", clauses=PACED, also=("R-10.5.2-09", *_PERIODIC, "R-10.5.1-30", "R-10.5.2-19"))
class executes_periodic_ones_uncalled(_Invents):
    """A periodic active component is executed once without a call."""


@breaks("R-10.5.2-13", clauses=PACED, also=("R-10.5.2-14", *_SPORADIC, "R-10.5.2-19"))
class executes_sporadic_ones_uncalled(_Invents):
    """A sporadic component is executed once without a call."""

    definition = s.SPORADIC_ACTIVE


class _Miscounts(Base):
    """Executes the ``nth`` call of a component of ``definition`` as often as ``times`` says."""

    definition = s.PERIODIC_ACTIVE
    times = 1
    nth = 3

    def _execute_alone(self, member: Member, port: str | None, work: Callable[[], T]) -> T:
        extended = member.execution.extended
        if not extended or extended[0].definition != self.definition or port not in member.execution.managed:
            return super()._execute_alone(member, port, work)
        count = member.__dict__["count"] = member.__dict__.get("count", 0) + 1
        if count == self.nth and not self.times:
            return 0  # type: ignore[return-value]
        if count == self.nth:
            super()._execute_alone(member, port, work)
        return super()._execute_alone(member, port, work)


@breaks("R-10.5.2-09", clauses=PACED, also=_AS_ALL_CALLS)
class loses_the_third_periodic_call(_Miscounts):
    """The third call of a periodic active component returns and is not executed."""

    times = 0


@breaks("R-10.5.2-09", clauses=PACED, also=(*_PERIODIC, *_AS_ALL_CALLS))
class doubles_the_third_periodic_call(_Miscounts):
    """The third call of a periodic active component is executed twice."""

    times = 2


@breaks("R-10.5.2-14", clauses=PACED, also=_AS_ALL_CALLS)
class loses_the_third_sporadic_call(_Miscounts):
    """The third call of a sporadic component returns and is not executed."""

    times = 0
    definition = s.SPORADIC_ACTIVE


@breaks("R-10.5.2-14", clauses=PACED, also=(*_SPORADIC, *_AS_ALL_CALLS))
class doubles_the_third_sporadic_call(_Miscounts):
    """The third call of a sporadic component is executed twice."""

    times = 2
    definition = s.SPORADIC_ACTIVE


@breaks("R-10.5.2-14", clauses=PACED, readings={"early-invocation": "delayed"}, also=_AS_ALL_CALLS)
class refuses_early_calls_undeclared(Base):
    """A sporadic component that is executed refuses calls, and it is declared that they wait."""

    def _execute_paced(self, member: Member, port: str | None, work: Callable[[], T]) -> T:
        pace = member.execution.paces.get(port)
        if pace is not None and _is_sporadic(pace) and time.monotonic() < pace.entered_at + pace.period:
            raise pm.UcmError("the call comes too early")
        return super()._execute_paced(member, port, work)


@breaks("R-10.5.2-09", clauses=PACED, also=_AS_ALL_CALLS)
class refuses_waiting_periodic_calls(Base):
    """A call of a periodic active component that comes while another one waits is refused."""

    def _execute_paced(self, member: Member, port: str | None, work: Callable[[], T]) -> T:
        waiting = member.__dict__.setdefault("waiting", threading.Semaphore(1))
        if member.execution.extended[0].definition != s.PERIODIC_ACTIVE:
            return super()._execute_paced(member, port, work)
        if not waiting.acquire(blocking=False):
            raise pm.UcmError("another call waits")
        try:
            return super()._execute_paced(member, port, work)
        finally:
            waiting.release()


@breaks("R-10.5.2-09", "R-10.5.2-14", clauses=PACED, also=(*_AS_ALL_CALLS, "R-11.1.3-01"))
class answers_with_the_last_result(Base):
    """A paced call brings back the result of the one before."""

    def _execute_paced(self, member: Member, port: str | None, work: Callable[[], T]) -> T:
        result = super()._execute_paced(member, port, work)
        last: T = member.__dict__.get("last", result)
        member.__dict__["last"] = result
        return last


class _Due(Pace):
    """A call is due when ``when`` says so."""

    when: Callable[[Pace, float], float]

    def due(self, asked: float) -> float:
        return self.when(self, asked)


def _usual(pace: Pace, asked: float) -> float:
    return Pace.due(pace, asked)


def _for(is_right: Callable[[Pace], bool], when: Callable[[Pace, float], float]) -> Callable[[Pace, float], float]:
    """``when`` for policies that ``is_right`` is true of, else as usual."""

    def found(pace: Pace, asked: float) -> float:
        return when(pace, asked) if is_right(pace) else _usual(pace, asked)

    return found


def _periodic(when: Callable[[Pace, float], float]) -> Callable[[Pace, float], float]:
    return _for(lambda pace: not _is_sporadic(pace), when)


def _sporadic(when: Callable[[Pace, float], float]) -> Callable[[Pace, float], float]:
    return _for(_is_sporadic, when)


class _Times(_Due):
    """As ``_Due``, with another period."""

    times = 1.0
    of_sporadic = False

    def __init__(self, policy: s.Policy, origin: float) -> None:
        super().__init__(policy, origin)
        if _is_sporadic(self) == self.of_sporadic and policy.definition in (s.SPORADIC_ACTIVE, s.PERIODIC_ACTIVE):
            self.period *= self.times

    def due(self, asked: float) -> float:
        return Pace.due(self, asked)


def _times(factor: float, of_sporadic: bool) -> type[Pace]:
    return type("Times", (_Times,), {"times": factor, "of_sporadic": of_sporadic})


family(
    Base,
    "pace_class",
    {
        "executes_periodic_ones_half_as_often": Row(
            "R-10.5.2-10", "The period of active components is twice as long.", _times(2, False), also=_PERIODIC
        ),
        "executes_periodic_ones_twice_as_often": Row(
            "R-10.5.2-11", "The period of active components is half as long.", _times(0.5, False), also=_PERIODIC
        ),
        "keeps_sporadic_ones_half_as_far_apart": Row(
            "R-10.5.2-15", "The least distance is half as long.", _times(0.5, True), also=_SPORADIC
        ),
        "keeps_sporadic_ones_a_little_closer": Row(
            "R-10.5.2-15", "The least distance is a fifth shorter.", _times(0.8, True), also=_SPORADIC
        ),
        "keeps_sporadic_ones_farther_apart": Row(
            "R-10.5.2-17", "The least distance is twice as long.", _times(2, True), also=_SPORADIC
        ),
    },
    PACED,
)

family(
    _Due,
    "when",
    {
        "executes_periodic_ones_at_once": Row(
            "R-10.5.2-11",
            "A call of a periodic active component is executed at once, if the offset has passed.",
            _periodic(lambda pace, asked: max(asked, pace.first)),
            also=_PERIODIC,
        ),
        "executes_between_two_instants": Row(
            "R-10.5.2-10",
            "A periodic active component is executed a third of a period before each instant.",
            _periodic(lambda pace, asked: max(_usual(pace, asked) - pace.period / 3, pace.first)),
            readings={"periodic-active": "one-a-period"},
            also=_PERIODIC,
        ),
        "executes_periodic_ones_late": Row(
            "R-10.5.2-10",
            "A periodic active component is executed a quarter of a second after each instant.",
            _periodic(lambda pace, asked: _usual(pace, asked) + 0.25),
            also=_PERIODIC,
        ),
        "lets_an_instant_pass": Row(
            "R-10.5.2-10",
            "A call of a periodic active component waits for the instant after the next.",
            _periodic(lambda pace, asked: _usual(pace, asked + pace.period)),
            also=_PERIODIC,
        ),
        "keeps_those_behind_waiting": Row(
            "R-10.5.2-12",
            "A call of a periodic active component that comes before another one was executed waits for 0.2 seconds more.",
            _periodic(lambda pace, asked: _usual(pace, asked) + (0.2 if asked < pace.entered_at else 0)),
            also=_PERIODIC,
        ),
        "keeps_no_distance": Row(
            "R-10.5.2-15",
            "A sporadic component is executed whenever it is called.",
            _sporadic(lambda pace, asked: asked),
            also=_SPORADIC,
        ),
        "keeps_a_first_one_waiting": Row(
            "R-10.5.2-16",
            "Each call of a sporadic component waits for the least distance.",
            _sporadic(lambda pace, asked: max(_usual(pace, asked), asked + pace.period)),
            also=_SPORADIC,
        ),
        "keeps_sporadic_ones_waiting_after_a_while": Row(
            "R-10.5.2-16",
            "After the least distance a call of a sporadic component waits for as long again.",
            _sporadic(lambda pace, asked: asked if pace.entered_at < 0 else max(asked, pace.entered_at + pace.period) + pace.period),
            also=_SPORADIC,
        ),
    },
    PACED,
)  # fmt: skip


@breaks("R-10.5.2-17", clauses=PACED, also=_SPORADIC)
class adds_up_distances(Pace):
    """Each further call of a burst waits for one least distance more than the one before."""

    def due(self, asked: float) -> float:
        if not _is_sporadic(self):
            return super().due(asked)
        number: int = self.__dict__.get("number", 0)
        return max(asked, self.entered_at + max(1, number) * self.period)

    def __setattr__(self, name: str, value: object) -> None:
        if name == "entered_at" and isinstance(value, float) and value > 0:
            self.__dict__["number"] = self.__dict__.get("number", 0) + 1
        super().__setattr__(name, value)


@breaks("R-10.5.2-15", clauses=PACED, also=("R-10.5.2-21",))
class keeps_the_first_distance_only(Pace):
    """Only the second execution of a sporadic component keeps its distance."""

    def due(self, asked: float) -> float:
        if _is_sporadic(self) and self.__dict__.get("count", 0) > 1:
            return asked
        return super().due(asked)

    def __setattr__(self, name: str, value: object) -> None:
        if name == "left_at":
            self.__dict__["count"] = self.__dict__.get("count", -1) + 1
        super().__setattr__(name, value)


@breaks("R-10.5.2-15", clauses=PACED, readings={"sporadic-measure": "end"})
class says_that_it_measures_from_the_end(Base):
    """The least distance counts from the beginning of an execution, and it is declared that it counts from its end."""


@breaks(
    "R-10.5.2-11",
    "R-10.5.2-15",
    clauses=PACED,
    readings={"periodic-active": "one-a-period"},
    also=(*_PERIODIC, *_SPORADIC),
)
class paces_each_port_undeclared(paces_each_port):
    """Each port element has instants of its own, and it is not declared."""


@breaks("R-10.5.2-11", clauses=PACED, readings={"periodic-active": "one-a-period"}, also=_PERIODIC)
class serves_all_undeclared(Pace):
    """All calls that wait are executed at an instant, and it is declared that it is one."""

    def _next_tick(self) -> int:
        return 0


@breaks("R-10.5.2-19", clauses=PACED, also=("R-10.5.2-12", "R-10.5.2-17"))
class lets_paced_calls_meet(Base):
    """Calls of an active component of 10.5 do not keep each other out."""

    def _execute_paced(self, member: Member, port: str | None, work: Callable[[], T]) -> T:
        pace = member.execution.paces.get(port)
        if pace is None:
            return super()._execute_paced(member, port, work)
        with member.__dict__.setdefault("slots", threading.Lock()):
            due = pace.due(time.monotonic())
            time.sleep(max(0, due - time.monotonic()))
            pace.entered_at = time.monotonic()
        return work()

    @contextmanager
    def _exclusion(self, member: Member, port: str | None) -> Iterator[None]:
        if member.execution.extended and port in member.execution.managed:
            yield
            return
        with super()._exclusion(member, port):
            yield


@breaks("R-10.1.3.2-10", clauses=PACED, also=("R-10.1.3.2-06",))
class executes_paced_calls_beside_others(Base):
    """A call of a managed port enters while one of a port that the policy does not manage is executed."""

    @contextmanager
    def _exclusion(self, member: Member, port: str | None) -> Iterator[None]:
        if any(policy.port == port for policy in member.execution.extended if port is not None):
            yield
        else:
            with super()._exclusion(member, port):
                yield


@breaks("R-10.5.2-10", clauses=PACED)
class loses_its_instants(Pace):
    """After its first execution a periodic active component only keeps the distance of a period."""

    def due(self, asked: float) -> float:
        is_begun = self.policy.definition == s.PERIODIC_ACTIVE and self.entered_at >= self.first
        return max(asked, self.entered_at + self.period) if is_begun else super().due(asked)
