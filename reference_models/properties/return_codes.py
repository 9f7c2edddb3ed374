"""Properties about return codes: what a push is answered, and whether that is true (10.1.2)."""

from __future__ import annotations

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.trace import Raise, Return, Timeout
from ucm_cts.reference_models.model.interactions import MethodCall
from ucm_cts.reference_models.model.links import LinkState
from ucm_cts.reference_models.model.messages import (
    CODES,
    COMM_ERROR,
    INTERNAL_ERROR,
    OK,
    answer_to_push,
    counts,
    events_of,
    is_calm,
    is_disturbed,
    is_healthy,
    is_quiet,
    is_well,
    is_whole,
    lasting,
    messages,
    name_of,
    overdue,
    settling_time,
    waited_for,
)
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.runtime import OperationInProgress
from ucm_cts.reference_models.properties.declaration import property_at
from ucm_cts.reference_models.verdicts import Verdicts

_DUE = {"transport": ("R-10.1.2-12", COMM_ERROR), "inside": ("R-10.1.2-11", INTERNAL_ERROR)}


@property_at("completed", "R-10.1.2-02")
def known_codes(verdicts: Verdicts, runtime: ObservedRuntime, call: MethodCall) -> None:
    """Whatever push gives back is one of the three codes."""
    if not call.is_message or call.reply is None or call.caller is None or not call.caller.serving:
        return
    results = list(call.reply.results or ())
    if not call.reply.raised and call.reply.exception is None and len(results) == 1 and results[0] in CODES:
        verdicts.exercised("R-10.1.2-02")
        return
    _violate(verdicts, "R-10.1.2-02", "known_codes", call, f"is answered {' or '.join(CODES)}", "unknown")


@property_at("completed", "R-10.1.2-02")
def without_receivers(verdicts: Verdicts, runtime: ObservedRuntime, call: MethodCall) -> None:
    """A push that nobody receives is answered what the vendor has declared."""
    if (
        not call.is_message
        or call.targets
        or not call.ready
        or not is_whole(verdicts, runtime, call)
        or call.code not in CODES
    ):
        return
    declared = verdicts.ics.reading("push-without-receiver")
    if declared == "refused" and call.link is not None and any(end.role == "receiver" for end in call.link.ends):
        return  # what was refused is to connect or start without one; this one lost its receivers later
    if not verdicts.observed("push-without-receiver", str(call.code)):
        expected = f"has no receiver, for which {declared} was declared"
        _violate(verdicts, "R-10.1.2-02", "without_receivers", call, expected, "without receivers")


@property_at("ended", "R-10.1.2-02", at=("start",), feature="interactions")
def refused_without_receivers(
    verdicts: Verdicts, runtime: ObservedRuntime, ongoing: OperationInProgress, end: Return | Raise
) -> None:
    """A connection without receivers is refused only where the vendor has declared it."""
    if not isinstance(end, Raise) or any(not m.connected for m in ongoing.container.members):
        return
    links = [k for k in runtime.interactions.improper(ongoing.container) if k.live("emitter")]
    if links and not verdicts.observed("push-without-receiver", "refused"):
        declared = verdicts.ics.reading("push-without-receiver")
        verdicts.violated(
            "R-10.1.2-02",
            "refused_without_receivers",
            "refused",
            f"push-without-receiver was declared as {declared}: who has nobody to push to is started",
            f"start raised {end.error}",
            (ongoing.call, end.n),
            ongoing.step_number,
        )


@property_at("linked", "R-10.1.2-02")
def refused_attachment(
    verdicts: Verdicts, runtime: ObservedRuntime, link: LinkState | None, step: s.ConnectorCall, end: Return | Raise
) -> None:
    """An emitter that has no receiver yet is refused only where the vendor has declared it."""
    if not isinstance(step, s.Attach) or step.role != "emitter" or link is None or link.live("receiver"):
        return
    if isinstance(end, Raise) and not verdicts.observed("push-without-receiver", "refused"):
        declared = verdicts.ics.reading("push-without-receiver")
        expected = f"push-without-receiver was declared as {declared}: an emitter can be attached before a receiver"
        observed = f"it raised {end.error}"
        verdicts.violated("R-10.1.2-02", "refused_attachment", "refused", expected, observed, (end.n,), end.step)


@property_at("completed", "R-10.1.2-09")
def ok_when_healthy(verdicts: Verdicts, runtime: ObservedRuntime, call: MethodCall) -> None:
    """Nothing disturbs the push, so it gives ok."""
    if not _is_undisturbed(verdicts, runtime, call) or call.link is None or call.link.broken_at:
        return
    if all(is_well(end.member) for end, _ in call.targets):
        if call.code == OK:
            verdicts.exercised("R-10.1.2-09")
            return
        blocking = verdicts.ics.reading("message-overflow") == "block"
        if is_quiet(runtime, call) or (blocking and call.code in CODES):
            expected = "is answered ok: all its receivers are operational and well, and nothing is broken"
            _violate(verdicts, "R-10.1.2-09", "ok_when_healthy", call, expected, "not ok")


@property_at("completed", "R-10.1.2-09")
def receivers_codes(verdicts: Verdicts, runtime: ObservedRuntime, call: MethodCall) -> None:
    """What a receiver answers is dropped, and the code is ok, or passed on, and the code is that of one that was not ok."""
    if not _is_undisturbed(verdicts, runtime, call) or not is_quiet(runtime, call):
        return
    answers = {answer_to_push(end.member) for end, _ in call.targets}
    if answers == {OK} or not answers <= {*CODES}:
        return  # ok_when_healthy's matter; after an exception any code will do
    reading = "dropped" if call.code == OK else "passed"
    if call.code != OK and call.code not in answers:
        expected = f"is answered ok, or what a receiver answered: {', '.join(sorted(answers - {OK}))}"
        _violate(verdicts, "R-10.1.2-09", "receivers_codes", call, expected, "another code")
    elif not verdicts.observed("receiver-code", reading):
        expected = f"is answered so that the receiver's code is {verdicts.ics.reading('receiver-code')}, as declared"
        _violate(verdicts, "R-10.1.2-09", "receivers_codes", call, expected, "receiver-code")
    else:
        verdicts.exercised("R-10.1.2-09")


@property_at("waited", "R-10.1.2-09", timed=True)
def answered_at_all(verdicts: Verdicts, runtime: ObservedRuntime, timeout: Timeout) -> None:
    """A push that nothing disturbs is answered."""
    for call in messages(runtime):
        if call.reply is not None or not is_whole(verdicts, runtime, call) or not is_healthy(runtime, call):
            continue
        if waited_for(runtime, timeout, call.request.t):
            _violate(verdicts, "R-10.1.2-09", "answered_at_all", call, "is answered ok", "no answer")


@property_at("closed", "R-10.1.2-10")
def ok_true(verdicts: Verdicts, runtime: ObservedRuntime) -> None:
    """Counts messages that got ok and arrived."""
    for call in messages(runtime):
        if call.code == OK and not call.broken and any(d.fit == "same" for d in call.deliveries):
            verdicts.exercised("R-10.1.2-10")


@property_at("waited", "R-10.1.2-10", timed=True)
def ok_kept(verdicts: Verdicts, runtime: ObservedRuntime, timeout: Timeout) -> None:
    """What got ok arrives, if nothing is broken and the receivers are well."""
    for call, missing in overdue(verdicts, runtime, timeout):
        if call.code == OK and not call.deliveries and not is_disturbed(runtime, call):
            names = ", ".join(sorted(end.member.lane for end in missing))
            expected = f"was answered ok and comes to {names}"
            _violate(verdicts, "R-10.1.2-10", "ok_kept", call, expected, "lost", "it came to nobody", timeout.n)


@property_at("completed", "R-10.1.2-10")
def delivered_before_ok(verdicts: Verdicts, runtime: ObservedRuntime, call: MethodCall) -> None:
    """Where the vendor has declared it, push gives ok when every receiver has the message."""
    if not call.is_message or call.code != OK or not is_whole(verdicts, runtime, call) or not is_calm(runtime, call):
        return
    receivers = [end for end in lasting(runtime, call) if is_well(end.member) and not counts(end.member)]
    late = [end for end in receivers if not call.delivered_to(end.member, end.port)]
    if receivers and not verdicts.observed("message-delivery", "asynchronous" if late else "synchronous") and late:
        expected = f"comes to {late[0].member.lane} before push returns, as declared"
        _violate(verdicts, "R-10.1.2-10", "delivered_before_ok", call, expected, "not yet", "push returned before")


@property_at("completed", "R-10.1.2-01", timed=True)
def failure_noticed(verdicts: Verdicts, runtime: ObservedRuntime, call: MethodCall) -> None:
    """While its connector is known to be broken an interaction does not look as if it had gone well."""
    if call.link is None or not call.broken or call.reply is None:
        return
    if call.link.connector == s.SERVICE_CONNECTOR:
        _failed_request(verdicts, call)
    elif call.is_message and _is_still_broken(call) and _is_known(verdicts, runtime, call):
        if call.code == OK:
            where = (
                f"the {call.broken} of its connection is broken"
                if call.broken == "transport"
                else "it is broken inside"
            )
            _violate(verdicts, "R-10.1.2-01", "failure_noticed", call, f"is not answered ok while {where}", "ok")
        else:
            verdicts.exercised("R-10.1.2-01")


def _failed_request(verdicts: Verdicts, call: MethodCall) -> None:
    reply = call.reply
    assert reply is not None
    if reply.raised or reply.exception is not None:
        taken, reading = verdicts.observed("service-failure", "raise"), "raise"
    elif any(d.exit is not None and d.exit.results == reply.results for d in call.deliveries):
        taken, reading = _is_still_broken(call) or verdicts.observed("service-failure", "wait"), "wait"
    else:
        expected = "does not return as if its server had answered: the connection is broken"
        _violate(verdicts, "R-10.1.2-01", "failure_noticed", call, expected, "invented result")
        return
    if taken:
        verdicts.exercised("R-10.1.2-01")
    else:
        declared = verdicts.ics.reading("service-failure")
        expected = f"ends as declared of calls whose connection is broken: {declared}"
        _violate(verdicts, "R-10.1.2-01", "failure_noticed", call, expected, reading)


@property_at("completed", "R-10.1.2-11")
def internal_error_when_due(verdicts: Verdicts, runtime: ObservedRuntime, call: MethodCall) -> None:
    """A push through a connector that is broken inside gives internal_error."""
    if not call.is_message or call.broken != "inside" or not _is_still_broken(call) or not _has_receivers(call):
        return
    if call.code == INTERNAL_ERROR:
        verdicts.exercised("R-10.1.2-11")
    else:
        expected = "is answered internal_error: its connector is broken inside"
        _violate(verdicts, "R-10.1.2-11", "internal_error_when_due", call, expected, "another code")


@property_at("completed", "R-10.1.2-12", timed=True)
def comm_error_when_due(verdicts: Verdicts, runtime: ObservedRuntime, call: MethodCall) -> None:
    """A push through a transport that is broken gives comm_error, at the latest when the connector must know."""
    if not call.is_message or call.broken != "transport" or not _is_still_broken(call) or not _has_receivers(call):
        return
    if call.code == COMM_ERROR:
        verdicts.exercised("R-10.1.2-12")
        if call is _first_to_meet(runtime, call):
            verdicts.observed("comm-error", "at-once")
    elif _is_known(verdicts, runtime, call) or not verdicts.observed("comm-error", "eventually"):
        expected = "is answered comm_error: the transport of its connection is broken"
        _violate(verdicts, "R-10.1.2-12", "comm_error_when_due", call, expected, "another code")


@property_at("completed", "R-10.1.2-11", "R-10.1.2-12", timed=True)
def ok_after_mending(verdicts: Verdicts, runtime: ObservedRuntime, call: MethodCall) -> None:
    """When what was broken has been mended push gives ok again."""
    link = call.link
    if link is None or not link.mended_at or not link.was_broken:  # who could not break it may still mend it
        return
    if not _is_undisturbed(verdicts, runtime, call) or not is_quiet(runtime, call):
        return
    if not all(is_well(end.member) for end, _ in call.targets):
        return
    requirement, _ = _DUE[link.was_broken]
    if call.code == OK:
        verdicts.exercised(requirement)
    else:
        _violate(verdicts, requirement, "ok_after_mending", call, "is answered ok: its connection was mended", "mended")


def _is_undisturbed(verdicts: Verdicts, runtime: ObservedRuntime, call: MethodCall) -> bool:
    """Is it a message that has been answered, by a connector that was whole and had only receivers that are operational?"""
    return (
        call.is_message and call.reply is not None and is_whole(verdicts, runtime, call) and is_healthy(runtime, call)
    )


def _is_still_broken(call: MethodCall) -> bool:
    """Has its link been broken all the while?"""
    link = call.link
    return link is not None and link.broken == call.broken and link.broken_at <= call.request.t


def _has_receivers(call: MethodCall) -> bool:
    serving = call.caller is not None and call.caller.serving
    return bool(serving and any(ready for _, ready in call.targets))


def _first_to_meet(runtime: ObservedRuntime, call: MethodCall) -> MethodCall:
    """The first message pushed through the link since it was broken."""
    since = call.link.broken_at if call.link is not None else 0
    return next(c for c in messages(runtime) if c.link is call.link and c.broken and c.request.t >= since)


def _is_known(verdicts: Verdicts, runtime: ObservedRuntime, call: MethodCall) -> bool:
    """Must the connector know by now that it is broken?"""
    if not _has_receivers(call):
        return False
    first = _first_to_meet(runtime, call)
    return call.broken == "inside" or call.request.t - first.request.t >= settling_time(verdicts)


def _violate(
    verdicts: Verdicts,
    requirement: str,
    rule_name: str,
    call: MethodCall,
    expected: str,
    cause: str,
    observed: str = "",
    *further: int,
) -> None:
    verdicts.violated(
        requirement,
        rule_name,
        cause,
        f"{name_of(call)} {expected}",
        observed or _answer(call),
        events_of(call, *further),
    )


def _answer(call: MethodCall) -> str:
    if call.reply is None:
        return "there was no answer"
    if call.reply.raised or call.reply.exception is not None:
        return f"it ended with exception {call.reply.exception or ''}".rstrip()
    return f"the answer was {', '.join(map(str, call.reply.results or ())) or 'nothing'}"
