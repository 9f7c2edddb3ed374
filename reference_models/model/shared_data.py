"""Publications, freezes and notifications of shared-data connections (10.4.2), put together when the trace is over.

A publication sends what its writer has set since the last one; whether another writer may set it, too, and whether a value is
sent again, the text leaves open, so that a publication may have several values. Calls that overlap have no order.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from itertools import pairwise

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_types import Datum, Integer
from ucm_cts.adapters.contract.platform_interfaces import (
    CANCEL,
    FREEZE,
    NOTIFY,
    READ,
    RELEASE,
    SHARED,
    SHARED_DATA,
    WRITE,
)
from ucm_cts.reference_models.model.extended_links import end_at
from ucm_cts.reference_models.model.links import LinkState
from ucm_cts.reference_models.model.method_calls import Delivery, MethodCall, Operation
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.shared_data_events import (
    Publication,
    Reader,
    Session,
    SharedData,
    Source,
    is_ok,
    written,
)

_PLAIN = Integer("LONG")


def all_shared_data(runtime: ObservedRuntime) -> list[SharedData]:
    """What happened through each shared-data connection. The trace must be over."""
    if runtime.shared_data is None:
        links = [k for k in runtime.interactions.links.values() if k.connector == SHARED_DATA]
        runtime.shared_data = [_put_together(runtime, link) for link in links]
    return runtime.shared_data


def changes(runtime: ObservedRuntime, link: LinkState) -> list[Operation]:
    """The operations that start, stop or join components of ``link``, or disturb connections: what was published before one of them
    need not be there afterwards.
    """
    places = [end.member.container for end in link.ends]
    return [o for o in runtime.interactions.changes if _concerns(link, places, o)]


def _concerns(link: LinkState, places: Sequence[object], operation: Operation) -> bool:
    step = operation.step
    if isinstance(step, s.Break | s.Mend):
        return True  # connections may share what is broken
    if isinstance(step, s.Attach | s.Detach):
        return operation.link is link
    if not step.undoes and not isinstance(step, s.Start):
        return False
    return operation.container is None or operation.container in places


def is_disturbed(runtime: ObservedRuntime, call: MethodCall) -> bool:
    """Was something changed or broken while it was made?"""
    link = call.link
    if link is None or call.broken or not call.ready or not call.prepared:
        return True
    return any(o.overlaps(call.request.n, call.over) for o in changes(runtime, link))


def _put_together(runtime: ObservedRuntime, link: LinkState) -> SharedData:
    types = runtime.scenario.types[link.interface]
    found = SharedData(link, types[SHARED] == _PLAIN)
    readers: dict[tuple[int, str], Reader] = {}
    writers: dict[MethodCall, object] = {}
    for call in (c for c in runtime.interactions.calls if c.link is link):
        end = end_at(link, call.caller, call.request.port, call.request.n)
        if end is None:
            continue
        if end.side == "writer":
            for target, _ in call.targets:  # one that never reads, and is never notified, is a reader, too
                readers.setdefault((id(target.member), target.of), Reader(target))
            found.operations.append(call)
            if call.request.method not in (WRITE, CANCEL):
                found.publications.append(Publication(call, end, (), "nothing"))
            writers[call] = end
        elif end.side == "reader":
            reader = readers.setdefault((id(end.member), end.of), Reader(end))
            reader.calls.append(call)
    for delivery in (d for d in runtime.interactions.deliveries if d.link is link and d.enter.method == NOTIFY):
        end = end_at(link, delivery.receiver, delivery.enter.port or "", delivery.enter.n)
        if end is not None and end.side == "reader":
            readers.setdefault((id(end.member), end.of), Reader(end)).notices.append(delivery)
    found.readers = list(readers.values())
    publications = [_completed(runtime, found, one, writers) for one in found.publications]
    found.publications = [one for one in publications if one.values]
    found.voids = [one for one in publications if not one.values]
    for reader in found.readers:
        reader.reads = [c for c in reader.calls if c.request.method == READ]
        _find_sessions(runtime, found, reader)
        reader.heard_of = _heard_of(runtime, found, reader)
    return found


def _completed(
    runtime: ObservedRuntime, found: SharedData, bare: Publication, writers: dict[MethodCall, object]
) -> Publication:
    """The publication with what it sent."""
    before = [o for o in found.operations if o.request.n < bare.since]
    own = [o for o in before if writers[o] is bare.writer]
    source, value = _set_by(own)
    outcomes: list[tuple[Source, tuple[Datum, ...]]] = [(source, (value,) if value is not None else ())]
    if len({id(end) for end in writers.values()}) > 1 and runtime.ics.permits("pending-value", "shared"):
        by_all = _set_by_all(found, bare, before)
        outcomes = [*outcomes, by_all] if runtime.ics.permits("pending-value", "per-writer") else [by_all]
    values = tuple(_distinct(value for _, values in outcomes for value in values))
    writes = _since_last(own)
    if any(o.broken for o in (writes or own)):  # nobody knows what became of it
        values, source = tuple(_distinct(v for o in own if (v := written(o)) is not None)), "repeated"
    is_sure = all(source == "written" for source, _ in outcomes) and all(map(is_ok, (*writes, bare.call)))
    first = writes[0].request.n if writes else own[-1].request.n if own else bare.since
    is_changed = any(o.overlaps(first, bare.over) for o in changes(runtime, found.link))
    if is_changed and runtime.ics.permits("publish-twice", "again"):  # what was written may be lost
        _, earlier = _set_by(own[: len(own) - len(writes)])
        values = tuple(_distinct((*values, *((earlier,) if earlier is not None else ()))))
    return replace(
        bare,
        values=values,
        source=source,
        is_sure=is_sure and source == "written" and not is_disturbed(runtime, bare.call) and not is_changed,
        writes=writes,
        cancelled=_cancelled(own),
        crossed=tuple(
            o for o in found.operations if writers[o] is not bare.writer and o.over > first and o.request.n < bare.over
        ),
    )


def _set_by(operations: Sequence[MethodCall]) -> tuple[Source, Datum | None]:
    """What these, in this order, have set."""
    source: Source = "nothing"
    value: Datum | None = None
    for operation in operations:
        if operation.request.method == WRITE:
            source, value = "written", written(operation)
        elif operation.request.method == CANCEL:
            source, value = "cancelled" if source != "nothing" else source, None
        elif source == "written":
            source = "repeated"
    return source, value


def _set_by_all(found: SharedData, bare: Publication, before: Sequence[MethodCall]) -> tuple[Source, tuple[Datum, ...]]:
    """The same if all writers set one value. Calls that overlap may have any order."""
    others = [o for o in found.operations if o is not bare.call and o.request.n < bare.over]
    in_order = all(one.over < other.request.n for one, other in pairwise((*others, bare.call)))
    if in_order:
        source, value = _set_by(before)
        return source, (value,) if value is not None else ()
    return "repeated", tuple(v for o in others if o.request.method == WRITE and (v := written(o)) is not None)


def _since_last(own: Sequence[MethodCall]) -> tuple[MethodCall, ...]:
    """The writes after all other calls of a writer."""
    last: list[MethodCall] = []
    for operation in reversed(own):
        if operation.request.method != WRITE:
            break
        last.insert(0, operation)
    return tuple(last)


def _cancelled(own: Sequence[MethodCall]) -> tuple[Datum, ...]:
    """The values that a writer set and cancelled since its last publication."""
    values: list[Datum] = []
    cancelled: list[Datum] = []
    for operation in own:
        if operation.request.method == WRITE and (value := written(operation)) is not None:
            values.append(value)
        elif operation.request.method == CANCEL:
            cancelled, values = [*cancelled, *values], []
        else:
            cancelled, values = [], []
    return tuple(cancelled)


def _distinct(values: Iterable[Datum]) -> list[Datum]:
    found: list[Datum] = []
    for value in values:
        if value not in found:
            found.append(value)
    return found


def _find_sessions(runtime: ObservedRuntime, found: SharedData, reader: Reader) -> None:
    """``flat`` and ``counted`` are the depths of freezing by reading: one release ends all, or as many as freezes."""
    may_count = runtime.ics.permits("nested-freeze", "counted")
    must_count = runtime.ics.reading("nested-freeze") == "counted"
    stops = [o.begin.n for o in changes(runtime, found.link)]
    session: Session | None = None
    flat = counted = 0
    for call in (c for c in reader.calls if c.request.method in (FREEZE, RELEASE)):
        _note_stops(session, [stop for stop in stops if stop < call.request.n])
        if call.request.method == FREEZE:
            if session is None:
                session = Session(call, len(reader.sessions) + 1)
                reader.sessions.append(session)
                flat = counted = 1
            else:
                session.nested.append(call)
                flat, counted = 1, counted + (1 if is_ok(call) else 0)
            continue
        if session is None:
            reader.idle_releases.append(call)
            continue
        flat, counted = 0, counted - 1
        if not may_count:
            counted = 0
        if must_count:
            flat = counted
        if max(flat, counted) <= 0:
            session.released, session = call, None
        elif flat <= 0:
            session.unclear_since = min(session.unclear_since, call.request.n)
    _note_stops(session, stops)


def _note_stops(session: Session | None, stops: Sequence[int]) -> None:
    """A stop may end a freeze."""
    if session is not None:
        after = [stop for stop in stops if stop > session.freeze.request.n]
        session.unclear_since = min((session.unclear_since, *after))
        session.is_stopped = session.is_stopped or bool(after)


def _heard_of(runtime: ObservedRuntime, found: SharedData, reader: Reader) -> dict[int, int]:
    """By publication, the notification by which the reader had surely been told of it.

    A notification may be for any publication that it was not told of so far, and after a start one may be for what had been
    published before.
    """
    happened: list[tuple[int, Publication | Delivery | None]] = [(one.since, one) for one in found.publications]
    happened += [(notice.enter.n, notice) for notice in reader.notices]
    happened += [(o.begin.n, None) for o in changes(runtime, found.link)]
    told: dict[int, int] = {}
    waiting: list[Publication] = []
    heard = spare = 0
    for moment, one in sorted(happened, key=lambda pair: pair[0]):
        if one is None:
            again = 1 if any(p.since < moment for p in found.publications) else 0
            spare, waiting, heard = again + max(len(waiting) + spare - heard, 0), [], 0
        elif isinstance(one, Publication):
            waiting.append(one)
        else:
            heard += 1
            if waiting and heard >= len(waiting) + spare:
                told.update((id(p), moment) for p in waiting)
                waiting, heard, spare = [], 0, 0
            elif not waiting:
                heard, spare = 0, max(spare - 1, 0)
    return told
