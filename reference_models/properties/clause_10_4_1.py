"""Properties about connections with the request-response connector: their ends, their servers and their codes (10.4.1.1)."""

from __future__ import annotations

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_values import printed
from ucm_cts.adapters.contract.platform_interfaces import CONNECTOR_PORTS, REQUEST, REQUEST_RESPONSE
from ucm_cts.adapters.contract.trace import Raise, Return
from ucm_cts.reference_models.conclusions import Concluded, Conclusions, takes
from ucm_cts.reference_models.findings import Finding
from ucm_cts.reference_models.model.designation import designation
from ucm_cts.reference_models.model.extended_links import changes_between, fits
from ucm_cts.reference_models.model.links import End, LinkState
from ucm_cts.reference_models.model.messages import CODES, OK, settling_time
from ucm_cts.reference_models.model.method_calls import MethodCall
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.operation import OperationInProgress, Result
from ucm_cts.reference_models.model.requests import fails
from ucm_cts.reference_models.model.runtime import lane
from ucm_cts.reference_models.properties.declaration import Property, property_at

_ONE_SERVER, _EITHER_KIND = "R-10.4.1.1-07", "R-10.4.1.1-30"
_SUPPORTED, _PAIRS, _TYPES = "R-10.4.1.1-31", "R-10.4.1.1-32", "R-10.4.1.1-33"
_CODES, _BROKEN = "R-10.4.1.1-34", "R-10.4.1.1-35"

_REFUSALS = ("BAD_PARAMETER", "UCM_ERROR")


@property_at("linked", _SUPPORTED, _ONE_SERVER, _EITHER_KIND, _PAIRS, _TYPES, feature="extended")
def request_connector(
    check: Property, runtime: ObservedRuntime, link: LinkState | None, step: s.ConnectorCall, end: Result
) -> Conclusions:
    """While nothing is started, a connector can be had for all types, and takes one server and any number of clients."""
    if any(container.started is not False for container in runtime.containers.values()):
        return
    if isinstance(step, s.Link) and step.connector == REQUEST_RESPONSE and isinstance(end, Raise):
        others = [k for k in runtime.interactions.links.values() if k.connector == step.connector]
        yield _refused(check, _TYPES if others else _SUPPORTED, step, end, "the connector is made")
    elif isinstance(step, s.Attach) and link is not None and link.connector == REQUEST_RESPONSE:
        member = runtime.members.get(step.id)
        if member is not None and not member.suspended and fits(runtime, member, step, link):
            yield from _attached(check, runtime, link, step, end)


def _attached(check: Property, runtime: ObservedRuntime, link: LinkState, step: s.Attach, end: Result) -> Conclusions:
    kind = CONNECTOR_PORTS[step.role]
    before = [e for e in (*link.senders, *link.takers) if (e.member, e.of) != (runtime.members[step.id], step.port)]
    servers = [e for e in before if e.side == "server"]
    if kind.side == "server" and servers:
        if isinstance(end, Raise):
            both = any(e.role != step.role for e in servers)
            if end.error not in _REFUSALS:
                expected = "a second server is refused with BAD_PARAMETER or UCM_ERROR"
                yield check.refused(
                    "attach", end, expected=expected, cause="refused otherwise", requirement=_ONE_SERVER
                )
            else:
                yield check.kept(_EITHER_KIND if both else _ONE_SERVER)
        return
    mixed = [e for e in before if e.is_synchronous != (len(kind.elements) == 1)]
    if isinstance(end, Return):
        if before:
            yield check.kept(_SUPPORTED)
        return
    if mixed and end.error in _REFUSALS:
        for option, value in _reasons_to_refuse(mixed, kind.side):
            if (yield from takes(runtime, option, value)):
                return
    yield _refused(check, _PAIRS if mixed else _SUPPORTED, step, end, "it is attached")


def _reasons_to_refuse(mixed: list[End], side: str) -> list[tuple[str, str]]:
    """Readings by which an end is refused beside ends of the other kind: clients beside clients, or beside a server."""
    beside = {e.side == side for e in mixed}
    readings = {True: ("mixed-clients", "one-kind"), False: ("mixed-pairings", "same-kind")}
    return [readings[same] for same in sorted(beside)]


def _refused(check: Property, requirement: str, step: s.Link | s.Attach, end: Raise, expected: str) -> Finding:
    return check.refused(designation(step), end, expected=expected, cause="refused", requirement=requirement)


@property_at("ended", _SUPPORTED, _ONE_SERVER, _EITHER_KIND, _PAIRS, at=("start",), feature="extended")
def requests_started(check: Property, runtime: ObservedRuntime, ongoing: OperationInProgress) -> Conclusions:
    """Components that are joined by the connector are started, unless it has two servers."""
    members = ongoing.container.live_members()
    links = [
        k
        for k in runtime.interactions.links.values()
        if k.connector == REQUEST_RESPONSE and any(e.member in members for e in (*k.senders, *k.takers))
    ]
    for link in links:
        ends = [*link.senders, *link.takers]
        servers = {(id(e.member), e.of): e for e in ends if e.side == "server"}
        if len(servers) > 1:
            both = len({e.role for e in servers.values()}) > 1
            requirement = _EITHER_KIND if both else _ONE_SERVER
            if isinstance(ongoing.end, Raise):
                yield check.kept(requirement)
            elif all(e.member in members or e.member.container.started for e in servers.values()):
                yield check.fail(
                    "two servers",
                    expected=f"{link.name}, which has {'both kinds of server' if both else 'two servers'}, is not started",
                    observed="start returned",
                    ended=ongoing,
                    requirement=requirement,
                )
    if len(links) != 1 or not links[0].is_proper or not all(m.connected and m.is_sound for m in members):
        return
    ends = [*links[0].senders, *links[0].takers]
    if isinstance(ongoing.end, Return):
        if ongoing.judged and all(e.member in members for e in ends):
            yield check.kept(_SUPPORTED)
    elif runtime.interactions.links.keys() == {links[0].name} and not ongoing.container.started:
        mixed = len({e.is_synchronous for e in ends}) > 1
        clients = len({e.is_synchronous for e in ends if e.side == "client"}) > 1
        option, value = ("mixed-clients", "one-kind") if clients else ("mixed-pairings", "same-kind")
        if not mixed or not (yield from takes(runtime, option, value)):
            yield check.refused(
                "start",
                ongoing.end,
                expected="components that a request-response connector joins are started",
                requirement=_PAIRS if mixed else _SUPPORTED,
            )


@property_at("completed", _CODES, _BROKEN, timed=True, feature="extended")
def request_codes(check: Property, runtime: ObservedRuntime, call: MethodCall) -> Concluded:
    """Each method gives one of the three codes, and another one than ok while nothing can be transmitted."""
    link, reply = call.link, call.reply
    if link is None or link.connector != REQUEST_RESPONSE or reply is None or not call.ready or reply.wrong:
        return ()
    if reply.failed:
        return ()
    code = call.code_of_results
    if code not in CODES:
        expected = f"{_name(call)} gives {' or '.join(CODES)}"
        return check.fail(
            "unknown code",
            expected=expected,
            observed=f"it gave {printed(reply.results or ())}",
            at=(call.request.n, reply.n),
        )
    if not link.broken:
        return _after_mending(check, runtime, call, link)
    if link.broken_at > call.request.t:
        return ()
    if code != OK:
        return check.kept(_BROKEN)
    if call.request.t - link.broken_at < settling_time(runtime):
        return ()
    return check.fail(
        "ok while broken",
        expected=f"{_name(call)} does not give ok: the {link.broken} of its connection is broken",
        observed="it gave ok",
        at=(call.request.n, reply.n),
        requirement=_BROKEN,
    )


def _after_mending(check: Property, runtime: ObservedRuntime, call: MethodCall, link: LinkState) -> Concluded:
    """Once mended and known to be, it carries requests as before."""
    reply = call.reply
    if reply is None or not link.mended_at or call.request.t - link.mended_at < settling_time(runtime):
        return ()
    well = call.prepared and call.targets and all(ready and not fails(end) for end, ready in call.targets)
    if not well or call.request.method != REQUEST or next(changes_between(runtime, call.request.n, reply.n), None):
        return ()
    if call.code_of_results == OK:
        return check.kept(_BROKEN)
    return check.fail(
        "not ok after mending",
        expected=f"{_name(call)} gives ok: its connection was mended",
        observed=f"it gave {call.code_of_results}",
        at=(call.request.n, reply.n),
        requirement=_BROKEN,
    )


def _name(call: MethodCall) -> str:
    return f"{call.request.method} of '{lane(*call.request.body)}'"
