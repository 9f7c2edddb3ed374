"""Properties about messages: their receivers, number, order, time and values (10.1.6)."""

from __future__ import annotations

from collections.abc import Iterable

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_values import printed
from ucm_cts.adapters.contract.trace import Raise, Timeout
from ucm_cts.reference_models.conclusions import Concluded, Conclusions, Taken, takes
from ucm_cts.reference_models.findings import Finding
from ucm_cts.reference_models.model import messages as msg
from ucm_cts.reference_models.model.designation import designation, error_name
from ucm_cts.reference_models.model.hindrance import is_forgiving
from ucm_cts.reference_models.model.links import End, LinkState, interface_of
from ucm_cts.reference_models.model.method_calls import Delivery, MethodCall
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.operation import OperationInProgress, Result
from ucm_cts.reference_models.model.runtime import Member
from ucm_cts.reference_models.model.values_carried import overwritten
from ucm_cts.reference_models.properties.declaration import Property, property_at

_EMITTERS, _RECEIVERS, _INDEPENDENCE = "R-10.1.6.1-03", "R-10.1.6.1-04", "R-10.1.6.1-08"
_STANDARD, _TEMPLATE = "R-10.1.6.1-10", "R-10.1.6.1-20"


@property_at("closed", _EMITTERS, _RECEIVERS, _INDEPENDENCE, _STANDARD, _TEMPLATE)
def messages_arrived(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """Counts what the properties about missing messages checked: messages that reached every receiver they had to."""
    arrived: dict[LinkState, set[Member | None]] = {}
    interfaces = set()
    for call in msg.messages(runtime):
        ready = [end for end, was_ready in call.targets if was_ready and not msg.counts(end.member)]
        if call.link is None or not ready or not all(msg.was_delivered(call, end) for end in ready):
            continue
        yield check.kept(_STANDARD)
        arrived.setdefault(call.link, set()).add(call.caller)
        interfaces.add(call.link.interface)
        if len(ready) > 1:
            yield check.kept(_INDEPENDENCE if msg.is_disturbed(runtime, call) else _RECEIVERS)
    if len(interfaces) > 1:
        yield check.kept(_TEMPLATE)
    for emitters in arrived.values():
        if len(emitters) > 1:
            yield check.kept()


@property_at("waited", _RECEIVERS, _INDEPENDENCE, timed=True)
def every_receiver(check: Property, runtime: ObservedRuntime, timeout: Timeout) -> Conclusions:
    """A message that enters one receiver enters all that are well; a slow or failing one does not affect the others."""
    for call, missing in msg.overdue(runtime, timeout):
        refused, disturbed = call.code != msg.OK, msg.is_disturbed(runtime, call)
        if not call.deliveries and (refused or not disturbed):
            continue  # ok_kept's matter
        if refused and (call.crowded or msg.may_miss_an_end(call) or msg.comes_back(call)):
            continue
        requirement = _INDEPENDENCE if disturbed and not refused else _RECEIVERS
        got = ", ".join(sorted({d.receiver.lane for d in call.deliveries if d.receiver is not None}))
        yield _missing(check, requirement, call, missing, f"it came to {got or 'no receiver'}", timeout)


@property_at("waited", _INDEPENDENCE, timed=True)
def slow_receivers(check: Property, runtime: ObservedRuntime, timeout: Timeout) -> Conclusions:
    """Whether the others have the message while one of its receivers is held.

    The hold may end by itself shortly before the wait does: the patience of both is the same, and the hold began earlier.
    """
    held = {event.body for event in runtime.interactions.held}
    patience = runtime.scenario.patience * 900_000
    for call in msg.messages(runtime):
        holding = [d for d in call.deliveries if _holds(call, d, patience)]
        answered_otherwise = call.reply is not None and call.code != msg.OK
        if not held or not held <= {d.enter.body for d in holding}:
            continue
        if not msg.is_whole(runtime, call) or answered_otherwise or timeout.t - call.request.t < patience:
            continue
        until = min(d.exit.n if d.exit is not None else timeout.n for d in holding)
        keeping = {d.receiver for d in holding}
        others = [end for end in msg.lasting(runtime, call) if end.member not in keeping and msg.is_well(end.member)]
        missing = [e for e in others if all(d.enter.n >= until for d in call.delivered_to(e.member, e.port))]
        if missing and not (yield from takes(runtime, "slow-receiver", "shared")):
            yield _missing(check, _INDEPENDENCE, call, missing, "they wait for one that is slow", timeout)
        elif others and not missing:
            yield Taken("slow-receiver", "independent")


def _holds(call: MethodCall, delivery: Delivery, patience: float) -> bool:
    """Is its receiver inside, or was it held there for so many nanoseconds after the push?"""
    if delivery.receiver is None or delivery.exit is None:
        return delivery.receiver is not None
    return delivery.was_held and delivery.exit.t - call.request.t >= patience


@property_at("waited", _EMITTERS, timed=True)
def many_emitters(check: Property, runtime: ObservedRuntime, timeout: Timeout) -> Conclusions:
    """Messages of each emitter arrive, not of one only."""
    for call, missing in msg.overdue(runtime, timeout):
        arrived = {c.caller for c in msg.messages(runtime) if c.link is call.link and c.deliveries}
        if call.code == msg.OK and not call.deliveries and arrived and call.caller not in arrived:
            yield _missing(check, _EMITTERS, call, missing, "only another emitter's came", timeout)


@property_at("waited", _TEMPLATE, timed=True)
def message_template(check: Property, runtime: ObservedRuntime, timeout: Timeout) -> Conclusions:
    """Messages of each type arrive, not of one only."""
    for call, missing in msg.overdue(runtime, timeout):
        arrived = {c.link.interface for c in msg.messages(runtime) if c.link is not None and c.deliveries}
        if call.code == msg.OK and call.link is not None and arrived and call.link.interface not in arrived:
            yield _missing(check, _TEMPLATE, call, missing, "only another type's came", timeout)


@property_at("delivered", "R-10.1.6.1-05")
def at_most_once(check: Property, runtime: ObservedRuntime, delivery: Delivery) -> Concluded:
    """One push enters each receiver once."""
    call = delivery.call
    if call is None or not call.is_message or delivery.receiver is None:
        return ()
    if delivery.fit != "repeated":
        return check.kept()
    times = len(call.delivered_to(delivery.receiver, delivery.enter.port))
    return check.fail(
        "repeated",
        expected=f"{msg.name_of(call)} enters {delivery.receiver.lane} once",
        observed=f"it was entered {times} times",
        at=msg.events_of(call, delivery.enter.n),
    )


@property_at("closed", "R-10.1.6.1-06")
def message_origin(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """Each message that enters a receiver was pushed before by an emitter of its connection."""
    for delivery in runtime.interactions.deliveries:
        receiver, link, enter = delivery.receiver, delivery.link, delivery.enter
        if (
            receiver is None
            or link is None
            or enter.wrong
            or link.connector != s.MESSAGE_CONNECTOR
            or enter.method != s.PUSH
        ):
            continue
        call = delivery.call
        if call is not None and runtime.interactions.has_left(delivery):
            yield check.fail(
                "no receiver any more",
                expected=f"{receiver.lane} gets nothing that is pushed when it is no longer a receiver",
                observed=f"it got {msg.name_of(call)}",
                at=msg.events_of(call, enter.n),
            )
            continue
        if delivery.fit != "stray":
            yield check.kept()
            continue
        elsewhere = [c for c in msg.messages(runtime) if c.request.arguments == enter.arguments and c.link is not link]
        what = "which was pushed through another connection" if elsewhere else "which no emitter had pushed"
        yield check.fail(
            "another connection" if elsewhere else "invented",
            expected=f"{receiver.lane} gets what emitters of its connection pushed, and nothing else",
            observed=f"it got {printed(enter.arguments or ())}, {what}",
            at=(enter.n,),
        )


@property_at("delivered", "R-10.1.6.1-07")
def message_order(check: Property, runtime: ObservedRuntime, delivery: Delivery) -> Conclusions:
    """Do an emitter's messages come in the order in which they were pushed one after the other?"""
    call = delivery.call
    if call is None or not call.is_message or delivery.fit not in ("same", "altered"):
        return
    others = [c for c in msg.messages(runtime) if c.caller is call.caller and c.link is call.link and c is not call]
    came = [c for c in others if c.delivered_to(delivery.receiver, delivery.enter.port)]
    overtaken = [c for c in came if call.reply is not None and call.reply.n < c.request.n]
    if any(_has_twin(c, others) for c in (call, *overtaken)):
        return  # two messages with the same values: it is open which of them came
    if overtaken:
        yield check.kept()
        if not (yield from takes(runtime, "message-order", "unordered")):
            yield check.fail(
                "overtaken",
                expected=f"{msg.name_of(call)} comes before {msg.name_of(overtaken[0])}, which was pushed later",
                observed="it came after it",
                at=msg.events_of(call, overtaken[0].request.n, delivery.enter.n),
            )
    elif any(c.reply is not None and c.reply.n < call.request.n for c in came):
        yield check.kept()
        yield Taken("message-order", "fifo")


def _has_twin(call: MethodCall, others: Iterable[MethodCall]) -> bool:
    return any(c is not call and c.request.arguments == call.request.arguments for c in others)


@property_at("delivered", "R-10.1.6.1-19")
def values_isolated(check: Property, runtime: ObservedRuntime, delivery: Delivery) -> Concluded:
    """An emitter or receiver that overwrites its message changes no other component's copy."""
    call = delivery.call
    if call is None or not call.is_message or delivery.fit not in ("same", "altered"):
        return ()
    enter = delivery.enter
    earlier = [d for d in call.deliveries if d is not delivery and d.exit is not None and d.exit.n < enter.n]
    owners = [d.receiver.lane for d in earlier if d.receiver is not None and _overwrites(d.receiver)]
    if call.reply is not None and call.reply.n < enter.n and call.caller is not None:
        owners.append(call.caller.lane)
    if not owners:
        return ()
    pushed, got = list(call.request.arguments or ()), list(enter.arguments or ())
    if delivery.fit == "same":
        return check.kept()
    if got in overwritten(pushed):
        return check.fail(
            "overwritten",
            expected=f"{enter.component} gets {pushed} as it was pushed",
            observed=f"it got {got}, after {' and '.join(owners)} had overwritten what is theirs",
            at=msg.events_of(call, enter.n),
        )
    return ()


@property_at("linked", _EMITTERS, _RECEIVERS, _STANDARD, _TEMPLATE)
def message_connector(
    check: Property, runtime: ObservedRuntime, link: LinkState | None, step: s.ConnectorCall, end: Result
) -> Concluded:
    """A message connector can be had for each type, and any number of emitters and receivers can be joined by it."""
    if not isinstance(end, Raise) or any(c.started is not False for c in runtime.containers.values()):
        return ()
    if isinstance(step, s.Link) and step.connector == s.MESSAGE_CONNECTOR:
        others = {o.interface for o in runtime.interactions.links.values() if o.connector == step.connector}
        requirement = _TEMPLATE if others - {step.interface} else _STANDARD
        what = f"a message connector for {step.interface}"
    elif isinstance(step, s.Attach) and link is not None and link.connector == s.MESSAGE_CONNECTOR:
        member = runtime.members.get(step.id)
        ports = {"emitter": member.declaration.requires, "receiver": member.declaration.provides} if member else {}
        known = step.port in ports.get(step.role, ())
        if member is None or member.gone or member.suspended or not known or member.live_connections(step.port):
            return ()
        if interface_of(member, step.port) != link.interface:
            return ()  # compatible_attachment's matter
        if step.role == "emitter" and not link.live("receiver") and end.error in ("UCM_ERROR", "BAD_PARAMETER"):
            return ()  # refused_attachment's matter
        several = _EMITTERS if step.role == "emitter" else _RECEIVERS
        requirement = several if link.live(step.role) else _STANDARD
        what = f"{step.port} of {member.lane} as {step.role} of {link.name}, which has {len(link.live(step.role))}"
    else:
        return ()
    observed = f"{designation(step)} raised {error_name(end.error)} {end.detail}".rstrip()
    return check.fail(s.operation(step), expected=what, observed=observed, event=end, requirement=requirement)


@property_at("ended", _STANDARD, at=("start",), feature="interactions")
def joined_and_started(check: Property, runtime: ObservedRuntime, ongoing: OperationInProgress) -> Concluded:
    """Components that are joined by a message connector can be started."""
    if not isinstance(ongoing.end, Raise) or is_forgiving(runtime, ongoing):
        return ()
    members = ongoing.container.live_members()
    if any(
        m.raises("on_startup") or not m.connected or m.operational or ongoing.outcome.is_unknown(m) for m in members
    ):
        return ()
    links = [link for link in runtime.interactions.links.values() if link.connector == s.MESSAGE_CONNECTOR]
    joined = [link.name for link in links if any(e.member in members for e in link.live("emitter", "receiver"))]
    if joined:
        return check.fail(
            "start",
            expected=f"what is joined by {joined[0]} is started",
            observed=f"start raised {error_name(ongoing.end.error)} {ongoing.end.detail}",
            ended=ongoing,
        )
    return ()


def _overwrites(receiver: Member) -> bool:
    plan = receiver.declaration.plan.get("method", ())
    return any(isinstance(a, s.Answer) and a.method == s.PUSH and a.overwrite for a in plan)


def _missing(
    check: Property, requirement: str, call: MethodCall, missing: list[End], observed: str, timeout: Timeout
) -> Finding:
    names = ", ".join(sorted(end.member.lane for end in missing))
    return check.fail(
        "missing",
        expected=f"{msg.name_of(call)} comes to {names}",
        observed=f"it did not come; {observed}",
        at=msg.events_of(call, timeout.n),
        step=timeout.step,
        requirement=requirement,
    )
