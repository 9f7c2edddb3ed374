"""Wrong frameworks, clause 10.1.3: self-executing components that are executed wrongly."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from typing import TypeVar

from ucm_cts.adapters.contract.scenario import ACTIVE, PROTECTED_PASSIVE, SELF_EXECUTING, UNPROTECTED_PASSIVE
from ucm_cts.adapters.mutants.python.methods import replaces
from ucm_cts.adapters.mutants.python.registry import POLICIES, Base, breaks
from ucm_cts.adapters.reference.python.execution import Trigger
from ucm_cts.adapters.reference.python.members import Failures, Member

T = TypeVar("T")


@replaces("_begin_execution", "R-10.1.3.2-01", clauses=POLICIES, also=("R-10.1.3.2-03",))
def never_runs(_self: Base, *_: object) -> None:
    """Self-executing components are not executed."""


@replaces("_begin_execution", "R-10.1.3.2-01", clauses=POLICIES, also=("R-10.1.3.2-03",))
def runs_after_the_first_start_only(self: Base, member: Member) -> None:
    """Self-executing components are not executed after a restart."""
    if not member.__dict__.get("has_run"):
        Base._begin_execution(self, member)
    member.__dict__["has_run"] = True


@breaks("R-10.1.3.2-01", "R-10.1.3.2-03", clauses=POLICIES)
class runs_when_called(Base):
    """A self-executing component is executed only after a call of one of its ports."""

    def _keep_running(self, member: Member, trigger: Trigger) -> None:
        pass

    def _execute(self, member: Member, port: str | None, work: Callable[[], T]) -> T:
        result = super()._execute(member, port, work)
        if port is not None and member.execution.trigger:
            self._run(member, member.execution.trigger)
        return result


@replaces("_start_up", "R-10.1.3.2-02", clauses=POLICIES, also=("R-10.1.3.2-01", "R-10.1.3.2-03"))
def runs_before_startup(self: Base, member: Member, failures: Failures) -> bool:
    """run is called before on_startup."""
    if member.execution.definition == SELF_EXECUTING:
        self._begin_execution(member)
        time.sleep(2 * self.period)
    return Base._start_up(self, member, failures)


@breaks("R-10.1.3.2-02", clauses=POLICIES)
class runs_after_stop(Base):
    """run is called after stop, until the component is removed."""

    def _end_execution(self, member: Member) -> None:
        pass

    def get_components(self) -> list[int]:
        time.sleep(2 * self.period)  # so that run is called before the answer
        return super().get_components()

    def _remove(self, member: Member, failures: Failures) -> None:
        super()._end_execution(member)
        super()._remove(member, failures)


@replaces("_end_execution", "R-10.1.3.2-02", clauses=POLICIES, also=("R-10.1.3.2-06",))
def runs_once_more_after_stop(self: Base, member: Member) -> None:
    """run is called once more a little after stop."""
    had_run = member.execution.trigger is not None
    Base._end_execution(self, member)
    if had_run:
        threading.Timer(1.5 * self.period, self._execution_api(member).run).start()


@breaks("R-10.1.3.2-14", clauses=POLICIES)
class executes_passive_components(Base):
    """The container calls protected passive components by itself."""

    definition = PROTECTED_PASSIVE

    def _begin_execution(self, member: Member) -> None:
        super()._begin_execution(member)
        if member.execution.definition == self.definition and member.implementation.provides:
            port = self._reference_to(member, member.implementation.provides[0])
            assert port is not None
            threading.Thread(target=port.exchange, args=(0,), daemon=True).start()
            time.sleep(self.period)


@breaks("R-10.1.3.2-19", clauses=POLICIES)
class executes_unprotected_components(executes_passive_components):
    """The container calls unprotected passive components by itself."""

    definition = UNPROTECTED_PASSIVE


@breaks("R-10.1.3.2-24", clauses=POLICIES, also=("R-10.1.3.2-07",))
class executes_active_components(executes_passive_components):
    """The container calls active components by itself when it has started them."""

    definition = ACTIVE


@breaks("R-10.1.3.2-24", clauses=POLICIES, also=("R-10.1.3.2-07", "R-10.1.3.2-08", "R-11.1.3-01"))
class executes_active_components_once_more(Base):
    """A little after the first call of an active component it is entered again."""

    def _execute(self, member: Member, port: str | None, work: Callable[[], T]) -> T:
        result = super()._execute(member, port, work)
        if member.execution.definition == ACTIVE and not member.__dict__.setdefault("was executed", False):
            member.__dict__["was executed"] = True
            element = member.body.get_portElement(port or "")
            assert element is not None
            again = partial(super()._execute, member, port, lambda: element.exchange(0))
            threading.Timer(0.01, again).start()
        return result


@replaces("_remove", "R-11.2.2.2-07", clauses=POLICIES)
def leaves_threads_of_active_components(self: Base, member: Member, failures: Failures) -> None:
    """The thread of an active component is not ended when its component is removed."""
    member.execution.executor.close = lambda: None  # type: ignore[method-assign]
    Base._remove(self, member, failures)


@breaks("R-10.1.3.2-01", clauses=POLICIES)
class runs_no_successor_of_what_raised(Base):
    """Where a run has raised, components of that implementation that are added later are not executed."""

    def _run(self, member: Member, trigger: Trigger) -> None:
        failed: dict[str, int] = self.manager.__dict__.setdefault("failed runs", {})
        if failed.get(member.implementation.name, member.id) == member.id:
            api = self._execution_api(member)
            with suppress(Exception):
                self._execute(member, None, lambda: trigger.run(partial(self._noting, member, api.run, failed)))

    @staticmethod
    def _noting(member: Member, run: Callable[[], None], failed: dict[str, int]) -> None:
        try:
            run()
        except Exception:
            failed[member.implementation.name] = member.id
            raise
