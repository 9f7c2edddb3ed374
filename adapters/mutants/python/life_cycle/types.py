"""Wrong frameworks that hand over, or bring back, what is not of the type that the interface declares (10.1, 11.2.1)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from ucm_cts.adapters.contract import programming_model as pm
from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.mutants.python.methods import alters, replaces
from ucm_cts.adapters.mutants.python.registry import Base, PeerProxy, Proxy, variant
from ucm_cts.adapters.reference.python.connectors import Link
from ucm_cts.adapters.reference.python.members import Connection, Failures, Member

WRONG: Any = 1
"""Stands for a value of any other type than the one that is due."""


@replaces("_disconnect", "R-11.2.1.3-06")
def numbers_what_it_disconnects(self: Base, connection: Connection, failures: Failures) -> None:
    """on_disconnect is given a number."""
    del self.manager.connections[connection.id]
    if isinstance(connection.client.body, pm.Connectable):
        failures.attempt(connection.client.body.on_disconnect, connection.id)


@replaces("_connect", "R-11.2.1.3-04")
def connects_bytes(self: Base, connection: Connection) -> None:
    """on_connect is given the name of the port element in bytes."""
    name: Any = connection.port.encode()
    if isinstance(connection.client.body, pm.Connectable):
        failures = Failures()
        failures.attempt(connection.client.body.on_connect, name, connection.target)
        failures.report()
    self.manager.connections[connection.id] = connection


@alters("_dependencies_of", "R-11.2.1.2-09")
def hands_over_single_references(
    _self: Base, given: list[pm.PortConnection], _member: Member
) -> list[pm.PortConnection]:
    """on_startup is given one reference where a list of references is due."""
    single: Any = pm.PortConnection
    return [single(d.from_port, d.to_port[0]) for d in given]


@alters("_dependencies_of", "R-11.2.1.2-09")
def hands_over_a_mapping(_self: Base, given: list[pm.PortConnection], _member: Member) -> Any:
    """on_startup is given a mapping from names to references."""
    return {d.from_port: d.to_port for d in given}


@replaces("_set_attributes", "R-11.2.1.2-05", also=("R-10.1.1-06",))
def sets_attributes_to_numbers(_self: Base, member: Member, attributes: Mapping[str, str]) -> None:
    """Attributes are set to the length of their values."""
    for name, value in attributes.items():
        length: Any = len(value)
        member.body.set_attribute(name, length)


@alters("exchange", "R-11.1.3-01", "R-11.1.2-02")
def brings_nothing_back(_self: PeerProxy, _result: int, _value: int) -> Any:
    """Calls between components return nothing."""
    return None


@replaces("exchange", "R-11.1.3-01", "R-11.1.2-02")
def sends_texts(self: PeerProxy, value: int) -> int:
    """A component that is sent an integer by another one receives a text."""
    text: Any = str(value)
    self.target.exchange(text)
    return ~value


@alters("exchange", "R-11.2.1.1-02")
def answers_texts(_self: Proxy, result: int, _value: int) -> Any:
    """Calls through references return texts."""
    return str(result)


class _Asking(pm.ContainerInterface):
    def __init__(self, container: Base) -> None:
        self.container = container

    def get_components(self) -> Any:
        return ["one of these"] if self.container.is_started else self.container.get_components()


@replaces("_configure", "R-11.2.1.4-03")
def lists_names_to_fragments(self: Base, member: Member, attributes: Mapping[str, str]) -> None:
    """A fragment that asks for the members gets texts."""
    self._set_attributes(member, attributes)
    if isinstance(member.body, pm.FragmentObject):
        member.body.set_container_interface(_Asking(self))
    self._initialise(member)


@alters("send", "R-10.1.2-02", "R-10.1.5.1-08", clauses=("10.1.2", "10.1.5"))
def brings_bare_values_back(_self: Link, _results: Sequence[Datum], _method: str, _arguments: Sequence[Datum]) -> Any:
    """Calls through connectors return a number where a list of values is due."""
    return WRONG


@replaces("_copied", "R-10.1.6.1-06", "R-10.1.5.1-08", clauses=("10.1.5", "10.1.6"), also=("R-10.1.5.1-01",))
def delivers_bare_values(_self: Link, values: Sequence[Datum]) -> Any:
    """Bodies get an object where a list of values is due."""
    return [object() for _ in values]


class _Name(str):
    __slots__ = ()


@variant
class hands_over_other_sequences(Base):
    """Names are of a kind of str of the framework's own, lists are tuples, and dependencies come from a generator."""

    def _dependencies_of(self, member: Member) -> Any:
        def given() -> Iterator[pm.PortConnection]:
            for one in super(hands_over_other_sequences, self)._dependencies_of(member):
                yield pm.PortConnection(_Name(one.from_port), list(one.to_port))

        return given()
