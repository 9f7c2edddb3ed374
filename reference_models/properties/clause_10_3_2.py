"""Properties about index timers as such: components with them are started, get the service, and provide the callback (10.3.2)."""

from __future__ import annotations

from collections.abc import Generator

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_values import printed
from ucm_cts.adapters.contract.scenario import Declaration
from ucm_cts.adapters.contract.trace import Raise
from ucm_cts.reference_models.conclusions import Concluded, Conclusions, Taken, takes
from ucm_cts.reference_models.model import execution_policies as policies
from ucm_cts.reference_models.model.callback_history import Callback
from ucm_cts.reference_models.model.index_timers import all_timers, is_callback, service_calls_of, timer_phases
from ucm_cts.reference_models.model.method_calls import Delivery, MethodCall
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.operation import OperationInProgress
from ucm_cts.reference_models.model.paced_phases import granularity, lateness, shown
from ucm_cts.reference_models.model.runtime import has_meaningless_values, lane, raises
from ucm_cts.reference_models.model.service_policies import has_several_clocks, has_timers, policies_of, policy_elements
from ucm_cts.reference_models.model.timer_events import SECOND, Timer, TimerCallback, TimerPhase, time_out_of
from ucm_cts.reference_models.model.timer_times import earliest
from ucm_cts.reference_models.properties.declaration import Property, property_at

_SUPPORTED, _CALLBACK, _SERVICE, _NOT_WITHOUT = "R-10.3.2-19", "R-10.3.2-20", "R-10.3.2-23", "R-10.3.2-24"
_SEVERAL, _AT_ONCE = "R-10.3-09", "R-10.3.2-41"
_SERVICE_METHODS = s.TIMER_METHODS - {s.ON_TIMEOUT}


@property_at("ended", _SUPPORTED, _SEVERAL, at=("add_component", "start"), feature="timers")
def timers_supported(check: Property, runtime: ObservedRuntime, ongoing: OperationInProgress) -> Conclusions:
    """A component with index timers is added and started; one with two policies for them may be refused."""
    if isinstance(ongoing.step, s.AddComponent):
        declaration = runtime.scenario.components.get(ongoing.step.component)
        if not isinstance(ongoing.end, Raise) or declaration is None or ongoing.container.started is not False:
            return
        if not has_meaningless_values(declaration, ongoing.step):
            yield from _refused(check, runtime, declaration, "add_component", ongoing.end)
        return
    for member in ongoing.container.live_members():
        if not has_timers(member.declaration):
            continue
        if isinstance(ongoing.end, Raise):
            if len(ongoing.container.live_members()) == 1 and member.connected:
                yield from _refused(check, runtime, member.declaration, "start", ongoing.end)
        elif ongoing.judged and "on_startup" in [c.hook for c in ongoing.by_body.get(member.body, ())]:
            if len(policies_of(member.declaration, s.INDEX_TIMERS)) == 1:
                yield check.kept()
                if any(not has_timers(other.declaration) for other in ongoing.container.live_members()):
                    yield check.kept(_SEVERAL)
            elif not (yield from takes(runtime, "second-timer-policy", "separate")):
                yield check.fail(
                    "second policy",
                    expected=f"'{member.lane}', which has two policies for index timers, is refused, as declared",
                    observed="start returned",
                    event=ongoing.end,
                    requirement=_SEVERAL,
                )


def _refused(
    check: Property, runtime: ObservedRuntime, declaration: Declaration, operation: str, end: Raise
) -> Conclusions:
    timers = policies_of(declaration, s.INDEX_TIMERS)
    others = policies_of(declaration, s.COMPONENT_TRACE, s.PORT_TRACE)
    excused = others or has_several_clocks(declaration) or policies.is_contradictory(declaration)
    excused = excused or policies.extended_policy(declaration) is not None or policies.has_unknown_policy(declaration)
    if not timers or excused or raises(declaration, "on_init", "on_startup", "set_container_interface"):
        return
    if len(timers) > 1:
        if not (yield from takes(runtime, "second-timer-policy", "refused")):
            expected = "a component with two policies for index timers is added and started, as declared"
            yield check.refused(operation, end, expected=expected, cause="second policy", requirement=_SEVERAL)
        return
    yield check.refused(operation, end, expected="a component with index timers is added and started")


@property_at("entered", _NOT_WITHOUT, at=("on_startup",), feature="timers")
def no_timers_without_policy(check: Property, runtime: ObservedRuntime, callback: Callback) -> Conclusions:
    """on_startup hands over no reference of the service to a component without the policy."""
    event, member, ongoing, _ = callback
    if member is None or member.operational or has_timers(member.declaration):
        return
    of_others = {e for d in runtime.scenario.components.values() for e in policy_elements(d, s.INDEX_TIMERS)}
    given = {d.port for d in event.dependencies or () if any(r is not None for r in d.references)}
    wrong = sorted(of_others & given - {*member.declaration.requires})
    if not wrong:
        yield check.kept()
        return
    yield check.fail(
        "without policy",
        expected=f"'{member.lane}', which has no timers, is handed no reference for {wrong[0]}",
        observed="it was handed one",
        during=(ongoing, event),
    )


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
    if timer.delay == (0, False):
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
    if is_open or due is None or call.reply is None:
        return False
    return timer.rate is not None or call.reply.t < due


@property_at("closed", _AT_ONCE, feature="timers", timed=True)
def timer_service_returns_at_once(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """Starting and cancelling a timer do not wait for its expiry."""
    for timer in all_timers(runtime):
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


def at_of(timer: Timer, *callbacks: TimerCallback) -> tuple[int, ...]:
    """The events of a finding: how the timer was started, and its callbacks."""
    return (timer.call.request.n, *(c.n for c in callbacks))
