"""Defects that show in some situations only: after a phase, a refusal, a failure or a removal, or in a second container.

Each mutant is a cell of a table: what is wrong × since when. What is wrong is a class, since when its ``is_due``.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from typing import Any

from ucm_cts.adapters.contract.programming_model import (
    FragmentObject,
    NotFound,
    PortConnection,
    PortElementObject,
    UcmError,
)
from ucm_cts.adapters.mutants.python.dimensions.histories import (
    History,
    Situation,
    after_a_failure,
    after_a_phase,
    after_a_refusal,
    after_a_removal,
    after_a_removed_container,
    after_two_phases,
    beside_a_running_container,
    in_a_second_container,
    with_eight_members,
)
from ucm_cts.adapters.mutants.python.registry import CONTAINER, Row, family
from ucm_cts.adapters.reference.python.framework import Container, ContainerManager
from ucm_cts.adapters.reference.python.members import Connection, Failures, Member, State


class _Defect(History):
    situation: Situation

    @property
    def is_due(self) -> bool:
        """Does the defect show now?"""
        return type(self).situation(self)


class LeavesOneOut(_Defect):
    """start leaves out the member added last."""

    def _start_order(self) -> Sequence[Member]:
        order = super()._start_order()
        return order[:-1] if self.is_due else order


class StopsOneLess(_Defect):
    """stop leaves out the member that was started last."""

    def stop(self) -> None:
        if self.is_due and self.started:
            self.started.pop().state = State.CONFIGURING
        super().stop()


class StopsInOrder(_Defect):
    """stop goes in the order of start."""

    def stop(self) -> None:
        if self.is_due:
            self.started.reverse()
        super().stop()


class ConnectsSilently(_Defect):
    """There is no on_connect."""

    def _connect(self, connection: Connection) -> None:
        if self.is_due:
            self.manager.connections[connection.id] = connection
        else:
            super()._connect(connection)


class DisconnectsSilently(_Defect):
    """There is no on_disconnect."""

    def _disconnect(self, connection: Connection, failures: Failures) -> None:
        if self.is_due:
            del self.manager.connections[connection.id]
        else:
            super()._disconnect(connection, failures)


class InitialisesNothing(_Defect):
    """There is no on_init."""

    def _initialise(self, member: Member) -> None:
        if not self.is_due:
            super()._initialise(member)


class ConfiguresNothing(_Defect):
    """Attributes are not set."""

    def _set_attributes(self, member: Member, attributes: Mapping[str, str]) -> None:
        if not self.is_due:
            super()._set_attributes(member, attributes)


class RemovesSilently(_Defect):
    """There is no on_remove."""

    def _remove(self, member: Member, failures: Failures) -> None:
        if self.is_due:
            del self.members[member.id]
        else:
            super()._remove(member, failures)


class LosesTheLastConnection(_Defect):
    """on_startup leaves out the last connection."""

    def _dependencies_of(self, member: Member) -> list[PortConnection]:
        given = super()._dependencies_of(member)
        return given[:-1] if self.is_due else given


class HidesTheContainer(_Defect):
    """Fragments are not given their container."""

    def _configure(self, member: Member, attributes: Mapping[str, str]) -> None:
        if self.is_due and isinstance(member.body, FragmentObject):
            self._set_attributes(member, attributes)
            self._initialise(member)
        else:
            super()._configure(member, attributes)


class ListsOneLess(_Defect):
    """get_components leaves out the last member."""

    def get_components(self) -> list[int]:
        listed = super().get_components()
        return listed[:-1] if self.is_due else listed


class _Refuses(_Defect):
    def _refuse(self) -> None:
        if self.is_due:
            raise UcmError("not now")


class RefusesToStart(_Refuses):
    """start is refused."""

    def _check_startable(self) -> None:
        super()._check_startable()
        self._refuse()


class RefusesToAdd(_Refuses):
    """add_component is refused."""

    def _instantiate(self, implementation: Any) -> Any:
        self._refuse()
        return super()._instantiate(implementation)


class RefusesToConnect(_Refuses):
    """connect is refused."""

    def _connect_to(self, member: Member, port: str, target: PortElementObject) -> int:
        self._refuse()
        return super()._connect_to(member, port, target)


class RefusesToDisconnect(_Refuses):
    """disconnect is refused."""

    def _undo(self, connection: Connection) -> None:
        self._refuse()
        super()._undo(connection)


class RefusesToRemove(_Refuses):
    """remove_component is refused."""

    def _check_removable(self, member: Member) -> None:
        super()._check_removable(member)
        self._refuse()


class FindsNoElements(_Defect):
    """get_port_element raises NOT_FOUND."""

    def get_port_element(self, comp_instance: int, port_name: str) -> PortElementObject:
        element = super().get_port_element(comp_instance, port_name)
        if self.is_due:
            raise NotFound("not any more")
        return element


class MakesNoContainers(_Refuses):
    """create_container is refused."""

    def create_container(self) -> Container:
        self._refuse()
        return ContainerManager.create_container(self.manager)


class MakesNoFirstContainer(MakesNoContainers):
    """create_container is refused, and there is no sub-container."""


class RemovesNoContainers(_Refuses):
    """remove_container is refused."""

    def remove_container(self, sub_container: Container | None) -> None:
        if sub_container in self.manager.sub_containers:
            self._refuse()
        super().remove_container(sub_container)


class CallsAnother(_Defect):
    """An operation on one container calls on_shutdown of members of others that run."""

    def _start_up(self, member: Member, failures: Failures) -> bool:
        for other in (self.manager, *self.manager.sub_containers) if self.is_due else ():
            for running in other.started if other is not self else ():
                with suppress(Exception):
                    running.body.on_shutdown()
        return super()._start_up(member, failures)


_FRAGMENTS = ("R-11.2.1.4-01",)
_WRONG: dict[type[_Defect], tuple[str, str, tuple[str, ...]]] = {
    LeavesOneOut: ("start leaves out the last member", "R-11.2.2.1-11", (*_FRAGMENTS, "R-11.2.2.2-01")),
    StopsOneLess: (
        "stop leaves out the member that was started last",
        "R-11.2.2.1-12",
        ("R-11.2.3-09", "R-11.2.2.2-01"),
    ),
    StopsInOrder: ("stop goes in the order of start", "R-11.2.2.1-13", ()),
    ConnectsSilently: ("there is no on_connect", "R-11.2.1.3-02", ()),
    DisconnectsSilently: ("there is no on_disconnect", "R-11.2.1.3-05", ()),
    InitialisesNothing: (
        "there is no on_init",
        "R-11.2.3-05",
        (*_FRAGMENTS, "R-12.10-22", "R-11.2.1.2-05", "R-11.2.1.2-01"),
    ),
    ConfiguresNothing: ("attributes are not set", "R-11.2.1.2-05", ("R-10.1.1-06",)),
    RemovesSilently: ("there is no on_remove", "R-11.2.1.2-06", ("R-11.2.2.2-04", "R-11.2.2.2-05")),
    LosesTheLastConnection: ("on_startup leaves out a connection", "R-11.2.1.2-09", ("R-11.2.3-10", "R-12.10-25")),
    HidesTheContainer: ("fragments are not given their container", "R-11.2.1.4-02", ("R-11.2.1.4-03",)),
    ListsOneLess: ("get_components leaves out the last member", "R-11.2.2.1-14", ("R-11.2.1.4-03", "R-12.10-22")),
    RefusesToStart: ("start is refused", "R-11.2.3-06", ("R-11.2.3-08", "R-11.2.3-10")),
    RefusesToAdd: ("add_component is refused", "R-11.2.2.1-01", ("R-11.1.3-02",)),
    RefusesToConnect: (
        "connect is refused",
        "R-11.2.2.1-08",
        ("R-11.2.3-08", "R-11.2.1.1-01", "R-11.2.1.3-01", "R-12.10-24"),
    ),
    RefusesToDisconnect: ("disconnect is refused", "R-11.2.2.1-10", ()),
    RefusesToRemove: ("remove_component is refused", "R-11.2.2.1-05", ()),
    FindsNoElements: ("get_port_element finds nothing", "R-11.2.2.1-07", ()),
    MakesNoContainers: ("create_container is refused", "R-11.1.3-03", ("R-11.2.2.2-02",)),
    MakesNoFirstContainer: ("create_container is refused", "R-11.2.2.2-02", ("R-11.1.3-03",)),
    RemovesNoContainers: ("remove_container is refused", "R-11.2.2.2-03", ()),
    CallsAnother: ("start shuts members of other containers down", "R-11.1.3-04", ("R-11.2.1.2-10",)),
}
"""What is wrong: in words, the requirement that it breaks, and those that it may break as well."""

_CELLS: dict[Situation, dict[str, type[_Defect]]] = {
    after_a_phase: {
        "starts_one_less_after_a_phase": LeavesOneOut,
        "connects_silently_after_a_phase": ConnectsSilently,
        "disconnects_silently_after_a_phase": DisconnectsSilently,
        "initialises_nothing_after_a_phase": InitialisesNothing,
        "configures_nothing_after_a_phase": ConfiguresNothing,
        "removes_silently_after_a_phase": RemovesSilently,
        "hides_the_container_after_a_phase": HidesTheContainer,
        "lists_one_less_after_a_phase": ListsOneLess,
        "adds_nothing_after_a_phase": RefusesToAdd,
        "disconnects_nothing_after_a_phase": RefusesToDisconnect,
        "finds_nothing_after_a_phase": FindsNoElements,
        "makes_no_containers_after_a_phase": MakesNoFirstContainer,
    },
    after_two_phases: {
        "stops_one_less_after_two_phases": StopsOneLess,
        "loses_a_connection_after_two_phases": LosesTheLastConnection,
    },
    after_a_refusal: {
        "adds_nothing_after_a_refusal": RefusesToAdd,
        "connects_nothing_after_a_refusal": RefusesToConnect,
        "disconnects_nothing_after_a_refusal": RefusesToDisconnect,
        "removes_nothing_after_a_refusal": RefusesToRemove,
        "starts_nothing_after_a_refusal": RefusesToStart,
        "starts_one_less_after_a_refusal": LeavesOneOut,
        "lists_one_less_after_a_refusal": ListsOneLess,
        "finds_nothing_after_a_refusal": FindsNoElements,
        "removes_silently_after_a_refusal": RemovesSilently,
        "connects_silently_after_a_refusal": ConnectsSilently,
        "loses_a_connection_after_a_refusal": LosesTheLastConnection,
        "makes_no_containers_after_a_refusal": MakesNoFirstContainer,
        "stops_in_order_after_a_refusal": StopsInOrder,
    },
    after_a_failure: {
        "adds_nothing_after_a_failure": RefusesToAdd,
        "connects_nothing_after_a_failure": RefusesToConnect,
        "removes_nothing_after_a_failure": RefusesToRemove,
        "lists_one_less_after_a_failure": ListsOneLess,
        "finds_nothing_after_a_failure": FindsNoElements,
        "configures_nothing_after_a_failure": ConfiguresNothing,
        "starts_one_less_after_a_failure": LeavesOneOut,
        "stops_one_less_after_a_failure": StopsOneLess,
        "removes_silently_after_a_failure": RemovesSilently,
        "disconnects_silently_after_a_failure": DisconnectsSilently,
        "hides_the_container_after_a_failure": HidesTheContainer,
    },
    after_a_removal: {
        "starts_one_less_after_a_removal": LeavesOneOut,
        "stops_one_less_after_a_removal": StopsOneLess,
        "stops_in_order_after_a_removal": StopsInOrder,
        "configures_nothing_after_a_removal": ConfiguresNothing,
        "connects_silently_after_a_removal": ConnectsSilently,
        "loses_a_connection_after_a_removal": LosesTheLastConnection,
        "hides_the_container_after_a_removal": HidesTheContainer,
        "removes_silently_after_a_removal": RemovesSilently,
        "starts_nothing_after_a_removal": RefusesToStart,
    },
    in_a_second_container: {
        "starts_one_less_in_a_second_container": LeavesOneOut,
        "stops_one_less_in_a_second_container": StopsOneLess,
        "stops_in_order_in_a_second_container": StopsInOrder,
        "connects_silently_in_a_second_container": ConnectsSilently,
        "disconnects_silently_in_a_second_container": DisconnectsSilently,
        "configures_nothing_in_a_second_container": ConfiguresNothing,
        "hides_the_container_in_a_second_container": HidesTheContainer,
        "loses_a_connection_in_a_second_container": LosesTheLastConnection,
        "lists_one_less_in_a_second_container": ListsOneLess,
        "finds_nothing_in_a_second_container": FindsNoElements,
        "removes_nothing_in_a_second_container": RefusesToRemove,
    },
    after_a_removed_container: {
        "makes_no_containers_after_a_removed_one": MakesNoContainers,
        "removes_no_second_container": RemovesNoContainers,
        "starts_one_less_after_a_removed_container": LeavesOneOut,
        "adds_nothing_after_a_removed_container": RefusesToAdd,
        "connects_nothing_after_a_removed_container": RefusesToConnect,
    },
    beside_a_running_container: {
        "starts_one_less_beside_a_running_container": LeavesOneOut,
        "stops_one_less_beside_a_running_container": StopsOneLess,
        "finds_nothing_beside_a_running_container": FindsNoElements,
        "shuts_others_down_beside_a_running_container": CallsAnother,
    },
    with_eight_members: {
        "stops_in_order_with_eight_members": StopsInOrder,
        "stops_one_less_with_eight_members": StopsOneLess,
        "lists_one_less_with_eight_members": ListsOneLess,
        "removes_silently_with_eight_members": RemovesSilently,
        "finds_nothing_with_eight_members": FindsNoElements,
    },
}
"""The cells that are mutants: since when × name × what is wrong."""

for _situation, _mutants in _CELLS.items():
    _since = _situation.__name__.replace("_", " ")
    for _name, _base in _mutants.items():
        _words, _requirement, _also = _WRONG[_base]
        _row = Row(_requirement, f"{_since.capitalize()}: {_words}.", _situation, _also)
        family(_base, "situation", {_name: _row}, clauses=CONTAINER)
