"""What was given out long ago: ids, connections, references and containers after removal, restart and replacement."""

from __future__ import annotations

from ucm_cts.adapters.contract.programming_model import (
    NotFound,
    PortConnection,
    PortElementObject,
    UcmError,
)
from ucm_cts.adapters.mutants.python.methods import replaces
from ucm_cts.adapters.mutants.python.registry import (
    Base,
    GivesOutProxies,
    HandsOverProxies,
    Proxy,
    breaks,
    is_below,
)
from ucm_cts.adapters.mutants.python.variants.readings import LeadsNowhere, cascades
from ucm_cts.adapters.reference.python.framework import Container, ContainerManager
from ucm_cts.adapters.reference.python.members import Connection, Failures, Member

# ids of components


class _KnowsSuccessors(Base):
    """Knows which component of the same implementation came after one that was removed."""

    def remove_component(self, comp_instance: int) -> None:
        member = self.members.get(comp_instance)
        super().remove_component(comp_instance)
        if member is not None:
            self.__dict__.setdefault("gone", {})[comp_instance] = member.implementation.name

    def _successor(self, number: int) -> int:
        name = self.__dict__.get("gone", {}).get(number)
        heirs = [m.id for m in self.members.values() if m.implementation.name == name and m.id > number]
        return heirs[-1] if heirs and number not in self.members else number


@breaks("R-12.10-15", also=("R-11.2.1.2-06", "R-11.2.2.1-14"))
class removes_the_successor(_KnowsSuccessors):
    """remove_component of a removed component removes the one of that implementation that was added later."""

    def remove_component(self, comp_instance: int) -> None:
        super().remove_component(self._successor(comp_instance))


@breaks("R-12.10-15")
class gives_elements_of_the_successor(_KnowsSuccessors):
    """get_port_element of a removed component gives that of the one of its implementation that was added later."""

    def get_port_element(self, comp_instance: int, port_name: str) -> PortElementObject:
        return super().get_port_element(self._successor(comp_instance), port_name)


@breaks("R-12.10-15")
class connects_the_successor(_KnowsSuccessors):
    """connect of a removed component connects the one of its implementation that was added later."""

    def connect(self, instance: int, port_name: str, to_port: PortElementObject | None) -> int:
        return super().connect(self._successor(instance), port_name, to_port)


@breaks("R-12.10-15", also=("R-11.2.1.2-06",))
class removes_twice_after_a_restart(Base):
    """A component that was removed after the container had been started twice can be removed again."""

    def start(self) -> None:
        self.__dict__["starts"] = self.__dict__.get("starts", 0) + (not self.is_started)
        super().start()

    def remove_component(self, comp_instance: int) -> None:
        if comp_instance in self.__dict__.get("gone", ()):
            return
        super().remove_component(comp_instance)
        if self.__dict__.get("starts", 0) > 1:
            self.__dict__.setdefault("gone", set()).add(comp_instance)


@breaks("R-12.10-15")
class answers_for_members_of_removed_containers(Base):
    """The manager gives port elements of members of sub-containers that have been removed."""

    def remove_container(self, sub_container: Container | None) -> None:
        members = dict(sub_container.members) if sub_container is not None else {}
        ContainerManager.remove_container(self.manager, sub_container)
        self.__dict__.setdefault("gone", {}).update(members)

    def get_port_element(self, comp_instance: int, port_name: str) -> PortElementObject:
        gone: Member | None = self.__dict__.get("gone", {}).get(comp_instance)
        element = gone.body.get_portElement(port_name) if gone is not None else None
        return element if element is not None else super().get_port_element(comp_instance, port_name)


# ids of connections


@breaks("R-12.10-16", also=("R-11.2.1.3-05", "R-11.2.3-06"))
class undoes_the_successor(Base):
    """disconnect of a connection already undone undoes the one that took its place."""

    def disconnect(self, connection: int) -> None:
        places = self.__dict__.setdefault("places", {})
        found = self.manager.connections.get(connection)
        if found is not None:
            places[connection] = (found.client.id, found.port)
        elif connection in places:
            heirs = [c.id for c in self.manager.connections.values() if (c.client.id, c.port) == places[connection]]
            connection = heirs[0] if heirs else connection
        super().disconnect(connection)


@breaks("R-12.10-16")
class undoes_twice_after_a_restart(Base):
    """A connection that was undone after a phase can be undone again."""

    def stop(self) -> None:
        self.__dict__["stopped"] = self.__dict__.get("stopped") or self.is_started
        super().stop()

    def disconnect(self, connection: int) -> None:
        if connection in self.__dict__.get("gone", ()):
            return
        super().disconnect(connection)
        if self.__dict__.get("stopped"):
            self.__dict__.setdefault("gone", set()).add(connection)


@breaks("R-11.2.2.1-10", also=("R-12.10-16",))
class forgets_old_connection_ids(Base):
    """A connection that has lasted two phases cannot be undone: its number is NOT_FOUND."""

    def stop(self) -> None:
        for connection in self._connections_of_members() if self.is_started else ():
            ages = self.manager.__dict__.setdefault("ages", {})
            ages[connection.id] = ages.get(connection.id, 0) + 1
        super().stop()

    def disconnect(self, connection: int) -> None:
        if self.manager.__dict__.get("ages", {}).get(connection, 0) > 1:
            raise NotFound("expired")
        super().disconnect(connection)


# what removal leaves behind


@breaks("R-11.2.2.1-05", also=("R-11.2.3-11",))
class servers_stay_in_use(Base):
    """A component that had a client in an earlier phase cannot be removed, though it is not connected."""

    def stop(self) -> None:
        for member in self.members.values() if self.is_started else ():
            member.__dict__["was used"] = bool(self._connections_to(member))
        super().stop()

    def _check_removable(self, member: Member) -> None:
        super()._check_removable(member)
        if member.__dict__.get("was used") and not self._connections_to(member):
            raise UcmError("in use")


@breaks("R-11.2.2.1-05", also=("R-11.2.3-11",))
class servers_of_removed_clients_stay_in_use(Base):
    """A component whose client was removed with its connection cannot be removed."""

    def _remove(self, member: Member, failures: Failures) -> None:
        super()._remove(member, failures)
        self.__dict__.setdefault("served", []).extend(member.__dict__.get("targets", ()))

    def _disconnect(self, connection: Connection, failures: Failures) -> None:
        super()._disconnect(connection, failures)
        connection.client.__dict__.setdefault("targets", []).append(connection.target)

    def _check_removable(self, member: Member) -> None:
        super()._check_removable(member)
        own = [self._reference_to(member, port) for port in member.implementation.provides]
        if any(element is target for element in own for target in self.__dict__.get("served", ())):
            raise UcmError("in use")


@breaks("R-12.10-25", also=("R-11.2.1.2-09", "R-11.2.3-07", "R-11.2.3-14", "R-11.2.3-06"))
class successors_inherit_connections(Base):
    """A component gets the connections of a removed one of its implementation at start, beside its own."""

    def remove_component(self, comp_instance: int) -> None:
        member = self.members.get(comp_instance)
        old = self._connections_from(member) if member is not None else []
        super().remove_component(comp_instance)
        if member is not None and old:
            self.__dict__.setdefault("left", {})[member.implementation.name] = old

    def _dependencies_of(self, member: Member) -> list[PortConnection]:
        given = super()._dependencies_of(member)
        left = self.__dict__.get("left", {}).get(member.implementation.name, [])
        return [*given, *(PortConnection(c.port, (c.target,)) for c in left)]


@breaks("R-11.2.3-06", also=("R-11.2.3-10", "R-11.2.3-08"))
class gaps_prevent_the_start(Base):
    """A container in which a member before others was removed cannot be started."""

    def _remove(self, member: Member, failures: Failures) -> None:
        later = any(number > member.id for number in self.members)
        super()._remove(member, failures)
        self.__dict__["has gap"] = self.__dict__.get("has gap") or later

    def _check_startable(self) -> None:
        super()._check_startable()
        if self.__dict__.get("has gap") and self.members:
            raise UcmError("a member is missing")


@breaks("R-11.2.2.1-06", also=("R-11.2.1.1-02", "R-11.2.1.2-07", "R-11.1.3-01"))
class serves_elements_of_the_predecessor(Base):
    """After a replacement get_port_element gives the port element of the removed component of that implementation."""

    def get_port_element(self, comp_instance: int, port_name: str) -> PortElementObject:
        element = super().get_port_element(comp_instance, port_name)
        name = self.members[comp_instance].implementation.name
        return self.__dict__.get("gone", {}).get((name, port_name), element)  # type: ignore[no-any-return]

    def _remove(self, member: Member, failures: Failures) -> None:
        for port in member.implementation.provides:
            self.__dict__.setdefault("gone", {})[member.implementation.name, port] = member.body.get_portElement(port)
        super()._remove(member, failures)


@breaks(
    "R-11.2.3-14",
    also=("R-11.2.1.2-03", "R-11.2.1.2-09", "R-11.2.1.3-04", "R-11.2.3-10", "R-11.2.2.1-10", "R-11.1.3-01"),
)
class reconnects_to_the_predecessor(Base):
    """A port that is connected again is connected to what it was connected to first."""

    def _connect_to(self, member: Member, port: str, target: PortElementObject) -> int:
        identifier = super()._connect_to(member, port, target)
        first = member.__dict__.setdefault(f"first target of {port}", target)
        self.manager.connections[identifier] = Connection(identifier, member, port, first)
        return identifier


# proxies of what is gone


class _HandsOverProxies(HandsOverProxies):
    def _dependencies_of(self, member: Member) -> list[PortConnection]:
        given = super()._dependencies_of(member)
        given += [PortConnection(port, (LeadsNowhere(),)) for port in self._lost(member)]
        return given

    def _check_startable(self) -> None:
        for member in self.members.values():
            lost = self._lost(member)
            for port in member.implementation.requires:
                if port not in lost and not self._is_connected(member, port):
                    raise UcmError(f"{port!r} of component {member.id} is not connected")

    def _lost(self, member: Member) -> dict[str, PortElementObject]:
        """What is still handed over although its connection has gone, by port."""
        lost = member.__dict__.get("lost", {})
        return {port: target for port, target in lost.items() if not self._is_connected(member, port)}


@breaks("R-11.2.3-14")
class proxies_outlive_the_container_behind_them(_HandsOverProxies):
    """Components are given proxies; those that lead to a container which has been removed are handed over again, and refuse calls."""

    def _disconnect(self, connection: Connection, failures: Failures) -> None:
        super()._disconnect(connection, failures)
        if is_below(self) and connection.client.container is not self:
            connection.client.__dict__.setdefault("lost", {})[connection.port] = connection.target


_CASCADES = {"remove-while-ready": "cascade", "remove-provider-in-use": "cascade"}


class _OutlivesProviders(_HandsOverProxies, cascades):
    def remove_component(self, comp_instance: int) -> None:
        member = self.members.get(comp_instance)
        found = self._connections_to(member) if member is not None else []
        super().remove_component(comp_instance)
        for connection in found:
            if self._outlives(connection):
                connection.client.__dict__.setdefault("lost", {})[connection.port] = connection.target

    def _outlives(self, connection: Connection) -> bool:
        raise NotImplementedError


@breaks("R-11.2.3-14", readings=_CASCADES)
class proxies_outlive_the_provider(_OutlivesProviders):
    """Components are given proxies; one that leads to a component of their own container is handed over after its removal, too."""

    def _outlives(self, connection: Connection) -> bool:
        return connection.client.container is self


@breaks("R-11.2.3-14", readings=_CASCADES)
class proxies_outlive_the_provider_across(_OutlivesProviders):
    """Components are given proxies; one that leads to a component of another container is handed over after its removal, too."""

    def _outlives(self, connection: Connection) -> bool:
        return connection.client.container is not self


@breaks("R-11.2.2.1-10")
class proxies_outlive_connections_across(_HandsOverProxies):
    """Components are given proxies; one of a connection to another container is handed over after that was undone, too."""

    def disconnect(self, connection: int) -> None:
        found = self.manager.connections.get(connection)
        super().disconnect(connection)
        own = [self._reference_to(m, port) for m in self.members.values() for port in m.implementation.provides]
        if found is not None and not any(found.target is element for element in own):
            found.client.__dict__.setdefault("lost", {})[found.port] = found.target


# references


class _Mortal(Proxy):
    born = 0

    def exchange(self, value: int) -> int:
        if self._is_dead():
            raise UcmError("the reference has expired")
        return super().exchange(value)

    def _is_dead(self) -> bool:
        raise NotImplementedError


class _CountsStarts(GivesOutProxies):
    def start(self) -> None:
        fresh = not self.is_started
        super().start()
        self.__dict__["starts"] = self.__dict__.get("starts", 0) + fresh

    def get_port_element(self, comp_instance: int, port_name: str) -> PortElementObject:
        element = super().get_port_element(comp_instance, port_name)
        element.__dict__["born"] = self.__dict__.get("starts", 0)
        return element


class _DiesAtRestart(_Mortal):
    def _is_dead(self) -> bool:
        return int(self.member.container.__dict__.get("starts", 0)) > self.born + 1


@breaks("R-11.2.1.2-07", also=("R-11.2.1.1-02", "R-11.2.3-03", "R-11.1.3-01"))
class references_die_at_restart(_CountsStarts):
    """A reference of get_port_element serves one phase; after a restart its calls are refused."""

    proxy = _DiesAtRestart


class _DiesIfEarly(_Mortal):
    def _is_dead(self) -> bool:
        return self.born == 0 and is_below(self.member.container)


@breaks("R-11.2.1.2-07", also=("R-11.2.1.1-02", "R-11.2.3-03", "R-11.1.3-01"))
class references_from_configuration_are_dead_below(_CountsStarts):
    """References that were obtained before the first start of a sub-container refuse every call."""

    proxy = _DiesIfEarly


class _DiesWithNeighbours(_Mortal):
    def _is_dead(self) -> bool:
        return bool(self.member.container.__dict__.get("has removed"))


@breaks("R-11.2.1.2-07", also=("R-11.2.1.1-02", "R-11.2.3-03", "R-11.1.3-01"))
class references_die_with_a_neighbour(GivesOutProxies):
    """Once a component was removed, the references of its neighbours refuse every call."""

    proxy = _DiesWithNeighbours

    def _remove(self, member: Member, failures: Failures) -> None:
        super()._remove(member, failures)
        self.__dict__["has removed"] = True


class _Given(Proxy):
    def exchange(self, value: int) -> int:
        if self.member.__dict__.get("lives") != self.__dict__["life"]:
            raise UcmError("the reference is of another phase")
        return super().exchange(value)


@replaces("_dependencies_of", "R-11.2.3-03", also=("R-11.1.3-01", "R-11.1.2-02"))
def serves_bodies_in_the_first_two_phases(self: Base, member: Member) -> list[PortConnection]:
    """References that a body gets at its third start refuse every call."""
    member.__dict__["lives"] = member.__dict__.get("lives", 0) + 1
    given = []
    for connection in Base._dependencies_of(self, member):
        proxies = [_Given(target, member) for target in connection.to_port if target]
        for proxy in proxies:
            proxy.__dict__["life"] = min(member.__dict__["lives"], 2)
        given.append(PortConnection(connection.from_port, tuple(proxies)))
    return given
