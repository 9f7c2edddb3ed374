"""Undeclared extras: attributes, callbacks, dependencies, members, records and calls that nobody asked for."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from types import MappingProxyType

from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.programming_model import FragmentObject, PortConnection, PortElementObject, UcmError
from ucm_cts.adapters.contract.scenario import MESSAGE_CONNECTOR
from ucm_cts.adapters.mutants.python.methods import alters, replaces
from ucm_cts.adapters.mutants.python.registry import POLICIES, Base, breaks, is_below
from ucm_cts.adapters.reference.python.connectors import Link
from ucm_cts.adapters.reference.python.framework import Container, ContainerManager
from ucm_cts.adapters.reference.python.members import Connection, Failures, Member

# attributes

_EXTRA = "R-11.2.3-19"


class _SetsMore(Base):
    more: Mapping[str, str] = MappingProxyType({})

    def _set_attributes(self, member: Member, attributes: Mapping[str, str]) -> None:
        super()._set_attributes(member, self._with_more(member, attributes))

    def _with_more(self, member: Member, attributes: Mapping[str, str]) -> Mapping[str, str]:
        raise NotImplementedError


@replaces("_with_more", _EXTRA)
def sets_an_attribute_of_its_own(_self: _SetsMore, _member: Member, attributes: Mapping[str, str]) -> Mapping[str, str]:
    """Each body is given an attribute that it does not have."""
    return {**attributes, "container": "ucm"}


@replaces("_with_more", _EXTRA)
def sets_attributes_of_neighbours(self: _SetsMore, member: Member, attributes: Mapping[str, str]) -> Mapping[str, str]:
    """Each body is given the attributes that were configured for members before it, beside its own."""
    known: dict[str, str] = self.__dict__.setdefault("known", {})
    before = dict(known)
    known.update(attributes)
    return {**before, **attributes}


@replaces("_with_more", "R-11.2.1.2-05")
def sets_all_attributes_alike(_self: _SetsMore, _member: Member, attributes: Mapping[str, str]) -> Mapping[str, str]:
    """All attributes of a component get the value of the last one."""
    last = list(attributes.values())[-1:]
    return {name: last[0] for name in attributes}


@replaces("_with_more", _EXTRA)
def gives_later_instances_a_number(self: _SetsMore, member: Member, attributes: Mapping[str, str]) -> Mapping[str, str]:
    """The second instance of an implementation is given an attribute that it does not have."""
    known: list[str] = self.__dict__.setdefault("known", [])
    known.append(member.implementation.name)
    number = known.count(member.implementation.name)
    return attributes if number == 1 else {**attributes, "instance": str(number)}


# callbacks


@breaks("R-12.10-04", also=("R-11.2.2.1-01", "R-11.1.3-02", "R-12.10-22"))
class shows_everybody_the_container(Base):
    """set_container_interface is called on components, too, and its failure leaves add_component."""

    def add_component(self, implementation: str, attributes: Mapping[str, str]) -> int:
        identifier = super().add_component(implementation, attributes)
        body = self.members[identifier].body
        if not isinstance(body, FragmentObject):
            body.set_container_interface(self)  # type: ignore[attr-defined]
        return identifier


@breaks("R-12.10-07", also=("R-11.2.1.3-01",))
class tells_everybody_of_connections(Base):
    """on_connect is called on bodies that do not have it, and its failure leaves connect."""

    def connect(self, instance: int, port_name: str, to_port: PortElementObject | None) -> int:
        identifier = super().connect(instance, port_name, to_port)
        body = self.members[instance].body
        if not self.members[instance].implementation.connectable:
            body.on_connect(port_name, to_port)  # type: ignore[attr-defined]
        return identifier


@breaks("R-11.2.1.3-03", also=("R-11.2.1.3-04",))
class tells_of_all_ports(Base):
    """on_connect is called for all required port elements when the first one is connected."""

    def _connect(self, connection: Connection) -> None:
        super()._connect(connection)
        member = connection.client
        for port in member.implementation.requires if member.implementation.connectable else ():
            if port != connection.port and not self._is_connected(member, port):
                Failures().attempt(member.body.on_connect, port, None)  # type: ignore[attr-defined]


@breaks("R-11.2.1.3-05")
class tells_of_disconnections_that_were_not(Base):
    """A component that is removed gets on_disconnect for required port elements that were not connected."""

    def _remove(self, member: Member, failures: Failures) -> None:
        for port in member.implementation.requires if member.implementation.connectable else ():
            Failures().attempt(member.body.on_disconnect, port)  # type: ignore[attr-defined]
        super()._remove(member, failures)


@breaks("R-11.2.1.3-05")
class tells_of_disconnections_at_stop(Base):
    """Members of sub-containers get on_disconnect at stop; their connections stand."""

    def stop(self) -> None:
        for member in self.started if is_below(self) else ():
            for connection in self._connections_from(member):
                if member.implementation.connectable:
                    Failures().attempt(member.body.on_disconnect, connection.port)  # type: ignore[attr-defined]
        super().stop()


@breaks("R-11.2.1.2-08", also=("R-11.2.1.3-03",))
class tells_of_connections_at_restart(Base):
    """Members get on_connect again when their container is started again."""

    def start(self) -> None:
        again = self.__dict__.get("started before") and not self.is_started
        for connection in self._connections_of_members() if again else ():
            if connection.client.container is self and connection.client.implementation.connectable:
                body = connection.client.body
                Failures().attempt(body.on_connect, connection.port, connection.target)  # type: ignore[attr-defined]
        super().start()
        self.__dict__["started before"] = True


@breaks("R-11.2.1.4-02")
class shows_the_container_at_each_start(Base):
    """Fragments get set_container_interface again at each start."""

    def _start_up(self, member: Member, failures: Failures) -> bool:
        if isinstance(member.body, FragmentObject):
            member.body.set_container_interface(self)
        return super()._start_up(member, failures)


@breaks("R-11.2.1.2-10")
class shuts_down_what_it_removes(Base):
    """A component that is removed gets on_shutdown if it has been started before, although it is stopped."""

    def _start_up(self, member: Member, failures: Failures) -> bool:
        member.__dict__["was started"] = True
        return super()._start_up(member, failures)

    def _remove(self, member: Member, failures: Failures) -> None:
        if member.__dict__.get("was started"):
            Failures().attempt(member.body.on_shutdown)
        super()._remove(member, failures)


# dependencies


@alters("_dependencies_of", "R-11.2.1.2-09", also=("R-11.2.3-10",))
def hands_over_itself(_self: Base, given: list[PortConnection], member: Member) -> list[PortConnection]:
    """Each body is given its own provided port elements among its dependencies."""
    return [*given, *(PortConnection(p, (member.body.get_portElement(p),)) for p in member.implementation.provides)]


@alters("_dependencies_of", "R-11.2.1.2-09", also=("R-11.2.3-10",))
def hands_over_a_container(_self: Base, given: list[PortConnection], member: Member) -> list[PortConnection]:
    """Each fragment is given a dependency without references, which it does not require."""
    return [*given, PortConnection("container", ())] if isinstance(member.body, FragmentObject) else given


@replaces("_dependencies_of", "R-11.2.1.2-09", also=("R-11.2.3-10", "R-12.10-25", "R-11.2.1.2-03", "R-11.1.3-01"))
def hands_over_dependencies_of_neighbours(self: Base, member: Member) -> list[PortConnection]:
    """Each body is given its neighbours' connections, too, if whom they lead to calls nobody itself."""
    given = Base._dependencies_of(self, member)
    silent = [m for m in self.members.values() if not Base._connections_from(self, m)]  # else calls would go in circles
    others = [c for m in silent for c in Base._connections_to(self, m) if c.client is not member]
    return [*given, *(PortConnection(c.port, (c.target,)) for c in others)]


@replaces("_dependencies_of", "R-12.10-25", also=("R-11.2.1.2-09", "R-11.2.1.2-03", "R-11.2.3-10"))
def hands_over_all_references_everywhere(self: Base, member: Member) -> list[PortConnection]:
    """A body with two connected ports gets both references at each of them."""
    given = Base._dependencies_of(self, member)
    everything = tuple(t for d in given for t in d.to_port)
    return [PortConnection(d.from_port, everything) for d in given]


@replaces("_dependencies_of", "R-12.10-25", also=("R-11.2.3-10", "R-11.2.1.2-09"))
def hands_over_one_more_each_time(self: Base, member: Member) -> list[PortConnection]:
    """At each further start a body gets each reference once more."""
    member.__dict__["times"] = member.__dict__.get("times", 0) + 1
    given = Base._dependencies_of(self, member)
    return [PortConnection(d.from_port, tuple(d.to_port) * int(member.__dict__["times"])) for d in given]


# members and bodies


@alters("get_components", "R-11.2.2.1-14", also=("R-11.2.1.4-03", "R-12.10-22"))
def lists_members_of_other_containers(self: Base, listed: list[int]) -> list[int]:
    """get_components of a sub-container lists the members of other sub-containers, too."""
    others = [c for c in self.manager.sub_containers if c is not self] if is_below(self) else []
    return [*listed, *(number for other in others for number in other.members)]


@alters("get_components", "R-11.2.2.1-14", also=("R-11.2.1.4-03", "R-12.10-22"))
def lists_members_twice(_self: Base, listed: list[int]) -> list[int]:
    """get_components lists the first of several members twice."""
    return [*listed, listed[0]] if len(listed) > 1 else listed


@replaces("_instantiate", "R-11.2.2.1-02", also=("R-11.2.3-05", "R-11.2.1.2-05"))
def makes_a_spare_body_each_time(self: Base, implementation: object) -> object:
    """The second instance of an implementation has a spare body, which is initialised, too."""
    made = self.__dict__.setdefault("made", set())
    name = implementation.name  # type: ignore[attr-defined]
    if name in made:
        with suppress(Exception):
            implementation.create().on_init()  # type: ignore[attr-defined]
    made.add(name)
    return Container._instantiate(self, implementation)  # type: ignore[arg-type]


@breaks("R-11.2.1.2-01", also=("R-11.2.1.2-06", "R-11.2.1.2-10"))
class calls_the_dead_at_stop(Base):
    """stop calls on_shutdown of components that were removed since the last start."""

    def _remove(self, member: Member, failures: Failures) -> None:
        super()._remove(member, failures)
        self.__dict__.setdefault("dead", []).append(member)

    def stop(self) -> None:
        super().stop()
        for member in self.__dict__.pop("dead", ()):
            Failures().attempt(member.body.on_shutdown)


# calls, messages and records


@breaks("R-11.2.3-17", also=("R-11.2.1.1-02", "R-11.2.3-02", "R-11.1.3-01"))
class tries_every_port_after_the_stop(Base):
    """When the next operation begins after a stop, each provided port element is called once, to see whether it still works."""

    def stop(self) -> None:
        stopped = list(self.started)
        super().stop()
        self.__dict__["stopped"] = stopped

    @contextmanager
    def _operation(self) -> Iterator[None]:
        with super()._operation():
            for member in self.__dict__.pop("stopped", ()):
                for port in member.implementation.provides:
                    with suppress(Exception):
                        member.body.get_portElement(port).exchange(0)
            yield


class _Greets(Link):
    def _post(self, taker: object, method: str, arguments: list[Datum]) -> None:
        if self.__dict__.setdefault("first", arguments) is arguments:
            super()._post(taker, method, self._copied(arguments))  # type: ignore[arg-type]
        super()._post(taker, method, arguments)  # type: ignore[arg-type]


@breaks("R-10.1.6.1-05", clauses=("10.1.6",))
class sends_the_first_message_twice(_Greets):
    """The first message of a connection comes twice."""


@replaces("_request", "R-10.1.5.1-01", clauses=("10.1.5",))
def asks_servers_before_the_first_call(self: Link, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
    """The first call of a connection is carried out twice."""
    if self.connector != MESSAGE_CONNECTOR and not self.__dict__.get("asked"):
        self.__dict__["asked"] = True
        with suppress(Exception):
            Link._request(self, method, arguments)
    return Link._request(self, method, arguments)


@breaks("R-10.1.4.2-32", clauses=("10.1.4",), also=("R-10.1.4.2-26", "R-10.1.4.2-33"))
class log_tells_of_look_ups(Base):
    """get_port_element of a traced port leaves a record that names its methods."""

    def get_port_element(self, comp_instance: int, port_name: str) -> PortElementObject:
        element = super().get_port_element(comp_instance, port_name)
        for policy in self._port_traces(self.members[comp_instance], port_name):
            self._write((policy.parameters["log_severity"], f"looked up: {policy.parameters['methods_to_trace']}"))
        return element


@breaks("R-10.1.5.1-01", clauses=POLICIES, also=("R-10.1.3.2-15", "R-10.1.3.2-14", "R-11.2.1.1-02", "R-11.1.3-01"))
class runs_protected_calls_again(Base):
    """A call of a protected component that raised is carried out once more."""

    def _execute_alone(self, member: Member, port: str | None, work):  # type: ignore[no-untyped-def]
        try:
            return super()._execute_alone(member, port, work)
        except Exception:
            if port is None:
                raise
            return super()._execute_alone(member, port, work)


@breaks("R-11.2.2.2-06")
class refuses_to_end_with_two_containers(Base):
    """destroy is refused while there are two sub-containers or more."""

    def destroy(self) -> None:
        if len(self.manager.sub_containers) > 1:
            raise UcmError("not empty")
        ContainerManager.destroy(self.manager)
