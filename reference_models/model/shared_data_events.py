"""What happened through a shared-data connection (10.4.2): what writers published, and what each reader did and was told."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.platform_interfaces import WRITE
from ucm_cts.reference_models.model.links import End, LinkState
from ucm_cts.reference_models.model.method_calls import NEVER, Delivery, MethodCall

Source = Literal["written", "repeated", "cancelled", "nothing"]
"""What its writer has set when it publishes: a value since the last publication; none since then; a value that it has cancelled;
nothing so far.
"""


@dataclass(slots=True, eq=False)
class Publication:
    """A call of ``publish_data``.

    ``values``: what it may have sent, one value for each reading of the text; empty if it sent nothing.
    ``source``: what its writer had set.
    ``is_sure``: under all readings it sends something, it gave ok, and nothing was broken or changed meanwhile.
    ``writes``: the writes of that writer since its last publication or cancellation.
    ``cancelled``: the values that it has cancelled since its last publication.
    ``crossed``: what other writers did between the first of its writes and it.
    """

    call: MethodCall
    writer: End
    values: tuple[Datum, ...]
    source: Source
    is_sure: bool = False
    writes: tuple[MethodCall, ...] = ()
    cancelled: tuple[Datum, ...] = ()
    crossed: tuple[MethodCall, ...] = ()

    @property
    def since(self) -> int:
        """The event that began it."""
        return self.call.request.n

    @property
    def over(self) -> int:
        """The event that ended it; later than all if none did."""
        return self.call.over

    def precedes(self, other: Publication) -> bool:
        """Had it returned before the ``other`` was made?"""
        return self.over < other.since


@dataclass(slots=True, eq=False)
class Session:
    """The time for which a reader is frozen.

    ``freeze``, ``nested``: the call of ``freeze_data`` that began it, and further ones in it.
    ``unclear_since``: the event from which it may be over: a release after several calls of ``freeze_data``, or a stop.
    ``is_stopped``: something was stopped, started or joined meanwhile.
    ``released``: the call of ``release_data`` that surely ended it; None if none did.
    ``nth``: its number among those of its reader, from 1.
    """

    freeze: MethodCall
    nth: int
    nested: list[MethodCall] = field(default_factory=list)
    unclear_since: int = NEVER
    is_stopped: bool = False
    released: MethodCall | None = None

    def beginnings(self, before: int) -> list[MethodCall]:
        """The calls of ``freeze_data``, before that event, that may have frozen the reader: the first one, and those that were made when the
        session may have ended.
        """
        again = [call for call in self.nested if self.unclear_since < call.request.n < before]
        return [self.freeze, *again]


@dataclass(slots=True, eq=False)
class Reader:
    """A reader of the connection.

    ``calls``: its calls, in order; ``reads`` are those of ``read_data``.
    ``notices``: the entries of ``on_data_update``; ``heard_of``: the one by which it had surely been told, by publication.
    ``idle_releases``: calls of ``release_data`` while it was not frozen.
    """

    end: End
    calls: list[MethodCall] = field(default_factory=list)
    reads: list[MethodCall] = field(default_factory=list)
    notices: list[Delivery] = field(default_factory=list)
    heard_of: dict[int, int] = field(default_factory=dict)
    sessions: list[Session] = field(default_factory=list)
    idle_releases: list[MethodCall] = field(default_factory=list)


@dataclass(slots=True, eq=False)
class SharedData:
    """What happened through one shared-data connection.

    ``operations``: the calls of writers, in the order in which they were made.
    ``publications``: those that sent something, or may have; ``voids``: those that sent nothing.
    ``types_are_plain``: the connection is bound to a plain number.
    """

    link: LinkState
    types_are_plain: bool
    readers: list[Reader] = field(default_factory=list)
    operations: list[MethodCall] = field(default_factory=list)
    publications: list[Publication] = field(default_factory=list)
    voids: list[Publication] = field(default_factory=list)

    @property
    def writes(self) -> list[MethodCall]:
        """The calls of ``write_data``."""
        return [call for call in self.operations if call.request.method == WRITE]


def written(call: MethodCall) -> Datum | None:
    """The value that a call of ``write_data`` sets."""
    return (call.request.arguments or (None,))[0]


def given(call: MethodCall) -> Datum | None:
    """The value that a call of ``read_data`` gave; None if it gave none."""
    reply = call.reply
    results = reply.results or () if reply is not None and not reply.failed else ()
    return results[0] if len(results) == 2 else None


def is_ok(call: MethodCall) -> bool:
    """Did it give ok?"""
    return call.code_of_results == "ok"


def are_of_one_end(one: MethodCall, other: MethodCall) -> bool:
    """Are both calls made through one port of one component?"""
    return one.caller is other.caller and one.request.port == other.request.port
