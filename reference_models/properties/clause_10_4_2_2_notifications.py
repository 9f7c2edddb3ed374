"""Properties about notifications of shared data: one for each update at most, one after the last at least (10.4.2.2)."""

from __future__ import annotations

import itertools

from ucm_cts.reference_models.conclusions import Conclusions, takes
from ucm_cts.reference_models.model import execution_policies as policies
from ucm_cts.reference_models.model.extended_links import overdue_since
from ucm_cts.reference_models.model.method_calls import NEVER, MethodCall
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.shared_data import all_shared_data, changes
from ucm_cts.reference_models.model.shared_data_events import Publication, Reader, Session, SharedData, is_ok
from ucm_cts.reference_models.model.shared_data_views import state_at
from ucm_cts.reference_models.properties.declaration import Property, property_at

_TWO_STEPS, _APART = "R-10.4.2-04", "R-10.4.2-07"
_NOTIFIES, _NO_UPDATE, _PHASES, _PROTECTED = (f"R-10.4.2.2-{n}" for n in ("02", "03", "04", "05"))
_NOTHING = "R-10.4.2.2-19"


@property_at("closed", _NO_UPDATE, _NOTHING, _TWO_STEPS, _APART, feature="extended")
def notified_of_updates(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """A reader is notified once for each publication at most, and of nothing else."""
    everything = all_shared_data(runtime)
    for found in everything:
        for reader in found.readers:
            idle = True
            for number, notice in enumerate(reader.notices, 1):
                moment = notice.enter.n
                sent = [p for p in found.publications if p.since < moment]
                if number <= len(sent) + _starts(runtime, found, moment):
                    continue
                idle = False
                last = max((o for o in found.operations if o.request.n < moment), key=_began, default=None)
                elsewhere = [p for other in everything if other is not found for p in other.publications]
                void = next((v for v in found.voids if last is v.call), None)
                near = any(p.since < moment and (last is None or p.since > last.request.n) for p in elsewhere)
                cancelled = void is not None and void.source == "cancelled"
                at_once = sent and last is sent[-1].call and len(sent[-1].writes) > 1
                requirement = _NOTHING if cancelled else _APART if near else _TWO_STEPS if at_once else _NO_UPDATE
                yield check.fail(
                    "no update",
                    expected=f"'{found.link.label(reader.end)}' is notified once for each publication at most: {len(sent)} so far",
                    observed=f"on_data_update was entered {number} times",
                    at=(*((last.request.n,) if last is not None else ()), moment),
                    requirement=requirement,
                )
                break
            if idle:
                yield from _nothing_heard(check, runtime, everything, found, reader)


def _began(call: MethodCall) -> int:
    return call.request.n


def _starts(runtime: ObservedRuntime, found: SharedData, moment: int) -> int:
    """After a start a reader may be notified of what had been published before, and after mending of what was not sent."""
    operations = [o for o in changes(runtime, found.link) if not o.step.undoes and o.begin.n < moment]
    return sum(any(p.since < o.begin.n for p in found.publications) for o in operations)


def _nothing_heard(
    check: Property, runtime: ObservedRuntime, everything: list[SharedData], found: SharedData, reader: Reader
) -> Conclusions:
    """There was something that is no update, and it had time to show: the reader was waited for in vain, or notified later."""
    last = reader.notices[-1].enter.n if reader.notices else 0
    for void in found.voids:
        reply = void.call.reply
        if reply is not None and (last > reply.n or overdue_since(runtime, reader.end.member, reply)):
            yield check.kept(_NO_UPDATE)
            if void.source == "cancelled":
                yield check.kept(_NOTHING)
    others = [p for other in everything if other is not found for p in other.publications]
    if reader.notices and any(p.over < last for p in others):
        yield check.kept(_APART)


@property_at("closed", _NOTIFIES, timed=True, feature="extended")
def reader_notified(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """A reader is notified after the last of several publications, within patience, unless it is frozen."""
    for found in all_shared_data(runtime):
        for reader in found.readers:
            sure = [p for p in found.publications if p.is_sure and _is_there(reader, p)]
            heard = [p for p in sure if id(p) in reader.heard_of]
            if heard:
                yield check.kept()
            yield from _counted(runtime, reader, sure)
            for one in sure:
                reply = one.call.reply
                overdue = overdue_since(runtime, reader.end.member, reply) if reply is not None else 0
                if any(one.since < notice.enter.n < overdue for notice in reader.notices) or reply is None:
                    continue
                held = found.readers if runtime.ics.reading("freeze-scope") == "connection" else [reader]
                is_free = all(_is_free(other, one, overdue) for other in held)
                if overdue and not _is_changed(runtime, found, one.since, overdue) and is_free:
                    yield check.fail(
                        "never",
                        expected=f"'{found.link.label(reader.end)}' is notified of the publication",
                        observed="it was not",
                        at=(one.since, reply.n, overdue),
                    )
                    break
            yield from _coalesced(check, runtime, found, reader, sure)


def _counted(runtime: ObservedRuntime, reader: Reader, sure: list[Publication]) -> Conclusions:
    """Two publications between two notifications: was the reader told of each?"""
    for first, second in itertools.pairwise(sure):
        at_once = not any(first.since < n.enter.n < second.since for n in reader.notices)
        if at_once and id(first) in reader.heard_of and id(second) in reader.heard_of and _was_free(reader, second):
            yield from takes(runtime, "notifications", "each")


def _coalesced(
    check: Property, runtime: ObservedRuntime, found: SharedData, reader: Reader, sure: list[Publication]
) -> Conclusions:
    """Fewer notifications than publications, though all were waited for."""
    reply = sure[-1].call.reply if sure else None
    overdue = overdue_since(runtime, reader.end.member, reply) if reply is not None else 0
    if not overdue or reader.sessions or _is_changed(runtime, found, sure[0].since, overdue):
        return
    notices = [n for n in reader.notices if sure[0].since < n.enter.n < overdue]
    if notices and len(notices) < len(sure) and not (yield from takes(runtime, "notifications", "coalesced")):
        yield check.fail(
            "fewer",
            expected=f"'{found.link.label(reader.end)}' is notified of each of {len(sure)} publications, as declared",
            observed=f"it was notified {len(notices)} times",
            at=(sure[0].since, overdue),
        )


def _is_there(reader: Reader, one: Publication) -> bool:
    """Was the reader operational when it was published?"""
    return any(end.member is reader.end.member and ready for end, ready in one.call.targets)


def _is_changed(runtime: ObservedRuntime, found: SharedData, begin: int, end: int) -> bool:
    return any(o.overlaps(begin, end) for o in changes(runtime, found.link))


def _is_free(reader: Reader, one: Publication, until: int) -> bool:
    """Was the reader not frozen at any time between?"""
    return not any(
        session.freeze.request.n < until and (session.released is None or session.released.over > one.since)
        for session in reader.sessions
    )


def _was_free(reader: Reader, one: Publication) -> bool:
    """Was the reader not frozen when it was published?"""
    return state_at(reader, one.call)[0] == "free"


@property_at("closed", _NO_UPDATE, _TWO_STEPS, timed=True, feature="extended")
def published_twice(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """Does a second publication without a new value notify again?"""
    for found in all_shared_data(runtime):
        repeated = [p for p in found.publications if p.source == "repeated" and is_ok(p.call)]
        writers = {id(p.writer) for p in found.publications}
        for reader in found.readers if len(repeated) == 1 and len(writers) == 1 and not found.link.was_broken else ():
            one, others = repeated[0], [p for p in found.publications if p is not repeated[0]]
            if reader.sessions or not all(p.is_sure and _is_there(reader, p) for p in others):
                continue
            following = min((p.since for p in others if p.since > one.since), default=NEVER)
            before = [p for p in others if p.since < one.since]
            if any(reader.heard_of.get(id(p), NEVER) > one.since for p in before) or one.call.reply is None:
                continue
            overdue = overdue_since(runtime, reader.end.member, one.call.reply)
            again = any(one.since < n.enter.n < following for n in reader.notices)
            if not again and not 0 < overdue < following:
                continue
            if _is_changed(
                runtime, found, before[0].since if before else one.since, min(following, overdue or following)
            ):
                continue
            if not (yield from takes(runtime, "publish-twice", "again" if again else "nothing")):
                expected = f"'{found.link.label(reader.end)}' is told of a second publication as declared"
                yield check.fail(
                    "twice",
                    expected=f"{expected}: publish-twice = {runtime.ics.reading('publish-twice')}",
                    observed="it was notified" if again else "it was not notified",
                    at=(one.since,),
                    requirement=_NO_UPDATE if again else _TWO_STEPS,
                )


@property_at("closed", _NOTIFIES, timed=True, feature="extended")
def frozen_notified(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """When is a reader notified that is frozen: at once, at its release, or not at all?"""
    for found in all_shared_data(runtime):
        for reader in found.readers:
            for session in reader.sessions:
                reading = _reading_of(runtime, found, reader, session)
                if reading and not (yield from takes(runtime, "frozen-notification", reading[0])):
                    declared = runtime.ics.reading("frozen-notification")
                    yield check.fail(
                        "frozen",
                        expected=f"'{found.link.label(reader.end)}', which is frozen, is notified as declared: {declared}",
                        observed={
                            "at-once": "it was notified while it was frozen",
                            "at-release": "it was notified after its release",
                            "none": "it was not notified",
                        }[reading[0]],
                        at=(session.freeze.request.n, *reading[1:]),
                    )


def _reading_of(
    runtime: ObservedRuntime, found: SharedData, reader: Reader, session: Session
) -> tuple[str, int] | None:
    """The reading that a freeze shows, and the event that shows it. A notification that comes after the release may have been on its
    way before, so it shows something only if it had been waited for in vain while the reader was frozen.
    """
    end = session.released
    until = end.request.n if end is not None else NEVER
    member = reader.end.member
    during = [p for p in found.publications if p.is_sure and session.freeze.over < p.since and p.over < until]
    before = [p for p in found.publications if p.since < session.freeze.over]
    if not during or session.unclear_since < until or any(p.is_sure and id(p) not in reader.heard_of for p in before):
        return None
    if any(reader.heard_of.get(id(p), NEVER) > session.freeze.request.n for p in before):
        return None
    first = next((n.enter.n for n in reader.notices if n.enter.n > during[0].since), NEVER)
    if first < until:
        return "at-once", first
    reply = during[0].call.reply
    overdue = overdue_since(runtime, member, reply) if reply is not None else 0
    if (
        not overdue
        or overdue > until
        or end is None
        or end.reply is None
        or _is_changed(runtime, found, during[0].since, overdue)
    ):
        return None
    following = min((p.since for p in found.publications if p.since > until), default=NEVER)
    if first < following:
        return "at-release", first
    late = overdue_since(runtime, member, end.reply)
    return ("none", late) if late and late < following else None


@property_at("closed", _PHASES, feature="extended")
def publications_without_reader(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """Publications went on while a reader was not operational, and it was not notified."""
    for found in all_shared_data(runtime):
        for one in (p for p in found.publications if p.is_sure):
            if any(not ready for _, ready in one.call.targets):
                yield check.kept()


@property_at("closed", _PROTECTED, timed=True, feature="extended")
def notification_kept_out(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """A publication came while a protected reader was executed, and its notification entered afterwards."""
    for found in all_shared_data(runtime):
        for reader in found.readers:
            for notice in reader.notices:
                enter = notice.enter
                declaration = reader.end.member.declaration
                for execution in runtime.executions.past.get(enter.body, ()):
                    excluded = policies.exclusion(declaration, runtime.ics, execution.way, enter.port or "")
                    inside = [p for p in found.publications if execution.enter.n < p.since < execution.end < enter.n]
                    if excluded and inside:
                        yield check.kept()
