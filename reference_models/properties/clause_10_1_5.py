"""Properties about the service connector: calls of clients reach one server and come back (10.1.5.1)."""

from __future__ import annotations

import math
from collections.abc import Iterable

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_values import printed
from ucm_cts.adapters.contract.trace import Raise, Reply, Return
from ucm_cts.reference_models.conclusions import Concluded, Conclusions, Taken, takes
from ucm_cts.reference_models.findings import Arrow, Finding
from ucm_cts.reference_models.model.designation import designation
from ucm_cts.reference_models.model.links import LinkState
from ucm_cts.reference_models.model.method_calls import Operation
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.operation import OperationInProgress, Result
from ucm_cts.reference_models.model.pacing import may_be_turned_away
from ucm_cts.reference_models.model.runtime import lane
from ucm_cts.reference_models.model.service_call import ServiceCall, Trouble
from ucm_cts.reference_models.model.services import (
    disturbed_at,
    ended_by,
    is_left_hanging,
    led_astray,
    new_types,
    service_calls,
    shared_links,
    strays,
    undisturbed,
    what_sets_apart,
)
from ucm_cts.reference_models.properties.declaration import Property, property_at

_CALLS, _CLIENTS, _OWN, _ONE_SERVER = "R-10.1.5.1-01", "R-10.1.5.1-03", "R-10.1.5.1-04", "R-10.1.5.1-05"
_DIRECTIONS, _INHERITED, _EXCEPTIONS = "R-10.1.5.1-08", "R-10.1.5.1-09", "R-10.1.5.1-10"
_BLOCKING, _IN_FLIGHT, _TEMPLATE = "R-10.1.5.1-11", "R-10.1.5.1-12", "R-10.1.5.1-13"

_REFUSALS = ("BAD_PARAMETER", "UCM_ERROR")
"""How a second server is refused at once."""

_SET_APART = {"inherited": _INHERITED, "second server": _ONE_SERVER, "client": _CLIENTS}


@property_at("closed", _CALLS, _CLIENTS, _OWN, _ONE_SERVER, _INHERITED, _TEMPLATE)
def service_call(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """A call enters the connected server once, at the method called, and comes back as the server was left."""
    judged = undisturbed(runtime)
    good = [one for one, trouble in judged if not trouble]
    shared = shared_links(good)
    several = len({one.link.interface for one in good}) > 1
    for one in good:
        yield check.kept(_CALLS)
        if one.is_inherited:
            yield check.kept(_INHERITED)
        if id(one.link) in shared:
            yield check.kept(_CLIENTS)
        if several:
            yield check.kept(_TEMPLATE)
    expected = "enters the server once and comes back as the server was left"
    for one, trouble in judged:
        if trouble == "twice":
            observed = f"the server was entered {len(one.served)} times"
            yield _violate(check, _CALLS, trouble, one, expected, observed)
        elif trouble == "not served" and _is_turned_away(runtime, one):
            continue
        elif trouble in ("not served", "elsewhere", "failed"):
            observed = _what_failed(runtime, one, trouble)
            spoilt = trouble == "failed" and any(
                one.meets(o) and o.exit is not None and o.exit.failed for o, _ in judged
            )
            requirement = _OWN if spoilt else _concerned(runtime, one, good)
            astray = led_astray(runtime, one) if trouble == "elsewhere" else None
            further = (astray.enter.n,) if astray is not None else ()
            yield _violate(check, requirement, trouble, one, expected, observed, *further)


@property_at("closed", _CALLS, _CLIENTS, _ONE_SERVER, _INHERITED, _TEMPLATE, timed=True)
def service_call_ends(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """A call that nothing disturbs ends when its server has been left, if the server waits for no other body."""
    for one in service_calls(runtime):
        if one.call.reply is None and _may_be_expected(one) and _hangs(runtime, one, disturbed_at(runtime, one)):
            good = [other for other, trouble in undisturbed(runtime) if not trouble]
            observed = "the server was left, and it did not end" if one.exit else "it did not end"
            requirement = _concerned(runtime, one, good)
            yield _violate(check, requirement, "hangs", one, "ends", observed)


def _is_turned_away(runtime: ObservedRuntime, one: ServiceCall) -> bool:
    """Was it refused as too early for a server whose executions must be apart (10.5.2)?"""
    reply = one.call.reply
    return reply is not None and reply.failed and may_be_turned_away(runtime, one.call.business)


def _hangs(runtime: ObservedRuntime, one: ServiceCall, until: int | None = None) -> bool:
    return is_left_hanging(runtime, one.call.business.worker, one.call.request.n, until)


def _what_failed(runtime: ObservedRuntime, one: ServiceCall, trouble: Trouble) -> str:
    if trouble == "failed":
        return f"the server {'gave its results' if one.exit else 'was entered'}, and the call ended with an exception"
    astray = led_astray(runtime, one)
    if astray is not None:
        enter = astray.enter
        return f"it entered '{lane(*enter.body)}' at {enter.port}"
    reply = one.call.reply
    how = "returned" if reply is not None and not reply.raised else "ended with an exception"
    return f"it {how}, and the server was not entered"


def _concerned(runtime: ObservedRuntime, one: ServiceCall, good: list[ServiceCall]) -> str:
    """The requirement that a call that is not carried out breaks: that of its difference from calls that are."""
    links = runtime.interactions.links.values()
    services = {link.interface for link in links if link.connector == s.SERVICE_CONNECTOR}
    apart = what_sets_apart(runtime, one, good)
    return _SET_APART[apart] if apart else _TEMPLATE if len(services) > 1 else _CALLS


def _may_be_expected(one: ServiceCall) -> bool:
    """Does its server wait for no other body?"""
    calls = (s.CallPort, s.CallMethod, s.Burst)
    return not any(isinstance(a, calls) for plan in one.server.member.declaration.plan.values() for a in plan)


@property_at("closed", _OWN, _DIRECTIONS, _CALLS)
def service_values(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """The client's values reach the server, and the server's results reach the client that called."""
    judged = undisturbed(runtime)
    shared = shared_links(one for one, _ in judged)
    for one, trouble in judged:
        method, given = one.method, one.exit
        several = method is not None and any(p.direction in ("OUT", "INOUT") for p in method.parameters)
        others_meet = judged if id(one.link) in shared else ()
        beside = [other for other, _ in others_meet if one.meets(other) and other.exit is not None]
        if not trouble and given is not None and not given.raised:
            if several and given.exception is None:
                yield check.kept(_DIRECTIONS)
            if any(_outcome(other) != _outcome(one) for other in beside):
                yield check.kept(_OWN)
        elif trouble == "arguments":
            observed = f"it got {_values(one.served[0].enter.arguments)}"
            expected = f"reaches the server with {_values(one.call.request.arguments)}"
            yield _violate(check, _DIRECTIONS if several else _CALLS, trouble, one, expected, observed)
        elif trouble == "results" and given is not None and one.call.reply is not None:
            got = one.call.reply.results
            others = [other for other in beside if other.exit is not None and other.exit.results == got]
            requirement = _OWN if others else _DIRECTIONS if several else _CALLS
            expected = f"brings back what the server gave for it, {_values(given.results)}"
            yield _violate(check, requirement, trouble, one, expected, f"it brought {_values(got)}")


def _outcome(one: ServiceCall) -> object:
    return (one.exit.exception, one.exit.results) if one.exit is not None else None


def _values(values: object) -> str:
    return printed(values) if isinstance(values, tuple) else "nothing"


@property_at("closed", _EXCEPTIONS)
def service_exceptions(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """An exception of the server's is one for the client: the same one, unless it may be any."""
    for one, trouble in undisturbed(runtime):
        left, reply = one.exit, one.call.reply
        if left is None or reply is None or left.n > reply.n or not left.failed:
            continue
        if left.raised and trouble != "swallowed":
            continue  # arrives as any exception
        reading = "full" if not trouble else "system-error"
        if trouble in ("", "translated") and (yield from takes(runtime, "exception-transport", reading)):
            yield check.kept()
            continue
        if trouble not in ("swallowed", "", "translated"):
            continue
        gave = f"{left.exception} with {_values(left.results)}" if left.exception else "an exception"
        got = f"{reply.exception} with {_values(reply.results)}" if reply.exception else "some other exception"
        observed = f"it returned {_values(reply.results)}" if trouble == "swallowed" else f"it ended with {got}"
        expected = f"ends as the server did, with {gave}"
        yield _violate(check, _EXCEPTIONS, trouble or "full", one, expected, observed)


@property_at("closed", _BLOCKING)
def service_blocks(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """No call comes back with an answer before its server's method was left."""
    settled = runtime.interactions.settled
    for one, trouble in undisturbed(runtime):
        left = one.exit
        if trouble == "early":
            expected = "comes back when the server's method has been left"
            yield _violate(check, _BLOCKING, trouble, one, expected, "it came back before")
            continue
        seen = [e for e in settled if e.worker == one.call.business.worker and e.where != "done"]
        if left is not None and one.served[0].was_held and any(one.served[0].enter.n < e.n < left.n for e in seen):
            yield check.kept()


@property_at("closed", _IN_FLIGHT)
def call_in_flight_ends(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """A call whose client or server is stopped, or whose connection is undone, brings what its server gave, or an exception."""
    for one in service_calls(runtime):
        ending = ended_by(runtime, one)
        if not ending or one.call.reply is None:
            continue
        reading = _how_it_ended(one, one.call.reply)
        was_inside = bool(one.served) and one.served[0].enter.n < min(o.begin.n for o in ending)
        if reading and (not was_inside or (yield from takes(runtime, "call-in-flight", reading))):
            yield check.kept()
            continue
        if reading == "finishes" and not _had_begun(runtime, ending, one):
            continue
        declared = runtime.ics.reading("call-in-flight")
        expected = f"{declared} as declared" if reading else "ends with what the server gave, or with an exception"
        happened = "it returned what the server gave" if reading == "finishes" else "it ended with an exception"
        observed = happened if reading else f"it returned {_values(one.call.reply.results)}"
        yield _violate(check, _IN_FLIGHT, reading or "invented", one, expected, observed)


@property_at("closed", _IN_FLIGHT, timed=True)
def nobody_is_left_hanging(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """Neither the call nor what stops its client or server, or undoes its connection, waits for ever."""
    for one in service_calls(runtime):
        ending = ended_by(runtime, one)
        for operation in ending:
            if operation.end is None and is_left_hanging(runtime, operation.step.thread, operation.begin.n):
                expected = f"and {s.operation(operation.step)}, called meanwhile, end once the server is let go"
                observed = f"{s.operation(operation.step)} did not end"
                yield _violate(check, _IN_FLIGHT, "operation", one, expected, observed)
        began = min((o.begin.n for o in ending), default=None)
        if began is not None and one.call.reply is None and not _hangs(runtime, one, began) and _hangs(runtime, one):
            expected = "ends once the server is let go"
            yield _violate(check, _IN_FLIGHT, "hangs", one, expected, "it did not end")


def _had_begun(runtime: ObservedRuntime, ending: Iterable[Operation], one: ServiceCall) -> bool:
    """Had an operation that ends the call come to its end, or to a place where it waits, when the server was let go?"""
    left = one.exit.n if one.exit is not None else math.inf
    settled = runtime.interactions.settled
    return any(
        (o.end is not None and o.end.n < left)
        or any(e.worker == o.step.thread and o.begin.n < e.n < left and e.where != "done" for e in settled)
        for o in ending
    )


def _how_it_ended(one: ServiceCall, reply: Reply) -> str:
    """``finishes`` or ``aborted``; empty if the server never gave what it brought back."""
    left = one.exit
    gave = (left.exception, left.results, left.raised) if left is not None and left.n < reply.n else None
    if gave == (reply.exception, reply.results, reply.raised):
        return "finishes"
    return "aborted" if reply.failed else ""


@property_at("closed", _CALLS)
def service_uncalled(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """A server is entered because a client of its own connection called."""
    explained = [led_astray(runtime, one) for one, trouble in undisturbed(runtime) if trouble == "elsewhere"]
    for delivery in strays(runtime):
        if any(delivery is other for other in explained) or _may_be_late(runtime, delivery.enter.n):
            continue
        enter = delivery.enter
        who = lane(*enter.body)
        yield check.fail(
            "no caller",
            expected=f"'{who}' is entered at {enter.port} when a client calls it",
            observed=f"{enter.method} was entered with {_values(enter.arguments)}, and no client had called that",
            at=(enter.n,),
        )


@property_at("closed", _CALLS)
def servers_that_left(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """A component that is no longer a server of the connection is not entered by calls through it.

    A client that has not been started again may still have the reference of the server itself: the text has no word on that.
    """
    interactions = runtime.interactions
    for delivery in interactions.deliveries:
        link, call, enter = delivery.link, delivery.call, delivery.enter
        if link is None or link.connector != s.SERVICE_CONNECTOR or call is None or call.link is not link:
            continue
        if delivery.fit == "same" and interactions.has_left(delivery, restarted=True):
            yield check.fail(
                "no server any more",
                expected=f"'{lane(*enter.body)}' is not called through {link.name}, which it was detached from",
                observed=f"a later call of {call.request.component} entered {enter.method}",
                at=(call.request.n, enter.n),
            )


def _may_be_late(runtime: ObservedRuntime, moment: int) -> bool:
    """Were connections undone, or broken, before? Then it is open what is still on its way."""
    undoing = (s.Detach, s.Break, s.Mend)
    return any(isinstance(o.step, undoing) and o.begin.n < moment for o in runtime.interactions.changes)


@property_at("linked", _CALLS, _CLIENTS, _ONE_SERVER, _TEMPLATE)
def connector_takes_its_ends(
    check: Property, runtime: ObservedRuntime, link: LinkState | None, step: s.ConnectorCall, end: Result
) -> Concluded:
    """While nothing is started, a connector can be had for each interface, and takes one server and any number of clients."""
    if any(container.started is not False for container in runtime.containers.values()):
        return ()
    if isinstance(step, s.Link):
        if step.connector == s.SERVICE_CONNECTOR and isinstance(end, Raise):
            others = [k for k in runtime.interactions.links.values() if k.connector == step.connector]
            if not others or not new_types(runtime, step):  # otherwise a matter of its types
                return _refused(check, _TEMPLATE if others else _CALLS, step, end, "made")
        return ()
    if isinstance(step, s.Attach) and link is not None and link.connector == s.SERVICE_CONNECTOR:
        return _attached(check, runtime, link, step, end)
    return ()


def _attached(check: Property, runtime: ObservedRuntime, link: LinkState, step: s.Attach, end: Result) -> Concluded:
    member = runtime.members.get(step.id)
    if member is None or member.suspended or member.declaration.ports.get(step.port) != link.interface:
        return ()
    last = link.ends[-1].since if link.ends else None
    if runtime.replaces_servers and isinstance(end, Return) and any(e.until == last for e in link.ends):
        return (Taken("second-server", "replace"), check.kept(_ONE_SERVER))
    before = [e for e in link.ends if e.until is None and (e.member, e.port) != (member, step.port)]
    servers = [e for e in before if e.role == "server"]
    if step.role == "server" and servers and step.port in member.declaration.provides:
        if isinstance(end, Raise):
            return _refused_second_server(check, runtime, step, end)
    elif isinstance(end, Raise) and _fits(link, step, bool(servers)):
        clients = [e for e in before if e.role == "client"]
        return _refused(check, _CLIENTS if step.role == "client" and clients else _CALLS, step, end, "attached")
    return ()


def _fits(link: LinkState, step: s.Attach, has_server: bool) -> bool:
    """Is it the server, or a client of a server that is there? Whether clients may come first is left open."""
    known = any((e.member.name, e.port) == (step.id, step.port) and e.until is None for e in link.ends)
    return not known and (step.role == "server" or (step.role == "client" and has_server))


def _refused(check: Property, requirement: str, step: s.Link | s.Attach, end: Raise, done: str) -> Finding:
    what = f"a connector for {step.interface}" if isinstance(step, s.Link) else f"{step.role} {step.id}"
    return check.refused(
        designation(step), end, expected=f"{what} is {done}", cause=f"not {done}", requirement=requirement
    )


def _refused_second_server(check: Property, runtime: ObservedRuntime, step: s.Attach, end: Raise) -> Conclusions:
    if end.error in _REFUSALS and (yield from takes(runtime, "second-server", "at-connect")):
        yield check.kept(_ONE_SERVER)
        return
    expected = "a second server is refused with BAD_PARAMETER or UCM_ERROR, unless at-start was declared"
    yield check.refused("attach", end, expected=expected, cause="refused otherwise", requirement=_ONE_SERVER)


@property_at("ended", _ONE_SERVER, at=("start",), feature="interactions")
def one_server(check: Property, runtime: ObservedRuntime, ongoing: OperationInProgress) -> Conclusions:
    """Two servers of one connection never are operational together."""
    links = runtime.interactions.improper()
    for link in (k for k in links if k.connector == s.SERVICE_CONNECTOR):
        servers = link.live("server")
        if len(servers) < 2 or all(e.member.container is not ongoing.container for e in link.live("server", "client")):
            continue
        started = [e for e in servers if e.member.container is ongoing.container or e.member.container.started]
        if isinstance(ongoing.end, Raise):
            if ongoing.end.error == "UCM_ERROR" and (yield from takes(runtime, "second-server", "at-start")):
                yield check.kept()
            elif ongoing.end.error == "UCM_ERROR":
                yield _started(check, ongoing, "it was to be refused at connect, as declared")
        elif len(started) == len(servers):
            yield _started(check, ongoing, "start returned")


def _started(check: Property, ongoing: OperationInProgress, observed: str) -> Finding:
    return check.fail(
        "two",
        expected="a connection with two servers is not started",
        observed=observed,
        ended=ongoing,
    )


def _violate(
    check: Property, requirement: str, cause: str, one: ServiceCall, expected: str, observed: str, *further: int
) -> Finding:
    request, reply = one.call.request, one.call.reply
    client, server = lane(*request.body), one.server.member.lane
    events = (request.n, *further, *(d.enter.n for d in one.served), *((reply.n,) if reply is not None else ()))
    return check.fail(
        cause,
        expected=f"the call of {request.method} by '{client}' {expected}",
        observed=observed,
        at=events,
        instead=(Arrow(client, server, request.method or ""), Arrow(server, client, "result")),
        requirement=requirement,
    )
