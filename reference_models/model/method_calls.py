"""Calls of methods, entries into bodies, bursts, steps and waits: what the model of interactions records (10.1.5, 10.1.6)."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract import trace as t
from ucm_cts.reference_models.model.executions import BusinessCall, connections_behind
from ucm_cts.reference_models.model.links import End, LinkState
from ucm_cts.reference_models.model.runtime import Container, Member

NEVER = 2**63
"""The ``n`` of an event that has not happened: later than all others."""

Fit = Literal["same", "altered", "repeated", "stray"]
"""How an entry fits the calls made so far: as one was made; as one was made, but for its values; like one that had been
delivered here before; like none.
"""


@dataclass(slots=True, eq=False)
class Delivery:
    """A body was entered at a method.

    ``call``: the call that it belongs to; None for a stray one.
    ``was_held``: it had to wait at a gate there.
    """

    enter: t.Enter
    receiver: Member | None
    link: LinkState | None
    call: MethodCall | None
    fit: Fit
    exit: t.Exit | None = None
    was_held: bool = False


@dataclass(slots=True, eq=False)
class Operation:
    """A step that was handed to the framework.

    ``container``, ``member``, ``link``: what its variables held when it began, None if that is unknown; later steps may bind them anew.
    ``end``: None while it has not ended.
    """

    step: s.Step
    begin: t.Call
    container: Container | None
    member: Member | None
    link: LinkState | None
    end: t.Return | t.Raise | None = None

    def overlaps(self, begin: int, end: int) -> bool:
        """Was it in progress somewhere between the events ``begin`` and ``end``?"""
        return self.begin.n < end and (self.end is None or self.end.n > begin)


@dataclass(slots=True, eq=False)
class Wait:
    """A wait ran out of patience.

    ``quiet_since``: when something had happened last (``t``).
    ``held``: a body was held at a gate.
    """

    step: s.Step
    timeout: t.Timeout
    quiet_since: int
    held: bool


@dataclass(slots=True, eq=False)
class MethodCall:
    """A body's call of a method.

    ``ready``: the caller was operational.
    ``started``: when its last on_startup began (``n``), which gave it its references; 0 if it had none.
    ``prepared``: all ends were attached before the components there were started.
    ``broken``: where its link was broken when it was made.
    ``targets``: the other ends that were attached then, with whether each was operational.
    ``idle``: those ends that certainly were not operational.
    ``crowded``: another message was on its way when this one was pushed, or was pushed before this one was answered.
    ``is_message``: it was pushed through a message connector.
    """

    request: t.Request
    business: BusinessCall
    caller: Member | None
    link: LinkState | None
    ready: bool
    started: int = 0
    prepared: bool = False
    broken: str = ""
    targets: list[tuple[End, bool]] = field(default_factory=list)
    idle: list[End] = field(default_factory=list)
    crowded: bool = False
    deliveries: list[Delivery] = field(default_factory=list)
    reply: t.Reply | None = None
    is_message: bool = False

    def __post_init__(self) -> None:
        connector = self.link.connector if self.link is not None else ""
        self.is_message = connector == s.MESSAGE_CONNECTOR and self.request.method == s.PUSH

    @property
    def over(self) -> int:
        """The event that ended it; later than all if none did."""
        return self.reply.n if self.reply is not None else NEVER

    @property
    def code(self) -> object:
        """The return code that a push gave; None if it gave none."""
        results = self.reply.results if self.reply is not None and self.reply.exception is None else None
        return results[0] if results else None

    @property
    def code_of_results(self) -> object:
        """The return code that a method of 10.4 gave, which is its last result; None if it gave none."""
        results = self.reply.results if self.reply is not None and self.reply.exception is None else None
        return results[-1] if results else None

    @property
    def is_mistyped(self) -> bool:
        """Did something of another type than that of the interface come to a body, or back?"""
        back = self.reply is not None and bool(self.reply.wrong)
        return back or any(delivery.enter.wrong for delivery in self.deliveries)

    @property
    def goals(self) -> set[tuple[Member, str]]:
        """The port elements that it may come to, as far as they are known."""
        if self.link is not None:
            return {(end.member, end.port) for end in self.link.ends if end.connection is None}
        behind = connections_behind(self.caller, self.request.port) if self.caller is not None else ()
        return {(c.provider, c.provided) for c in behind if c.provider is not None}

    def delivered_to(self, receiver: Member | None, port: str | None = None) -> list[Delivery]:
        """The entries into that receiver, at ``port`` or anywhere, that belong to this call."""
        return [d for d in self.deliveries if d.receiver is receiver and port in (None, d.enter.port)]


@dataclass(slots=True, eq=False)
class PushedBurst:
    """A burst that has been pushed. ``receivers`` are those that were operational then."""

    pushed: t.Pushed
    link: LinkState | None
    receivers: list[Member]
