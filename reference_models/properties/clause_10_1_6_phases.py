"""Properties about messages and phases: before a receiver is started, after it is stopped, and what waits meanwhile (10.1.6)."""

from __future__ import annotations

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_values import printed
from ucm_cts.adapters.contract.trace import Raise, Timeout
from ucm_cts.reference_models.conclusions import Concluded, Conclusions, takes
from ucm_cts.reference_models.model import messages as msg
from ucm_cts.reference_models.model.method_calls import Delivery, MethodCall
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.operation import OperationInProgress
from ucm_cts.reference_models.model.runtime import Member
from ucm_cts.reference_models.properties.declaration import Property, property_at

_IN_PHASE = "R-10.1.6.1-09"


@property_at("delivered", _IN_PHASE)
def message_phases(check: Property, runtime: ObservedRuntime, delivery: Delivery) -> Concluded:
    """No message enters a receiver before start was called on its container, or after stop returned."""
    receiver, call = delivery.receiver, delivery.call
    if receiver is None or receiver.suspended or (call is not None and not call.is_message):
        return ()
    if delivery.link is None or delivery.link.connector != s.MESSAGE_CONNECTOR:
        return ()
    in_progress = runtime.interactions.in_progress.values()
    if receiver.operational or any(isinstance(o.step, s.Start) for o in in_progress):
        if call is not None and _was_kept_waiting(runtime, call, receiver):
            return check.kept()
        return ()
    if receiver.container.started is not False:
        return ()
    when = "after it was stopped" if receiver.startups else "before it was started"
    return check.fail(
        when,
        expected=f"{receiver.lane} gets messages in its operational phase only",
        observed=f"{printed(delivery.enter.arguments or ())} entered it {when}",
        at=(delivery.enter.n,),
    )


@property_at("delivered", _IN_PHASE)
def later_phases(check: Property, runtime: ObservedRuntime, delivery: Delivery) -> Conclusions:
    """A message of an earlier phase comes in a later one only if the vendor has not declared that it does not."""
    call, receiver = delivery.call, delivery.receiver
    if call is None or receiver is None or not call.is_message or not msg.was_restarted(runtime, call, receiver):
        return
    ready = [was_ready for end, was_ready in call.targets if end.member is receiver]
    was_idle = any(end.member is receiver for end in call.idle)
    if not (was_idle or any(ready)):
        return
    option, value = ("receiver-not-ready", "hold") if was_idle else ("pending-at-stop", "keep")
    if not (yield from takes(runtime, option, value)):
        yield check.fail(
            option,
            expected=f"{option} was declared as {runtime.ics.reading(option)}: {msg.name_of(call)} does not come after a start",
            observed=f"it entered {receiver.lane} after its next start",
            at=msg.events_of(call, delivery.enter.n),
        )


@property_at("waited", _IN_PHASE, timed=True)
def kept_for_later_phases(check: Property, runtime: ObservedRuntime, timeout: Timeout) -> Conclusions:
    """A message that waits for the next start comes then, where the vendor has declared it."""
    for call in msg.messages(runtime):
        if call.code != msg.OK or not msg.is_whole(runtime, call):
            continue
        for end, was_ready in call.targets:
            started_again = msg.was_restarted(runtime, call, end.member) and end.member.serving and end.until is None
            if not started_again or msg.was_delivered(call, end) or msg.counts(end.member):
                continue
            is_over = msg.waited_for(runtime, timeout, call.reply.t if call.reply else 0)
            if not is_over or not (was_ready or end in call.idle):
                continue
            option = "pending-at-stop" if was_ready else "receiver-not-ready"
            if not (yield from takes(runtime, option, "drop")):
                declared = runtime.ics.reading(option)
                yield check.fail(
                    option,
                    expected=f"{option} was declared as {declared}: {msg.name_of(call)} comes after the start",
                    observed=f"it never came to {end.member.lane}",
                    at=msg.events_of(call, timeout.n),
                )


@property_at("ended", _IN_PHASE, at=("stop",), feature="interactions")
def delivered_at_stop(check: Property, runtime: ObservedRuntime, ongoing: OperationInProgress) -> Conclusions:
    """All that had got ok has arrived when stop returns, where the vendor has declared it."""
    if isinstance(ongoing.end, Raise):
        return
    for call in msg.messages(runtime):
        for target in msg.of_one_phase(runtime, call) if call.code == msg.OK and msg.is_whole(runtime, call) else ():
            here = target.member.container is ongoing.container and not msg.counts(target.member)
            if not here or call.request.n > ongoing.call or msg.was_delivered(call, target):
                continue
            if runtime.ics.reading("pending-at-stop") == "deliver":
                yield check.fail(
                    "pending-at-stop",
                    expected=f"pending-at-stop was declared as deliver: {msg.name_of(call)} is delivered when stop returns",
                    observed=f"it had not come to {target.member.lane}",
                    at=msg.events_of(call, ongoing.end.n),
                )


@property_at("completed", _IN_PHASE)
def unready_receivers(check: Property, runtime: ObservedRuntime, call: MethodCall) -> Conclusions:
    """A push to a receiver that is not operational is answered as the vendor has declared."""
    if not call.is_message or not call.idle or not msg.is_whole(runtime, call) or not msg.is_quiet(runtime, call):
        return
    others = [end for end, ready in call.targets if ready and end not in call.idle]
    if len(others) + len(call.idle) < len(call.targets) or not all(msg.is_well(end.member) for end in others):
        return
    refused = call.code in msg.CODES and call.code != msg.OK
    declared = runtime.ics.reading("receiver-not-ready")
    if (refused and not (yield from takes(runtime, "receiver-not-ready", "error"))) or (
        declared == "error" and call.code == msg.OK
    ):
        yield check.fail(
            "receiver-not-ready",
            expected=f"{msg.name_of(call)} is answered as receiver-not-ready was declared: {declared}",
            observed=f"the answer was {call.code}",
            at=msg.events_of(call),
        )


def _was_kept_waiting(runtime: ObservedRuntime, call: MethodCall, receiver: Member) -> bool:
    """Has this message, or one before it, been pushed when it could have come while the receiver was not operational?"""
    since = runtime.startups.get(receiver.body, (0, 0))[0]
    starts = [o.begin.n for o in runtime.interactions.changes if isinstance(o.step, s.Start)]
    started = max((n for n in starts if n < since), default=0)
    last = min(call.request.n, started - 1)
    earlier = [c for c in msg.messages(runtime) if c.link is call.link and c.request.n <= last]
    pending = [c for c in earlier if all(d.enter.n > since for d in c.delivered_to(receiver))]
    return any(end.member is receiver for c in pending for end, _ in c.targets)
