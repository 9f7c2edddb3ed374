"""Properties about requests: they enter the server, clients wait for responses or go on, and get what was given (10.4.1.2)."""

from __future__ import annotations

from ucm_cts.adapters.contract.data_types import Integer
from ucm_cts.adapters.contract.platform_interfaces import REQUEST_DATA, RESPONSE_DATA
from ucm_cts.reference_models.conclusions import Conclusions, takes
from ucm_cts.reference_models.findings import Arrow, Finding
from ucm_cts.reference_models.model.extended_links import changes_between, overdue_since, value_shown
from ucm_cts.reference_models.model.messages import OK
from ucm_cts.reference_models.model.method_calls import NEVER
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.request_events import Asked, Received, Requests
from ucm_cts.reference_models.model.requests import all_requests, asker, fails, is_sound, participants
from ucm_cts.reference_models.model.runtime import lane
from ucm_cts.reference_models.model.services import is_left_hanging
from ucm_cts.reference_models.properties.declaration import Property, property_at

_CLIENTS, _PAIRS, _TYPES, _CODES = "R-10.4.1.1-08", "R-10.4.1.1-32", "R-10.4.1.1-33", "R-10.4.1.1-34"
_MENDED = "R-10.4.1.1-35"
_CARRIES, _WAITS, _RETURNS, _AS_SERVICES = "R-10.4.1.2-01", "R-10.4.1.2-02", "R-10.4.1.2-03", "R-10.4.1.2-04"
_GOES_ON, _REACHES = "R-10.4.1.2-05", "R-10.4.1.2-06"
_SEVERAL, _UNANSWERED, _APART, _HANGING = "R-10.4.1.2-14", "R-10.4.1.2-15", "R-10.4.1.2-20", "R-10.4.1.2-21"

_MOST_OPEN = 8
"""So many requests of a client may be open (interpretation open-requests)."""

_SOON = 100_000_000
"""Nanoseconds. No connector gives up a request after so short a time, unless something is wrong."""

_PLAIN = Integer("LONG")
"""The type of which a value that is lost is not lost for its type's sake."""


@property_at("closed", _CARRIES, _REACHES, _TYPES, _CLIENTS, _SEVERAL, _UNANSWERED, feature="extended")
def request_carried(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """Each request that gave ok enters the server once, with the value that was sent."""
    for found in all_requests(runtime):
        for asked in found.asked:
            if not asked.is_ok or not is_sound(runtime, asked, asked.call.over):
                continue
            requirement = _CARRIES if asked.waits else _REACHES
            for entry in asked.entries[:1]:
                if entry.fit == "altered":
                    yield _altered(check, runtime, found, asked, entry)
            if len(asked.entries) > 1:
                observed = f"it entered {len(asked.entries)} times"
                yield _violate(check, requirement, "twice", asked, "enters the server once", observed)
            elif asked.entries and asked.entries[0].fit == "same":
                yield check.kept(requirement)
                if _types(runtime, found)[0] != _PLAIN:
                    yield check.kept(_TYPES)
            elif not asked.entries and asked.waits:
                due = _CLIENTS if _others_are_served(found, asked) else requirement
                yield _violate(check, due, "not served", asked, "enters the server", "it did not, and gave ok")


def _was_open_before(other: Asked, asked: Asked) -> bool:
    """Was the ``other`` request made before this one, and not answered yet when this one was made?"""
    moment = asked.call.request.n
    return other.call.request.n < moment and (not other.answers or other.answers[0].moment > moment)


def _has_many_open(found: Requests, asked: Asked) -> bool:
    """Were so many requests of its client open already that a further one may be refused?"""
    own = (other for other in found.asked if other.client.is_of_port(asked.client) and other.is_ok)
    return sum(_was_open_before(other, asked) for other in own) >= _MOST_OPEN


def _others_are_served(found: Requests, asked: Asked) -> bool:
    """Do requests of other clients enter the server, and none of this one?"""
    own = [a for a in found.asked if a.client.is_of_port(asked.client)]
    return len(own) > 1 and not any(a.entries for a in own) and any(a.entries for a in found.asked if a not in own)


def _altered(check: Property, runtime: ObservedRuntime, found: Requests, asked: Asked, entry: Received) -> Finding:
    plain = _types(runtime, found)[0] == _PLAIN
    requirement = (_CARRIES if asked.waits else _REACHES) if plain else _TYPES
    expected = f"reaches the server as {value_shown(asked.value)}"
    return _violate(check, requirement, "altered", asked, expected, f"the server got {value_shown(entry.value)}")


@property_at("closed", _REACHES, _SEVERAL, _UNANSWERED, _CARRIES, timed=True, feature="extended")
def request_arrives(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """A request that gave ok enters the server within patience, whatever is not answered yet."""
    for found in all_requests(runtime):
        for asked in found.asked:
            reply = asked.call.reply
            servers = [end for end, _ in asked.call.targets]
            if asked.waits or asked.entries or not asked.is_ok or reply is None or not servers:
                continue
            overdue = overdue_since(runtime, servers[0].member, reply)
            if not overdue or not is_sound(runtime, asked, overdue):
                continue
            ahead = [other for other in found.asked if other.entries and _was_open_before(other, asked)]
            own = any(other.client.is_of_port(asked.client) for other in ahead)
            requirement = _SEVERAL if own else _UNANSWERED if ahead else _REACHES
            requirement = _CLIENTS if _others_are_served(found, asked) and not ahead else requirement
            expected = "enters the server"
            expected += ", though earlier ones are not answered yet" if ahead else ""
            yield _violate(check, requirement, "never", asked, expected, "it did not, and gave ok")


@property_at("closed", _CARRIES, _UNANSWERED, timed=True, feature="extended")
def waiting_request_arrives(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """The request of a client that waits enters its asynchronous server within patience, whatever is not answered yet."""
    for found in all_requests(runtime):
        for asked in found.asked:
            servers = [end for end, _ in asked.call.targets if not end.is_synchronous]
            if not asked.waits or asked.entries or not servers:
                continue
            overdue = overdue_since(runtime, servers[0].member, asked.call.request)
            if not overdue or overdue > asked.call.over or not is_sound(runtime, asked, overdue):
                continue
            ahead = any(other.entries and _was_open_before(other, asked) for other in found.asked)
            expected = "enters the server" + (", though earlier ones are not answered yet" if ahead else "")
            yield _violate(
                check, _UNANSWERED if ahead else _CARRIES, "never", asked, expected, "it did not, and waited"
            )


@property_at("closed", _SEVERAL, _UNANSWERED, _CLIENTS, feature="extended")
def requests_before_answers(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """Requests enter the server while earlier ones are not answered."""
    for found in all_requests(runtime):
        entered = [r for r in found.received if r.fit == "same" and r.asked is not None]
        for index, received in enumerate(entered):
            moment = received.delivery.enter.n
            open_ones = [r for r in entered[:index] if not r.answers or r.answers[0].moment > moment]
            asked = received.asked
            if any(
                r.asked is not None and asked is not None and r.asked.client.is_of_port(asked.client) for r in open_ones
            ):
                yield check.kept(_SEVERAL)
            if open_ones:
                yield check.kept(_UNANSWERED)


@property_at("closed", _WAITS, _AS_SERVICES, feature="extended")
def response_awaited(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """The request of a synchronous client comes back when its server has answered, and not before."""
    settled = runtime.interactions.settled
    for found in all_requests(runtime):
        for asked in found.asked:
            reply = asked.call.reply
            if not asked.waits or reply is None or not asked.is_ok or not asked.entries:
                continue
            if next(changes_between(runtime, asked.call.request.n, reply.n), None) is not None:
                continue  # request_ends has that
            first = min((a.moment for a in asked.answers), default=NEVER)
            left = asked.entries[0].delivery.exit
            if left is not None and left.failed and left.n < reply.n:
                observed = f"it came back with {value_shown(asked.given)} and ok"
                expected = "does not end with ok: its server raised an exception"
                yield _violate(check, _AS_SERVICES, "swallowed", asked, expected, observed)
                continue
            if first > reply.n:
                observed = f"it came back with {value_shown(asked.given)} before the server had answered"
                expected = "comes back when the server has answered"
                yield _violate(check, _WAITS, "early", asked, expected, observed)
                continue
            looked_for = [e for e in settled if e.worker == asked.call.business.worker and e.where != "done"]
            if any(asked.call.request.n < e.n < first for e in looked_for) or asked.entries[0].number is not None:
                yield check.kept(_WAITS)


@property_at("closed", _RETURNS, _TYPES, _CODES, _PAIRS, _CLIENTS, _AS_SERVICES, _MENDED, feature="extended")
def response_returned(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """A synchronous client gets ok and the response that the server gave for its request."""
    for found in all_requests(runtime):
        for asked in found.asked:
            reply, entries = asked.call.reply, asked.entries
            if not asked.waits or reply is None:
                continue
            if not entries and not asked.is_ok and is_sound(runtime, asked, reply.n) and not _is_busy(runtime, asked):
                beside = [other for other in found.asked if not other.client.is_of_port(asked.client)]
                due = _CLIENTS if any(other.entries for other in beside) else _CODES
                yield _violate(
                    check, due, "refused", asked, "enters the server: nothing is wrong", f"it gave {_got(asked)}"
                )
            if len(entries) != 1 or entries[0].fit != "same":
                continue
            answers = [a for a in asked.answers if a.moment < reply.n]
            if not is_sound(runtime, asked, reply.n):
                continue
            if not answers:
                if not asked.is_ok and not fails(entries[0].server) and reply.t - asked.call.request.t < _SOON:
                    yield _violate(
                        check,
                        _CODES,
                        "given up",
                        asked,
                        "waits for its response: nothing is wrong",
                        f"it gave {_got(asked)}",
                    )
                continue
            server, first = entries[0].server, answers[0]
            if not asked.is_ok:
                yield from _not_ok(check, runtime, asked, entries[0])
            elif asked.given != first.value:
                others = [a for a in found.answers if a.value == asked.given and a.to is not first.to]
                plain = others or _types(runtime, found)[1] == _PLAIN
                observed = f"it got {value_shown(asked.given)}"
                observed += f", which was for '{asker(others[0].asked)}'" if others else ""
                expected = f"gets {value_shown(first.value)}, which the server gave"
                cause = "another's" if others else "other"
                yield _violate(check, _RETURNS if plain else _TYPES, cause, asked, expected, observed)
            else:
                own = _own_code(entries[0])
                if own != OK and server.is_synchronous and not (yield from takes(runtime, "request-code", "dropped")):
                    expected = f"gives {own}, as its server did, for codes are passed on, as declared"
                    yield _violate(check, _CODES, "code dropped", asked, expected, "it gave ok")
                    continue
                yield check.kept(_RETURNS)
                yield check.kept(_CODES)
                if server.is_synchronous:
                    yield check.kept(_AS_SERVICES)
                else:
                    yield check.kept(_PAIRS)
                if _types(runtime, found)[1] != _PLAIN:
                    yield check.kept(_TYPES)
                if len({id(other.client) for other in found.asked if other.entries}) > 1:
                    yield check.kept(_CLIENTS)


def _not_ok(check: Property, runtime: ObservedRuntime, asked: Asked, entry: Received) -> Conclusions:
    """It was answered and nothing was wrong: another code than ok must be the server's own."""
    own = _own_code(entry)
    if own != OK and asked.code == own:
        if (yield from takes(runtime, "request-code", "passed")):
            return
    elif fails(entry.server) and asked.code != OK:
        return
    yield _violate(check, _CODES, "not ok", asked, "gives ok: its server answered", f"it gave {_got(asked)}")


def _own_code(entry: Received) -> object:
    """The code that the server's body gave; ok if it gave none."""
    left = entry.delivery.exit
    return left.results[-1] if left is not None and left.results and not left.failed else OK


def _is_busy(runtime: ObservedRuntime, asked: Asked) -> bool:
    """Was the server executed when the request was made? It may be refused then: as a circle, or when its time is out."""
    moment = asked.call.request.n
    servers = {end.member.body for end, _ in asked.call.targets}
    spans = [(e.enter, e.end if e.over else NEVER) for body in servers for e in runtime.executions.of(body)]
    spans += [(d.enter, d.exit.n if d.exit is not None else NEVER) for d in runtime.interactions.deliveries]
    return any(enter.body in servers and enter.n < moment < end for enter, end in spans)


def _got(asked: Asked) -> object:
    return asked.code if asked.code is not None else "an exception"


@property_at("closed", _GOES_ON, _CODES, timed=True, feature="extended")
def client_goes_on(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """The request of an asynchronous client comes back without the response, with ok."""
    settled = runtime.interactions.settled
    for found in all_requests(runtime):
        for asked in found.asked:
            reply, request = asked.call.reply, asked.call.request
            if asked.waits or not is_sound(runtime, asked, asked.call.over):
                continue
            worker = asked.call.business.worker
            inside = [e.delivery for e in asked.entries]
            answered = min((a.moment for a in asked.answers), default=NEVER)
            if reply is None:
                left = all(d.exit is not None for d in inside)
                if left and is_left_hanging(runtime, worker, request.n):
                    yield _violate(check, _GOES_ON, "hangs", asked, "comes back without a response", "it did not")
                continue
            if not asked.is_ok:
                if not any(fails(end) for end, _ in asked.call.targets) and not _has_many_open(found, asked):
                    yield _violate(
                        check, _CODES, "not ok", asked, "gives ok: nothing is wrong", f"it gave {_got(asked)}"
                    )
                continue
            yield check.kept(_CODES)
            waited = [e for e in settled if e.worker == worker and e.where != "done" and request.n < e.n < reply.n]
            held = [d for d in inside if d.was_held and any(d.enter.n < e.n for e in waited)]
            if held and not (yield from takes(runtime, "request-return", "taken")):
                expected = "comes back when the request is sent, as declared"
                yield _violate(check, _GOES_ON, "waits", asked, expected, "it waited for the server's method")
            elif answered > reply.n and not held:
                yield check.kept(_GOES_ON)


@property_at("closed", _HANGING, _WAITS, timed=True, feature="extended")
def request_ends(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """A synchronous request ends when it is answered, or when its server has left."""
    for found in all_requests(runtime):
        for asked in found.asked:
            request, reply = asked.call.request, asked.call.reply
            if not asked.waits or not asked.call.ready or not asked.call.prepared or asked.call.broken:
                continue
            ending = list(changes_between(runtime, request.n, asked.call.over, participants(asked)))
            ending = [o for o in ending if o.begin.n > request.n and o.step.undoes in ("phase", "connection")]
            hangs = reply is None and is_left_hanging(runtime, asked.call.business.worker, request.n)
            if ending and reply is not None:
                if asked.is_ok and not any(a.moment < reply.n and a.value == asked.given for a in asked.answers):
                    observed = f"it came back with {value_shown(asked.given)}"
                    yield _violate(check, _HANGING, "invented", asked, "ends without an invented response", observed)
                else:
                    yield check.kept(_HANGING)
            elif ending and hangs and all(e.delivery.exit is not None for e in asked.entries):
                yield _violate(check, _HANGING, "hangs", asked, "ends when its server has left", "it did not end")
            elif hangs and asked.answers and not ending:
                yield _violate(check, _WAITS, "hangs", asked, "ends when it is answered", "it did not end")


@property_at("closed", _APART, _CARRIES, _REACHES, feature="extended")
def servers_uncalled(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """A server is entered because a client of its own connection asked."""
    everything = all_requests(runtime)
    for found in everything:
        for received in found.received:
            others = [a for other in everything if other is not found for a in other.asked]
            if received.fit != "stray":
                if others and received.asked is not None and any(a.entries for a in others):
                    yield check.kept(_APART)
                continue
            elsewhere = any(a.value == received.value for a in others)
            enter = received.delivery.enter
            requirement = _APART if elsewhere else _CARRIES if received.server.is_synchronous else _REACHES
            yield check.fail(
                "another connection" if elsewhere else "invented",
                expected=f"'{lane(*enter.body)}' gets what clients of {found.link.name} ask, and nothing else",
                observed=f"it got {value_shown(received.value)}, {'asked through another connection' if elsewhere else 'which nobody asked'}",
                at=(enter.n,),
                requirement=requirement,
            )


def _types(runtime: ObservedRuntime, found: Requests) -> tuple[object, object]:
    types = runtime.scenario.types[found.link.interface]
    return types[REQUEST_DATA], types[RESPONSE_DATA]


def _violate(check: Property, requirement: str, cause: str, asked: Asked, expected: str, observed: str) -> Finding:
    request, reply = asked.call.request, asked.call.reply
    client = lane(*request.body)
    entered = [e.delivery.enter for e in asked.entries]
    targets = [end.member.lane for end, _ in asked.call.targets]
    server = lane(*entered[0].body) if entered else targets[0] if targets else "server"
    return check.fail(
        cause,
        expected=f"the request {value_shown(asked.value)} of '{asker(asked)}' {expected}",
        observed=observed,
        at=(request.n, *(e.n for e in entered), *((reply.n,) if reply is not None else ())),
        instead=(Arrow(client, server, "request"), Arrow(server, client, "response")),
        requirement=requirement,
    )
