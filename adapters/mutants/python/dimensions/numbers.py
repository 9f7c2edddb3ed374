"""Numbers that are given out again after a removal, which the text permits, and what still clings to them (11.2.2.1)."""

from __future__ import annotations

from collections.abc import Mapping

from ucm_cts.adapters.contract.programming_model import PortConnection, PortElementObject
from ucm_cts.adapters.mutants.python.registry import breaks
from ucm_cts.adapters.mutants.python.variants.readings import reuses_ids
from ucm_cts.adapters.reference.python.members import Connection, Failures, Member


class _Remembers(reuses_ids):
    """Knows which numbers components of this container had that were removed."""

    def remove_component(self, comp_instance: int) -> None:
        member = self.members.get(comp_instance)
        super().remove_component(comp_instance)
        if member is not None:
            self.__dict__.setdefault("old", {})[comp_instance] = member

    def _predecessor(self, number: int) -> Member | None:
        found: Member | None = self.__dict__.get("old", {}).get(number)
        return found


@breaks("R-11.2.3-05", also=("R-11.2.1.2-01", "R-11.2.1.2-10"))
class initialises_each_number_once(_Remembers):
    """A component that gets the number of a removed one gets no on_init."""

    def _initialise(self, member: Member) -> None:
        if self._predecessor(member.id) is None:
            super()._initialise(member)


@breaks("R-11.2.2.1-11", also=("R-11.2.1.2-07", "R-11.2.3-03"))
class starts_each_number_once(_Remembers):
    """A component that has the number of a removed one is not started."""

    def _start_up(self, member: Member, failures: Failures) -> bool:
        return self._predecessor(member.id) is not None or super()._start_up(member, failures)


@breaks("R-11.2.1.2-06")
class announces_each_removal_once(_Remembers):
    """A component that has the number of a removed one gets no on_remove."""

    def _remove(self, member: Member, failures: Failures) -> None:
        if self._predecessor(member.id) is None:
            super()._remove(member, failures)
        else:
            del self.members[member.id]


@breaks("R-11.2.2.1-14", also=("R-11.2.1.4-03",))
class hides_numbers_that_were_used(_Remembers):
    """get_components does not list a component that has the number of a removed one."""

    def get_components(self) -> list[int]:
        return [number for number in super().get_components() if self._predecessor(number) is None]


@breaks("R-11.2.2.1-06", also=("R-11.2.1.2-07", "R-11.2.1.1-02", "R-11.2.2.1-07", "R-11.2.3-17", "R-11.2.1.2-09"))
class gives_elements_of_the_removed(_Remembers):
    """get_port_element gives that of the removed component that had the number before."""

    def get_port_element(self, comp_instance: int, port_name: str) -> PortElementObject:
        element = super().get_port_element(comp_instance, port_name)
        old = self._predecessor(comp_instance)
        return (old.body.get_portElement(port_name) if old is not None else None) or element


@breaks("R-11.2.1.2-05", also=("R-10.1.1-06", "R-11.2.3-19"))
class sets_attributes_of_the_predecessor(_Remembers):
    """A component that gets the number of a removed one gets its attributes, too."""

    def _set_attributes(self, member: Member, attributes: Mapping[str, str]) -> None:
        known = self.__dict__.setdefault("configured", {})
        super()._set_attributes(member, {**attributes, **known.get(member.id, {})})
        known[member.id] = attributes


@breaks(
    "R-11.2.1.3-01",
    also=("R-11.2.2.1-08", "R-11.2.1.1-01", "R-11.2.3-06", "R-11.2.3-08", "R-11.2.1.3-02", "R-12.10-24", "R-11.2.3-10"),
)
class counts_connections_of_the_predecessor(_Remembers):
    """A component that has the number of a removed one counts as connected where that one was."""

    def _is_connected(self, member: Member, port: str) -> bool:
        joined = self.manager.__dict__.get("joined", ())
        return super()._is_connected(member, port) or (
            self._predecessor(member.id) is not None and (member.id, port) in joined
        )

    def _connect(self, connection: Connection) -> None:
        super()._connect(connection)
        self.manager.__dict__.setdefault("joined", set()).add((connection.client.id, connection.port))


@breaks(
    "R-11.2.1.2-03", also=("R-11.2.1.2-09", "R-11.2.2.1-10", "R-11.2.3-10", "R-11.2.3-14", "R-11.1.3-01", "R-11.2.3-03")
)
class hands_over_what_the_predecessor_had(_Remembers):
    """on_startup gives a component the references that the last component with its number was given."""

    def _dependencies_of(self, member: Member) -> list[PortConnection]:
        known: dict[int, list[PortConnection]] = self.__dict__.setdefault("handed over", {})
        return known.setdefault(member.id, super()._dependencies_of(member))


@breaks("R-11.2.1.3-05")
class reports_the_end_of_each_number_once(reuses_ids):
    """A connection that has the number of one that was undone is undone without on_disconnect."""

    def _disconnect(self, connection: Connection, failures: Failures) -> None:
        undone = self.manager.__dict__.setdefault("undone", set())
        if connection.id in undone:
            del self.manager.connections[connection.id]
            return
        undone.add(connection.id)
        super()._disconnect(connection, failures)


@breaks("R-11.2.1.3-02")
class reports_each_number_once(reuses_ids):
    """A connection that has the number of one that was undone is made without on_connect."""

    def _connect(self, connection: Connection) -> None:
        made = self.manager.__dict__.setdefault("made", set())
        if connection.id in made:
            self.manager.connections[connection.id] = connection
            return
        made.add(connection.id)
        super()._connect(connection)
