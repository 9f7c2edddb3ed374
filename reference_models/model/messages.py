"""Conditions for the delivery of a message: working receivers, an unbroken connection and enough time (10.1.2, 10.1.6)."""

from __future__ import annotations

from collections.abc import Iterator

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_values import printed
from ucm_cts.adapters.contract.trace import Timeout
from ucm_cts.reference_models.model.execution_policies import protection_of
from ucm_cts.reference_models.model.links import End
from ucm_cts.reference_models.model.method_calls import MethodCall
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.runtime import Member

OK, INTERNAL_ERROR, COMM_ERROR = "ok", "internal_error", "comm_error"
CODES = (OK, INTERNAL_ERROR, COMM_ERROR)
"""The return codes of 10.1.2."""

_NANOSECONDS = 1_000_000
"""In a millisecond."""

_LONGEST = 200
"""The most characters of a message's values that findings show."""

PUNCTUALITY = 0.9
"""A wait for patience may end after this part of it: clocks differ."""


def messages(runtime: ObservedRuntime) -> Iterator[MethodCall]:
    """All messages pushed so far."""
    return (call for call in runtime.interactions.calls if call.is_message)


def answer_to_push(member: Member) -> str:
    """The code that a receiver's plan has it answer; empty if it raises or gives none."""
    plan = member.declaration.plan.get("method", ())
    if counts(member):
        return OK
    answers = [a for a in plan if isinstance(a, s.Answer) and a.method == s.PUSH]
    if member.raises("method") or not answers or answers[-1].exception is not None:
        return ""
    results = answers[-1].results
    return str(results[0]) if results else ""


def is_well(member: Member) -> bool:
    """Does it answer ok?"""
    return answer_to_push(member) == OK


def counts(member: Member) -> bool:
    """Does it count what it gets and record no single message?"""
    return any(isinstance(a, s.CountMessages) for a in member.declaration.plan.get("method", ()))


def may_miss_an_end(call: MethodCall) -> bool:
    """Is comm_error true because an end of its connection has been removed without being detached?"""
    return call.code == COMM_ERROR and call.link is not None and call.link.has_lost_an_end


def comes_back(call: MethodCall) -> bool:
    """Is one of its receivers the emitter itself, or a component that waits for the emitter? What becomes of calls that come back to a
    component that may be protected is open (protected-recursion).
    """
    return any(
        (end.member is call.caller or call.business.leads_back_to(end.member))
        and protection_of(end.member.declaration) != "unprotected"
        for end, _ in call.targets
    )


def settling_time(runtime: ObservedRuntime) -> float:
    """Nanoseconds that a connector may take to learn that it was broken or mended."""
    return runtime.ics.tolerance("error-known-within") * _NANOSECONDS


def is_whole(runtime: ObservedRuntime, call: MethodCall) -> bool:
    """Has nothing been broken when it was pushed, nor since, nor mended so lately that the connector need not know?

    Connections may share what is broken.
    """
    links = runtime.interactions.links.values()
    if call.link is None or any(link.broken or link.broken_at > call.request.t for link in links):
        return False
    mended_at = max(link.mended_at for link in links)
    return not mended_at or call.request.t - mended_at >= settling_time(runtime)


def lasting(runtime: ObservedRuntime, call: MethodCall) -> list[End]:
    """The receivers that were operational when it was pushed and have been ever since."""
    return [end for end in of_one_phase(runtime, call) if end.member.serving]


def of_one_phase(runtime: ObservedRuntime, call: MethodCall) -> list[End]:
    """The receivers that were operational when it was pushed and have not been started again, nor detached."""
    kept = [end for end, ready in call.targets if ready and end.until is None]
    return [end for end in kept if end.member.operational and not was_restarted(runtime, call, end.member)]


def is_quiet(runtime: ObservedRuntime, call: MethodCall) -> bool:
    """Has nothing else been on its way that could fill a queue, and has no receiver been held?"""
    return not call.crowded and not runtime.interactions.held


def is_healthy(runtime: ObservedRuntime, call: MethodCall) -> bool:
    """Are its emitter and all its receivers, one at least, operational, and have they been since it was pushed?"""
    receivers = lasting(runtime, call)
    all_ready = call.caller is not None and call.caller.serving and 0 < len(receivers) == len(call.targets)
    return all_ready and is_calm(runtime, call)


def is_calm(runtime: ObservedRuntime, call: MethodCall) -> bool:
    """Has nothing been started, stopped or changed since it was pushed?"""
    changes, since = runtime.interactions.changes, call.request.n
    return not any(operation.end is None or operation.end.n > since for operation in changes)


def was_delivered(call: MethodCall, end: End) -> bool:
    """Has it entered that receiver?"""
    return bool(call.delivered_to(end.member, end.port))


def is_disturbed(runtime: ObservedRuntime, call: MethodCall) -> bool:
    """Does one of its receivers fail, or was one held when it was pushed or afterwards?"""
    receivers = [end.member for end, _ in call.targets]
    held = [d for d in runtime.interactions.deliveries if d.was_held and d.receiver in receivers]
    return not all(map(is_well, receivers)) or any(d.exit is None or d.exit.n > call.request.n for d in held)


def waited_for(runtime: ObservedRuntime, timeout: Timeout, since: int) -> bool:
    """Has patience run out for what was due from ``since`` (``t``) on, while no body is held that could be the reason?"""
    interactions = runtime.interactions
    patience = runtime.scenario.patience * _NANOSECONDS * PUNCTUALITY
    return not interactions.held and timeout.t - max(since, interactions.released_at) >= patience


def overdue(runtime: ObservedRuntime, timeout: Timeout) -> Iterator[tuple[MethodCall, list[End]]]:
    """Answered messages, and the receivers that are well and operational all the while and were waited for in vain."""
    for call in messages(runtime):
        if call.reply is None or call.reply.wrong or not is_whole(runtime, call):
            continue
        if call.link is not None and runtime.interactions.is_mistyped(call.link):
            continue
        if not waited_for(runtime, timeout, call.reply.t):
            continue
        well = [end for end in lasting(runtime, call) if is_well(end.member) and not counts(end.member)]
        missing = [end for end in well if not was_delivered(call, end)]
        if missing:
            yield call, missing


def name_of(call: MethodCall) -> str:
    """The message, as findings name it."""
    emitter = call.caller.lane if call.caller is not None else call.request.component
    values = printed(call.request.arguments or ())
    return f"{values if len(values) <= _LONGEST else f'{values[:_LONGEST]}…'} of {emitter}"


def events_of(call: MethodCall, *further: int) -> tuple[int, ...]:
    """The events by which the message was pushed and answered, and further ones."""
    return (call.request.n, *((call.reply.n,) if call.reply is not None else ()), *further)


def was_restarted(runtime: ObservedRuntime, call: MethodCall, receiver: Member) -> bool:
    """Has the receiver's last on_startup begun after the message was pushed?"""
    return runtime.startups.get(receiver.body, (0, 0))[0] > call.request.n
