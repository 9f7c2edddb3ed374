"""Connections with core connectors and their ends, as they are made, broken and undone (10.1.5, 10.1.6)."""

from __future__ import annotations

from dataclasses import dataclass, field

from ucm_cts.reference_models.model.runtime import Connection, Member

SENDERS = ("client", "emitter")
"""The roles of ends that call or push."""

TAKERS = ("server", "receiver")
"""The roles of ends that are called or pushed to."""


@dataclass(slots=True, eq=False)
class End:
    """A port element attached to a link.

    ``since``, ``until``: the ``n`` of the events that attached and detached it.
    ``connection``: only for clients and emitters.
    """

    role: str
    member: Member
    port: str
    since: int
    until: int | None = None
    connection: Connection | None = None


@dataclass(slots=True, eq=False)
class LinkState:
    """A connection with a core connector.

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

    def live(self, *roles: str) -> list[End]:
        """The ends of these roles that are attached now."""
        return [end for end in self.ends if end.until is None and end.role in roles and not end.member.gone]

    @property
    def has_lost_an_end(self) -> bool:
        """Was a component removed that was still attached?"""
        return any(end.until is None and end.member.gone for end in self.ends)

    @property
    def is_proper(self) -> bool:
        """Has it both sides, no second server, and ends of its interface only? Clients without server are not connected, and
        that is all.
        """
        whole = bool(self.live(*SENDERS) and self.live(*TAKERS))
        return (whole or bool(self.live("client"))) and len(self.live("server")) < 2 and not self.misfits

    @property
    def misfits(self) -> list[End]:
        """The ends whose port element has another interface."""
        return [e for e in self.live(*SENDERS, *TAKERS) if interface_of(e.member, e.port) != self.interface]


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
