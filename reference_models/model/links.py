"""Connections with connectors and their ends, as they are made, broken and undone (10.1.5, 10.1.6, 10.4)."""

from __future__ import annotations

from dataclasses import dataclass, field

from ucm_cts.adapters.contract.platform_interfaces import CONNECTOR_PORTS, PARAMETERS, ConnectorPort, Element
from ucm_cts.adapters.contract.scenario import Declaration
from ucm_cts.reference_models.model.runtime import Connection, Member

SENDERS = ("client", "emitter")
"""The roles of ends that call or push."""

TAKERS = ("server", "receiver")
"""The roles of ends that are called or pushed to."""


@dataclass(slots=True, eq=False)
class End:
    """A port element attached to a link.

    ``port``: the port element, by itself or as one of a port of 10.4.
    ``since``, ``until``: the ``n`` of the events that attached and detached it.
    ``connection``: only of required port elements.
    ``of``: the port that was attached, if it is one of 10.4.
    """

    role: str
    member: Member
    port: str
    since: int
    until: int | None = None
    connection: Connection | None = None
    of: str = ""

    @property
    def kind(self) -> ConnectorPort | None:
        """The connector port of 10.4 that it belongs to."""
        return CONNECTOR_PORTS.get(self.role)

    @property
    def side(self) -> str:
        """Its side of a connection of 10.4; empty for others."""
        kind = self.kind
        return kind.side if kind is not None else ""

    def is_of_port(self, other: End) -> bool:
        """Do both belong to one port of one component?"""
        return self.member is other.member and self.of == other.of

    @property
    def is_synchronous(self) -> bool:
        """Does a port with one element only take part in request-response?"""
        kind = self.kind
        return kind is not None and len(kind.elements) == 1


@dataclass(slots=True, eq=False)
class LinkState:
    """A connection with a connector.

    ``broken``, ``broken_at``: where it is broken now, and since when (``t``).
    ``was_broken``, ``mended_at``: where it was broken, and when that was mended last (``t``).
    """

    name: str
    connector: str
    interface: str
    ends: list[End] = field(default_factory=list)
    broken: str = ""
    broken_at: int = 0
    was_broken: str = ""
    mended_at: int = 0

    def label(self, end: End) -> str:
        """What findings call ``end``: its component, and its port if that has several here."""
        ports = {other.of for other in self.ends if other.member is end.member}
        return f"{end.member.lane}.{end.of}" if len(ports) > 1 else end.member.lane

    def live(self, *roles: str) -> list[End]:
        """The ends of these roles that are attached now."""
        return [end for end in self.ends if end.until is None and end.role in roles and not end.member.gone]

    @property
    def is_extended(self) -> bool:
        """Is its connector one of 10.4?"""
        return self.connector in PARAMETERS

    @property
    def senders(self) -> list[End]:
        """The required port elements that are attached now."""
        return [e for e in self.ends if e.until is None and e.connection is not None and not e.member.gone]

    @property
    def takers(self) -> list[End]:
        """The provided port elements that are attached now."""
        return [e for e in self.ends if e.until is None and e.connection is None and not e.member.gone]

    def across(self, end: End) -> list[End]:
        """The ends that calls through ``end`` may come to: of connections of 10.4 those of another side."""
        return [taker for taker in self.takers if not self.is_extended or taker.side != end.side]

    @property
    def has_lost_an_end(self) -> bool:
        """Was a component removed that was still attached?"""
        return any(end.until is None and end.member.gone for end in self.ends)

    @property
    def is_proper(self) -> bool:
        """Has it both sides, no second server, and ends of its interface only? Clients without server are not connected, and
        that is all.
        """
        if self.is_extended:
            sides = [end.side for end in (*self.senders, *self.takers)]
            servers = {(id(e.member), e.of) for e in (*self.senders, *self.takers) if e.side == "server"}
            return len(set(sides)) == 2 and len(servers) < 2
        whole = bool(self.live(*SENDERS) and self.live(*TAKERS))
        return (whole or bool(self.live("client"))) and len(self.live("server")) < 2 and not self.misfits

    @property
    def misfits(self) -> list[End]:
        """The ends whose port element has another interface."""
        return [e for e in self.live(*SENDERS, *TAKERS) if interface_of(e.member, e.port) != self.interface]


def element_names(declaration: Declaration, port: str, kind: ConnectorPort) -> dict[Element, str]:
    """How the port elements of a component's ``port`` of that ``kind`` are spelled; those that it does not have are left out.

    Each framework spells them in its own way, of which only this is known: both names are in it.
    """
    found: dict[Element, str] = {}
    for element in kind.elements:
        declared = declaration.provides if element.provided else declaration.requires
        names = [name for name in declared if port in name and element.name in name]
        if names:
            found[element] = min(names, key=len)
    return found


def interface_of(member: Member, port: str) -> str:
    """The name of the interface of a port element; empty for the probes' usual one."""
    return member.declaration.ports.get(port, "")


def is_misfit(connection: Connection) -> bool:
    """Do its two ends have different interfaces?"""
    provider = connection.provider
    return provider is not None and differ(connection.client, connection.port, provider, connection.provided)


def differ(client: Member, required: str, provider: Member, provided: str) -> bool:
    """Do the two port elements have different interfaces?"""
    return interface_of(client, required) != interface_of(provider, provided)
