"""Frameworks in which something does not outlast an exception, a phase, a while, another's removal, or a name that is alike."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from typing import Any, TypeVar

from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.programming_model import DeclaredException, FragmentObject, PortElementObject, UcmError
from ucm_cts.adapters.contract.scenario import MESSAGE_CONNECTOR, Policy
from ucm_cts.adapters.mutants.python.methods import elsewhere, replaces
from ucm_cts.adapters.mutants.python.registry import POLICIES, Base, breaks
from ucm_cts.adapters.reference.python.connectors import OK, Link
from ucm_cts.adapters.reference.python.members import Failures, Member

T = TypeVar("T")


# executions


@replaces("_execute_on_own_thread", "R-10.1.3.2-08", clauses=POLICIES, also=("R-10.1.3.2-17",))
def thread_dies_with_an_exception(self: Base, member: Member, work: Callable[[], T]) -> T:
    """The thread of an active component dies with an exception that is not declared; calls that follow wait for ever."""
    if member.__dict__.get("dead"):
        threading.Event().wait()
    try:
        return Base._execute_on_own_thread(self, member, work)
    except DeclaredException:
        raise
    except Exception:
        member.__dict__["dead"] = True
        raise


@replaces("_shut_down", "R-10.1.3.2-08", clauses=POLICIES)
def thread_ends_with_the_phase(self: Base, member: Member, failures: Failures) -> None:
    """The thread of an active component that was called ends at stop, and is not begun again."""
    Base._shut_down(self, member, failures)
    if member.execution.managed and member.execution.executor._is_running:
        member.execution.executor.close()


@breaks("R-10.1.3.2-13", clauses=POLICIES, also=("R-10.1.3.2-15", "R-10.1.3.2-16", "R-10.1.3.2-17"))
class leaves_with_the_inner_call(Base):
    """A call that comes back to a protected component lets others in when it ends, although the outer one goes on."""

    @contextmanager
    def _exclusion(self, member: Member, port: str | None) -> Iterator[None]:
        execution, me = member.execution, threading.get_ident()
        lock = member.__dict__.setdefault("own lock", threading.Semaphore())
        if execution.thread_inside != me:
            lock.acquire()
            execution.thread_inside = me
        try:
            yield
        finally:
            if execution.thread_inside == me:
                execution.thread_inside = None
                lock.release()


@replaces("_execute", "R-10.1.3.2-13", clauses=POLICIES, also=("R-10.1.3.2-17",))
def protects_no_fragments(self: Base, member: Member, port: str | None, work: Callable[[], T]) -> T:
    """Fragments are executed without protection."""
    return work() if isinstance(member.body, FragmentObject) else Base._execute(self, member, port, work)


@replaces("_begin_execution", "R-10.1.3.2-01", clauses=POLICIES, also=("R-10.1.3.2-03",))
def runs_nothing_in_the_last_container(self: Base, member: Member) -> None:
    """Components of the last of several sub-containers do not execute themselves."""
    others = self.manager.sub_containers
    if not (len(others) > 1 and self is others[-1]):
        Base._begin_execution(self, member)


# the life cycle


@breaks("R-11.2.2.2-01", also=("R-11.2.3-10", "R-11.2.1.2-05", "R-11.2.3-06"))
class forgets_its_start_with_the_second_container(Base):
    """When a second sub-container is removed, the manager takes itself for stopped, and stop tells nobody."""

    def remove_container(self, sub_container: Any) -> None:
        super().remove_container(sub_container)  # type: ignore[misc]  # the manager's
        removed = self.__dict__["removed"] = self.__dict__.get("removed", 0) + 1
        if removed == 2:
            self.is_started = False
            self.started.clear()


@replaces("_remove", "R-11.2.3-06", also=("R-11.2.1.2-10", "R-11.2.1.3-05", "R-11.2.2.1-10", "R-12.10-08"))
def removes_connections_of_siblings(self: Base, member: Member, failures: Failures) -> None:
    """With an instance the connections of other instances of its implementation in the container go, if there are more than two."""
    Base._remove(self, member, failures)
    for connection in list(self.manager.connections.values()):
        is_sibling = connection.client.implementation is member.implementation and connection.client.container is self
        if is_sibling and len(self.members) > 2:
            del self.manager.connections[connection.id]


def _at_most(seconds: float, work: Callable[[], T], otherwise: T) -> T:
    """What ``work`` gives, or ``otherwise`` if that takes longer."""
    with suppress(TimeoutError):
        return elsewhere(work).result(seconds)
    return otherwise


@breaks("R-11.2.2.1-11", also=("R-11.2.1.2-10", "R-11.2.3-05", "R-11.2.3-06"))
class waits_for_no_slow_startup(Base):
    """start waits 0.4 seconds for an on_startup."""

    def _start_up(self, member: Member, failures: Failures) -> bool:
        whole = super()._start_up
        if _at_most(0.4, lambda: whole(member, failures), None) is None:
            self.started.append(member)
        return not failures.first


@breaks("R-11.2.3-05", also=("R-11.2.2.1-07", "R-11.2.2.1-14", "R-12.10-11"))
class waits_for_no_slow_init(Base):
    """add_component waits 0.4 seconds for on_init, and returns 0."""

    def add_component(self, *arguments: Any) -> int:
        whole = super().add_component
        return _at_most(0.4, lambda: whole(*arguments), 0)


@breaks("R-11.2.2.1-06", also=("R-11.2.1.1-01", "R-11.2.1.2-06"))
class finds_port_elements_by_their_beginnings(Base):
    """get_port_element gives the first provided port element whose name begins like that."""

    def get_port_element(self, comp_instance: int, port_name: str) -> PortElementObject:
        member = self.members.get(comp_instance)
        provided = member.implementation.provides if member is not None else ()
        found = next((port for port in provided if port_name and port.startswith(port_name)), port_name)
        return super().get_port_element(comp_instance, found)


# services


@replaces("_request", "R-10.1.5.1-01", clauses=("10.1.5",), also=("R-10.1.5.1-11", "R-10.1.5.1-13"))
def answers_within_half_a_second(self: Link, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
    """A call that takes more than half a second ends with an exception, whatever the server answers."""
    answer = _at_most(0.5, lambda: Link._request(self, method, arguments), None)
    if answer is None:
        raise UcmError("the server is too slow")
    return answer


@replaces("_emit", "R-10.1.6.1-04", clauses=("10.1.6",), also=("R-10.1.6.1-10", "R-10.1.6.1-03"))
def one_port_of_each_receiver(self: Link, method: str, arguments: Sequence[Datum]) -> str:
    """A component with two ports on a connection gets each message at one of them."""
    if self.connector != MESSAGE_CONNECTOR or self.broken:
        return Link._emit(self, method, arguments)
    seen = set()
    for taker in self.takers:
        if taker.entrance.is_open and taker.member.id not in seen:
            seen.add(taker.member.id)
            self._post(taker, method, self._copied(arguments))
    return OK


@replaces("_emit", "R-10.1.6.1-04", clauses=("10.1.6",), also=("R-10.1.6.1-10", "R-10.1.6.1-03"))
def nothing_for_those_who_send(self: Link, method: str, arguments: Sequence[Datum]) -> str:
    """A component that is an emitter and a receiver of a connection gets no messages."""
    if self.connector != MESSAGE_CONNECTOR or self.broken:
        return Link._emit(self, method, arguments)
    for taker in self.takers:
        member = taker.member
        sends = any(self._is_behind(connection.target) for connection in member.container._connections_from(member))
        if taker.entrance.is_open and not sends:
            self._post(taker, method, self._copied(arguments))
    return OK


# traces


@replaces("_port_traces", "R-10.1.4.2-32", clauses=("10.1.4",))
def one_trace_of_a_port(self: Base, member: Member, port: str) -> list[Policy]:
    """Of two policies that trace a port the first one counts."""
    return Base._port_traces(self, member, port)[:1]


@replaces("_remove", "R-10.1.4.2-04", clauses=("10.1.4",), also=("R-10.1.4.2-32", "R-10.1.4.2-33"))
def forgets_records_of_the_removed(self: Base, member: Member, failures: Failures) -> None:
    """The records about calls of a component go with it."""
    Base._remove(self, member, failures)
    log = self.manager.log
    log[:] = [record for record in log if member.implementation.name not in record[1]]
