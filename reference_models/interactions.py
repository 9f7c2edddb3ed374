"""Interactions of bodies through port elements that have interfaces: connections with connectors, calls of methods, and
which entry into a body belongs to which call (10.1.5, 10.1.6). Calls of policies' port elements (10.1.4) are calls, too.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.trace import Call, Enter, Exit, Raise, Reply, Request, Return
from ucm_cts.reference_models.executions import BusinessCall, connections_behind
from ucm_cts.reference_models.runtime import NO_ID, Connection, Member, Runtime

Fit = Literal["same", "altered", "repeated", "stray"]
"""How an entry fits the calls made so far: as one was made; as one was made, but for its values; like one that had been
delivered here before; like none.
"""

_SENDERS = ("client", "emitter")


@dataclass(slots=True, eq=False)
class End:
    """A port element attached to a link. ``until`` is the ``n`` of what detached it, ``connection`` is there for clients
    and emitters.
    """

    role: str
    member: Member
    port: str
    since: int
    until: int | None = None
    connection: Connection | None = None


@dataclass(slots=True, eq=False)
class LinkState:
    """A connection with a core connector. ``broken`` says where it is broken now, ``broken_at`` since when (``t``)."""

    name: str
    connector: str
    interface: str
    ends: list[End] = field(default_factory=list)
    broken: str = ""
    broken_at: int = 0

    def live(self, *roles: str) -> list[End]:
        """The ends of these roles that are attached now."""
        return [end for end in self.ends if end.until is None and end.role in roles]


@dataclass(slots=True, eq=False)
class Delivery:
    """A body was entered at a method. ``call`` is the call that it belongs to, None for a stray one."""

    enter: Enter
    receiver: Member | None
    link: LinkState | None
    call: MethodCall | None
    fit: Fit
    exit: Exit | None = None


@dataclass(slots=True, eq=False)
class MethodCall:
    """A body's call of a method. ``broken`` says where its link was broken when it was made, ``targets`` are the other ends
    that were attached then, with whether each was operational.
    """

    request: Request
    business: BusinessCall
    caller: Member | None
    link: LinkState | None
    broken: str = ""
    targets: list[tuple[End, bool]] = field(default_factory=list)
    deliveries: list[Delivery] = field(default_factory=list)
    reply: Reply | None = None

    @property
    def code(self) -> object:
        """The return code that a push gave; None if it gave none."""
        results = self.reply.results if self.reply is not None and self.reply.exception is None else None
        return results[0] if results else None

    def delivered_to(self, receiver: Member | None) -> list[Delivery]:
        """The entries into that receiver that belong to this call."""
        return [d for d in self.deliveries if d.receiver is receiver]


class Interactions:
    """All links, calls and deliveries of one trace."""

    def __init__(self, runtime: Runtime) -> None:
        self._runtime = runtime
        self.links: dict[str, LinkState] = {}
        self.calls: list[MethodCall] = []
        self.deliveries: list[Delivery] = []
        self._open: dict[int, list[MethodCall]] = {}
        self._inside: dict[int, list[Delivery]] = {}

    def linked(self, step: s.ConnectorCall, begin: Call, end: Return | Raise) -> LinkState | None:
        """A step for connectors has ended: the link it was about, as it is now."""
        if isinstance(step, s.Link):
            if isinstance(end, Return):
                self.links[step.bind] = LinkState(step.bind, step.connector, step.interface)
            return self.links.get(step.bind)
        link = self.links.get(step.link)
        if link is None or isinstance(end, Raise):
            return link
        if isinstance(step, s.Break):
            link.broken, link.broken_at = step.where, end.t
        elif isinstance(step, s.Mend):
            link.broken = ""
        elif isinstance(step, s.Attach):
            self._attach(link, step, begin)
        else:
            self._detach(link, step, begin)
        return link

    def _attach(self, link: LinkState, step: s.Attach, begin: Call) -> None:
        member = self._runtime.members.get(step.id)
        if member is None:
            return
        end = End(step.role, member, step.port, begin.n)
        if step.role in _SENDERS:
            end.connection = Connection(link.name, NO_ID, member, step.port, "opaque", None)
            member.connections.append(end.connection)
        link.ends.append(end)
        server = next(iter(link.live("server")), None)
        for client in link.live("client") if server is not None else ():
            if client.connection is not None and server is not None:
                client.connection.provider, client.connection.provided = server.member, server.port

    def _detach(self, link: LinkState, step: s.Detach, begin: Call) -> None:
        member = self._runtime.members.get(step.id)
        for end in link.live("client", "emitter", "server", "receiver"):
            if end.member is member and end.port == step.port:
                end.until = begin.n
                if end.connection is not None:
                    end.connection.live = False

    def request(self, event: Request, business: BusinessCall) -> None:
        """A body calls a method."""
        caller = self._runtime.member_of(event.component, event.instance)
        call = MethodCall(event, business, caller, self._link_of(caller, event.port, _SENDERS))
        if call.link is not None:
            call.broken = call.link.broken
            call.targets = [(end, end.member.serving) for end in call.link.live("server", "receiver")]
        self.calls.append(call)
        self._open.setdefault(event.thread, []).append(call)

    def reply(self, event: Reply) -> MethodCall | None:
        """A call of a method came back."""
        calls = self._open.get(event.thread)
        if not calls:
            return None
        call = calls.pop()
        call.reply = event
        return call

    def enter(self, event: Enter) -> Delivery:
        """A body is entered at a method."""
        receiver = self._runtime.member_of(event.component, event.instance)
        link = self._link_of(receiver, event.port or "", ("server", "receiver"))
        call, fit = self._call_behind(event, receiver, link)
        delivery = Delivery(event, receiver, link, call, fit)
        if call is not None:
            call.deliveries.append(delivery)
        self.deliveries.append(delivery)
        self._inside.setdefault(event.thread, []).append(delivery)
        return delivery

    def exit(self, event: Exit) -> None:
        """A body is left that was entered at a method."""
        inside = self._inside.get(event.thread)
        if inside:
            inside.pop().exit = event

    def _link_of(self, member: Member | None, port: str, roles: tuple[str, ...]) -> LinkState | None:
        """The link that ``port`` of ``member`` is, or was last, an end of."""
        ends = [
            (end.until is None, end.since, link)
            for link in self.links.values()
            for end in link.ends
            if end.member is member and end.port == port and end.role in roles
        ]
        return max(ends, key=lambda e: e[:2])[2] if ends else None

    def _call_behind(
        self, event: Enter, receiver: Member | None, link: LinkState | None
    ) -> tuple[MethodCall | None, Fit]:
        """The call that led to this entry. Services answer before the next call of the client; messages may come late."""
        candidates = [c for c in self.calls if c.request.method == event.method and self._leads_to(c, receiver, link)]
        if link is None or link.connector == s.SERVICE_CONNECTOR:
            candidates = [c for c in candidates if c.reply is None] or candidates
        same = [c for c in candidates if c.request.arguments == event.arguments]
        undelivered = [c for c in same if not c.delivered_to(receiver)]
        if undelivered:
            return undelivered[0], "same"
        if same:
            return same[-1], "repeated"
        altered = [c for c in candidates if not c.delivered_to(receiver)]
        return (altered[0], "altered") if altered else (None, "stray")

    def _leads_to(self, call: MethodCall, receiver: Member | None, link: LinkState | None) -> bool:
        if link is not None or call.link is not None:
            return call.link is link
        if call.caller is None or receiver is None:
            return False
        return any(c.provider is receiver for c in connections_behind(call.caller, call.request.port))
