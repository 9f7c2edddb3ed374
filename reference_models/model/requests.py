"""Requests and responses of request-response connections (10.4.1), paired when the trace is over.

A response may come before ``request`` has given out its identifier, and both sides may number requests in their own way. So
entries of the server are paired with requests by their values, answers with entries by the server's identifier, and what
comes back with answers by its value.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.platform_interfaces import REQUEST, REQUEST_RESPONSE, RESPONSE
from ucm_cts.reference_models.model.extended_links import changes_between, end_at
from ucm_cts.reference_models.model.links import End, LinkState
from ucm_cts.reference_models.model.method_calls import NEVER, MethodCall
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.request_events import Answer, Asked, Callback, Received, Requests
from ucm_cts.reference_models.model.runtime import Member


def all_requests(runtime: ObservedRuntime) -> list[Requests]:
    """What happened through each request-response connection. The trace must be over."""
    if runtime.requests is None:
        links = [k for k in runtime.interactions.links.values() if k.connector == REQUEST_RESPONSE]
        runtime.requests = [_paired(runtime, link) for link in links]
    return runtime.requests


def _paired(runtime: ObservedRuntime, link: LinkState) -> Requests:
    found = Requests(link)
    interactions = runtime.interactions
    calls = [call for call in interactions.calls if call.link is link]
    for call in calls:
        client = end_at(link, call.caller, call.request.port, call.request.n)
        if client is not None and client.side == "client" and call.request.method == REQUEST:
            found.asked.append(Asked(call, client))
    for delivery in (d for d in interactions.deliveries if d.link is link):
        end = end_at(link, delivery.receiver, delivery.enter.port or "", delivery.enter.n)
        if end is not None and end.side == "server" and delivery.enter.method == REQUEST:
            found.received.append(Received(delivery, end))
        elif end is not None and end.side == "client" and delivery.enter.method == RESPONSE:
            found.callbacks.append(Callback(delivery, end))
    _pair_entries(found)
    _find_answers(found, calls)
    _pair_callbacks(found)
    return found


def _pair_entries(found: Requests) -> None:
    for received in found.received:
        moment = received.delivery.enter.n
        before = [a for a in found.asked if a.call.request.n < moment]
        same = [a for a in before if a.value == received.value]
        free = [a for a in same if not a.entries]
        if free:
            received.asked, received.fit = min(free, key=lambda a: _reasons_against(a, received)), "same"
        elif same:
            received.asked, received.fit = same[-1], "repeated"
        if received.asked is not None:
            received.asked.entries.append(received)
    for received in (r for r in found.received if r.asked is None):
        moment = received.delivery.enter.n
        lost = [a for a in found.asked if not a.entries and a.call.request.n < moment]
        if lost:
            received.asked, received.fit = min(lost, key=lambda a: _reasons_against(a, received)), "altered"
            received.asked.entries.append(received)


def _reasons_against(asked: Asked, received: Received) -> tuple[bool, bool, bool, int]:
    """Reasons why a request does not belong to an entry with its value: it had come back, gave another code than ok, or has another
    identifier; earlier ones come first.
    """
    had_come_back = asked.waits and asked.call.over < received.delivery.enter.n
    refused = asked.call.reply is not None and not asked.is_ok
    other = not asked.waits and received.number is not None and asked.given != received.number
    return had_come_back, refused, other, asked.call.request.n


def _find_answers(found: Requests, calls: list[MethodCall]) -> None:
    for received in found.received:
        left = received.delivery.exit
        results = left.results or () if left is not None and not left.failed else ()
        if left is not None and received.server.is_synchronous and len(results) == 2:
            received.answers.append(Answer(left, results[0], received))
    for call in calls:
        arguments = call.request.arguments or ()
        if call.request.method != RESPONSE or len(arguments) != 2:
            continue
        moment = call.request.n
        named = [r for r in found.received if r.number == arguments[1] and r.delivery.enter.n < moment]
        open_ones = [r for r in named if not r.answers]
        to = (open_ones or named)[-1] if named else None
        answer = Answer(call, arguments[0], to, len(to.answers) + 1 if to is not None else 1)
        if to is not None:
            to.answers.append(answer)
        else:
            found.answers.append(answer)
    found.answers += [answer for received in found.received for answer in received.answers]
    found.answers.sort(key=lambda answer: answer.moment)


def _pair_callbacks(found: Requests) -> None:
    for callback in found.callbacks:
        moment = callback.delivery.enter.n
        given = [a for a in found.answers if a.moment < moment and a.value == callback.value]
        _pair_otherwise(found, callback, given)
        own = [a for a in given if a.asked is not None and a.asked.client.is_of_port(callback.client)]
        by_number = [a for a in own if a.asked is not None and a.asked.given == callback.number]
        fresh = [a for a in (*by_number, *own) if not a.callbacks]
        if fresh:
            callback.answer, callback.fit = fresh[0], "own"
        elif own:
            callback.answer, callback.fit = own[-1], "repeated"
        elif foreign := [a for a in given if a.asked is not None and not a.asked.waits]:
            callback.answer, callback.fit = foreign[0], "foreign"
        else:
            _pair_by_number(found, callback)
        if callback.answer is not None:
            callback.answer.callbacks.append(callback)


def _pair_otherwise(found: Requests, callback: Callback, given: Sequence[Answer]) -> None:
    """A server learns no identifier, or another one than the client: which of several equal requests it answered shows when a response
    tells one.
    """
    own = [
        a for a in found.asked if not a.waits and a.client.is_of_port(callback.client) and a.given == callback.number
    ]
    if any(answer.asked in own for answer in given):
        return
    for answer, other in itertools.product(given, own):
        entry, asked = answer.to, answer.asked
        if entry is None or asked is None or entry.number == asked.given or answer.callbacks:
            continue
        was_asked = other.value == asked.value and other.call.request.n < entry.delivery.enter.n
        if was_asked and not any(one.callbacks for one in other.answers):
            asked.entries, other.entries = other.entries, asked.entries
            for received in asked.entries:
                received.asked = asked
            for received in other.entries:
                received.asked = other
            return


def _pair_by_number(found: Requests, callback: Callback) -> None:
    """Its value is none that was given: is its identifier that of a request of this client that was answered before?"""
    for answer in found.answers:
        asked = answer.asked
        answered = answer.moment < callback.delivery.enter.n and not answer.callbacks
        if (
            asked is not None
            and answered
            and asked.client.is_of_port(callback.client)
            and asked.given == callback.number
        ):
            callback.answer, callback.fit = answer, "altered"
            return


def is_sound(runtime: ObservedRuntime, asked: Asked, until: int = NEVER) -> bool:
    """Was everything in order from the request until that event?

    There was one server, and both were operational and attached in time. No connection was broken, no component was removed, no connection was
    undone, and no container was stopped that has one of the two.
    """
    call, link = asked.call, asked.call.link
    if link is None or not link.is_proper or not call.ready or not call.prepared:
        return False
    if any(one.was_broken for one in runtime.interactions.links.values()):  # connections may share what is broken
        return False
    servers = {id(end.member) for end, _ in call.targets}
    if len(servers) != 1 or not all(ready for _, ready in call.targets) or call.is_mistyped:
        return False
    return next(changes_between(runtime, call.request.n, until, participants(asked)), None) is None


def participants(asked: Asked) -> list[Member]:
    """Its client, and the servers that it may have come to."""
    return [asked.client.member, *(end.member for end, _ in asked.call.targets)]


def fails(end: End) -> bool:
    """Does the plan of the component make it raise, or give another code than ok, where its methods are entered?"""
    member = end.member
    plan = member.declaration.plan.get("method", ())
    codes = [a.results[-1] for a in plan if isinstance(a, s.Answer) and a.results and a.exception is None]
    return member.raises("method") or any(code != "ok" for code in codes)


def asker(asked: Asked | None) -> str:
    """What findings call its client."""
    link = asked.call.link if asked is not None else None
    return link.label(asked.client) if asked is not None and link is not None else "another"
