"""Wrong frameworks, clause 10.5.2: components that execute themselves run at other times, or other times often."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import TypeVar

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.mutants.python.registry import PACED, Base, Row, breaks, family
from ucm_cts.adapters.reference.python.execution import Trigger
from ucm_cts.adapters.reference.python.members import Member
from ucm_cts.adapters.reference.python.pacing import Pace

T = TypeVar("T")

_RATE = ("R-10.5.2-01", "R-10.5.2-02", "R-10.5.2-03", "R-10.5.2-04", "R-10.5.2-21", "R-10.5.1-31")


def _is_periodic(pace: Pace) -> bool:
    return pace.policy.definition == s.PERIODIC_SELF_EXECUTING


class _OtherPeriod(Pace):
    """Runs are ``times`` as far apart as they should be."""

    times = 1.0

    def __init__(self, policy: s.Policy, origin: float) -> None:
        super().__init__(policy, origin)
        if _is_periodic(self):
            self.period *= self.times


family(
    _OtherPeriod,
    "times",
    {
        "runs_every_second_period": Row("R-10.5.2-01", "The period is twice as long.", 2.0, also=_RATE),
        "runs_a_little_seldom": Row("R-10.5.2-01", "The period is a quarter longer.", 1.25, also=_RATE),
        "runs_twice_a_period": Row("R-10.5.2-03", "The period is half as long.", 0.5, also=_RATE),
        "runs_a_little_often": Row("R-10.5.2-03", "The period is a tenth shorter.", 0.9, also=_RATE),
    },
    PACED,
)


@breaks("R-10.5.2-01", clauses=PACED, also=_RATE)
class drifts(Pace):
    """Each run is ten milliseconds later than the one before and a period."""

    def tick(self, number: int) -> float:
        return super().tick(number) + (0.01 * number if _is_periodic(self) else 0)


@breaks("R-10.5.2-01", clauses=PACED, also=_RATE)
class leaves_out_every_third(Pace):
    """Each third instant has no run."""

    def after_run(self, number: int) -> int:
        return number + (2 if number % 3 == 1 else 1)


@breaks("R-10.5.2-02", clauses=PACED, also=(*_RATE, "R-10.5.2-06"))
class waits_for_two_offsets(Pace):
    """Two offsets pass before the first run."""

    def __init__(self, policy: s.Policy, origin: float) -> None:
        super().__init__(policy, origin + policy.settings.get("psec_offset", 0) / 1_000_000)


@breaks("R-10.5.2-02", clauses=PACED, also=_RATE)
class never_runs_periodically(Base):
    """A periodic component does not run."""

    def _run_paced(self, member: Member, trigger: Trigger) -> None:
        if member.execution.extended[0].definition != s.PERIODIC_SELF_EXECUTING:
            super()._run_paced(member, trigger)


class _Begins(Base):
    """``before`` is the time that passes before a component runs at all."""

    before = 0.0
    definition = s.PERIODIC_SELF_EXECUTING

    def _run_paced(self, member: Member, trigger: Trigger) -> None:
        if member.execution.extended[0].definition == self.definition and trigger.ended.wait(self.before):
            return
        super()._run_paced(member, trigger)


@breaks("R-10.5.2-02", clauses=PACED, also=(*_RATE, "R-10.5.1-27"))
class begins_late(_Begins):
    """The first run comes a quarter of a second late, and those that were missed follow."""

    before = 0.25


@breaks("R-10.5.2-06", clauses=PACED, also=("R-10.5.2-05", "R-10.5.2-21"))
class begins_the_background_late(_Begins):
    """The background run comes a quarter of a second late."""

    before = 0.25
    definition = s.BACKGROUND


@breaks("R-10.5.2-06", clauses=PACED, also=("R-10.5.2-05", "R-10.5.2-21", "R-10.5.2-20"))
class never_runs_in_the_background(_Begins):
    """A background component does not run."""

    before = 3600.0
    definition = s.BACKGROUND


@breaks("R-10.5.2-03", clauses=PACED)
class makes_up_for_long_runs(Pace):
    """After a long run two runs are made for each instant that was missed."""

    def after_run(self, number: int) -> int:
        missed = self.tick_from(time.monotonic()) - number - 1
        if missed > 1 and _is_periodic(self):
            self.first -= missed * self.period
        return number + 1


class _StopsRunning(Base):
    """No run follows one after which ``ends`` is true."""

    ends: Callable[[int, float, bool], bool]

    def _run_paced(self, member: Member, trigger: Trigger) -> None:
        if member.execution.extended[0].definition == s.BACKGROUND:
            super()._run_paced(member, trigger)
            return
        pace, number = member.execution.paces[None], 0
        while self._await(trigger, pace.tick(number)):
            began, raised = time.monotonic(), False
            try:
                self._execute(member, None, lambda: trigger.run(self._execution_api(member).run))
            except Exception:  # noqa: BLE001 - a body may raise anything
                raised = True
            number += 1
            if self.ends(number, time.monotonic() - began, raised):
                return


family(
    _StopsRunning,
    "ends",
    {
        "stops_after_ten_runs": Row(
            "R-10.5.2-04", "The tenth run is the last one.", lambda number, took, raised: number == 10, also=_RATE
        ),
        "stops_after_a_long_run": Row(
            "R-10.5.2-04",
            "A run of more than 100 milliseconds is the last one.",
            lambda number, took, raised: took > 0.1,
        ),
    },
    PACED,
)


@breaks("R-10.5.2-04", clauses=PACED, readings={"period-overrun": "queued"}, also=("R-10.5.2-21",))
class says_that_it_catches_up(Pace):
    """Instants that pass during a run are left out, and it is declared that they are caught up."""

    def after_run(self, number: int) -> int:
        return max(number + 1, self.tick_from(time.monotonic()))


@breaks("R-10.5.2-04", clauses=PACED, readings={"period-overrun": "skipped"})
class says_that_it_leaves_out(Base):
    """Missed runs are caught up, and it is declared that they are left out."""


class _RunsAgain(Base):
    """A background component runs again when ``again`` says so."""

    again: Callable[[float, bool], float | None]

    def _run_paced(self, member: Member, trigger: Trigger) -> None:
        super()._run_paced(member, trigger)
        if member.execution.extended[0].definition == s.BACKGROUND:
            wait = self.again(0.0, False)
            if wait is not None and not trigger.ended.wait(wait):
                self._run(member, trigger)


@breaks("R-10.5.2-05", clauses=PACED, also=("R-10.5.2-21",))
class runs_twice_in_the_background(_RunsAgain):
    """The background run is made twice."""

    again = staticmethod(lambda took, raised: 0.0)


@breaks("R-10.5.2-05", clauses=PACED, also=("R-10.5.2-21",))
class runs_again_after_a_while(_RunsAgain):
    """A background component runs again after 80 milliseconds."""

    again = staticmethod(lambda took, raised: 0.08)


@breaks("R-10.5.2-05", clauses=PACED)
class repeats_a_run_that_raised(Base):
    """A background run that raises is made again."""

    def _run(self, member: Member, trigger: Trigger) -> None:
        if member.execution.extended and member.execution.extended[0].definition == s.BACKGROUND:
            try:
                self._execute(member, None, lambda: trigger.run(self._execution_api(member).run))
            except Exception:  # noqa: BLE001 - a body may raise anything
                super()._run(member, trigger)
            return
        super()._run(member, trigger)


@breaks("R-10.5.2-05", clauses=PACED, also=("R-10.5.2-06", "R-10.5.2-21"))
class runs_once_more_at_each_stop(Base):
    """A background component runs once more when it is stopped."""

    def _end_execution(self, member: Member) -> None:
        trigger = member.execution.trigger
        is_background = any(policy.definition == s.BACKGROUND for policy in member.execution.extended)
        if trigger is not None and is_background and member.execution.paces:
            self._run(member, trigger)
        super()._end_execution(member)


@breaks("R-10.5.2-07", clauses=PACED, also=("R-10.5.2-06", "R-10.5.1-29"))
class runs_in_start(Base):
    """A background component runs inside start."""

    def _begin_execution(self, member: Member) -> None:
        if member.execution.extended and member.execution.extended[0].definition == s.BACKGROUND:
            self._begin_pace(member)
            trigger = member.execution.trigger = Trigger()
            self._run_paced(member, trigger)
            return
        super()._begin_execution(member)


@breaks("R-10.5.2-07", clauses=PACED)
class holds_up_everything(Base):
    """While a component runs in the background no other component is executed."""

    @property
    def everything(self) -> threading.RLock:
        lock: threading.RLock = self.manager.__dict__.setdefault("everything", threading.RLock())
        return lock

    def _run(self, member: Member, trigger: Trigger) -> None:
        with self.everything:
            super()._run(member, trigger)

    def _is_protected(self, member: Member) -> bool:
        return True

    def _execute(self, member: Member, port: str | None, work: Callable[[], T]) -> T:
        with self.everything:
            return super()._execute(member, port, work)


class _Overlaps(Base):
    """Executions of a component of 10.5 do not exclude those that come in by ``ways``."""

    is_free: Callable[[str | None], bool]

    @contextmanager
    def _exclusion(self, member: Member, port: str | None) -> Iterator[None]:
        if member.execution.extended and member.execution.definition == s.SELF_EXECUTING and self.is_free(port):
            yield
            return
        with super()._exclusion(member, port):
            yield


family(
    _Overlaps,
    "is_free",
    {
        "lets_runs_meet_calls": Row("R-10.5.2-18", "A run does not keep calls out.", lambda port: port is None),
        "lets_calls_meet_runs": Row("R-10.5.2-18", "A call does not keep runs out.", lambda port: port is not None),
    },
    PACED,
)


@breaks("R-10.5.2-18", clauses=PACED, also=_RATE)
class lets_runs_meet(Base):
    """A run begins at each instant, whether the one before has ended or not."""

    def _run(self, member: Member, trigger: Trigger) -> None:
        if not member.execution.extended or member.execution.extended[0].definition == s.BACKGROUND:
            super()._run(member, trigger)
            return

        def run() -> None:
            with suppress(Exception):
                self._execution_api(member).run()

        threading.Thread(target=run, daemon=True).start()


@breaks("R-10.5.2-21", clauses=PACED, also=("R-10.5.2-02", "R-10.5.2-04"))
class runs_twice_after_a_stop_during_a_run(Base):
    """A component that is stopped while its run is inside is executed twice a period from the next start on."""

    def _run(self, member: Member, trigger: Trigger) -> None:
        super()._run(member, trigger)
        if trigger.ended.is_set():
            self.__dict__.setdefault("twice", set()).add(member.id)

    def _run_paced(self, member: Member, trigger: Trigger) -> None:
        if member.id in self.__dict__.get("twice", ()):
            threading.Thread(target=super()._run_paced, args=(member, trigger), daemon=True).start()
        super()._run_paced(member, trigger)
