"""Properties about asynchronous responses: each comes to its client once, with the identifier of its request (10.4.1.2)."""

from __future__ import annotations

from collections.abc import Sequence

from ucm_cts.adapters.contract.data_types import Integer
from ucm_cts.adapters.contract.platform_interfaces import RESPONSE_DATA
from ucm_cts.adapters.contract.scenario import Stop
from ucm_cts.adapters.contract.trace import Return
from ucm_cts.reference_models.conclusions import Conclusions, takes
from ucm_cts.reference_models.findings import Finding
from ucm_cts.reference_models.model import execution_policies as policies
from ucm_cts.reference_models.model.extended_links import changes_between, overdue_since, value_shown
from ucm_cts.reference_models.model.messages import INTERNAL_ERROR, OK
from ucm_cts.reference_models.model.method_calls import NEVER
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.request_events import Answer, Asked, Callback, Received, Requests
from ucm_cts.reference_models.model.requests import all_requests, asker, is_sound, participants
from ucm_cts.reference_models.model.runtime import lane
from ucm_cts.reference_models.properties.declaration import Property, property_at

_DECOUPLED, _CLIENTS, _PAIRS, _TYPES = "R-10.4.1.1-10", "R-10.4.1.1-08", "R-10.4.1.1-32", "R-10.4.1.1-33"
_COMES, _STORED, _ANY_ORDER = "R-10.4.1.2-07", "R-10.4.1.2-08", "R-10.4.1.2-09"
_PAIRED, _SERVERS_ID, _DIFFER, _ASKER = "R-10.4.1.2-10", "R-10.4.1.2-11", "R-10.4.1.2-12", "R-10.4.1.2-13"
_UNKNOWN, _ONCE, _PROTECTED = "R-10.4.1.2-16", "R-10.4.1.2-17", "R-10.4.1.2-18"
_PHASES, _APART = "R-10.4.1.2-19", "R-10.4.1.2-20"

_PLAIN = Integer("LONG")


@property_at("closed", _COMES, _ASKER, _UNKNOWN, _ONCE, _TYPES, _APART, _PAIRS, feature="extended")
def response_comes(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """What enters an asynchronous client is an answer to one of its own requests, once and unchanged."""
    everything = all_requests(runtime)
    for found in everything:
        for callback in found.callbacks:
            if callback.delivery.enter.wrong:
                continue
            yield from _judged(check, runtime, everything, found, callback)


def _judged(
    check: Property, runtime: ObservedRuntime, everything: Sequence[Requests], found: Requests, callback: Callback
) -> Conclusions:
    answer = callback.answer
    if callback.fit == "own" and answer is not None:
        yield from _own(check, runtime, found, callback, answer)
    elif callback.fit == "repeated":
        twice = answer is not None and answer.to is not None and len(answer.to.answers) > 1
        yield _violate(check, _ONCE if twice else _COMES, "twice", callback, "gets each response once", "got it again")
    elif callback.fit == "foreign" and answer is not None:
        observed = f"got the response to '{asker(answer.asked)}'"
        yield _violate(check, _ASKER, "another's", callback, "gets responses to its own requests", observed)
    elif callback.fit == "altered" and answer is not None:
        plain = runtime.scenario.types[found.link.interface][RESPONSE_DATA] == _PLAIN
        expected = f"gets {value_shown(answer.value)} as the server gave it"
        observed = f"got {value_shown(callback.value)}"
        yield _violate(check, _COMES if plain else _TYPES, "altered", callback, expected, observed)
    else:
        unknown = [a for a in found.answers if a.to is None and a.value == callback.value]
        others = [a for other in everything if other is not found for a in other.answers]
        elsewhere = any(a.value == callback.value for a in others)
        requirement = _UNKNOWN if unknown else _APART if elsewhere else _COMES
        cause = "unknown request" if unknown else "another connection" if elsewhere else "invented"
        observed = f"got {value_shown(callback.value)}"
        observed += (
            ", given for an identifier that was not open"
            if unknown
            else ", given through another connection"
            if elsewhere
            else ", which no server gave"
        )
        yield _violate(check, requirement, cause, callback, "gets what its server gave for its requests", observed)


def _own(check: Property, runtime: ObservedRuntime, found: Requests, callback: Callback, answer: Answer) -> Conclusions:
    if answer.nth > 1:
        if not (yield from takes(runtime, "repeated-answer", "delivered")):
            yield _violate(check, _ONCE, "second", callback, "gets one response to a request", "got a second one")
        return
    yield check.kept(_COMES)
    if runtime.scenario.types[found.link.interface][RESPONSE_DATA] != _PLAIN:
        yield check.kept(_TYPES)
    clients = {id(a.client) for a in found.asked if a.entries and not a.waits}
    if len(clients) > 1:
        yield check.kept(_ASKER)
        yield check.kept(_CLIENTS)
    if answer.to is not None and answer.to.server.is_synchronous:
        yield check.kept(_PAIRS)


@property_at("closed", _COMES, _STORED, _ANY_ORDER, _DECOUPLED, timed=True, feature="extended")
def response_missing(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """Each answer comes to its asynchronous client within patience, however late and in which order it is given."""
    for found in all_requests(runtime):
        for answer in found.answers:
            asked, to = answer.asked, answer.to
            if asked is None or to is None or asked.waits or answer.nth > 1 or answer.code != OK:
                continue
            stored = to.delivery.exit is not None and to.delivery.exit.n < answer.moment
            overtaking = _overtakes(found, answer)
            if answer.callbacks:
                if stored:
                    yield check.kept(_STORED)
                    yield check.kept(_DECOUPLED)
                if overtaking:
                    yield check.kept(_ANY_ORDER)
                continue
            client = asked.client.member
            overdue = overdue_since(runtime, client, answer.ended) if answer.ended is not None else 0
            if overdue and is_sound(runtime, asked, overdue):
                broken = (_ANY_ORDER,) if overtaking else (_STORED, _DECOUPLED) if stored else (_COMES,)
                for requirement in broken:
                    yield check.fail(
                        "never",
                        expected=f"the response {value_shown(answer.value)} to '{asker(asked)}' comes to it",
                        observed="it did not",
                        at=(asked.call.request.n, answer.moment),
                        requirement=requirement,
                    )


def _overtakes(found: Requests, answer: Answer) -> bool:
    """Is it given before an answer to an earlier request?"""
    to = answer.to
    earlier = [r for r in found.received if to is not None and r.delivery.enter.n < to.delivery.enter.n]
    return any(r.answers and r.answers[0].moment > answer.moment for r in earlier)


@property_at("closed", _PAIRED, _SERVERS_ID, _DIFFER, feature="extended")
def identifiers_pair(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """A response has the identifier that its request gave out; the server's identifier leads to the right request."""
    for found in all_requests(runtime):
        for callback in (c for c in found.callbacks if c.fit == "own" and c.answer is not None):
            asked = callback.answer.asked if callback.answer is not None else None
            if asked is None or asked.given is None or not asked.is_ok:
                continue
            if asked.given == callback.number:
                yield check.kept(_PAIRED)
            else:
                expected = f"gets {value_shown(callback.value)} with {asked.given}, the identifier of its request"
                yield _violate(check, _PAIRED, "another", callback, expected, f"got it with {callback.number}")
        for answer in found.answers:
            asked = answer.asked
            if asked is None or answer.nth > 1 or answer.to is None or answer.to.number is None:
                continue
            arrived = answer.callbacks or (asked.waits and asked.given == answer.value)
            if arrived and answer.code == OK:
                yield check.kept(_SERVERS_ID)
            elif answer.code == INTERNAL_ERROR and is_sound(runtime, asked, answer.moment):
                yield check.fail(
                    "not known",
                    expected=f"the server's response with {answer.to.number}, which it was given, is taken",
                    observed=f"it gave {answer.code}",
                    at=(answer.to.delivery.enter.n, answer.moment),
                    requirement=_SERVERS_ID,
                )
        yield from _differing(check, runtime, found)
        for received in found.received:
            asked = received.asked
            given = asked.given if asked is not None and asked.is_ok and not asked.waits else None
            if given is not None and received.number is not None:
                reading = "same" if given == received.number else "translated"
                if not (yield from takes(runtime, "request-ids", reading)) and reading == "translated":
                    yield check.fail(
                        "other numbers",
                        expected=f"client and server know the request by one identifier, as declared: {given}",
                        observed=f"the server was given {received.number}",
                        at=(received.delivery.enter.n,),
                        requirement=_PAIRED,
                    )


def _differing(check: Property, runtime: ObservedRuntime, found: Requests) -> Conclusions:
    """Identifiers of requests that are open at the same time differ, at each client and at the server."""
    asked = [a for a in found.asked if not a.waits and a.given is not None and a.call.reply is not None and a.is_ok]
    for index, one in enumerate(asked):
        for other in asked[:index]:
            over = min(_over(other), _given_up(runtime, other, other.call.over, other.entries))
            is_open = over > one.call.over and all(ready for _, ready in other.call.targets)
            if is_open and other.client.is_of_port(one.client):
                if one.given != other.given:
                    yield check.kept(_DIFFER)
                else:
                    yield _same(check, f"'{asker(one)}'", one.given, other.call.over, one.call.over)
    entered = [r for r in found.received if r.number is not None and r.fit == "same"]
    for index, received in enumerate(entered):
        for earlier in entered[:index]:
            moment, begun = received.delivery.enter.n, earlier.delivery.enter.n
            answered = [answer.moment for answer in earlier.answers[:1]]
            if min([*answered, _given_up(runtime, earlier.asked, begun, [earlier])]) > moment:
                if received.number != earlier.number:
                    yield check.kept(_DIFFER)
                else:
                    server = f"'{lane(*received.delivery.enter.body)}'"
                    yield _same(check, server, received.number, begun, moment)


def _over(asked: Asked) -> int:
    """When its response had come; later than all events if it has not."""
    came = [c.delivery.enter.n for a in asked.answers for c in a.callbacks]
    return min(came, default=NEVER)


def _given_up(runtime: ObservedRuntime, asked: Asked | None, since: int, entries: Sequence[Received]) -> int:
    """From when a request that was open at the event ``since`` may have been given up: its server raised, its client had come back, or something
    that concerns them was stopped or undone; later than all events if nothing of that happened.
    """
    among = participants(asked) if asked is not None else ()
    moments = [operation.begin.n for operation in changes_between(runtime, since, NEVER, among)]
    moments += [
        entry.delivery.exit.n for entry in entries if entry.delivery.exit is not None and entry.delivery.exit.failed
    ]
    if asked is not None and asked.waits:
        moments.append(asked.call.over)
    return min(moments, default=NEVER)


def _same(check: Property, who: str, number: object, *at: int) -> Finding:
    return check.fail(
        "same identifier",
        expected=f"requests that are open at the same time have different identifiers at {who}",
        observed=f"two of them have {number}",
        at=at,
        requirement=_DIFFER,
    )


@property_at("closed", _UNKNOWN, _ONCE, feature="extended")
def answers_without_request(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """A response with an identifier that is not open leads to no response, and gives a code as declared."""
    for found in all_requests(runtime):
        for answer in found.answers:
            if answer.code is None:
                continue
            if answer.to is None:
                if not any(c.value == answer.value for c in found.callbacks):
                    yield check.kept(_UNKNOWN)
                reading = "ignored" if answer.code == OK else "refused"
                if not (yield from takes(runtime, "unknown-id", reading)):
                    yield check.fail(
                        "code",
                        expected=f"a response with an unknown identifier is {runtime.ics.reading('unknown-id')}, as declared",
                        observed=f"it gave {answer.code}",
                        at=(answer.moment,),
                        requirement=_UNKNOWN,
                    )
            elif answer.nth > 1 and not answer.callbacks and answer.asked is not None:
                first = answer.to.answers[0]
                if first.callbacks or answer.asked.given == first.value:
                    yield check.kept(_ONCE)


@property_at("closed", _ANY_ORDER, feature="extended")
def response_order(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """Do responses come to a client in the order in which its server gave them?"""
    for found in all_requests(runtime):
        own = [c for c in found.callbacks if c.fit == "own" and c.answer is not None]
        for index, later in enumerate(own):
            for earlier in own[:index]:
                if not earlier.client.is_of_port(later.client) or earlier.answer is None or later.answer is None:
                    continue
                given = _ended(earlier.answer), later.answer.moment
                overtaken = _ended(later.answer) < earlier.answer.moment
                if overtaken and not (yield from takes(runtime, "response-order", "unordered")):
                    yield _violate(
                        check,
                        _ANY_ORDER,
                        "overtaken",
                        later,
                        "gets responses in the order given, as declared",
                        "did not",
                    )
                elif given[0] < given[1]:
                    yield from takes(runtime, "response-order", "fifo")


def _ended(answer: Answer) -> int:
    return answer.ended.n if answer.ended is not None else NEVER


@property_at("closed", _PROTECTED, feature="extended")
def response_kept_out(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """A response was given while its protected client was executed, and came in when that had ended."""
    for found in all_requests(runtime):
        for callback in (c for c in found.callbacks if c.fit == "own" and c.answer is not None):
            enter, declaration = callback.delivery.enter, callback.client.member.declaration
            for execution in runtime.executions.past.get(enter.body, ()):
                given = callback.answer.moment if callback.answer is not None else NEVER
                excluded = policies.exclusion(declaration, runtime.ics, execution.way, enter.port or "")
                if excluded and execution.enter.n < given < execution.end < enter.n:
                    yield check.kept()


@property_at("closed", _PHASES, feature="extended")
def no_response_after_stop(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """Requests were outstanding when a participant was stopped, and it was not entered until it was started again."""
    stops = [o for o in runtime.interactions.changes if isinstance(o.step, Stop) and isinstance(o.end, Return)]
    for found in all_requests(runtime):
        for stop in stops:
            if any(_was_open(a, stop.begin.n) for a in found.asked):
                yield check.kept()
                came = [c for c in found.callbacks if c.answer is not None and c.delivery.enter.n > stop.begin.n]
                kept = any(c.answer is not None and c.answer.moment < stop.begin.n for c in came)
                yield from takes(runtime, "outstanding-at-stop", "kept" if kept else "dropped")


def _was_open(asked: Asked, moment: int) -> bool:
    return asked.is_ok and not asked.waits and asked.call.over < moment < _over(asked) and bool(asked.entries)


def _violate(
    check: Property, requirement: str, cause: str, callback: Callback, expected: str, observed: str
) -> Finding:
    enter, answer = callback.delivery.enter, callback.answer
    asked = answer.asked if answer is not None else None
    before = [asked.call.request.n] if asked is not None else []
    given = [answer.moment] if answer is not None else []
    link, client = callback.delivery.link, callback.client
    return check.fail(
        cause,
        expected=f"'{link.label(client) if link is not None else client.member.lane}' {expected}",
        observed=f"it {observed}",
        at=tuple(sorted({*before, *given, enter.n})),
        requirement=requirement,
    )
