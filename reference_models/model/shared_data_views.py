"""What a reader of shared data may read at a moment (10.4.2.2): what was published and may be the current value there.

Readers may have a publication as soon as it begins. That they have it for certain follows from one of these: it had returned, and
the vendor declares that this is enough; patience has run out since; they were notified of it; they have read it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.reference_models.model.method_calls import MethodCall
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.shared_data import changes
from ucm_cts.reference_models.model.shared_data_events import Publication, Reader, Session, SharedData, given, is_ok

_NANOSECONDS = 1_000_000
"""In a millisecond."""


@dataclass(frozen=True)
class View:
    """What a reader may read in a call.

    ``values``: the values that are permitted.
    ``may_be_none``: it may also be as before the first publication, or as before the last start.
    ``arrived``: the publications that it has for certain, or had when it was frozen.
    ``kept``: the values that it may read only because a freeze before kept them; ``fresh``: the other ones.
    """

    values: tuple[Datum, ...]
    may_be_none: bool
    arrived: tuple[Publication, ...]
    kept: tuple[Datum, ...] = ()
    fresh: tuple[Datum, ...] = ()

    @property
    def newest(self) -> list[Publication]:
        """The publications of ``arrived`` that no other one of them followed."""
        return [one for one in self.arrived if not any(one.precedes(other) for other in self.arrived)]


State = Literal["free", "frozen", "unclear"]


def state_at(reader: Reader, call: MethodCall) -> tuple[State, Session | None]:
    """Is the reader frozen while it makes ``call``, and by which session, or the last one?"""
    last: Session | None = None
    for session in (one for one in reader.sessions if one.freeze.request.n < call.over and one.freeze is not call):
        last = session
        begun = session.freeze.over < call.request.n
        over = session.released is not None and session.released.over < call.request.n
        ending = session.released is not None and session.released.request.n < call.over
        if over:
            continue
        if not begun or ending or session.unclear_since < call.over or not is_ok(session.freeze):
            return "unclear", session
        return "frozen", session
    return "free", last


def frozen_at(found: SharedData, call: MethodCall, but: Reader | None = None) -> list[Session]:
    """The sessions of readers, ``but`` one, that are surely frozen while ``call`` is made."""
    states = [state_at(reader, call) for reader in found.readers if reader is not but]
    return [session for state, session in states if state == "frozen" and session is not None]


def may_be_frozen(found: SharedData, call: MethodCall) -> bool:
    """May some reader be frozen while ``call`` is made?"""
    return any(state_at(reader, call)[0] != "free" for reader in found.readers)


def view_of(runtime: ObservedRuntime, found: SharedData, reader: Reader, read: MethodCall) -> View:
    """What the reader may read in ``read``."""
    state, session = state_at(reader, read)
    if state == "frozen" and session is not None:
        return _pinned(runtime, found, reader, session, read)
    free = _free(runtime, found, reader, read)
    for freeze in (session.freeze, *session.nested) if state == "unclear" and session is not None else ():
        if freeze.request.n < read.over:
            free = _both(free, _free(runtime, found, reader, freeze))
    return free


def has_arrived(
    runtime: ObservedRuntime, found: SharedData, reader: Reader, one: Publication, call: MethodCall
) -> bool:
    """Has the reader ``one`` for certain when it makes ``call``?"""
    return one.is_sure and (
        was_told(reader, one, call)
        or is_due(runtime, one, call)
        or any(_identified(found, earlier) is one for earlier in reader.reads if earlier.over < call.request.n)
    )


def is_due(runtime: ObservedRuntime, one: Publication, call: MethodCall) -> bool:
    """Should all readers have ``one`` when ``call`` is made, told or not?"""
    reply = one.call.reply
    if reply is None or one.over > call.request.n:
        return False
    patience = runtime.scenario.patience * _NANOSECONDS
    return runtime.ics.reading("publication") == "before-return" or call.request.t - reply.t >= patience


def was_told(reader: Reader, one: Publication, call: MethodCall) -> bool:
    """Had the reader surely been notified of ``one`` before it made ``call``?"""
    moment = reader.heard_of.get(id(one))
    return moment is not None and moment < call.request.n


def base_of(runtime: ObservedRuntime, found: SharedData, call: MethodCall) -> int:
    """The end of the last operation that changed something before ``call`` was made."""
    return max(
        (o.end.n for o in changes(runtime, found.link) if o.end is not None and o.end.n < call.request.n), default=0
    )


def _identified(found: SharedData, read: MethodCall) -> Publication | None:
    """The publication whose value that read gave; None if there are several, or none."""
    value = given(read) if is_ok(read) else None
    if value is None:
        return None
    matching = [one for one in found.publications if value in one.values and one.since < read.over]
    return matching[0] if len(matching) == 1 else None


def _free(runtime: ObservedRuntime, found: SharedData, reader: Reader, call: MethodCall) -> View:
    """What it may read in ``call`` if it is not frozen, or would keep if that is a call of ``freeze_data``.

    If a freeze holds the whole connection, that is also what was current when others were frozen.
    """
    view = _unheld(runtime, found, reader, call)
    if runtime.ics.reading("freeze-scope") == "connection":
        for freeze in _holding(found, reader, call, view):
            view = _both(view, _unheld(runtime, found, reader, freeze))
    return view


def _holding(found: SharedData, reader: Reader, call: MethodCall, view: View) -> list[MethodCall]:
    """The freezes that may hold the connection in ``call``: until nobody is frozen any more and something that was published later has arrived.

    They are of other readers. A freeze while another one holds keeps what that one kept; so one of the reader itself counts, too, if another
    one followed it.
    """
    left = [session for other in found.readers for session in other.sessions]
    freezes: list[MethodCall] = []
    looked_at = [call]
    while looked_at:
        moment = looked_at.pop()
        latest = max((one.since for one in view.arrived if one.since < moment.over), default=0)
        for session in [one for one in left if one.freeze.request.n < moment.over]:
            if moment is call and session in reader.sessions:
                continue
            released = session.released
            if released is None or released.over > moment.request.n or released.request.n > latest:
                left.remove(session)
                freezes += session.beginnings(moment.over)
                looked_at += session.beginnings(moment.over)
    return freezes


def _unheld(runtime: ObservedRuntime, found: SharedData, reader: Reader, call: MethodCall) -> View:
    base = base_of(runtime, found, call)
    begun = [one for one in found.publications if one.since < call.over]
    arrived = [one for one in begun if one.since > base and has_arrived(runtime, found, reader, one, call)]
    current = [one for one in begun if not any(one.precedes(other) for other in arrived)]
    fresh = tuple(value for one in current for value in one.values)
    left = _left(found, reader, base, call)
    fresh = tuple(value for value in fresh if value not in left) or fresh
    kept = _kept(runtime, found, reader, call, arrived)
    stale = tuple(value for value in kept.values if value not in left) if kept is not None else ()
    none = not arrived or (kept is not None and kept.may_be_none)
    return View((*fresh, *stale), none, tuple(arrived), tuple(v for v in stale if v not in fresh), fresh)


def _left(found: SharedData, reader: Reader, base: int, call: MethodCall) -> list[Datum]:
    """The values that the reader has read since ``base`` before it read another one: they do not come back."""
    sent = [value for one in found.publications if one.since < call.over for value in one.values]
    reads = [r for r in reader.reads if base < r.request.n and r.over < call.request.n and is_ok(r)]
    known = [(r, value) for r in reads if (value := given(r)) is not None and sent.count(value) == 1]
    return [value for r, value in known if any(r.over < later.request.n and value != other for later, other in known)]


def _kept(
    runtime: ObservedRuntime, found: SharedData, reader: Reader, call: MethodCall, arrived: list[Publication]
) -> View | None:
    """What a freeze that is over has kept, if the reader may still read it: until the next publication, or until it has had time to
    get the last one that it missed.
    """
    over = [one for one in reader.sessions if one.released is not None and one.released.over < call.request.n]
    if not over or over[-1].released is None:
        return None
    session, release = over[-1], over[-1].released
    if any(one.since > release.request.n for one in arrived):
        return None
    missed = [one for one in found.publications if session.freeze.over < one.since and one.over < release.request.n]
    if not runtime.ics.permits("value-after-release", "next") and any(one.is_sure for one in missed):
        reply = release.reply
        patience = runtime.scenario.patience * _NANOSECONDS
        is_late = reply is not None and call.request.t - reply.t >= patience
        if is_late:
            return None
    return _pinned(runtime, found, reader, session, call)


def _pinned(runtime: ObservedRuntime, found: SharedData, reader: Reader, session: Session, call: MethodCall) -> View:
    """What the reader kept when it was frozen: what it has read since, or else what it might have read then."""
    view = _free(runtime, found, reader, session.freeze)
    later = session.beginnings(call.request.n)[1:]
    for again in later:
        view = _both(view, _free(runtime, found, reader, again))
    for read in reader.reads if not later else ():
        is_in = session.freeze.over < read.request.n and read.over < call.request.n
        value = given(read) if is_in and is_ok(read) else None
        if value is not None and value in view.values and state_at(reader, read) == ("frozen", session):
            return View((value,), False, view.arrived, (), (value,))
    return view


def _both(one: View, other: View) -> View:
    values = (*one.values, *other.values)
    return View(values, one.may_be_none or other.may_be_none, (), other.values, one.values)
