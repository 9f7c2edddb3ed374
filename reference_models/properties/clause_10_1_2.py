"""Properties about return codes: which code a push gives, and whether the code is true (10.1.2)."""

from __future__ import annotations

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_values import printed
from ucm_cts.adapters.contract.trace import Raise, Timeout
from ucm_cts.reference_models.conclusions import Concluded, Conclusions, Taken, takes
from ucm_cts.reference_models.findings import Finding
from ucm_cts.reference_models.model import messages as msg
from ucm_cts.reference_models.model.designation import error_name
from ucm_cts.reference_models.model.links import LinkState
from ucm_cts.reference_models.model.method_calls import MethodCall
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.operation import OperationInProgress, Result
from ucm_cts.reference_models.properties.declaration import Property, property_at

_CODES, _OK_IF_WELL, _OK_IS_TRUE = "R-10.1.2-02", "R-10.1.2-09", "R-10.1.2-10"
_INTERNAL, _TRANSMISSION = "R-10.1.2-11", "R-10.1.2-12"
_SERVED = "R-10.1.5.1-01"

_DUE = {"transport": _TRANSMISSION, "inside": _INTERNAL}


@property_at("completed", _CODES)
def known_codes(check: Property, runtime: ObservedRuntime, call: MethodCall) -> Concluded:
    """The result of push is one of the three codes."""
    if not call.is_message or call.reply is None or call.caller is None or not call.caller.serving or call.reply.wrong:
        return ()
    results = list(call.reply.results or ())
    if not call.reply.failed and len(results) == 1 and results[0] in msg.CODES:
        return check.kept()
    return _violate(check, call, f"is answered {' or '.join(msg.CODES)}", "unknown")


@property_at("completed", _CODES)
def without_receivers(check: Property, runtime: ObservedRuntime, call: MethodCall) -> Conclusions:
    """A push without receivers is answered as the vendor has declared."""
    if (
        not call.is_message
        or call.targets
        or not call.ready
        or not msg.is_whole(runtime, call)
        or call.code not in msg.CODES
    ):
        return
    declared = runtime.ics.reading("push-without-receiver")
    if declared == "refused" and call.link is not None and any(end.role == "receiver" for end in call.link.ends):
        return  # what was refused is to connect or start without one; this one lost its receivers later
    if not (yield from takes(runtime, "push-without-receiver", str(call.code))):
        expected = f"has no receiver, for which {declared} was declared"
        yield _violate(check, call, expected, "without receivers")


@property_at("ended", _CODES, at=("start",), feature="interactions")
def refused_without_receivers(check: Property, runtime: ObservedRuntime, ongoing: OperationInProgress) -> Conclusions:
    """A connection without receivers is refused only where the vendor has declared it."""
    if not isinstance(ongoing.end, Raise) or any(not m.connected for m in ongoing.container.members):
        return
    links = [k for k in runtime.interactions.improper(ongoing.container) if k.live("emitter")]
    if links and not (yield from takes(runtime, "push-without-receiver", "refused")):
        declared = runtime.ics.reading("push-without-receiver")
        yield check.fail(
            "refused",
            expected=f"start succeeds without a receiver, because push-without-receiver was declared as {declared}",
            observed=f"start raised {error_name(ongoing.end.error)}",
            ended=ongoing,
        )


@property_at("linked", _CODES)
def refused_attachment(
    check: Property, runtime: ObservedRuntime, link: LinkState | None, step: s.ConnectorCall, end: Result
) -> Conclusions:
    """An emitter that has no receiver yet is refused only where the vendor has declared it."""
    if not isinstance(step, s.Attach) or step.role != "emitter" or link is None or link.live("receiver"):
        return
    if isinstance(end, Raise) and not (yield from takes(runtime, "push-without-receiver", "refused")):
        declared = runtime.ics.reading("push-without-receiver")
        expected = f"push-without-receiver was declared as {declared}: an emitter can be attached before a receiver"
        observed = f"it raised {error_name(end.error)}"
        yield check.fail("refused", expected=expected, observed=observed, event=end)


@property_at("completed", _OK_IF_WELL)
def ok_when_healthy(check: Property, runtime: ObservedRuntime, call: MethodCall) -> Concluded:
    """Nothing disturbs the push, so it gives ok."""
    if not _is_undisturbed(runtime, call) or call.link is None or call.link.broken_at:
        return ()
    if all(msg.is_well(end.member) for end, _ in call.targets):
        if call.code == msg.OK:
            return check.kept()
        if msg.may_miss_an_end(call) or msg.comes_back(call):
            return ()
        blocking = runtime.ics.reading("message-overflow") == "block"
        if msg.is_quiet(runtime, call) or (blocking and call.code in msg.CODES):
            expected = "is answered ok: all its receivers are operational and well, and nothing is broken"
            return _violate(check, call, expected, "not ok")
    return ()


@property_at("completed", _OK_IF_WELL)
def receivers_codes(check: Property, runtime: ObservedRuntime, call: MethodCall) -> Conclusions:
    """A receiver's code is dropped, and push gives ok, or it is passed on, and push gives a code that was not ok."""
    if not _is_undisturbed(runtime, call) or not msg.is_quiet(runtime, call):
        return
    answers = {msg.answer_to_push(end.member) for end, _ in call.targets}
    if answers == {msg.OK} or not answers <= {*msg.CODES}:
        return  # ok_when_healthy's matter; after an exception any code will do
    reading = "dropped" if call.code == msg.OK else "passed"
    if msg.may_miss_an_end(call):
        return
    if call.code != msg.OK and call.code not in answers:
        expected = f"is answered ok, or what a receiver answered: {', '.join(sorted(answers - {msg.OK}))}"
        yield _violate(check, call, expected, "another code")
    elif not (yield from takes(runtime, "receiver-code", reading)):
        expected = f"is answered so that the receiver's code is {runtime.ics.reading('receiver-code')}, as declared"
        yield _violate(check, call, expected, "receiver-code")
    else:
        yield check.kept()


@property_at("waited", _OK_IF_WELL, timed=True)
def answered_at_all(check: Property, runtime: ObservedRuntime, timeout: Timeout) -> Conclusions:
    """A push that nothing disturbs is answered."""
    for call in msg.messages(runtime):
        if msg.comes_back(call):
            continue
        if call.reply is not None or not msg.is_whole(runtime, call) or not msg.is_healthy(runtime, call):
            continue
        if msg.waited_for(runtime, timeout, call.request.t):
            yield _violate(check, call, "is answered ok", "no answer")


@property_at("closed", _OK_IS_TRUE)
def ok_true(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """Counts messages that got ok and arrived."""
    for call in msg.messages(runtime):
        if call.code == msg.OK and not call.broken and any(d.fit == "same" for d in call.deliveries):
            yield check.kept()


@property_at("waited", _OK_IS_TRUE, timed=True)
def ok_kept(check: Property, runtime: ObservedRuntime, timeout: Timeout) -> Conclusions:
    """A message answered ok arrives, if nothing is broken and the receivers are well."""
    for call, missing in msg.overdue(runtime, timeout):
        if call.code == msg.OK and not call.deliveries and not msg.is_disturbed(runtime, call):
            names = ", ".join(sorted(end.member.lane for end in missing))
            expected = f"was answered ok and comes to {names}"
            yield _violate(check, call, expected, "lost", "it came to no receiver", timeout.n)


@property_at("completed", _OK_IS_TRUE)
def delivered_before_ok(check: Property, runtime: ObservedRuntime, call: MethodCall) -> Conclusions:
    """Where the vendor has declared it, push gives ok when every receiver has the message."""
    if not call.is_message or call.code != msg.OK or not msg.is_whole(runtime, call) or not msg.is_calm(runtime, call):
        return
    receivers = [end for end in msg.lasting(runtime, call) if msg.is_well(end.member) and not msg.counts(end.member)]
    late = [end for end in receivers if not call.delivered_to(end.member, end.port)]
    if (
        receivers
        and not (yield from takes(runtime, "message-delivery", "asynchronous" if late else "synchronous"))
        and late
    ):
        expected = f"comes to {late[0].member.lane} before push returns, as declared"
        yield _violate(check, call, expected, "not yet", "push returned before")


@property_at("completed", "R-10.1.2-01", _SERVED, timed=True)
def failure_noticed(check: Property, runtime: ObservedRuntime, call: MethodCall) -> Concluded:
    """While its connector is known to be broken an interaction does not seem to succeed."""
    if call.link is None or not call.broken or call.reply is None:
        return ()
    if call.link.connector == s.SERVICE_CONNECTOR:
        return _failed_request(check, runtime, call)
    if call.is_message and _is_still_broken(call) and _is_known(runtime, call):
        if call.code == msg.OK:
            where = (
                f"the {call.broken} of its connection is broken"
                if call.broken == "transport"
                else "it is broken inside"
            )
            return _violate(check, call, f"is not answered ok while {where}", "ok")
        return check.kept()
    return ()


def _failed_request(check: Property, runtime: ObservedRuntime, call: MethodCall) -> Conclusions:
    reply = call.reply
    assert reply is not None
    if reply.failed:
        if not _is_broken_only(call):
            return
        taken, reading = (yield from takes(runtime, "service-failure", "raise")), "raise"
    elif any(d.exit is not None and d.exit.results == reply.results for d in call.deliveries):
        taken, reading = _is_still_broken(call) or (yield from takes(runtime, "service-failure", "wait")), "wait"
    else:
        expected = "does not return as if its server had answered: the connection is broken"
        yield _violate(check, call, expected, "invented result", requirement=_SERVED)
        return
    if taken:
        yield check.kept()
    else:
        declared = runtime.ics.reading("service-failure")
        expected = f"ends as declared of calls whose connection is broken: {declared}"
        yield _violate(check, call, expected, reading)


def _is_broken_only(call: MethodCall) -> bool:
    """Is its connection still broken, and can nothing else be why it was not carried out?"""
    servers = call.link.live("server") if call.link is not None else []
    is_served = bool(servers) and all(end.member.serving for end in servers)
    is_in_phase = call.caller is not None and call.caller.serving
    return _is_still_broken(call) and not call.deliveries and is_served and is_in_phase


@property_at("completed", _INTERNAL)
def internal_error_when_due(check: Property, runtime: ObservedRuntime, call: MethodCall) -> Concluded:
    """A push through a connector that is broken inside gives internal_error."""
    if not call.is_message or call.broken != "inside" or not _is_still_broken(call) or not _has_receivers(call):
        return ()
    if call.code == msg.INTERNAL_ERROR:
        return check.kept()
    expected = "is answered internal_error: its connector is broken inside"
    return _violate(check, call, expected, "another code")


@property_at("completed", _TRANSMISSION, timed=True)
def comm_error_when_due(check: Property, runtime: ObservedRuntime, call: MethodCall) -> Conclusions:
    """A push through a transport that is broken gives comm_error, at the latest when the connector must know."""
    if not call.is_message or call.broken != "transport" or not _is_still_broken(call) or not _has_receivers(call):
        return
    if call.code == msg.COMM_ERROR:
        yield check.kept()
        if call is _first_to_meet(runtime, call):
            yield Taken("comm-error", "at-once")
    elif _is_known(runtime, call) or not (yield from takes(runtime, "comm-error", "eventually")):
        expected = "is answered comm_error: the transport of its connection is broken"
        yield _violate(check, call, expected, "another code")


@property_at("completed", _INTERNAL, _TRANSMISSION, timed=True)
def ok_after_mending(check: Property, runtime: ObservedRuntime, call: MethodCall) -> Concluded:
    """When what was broken has been mended push gives ok again."""
    link = call.link
    if link is None or not link.mended_at or not link.was_broken:  # a hook that cannot break it may still mend it
        return ()
    if not _is_undisturbed(runtime, call) or not msg.is_quiet(runtime, call):
        return ()
    if not all(msg.is_well(end.member) for end, _ in call.targets):
        return ()
    requirement = _DUE[link.was_broken]
    if call.code == msg.OK:
        return check.kept(requirement)
    return _violate(check, call, "is answered ok: its connection was mended", "mended", requirement=requirement)


def _is_undisturbed(runtime: ObservedRuntime, call: MethodCall) -> bool:
    """Is it a message that has been answered, by a connector that was whole and had only receivers that are operational?"""
    if call.reply is None or call.reply.wrong:
        return False
    return call.is_message and msg.is_whole(runtime, call) and msg.is_healthy(runtime, call)


def _is_still_broken(call: MethodCall) -> bool:
    """Has its link been broken all the while?"""
    link = call.link
    return link is not None and link.broken == call.broken and link.broken_at <= call.request.t


def _has_receivers(call: MethodCall) -> bool:
    if call.reply is not None and call.reply.wrong:
        return False
    serving = call.caller is not None and call.caller.serving
    return bool(serving and any(ready for _, ready in call.targets))


def _first_to_meet(runtime: ObservedRuntime, call: MethodCall) -> MethodCall:
    """The first message pushed through the link since it was broken."""
    since = call.link.broken_at if call.link is not None else 0
    return next(c for c in msg.messages(runtime) if c.link is call.link and c.broken and c.request.t >= since)


def _is_known(runtime: ObservedRuntime, call: MethodCall) -> bool:
    """Must the connector know by now that it is broken?"""
    if not _has_receivers(call):
        return False
    first = _first_to_meet(runtime, call)
    return call.broken == "inside" or call.request.t - first.request.t >= msg.settling_time(runtime)


def _violate(
    check: Property,
    call: MethodCall,
    expected: str,
    cause: str,
    observed: str = "",
    *further: int,
    requirement: str = "",
) -> Finding:
    return check.fail(
        cause,
        expected=f"{msg.name_of(call)} {expected}",
        observed=observed or _answer(call),
        at=msg.events_of(call, *further),
        requirement=requirement,
    )


def _answer(call: MethodCall) -> str:
    if call.reply is None:
        return "there was no answer"
    if call.reply.failed:
        return f"it ended with exception {call.reply.exception or ''}".rstrip()
    return f"the answer was {', '.join(map(printed, call.reply.results or ())) or 'nothing'}"
