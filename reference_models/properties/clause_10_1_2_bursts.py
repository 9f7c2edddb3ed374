"""Properties about bursts: many messages, of which only the numbers pushed and counted are known (10.1.2, 10.1.6)."""

from __future__ import annotations

import itertools

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.trace import Counted, Pushed
from ucm_cts.reference_models.conclusions import Conclusions, Taken, takes
from ucm_cts.reference_models.findings import Finding
from ucm_cts.reference_models.model.links import LinkState
from ucm_cts.reference_models.model.messages import CODES, COMM_ERROR, OK, is_well
from ucm_cts.reference_models.model.method_calls import PushedBurst
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.runtime import Member
from ucm_cts.reference_models.properties.declaration import Property, property_at

_CODES, _OK_IF_WELL, _OK_IS_TRUE = "R-10.1.2-02", "R-10.1.2-09", "R-10.1.2-10"
_EMITTERS, _ONCE, _ORIGIN = "R-10.1.6.1-03", "R-10.1.6.1-05", "R-10.1.6.1-06"
_ORDER = "R-10.1.6.1-07"


@property_at("pushed", _CODES, _OK_IF_WELL)
def burst_answered(check: Property, runtime: ObservedRuntime, event: Pushed) -> Conclusions:
    """Each message of a burst is answered one of the three codes; ok, where the vendor has declared that push waits."""
    burst = runtime.interactions.bursts[-1]
    emitter = runtime.bodies.get(event.body)
    if emitter is None or not emitter.serving or burst.link is None:
        return
    unknown = [code for code in event.answers if code not in CODES]
    if unknown:
        expected = f"each message of a burst is answered {' or '.join(CODES)}"
        yield _violate(check, _CODES, expected, f"{unknown[0] or 'nothing'} was the answer", event)
        return
    yield check.kept()
    healthy = len(burst.receivers) == len(burst.link.live("receiver")) > 0 and all(map(is_well, burst.receivers))
    if not healthy or burst.link.broken_at:
        return
    if set(event.answers) == {OK}:
        yield check.kept(_OK_IF_WELL)
    elif burst.link.has_lost_an_end and set(event.answers) <= {OK, COMM_ERROR}:
        return
    elif not (yield from takes(runtime, "message-overflow", "refuse")):
        expected = "message-overflow was declared as block: each message of a burst is answered ok"
        yield _violate(check, _OK_IF_WELL, expected, f"the answers were {event.answers}", event)


@property_at("counted", _OK_IS_TRUE, _EMITTERS, _ONCE, _ORIGIN, _ORDER, timed=True)
def burst_counted(check: Property, runtime: ObservedRuntime, event: Counted) -> Conclusions:
    """Receivers count each message of a burst that was answered ok once, and no others."""
    receiver = runtime.bodies.get((event.component, event.instance))
    link = runtime.interactions.link_to(receiver) if receiver is not None else None
    bursts = [burst for burst in runtime.interactions.bursts if burst.link is link]
    if receiver is None or link is None or not bursts or _is_busy(runtime, link) or not _is_known(bursts):
        return
    if runtime.interactions.is_mistyped(link):
        return
    yield from _origin(check, receiver, bursts, event)
    yield from _once(check, receiver, event)
    yield from _order(check, runtime, receiver, event)
    if link.broken_at or not receiver.serving or not all(receiver in burst.receivers for burst in bursts):
        return
    due = sum(burst.pushed.answers.get(OK, 0) for burst in bursts)
    step = runtime.scenario.steps[event.step]
    if event.distinct >= due:
        yield check.kept()
        if len({b.pushed.body for b in bursts}) > 1:
            yield check.kept(_EMITTERS)
    elif isinstance(step, s.AwaitMessages) and event.received < step.count and not runtime.interactions.held:
        expected = f"{receiver.lane} gets each of the {due} messages that were answered ok"
        observed = f"it has got {event.distinct} of them when patience has run out"
        yield _violate(check, _OK_IS_TRUE, expected, observed, event, "lost")


def _origin(check: Property, receiver: Member, bursts: list[PushedBurst], event: Counted) -> Conclusions:
    pushed = sum(burst.pushed.count for burst in bursts)
    least = min(burst.pushed.first for burst in bursts)
    greatest = max(burst.pushed.first + burst.pushed.count - 1 for burst in bursts)
    if event.received and (event.distinct > pushed or event.least < least or event.greatest > greatest):
        expected = f"{receiver.lane} gets {pushed} messages from {least} to {greatest} and nothing else"
        observed = f"it got {event.distinct} from {event.least} to {event.greatest}"
        yield _violate(check, _ORIGIN, expected, observed, event, "invented")
    elif event.received:
        yield check.kept(_ORIGIN)


def _once(check: Property, receiver: Member, event: Counted) -> Conclusions:
    if event.received > event.distinct:
        again = event.received - event.distinct
        expected = f"{receiver.lane} gets each message once"
        yield _violate(check, _ONCE, expected, f"{again} came again", event, "repeated")
    elif event.received:
        yield check.kept(_ONCE)


def _order(check: Property, runtime: ObservedRuntime, receiver: Member, event: Counted) -> Conclusions:
    """Each burst has numbers of its own, in which the disorder is counted."""
    if event.received < 2:
        return
    yield check.kept(_ORDER)
    if not event.disordered:
        yield Taken("message-order", "fifo")
    elif not (yield from takes(runtime, "message-order", "unordered")):
        expected = f"{receiver.lane} gets an emitter's messages in the order in which they were pushed"
        observed = f"{event.disordered} came after a later one"
        yield _violate(check, _ORDER, expected, observed, event, "disordered")


def _is_busy(runtime: ObservedRuntime, link: LinkState) -> bool:
    """May an emitter of ``link`` still be pushing?"""
    inside = {body for bodies in runtime.inside.values() for body in bodies}
    return any(end.member.body in inside for end in link.ends if end.role == "emitter")


def _is_known(bursts: list[PushedBurst]) -> bool:
    """Has no number been pushed twice?"""
    ranges = sorted((burst.pushed.first, burst.pushed.count) for burst in bursts)
    return all(first + count <= then for (first, count), (then, _) in itertools.pairwise(ranges))


def _violate(
    check: Property, requirement: str, expected: str, observed: str, event: Pushed | Counted, cause: str = "answer"
) -> Finding:
    step = event.step if isinstance(event, Counted) else None
    return check.fail(cause, expected=expected, observed=observed, at=(event.n,), step=step, requirement=requirement)
