"""Properties about index timers as such: their service returns, and they call on_timeout (10.3.2)."""

from __future__ import annotations

from collections.abc import Generator

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_values import printed
from ucm_cts.reference_models.conclusions import Concluded, Conclusions, Taken, takes
from ucm_cts.reference_models.model.index_timers import is_callback, service_calls_of, timer_phases
from ucm_cts.reference_models.model.method_calls import Delivery, MethodCall
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.paced_phases import granularity, lateness, shown
from ucm_cts.reference_models.model.runtime import lane
from ucm_cts.reference_models.model.service_policies import policies_of
from ucm_cts.reference_models.model.timer_events import SECOND, Timer, TimerPhase, time_out_of
from ucm_cts.reference_models.model.timer_times import earliest
from ucm_cts.reference_models.properties.declaration import Property, property_at

_CALLBACK, _SERVICE, _SEVERAL, _AT_ONCE = "R-10.3.2-20", "R-10.3.2-23", "R-10.3-09", "R-10.3.2-41"
_SERVICE_METHODS = s.TIMER_METHODS - {s.ON_TIMEOUT}


@property_at("delivered", _CALLBACK, feature="timers")
def timers_call_on_timeout(check: Property, runtime: ObservedRuntime, delivery: Delivery) -> Concluded:
    """Timers call on_timeout of timer_callback with a time and a number, and nothing else of a component."""
    enter, by_nobody = delivery.enter, delivery.call is None
    if enter.wrong:
        return ()
    if enter.port == s.TIMER_CALLBACK:
        arguments = enter.arguments or ()
        is_right = enter.method == s.ON_TIMEOUT and len(arguments) == 2 and time_out_of(arguments[0]) is not None
        number = arguments[1] if is_right else None
        if isinstance(number, int) and not isinstance(number, bool) and 0 <= number <= s.LARGEST_NUMBER:
            return check.kept()
        observed = f"its {enter.method} was called with {printed(arguments)}"
    elif enter.method == s.ON_TIMEOUT and by_nobody:
        observed = f"on_timeout was called at {enter.port}"
    else:
        return ()
    return check.fail(
        "otherwise",
        expected=f"timers of '{lane(*enter.body)}' call on_timeout of its timer_callback with a time and a number",
        observed=observed,
        at=(enter.n,),
    )


@property_at("closed", _SERVICE, feature="timers")
def timer_service_returns(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """The four operations of the service return."""
    for phase in timer_phases(runtime):
        returned = {c.request.method for c in phase.calls if c.reply is not None and not c.reply.failed}
        if returned >= _SERVICE_METHODS:
            yield check.kept()
        for call in phase.calls:
            reply = call.reply
            if reply is None or not reply.failed or call.request.method not in _SERVICE_METHODS:
                continue
            if reply.n > phase.of.until:
                continue  # the component is being stopped
            if (yield from _may_raise(runtime, phase, call)):
                continue
            yield check.fail(
                f"{call.request.method} raises",
                expected=f"{call.request.method}({printed(call.request.arguments or ())[1:-1]}) of '{phase.member.lane}' returns",
                observed="it raised" if reply.raised else f"it raised {reply.exception}",
                at=(call.request.n, reply.n),
            )
            break


def _may_raise(runtime: ObservedRuntime, phase: TimerPhase, call: MethodCall) -> Generator[Taken, None, bool]:
    """May the service refuse this call, by a reading that is not declared otherwise?"""
    timer = next((t for t in phase.timers if t.call is call), None)
    if timer is None:
        return not _is_known(runtime, phase, call)
    reasons = []
    before = [t for t in phase.timers if t.number == timer.number and t.call.request.n < call.request.n]
    if timer.is_contested or any(t.is_started and t.waits(call.request.n) for t in before):
        reasons.append(("number-in-use", "refuse"))
    if timer.has_no_delay:
        reasons.append(("zero-delay", "refused"))
    if timer.delay.is_absolute:
        reasons.append(("past-time", "refused"))
    if timer.rate is not None and timer.rate.is_absolute:
        reasons.append(("absolute-rate", "refused"))
    for option, value in reasons:
        if (yield from takes(runtime, option, value)):
            return True
    return False


def _is_known(runtime: ObservedRuntime, phase: TimerPhase, call: MethodCall) -> bool:
    """Is the call certainly about a timer that waits? Then it cannot be refused."""
    number = (call.request.arguments or (None,))[0]
    timers = [t for t in phase.timers if t.number == number and t.call.request.n < call.request.n]
    if not timers or not timers[-1].is_started or not timers[-1].has_usual_times:
        return False
    timer = timers[-1]
    due = earliest(runtime, timer, 0)
    is_open = timer.is_contested or timer.is_in_startup or not timer.waits(call.request.n)
    is_open = is_open or timer.may_have_failed(call.over)
    if is_open or due is None or call.reply is None:
        return False
    return timer.rate is not None or call.reply.t < due


@property_at("closed", _AT_ONCE, feature="timers", timed=True)
def timer_service_returns_at_once(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """Starting and cancelling a timer do not wait for its expiry."""
    for phase in timer_phases(runtime):
        for timer in phase.timers:
            for call in (timer.call, *timer.cancels) if timer.has_usual_times and not timer.is_contested else ():
                yield from _returned(check, runtime, timer, call)


def _returned(check: Property, runtime: ObservedRuntime, timer: Timer, call: MethodCall) -> Conclusions:
    request, reply = call.request, call.reply
    over = reply.t if reply is not None else runtime.interactions.latest
    took = over - request.t
    come = [c for c in timer.callbacks if request.n < c.n < call.over]
    is_start = call is timer.call
    if reply is None and took < SECOND + lateness(runtime):
        return
    if took < timer.delay.lasts - granularity(runtime) and not (is_start and come):
        yield check.kept()
        return
    yield check.fail(
        "waits",
        expected=f"{request.method} of timer {timer.number} returns at once, and does not wait until it is due",
        observed=f"it took {shown(took)}" + (", and the timer called back meanwhile" if come else ""),
        at=(request.n, *(c.n for c in come[:1]), *((reply.n,) if reply is not None else ())),
    )


@property_at("closed", _SEVERAL, feature="timers", timed=True)
def second_policy_has_own_numbers(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """Equal numbers of two policies of one component are two timers, where a second policy is accepted."""
    for member in runtime.bodies.values():
        if len(policies_of(member.declaration, s.INDEX_TIMERS)) < 2 or member.suspended:
            continue
        calls = service_calls_of(runtime, member)
        ports = {
            c.request.port for c in calls if c.request.method == s.START_SPORADIC and c.reply and not c.reply.failed
        }
        come = [e for e in runtime.executions.of(member.body) if is_callback(e)]
        lasting = max((_lasts(c) for c in calls), default=0) + lateness(runtime)
        is_over = bool(calls) and runtime.interactions.latest > calls[-1].request.t + lasting
        if len(ports) == 2 and is_over and len(come) < 2:
            yield check.fail(
                "one timer",
                expected=f"equal numbers in two policies of '{member.lane}' are two timers, and both call back",
                observed=f"there were {len(come)} callbacks",
                at=tuple(c.request.n for c in calls),
            )
        elif len(ports) == 2 and is_over:
            yield check.kept()


def _lasts(call: MethodCall) -> int:
    arguments = call.request.arguments or ()
    time = time_out_of(arguments[1]) if len(arguments) > 1 else None
    return time.lasts if time is not None and not time.is_absolute else 0
