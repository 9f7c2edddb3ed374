"""Scenarios of request-response (10.4.1): all pairs of clients and servers, stored requests, and what goes wrong.

A client asks when the test calls it. An asynchronous server answers at once or stores what it is asked and answers when the test
calls it, in an order of its own. Bodies pass an open gate at each entry, so that a scenario waits for entries and never sleeps;
to see that something does not come, it waits for something that was sent later on the same way.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence

from ucm_cts.adapters.contract import data_types as d
from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Policy, Scenario
from ucm_cts.harness.purposes.derived.request_configuration import (
    ASYNCHRONOUS,
    ELSEWHERE,
    INSIDE,
    KINDS,
    SYNCHRONOUS,
    Configuration,
    Kind,
)
from ucm_cts.harness.purposes.derived.through_components import through_components
from ucm_cts.harness.purposes.scripts import TestPurpose

_CLAUSE = "10.4.1"
_OUTSTANDING = 5
_MOST = 8
"""So many requests of each client may be open (interpretation open-requests)."""

_MANY = 300
"""More requests than a byte has identifiers for. A framework may refuse them, but none is lost of which it says ok."""

_LONG = 2500
"""Milliseconds after which a request is not forgotten."""

_QUIET = 100
"""Milliseconds in which nothing is to come."""

_UNKNOWN_ID = 4_000_000_000

_RECORD = d.Structure(
    "reading", {"number": d.Integer("LONGLONG"), "name": d.String("CHAR8"), "levels": d.Sequence(d.Integer("SHORT"))}
)
_TYPES: dict[str, tuple[d.AnyType, d.Datum]] = {
    "LONG": (d.Integer("LONG"), 7),
    "ULONGLONG": (d.Integer("ULONGLONG"), 2**64 - 1),
    "DOUBLE": (d.Float("DOUBLE"), "400921fb54442d18"),
    "BOOLEAN": (d.Boolean(), True),
    "CHAR32": (d.Char("CHAR32"), 0x1F600),
    "string": (d.String("CHAR32"), "réponse"),
    "structure": (_RECORD, [-(2**40), "level", [1, -1, 300]]),
    "array": (d.Array(d.Integer("USHORT"), (2, 2)), [[1, 2], [3, 65535]]),
    "enumeration": (d.Enumeration("mode", "ULONG", {"off": 0, "on": 7}), "on"),
    "LONG, zero": (d.Integer("LONG"), 0),
    "BOOLEAN, false": (d.Boolean(), False),
    "string, empty": (d.String("CHAR8"), ""),
    "sequence, empty": (d.Sequence(d.Integer("SHORT")), []),
}
"""Types of requests and responses, each with a value."""


def request_purposes() -> list[TestPurpose]:
    """Pairs of kinds, stored requests, types, servers, faults, phases."""
    return [
        _pairs(),
        _stored(),
        _waiting(),
        _types(),
        _overwritten(),
        _servers(),
        _identifiers(),
        _apart(),
        _ports(),
        _protected(),
        through_components(_protected()),
        _faults(),
        _failing(),
        _phases(),
    ]


def _purpose(name: str, text: str, requirements: str, scenarios: Sequence[tuple[str, Scenario]]) -> TestPurpose:
    ids = tuple(f"R-10.4.1.{one}" for one in requirements.split())
    return TestPurpose(f"requests/{name}", _CLAUSE, text, ids, tuple((f"requests/{n}", one) for n, one in scenarios))


def _pairs() -> TestPurpose:
    """Clients of each kind ask a server of each kind, one after the other, before and after two restarts."""
    scenarios = []
    for server, kinds in itertools.product(KINDS, _groups()):
        for place in (s.MANAGER, ELSEWHERE):
            made = Configuration(place).server(server).clients((*kinds, kinds[0], kinds[-1]), 2).start()
            for number in range(len(kinds)):
                made.ask(number)
            made.restart().ask(len(kinds)).restart().ask(len(kinds) + 1)
            where = "one container" if place == s.MANAGER else "server elsewhere"
            scenarios.append((f"{' and '.join(kinds)} to {server}, {where}", made.end()))
    text = "Clients of each kind ask a server of each kind, before and after restarts."
    return _purpose("pairs", text, "1-31 1-32 1-34 1-08 2-01 2-03 2-04 2-06 2-07 2-11", scenarios)


def _groups() -> list[tuple[Kind, ...]]:
    return [
        (SYNCHRONOUS,),
        (ASYNCHRONOUS,),
        (SYNCHRONOUS, SYNCHRONOUS),
        (ASYNCHRONOUS, ASYNCHRONOUS),
        (SYNCHRONOUS, ASYNCHRONOUS),
    ]


def _stored() -> TestPurpose:
    """An asynchronous server stores requests and answers them later, in an order of its own."""
    scenarios = []
    for name, order in (
        ("3, 1, 2", (3, 1, 2)),
        ("5 to 1", tuple(range(_OUTSTANDING, 0, -1))),
        ("1 to 5", (1, 2, 3, 4, 5)),
    ):
        made = Configuration().storing(order).clients((ASYNCHRONOUS,), len(order)).start()
        made.ask_all(0).entered(len(order)).answer(len(order)).join(0)
        scenarios.append((f"answers in the order {name}", made.end()))
    orders = ((1, 2, 3, 4, 5, 6), (6, 5, 4, 3, 2, 1), (4, 1, 5, 2, 6, 3))
    for order in orders:
        made = Configuration().storing(order).clients((ASYNCHRONOUS, ASYNCHRONOUS), 3).start()
        made.ask_all(0, 1).entered(6).answer(6).join(0, 1)
        scenarios.append((f"two clients, three each, answers in the order {', '.join(map(str, order))}", made.end()))
    made = Configuration().storing(range(1, 2 * _MOST + 1)).clients((ASYNCHRONOUS, ASYNCHRONOUS), _MOST).start()
    made.ask_all(0, 1).entered(2 * _MOST).answer(2 * _MOST).join(0, 1)
    scenarios.append((f"two clients, {_MOST} each", made.end()))
    made = Configuration().storing(range(1, _MANY + 1)).clients((ASYNCHRONOUS,), _MANY).start()
    made.ask_apart(0).join(0).entered(_MANY).answer(_MANY)
    scenarios.append((f"one client, {_MANY}", made.end()))
    made = Configuration().storing(range(1, _OUTSTANDING + 1), apart=True).clients((ASYNCHRONOUS,), _OUTSTANDING)
    made.start().ask_all(0).entered(_OUTSTANDING).join(0).answer_at_once(_OUTSTANDING)
    scenarios.append(("answers at once", made.end()))
    made = Configuration().storing((1, 2), apart=True).clients((ASYNCHRONOUS,), 1, again=True).start()
    made.ask_all(0).entered(1).join(0).answer_next(0, 1).entered(2).answer_next(1, 1).entered(3)
    scenarios.append(("a client that asks again when it is answered", made.end()))
    made = Configuration().storing((2, 1)).clients((ASYNCHRONOUS,), 2).start()
    made.ask_all(0).entered(2).join(0).pause(_LONG).answer(2)
    scenarios.append(("answers after a long time", made.end()))
    text = "A server stores requests of one client or two, and answers them later."
    return _purpose("stored", text, "1-10 2-08 2-09 2-10 2-12 2-13 2-14 2-15", scenarios)


def _waiting() -> TestPurpose:
    """A synchronous client waits; an asynchronous one goes on while its server is held, or does not answer."""
    scenarios = []
    for client, server in itertools.product(KINDS, KINDS):
        made = Configuration().server(server, held=True).clients((client,), 1).start(held=True)
        made.ask_apart(0).at_gate().settle(0)
        made.open(INSIDE).join(0).answered(1 if client == ASYNCHRONOUS else 0)
        scenarios.append((f"{client} client of a held {server} server", made.end()))
    made = Configuration().storing((2, 1)).clients((SYNCHRONOUS, SYNCHRONOUS), 1).start()
    made.ask_apart(0).entered(1).settle(0).ask_apart(1).entered(2).settle(1).answer(0).join(0, 1)
    scenarios.append(("two synchronous clients wait, answered in the order 2, 1", made.end()))
    made = Configuration().storing((2, 3, 1), apart=True).clients((SYNCHRONOUS,) * 3, 1).start()
    for number in range(3):
        made.ask_apart(number).entered(number + 1)
    made.answer_next(0, 0).join(1).settle(0).settle(2).answer_next(1, 0).join(2).settle(0).answer_next(2, 0).join(0)
    scenarios.append(("three synchronous clients wait, answered one by one", made.end()))
    for server in KINDS:
        made = Configuration().server(server).clients((SYNCHRONOUS,) * 4, 2).start()
        made.ask_all(0, 1, 2, 3).join(0, 1, 2, 3)
        scenarios.append((f"four synchronous clients of a {server} server at once", made.end()))
    made = Configuration().storing((2, 1)).clients((SYNCHRONOUS, ASYNCHRONOUS), 1).start()
    made.ask_apart(0).entered(1).settle(0).ask_all(1).entered(2).answer(1).join(0, 1)
    scenarios.append(("one waits and one goes on, answered in the order 2, 1", made.end()))
    text = "A client waits, or goes on, while its server is held or has not answered."
    return _purpose("waiting", text, "2-02 2-05 2-03 2-13", scenarios)


def _types() -> TestPurpose:
    """Requests and responses of each type, through all pairs of kinds."""
    scenarios = []
    names = list(_TYPES)
    for index, name in enumerate(names):
        other = names[(index + 1) % len(names)]
        (request, asked), (response, given) = _TYPES[name], _TYPES[other]
        for client, server in itertools.product(KINDS, KINDS):
            made = Configuration(types=(request, response), values=((asked,), (given,)))
            made.server(server, fixed=True).clients((client,), 1).start()
            made.ask(0)
            scenarios.append((f"{name} and {other}, {client} to {server}", made.end()))
    text = "Requests and responses have each type, and both have different ones."
    return _purpose("types", text, "1-33 2-01 2-03 2-06 2-07", scenarios)


def _overwritten() -> TestPurpose:
    """A client overwrites what it asked while its server is held, a server what it answered while its client is."""
    scenarios = []
    for name in ("structure", "array"):
        of, value = _TYPES[name]
        for server in KINDS:
            made = Configuration(types=(of, of), values=((value,), (value,))).server(server, held=True, fixed=True)
            made.clients((ASYNCHRONOUS,), 2).start(held=True).ask_apart(0).at_gate().join(0).open(INSIDE).answered(2)
            scenarios.append((f"{name}, request to a held {server} server", made.end()))
        made = Configuration(types=(of, of), values=((value,), (value,))).server(ASYNCHRONOUS, fixed=True)
        made.clients((ASYNCHRONOUS,), 1, policies=(Policy(s.PROTECTED_PASSIVE),), holds=True).start(held=True)
        made.ask_apart(0).at_gate().entered(1).pause(_QUIET).open(INSIDE).join(0).answered(1)
        scenarios.append((f"{name}, response to a held client", made.end()))
    text = "Requests and responses are overwritten when the call is over that gave them away."
    return _purpose("overwritten", text, "1-33", scenarios)


def _servers() -> TestPurpose:
    """A second server, of the same or the other kind, is refused; without it the connection works."""
    scenarios = []
    for first, second in itertools.product(KINDS, KINDS):
        made = Configuration().server(first).server(second, name="other").clients((ASYNCHRONOUS,), 1).start()
        scenarios.append((f"{first} and {second} server", made.end()))
    for first, second in itertools.product(KINDS, KINDS):
        made = Configuration().server(first).clients((SYNCHRONOUS, ASYNCHRONOUS), 2).start().ask(0).ask(1).stop()
        made.remove_server().server(second, name="other").start().ask(0).ask(1)
        scenarios.append((f"{first} server, then another {second} one", made.end()))
    text = "A connection is to have two servers, at once or one after the other."
    return _purpose("servers", text, "1-07 1-30", scenarios)


def _identifiers() -> TestPurpose:
    """Answers with identifiers that are not open: never given out, or answered already."""
    scenarios = []
    for client in KINDS:
        made = Configuration().storing((1, 1, 2), unknown=_UNKNOWN_ID).clients((client, client), 1).start()
        if client == ASYNCHRONOUS:
            made.ask_all(0).entered(1).ask_all(1).entered(2).answer(2).join(0, 1)
        else:
            made.ask_all(0).entered(1).ask_all(1).entered(2).answer(0).join(0, 1)
        scenarios.append((f"unknown and repeated, {client} clients", made.end()))
    text = "A server answers an unknown request, and one request twice."
    return _purpose("identifiers", text, "2-16 2-17", scenarios)


def _apart() -> TestPurpose:
    """Two connections of equal types, each with a server and clients of its own."""
    scenarios = []
    for kind in KINDS:
        made = Configuration().server(ASYNCHRONOUS).clients((kind,), 2)
        made.connection("second").server(ASYNCHRONOUS, name="server of the second").clients((kind,), 2).start()
        made.ask(0).ask(1)
        scenarios.append((f"{kind} clients", made.end()))
    made = Configuration().storing((2, 1)).clients((ASYNCHRONOUS,), 2)
    made.connection("second").storing((2, 1), name="server of the second").clients((ASYNCHRONOUS,), 2).start()
    made.ask_all(0, 1).entered(4).answer(0).answer(4, "server of the second").join(0, 1)
    scenarios.append(("stored on both", made.end()))
    text = "Requests of two connections are open at the same time."
    return _purpose("apart", text, "2-20", scenarios)


def _ports() -> TestPurpose:
    """A component has two ports of one connection, or one of each of two."""
    scenarios = []
    for kind, server in itertools.product(KINDS, KINDS):
        made = Configuration().server(server).clients((kind, kind), 2, second="first").start()
        made.ask(0).ask(1).restart().ask(0)
        scenarios.append((f"{kind} clients of a {server} server, one connection", made.end()))
    for kind in KINDS:
        made = Configuration().server(ASYNCHRONOUS).connection("second").server(SYNCHRONOUS, name="other")
        made.clients((kind, kind), 2, second="first").start().ask(0).ask(1)
        scenarios.append((f"{kind} clients, two connections", made.end()))
    made = Configuration().storing((4, 2, 3, 1)).clients((ASYNCHRONOUS,), 2, second="first").start()
    made.ask_all(0).entered(4).answer(4).join(0)
    scenarios.append(("stored, one connection", made.end()))
    text = "Clients have two ports, of one connection or of two."
    return _purpose("ports", text, "1-08 2-07 2-10 2-13 2-20", scenarios)


def _protected() -> TestPurpose:
    """A response is given while its client is executed."""
    scenarios = []
    for policy in (Policy(s.PROTECTED_PASSIVE), Policy(s.ACTIVE, "in.api")):
        made = Configuration().server(ASYNCHRONOUS).clients((ASYNCHRONOUS,), 1, policies=(policy,), holds=True)
        made.start(held=True).ask_apart(0).at_gate().entered(1).pause(50).open(INSIDE).join(0).answered(1)
        scenarios.append((f"client with {policy.definition}", made.end()))
    text = "A response is given while its client, which is protected, is executed."
    return _purpose("protected", text, "2-18", scenarios)


def _faults() -> TestPurpose:
    """Transport or connector is broken when a client asks, or when a server answers, and mended again."""
    scenarios = []
    for where, client, server in itertools.product(("transport", "inside"), KINDS, KINDS):
        made = Configuration().server(server).clients((client,) * 3, 2).start()
        made.ask(0).break_(where).ask(1, wait=False).mend().ask(2)  # type: ignore[arg-type]
        scenarios.append((f"{where} broken, {client} to {server}", made.end()))
    for where in ("transport", "inside"):
        made = Configuration().storing((1, 2)).clients((ASYNCHRONOUS,), 2).start()
        made.ask_all(0).entered(2).break_(where).answer(0).mend().join(0)  # type: ignore[arg-type]
        scenarios.append((f"{where} broken when the server answers", made.end()))
    text = "Something is broken when a client asks, or a server answers."
    return _purpose("faults", text, "1-35", scenarios)


def _failing() -> TestPurpose:
    """The server raises, or gives another code than ok; the next server's clients are served."""
    scenarios = []
    for client, server in itertools.product(KINDS, KINDS):
        made = Configuration().failing(server).clients((client,), 2).start()
        made.ask_all(0).entered(1).join(0).stop()
        scenarios.append((f"{client} client of a {server} server that raises", made.end()))
    made = Configuration().server(SYNCHRONOUS, code="internal_error").clients((SYNCHRONOUS,), 2).start().ask(0)
    scenarios.append(("a server that gives another code", made.end()))
    text = "A server fails, or gives a code of its own."
    return _purpose("failing", text, "1-34 2-03", scenarios)


def _phases() -> TestPurpose:
    """Requests are outstanding when all are stopped, or a client is removed."""
    scenarios = []
    made = Configuration().storing((1, 2, 3, 4)).clients((ASYNCHRONOUS, ASYNCHRONOUS), 2).start()
    made.ask_all(0).entered(2).join(0).stop().pause(_QUIET).start().ask_all(1).entered(4).answer(2).join(1)
    scenarios.append(("asynchronous client, stopped and started again", made.end()))
    made = Configuration().storing((1,)).clients((SYNCHRONOUS,), 1).start()
    made.ask_apart(0).entered(1).settle(0).stop().join(0)
    scenarios.append(("synchronous client that waits, stopped", made.end()))
    made = Configuration(ELSEWHERE).storing((1,)).clients((SYNCHRONOUS,), 1).start()
    made.ask_apart(0).entered(1).settle(0).stop_only(ELSEWHERE).join(0)
    scenarios.append(("synchronous client whose server is stopped", made.end()))
    made = Configuration().server(SYNCHRONOUS, held=True).clients((SYNCHRONOUS,), 1).start(held=True)
    made.ask_apart(0).at_gate().settle(0).stop_apart().open(INSIDE).join(0).join_stop()
    scenarios.append(("synchronous client of a held server, stopped", made.end()))
    made = Configuration().storing((1, 2)).clients((ASYNCHRONOUS,) * 3, 1).start()
    made.ask_all(0, 1).entered(2).join(0, 1).stop().remove(0)
    made.start().ask_all(2).entered(3).join(2)
    scenarios.append(("a client with an open request is removed", made.end()))
    made = Configuration().container(ELSEWHERE).storing((2, 1)).clients((ASYNCHRONOUS,), 2)
    made.clients((ASYNCHRONOUS,), 1, place=ELSEWHERE).start().ask_all(0).entered(2).join(0).stop_only(ELSEWHERE)
    made.answer(2).start_only(ELSEWHERE).ask_all(1).entered(3).join(1)
    scenarios.append(("another client's container is stopped", made.end()))
    made = Configuration().container(ELSEWHERE).storing((1, 2), apart=True).clients((SYNCHRONOUS,), 1)
    made.clients((ASYNCHRONOUS,), 1, place=ELSEWHERE).start().ask_apart(0).entered(1).ask_all(1).entered(2).join(1)
    made.stop_only(ELSEWHERE).settle(0).answer_next(0, 0).join(0)
    scenarios.append(("another client's container is stopped while one waits", made.end()))
    text = "Requests are open when a client or the server is stopped or removed."
    return _purpose("phases", text, "2-19 2-21", scenarios)
