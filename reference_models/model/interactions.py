"""Interactions through port elements with interfaces: links, and which entry into a body belongs to which call (10.1.4 to 6)."""

from __future__ import annotations

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract import trace as t
from ucm_cts.adapters.contract.data_types import Boolean, Enumeration
from ucm_cts.adapters.contract.platform_interfaces import CONNECTOR_PORTS
from ucm_cts.reference_models.model.executions import BusinessCall, connections_behind
from ucm_cts.reference_models.model.links import SENDERS, End, LinkState, element_names
from ucm_cts.reference_models.model.method_calls import Delivery, Fit, MethodCall, Operation, PushedBurst, Wait
from ucm_cts.reference_models.model.runtime import NO_ID, Connection, Container, Member, Runtime
from ucm_cts.reference_models.model.value_transport import distance


class Interactions:
    """All links, calls, deliveries and bursts of one trace.

    ``held``: bodies at gates that are closed; ``released_at``: when the last of them was let go (``t``).
    ``operations``: the steps handed to the framework; ``changes``: those that do not only read.
    ``in_progress``: the operations that have not ended, by step.
    ``settled``: where workers were found.
    ``waits``: waits that ran out of patience.
    ``latest``: when something happened last (``t``).
    ``pauses``: what the calendar clock showed.
    """

    def __init__(self, runtime: Runtime) -> None:
        self._runtime = runtime
        self.links: dict[str, LinkState] = {}
        self.calls: list[MethodCall] = []
        self.deliveries: list[Delivery] = []
        self.bursts: list[PushedBurst] = []
        self.held: list[t.Held] = []
        self.released_at = 0
        self.operations: list[Operation] = []
        self.changes: list[Operation] = []
        self.in_progress: dict[int, Operation] = {}
        self.settled: list[t.Settled] = []
        self.waits: list[Wait] = []
        self.latest = 0
        self.pauses: list[t.Paused] = []
        self._opened: set[str] = set()
        self._under_way: list[MethodCall] = []
        self._open: dict[int, list[MethodCall]] = {}
        self._inside: dict[int, list[Delivery]] = {}

    def linked(self, step: s.ConnectorCall, begin: t.Call, end: t.Return | t.Raise) -> LinkState | None:
        """A step for connectors has ended: the link it was about, as it is now."""
        if isinstance(step, s.Link):
            if isinstance(end, t.Return):
                earlier = self.links.get(step.bind)
                if earlier is not None:  # the variable is bound anew; what was attached to the earlier one still is
                    self.links[f"{step.bind}, {len(self.links)}"] = earlier
                self.links[step.bind] = LinkState(step.bind, step.connector, step.interface)
            return self.links.get(step.bind)
        link = self.links.get(step.link)
        if link is None or isinstance(end, t.Raise):
            return link
        if isinstance(step, s.Break):
            link.broken, link.broken_at, link.was_broken = step.where, end.t, step.where
        elif isinstance(step, s.Mend):
            link.broken, link.mended_at = "", end.t
        elif isinstance(step, s.Attach):
            self._attach(link, step, begin)
        else:
            self._detach(link, step, begin)
        return link

    def operate(self, step: s.Step, begin: t.Call) -> None:
        """A step is handed to the framework."""
        container = self._runtime.containers.get(getattr(step, "container", ""))
        member, link = self._runtime.members.get(getattr(step, "id", "")), self.links.get(getattr(step, "link", ""))
        operation = self.in_progress[begin.step] = Operation(step, begin, container, member, link)
        self.operations.append(operation)
        if not step.reads_only:
            self.changes.append(operation)

    def operated(self, end: t.Return | t.Raise) -> None:
        """A step has ended."""
        operation = self.in_progress.pop(end.step, None)
        if operation is not None:
            operation.end = end

    def links_of(self, member: Member) -> list[LinkState]:
        """The links that port elements of ``member`` are attached to."""
        return [k for k in self.links.values() if any(end.member is member for end in (*k.takers, *k.senders))]

    def is_mistyped(self, link: LinkState) -> bool:
        """Did something of another type come to a body through it? Then it is open which message that was."""
        return any(delivery.enter.wrong for delivery in self.deliveries if delivery.link is link)

    def is_used_elsewhere(self, member: Member) -> bool:
        """Does a link join a provided port element of ``member`` with an end in another container?"""
        providing = (k for k in self.links_of(member) if any(end.member is member for end in k.takers))
        return any(end.member.container is not member.container for link in providing for end in link.senders)

    def has_refused(self, link: LinkState, role: str) -> bool:
        """Was an end of ``role`` refused?"""
        of_link = (o for o in self.operations if o.link is link and isinstance(o.end, t.Raise))
        return any(isinstance(o.step, s.Attach) and o.step.role == role for o in of_link)

    @property
    def is_joining(self) -> bool:
        """Is a port element just being attached to a connector, or detached?"""
        return any(isinstance(o.step, s.Attach | s.Detach) for o in self.in_progress.values())

    def has_left(self, delivery: Delivery, restarted: bool = False) -> bool:
        """Was the receiver detached from the link, or removed, before the first call with these values was made?

        With ``restarted``: also before the caller was started, so that it got no reference to the receiver.
        """
        member, link, arguments = delivery.receiver, delivery.link, delivery.enter.arguments
        calls = [c for c in self.calls if c.link is link and c.request.arguments == arguments]
        moment = min((c.started if restarted else c.request.n for c in calls), default=0)
        ends = (
            [e for e in link.ends if e.member is member and e.port == delivery.enter.port] if link is not None else []
        )
        if member is None or link is None or not ends or any(e.until is None and not member.gone for e in ends):
            return False
        attached = max(end.since for end in ends)
        return any(
            isinstance(o.end, t.Return) and o.begin.n > attached and o.end.n < moment
            for o in self.operations
            if isinstance(o.step, s.RemoveComponent)
            or (isinstance(o.step, s.Detach) and o.link is link and o.step.port == delivery.enter.port)
            if o.member is member
        )

    def ends_phases(self, begin: int, end: int) -> bool:
        """Was something in progress between these events that stops or removes components, or undoes connections?"""
        return any(o.step.undoes in ("phase", "connection") and o.overlaps(begin, end) for o in self.changes)

    def wait(self, event: t.Timeout) -> None:
        """A wait ran out of patience."""
        step = self._runtime.scenario.steps[event.step]
        self.waits.append(Wait(step, event, self.latest, bool(self.held)))

    def _attach(self, link: LinkState, step: s.Attach, begin: t.Call) -> None:
        member = self._runtime.members.get(step.id)
        if member is None:
            return
        for replaced in link.live("server") if step.role == "server" and self._runtime.replaces_servers else ():
            replaced.until = begin.n
        kind = CONNECTOR_PORTS.get(step.role)
        if kind is None:
            ends = [(step.port, step.role in SENDERS, "")]
        else:
            names = element_names(member.declaration, step.port, kind)
            ends = [(name, not element.provided, step.port) for element, name in names.items()]
        for port, requires, of in ends:
            end = End(step.role, member, port, begin.n, of=of)
            if requires:
                end.connection = Connection(link.name, NO_ID, member, port, "opaque", None)
                member.connections.append(end.connection)
                self._runtime.remembered.attach(end.connection)
            link.ends.append(end)
        self._connect_ends(link)

    def _connect_ends(self, link: LinkState) -> None:
        """A client is connected while the link has a taker; with two servers its provider is unknown."""
        if link.is_extended:
            self._connect_extended(link)
            return
        servers, takers = link.live("server"), link.takers
        for sender in link.senders:
            if sender.connection is not None:
                known = bool(takers) or link.connector == s.MESSAGE_CONNECTOR
                sender.connection.live = True if known else None
                only = servers[0] if len(servers) == 1 else None
                sender.connection.takers = tuple(end.member for end in takers)
                sender.connection.provider = only.member if only is not None else None
                sender.connection.provided = only.port if only is not None else ""

    def _connect_extended(self, link: LinkState) -> None:
        """A port of 10.4 is connected to the connector; while nothing is at the other side, that is left open."""
        for sender in link.senders:
            across = [e for e in (*link.senders, *link.takers) if e.side != sender.side]
            if sender.connection is not None:
                sender.connection.live = True if across else None
                sender.connection.takers = tuple(end.member for end in across)

    def _detach(self, link: LinkState, step: s.Detach, begin: t.Call) -> None:
        member = self._runtime.members.get(step.id)
        for end in (*link.senders, *link.takers):
            if end.member is member and step.port == (end.of or end.port):
                end.until = begin.n
                if end.connection is not None:
                    end.connection.live = False
        self._connect_ends(link)

    def request(self, event: t.Request, business: BusinessCall) -> None:
        """A body calls a method."""
        caller = self._runtime.bodies.get(event.body)
        ready = caller is not None and caller.serving
        started = self._runtime.startups.get(event.body, (0, 0))[0]
        end = self._end_of(caller, event.port, True)
        call = MethodCall(event, business, caller, end[0] if end is not None else None, ready, started)
        if end is not None and call.link is not None:
            call.broken = call.link.broken
            call.targets = [(other, other.member.serving) for other in call.link.across(end[1])]
            call.prepared = self._is_prepared(call)
            call.idle = [end for end, _ in call.targets if _is_idle(self._runtime, end.member)]
        if call.is_message:
            self._note_crowding(call)
        self.calls.append(call)
        self._open.setdefault(event.thread, []).append(call)

    def reply(self, event: t.Reply) -> MethodCall | None:
        """A call of a method came back."""
        calls = self._open.get(event.thread)
        if not calls:
            return None
        call = calls.pop()
        call.reply = event
        return call

    def enter(self, event: t.Enter) -> Delivery | None:
        """A body is entered at a method."""
        receiver = self._runtime.bodies.get(event.body)
        end = self._end_of(receiver, event.port or "", False)
        link = end[0] if end is not None else None
        call, fit = self._call_behind(event, receiver, link)
        delivery = Delivery(event, receiver, link, call, fit)
        if call is not None:
            call.deliveries.append(delivery)
        self.deliveries.append(delivery)
        self._inside.setdefault(event.thread, []).append(delivery)
        return delivery

    def exit(self, event: t.Exit) -> None:
        """A body is left that was entered at a method."""
        inside = self._inside.get(event.thread)
        if inside:
            inside.pop().exit = event

    def push(self, event: t.Pushed) -> None:
        """A body has pushed a burst."""
        caller = self._runtime.bodies.get(event.body)
        end = self._end_of(caller, event.port, True)
        link = end[0] if end is not None else None
        ends = link.live("receiver") if link is not None else []
        self.bursts.append(PushedBurst(event, link, [end.member for end in ends if end.member.serving]))

    def link_to(self, receiver: Member) -> LinkState | None:
        """The link that ``receiver`` is a receiver of."""
        links = self.links.values()
        return next((link for link in links if any(e.member is receiver for e in link.live("receiver"))), None)

    def hold(self, event: t.Held) -> None:
        """A body is held at a gate, if the gate is closed."""
        if event.gate in self._opened:
            return
        self.held.append(event)
        for delivery in self._inside.get(event.thread, ()):
            delivery.was_held = True

    def open(self, event: t.Opened) -> None:
        """A gate is opened for good."""
        self._opened.add(event.gate)
        if any(held.gate == event.gate for held in self.held):
            self.released_at = event.t
        self.held = [held for held in self.held if held.gate != event.gate]

    def settle(self, event: t.Settled) -> None:
        """A worker was looked for."""
        self.settled.append(event)

    def pause(self, event: t.Paused) -> None:
        """The scenario has let time pass."""
        self.pauses.append(event)

    def improper(self, container: Container | None = None) -> list[LinkState]:
        """Links that members of ``container``, or of any, are ends of and that are not as they should be."""
        return [
            link
            for link in self.links.values()
            if not link.is_proper
            and any(container in (None, end.member.container) for end in (*link.senders, *link.takers))
        ]

    def _is_prepared(self, call: MethodCall) -> bool:
        senders = call.link.senders if call.link is not None else []
        own = [end for end in senders if end.member is call.caller and end.port == call.request.port]
        ends = [*own, *(end for end, _ in call.targets)]
        begun = [self._runtime.startups.get(end.member.body) for end in ends]
        return bool(own) and all(b is not None and b[0] > end.since for b in begun for end in ends)

    def _note_crowding(self, call: MethodCall) -> None:
        """Is another message on its way?"""
        self._under_way = [other for other in self._under_way if not _has_come(other)]
        for other in self._under_way:
            if other.reply is None:
                call.crowded = other.crowded = True
            else:
                call.crowded = call.crowded or any(ready and not _is_done(other, end) for end, ready in other.targets)
        self._under_way.append(call)

    def _end_of(self, member: Member | None, port: str, requires: bool) -> tuple[LinkState, End] | None:
        """The link that ``port`` of ``member`` is, or was last, an end of, and that end."""
        ends = [
            (end.until is None, end.since, link, end)
            for link in self.links.values()
            for end in link.ends
            if end.member is member and end.port == port and (end.connection is not None) is requires
        ]
        return max(ends, key=lambda e: e[:2])[2:] if ends else None

    def _call_behind(
        self, event: t.Enter, receiver: Member | None, link: LinkState | None
    ) -> tuple[MethodCall | None, Fit]:
        """The call that led to this entry. Services answer before the next call of the client; messages may come late."""
        is_message = link is not None and link.connector == s.MESSAGE_CONNECTOR
        if link is not None and link.is_extended:
            return self._request_behind(event, link)
        candidates = [c for c in self.calls if c.request.method == event.method and self._leads_to(c, receiver, link)]
        if not is_message:
            candidates = _waiting(candidates, event)
        same = [c for c in candidates if c.request.arguments == event.arguments]
        undelivered = [c for c in same if not c.delivered_to(receiver, event.port)]
        if undelivered:
            return min(undelivered, key=lambda call: self._reasons_against(call, receiver)), "same"
        mistaken = [d for c in same for d in c.delivered_to(receiver, event.port) if d.fit == "altered"]
        if mistaken and is_message:
            return self._give_back(mistaken[0], candidates), "same"
        if same:
            return same[-1], "repeated"
        altered = [c for c in candidates if not c.delivered_to(receiver, event.port)]
        mixed_up = any(
            c.request.arguments == event.arguments for c in self.calls if _may_be_mixed_up(c, event, is_message)
        )
        if mixed_up and not (altered and self._has_few_values(event, link)):
            return None, "stray"
        return _nearest(altered, event), "altered" if altered else "stray"

    def _request_behind(self, event: t.Enter, link: LinkState) -> tuple[MethodCall | None, Fit]:
        """The call that waits for this entry of a synchronous server; others are paired when the trace is over."""
        waiting = [c for c in self.calls if c.link is link and c.reply is None and not c.deliveries]
        same = [c for c in waiting if c.request.method == event.method and c.request.arguments == event.arguments]
        return (same[0], "same") if same else (None, "stray")

    def _has_few_values(self, event: t.Enter, link: LinkState | None) -> bool:
        """Is what was given of types with so few values that one says nothing of where it came from?"""
        interface = self._runtime.scenario.interfaces.get(link.interface) if link is not None else None
        method = interface.methods.get(event.method or "") if interface is not None else None
        return method is not None and all(isinstance(p.of, Boolean | Enumeration) for p in method.arguments)

    def _reasons_against(self, call: MethodCall, receiver: Member | None) -> tuple[bool, bool, bool]:
        """Reasons against a message's delivery: a phase that is over, a broken link, another code than ok."""
        body = receiver.body if receiver is not None else ("", 0)
        since = self._runtime.startups.get(body, (0, 0))[0]
        refused = call.reply is not None and call.code != "ok"
        return call.request.n < since, bool(call.broken), refused

    def _give_back(self, mistaken: Delivery, candidates: list[MethodCall]) -> MethodCall | None:
        """The message ``mistaken`` belongs to another call: find that call, and return the one it was assigned to."""
        call = mistaken.call
        if call is not None:
            call.deliveries.remove(mistaken)
            if call.is_message and call not in self._under_way:
                self._under_way.append(call)
        others = [c for c in candidates if c is not call and not c.delivered_to(mistaken.receiver, mistaken.enter.port)]
        mistaken.call = _nearest(others, mistaken.enter)
        if mistaken.call is not None:
            mistaken.call.deliveries.append(mistaken)
        else:
            mistaken.fit = "stray"
        return call

    def _leads_to(self, call: MethodCall, receiver: Member | None, link: LinkState | None) -> bool:
        if link is not None or call.link is not None:
            return call.link is link
        if call.caller is None or receiver is None:
            return False
        return any(c.provider is receiver for c in connections_behind(call.caller, call.request.port))


def _waiting(calls: list[MethodCall], enter: t.Enter) -> list[MethodCall]:
    """Those that wait for a server, and, unless one of them fits, those that gave up before they had one."""
    waiting = [call for call in calls if call.reply is None]
    if any(call.request.arguments == enter.arguments for call in waiting):
        return waiting
    late = [call for call in calls if not call.deliveries and call.request.arguments == enter.arguments]
    return late or waiting or calls


def _nearest(calls: list[MethodCall], enter: t.Enter) -> MethodCall | None:
    """The call whose values differ least from those that a body was entered with."""
    return min(calls, key=lambda call: distance(call.request.arguments, enter.arguments), default=None)


def _may_be_mixed_up(call: MethodCall, event: t.Enter, is_message: bool) -> bool:
    """May this entry be that call's, through another link?"""
    if is_message or call.link is None:
        return call.is_message
    return not call.is_message and call.reply is None and call.request.method == event.method


def _is_idle(runtime: Runtime, member: Member) -> bool:
    """Is it certain that it is not operational, and not being started?"""
    being_started = member.body in runtime.startups and not member.closing
    return member.container.started is False and not (member.operational or member.suspended or being_started)


def _has_come(call: MethodCall) -> bool:
    """Is a message answered, and certainly not in transit any more?"""
    if call.reply is None:
        return False
    if call.broken or call.code != "ok":
        return True
    return all(
        not ready or any(delivery.exit is not None for delivery in call.delivered_to(end.member, end.port))
        for end, ready in call.targets
    )


def _is_done(call: MethodCall, end: End) -> bool:
    """Has the message been dealt with at that end, or can it no longer be?"""
    if not end.member.serving:
        return True
    return any(delivery.exit is not None for delivery in call.delivered_to(end.member, end.port))
