"""Wrong frameworks, clause 10.1.3: execution policies that protect too little, too long or the wrong thing."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from typing import TypeVar

from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.programming_model import Implementation, PortConnection, PortElementObject, UcmError
from ucm_cts.adapters.contract.scenario import (
    ACTIVE,
    PROTECTED_PASSIVE,
    SELF_EXECUTING,
    UNPROTECTED_PASSIVE,
)
from ucm_cts.adapters.mutants.python.methods import alters, does_only_if, refuses_if, replaces
from ucm_cts.adapters.mutants.python.registry import (
    POLICIES,
    Base,
    PeerProxy,
    breaks,
    container_of,
)
from ucm_cts.adapters.mutants.python.variants.direct_calls import protects_what_components_call
from ucm_cts.adapters.reference.python.connectors import Link, Taker
from ucm_cts.adapters.reference.python.execution import POLICIES as EXECUTION_POLICIES
from ucm_cts.adapters.reference.python.execution import Trigger
from ucm_cts.adapters.reference.python.members import Member
from ucm_cts.adapters.reference.python.policies import ProtectedElement

T = TypeVar("T")

# too little protection


class _Unprotects(Base):
    definition: str

    def _is_protected(self, member: Member) -> bool:
        return member.execution.definition != self.definition and super()._is_protected(member)

    def _execute(self, member: Member, port: str | None, work: Callable[[], T]) -> T:
        return super()._execute(member, port, work) if self._is_protected(member) else work()


@breaks("R-10.1.3.2-13", "R-10.1.3.2-16", clauses=POLICIES)
class leaves_passive_components_open(_Unprotects):
    """Protected passive components are not protected."""

    definition = PROTECTED_PASSIVE


@breaks("R-10.1.3.2-09", "R-10.1.3.2-10", clauses=POLICIES)
class leaves_active_components_open(_Unprotects):
    """Active components are executed by their callers, all at a time."""

    definition = ACTIVE


@breaks("R-10.1.3.2-06", clauses=POLICIES)
class leaves_self_executing_components_open(_Unprotects):
    """Self-executing components are not protected."""

    definition = SELF_EXECUTING


@replaces("_exclusion", "R-10.1.3.2-06", "R-10.1.3.2-10", "R-10.1.3.2-16", clauses=POLICIES)
@contextmanager
def locks_ports(_self: Base, member: Member, port: str | None) -> Iterator[None]:
    """A component has one lock for each port element and one for run."""
    with member.__dict__.setdefault(f"lock of {port}", threading.RLock()):
        yield


@alters(
    "_dependencies_of",
    "R-10.1.3.2-06",
    "R-10.1.3.2-09",
    "R-10.1.3.2-10",
    "R-10.1.3.2-13",
    "R-10.1.3.2-16",
    clauses=POLICIES,
)
def protects_from_the_outside_only(_self: Base, given: list[PortConnection], _member: Member) -> list[PortConnection]:
    """Components are given unprotected references at start."""
    return [PortConnection(d.from_port, tuple(map(_without_protection, d.to_port))) for d in given]


def _without_protection(target: PortElementObject | None) -> PortElementObject | None:
    return target.element if isinstance(target, ProtectedElement) else target


@breaks("R-10.1.3.2-06", "R-10.1.3.2-09", "R-10.1.3.2-10", "R-10.1.3.2-13", "R-10.1.3.2-16", clauses=POLICIES)
class protects_from_connections_only(Link):
    """Service connectors enter components without protection."""

    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        taker = self.takers[0]
        element = taker.member.body.get_portElement(taker.port)
        assert element is not None
        return element.call(method, arguments)


@replaces("_deliver", "R-10.1.3.2-06", "R-10.1.3.2-09", "R-10.1.3.2-10", "R-10.1.3.2-16", clauses=POLICIES)
def protects_from_calls_only(_self: Link, taker: Taker, method: str) -> None:
    """Messages enter protected components while other executions are inside."""
    while (message := taker.messages.get()) is not None:
        element = taker.member.body.get_portElement(taker.port)
        assert element is not None
        with suppress(Exception):
            element.call(method, [message])


@does_only_if("_post", "R-10.1.2-10", clauses=POLICIES)
def loses_messages_to_protected_components(_self: Link, taker: Taker, *_: object) -> bool:
    """Messages to protected components are lost, and push returns ok."""
    return not container_of(taker.member)._is_protected(taker.member)


@replaces("_execute", "R-10.1.3.2-06", "R-10.1.3.2-09", "R-10.1.3.2-16", clauses=POLICIES)
def protects_until_exceptions(self: Base, member: Member, port: str | None, work: Callable[[], T]) -> T:
    """A component is no longer protected after an execution of it has raised an exception."""
    if member.__dict__.get("was left with an exception"):
        return work()
    try:
        return Base._execute(self, member, port, work)
    except Exception:
        member.__dict__["was left with an exception"] = True
        raise


@breaks("R-10.1.3.2-06", "R-10.1.3.2-09", "R-10.1.3.2-16", clauses=POLICIES, also=("R-10.1.3.2-05",))
class protects_until_the_first_stop(Base):
    """Components are no longer protected after they have been stopped."""

    def _execute(self, member: Member, port: str | None, work: Callable[[], T]) -> T:
        return work() if member.__dict__.get("was stopped") else super()._execute(member, port, work)

    def _end_execution(self, member: Member) -> None:
        if member in self.started:
            member.__dict__["was stopped"] = True
        super()._end_execution(member)


@alters("_is_protected", "R-10.1.3.2-20", readings={"unprotected-concurrency": "concurrent"}, clauses=POLICIES)
def serialises_what_it_says_it_does_not(_self: Base, given: bool, member: Member) -> bool:
    """The vendor declares concurrent calls of unprotected components; calls enter one at a time."""
    return given or member.execution.definition == UNPROTECTED_PASSIVE


@breaks("R-10.1.3-03", clauses=POLICIES, readings={"second-active-policy": "refuse"})
class allows_what_it_says_it_refuses(Base):
    """The vendor declares that two active ports of a component are refused; they are accepted."""


@refuses_if("_check_policies", "R-10.1.3-03", readings={"second-active-policy": "allow"}, clauses=POLICIES)
def refuses_what_it_says_it_allows(_self: Base, implementation: Implementation) -> bool:
    """The vendor declares that two active ports of a component are accepted; they are refused."""
    return len([policy for policy in implementation.policies if policy.definition == ACTIVE]) > 1


@refuses_if(
    "_check_startable",
    "R-10.1.3-03",
    readings={"second-active-policy": "allow"},
    clauses=POLICIES,
    also=("R-11.2.3-06",),
)
def refuses_to_start_what_it_says_it_allows(self: Base) -> bool:
    """The vendor declares that two active ports of a component are accepted; the container of such a component does not start."""
    policies = [
        [p for p in member.implementation.policies if p.definition == ACTIVE] for member in self.members.values()
    ]
    return any(len(active) > 1 for active in policies)


@breaks("R-10.1.3.2-01", clauses=POLICIES, readings={"run-trigger": "once"})
class runs_more_often_than_it_says(Base):
    """The vendor declares that run is called once a start; it is called repeatedly."""


@replaces("_keep_running", "R-10.1.3.2-01", clauses=POLICIES, readings={"run-trigger": "repeated"})
def runs_less_often_than_it_says(self: Base, member: Member, trigger: Trigger) -> None:
    """The vendor declares that run is called repeatedly; it is called once a start."""
    if not trigger.ended.wait(self.period):
        self._run(member, trigger)


@breaks("R-10.1.3.2-09", clauses=POLICIES, readings={"active-unmanaged": "unprotected"})
class leaves_active_components_open_as_if_declared(leaves_active_components_open):
    """Active components are not protected; the vendor declares this for unmanaged ports only."""


@replaces("_execute", "R-10.1.3.2-10", clauses=POLICIES)
def protects_managed_ports_only(self: Base, member: Member, port: str | None, work: Callable[[], T]) -> T:
    """The ports of an active component that its policy does not manage are open."""
    is_open = member.execution.managed and port not in member.execution.managed
    return work() if is_open else Base._execute(self, member, port, work)


@replaces("exchange", "R-10.1.3.2-13", also=("R-10.1.3.2-16",), clauses=POLICIES)
def unlocks_for_nested_calls(self: PeerProxy, value: int) -> int:
    """While a component waits for another one, other callers may enter it."""
    execution = self.member.execution
    if not execution.is_inside:
        return self.target.exchange(value)
    inside, execution.thread_inside = execution.thread_inside, None
    execution.lock.release()
    try:
        return self.target.exchange(value)
    finally:
        execution.lock.acquire()
        execution.thread_inside = inside


@breaks("R-10.1.3.2-05", clauses=POLICIES, also=("R-10.1.3.2-06",))
class runs_before_run_has_ended(Base):
    """run is called again on another thread before the last call has ended."""

    def _run(self, member: Member, trigger: Trigger) -> None:
        threading.Thread(target=super()._run, args=(member, trigger), daemon=True).start()

    def _begin_execution(self, member: Member) -> None:
        super()._begin_execution(member)
        if member.execution.trigger:
            member.execution.trigger.run = lambda run: run()  # type: ignore[method-assign]

    @contextmanager
    def _exclusion(self, member: Member, port: str | None) -> Iterator[None]:
        if port is not None:
            with super()._exclusion(member, port):
                yield
            return
        if not member.__dict__.setdefault("running", 0):
            with super()._exclusion(member, port):
                member.__dict__["running"] += 1
                try:
                    yield
                finally:
                    member.__dict__["running"] -= 1
        else:
            yield


# callers that wait get no result, or a wrong one


class _Meets(Base):
    """A call that meets an execution is passed to ``_meet``."""

    def _execute_alone(self, member: Member, port: str | None, work: Callable[[], T]) -> T:
        if port is None or member.execution.lock.acquire(blocking=False):
            try:
                result = super()._execute_alone(member, port, work)
            finally:
                if port is not None:
                    member.execution.lock.release()
            if port is not None:
                member.__dict__["last"] = result
            return result
        return self._meet(member, port, work)

    def _meet(self, member: Member, port: str | None, work: Callable[[], T]) -> T:
        raise NotImplementedError


_THROUGH_CONNECTORS = ("R-10.1.2-10", "R-10.1.5.1-01", "R-10.1.5.1-03")
_CALLS = ("R-10.1.3.2-08", "R-10.1.3.2-15", "R-11.1.2-02", "R-11.1.3-01", "R-11.2.1.2-07", "R-11.2.3-03")
"""Broken by every defect of business calls."""


@replaces("_meet", "R-10.1.3.2-17", clauses=POLICIES, also=(*_CALLS, *_THROUGH_CONNECTORS))
def refuses_who_waited(self: _Meets, member: Member, port: str | None, *_: object) -> None:
    """A caller that meets an execution waits for its end and is refused."""
    with self._exclusion(member, port):
        pass
    raise UcmError("busy")


@replaces("_meet", "R-10.1.3.2-17", clauses=POLICIES, also=_CALLS)
def forgets_who_waits(_self: _Meets, *_: object) -> None:
    """A caller that meets an execution waits for ever."""
    threading.Event().wait()


@replaces("_meet", "R-10.1.3.2-17", clauses=POLICIES, also=(*_CALLS, *_THROUGH_CONNECTORS))
def answers_all_who_wait_alike(self: _Meets, member: Member, port: str | None, *_: object) -> object:
    """A caller that meets an execution waits, and gets the result of that execution."""
    with self._exclusion(member, port):
        return member.__dict__.get("last", 0)


@replaces("_exclusion", "R-10.1.3.2-17", clauses=POLICIES, also=_CALLS)
@contextmanager
def stays_locked_after_exceptions(_self: Base, member: Member, *_: object) -> Iterator[None]:
    """After an execution has raised an exception no call enters the component."""
    lock = member.__dict__.setdefault("semaphore", threading.Semaphore())
    if member.execution.is_inside:
        yield
        return
    lock.acquire()
    member.execution.thread_inside = threading.get_ident()
    try:
        yield
    except Exception:
        member.execution.thread_inside = None
        raise
    member.execution.thread_inside = None
    lock.release()


@breaks("R-10.1.3.2-06", "R-10.1.3.2-09", "R-10.1.3.2-10", "R-10.1.3.2-13", "R-10.1.3.2-16", clauses=POLICIES)
class leaves_references_unprotected(protects_what_components_call):
    """References of get_port_element are not protected, which the vendor does not declare."""


@breaks("R-10.1.3.2-13", "R-10.1.3.2-01", clauses=POLICIES, also=("R-10.1.3.2-16", "R-10.1.3.2-17", "R-10.1.3.2-03"))
class asks_the_first_policy_alone(Base):
    """Only the first technical policy of a component is asked how it is executed."""

    def _configure(self, member: Member, attributes: Mapping[str, str]) -> None:
        policies = member.implementation.policies
        if policies and policies[0].definition not in EXECUTION_POLICIES:
            member.execution.definition = ""
        super()._configure(member, attributes)


@replaces("_exclusion", "R-10.1.3.2-13", clauses=POLICIES, also=("R-10.1.3.2-06", "R-10.1.3.2-16", "R-10.1.3.2-17"))
@contextmanager
def lets_in_who_has_waited_long(_self: Base, member: Member, *_: object) -> Iterator[None]:
    """A caller that has waited for nearly a second for a protected component enters it, although another one is inside."""
    execution = member.execution
    is_held = execution.lock.acquire(timeout=0.9)
    outer, execution.thread_inside = execution.thread_inside, threading.get_ident()
    try:
        yield
    finally:
        execution.thread_inside = outer
        if is_held:
            execution.lock.release()


@breaks("R-10.1.3.2-13", clauses=POLICIES, also=("R-10.1.3.2-16", "R-10.1.3.2-17"))
class protects_no_traced_ports(Base):
    """A port element that is traced is not protected."""

    def _execute(self, member: Member, port: str | None, work: Callable[[], T]) -> T:
        if port is not None and self._port_traces(member, port):
            return work()
        return super()._execute(member, port, work)
