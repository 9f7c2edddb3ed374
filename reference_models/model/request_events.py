"""Requests, entries, answers and callbacks of a request-response connection (10.4.1), as they belong together."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.trace import Exit, Reply
from ucm_cts.reference_models.model.links import End, LinkState
from ucm_cts.reference_models.model.method_calls import Delivery, MethodCall


@dataclass(slots=True, eq=False)
class Asked:
    """A request of a client.

    ``call``, ``client``: the call of ``request``, and the end through which it was made.
    ``entries``: the entries of servers that belong to it: one, if all is well.
    """

    call: MethodCall
    client: End
    entries: list[Received] = field(default_factory=list)

    @property
    def value(self) -> Datum | None:
        """What was asked."""
        return (self.call.request.arguments or (None,))[0]

    @property
    def waits(self) -> bool:
        """Does its client wait for the response?"""
        return self.client.is_synchronous

    @property
    def given(self) -> Datum | None:
        """The response of a synchronous client's call, or the identifier that an asynchronous one got; None if it got none."""
        results = self._results
        return results[0] if len(results) == 2 else None

    @property
    def code(self) -> object:
        """The return code; None while there is none."""
        results = self._results
        return results[1] if len(results) == 2 else None

    @property
    def is_ok(self) -> bool:
        """Did it come back with ok?"""
        return self.code == "ok"

    @property
    def answers(self) -> list[Answer]:
        """The answers to it, in the order in which they were given."""
        return sorted((a for entry in self.entries for a in entry.answers), key=lambda a: a.moment)

    @property
    def _results(self) -> tuple[Datum, ...]:
        reply = self.call.reply
        return reply.results or () if reply is not None and not reply.failed else ()


@dataclass(slots=True, eq=False)
class Received:
    """A request that entered a server.

    ``number``: the identifier that an asynchronous server was given.
    ``fit``: the request that it belongs to has the ``same`` value, or another one; or had entered a server before; or there is none.
    """

    delivery: Delivery
    server: End
    asked: Asked | None = None
    fit: Literal["same", "altered", "repeated", "stray"] = "stray"
    answers: list[Answer] = field(default_factory=list)

    @property
    def value(self) -> Datum | None:
        """The request that it was given."""
        return (self.delivery.enter.arguments or (None,))[0]

    @property
    def number(self) -> Datum | None:
        """The identifier that it was given; None at a synchronous server."""
        arguments = self.delivery.enter.arguments or ()
        return arguments[1] if len(arguments) == 2 and not self.server.is_synchronous else None


@dataclass(slots=True, eq=False)
class Answer:
    """A response that a server gave, by calling ``response`` or as it left ``request``.

    ``to``: the entry that it answers; None for an unknown identifier.
    ``nth``: the number of the answer among those to that entry, from 1.
    ``callbacks``: where it came to.
    """

    by: MethodCall | Exit
    value: Datum | None
    to: Received | None
    nth: int = 1
    callbacks: list[Callback] = field(default_factory=list)

    @property
    def moment(self) -> int:
        """The event by which it was given."""
        return self.by.n if isinstance(self.by, Exit) else self.by.request.n

    @property
    def ended(self) -> Exit | Reply | None:
        """The event by which the server had given it; None if it had not."""
        return self.by if isinstance(self.by, Exit) else self.by.reply

    @property
    def code(self) -> object:
        """The code that the connector gave the server; ``ok`` at a synchronous server, which is told nothing."""
        return "ok" if isinstance(self.by, Exit) else self.by.code_of_results

    @property
    def asked(self) -> Asked | None:
        """The request that it answers."""
        return self.to.asked if self.to is not None else None


@dataclass(slots=True, eq=False)
class Callback:
    """``response`` of an asynchronous client was entered.

    ``fit``: with the value of an answer to one of its own requests (``own``); of an answer to another client's (``foreign``); of an
    answer that it had before (``repeated``); of no answer, but with the identifier of one (``altered``); none of these (``invented``).
    """

    delivery: Delivery
    client: End
    answer: Answer | None = None
    fit: Literal["own", "foreign", "repeated", "altered", "invented"] = "invented"

    @property
    def value(self) -> Datum | None:
        """The response that it was given."""
        return (self.delivery.enter.arguments or (None,))[0]

    @property
    def number(self) -> Datum | None:
        """The identifier that it was given."""
        arguments = self.delivery.enter.arguments or ()
        return arguments[1] if len(arguments) == 2 else None


@dataclass(slots=True, eq=False)
class Requests:
    """What happened through one request-response connection."""

    link: LinkState
    asked: list[Asked] = field(default_factory=list)
    received: list[Received] = field(default_factory=list)
    answers: list[Answer] = field(default_factory=list)
    callbacks: list[Callback] = field(default_factory=list)
