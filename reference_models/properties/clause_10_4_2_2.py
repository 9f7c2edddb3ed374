"""Properties about reading shared data: what was published last, or what was kept by a freeze (10.4.2, 10.4.2.2)."""

from __future__ import annotations

from ucm_cts.adapters.contract.data_types import Datum
from ucm_cts.adapters.contract.platform_interfaces import CANCEL
from ucm_cts.adapters.contract.scenario import Start
from ucm_cts.reference_models.conclusions import Conclusions, takes
from ucm_cts.reference_models.findings import Finding
from ucm_cts.reference_models.model.extended_links import value_shown
from ucm_cts.reference_models.model.method_calls import NEVER, MethodCall
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.shared_data import all_shared_data, changes
from ucm_cts.reference_models.model.shared_data_events import (
    Publication,
    Session,
    SharedData,
    are_of_one_end,
    given,
    is_ok,
    written,
)
from ucm_cts.reference_models.model.shared_data_reads import Reading, reads_of
from ucm_cts.reference_models.model.shared_data_views import (
    View,
    frozen_at,
    is_due,
    may_be_frozen,
    was_told,
)
from ucm_cts.reference_models.properties.declaration import Property, property_at

_WRITERS, _READERS, _WHEN, _TWO_STEPS = "R-10.4.2-01", "R-10.4.2-02", "R-10.4.2-03", "R-10.4.2-04"
_AGREE, _WHOLE, _APART, _TYPES = "R-10.4.2-05", "R-10.4.2-06", "R-10.4.2-07", "R-10.4.2-08"
_SKIPPED, _CODES, _BROKEN = "R-10.4-04", "R-10.4.2.1-22", "R-10.4.2.1-23"
_CURRENT, _LEAVES, _NOTIFIED = "R-10.4.2.2-06", "R-10.4.2.2-07", "R-10.4.2.2-08"
_FREEZES, _ONE_READER, _RELEASES, _FREEZES_AGAIN = (f"R-10.4.2.2-{n}" for n in ("09", "10", "12", "13"))
_WRITES, _REPLACES, _SENDS, _CANCELS, _NOTHING = (f"R-10.4.2.2-{n}" for n in range(15, 20))
_WORKS_AGAIN, _NO_RECALL, _UNDISTURBED = (f"R-10.4.2.2-{n}" for n in range(20, 23))

_OF_FREEZING = (_FREEZES, _ONE_READER, _RELEASES, _FREEZES_AGAIN)
_OF_WRITING = (_WRITES, _REPLACES, _SENDS, _CANCELS, _NOTHING, _WORKS_AGAIN, _NO_RECALL, _UNDISTURBED)


@property_at(
    "closed",
    *(_CURRENT, _WRITERS, _READERS, _WHEN, _TWO_STEPS, _WHOLE, _APART, _TYPES),
    *(_SKIPPED, _CODES, _BROKEN, _LEAVES, _NOTIFIED),
    *_OF_FREEZING,
    *_OF_WRITING,
    timed=True,
    feature="extended",
)
def data_read(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """A reader reads what was published last, or what it kept when it was frozen."""
    for found in all_shared_data(runtime):
        for one in reads_of(runtime, found):
            if one.value is None or not is_ok(one.call):
                yield from _without_value(check, runtime, one)
            elif one.value in one.view.values:
                yield from _kept(check, runtime, one)
            elif one.view.may_be_none and not _is_known(runtime, one.value):
                yield from _unpublished(check, runtime, one, "ok")
            else:
                yield from _other_value(check, runtime, one)


def _is_known(runtime: ObservedRuntime, value: Datum) -> bool:
    """Was it written, through any connection?"""
    return any(written(call) == value for found in all_shared_data(runtime) for call in found.writes)


def _without_value(check: Property, runtime: ObservedRuntime, one: Reading) -> Conclusions:
    code = one.call.code_of_results
    got = f"gave {code}" if code is not None else "raised an exception"
    if one.view.may_be_none and code is not None:
        yield from _unpublished(check, runtime, one, "error")
    elif one.previous is not None and is_ok(one.previous):
        yield _violate(check, _LEAVES, "read once", one, "gives the same value again", got)
    else:
        yield _violate(check, _CODES, "not ok", one, "gives ok: there is a value", got)


def _unpublished(check: Property, runtime: ObservedRuntime, one: Reading, reading: str) -> Conclusions:
    """Nothing was published, or nothing since the reader was started."""
    late = _is_late(runtime, one)
    option, value = ("unpublished-read", reading) if not one.published else ("late-reader", "empty")
    if one.published and not late:
        return
    if not (yield from takes(runtime, option, value)):
        declared = runtime.ics.reading(option)
        yield _violate(check, _WHEN, option, one, f"is as declared: {option} = {declared}", f"gave {_result(one)}")
        return
    if not one.published and one.found.writes and one.found.writes[0].over < one.call.request.n:
        yield check.kept(_WRITES)


def _is_late(runtime: ObservedRuntime, one: Reading) -> bool:
    """Was the reader started after the last publication, while its writer stayed operational, and did nobody's freeze hold the connection then?"""
    last = one.published[-1] if one.published else None
    reader = one.reader.end.member
    was_out = last is not None and any(end.member is reader and not ready for end, ready in last.call.targets)
    if last is None or not last.is_sure or not was_out or one.session is not None:
        return False
    if runtime.ics.permits("freeze-scope", "connection") and may_be_frozen(one.found, last.call):
        return False
    since = [o for o in changes(runtime, one.found.link) if o.begin.n > last.over and o.begin.n < one.call.request.n]
    return bool(since) and all(isinstance(o.step, Start) for o in since) and not one.view.arrived


def _kept(check: Property, runtime: ObservedRuntime, one: Reading) -> Conclusions:
    """The value is one that it may read: which requirements were at stake?"""
    yield from _readings_taken(check, runtime, one)
    found, read, view = one.found, one.call, one.view
    if one.state == "frozen" and one.session is not None:
        during = [p for p in found.publications if p.is_sure and one.session.freeze.over < p.since]
        if any(p.over < read.request.n for p in during):
            yield check.kept(_FREEZES)
            if one.session.nth > 1:
                yield check.kept(_FREEZES_AGAIN)
    newest = view.newest
    if one.state != "free" or len(newest) != 1 or one.value not in newest[0].values:
        return
    current = newest[0]
    for requirement in (_CURRENT, _WHOLE, _SENDS):
        yield check.kept(requirement)
    if not found.types_are_plain:
        yield check.kept(_TYPES)
    if was_told(one.reader, current, read):
        yield check.kept(_NOTIFIED)
    if found.link.mended_at and current.call.request.t > found.link.mended_at:
        yield check.kept(_BROKEN)
    yield from _kept_of_others(check, runtime, one, current)
    yield from _kept_of_writing(check, runtime, one, current)


def _kept_of_others(check: Property, runtime: ObservedRuntime, one: Reading, current: Publication) -> Conclusions:
    """What else happened at other ends, and at this one before."""
    found, read = one.found, one.call
    if len({id(p.writer) for p in one.published}) > 1:
        yield check.kept(_WRITERS)
    others = [r for reader in found.readers if reader is not one.reader for r in reader.reads]
    if any(is_ok(r) and given(r) == one.value and r.over < read.request.n for r in others):
        yield check.kept(_READERS)
    if one.previous is not None and given(one.previous) == one.value:
        yield check.kept(_WHEN)
        yield check.kept(_LEAVES)
    if len(one.unread) > 1:
        yield check.kept(_SKIPPED)
    elsewhere = [p for other in all_shared_data(runtime) if other is not found for p in other.publications]
    if any(p.over < read.request.n for p in elsewhere):
        yield check.kept(_APART)
    if any(session.freeze.over < current.since for session in frozen_at(found, read, one.reader)):
        yield check.kept(_ONE_READER)
    if one.session is not None and one.session.freeze.over < current.since:
        yield check.kept(_RELEASES)


def _kept_of_writing(check: Property, runtime: ObservedRuntime, one: Reading, current: Publication) -> Conclusions:
    """What writers did before and after the publication."""
    found, read = one.found, one.call
    if len(current.writes) > 1:
        yield check.kept(_TWO_STEPS)
        yield check.kept(_REPLACES)
    if current.cancelled:
        yield check.kept(_WORKS_AGAIN)
    if any(v.source == "cancelled" and current.over < v.since and v.over < read.request.n for v in found.voids):
        yield check.kept(_CANCELS)
        yield check.kept(_NOTHING)
    later = [o for o in found.operations if current.over < o.request.n and o.over < read.request.n]
    if any(o.request.method == CANCEL and are_of_one_end(o, current.call) for o in later):
        yield check.kept(_NO_RECALL)
    if any(written(o) not in (None, one.value) and not _is_sent(found, o, read) for o in later):
        yield check.kept(_WRITES)
    if current.crossed and runtime.ics.reading("pending-value") == "per-writer":
        yield check.kept(_UNDISTURBED)


def _is_sent(found: SharedData, write: MethodCall, read: MethodCall) -> bool:
    return any(written(write) in one.values and one.since < read.over for one in found.publications)


def _readings_taken(check: Property, runtime: ObservedRuntime, one: Reading) -> Conclusions:
    """Which reading of the text does this read show?"""
    value, session, view = one.value, one.session, one.view
    sent = [p for p in one.published if value in p.values]
    if len(sent) == 1 and len(sent[0].values) == 2 and runtime.ics.reading("pending-value") == "observed":
        yield from takes(runtime, "pending-value", "per-writer" if sent[0].values[0] == value else "shared")
    late = _is_late(runtime, one) and sent and sent[-1] is one.published[-1]
    if late and not (yield from takes(runtime, "late-reader", "sees")):
        yield _violate(check, _CURRENT, "late", one, "gives no value, as declared: late-reader = empty", _got(one))
    if session is None:
        return
    if (
        one.state == "unclear"
        and session.nested
        and not session.is_stopped
        and session.unclear_since < one.call.request.n
    ):
        if value in view.kept and value not in view.fresh and not runtime.ics.permits("value-after-release", "next"):
            yield from takes(runtime, "nested-freeze", "counted")
        elif value in view.fresh and value not in view.kept:
            refused = not all(map(is_ok, session.nested))
            yield from takes(runtime, "nested-freeze", "refused" if refused else "flat")
    if one.state != "free" or session.released is None or session.unclear_since < NEVER:
        return
    end = session.released.request.n
    missed = [p for p in one.published if p.is_sure and session.freeze.over < p.since and p.over < end]
    if not missed or any(p.since > end for p in one.published):
        return
    if value in missed[-1].values and not view.may_be_none:
        if not (yield from takes(runtime, "value-after-release", "latest")):
            expected = "gives what it kept, until the next publication, as declared: value-after-release = next"
            yield _violate(check, _RELEASES, "after release", one, expected, _got(one))
    elif value in view.kept and missed[-1] in view.arrived:
        yield from takes(runtime, "value-after-release", "next")


def _other_value(check: Property, runtime: ObservedRuntime, one: Reading) -> Conclusions:
    """The value is none that it may read: which requirement is broken?"""
    writes = [w for w in one.found.writes if written(w) == one.value and w.request.n < one.call.over]
    if not writes:
        yield _unknown(check, runtime, one)
    elif not any(one.value in p.values for p in one.published):
        yield from _not_published(check, one, writes[-1])
    elif one.state == "frozen" and one.session is not None:
        requirement = _FREEZES_AGAIN if one.session.nth > 1 else _FREEZES
        expected = f"gives {_values(one.view)}, which it kept when it was frozen"
        yield _violate(check, requirement, "not kept", one, expected, _got(one))
    else:
        newest = one.view.newest
        scope = frozen_at(one.found, one.call, one.reader)
        is_held_up = scope and newest and scope[0].freeze.over < newest[0].since
        if is_held_up and (yield from takes(runtime, "freeze-scope", "connection")):
            return
        current = newest[0] if newest else None
        if current is not None and one.previous is not None and given(one.previous) in current.values:
            expected = f"gives {_values(one.view)} again"
            yield _violate(check, _LEAVES, "read once", one, expected, _got(one))
        yield _stale(check, runtime, one, current, scope)


def _unknown(check: Property, runtime: ObservedRuntime, one: Reading) -> Finding:
    others = [other for other in all_shared_data(runtime) if other is not one.found]
    if any(written(w) == one.value for other in others for w in other.writes):
        observed = f"{_got(one)}, which was published through another connection"
        return _violate(check, _APART, "another connection", one, "gives what was published there", observed)
    requirement = _WHOLE if one.found.types_are_plain else _TYPES
    return _violate(check, requirement, "altered", one, "gives a value that was written", _got(one))


def _not_published(check: Property, one: Reading, write: MethodCall) -> Conclusions:
    """It gave a value that was set, and then cancelled, replaced, or neither."""
    found, newest = one.found, one.view.newest
    later = [o for o in found.operations if are_of_one_end(o, write) and write.over < o.request.n < one.call.over]
    ended = next((o for o in later if written(o) is None), None)
    if ended is not None and ended.request.method == CANCEL:
        void = any(v.call in later and v.source == "cancelled" for v in found.voids)
        for requirement in (_CANCELS, _NOTHING) if void else (_CANCELS,):
            yield _violate(check, requirement, "cancelled", one, "does not give what was cancelled", _got(one))
    elif newest and any(write in p.crossed for p in newest):
        expected = f"gives {_values(one.view)}, which its own writer has set"
        yield _violate(check, _UNDISTURBED, "of another writer", one, expected, _got(one))
    elif ended is not None and written(later[0]) is not None:
        yield _violate(check, _REPLACES, "replaced", one, "gives the value set last before publish_data", _got(one))
    else:
        yield _violate(check, _WRITES, "unpublished", one, "gives what was published, not what was only set", _got(one))


def _stale(
    check: Property, runtime: ObservedRuntime, one: Reading, current: Publication | None, scope: list[Session]
) -> Finding:
    """It gave what had been replaced by ``current``."""
    expected = f"gives {_values(one.view)}"
    if current is None:
        return _violate(check, _CURRENT, "stale", one, expected, _got(one))
    found, read = one.found, one.call
    read_by_all = [r for reader in found.readers for r in reader.reads if is_ok(r) and r.over < read.request.n]
    own = [r for r in read_by_all if r in one.reader.reads]
    others = [r for r in read_by_all if r not in one.reader.reads]
    of_writer = [p for p in one.published if p.writer is current.writer]
    later = [o for o in found.operations if are_of_one_end(o, current.call) and o.request.n > current.over]
    recalls = [o for o in later[:1] if o.request.method == CANCEL]
    is_new = not any(given(r) in current.values for r in read_by_all)
    reasons = (
        (any(current.over < o.request.n < read.request.n for o in recalls), _NO_RECALL),
        (any(given(r) in current.values for r in own), _CURRENT),
        (one.session is not None and one.session.freeze.over < current.since, _RELEASES),
        (any(session.freeze.over < current.since for session in scope), _ONE_READER),
        (bool(current.cancelled), _WORKS_AGAIN),
        (any(written(o) is not None or o.request.method == CANCEL for o in current.crossed), _UNDISTURBED),
        (not found.types_are_plain, _TYPES),
        (any(one.value in p.values for p in one.unread), _SKIPPED),
        (len(of_writer) < len(one.published) and not _any_read(read_by_all, of_writer), _WRITERS),
        (any(given(r) in current.values for r in others), _READERS),
        (was_told(one.reader, current, read) and not is_due(runtime, current, read), _NOTIFIED),
        (is_new, _SENDS),
    )
    requirement = next((reason for holds, reason in reasons if holds), _CURRENT)
    observed = f"{_got(one)}, which had been replaced"
    return _violate(check, requirement, "stale", one, expected, observed, current.call.request.n)


def _any_read(reads: list[MethodCall], published: list[Publication]) -> bool:
    return any(given(read) in one.values for read in reads for one in published)


@property_at("closed", _AGREE, timed=True, feature="extended")
def readers_agree(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """When nobody publishes any more all readers that are not frozen read one value."""
    for found in all_shared_data(runtime):
        read = [one for one in reads_of(runtime, found) if one.state == "free" and is_ok(one.call) and one.view.arrived]
        last = {id(one.reader): one for one in read if one.session is None}
        final = [one for one in last.values() if _is_final(one)]
        if len(final) < 2:
            continue
        if all(one.value == final[0].value for one in final):
            yield check.kept()
            if len(final[0].view.newest) > 1:
                yield from takes(runtime, "concurrent-publications", "agree")
            continue
        current = [value for one in final for p in one.view.newest for value in p.values]
        explained = all(one.value in current for one in final)
        if explained and not (yield from takes(runtime, "concurrent-publications", "free")):
            different = next(one for one in final if one.value != final[0].value)
            expected = f"gives {value_shown(final[0].value)}, as that of another reader did: all agree, as declared"
            yield _violate(check, _AGREE, "different", different, expected, _got(different))


def _is_final(one: Reading) -> bool:
    """Has the reader got all that was published?"""
    publications = one.found.publications
    return all(p.over < one.call.request.n and (p in one.view.arrived or not p.is_sure) for p in publications)


def _values(view: View) -> str:
    return " or ".join(dict.fromkeys(map(value_shown, view.values))) or "no value"


def _got(one: Reading) -> str:
    return f"gave {value_shown(one.value)}"


def _result(one: Reading) -> str:
    return f"{one.call.code_of_results} and {value_shown(one.value)}"


def _violate(
    check: Property, requirement: str, cause: str, one: Reading, expected: str, observed: str, *further: int
) -> Finding:
    request, reply = one.call.request, one.call.reply
    frozen = ", which is frozen," if one.state == "frozen" else ""
    return check.fail(
        cause,
        expected=f"read_data of '{one.found.link.label(one.reader.end)}'{frozen} {expected}",
        observed=f"it {observed}",
        at=tuple(sorted({*further, request.n, *((reply.n,) if reply is not None else ())})),
        requirement=requirement,
    )
