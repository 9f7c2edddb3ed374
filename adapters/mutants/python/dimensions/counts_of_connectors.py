"""Frameworks that can count to some number only: self-executing components, clients, receivers, messages, records."""

from __future__ import annotations

from collections.abc import Sequence

from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.programming_model import (
    UcmError,
)
from ucm_cts.adapters.contract.scenario import MESSAGE_CONNECTOR, SELF_EXECUTING
from ucm_cts.adapters.mutants.python.methods import does_only_if, refuses_if, replaces
from ucm_cts.adapters.mutants.python.registry import (
    POLICIES,
    Base,
    breaks,
    container_of,
)
from ucm_cts.adapters.reference.python.connectors import Link, Taker
from ucm_cts.adapters.reference.python.members import Member

# policies and connectors


@replaces("_begin_execution", "R-10.1.3.2-01", clauses=POLICIES, also=("R-10.1.3.2-03",))
def runs_one_component_of_a_container(self: Base, member: Member) -> None:
    """Of several self-executing components of a container the first runs only."""
    others = [m for m in self.started if m.execution.definition == SELF_EXECUTING]
    if not others or others[0] is member:
        Base._begin_execution(self, member)


@replaces(
    "_begin_execution",
    "R-10.1.3.2-01",
    clauses=POLICIES,
    readings={"run-trigger": "repeated"},
    also=("R-10.1.3.2-03",),
)
def runs_two_phases(self: Base, member: Member) -> None:
    """A self-executing component runs in the first two phases only."""
    member.__dict__["phases"] = member.__dict__.get("phases", 0) + 1
    if member.__dict__["phases"] <= 2:
        Base._begin_execution(self, member)


@refuses_if("_attach_sender", "R-10.1.5.1-03", clauses=("10.1.5",), also=("R-10.1.5.1-01",))
def takes_seven_clients(self: Link, *_: object) -> bool:
    """The eighth client of a server is refused."""
    self.__dict__["clients"] = self.__dict__.get("clients", 0) + (self.connector != MESSAGE_CONNECTOR)
    return bool(self.__dict__["clients"] > 7)


@refuses_if("_attach_sender", "R-10.1.6.1-03", clauses=("10.1.6",), also=("R-10.1.6.1-10",))
def takes_seven_emitters(self: Link, *_: object) -> bool:
    """The eighth emitter of a connection is refused."""
    self.__dict__["emitters"] = self.__dict__.get("emitters", 0) + (self.connector == MESSAGE_CONNECTOR)
    return bool(self.__dict__["emitters"] > 7)


@replaces("_emit", "R-10.1.6.1-04", clauses=("10.1.6",))
def reaches_seven_receivers(self: Link, method: str, arguments: Sequence[Datum]) -> str:
    """The eighth receiver of a connection gets no messages, and push returns ok."""
    takers = self.takers
    self.takers = takers[:7]
    try:
        return Link._emit(self, method, arguments)
    finally:
        self.takers = takers


@replaces("_emit", "R-10.1.6.1-04", clauses=("10.1.6",), also=("R-10.1.6.1-08",))
def reaches_two_receivers(self: Link, method: str, arguments: Sequence[Datum]) -> str:
    """The third receiver of a connection gets no messages, and push returns ok."""
    takers = self.takers
    self.takers = takers[:2]
    try:
        return Link._emit(self, method, arguments)
    finally:
        self.takers = takers


@replaces("_request", "R-10.1.5.1-01", clauses=("10.1.5",), also=("R-10.1.5.1-03",))
def serves_255_calls(self: Link, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
    """Each 256th call of a connection is refused."""
    self.__dict__["served"] = self.__dict__.get("served", 0) + 1
    if self.__dict__["served"] % 256 == 0:
        raise UcmError("busy")
    return Link._request(self, method, arguments)


@does_only_if("_write", "R-10.1.4.2-26", clauses=("10.1.4",), also=("R-10.1.4.2-32",))
def log_holds_255_records(self: Base, _record: tuple[str, str]) -> bool:
    """The log holds 255 records; those that follow are lost."""
    return len(self.manager.log) < 255


@does_only_if("_post", "R-10.1.2-10", clauses=("10.1.2",), also=("R-10.1.6.1-04", "R-10.1.6.1-08"))
def holds_255_messages(_self: Link, taker: Taker, *_: object) -> bool:
    """If 255 messages wait for a receiver, further ones are lost, and push returns ok."""
    return taker.messages.qsize() < 255


@refuses_if("link", "R-10.1.5.1-13", clauses=("10.1.5",), also=("R-10.1.6.1-20", "R-10.1.5.1-01", "R-10.1.6.1-10"))
def makes_three_connectors(self: Base, *_: object) -> bool:
    """A runtime makes three connections with connectors and no more."""
    return len(self.manager.links) >= 3


@breaks("R-10.1.5.1-01", clauses=("10.1.5",), also=("R-10.1.5.1-03", "R-10.1.5.1-09"))
class serves_one_port_of_a_component(Link):
    """Of several services of one component the first only can be called."""

    def _request(self, method: str, arguments: Sequence[Datum]) -> Sequence[Datum]:
        taker = self.takers[0] if self.takers else None
        if taker is not None and container_of(taker.member)._takers_of(taker.member)[0][1] is not taker:
            raise UcmError("no such service")
        return super()._request(method, arguments)
