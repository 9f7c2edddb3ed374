"""Properties about connections with the shared-data connector: their ends, their codes, and calls that come back (10.4.2)."""

from __future__ import annotations

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_values import printed
from ucm_cts.adapters.contract.platform_interfaces import CANCEL, FREEZE, PUBLISH, READ, RELEASE, SHARED_DATA, WRITE
from ucm_cts.adapters.contract.trace import Raise, Return
from ucm_cts.reference_models.conclusions import Concluded, Conclusions, takes
from ucm_cts.reference_models.findings import Finding
from ucm_cts.reference_models.model.designation import designation
from ucm_cts.reference_models.model.extended_links import fits
from ucm_cts.reference_models.model.links import LinkState
from ucm_cts.reference_models.model.messages import CODES, COMM_ERROR, OK, settling_time
from ucm_cts.reference_models.model.method_calls import MethodCall
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.operation import OperationInProgress, Result
from ucm_cts.reference_models.model.runtime import lane
from ucm_cts.reference_models.model.services import is_left_hanging
from ucm_cts.reference_models.model.shared_data import all_shared_data, changes, is_disturbed
from ucm_cts.reference_models.model.shared_data_events import Reader, Session, SharedData, are_of_one_end, is_ok
from ucm_cts.reference_models.model.shared_data_views import state_at
from ucm_cts.reference_models.properties.declaration import Property, property_at

_WHEN, _TYPES = "R-10.4.2-03", "R-10.4.2-08"
_SUPPORTED, _CODES, _BROKEN = "R-10.4.2.1-21", "R-10.4.2.1-22", "R-10.4.2.1-23"
_READERS_METHODS, _WRITERS_METHODS, _NOT_BLOCKED = "R-10.4.2.2-01", "R-10.4.2.2-14", "R-10.4.2.2-11"
_FREEZES, _AGAIN = "R-10.4.2.2-09", "R-10.4.2.2-13"

_NEITHER = ("internal_error", OK)
"""The codes of a call that has nothing to do (interpretation shared-data-codes)."""


@property_at("linked", _SUPPORTED, _TYPES, feature="extended")
def shared_data_connector(
    check: Property, runtime: ObservedRuntime, link: LinkState | None, step: s.ConnectorCall, end: Result
) -> Conclusions:
    """While nothing is started, a connector can be had for all types, and takes any number of writers and readers."""
    if any(container.started is not False for container in runtime.containers.values()):
        return
    if isinstance(step, s.Link) and step.connector == SHARED_DATA and isinstance(end, Raise):
        others = [k for k in runtime.interactions.links.values() if k.connector == step.connector]
        yield _refused(check, _TYPES if others else _SUPPORTED, step, end, "the connector is made")
    elif isinstance(step, s.Attach) and link is not None and link.connector == SHARED_DATA:
        member = runtime.members.get(step.id)
        if member is None or member.suspended or not fits(runtime, member, step, link):
            return
        if isinstance(end, Raise):
            yield _refused(check, _SUPPORTED, step, end, "it is attached")
        else:
            yield check.kept(_SUPPORTED)


def _refused(check: Property, requirement: str, step: s.Link | s.Attach, end: Raise, expected: str) -> Finding:
    return check.refused(designation(step), end, expected=expected, cause="refused", requirement=requirement)


@property_at("ended", _SUPPORTED, at=("start",), feature="extended")
def shared_data_started(check: Property, runtime: ObservedRuntime, ongoing: OperationInProgress) -> Conclusions:
    """Writers and readers that are joined by the connector are started."""
    members = ongoing.container.live_members()
    links = [
        k for k in runtime.interactions.links.values() if any(e.member in members for e in (*k.senders, *k.takers))
    ]
    if len(links) != 1 or links[0].connector != SHARED_DATA or not links[0].is_proper:
        return
    if not all(m.connected and m.is_sound for m in members) or ongoing.container.started:
        return
    if isinstance(ongoing.end, Return):
        yield check.kept(_SUPPORTED)
    elif runtime.interactions.links.keys() == {links[0].name}:
        expected = "components that a shared-data connector joins are started"
        yield check.refused("start", ongoing.end, expected=expected, requirement=_SUPPORTED)


@property_at("completed", _CODES, _BROKEN, timed=True, feature="extended")
def shared_data_codes(check: Property, runtime: ObservedRuntime, call: MethodCall) -> Concluded:
    """Each method gives one of the three codes, and publish_data another one than ok while nothing can be transmitted."""
    link, reply = call.link, call.reply
    if link is None or link.connector != SHARED_DATA or reply is None or not call.ready or reply.wrong or reply.failed:
        return ()
    code = call.code_of_results
    if code not in CODES:
        return check.fail(
            "unknown code",
            expected=f"{_name(call)} gives {' or '.join(CODES)}",
            observed=f"it gave {printed(reply.results or ())}",
            at=(call.request.n, reply.n),
            requirement=_CODES,
        )
    if not link.broken or link.broken_at > call.request.t or call.request.method != PUBLISH:
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


@property_at("closed", _CODES, _BROKEN, _FREEZES, _AGAIN, feature="extended")
def shared_data_contented(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """A call that does its work while nothing is broken gives ok; one that has nothing to do gives ok or internal_error."""
    for found in all_shared_data(runtime):
        for call in found.operations:
            if not _is_judged(runtime, call):
                continue
            method = call.request.method
            is_held = any(state_at(reader, call)[0] != "free" for reader in found.readers)
            if method == PUBLISH and is_held and runtime.ics.reading("freeze-scope") == "connection":
                continue
            works = method == WRITE or _is_set(runtime, found, call)
            mended = bool(found.link.mended_at) and call.request.t > found.link.mended_at
            yield from _code(check, call, works, _BROKEN if mended and method == PUBLISH else _CODES)
        for reader in found.readers:
            for call in reader.calls:
                if _is_judged(runtime, call) and call.request.method != READ:
                    yield from _code_of_freezing(check, runtime, reader, call)


def _is_judged(runtime: ObservedRuntime, call: MethodCall) -> bool:
    """Did it come back with one of the codes, and was nothing changed or broken meanwhile or so lately that it need not be known?"""
    mended_at = call.link.mended_at if call.link is not None else 0
    is_late = not mended_at or call.request.t - mended_at >= settling_time(runtime)
    return call.code_of_results in CODES and not is_disturbed(runtime, call) and is_late


def _is_set(runtime: ObservedRuntime, found: SharedData, call: MethodCall) -> bool:
    """Has its writer surely set a value, under all readings, when it makes ``call``?"""
    own = [o for o in found.operations if are_of_one_end(o, call) and o.request.n < call.request.n]
    alone = (
        all(are_of_one_end(o, call) for o in found.operations) or runtime.ics.reading("pending-value") == "per-writer"
    )
    if not alone or not own or own[-1].request.method != WRITE or not is_ok(own[-1]) or own[-1].broken:
        return False
    return not any(o.overlaps(own[-1].request.n, call.over) for o in changes(runtime, found.link))


def _code_of_freezing(check: Property, runtime: ObservedRuntime, reader: Reader, call: MethodCall) -> Conclusions:
    state, session = state_at(reader, call)
    if call.request.method == FREEZE:
        if state == "frozen" or state == "unclear":
            refused = not is_ok(call)
            if refused and not (yield from takes(runtime, "nested-freeze", "refused")):
                yield _wrong_code(check, call, "gives ok, as declared", _CODES)
            return
        yield from _code(check, call, True, _AGAIN if session is not None else _CODES)
    else:
        works = state == "frozen" and session is not None and not session.nested
        yield from _code(check, call, works, _CODES)


def _code(check: Property, call: MethodCall, works: bool, requirement: str) -> Conclusions:
    code = call.code_of_results
    if works and code != OK:
        yield _wrong_code(check, call, "gives ok: it has something to do, and nothing is broken", requirement)
    elif code == COMM_ERROR:
        yield _wrong_code(check, call, f"gives {' or '.join(_NEITHER)}: nothing is broken", requirement)
    elif works:
        yield check.kept(requirement)


def _wrong_code(check: Property, call: MethodCall, expected: str, requirement: str) -> Finding:
    reply = call.reply
    return check.fail(
        "code",
        expected=f"{_name(call)} {expected}",
        observed=f"it gave {call.code_of_results}",
        at=(call.request.n, *((reply.n,) if reply is not None else ())),
        requirement=requirement,
    )


@property_at("closed", _READERS_METHODS, _WRITERS_METHODS, _NOT_BLOCKED, _WHEN, timed=True, feature="extended")
def shared_data_calls_return(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """All methods of readers and writers come back, whoever is frozen, with a code and no exception."""
    for found in all_shared_data(runtime):
        for call in found.operations:
            frozen = any(_is_frozen(session, call) for reader in found.readers for session in reader.sessions)
            yield from _returned(check, runtime, call, _NOT_BLOCKED if frozen else _WRITERS_METHODS)
            if frozen and call.reply is not None:
                yield check.kept(_NOT_BLOCKED)
        for reader in found.readers:
            for call in reader.calls:
                requirement = _WHEN if call.request.method == READ else _READERS_METHODS
                yield from _returned(check, runtime, call, requirement)
            if {FREEZE, RELEASE, READ} <= {c.request.method for c in reader.calls if c.code_of_results in CODES}:
                yield check.kept(_READERS_METHODS)
        for caller in {id(c.caller): c.caller for c in found.operations}.values():
            own = {c.request.method for c in found.operations if c.caller is caller and c.code_of_results in CODES}
            if {WRITE, PUBLISH, CANCEL} <= own:
                yield check.kept(_WRITERS_METHODS)


def _is_frozen(session: Session, call: MethodCall) -> bool:
    """Was the reader frozen when the call was made?"""
    begun = session.freeze.over < call.request.n
    return begun and (session.released is None or session.released.request.n > call.request.n)


def _returned(check: Property, runtime: ObservedRuntime, call: MethodCall, requirement: str) -> Conclusions:
    reply = call.reply
    if not call.ready or not call.prepared or call.broken:
        return
    if is_left_hanging(runtime, call.business.worker, call.request.n, call.over):
        cause, observed, at = "hangs", "it did not, within patience", [call.request.n]
    elif reply is not None and reply.failed and not is_disturbed(runtime, call):
        cause, observed, at = "raised", "it raised an exception", [call.request.n, reply.n]
    else:
        return
    expected = f"{_name(call)} returns"
    yield check.fail(cause, expected=expected, observed=observed, at=tuple(at), requirement=requirement)


def _name(call: MethodCall) -> str:
    return f"{call.request.method} of '{lane(*call.request.body)}'"
