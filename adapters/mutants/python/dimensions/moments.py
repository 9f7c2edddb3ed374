"""What bodies do in callbacks besides raising: they take their time, call a peer or ask their container."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Mapping

from ucm_cts.adapters.contract.programming_model import FragmentObject, PortConnection, UcmError
from ucm_cts.adapters.mutants.python.methods import alters, replaces
from ucm_cts.adapters.mutants.python.registry import Base, PeerProxy, breaks, is_below
from ucm_cts.adapters.reference.python.framework import Container
from ucm_cts.adapters.reference.python.members import Connection, Failures, Member, State

# callbacks that take their time


def _for_a_while(work: Callable[[], object], seconds: float = 0.05) -> bool:
    """Do ``work`` on another thread and wait so long. False if it goes on."""
    working = threading.Thread(target=work, daemon=True)
    working.start()
    working.join(seconds)
    return not working.is_alive()


@breaks("R-11.2.3-05", also=("R-11.2.2.1-01", "R-11.1.1-01", "R-12.10-22"))
class does_not_wait_for_on_init(Base):
    """add_component returns after 50 ms although on_init goes on."""

    def _initialise(self, member: Member) -> None:
        failures = Failures()
        _for_a_while(lambda: failures.attempt(member.body.on_init))
        failures.report()


@breaks("R-11.2.1.3-02", also=("R-11.1.1-01",))
class does_not_wait_for_on_connect(Base):
    """connect returns after 50 ms although on_connect goes on."""

    def _connect(self, connection: Connection) -> None:
        failures = Failures()
        if connection.client.implementation.connectable:
            body = connection.client.body
            call = body.on_connect  # type: ignore[attr-defined]
            _for_a_while(lambda: failures.attempt(call, connection.port, connection.target))
        failures.report()
        self.manager.connections[connection.id] = connection


@breaks("R-11.2.1.3-05", also=("R-11.1.1-01",))
class does_not_wait_for_on_disconnect(Base):
    """disconnect returns after 50 ms although on_disconnect goes on."""

    def _disconnect(self, connection: Connection, failures: Failures) -> None:
        del self.manager.connections[connection.id]
        if connection.client.implementation.connectable:
            call = connection.client.body.on_disconnect  # type: ignore[attr-defined]
            _for_a_while(lambda: failures.attempt(call, connection.port))


@breaks("R-11.2.2.1-11", also=("R-11.1.1-01", "R-11.2.1.2-07"))
class does_not_wait_for_on_startup(Base):
    """start returns although an on_startup goes on for more than 50 ms."""

    def _start_up(self, member: Member, failures: Failures) -> bool:
        own = Failures()
        given = self._dependencies_of(member)
        _for_a_while(lambda: own.attempt(member.body.on_startup, given))
        if own.first:
            failures.first = failures.first or own.first
            return False
        member.state = State.READY
        self.started.append(member)
        return True


@breaks("R-11.2.2.1-12", also=("R-11.1.1-01",))
class does_not_wait_for_on_shutdown(Base):
    """stop returns although an on_shutdown goes on for more than 50 ms."""

    def _shut_down(self, member: Member, failures: Failures) -> None:
        self._end_execution(member)
        member.state = State.CONFIGURING
        _for_a_while(lambda: failures.attempt(member.body.on_shutdown))


@breaks("R-11.2.1.2-06", also=("R-11.1.1-01", "R-11.2.2.2-04", "R-11.2.2.2-05"))
class does_not_wait_for_on_remove(Base):
    """remove_component returns although on_remove goes on for more than 50 ms."""

    def _remove(self, member: Member, failures: Failures) -> None:
        self._leave_links(member)
        _for_a_while(lambda: failures.attempt(member.body.on_remove))
        member.execution.executor.close()
        del self.members[member.id]


@breaks("R-11.2.2.2-03", also=("R-11.2.2.2-04", "R-12.10-13", "R-11.2.3-10"))
class gives_up_removing_slow_containers(Base):
    """remove_container is refused half way if an on_shutdown takes more than 50 ms."""

    def _shut_down(self, member: Member, failures: Failures) -> None:
        began = time.monotonic()
        super()._shut_down(member, failures)
        if time.monotonic() - began > 0.05 and is_below(self):
            failures.first = failures.first or "it took too long"


@breaks("R-12.10-09", also=("R-11.2.3-06", "R-11.2.3-10"))
class starts_in_50_milliseconds(Base):
    """start raises an undeclared exception if an on_startup takes more than 50 ms."""

    def _start_up(self, member: Member, failures: Failures) -> bool:
        began = time.monotonic()
        done = super()._start_up(member, failures)
        if time.monotonic() - began > 0.05:
            raise TimeoutError("on_startup takes too long")
        return done


@breaks("R-11.2.1.2-10", also=("R-11.2.2.1-12", "R-11.2.3-09"))
class stops_twice_if_slow(Base):
    """A member whose on_shutdown takes more than 50 ms gets it again."""

    def _shut_down(self, member: Member, failures: Failures) -> None:
        began = time.monotonic()
        super()._shut_down(member, failures)
        if time.monotonic() - began > 0.05:
            failures.attempt(member.body.on_shutdown)


# business calls that take their time, or come back


class _Deep(PeerProxy):
    here = threading.local()
    depth = 2

    def exchange(self, value: int) -> int:
        depth = getattr(self.here, "depth", 0)
        if depth >= self.depth:
            raise UcmError("nested too deep")
        self.here.depth = depth + 1
        try:
            return self.target.exchange(value)
        finally:
            self.here.depth = depth


@breaks("R-11.2.3-03", also=("R-11.1.3-01", "R-11.1.2-02"))
class calls_peers_two_deep(_Deep):
    """A call inside a call inside a call between components is refused."""


@breaks("R-11.2.3-03", also=("R-11.1.3-01", "R-11.1.2-02"))
class calls_peers_seven_deep(_Deep):
    """The eighth call inside others between components is refused."""

    depth = 7


@replaces("exchange", "R-11.2.3-03", also=("R-11.1.3-01", "R-11.1.2-02"))
def calls_nobody_while_containers_change(self: PeerProxy, value: int) -> int:
    """While an operation of the runtime is in progress on another container, components cannot call each other."""
    if self.member.container.manager.busy_thread is not None and self.member.container.is_started:
        raise UcmError("the container is being stopped")
    return self.target.exchange(value)


@replaces("exchange", "R-11.2.3-03", also=("R-11.1.3-01", "R-11.1.2-02"))
def calls_nobody_after_an_exception(self: PeerProxy, value: int) -> int:
    """Once a call between two components raised, calls of that client are refused."""
    if self.member.__dict__.get("failed"):
        raise UcmError("the peer failed before")
    try:
        return self.target.exchange(value)
    except Exception:
        self.member.__dict__["failed"] = True
        raise


# fragments that ask their container


class _Shows(Base):
    """Fragments are shown what ``_seen`` makes of the list of members."""

    def _configure(self, member: Member, attributes: Mapping[str, str]) -> None:
        if isinstance(member.body, FragmentObject):
            self._set_attributes(member, attributes)
            member.body.set_container_interface(_View(self, member))
            self._initialise(member)
        else:
            super()._configure(member, attributes)

    def _seen(self, listed: list[int], member: Member) -> list[int]:
        return listed


class _View:
    def __init__(self, container: _Shows, member: Member) -> None:
        self.container, self.member = container, member

    def get_components(self) -> list[int]:
        """What the fragment is shown."""
        return self.container._seen(Container.get_components(self.container), self.member)


@replaces("_seen", "R-11.2.1.4-03")
def shows_fragments_others_only(_self: _Shows, listed: list[int], member: Member) -> list[int]:
    """A fragment does not see itself among the members."""
    return [number for number in listed if number != member.id]


@breaks("R-11.2.1.4-03")
class shows_fragments_nothing_after_a_restart(_Shows):
    """Fragments that ask in the second phase of their container see nobody."""

    def stop(self) -> None:
        self.__dict__["was stopped"] = self.__dict__.get("was stopped") or self.is_started
        super().stop()

    def _seen(self, listed: list[int], member: Member) -> list[int]:
        return [] if self.__dict__.get("was stopped") else listed


@replaces("_seen", "R-11.2.1.4-03")
def shows_fragments_those_before_them(_self: _Shows, listed: list[int], member: Member) -> list[int]:
    """A fragment sees the members that were added before it, and itself."""
    return [number for number in listed if number <= member.id]


@replaces("_seen", "R-11.2.1.4-03")
def shows_fragments_below_the_manager(self: _Shows, listed: list[int], _member: Member) -> list[int]:
    """Fragments of sub-containers see the manager's members beside their own."""
    return [*listed, *self.manager.members] if is_below(self) else listed


@alters("_dependencies_of", "R-11.2.1.2-09", also=("R-11.2.3-10",))
def gives_fragments_below_nothing(self: Base, given: list[PortConnection], member: Member) -> list[PortConnection]:
    """Fragments of sub-containers get no dependencies."""
    return [] if is_below(self) and isinstance(member.body, FragmentObject) else given
