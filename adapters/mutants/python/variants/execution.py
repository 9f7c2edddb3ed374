"""Conformant variants that execute protected components in their own way (10.1.3)."""

from __future__ import annotations

import dataclasses
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import TypeVar

from ucm_cts.adapters.contract.programming_model import Implementation, UcmError
from ucm_cts.adapters.contract.scenario import (
    ACTIVE,
    PROTECTED_PASSIVE,
    SELF_EXECUTING,
    UNPROTECTED_PASSIVE,
    Policy,
)
from ucm_cts.adapters.mutants.python.methods import alters, refuses_if, replaces
from ucm_cts.adapters.mutants.python.registry import CONTAINER, CORE, POLICIES, Base, variant_of
from ucm_cts.adapters.reference.python.execution import Executor, Trigger
from ucm_cts.adapters.reference.python.members import Failures, Member
from ucm_cts.adapters.sdk.python.policies import EXECUTION

T = TypeVar("T")

# threads


class _SharedExecutor(Executor):
    """Calls from its own thread enter at once."""

    own_thread: int | None = None

    def execute(self, work: Callable[[], T]) -> T:
        if self.own_thread == threading.get_ident():
            return work()

        def on_own_thread() -> T:
            self.own_thread = threading.get_ident()
            return work()

        return super().execute(on_own_thread)


@variant_of(*POLICIES)
class executes_all_on_one_thread(Base):
    """One thread of the application executes all its protected components."""

    def _execute(self, member: Member, port: str | None, work: Callable[[], T]) -> T:
        executor: _SharedExecutor = self.manager.__dict__.setdefault("executor", _SharedExecutor())
        return executor.execute(work)

    def _remove_members(self, failures: Failures) -> None:
        super()._remove_members(failures)
        self.__dict__.pop("executor", _SharedExecutor()).close()  # the manager has it: the application is destroyed


@replaces("_execute", clauses=POLICIES)
def executes_each_on_its_thread(self: Base, member: Member, port: str | None, work: Callable[[], T]) -> T:
    """Every protected component has a thread for all that enters it."""
    if member.execution.is_inside:
        return work()
    return self._execute_on_own_thread(member, lambda: self._execute_alone(member, port, work))


@replaces("_execute", clauses=POLICIES)
def executes_all_on_the_callers_thread(self: Base, member: Member, port: str | None, work: Callable[[], T]) -> T:
    """Active components have no thread; callers enter one by one."""
    return self._execute_alone(member, port, work)


# callers that wait


@refuses_if("_execute", clauses=POLICIES)
def refuses_recursion(_self: Base, member: Member, *_: object) -> bool:
    """A call that comes back to a protected component is refused."""
    return member.execution.is_inside


@alters("_is_protected", clauses=POLICIES)
def serialises_unprotected_components(_self: Base, given: bool, member: Member) -> bool:
    """Unprotected passive components are entered one at a time, too."""
    return given or member.execution.definition == UNPROTECTED_PASSIVE


class _Turnstile:
    """Callers enter one by one, in the order they came or in reverse."""

    def __init__(self, last_first: bool) -> None:
        self._changed = threading.Condition()
        self._waiting: list[object] = []
        self._is_free = True
        self._next = -1 if last_first else 0

    def enter(self) -> None:
        own = object()
        with self._changed:
            self._waiting.append(own)
            self._changed.wait_for(lambda: self._is_free and self._waiting[self._next] is own)
            self._waiting.remove(own)
            self._is_free = False

    def leave(self) -> None:
        with self._changed:
            self._is_free = True
            self._changed.notify_all()


@variant_of(*POLICIES)
class lets_the_first_in_first(Base):
    """Callers are let in in the order they came."""

    last_first = False

    @contextmanager
    def _exclusion(self, member: Member, port: str | None) -> Iterator[None]:
        if member.execution.is_inside:
            yield
            return
        turnstile: _Turnstile = member.__dict__.setdefault("turnstile", _Turnstile(self.last_first))
        turnstile.enter()
        member.execution.thread_inside = threading.get_ident()
        try:
            yield
        finally:
            member.execution.thread_inside = None
            turnstile.leave()


@variant_of(*POLICIES)
class lets_the_last_in_first(lets_the_first_in_first):
    """The caller that came last is let in first."""

    last_first = True


# calls that come back

_chain: ContextVar[tuple[Member, ...]] = ContextVar("_chain", default=())


class _Chained(Base):
    """Knows which components wait for a call, on whatever thread it is made."""

    def _execute(self, member: Member, port: str | None, work: Callable[[], T]) -> T:
        chain = _chain.get()
        if member in chain and self._is_protected(member):
            return self._come_back(work)

        def within() -> T:
            token = _chain.set((*chain, member))
            try:
                return work()
            finally:
                _chain.reset(token)

        return super()._execute(member, port, within)

    def _come_back(self, work: Callable[[], T]) -> T:
        return work()


@variant_of(*POLICIES, readings={"protected-recursion": "enter"})
class lets_calls_come_back(_Chained):
    """A call that comes back to a component that waits for it is let in."""


@variant_of(*POLICIES, readings={"protected-recursion": "refuse"})
class refuses_calls_that_come_back(_Chained):
    """A call that comes back to a component that waits for it is refused."""

    def _come_back(self, work: Callable[[], T]) -> T:
        raise UcmError("the component waits for this call")


@variant_of(*POLICIES, readings={"protected-recursion": "wait"})
class never_lets_calls_come_back(_Chained):
    """A call that comes back to a component that waits for it waits for ever."""

    def _come_back(self, work: Callable[[], T]) -> T:
        threading.Event().wait()
        return work()


# what is open under a reading that is declared


@replaces("_execute_alone", clauses=POLICIES, readings={"self-exec-mutex": "run-only"})
def keeps_runs_apart_only(self: Base, member: Member, port: str | None, work: Callable[[], T]) -> T:
    """Ports of a self-executing component are always open."""
    if member.execution.definition == SELF_EXECUTING and port is not None:
        return work()
    return Base._execute_alone(self, member, port, work)


@replaces("_execute_alone", clauses=POLICIES, readings={"active-unmanaged": "unprotected"})
def leaves_unmanaged_ports_open(self: Base, member: Member, port: str | None, work: Callable[[], T]) -> T:
    """The ports of an active component that its policy does not manage are open."""
    if member.execution.definition == ACTIVE and port not in member.execution.managed:
        return work()
    return Base._execute_alone(self, member, port, work)


@variant_of(*POLICIES, readings={"unprotected-concurrency": "concurrent"})
class lets_callers_meet(Base):
    """Calls of unprotected passive components overlap, as in the reference framework."""


@refuses_if("_check_policies", clauses=POLICIES, readings={"second-active-policy": "refuse"})
def refuses_two_active_ports(_self: Base, implementation: Implementation) -> bool:
    """Active policies on two ports of a component are refused."""
    return len([policy for policy in implementation.policies if policy.definition == ACTIVE]) > 1


@variant_of(*POLICIES, readings={"second-active-policy": "allow", "run-trigger": "repeated"})
class says_what_it_does(Base):
    """The reference framework, with its execution options declared."""


@variant_of(*POLICIES, *CONTAINER, *CORE, readings={"missing-execution-policy": "refuse"})
class refuses_components_without_policy(Base):
    """A component without execution policy is refused when it is added."""

    def _check_policies(self, implementation: Implementation) -> None:
        if not any(policy.definition in EXECUTION for policy in implementation.policies):
            raise UcmError(f"{implementation.name!r} has no execution policy")
        super()._check_policies(implementation)


@variant_of(*POLICIES, readings={"missing-execution-policy": "refuse"})
class refuses_to_start_components_without_policy(Base):
    """A component without execution policy is added; its container does not start."""

    def _check_startable(self) -> None:
        for member in self.members.values():
            if not member.execution.definition:
                raise UcmError(f"{member.implementation.name!r} has no execution policy")
        super()._check_startable()


@variant_of(*POLICIES, readings={"missing-execution-policy": "default"})
class gives_a_policy_to_those_without(Base):
    """A component without execution policy is executed as a protected passive component."""

    def _initialise(self, member: Member) -> None:
        member.execution.definition = member.execution.definition or PROTECTED_PASSIVE
        super()._initialise(member)


@variant_of(*POLICIES, readings={"protected-active-applicability": "onComponent"})
class manages_whole_components(Base):
    """The active policy cannot be applied to ports; all ports of a component that has it are managed."""

    def _check_policies(self, implementation: Implementation) -> None:
        if any(policy.definition == ACTIVE and policy.port is not None for policy in implementation.policies):
            raise UcmError(f"{ACTIVE!r} applies to components")
        others = tuple(policy for policy in implementation.policies if policy.definition != ACTIVE)
        if len([policy for policy in implementation.policies if policy.definition in EXECUTION]) > 1:
            raise UcmError(f"{implementation.name!r} has more than one execution policy")
        super()._check_policies(dataclasses.replace(implementation, policies=others))

    def _initialise(self, member: Member) -> None:
        if member.execution.definition == ACTIVE:
            member.execution.managed = set(member.implementation.provides)
        super()._initialise(member)


@variant_of(*POLICIES, readings={"protected-active-applicability": "onBoth"})
class manages_ports_or_whole_components(Base):
    """The active policy can be applied to ports, or to a component, all ports of which are managed then."""

    def _check_policies(self, implementation: Implementation) -> None:
        if implementation.policies != (Policy(ACTIVE),):
            super()._check_policies(implementation)

    def _initialise(self, member: Member) -> None:
        if None in member.execution.managed:
            member.execution.managed = set(member.implementation.provides)
        super()._initialise(member)


# run


@replaces("_keep_running", clauses=POLICIES, readings={"run-trigger": "once"})
def runs_once_a_start(self: Base, member: Member, trigger: Trigger) -> None:
    """run is called once after each start."""
    if not trigger.ended.wait(self.period):
        self._run(member, trigger)


@variant_of(*POLICIES)
class runs_seldom(Base):
    """run is called every 50 ms."""

    period = 0.05


@replaces("_keep_running", clauses=POLICIES)
def runs_no_more_after_a_failure(self: Base, member: Member, trigger: Trigger) -> None:
    """An exception out of run ends the runs until the next start."""
    run = self._execution_api(member).run
    try:
        while not trigger.ended.wait(self.period):
            self._execute(member, None, lambda: trigger.run(run))
    except Exception:  # noqa: BLE001 - a body may raise anything
        return


@replaces("_run", clauses=POLICIES)
def runs_one_component_at_a_time(self: Base, member: Member, trigger: Trigger) -> None:
    """Of all self-executing components of the runtime one runs at a time."""
    with self.manager.__dict__.setdefault("one_run", threading.Lock()):
        Base._run(self, member, trigger)


@replaces("_execute_on_own_thread", clauses=POLICIES)
def executes_active_components_by_period(self: Base, member: Member, work: Callable[[], T]) -> T:
    """A call of an active component is executed when the component's next period begins."""
    time.sleep(0.002)
    return Base._execute_on_own_thread(self, member, work)


@variant_of(*POLICIES)
class runs_five_times_a_second(Base):
    """So often is run of a self-executing component called."""

    period = 0.19
