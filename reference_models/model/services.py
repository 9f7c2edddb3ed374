"""Calls through a service connector: the conditions under which they succeed, and their results (10.1.5.1)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Literal

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_types import AnyType
from ucm_cts.adapters.contract.trace import Exit, Raise, Reply
from ucm_cts.reference_models.model.links import LinkState
from ucm_cts.reference_models.model.messages import counts, settling_time
from ucm_cts.reference_models.model.method_calls import NEVER, Delivery, MethodCall, Operation
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.runtime import NO_ID, Member
from ucm_cts.reference_models.model.service_call import ServiceCall, Trouble
from ucm_cts.reference_models.model.values_carried import altered_calls

_OF_VALUES = ("arguments", "results", "translated")

_QUIET = 0.5
"""The part of patience in which nothing may have happened for a call to be left hanging."""

_NANOSECONDS = 1_000_000


def service_calls(runtime: ObservedRuntime) -> list[ServiceCall]:
    """All calls through service connectors that may rely on a server, and for which everything handed over has the right type."""
    if runtime.is_over and runtime.service_calls is not None:
        return runtime.service_calls
    typed = [call for call in runtime.interactions.calls if not call.is_mistyped]
    found = [c for call in typed if (c := _service_call(runtime, call))]
    runtime.service_calls = found
    return found


def _service_call(runtime: ObservedRuntime, call: MethodCall) -> ServiceCall | None:
    link = call.link
    if link is None or link.connector != s.SERVICE_CONNECTOR or not call.prepared or not call.ready:
        return None
    if call.broken or _may_be_broken(runtime, call):
        return None
    clients = [
        end
        for end in link.ends
        if end.role == "client" and end.member is call.caller and end.port == call.request.port
        if end.since < call.request.n and (end.until is None or end.until > call.request.n)
    ]
    servers = [end for end, ready in call.targets if ready]
    if len(clients) != 1 or len(servers) != 1 or len(call.targets) != 1:
        return None
    client, server = clients[0], servers[0]
    found = ServiceCall(call, link, client, server, runtime.scenario.interfaces[link.interface])
    others = [c for c in client.member.connections if c.port == client.port and c.id != NO_ID]
    unclear = others or _serves_several(runtime, server.member, server.port) or _comes_back(call, server.member)
    return found if found.method is not None and not unclear and not counts(server.member) else None


def _may_be_broken(runtime: ObservedRuntime, call: MethodCall) -> bool:
    """Was anything broken when it was made, or mended so lately that the connector need not know?

    Connections may share what is broken.
    """
    interactions = runtime.interactions
    if not any(link.was_broken for link in interactions.links.values()):
        return False
    last: dict[LinkState | None, Operation] = {}
    for o in interactions.changes:
        if isinstance(o.step, s.Break | s.Mend) and o.begin.n < call.request.n and not isinstance(o.end, Raise):
            last[o.link] = o
    known_by = call.request.t - settling_time(runtime)
    return any(isinstance(o.step, s.Break) or o.end is None or o.end.t > known_by for o in last.values())


def _serves_several(runtime: ObservedRuntime, member: Member | None, port: str | None) -> bool:
    """Is or was the port element an end of several connections, so that it is open which one led to it?"""
    links = runtime.interactions.links.values()
    return sum(any(e.member is member and e.port == port for e in link.ends) for link in links) > 1


def _comes_back(call: MethodCall, server: Member) -> bool:
    """Is the server among the bodies that wait for this call?"""
    return call.business.leads_back_to(server)


def is_nested(one: ServiceCall) -> bool:
    """Did its client make it while it was called itself through a connector, or got a message?"""
    return any(caller.enter.method is not None for caller in one.call.business.callers())


def changes_beside(runtime: ObservedRuntime, one: ServiceCall) -> list[Operation]:
    """The operations that change something and were in progress while the call was."""
    begin, end = one.call.request.n, one.over
    return [o for o in runtime.interactions.changes if o.overlaps(begin, end)]


def disturbed_at(runtime: ObservedRuntime, one: ServiceCall) -> int | None:
    """When something began, while it was in progress or before, that may be a reason not to carry it out."""
    beside = changes_beside(runtime, one)
    disturbing = [o for o in beside if o.step.undoes == "phase" or _takes_away(runtime, one, o)]
    return min((o.begin.n for o in disturbing), default=None)


def is_disturbed(runtime: ObservedRuntime, one: ServiceCall) -> bool:
    """Was anything in progress beside it that may be a reason not to carry it out?"""
    return disturbed_at(runtime, one) is not None


def _takes_away(runtime: ObservedRuntime, one: ServiceCall, operation: Operation) -> bool:
    """Does it undo the call's connection, or break or mend any?"""
    step = operation.step
    if not isinstance(step, s.Detach):
        return isinstance(step, s.Break | s.Mend)
    ends = (one.client, one.server)
    return operation.link is one.link and any((operation.member, step.port) == (end.member, end.port) for end in ends)


def ended_by(runtime: ObservedRuntime, one: ServiceCall) -> list[Operation]:
    """The operations that stopped its client or server, or undid its connection, once it had been made."""
    containers = (one.client.member.container, one.server.member.container)
    return [
        o
        for o in changes_beside(runtime, one)
        if o.begin.n > one.call.request.n and not isinstance(o.end, Raise)
        if (isinstance(o.step, s.Stop) and o.container in containers)
        or (isinstance(o.step, s.Detach) and _takes_away(runtime, one, o))
    ]


def is_left_hanging(runtime: ObservedRuntime, worker: str | None, since: int, until: int | None = None) -> bool:
    """Was ``worker`` waited for in vain, between these events, while no body was held and nothing happened?"""
    quiet = runtime.scenario.patience * _NANOSECONDS * _QUIET
    return worker is not None and any(
        isinstance(wait.step, s.Join)
        and wait.step.worker == worker
        and since < wait.timeout.n < (until or NEVER)
        and not wait.held
        and wait.timeout.t - wait.quiet_since >= quiet
        for wait in runtime.interactions.waits
    )


def strays(runtime: ObservedRuntime) -> Iterator[Delivery]:
    """Entries into servers that no call through their connector led to, where every call is known."""
    interactions = runtime.interactions
    unknown = {call.request.method for call in interactions.calls if call.caller is None or call.link is None}
    for delivery in interactions.deliveries:
        link = delivery.link
        if link is None or link.connector != s.SERVICE_CONNECTOR or delivery.call is not None or delivery.enter.wrong:
            continue
        if delivery.enter.method not in unknown and not _serves_several(
            runtime, delivery.receiver, delivery.enter.port
        ):
            yield delivery


def led_astray(runtime: ObservedRuntime, one: ServiceCall) -> Delivery | None:
    """The entry of another server, or at another port, that the call seems to have led to."""
    request = one.call.request
    for delivery in runtime.interactions.deliveries:
        enter = delivery.enter
        same = (enter.method, enter.arguments) == (request.method, request.arguments)
        known = delivery.call is None or (delivery.call is one.call and delivery not in one.served)
        if known and same and request.n < enter.n < one.over:
            return delivery
    return None


def trouble_with(runtime: ObservedRuntime, one: ServiceCall) -> Trouble:
    """What went wrong with a call that came back and that nothing disturbed."""
    reply, served = one.call.reply, one.served
    assert reply is not None
    if not served:
        return "elsewhere" if led_astray(runtime, one) is not None else "not served"
    if len(served) > 1:
        return "twice"
    if served[0].fit == "altered":
        return "arguments"
    left = served[0].exit
    if left is None or left.n > reply.n:
        return "failed" if reply.raised else "early"
    return _answered(left, reply)


def undisturbed(runtime: ObservedRuntime) -> list[tuple[ServiceCall, Trouble]]:
    """The calls that came back and that nothing disturbed, each with what is wrong with it; none whose values were altered
    for their types' sake, which is the matter of 10.1.1.
    """
    if runtime.undisturbed is not None:
        return runtime.undisturbed
    calls = [one for one in service_calls(runtime) if one.call.reply is not None and not is_disturbed(runtime, one)]
    judged = [(one, trouble_with(runtime, one)) for one in calls]
    altered = altered_calls(runtime) if any(trouble in _OF_VALUES for _, trouble in judged) else ()
    found = [(one, trouble) for one, trouble in judged if one.call not in altered]
    if runtime.is_over:
        runtime.undisturbed = found
    return found


def shared_links(calls: Iterable[ServiceCall]) -> frozenset[int]:
    """The links, by ``id()``, through which several clients made ``calls``."""
    clients: dict[int, set[int]] = {}
    for one in calls:
        clients.setdefault(id(one.link), set()).add(id(one.client))
    return frozenset(link for link, of in clients.items() if len(of) > 1)


def _answered(left: Exit, reply: Reply) -> Trouble:
    normally = not reply.failed
    if left.failed:
        same = left.raised or (left.exception, left.results) == (reply.exception, reply.results)
        return "swallowed" if normally else "" if same else "translated"
    if not normally:
        return "failed"
    return "" if left.results == reply.results else "results"


def what_sets_apart(
    runtime: ObservedRuntime, one: ServiceCall, served: Sequence[ServiceCall]
) -> Literal["", "inherited", "second server", "client"]:
    """How a call that is not carried out differs from those that are ``served``: by an inherited method, a connection that
    was to have a second server, or another client; not if its connection had been mended.
    """
    if one.is_inherited:
        return "inherited"
    if runtime.interactions.has_refused(one.link, "server"):
        return "second server"
    if _was_mended(runtime, one):
        return ""
    others = any(other.link is one.link and other.client is not one.client for other in served)
    return "client" if others else ""


def _was_mended(runtime: ObservedRuntime, one: ServiceCall) -> bool:
    return any(
        isinstance(o.step, s.Mend) and o.link is one.link and o.begin.n < one.call.request.n
        for o in runtime.interactions.changes
    )


def new_types(runtime: ObservedRuntime, step: s.Link) -> list[AnyType]:
    """The types that it is bound to, or has in its interface, and no connector of that kind has in this runtime."""
    links = runtime.interactions.links.values()
    known = [of for k in links if k.connector == step.connector for of in _types_at(runtime, k.interface)]
    return [of for of in _types_at(runtime, step.interface) if of not in known]


def _types_at(runtime: ObservedRuntime, name: str) -> list[AnyType]:
    bound = runtime.scenario.types.get(name)
    if bound is not None:
        return list(bound.values())
    interface = runtime.scenario.interfaces[name]
    return [parameter.of for method in interface.methods.values() for parameter in method.parameters]
