"""What is left when a body raised while something ended: others that were not told, and ports and numbers that stay taken."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from typing import Any

from ucm_cts.adapters.contract.programming_model import PortElementObject, UcmError
from ucm_cts.adapters.mutants.python.dimensions.failures import NotesFailures
from ucm_cts.adapters.mutants.python.methods import replaces
from ucm_cts.adapters.mutants.python.registry import Base, breaks
from ucm_cts.adapters.reference.python.framework import ContainerManager
from ucm_cts.adapters.reference.python.members import Connection, Failures, Member, State

_TOLD, _AGAIN = "R-11.2.1.3-05", "R-11.2.3-08"
_REMOVES_ALL, _DESTROYS_ALL = "R-11.2.2.2-04", "R-11.2.2.2-05"


def _swallowed(operation: Callable[..., None]) -> Callable[..., None]:
    def call(*arguments: Any) -> None:
        with suppress(UcmError):
            operation(*arguments)

    return call


class _TellsNoMore(Base):
    """Once a body raised, the connections that follow are undone without on_disconnect."""

    def _disconnect_members(self, failures: Failures) -> None:
        for connection in reversed(self._connections_of_members()):
            if failures.first:
                del self.manager.connections[connection.id]
            else:
                self._disconnect(connection, failures)


@breaks(_TOLD)
class tells_no_more_members_after_a_failure(_TellsNoMore):
    """When a body raises in remove_container or destroy, the members that follow get no on_disconnect."""


@breaks(_TOLD)
class tells_no_more_members_and_returns(_TellsNoMore):
    """When a body raises in remove_container or destroy, the members that follow get no on_disconnect, and it returns."""

    def remove_container(self, sub_container: Any) -> None:
        _swallowed(ContainerManager.remove_container)(self.manager, sub_container)

    def destroy(self) -> None:
        _swallowed(ContainerManager.destroy)(self.manager)


class _ShutsNoMoreDown(Base):
    """Once an on_shutdown raised while containers are removed, the other members are not shut down."""

    def _shut_down_started(self, failures: Failures) -> None:
        if not self.manager.__dict__.get("ending"):
            super()._shut_down_started(failures)
            return
        for member in self.started:
            self._close_entrances(member)
            self._end_execution(member)
        while self.started:
            member = self.started.pop()
            member.state = State.CONFIGURING
            if not failures.first:
                self._shut_down(member, failures)
        self.is_started = False


@breaks(_REMOVES_ALL, also=("R-11.2.1.2-10", "R-11.2.1.2-06"))
class shuts_no_more_down_in_remove_container(_ShutsNoMoreDown):
    """When an on_shutdown raises in remove_container, the members that follow are removed without on_shutdown."""

    def remove_container(self, sub_container: Any) -> None:
        self.manager.__dict__["ending"] = True
        try:
            ContainerManager.remove_container(self.manager, sub_container)
        finally:
            self.manager.__dict__["ending"] = False


@breaks(_DESTROYS_ALL)
class shuts_no_more_down_in_destroy(_ShutsNoMoreDown):
    """When an on_shutdown raises in destroy, the members that follow are removed without on_shutdown, and it returns."""

    def destroy(self) -> None:
        self.manager.__dict__["ending"] = True
        _swallowed(ContainerManager.destroy)(self.manager)


class _KnowsTaken(NotesFailures):
    """Knows whose on_disconnect raised."""

    def _callback_failed(self, hook: str, member: Member) -> None:
        if hook == "on_disconnect":
            self.manager.__dict__.setdefault("taken", set()).add(member)

    def _is_taken(self, number: int) -> bool:
        return self.members.get(number) in self.manager.__dict__.get("taken", ())


@replaces("connect", _AGAIN, also=("R-12.10-07",))
def ports_stay_taken(self: _KnowsTaken, instance: int, port_name: str, to_port: PortElementObject | None) -> int:
    """A component whose on_disconnect raised cannot be connected again, although its connection is gone."""
    if self._is_taken(instance):
        raise UcmError(f"{port_name!r} is connected already")
    return ContainerManager.connect(self, instance, port_name, to_port)


@breaks(_AGAIN, also=("R-12.10-07",))
class ports_stay_taken_in_silence(_KnowsTaken):
    """What on_disconnect raises is ignored, and the component cannot be connected again."""

    def _undo(self, connection: Connection) -> None:
        _swallowed(super()._undo)(connection)

    def connect(self, instance: int, port_name: str, to_port: PortElementObject | None) -> int:
        if self._is_taken(instance):
            raise UcmError(f"{port_name!r} is connected already")
        return super().connect(instance, port_name, to_port)
