"""Bodies that raise: what escapes from the operation, and what is left half done (entrance × operation × aftermath)."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from typing import Any

from ucm_cts.adapters.contract.programming_model import FragmentObject, UcmError
from ucm_cts.adapters.mutants.python.methods import replaces
from ucm_cts.adapters.mutants.python.registry import Base, breaks, is_below
from ucm_cts.adapters.reference.python.framework import Container, ContainerManager
from ucm_cts.adapters.reference.python.members import Connection, Failures, Member, State


class NotesFailures(Base):
    """A container that is told which callback of which member raised."""

    def _callback_failed(self, hook: str, member: Member) -> None:
        """``hook`` of ``member`` raised."""

    def _initialise(self, member: Member) -> None:
        try:
            super()._initialise(member)
        except Exception:
            self._callback_failed("on_init", member)
            raise

    def _connect(self, connection: Connection) -> None:
        try:
            super()._connect(connection)
        except UcmError:
            self._callback_failed("on_connect", connection.client)
            raise

    def _disconnect(self, connection: Connection, failures: Failures) -> None:
        own = Failures()
        super()._disconnect(connection, own)
        self._pass_on("on_disconnect", connection.client, own, failures)

    def _start_up(self, member: Member, failures: Failures) -> bool:
        done = super()._start_up(member, failures)
        if not done:
            self._callback_failed("on_startup", member)
        return done

    def _shut_down(self, member: Member, failures: Failures) -> None:
        own = Failures()
        super()._shut_down(member, own)
        self._pass_on("on_shutdown", member, own, failures)

    def _remove(self, member: Member, failures: Failures) -> None:
        own = Failures()
        super()._remove(member, own)
        self._pass_on("on_remove", member, own, failures)

    def _pass_on(self, hook: str, member: Member, own: Failures, failures: Failures) -> None:
        if own.first:
            failures.first = failures.first or own.first
            self._callback_failed(hook, member)


# what escapes


class _NotesHooks(NotesFailures):
    def _callback_failed(self, hook: str, member: Member) -> None:
        self.manager.__dict__["failed"] = hook


def _lets_out(hook: str, operation: str) -> type:
    """A mixin whose ``operation`` raises something undeclared if ``hook`` raised in it."""

    def call(self: Any, *arguments: Any) -> Any:
        self.manager.__dict__["failed"] = ""
        try:
            return getattr(super(mixin, self), operation)(*arguments)
        except UcmError as error:
            if self.manager.__dict__["failed"] == hook:
                raise RuntimeError("the body failed") from error
            raise

    lie = f"What {hook} raises in {operation} leaves it as an undeclared exception."
    mixin = type(f"lets_{hook}_out_of_{operation}", (_NotesHooks,), {operation: call, "__doc__": lie})
    return mixin


_OPERATIONS = {
    "add_component": "R-12.10-04",
    "remove_component": "R-12.10-05",
    "connect": "R-12.10-07",
    "disconnect": "R-12.10-08",
    "start": "R-12.10-09",
    "stop": "R-12.10-10",
    "remove_container": "R-12.10-13",
    "destroy": "R-12.10-14",
}
_WAYS = {
    "on_init": ("add_component",),
    "on_connect": ("connect",),
    "on_disconnect": ("disconnect", "remove_component", "remove_container", "destroy"),
    "on_startup": ("start",),
    "on_shutdown": ("stop", "remove_container", "destroy"),
    "on_remove": ("remove_component", "remove_container", "destroy"),
}
for _hook, _operations in _WAYS.items():
    for _operation in _operations:
        breaks(_OPERATIONS[_operation], also=("R-12.10-23",))(_lets_out(_hook, _operation))


@breaks("R-12.10-04")
class lets_failures_of_set_container_interface_out(Base):
    """What set_container_interface raises leaves add_component as an undeclared exception."""

    def _configure(self, member: Member, attributes: Any) -> None:
        try:
            super()._configure(member, attributes)
        except Exception:
            self.__dict__["failed fragment"] = isinstance(member.body, FragmentObject)
            raise

    def add_component(self, implementation: str, attributes: Any) -> int:
        self.__dict__["failed fragment"] = False
        try:
            return super().add_component(implementation, attributes)
        except UcmError as error:
            if self.__dict__["failed fragment"]:
                raise RuntimeError("the fragment failed") from error
            raise


# what is left half done


class _Abandons(NotesFailures):
    """Once ``hook`` raised, the operation leaves the members that follow as they are."""

    hook = "on_remove"
    operation = ""

    def _callback_failed(self, hook: str, member: Member) -> None:
        if hook == self.hook:
            self.__dict__["abandoned"] = True

    def _remove_members(self, failures: Failures) -> None:
        for member in reversed(list(self.members.values())):
            if self.__dict__.get("abandoned"):
                self.members.clear()
            else:
                self._remove(member, failures)


def _abandons(hook: str, operation: str, requirement: str) -> None:
    def call(self: Any, *arguments: Any) -> Any:
        for container in (self.manager, *self.manager.sub_containers):
            container.__dict__["abandoned"] = False
        if operation != "destroy":
            return getattr(super(mixin, self), operation)(*arguments)
        with suppress(UcmError):
            getattr(super(mixin, self), operation)(*arguments)
        return None

    silently = ", and destroy returns" if operation == "destroy" else ""
    lie = f"Members that {operation} comes to after a failing {hook} get no on_remove{silently}."
    fields = {"hook": hook, operation: call, "__doc__": lie}
    mixin = type(f"abandons_{operation}_after_{hook}", (_Abandons,), fields)
    breaks(requirement, also=("R-11.2.2.2-04", "R-11.2.2.2-05"))(mixin)


for _hook in ("on_shutdown", "on_disconnect", "on_remove"):
    _abandons(_hook, "remove_container", "R-11.2.2.2-04")
    _abandons(_hook, "destroy", "R-11.2.2.2-05")


@breaks("R-11.2.2.1-12", also=("R-12.10-23", "R-11.2.3-09"))
class stops_no_further_below_after_a_failure(NotesFailures):
    """A failing on_shutdown in a sub-container ends stop there; the members that follow are not shut down."""

    def _callback_failed(self, hook: str, member: Member) -> None:
        if hook == "on_shutdown" and is_below(self):
            for other in self.started:
                other.state = State.CONFIGURING
            self.started.clear()


class _KeepsFailed(Base):
    def _is_kept(self, member: Member) -> bool:
        return True

    def _configure(self, member: Member, attributes: Any) -> None:
        try:
            super()._configure(member, attributes)
        except Exception:
            if self._is_kept(member):
                self.members[member.id] = member
            raise


@replaces("_is_kept", "R-12.10-22", also=("R-11.2.3-06", "R-11.2.2.1-14"))
def keeps_failed_components_below(self: _KeepsFailed, _member: Member) -> bool:
    """A component of a sub-container whose on_init raised stays a member, although add_component failed."""
    return is_below(self)


@replaces("_is_kept", "R-12.10-22", also=("R-11.2.3-06", "R-11.2.2.1-14"))
def keeps_failed_fragments(_self: _KeepsFailed, member: Member) -> bool:
    """A fragment whose on_init raised stays a member, although add_component failed."""
    return isinstance(member.body, FragmentObject)


@replaces("_is_kept", "R-12.10-22", also=("R-11.2.3-06", "R-11.2.2.1-14"))
def keeps_the_second_failed_component(self: _KeepsFailed, _member: Member) -> bool:
    """Of two components whose on_init raised, the second stays a member."""
    self.__dict__["met"] = self.__dict__.get("met", 0) + 1
    return int(self.__dict__["met"]) == 2


@replaces("_is_kept", "R-12.10-22", also=("R-11.2.3-06", "R-11.2.2.1-14"))
def keeps_failed_components_among_others(self: _KeepsFailed, _member: Member) -> bool:
    """A component whose on_init raised stays a member if there are two others."""
    return len(self.members) >= 2


class _RollsBack(NotesFailures):
    def _callback_failed(self, hook: str, member: Member) -> None:
        if hook == "on_init":
            self._roll_back(member)

    def _roll_back(self, member: Member) -> None:
        raise NotImplementedError


@replaces("_roll_back", "R-11.2.2.1-14", also=("R-12.10-22", "R-12.10-15", "R-11.2.2.1-11"))
def rolls_back_two_members(self: _RollsBack, _member: Member) -> None:
    """After a failing on_init the member that was added before is lost, too."""
    if self.members:
        self.members.popitem()


@replaces(
    "_roll_back",
    "R-11.2.1.3-05",
    also=("R-11.2.3-06", "R-11.2.2.1-10", "R-11.2.3-10", "R-12.10-16", "R-12.10-24"),
)
def rolls_back_connections(self: _RollsBack, _member: Member) -> None:
    """After a failing on_init the connections of all other members are lost."""
    for connection in self._connections_of_members():
        del self.manager.connections[connection.id]


@replaces("_roll_back", "R-11.2.1.2-06", also=("R-11.2.1.2-01",))
def rolls_back_the_wrong_member(self: _RollsBack, _member: Member) -> None:
    """After a failing on_init the member that was added before gets on_remove."""
    for other in list(self.members.values())[-1:]:
        Failures().attempt(other.body.on_remove)


@replaces("_roll_back", "R-11.2.1.2-10", also=("R-12.10-22",))
def shuts_down_what_failed_to_initialise(self: _RollsBack, member: Member) -> None:
    """A body whose on_init raised gets on_shutdown at once."""
    Failures().attempt(member.body.on_shutdown)


@breaks("R-11.2.2.1-14", also=("R-12.10-23",))
class lists_what_failed_to_leave(NotesFailures):
    """get_components goes on listing a component whose on_remove raised; nothing else knows it."""

    def _callback_failed(self, hook: str, member: Member) -> None:
        if hook == "on_remove":
            self.__dict__.setdefault("ghosts", []).append(member.id)

    def get_components(self) -> list[int]:
        return [*super().get_components(), *self.__dict__.get("ghosts", [])]


@breaks("R-11.2.2.1-11", also=("R-12.10-23",))
class leaves_out_those_who_started_before_a_failure(NotesFailures):
    """The start after a failed one leaves out the members that the failed one had started and shut down."""

    def _callback_failed(self, hook: str, member: Member) -> None:
        if hook == "on_startup":
            self.__dict__["done"] = list(self.started)

    def _start_order(self) -> Sequence[Member]:
        done = self.__dict__.pop("done", [])
        return [member for member in super()._start_order() if member not in done]


@breaks("R-11.2.3-06", also=("R-11.2.3-10", "R-12.10-23", "R-11.2.3-08"))
class never_starts_after_a_failing_start(NotesFailures):
    """Once an on_startup raised, every start of the container is refused."""

    def _callback_failed(self, hook: str, member: Member) -> None:
        if hook == "on_startup":
            self.__dict__["is spoilt"] = True

    def _check_startable(self) -> None:
        super()._check_startable()
        if self.__dict__.get("is spoilt"):
            raise UcmError("it failed before")


@breaks("R-11.1.3-03", also=("R-11.2.2.2-02",))
class makes_no_containers_after_a_failed_removal(Base):
    """After remove_container has failed, create_container is refused."""

    def remove_container(self, sub_container: Container | None) -> None:
        try:
            ContainerManager.remove_container(self.manager, sub_container)
        except UcmError:
            self.__dict__["is spoilt"] = True
            raise

    def create_container(self) -> Container:
        if self.__dict__.get("is spoilt"):
            raise UcmError("a container is still being removed")
        return ContainerManager.create_container(self.manager)


@breaks("R-12.10-17", also=("R-12.10-13",))
class knows_containers_that_failed_to_go(Base):
    """A container whose members raised in remove_container can be removed again and again."""

    def remove_container(self, sub_container: Container | None) -> None:
        failed = self.__dict__.setdefault("failed", [])
        if sub_container in failed:
            return
        try:
            ContainerManager.remove_container(self.manager, sub_container)
        except UcmError:
            failed.append(sub_container)
            raise
