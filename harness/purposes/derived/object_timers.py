"""Scenarios of object timers (10.3.1): single and repeated triggers, handlers, what timers tell, cancels, phases, and protection."""

from __future__ import annotations

import functools

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Declaration, Policy, Scenario, Step
from ucm_cts.harness.purposes.derived import timer_steps
from ucm_cts.harness.purposes.derived.object_timer_steps import (
    ASKS,
    FIRST,
    SCHEDULES,
    SECOND,
    THIRD,
    identified,
    made,
    once,
    own,
    repeated,
    scheduling,
)
from ucm_cts.harness.purposes.derived.through_components import through_components
from ucm_cts.harness.purposes.derived.timer_steps import (
    ACTIVE,
    INSIDE,
    OTHER_PORT,
    PASSIVE,
    PORT,
    SELF,
    TIMERS,
    UNPROTECTED,
    after,
    alone,
    sporadic,
    tell,
    together,
    two_instances,
    while_held,
)
from ucm_cts.harness.purposes.derived.timer_steps import cancel as index_cancel
from ucm_cts.harness.purposes.scripts import TestPurpose

_HOLDS = (s.HoldAtGate(INSIDE),)
_LONG = (2.2, 5, 257, 2148, 4295, 65537, 4294968)
"""Delays, in seconds, that not every type of times has."""

_DOZENS = 103
"""So many timers wait at once."""

_about = functools.partial(timer_steps.purposes_about, kind="object")


def object_timer_purposes() -> list[TestPurpose]:
    """All purposes of 10.3.1."""
    return [
        _support(),
        _once(),
        _several(),
        _repeated(),
        _handlers(),
        _asked(),
        _cancel(),
        _instances(),
        _phases(),
        _startup(),
        _protection(),
        through_components(_protection()),
        _missed(),
        _raising(),
        _unusual(),
        _told(),
        _in_triggers(),
    ]


def _support() -> TestPurpose:
    """Each execution policy with object timers; a component without; index timers beside; a second policy; all methods."""
    orders = (*identified(once(0.2, 1)), repeated(0.2, 0.2, 2, 1, SECOND))
    cases = [
        (policy.definition, alone(scheduling(*orders, policies=(policy, SCHEDULES)), tell(1), after(0.4)))
        for policy in (SELF, ACTIVE, PASSIVE, UNPROTECTED)
    ]
    plain = {"plain": Declaration((PORT,)), "timed": scheduling(once(0.2, 1))}
    cases.append(("beside a component without", together(plain, tell(1, "timed"), tell(1, "plain"), after(0.2))))
    kinds = scheduling(once(0.3, 1), sporadic(5, 1, 1), policies=(SCHEDULES, TIMERS), on_trigger=())
    cases.append(("both kinds", alone(kinds, tell(1), after(1))))
    apart = (
        sporadic(1, 1, 1),
        sporadic(2, 2, 1),
        once(1.5, 1),
        once(2, 1, SECOND),
        index_cancel(1, 2),
        made(s.CANCEL, 2, 2),
    )
    kinds = scheduling(*apart, policies=(SCHEDULES, TIMERS), on_trigger=())
    cases.append(("both kinds, of which one each is cancelled", alone(kinds, tell(1), s.Pause(100), tell(2), after(2))))
    cases.append(("two policies", alone(_two_schedulers(), *map(tell, (1, 2)), after(0.6))))
    return _about("support", "01 16 17 .10", *cases)


def _two_schedulers() -> Declaration:
    """Two timers of each of two schedulers. Of the first one the first is cancelled, of the other one the second."""
    element = "other.timer_scheduler"
    other = Policy(s.OBJECT_TIMERS, element=element)
    orders = (once(0.3, 1), once(0.4, 1), once(0.5, 1, SECOND, element), once(0.6, 1, THIRD, element))
    return scheduling(
        *orders, made(s.CANCEL, 1, 2), made(s.CANCEL, 4, 2, scheduler=element), policies=(SCHEDULES, other)
    )


def _once() -> TestPurpose:
    """One trigger, and then none for three delays; delays with microseconds, and of more than a second."""
    quiet = (tell(1), after(1.4))
    cases = [("one", alone(scheduling(*identified(once(0.4, 1))), *quiet))]
    again = (tell(1), after(0.3), tell(1), after(0.3))
    cases.append(("again when it has come", alone(scheduling(once(0.3, 1), on_trigger=()), *again)))
    delays = scheduling(once(0.250001, 1), once(1.2, 1, SECOND), once(0.5005, 1, THIRD))
    cases.append(("delays", alone(delays, s.Pause(300), tell(1), after(1.2))))
    others = scheduling(once(0.03, 1), once(1.95, 1, SECOND), repeated(1.3, 0.4, 2, 1, THIRD))
    cases.append(("small parts of seconds", alone(others, tell(1), after(1.95))))
    long = identified(*(once(delay, 1) for delay in _LONG))
    cases.append(("long delays", alone(scheduling(*long), tell(1), after(1))))
    return _about("once", "01 18 19 20", *cases)


def _several() -> TestPurpose:
    """Five timers in another order than their calls, on three handlers, and dozens on one."""
    delays = ((0.9, FIRST), (0.3, SECOND), (1.2, THIRD), (0.6, FIRST), (0.15, SECOND))
    orders = identified(*(once(delay, 1, handler) for delay, handler in delays))
    cases = [("five", alone(scheduling(*orders, repeated(0.45, 0.3, 2, 1, THIRD)), tell(1), after(1.2)))]
    sooner = scheduling(once(0.9, 1), once(0.2, 2, SECOND))
    cases.append(("one that is due before those that wait", alone(sooner, tell(1), s.Pause(100), tell(2), after(0.9))))
    many = scheduling(
        *identified(*(once(0.5 + 0.15 * (number % 7), 1) for number in range(_DOZENS))), on_trigger=ASKS[:1]
    )
    others = {"second": scheduling(*identified(once(0.4, 1)))}
    cases.append(("dozens", together({"many": many, **others}, tell(1, "many"), tell(1, "second"), after(1.4))))
    parallel = scheduling(once(0.3, 1), once(0.4, 2, SECOND), once(0.5, 3, THIRD), policies=(UNPROTECTED, SCHEDULES))
    callers = [s.Invoke("tell", value, thread=f"teller {value}") for value in (1, 2, 3)]
    joined = [s.Join(caller.thread or "") for caller in callers]
    cases.append(("by three calls at once", alone(parallel, *callers, *joined, after(0.5))))
    return _about("several", "19 20 25 26 28 34", *cases)


def _repeated() -> TestPurpose:
    """Start delays and intervals that differ, one, two and five rounds, and a long series."""
    rounds = (repeated(0.5, 0.2, 5, 1), repeated(0.2, 0.5, 2, 1, SECOND), repeated(0.3, 0.4, 1, 1, THIRD))
    cases = [("rounds", alone(scheduling(*rounds), tell(1), after(2.2)))]
    two = scheduling(repeated(0.3, 0.3, 3, 1), repeated(0.4, 0.3, 3, 1, SECOND), once(0.5, 1, THIRD))
    cases.append(("two of one length", alone(two, tell(1), after(1.0))))
    series = (tell(1), after(6.9))
    cases.append(("forty", alone(scheduling(repeated(0.3, 0.16, 40, 1), on_trigger=()), *series)))
    quick = scheduling(repeated(0.1, 0.021, 300, 1), on_trigger=())
    cases.append(("three hundred", alone(quick, tell(1), after(0.1 + 299 * 0.021))))
    many = scheduling(
        repeated(0.2, 1.5, 2, 1), repeated(0.2, 0.4, 2**31, 1, SECOND), repeated(0.3, 0.4, 2**32 - 1, 1, THIRD)
    )
    cases.append(("long intervals and many rounds", alone(many, tell(1), after(1.8))))
    more = scheduling(repeated(0.2, 0.4, 2**16 + 1, 1), repeated(0.25, 0.4, 2**8 + 1, 1, SECOND))
    cases.append(("rounds whose low bytes are one", alone(more, tell(1), after(1.4))))
    return _about("repeated", "20 21 22 23 24 30", *cases)


def _handlers() -> TestPurpose:
    """Three timers on one handler and one on another; two handlers in turn."""
    three = identified(once(0.2, 1), once(0.4, 1), once(0.6, 1), once(0.3, 1, SECOND))
    cases = [("three and one", alone(scheduling(*three), tell(1), after(0.6)))]
    turns = identified(once(0.2, 1, SECOND), once(0.4, 1), once(0.6, 1, SECOND), once(0.8, 1, THIRD))
    cases.append(("in turn", alone(scheduling(*turns), tell(1), after(0.8))))
    beside = (*identified(once(0.7, 1)), repeated(0.2, 0.3, 3, 1))
    cases.append(("single and repeated", alone(scheduling(*beside), tell(1), after(0.9))))
    both = (repeated(0.2, 0.3, 3, 1), repeated(0.35, 0.3, 3, 1))
    cases.append(("two repeated on one", alone(scheduling(*both), tell(1), after(1.3))))
    return _about("handlers", "23 25 26 28 29", *cases)


def _asked() -> TestPurpose:
    """Identifier, rounds and is_cancelled before, in and after the trigger."""
    asks = (made(s.TIMER_ID, 1, 2), made(s.TIMER_ROUNDS, 1, 2), made(s.IS_CANCELLED, 1, 2))
    body = scheduling(once(0.3, 1), *asks, made(s.CANCEL, 1, 3))
    cases = [("single", alone(body, tell(1), tell(2), after(0.3), tell(2), tell(3), tell(2)))]
    handed = tuple(own(method, 1, 2) for method in (s.TIMER_ID, s.TIMER_ROUNDS, s.IS_CANCELLED))
    later = scheduling(repeated(0.2, 0.3, 4, 1), *handed)
    cases.append(("repeated", alone(later, tell(1), s.Pause(350), tell(2), after(0.9), tell(2))))
    return _about("asked", "01 24 29 30 33", *cases)


def _cancel() -> TestPurpose:
    """Before expiry, in the own handler, one of three, twice, too late, and while the component is busy."""
    asks = tuple(made(method, 1, 3) for method in (s.IS_CANCELLED, s.TIMER_ID, s.TIMER_ROUNDS))
    before = scheduling(*identified(once(0.4, 1)), *asks, made(s.CANCEL, 1, 2), once(0.2, 4, SECOND))
    later = (tell(4), tell(3), after(1.3), tell(3))
    cases = [("before expiry", alone(before, *map(tell, (1, 3, 2, 3)), *later))]
    ends = scheduling(repeated(0.2, 0.3, 5, 1), on_trigger=(*ASKS, own(s.CANCEL), *ASKS))
    cases.append(("in its handler", alone(ends, tell(1), after(1.2))))
    third = scheduling(repeated(0.2, 0.3, 6, 1), on_trigger=(own(s.CANCEL, 3), own(s.IS_CANCELLED)))
    cases.append(("in its handler, in the third round", alone(third, tell(1), after(1.2))))
    three = (*identified(once(0.4, 1), once(0.5, 1), once(0.6, 1)), made(s.CANCEL, 2, 2), made(s.IS_CANCELLED, 1, 2))
    cases.append(("one of three", alone(scheduling(*three), tell(1), s.Pause(100), tell(2), after(0.6))))
    rest = (made(s.CANCEL, 1, 2), made(s.IS_CANCELLED, 1, 2), made(s.IS_CANCELLED, 2, 2))
    orders = (once(0.3, 1), repeated(0.4, 0.3, 3, 1, SECOND), once(0.9, 1, THIRD), *rest)
    cases.append(("beside others", alone(scheduling(*orders), tell(1), tell(2), after(1.2))))
    twice = scheduling(once(0.3, 1), once(0.5, 1, SECOND), made(s.CANCEL, 1, 2), made(s.IS_CANCELLED, 1, 3))
    cases.append(("twice", alone(twice, *map(tell, (1, 2, 3, 2, 3)), after(0.5))))
    late = scheduling(once(0.2, 1), made(s.CANCEL, 1, 2), made(s.IS_CANCELLED, 1, 3), once(0.3, 4, SECOND))
    cases.append(("too late", alone(late, tell(1), after(0.2), *map(tell, (3, 2, 3, 4)), after(0.3))))
    last = scheduling(once(0.5, 1), made(s.CANCEL, 1, 2))
    cases.append(("just before it is due", alone(last, tell(1), s.Pause(430), tell(2), after(0.4))))
    held = scheduling(once(0.3, 1), *_HOLDS, made(s.CANCEL, 1, 1), policies=(PASSIVE, SCHEDULES))
    waits = while_held(700, 0.1)
    cases.append(("of one that waits for its component", alone(held, *waits)))
    stopped = scheduling(repeated(0.2, 0.3, 6, 1), repeated(0.3, 0.3, 3, 1, SECOND), own(s.CANCEL, 2, 2))
    cases.append(("of a repeated one by another call", alone(stopped, tell(1), s.Pause(400), tell(2), after(1.2))))
    returned = scheduling(repeated(0.4, 0.3, 3, 1), made(s.CANCEL, 1, 2, s.SCHEDULE_REPEATED))
    cases.append(("of a repeated one that came back", alone(returned, tell(1), tell(2), after(1.1))))
    asked_apart = {
        "of one reference, asked of a later one": (own(s.CANCEL, 1, 2), own(s.IS_CANCELLED, 2, 3)),
        "of one reference, asked of an earlier one": (own(s.CANCEL, 2, 2), own(s.IS_CANCELLED, 1, 3)),
        "of one reference, asked of the one returned": (
            own(s.CANCEL, 2, 2),
            made(s.IS_CANCELLED, 1, 3, s.SCHEDULE_REPEATED),
        ),
    }
    for name, pair in asked_apart.items():
        waiting = scheduling(repeated(0.2, 0.3, 6, 1), *pair, on_trigger=())
        cases.append((name, alone(waiting, tell(1), s.Pause(950), tell(3), tell(2), tell(3), after(1))))
    lasting = scheduling(
        repeated(0.3, 0.3, 6, 1),
        policies=(PASSIVE, SCHEDULES),
        on_trigger=(*_HOLDS, own(s.CANCEL), own(s.IS_CANCELLED)),
    )
    long = (tell(1), s.ReachGate(INSIDE), s.Pause(750), s.OpenGate(INSIDE), after(0.7))
    cases.append(("in its handler, which lasts", alone(lasting, *long)))
    return _about("cancel", "31 32 33", *cases)


def _instances() -> TestPurpose:
    """Timers of two instances of one implementation, in one container and in two, of which one stops."""
    same = scheduling(*identified(once(0.4, 1)), repeated(0.2, 0.3, 3, 1, SECOND), made(s.CANCEL, 1, 2))
    names = {"one": same, "other": same}
    cases = [("one cancels", together(names, tell(1, "other"), tell(1, "one"), tell(2, "one"), after(0.9)))]
    cases.append(("the other cancels", together(names, tell(1, "one"), tell(1, "other"), tell(2, "other"), after(0.9))))
    beside = (
        *(s.CreateContainer("below"), s.AddComponent("timed"), s.AddComponent("timed", "below", bind="second")),
        *(s.GetPortElement("timed", PORT, "tell"), s.GetPortElement("second", PORT, "tell second", "below")),
        *(s.Start(), s.Start("below"), tell(1), tell(1, "second"), tell(2), after(0.9), s.Stop("below"), s.Stop()),
    )
    cases.append(("in another container", Scenario({"timed": same}, beside, 4000)))
    cases.append(("of one implementation", two_instances(same, after(0.9))))
    below = (
        *(s.CreateContainer("below"), s.AddComponent("timed"), s.AddComponent("timed", "below", bind="second")),
        *(s.GetPortElement("timed", PORT, "tell"), s.GetPortElement("second", PORT, "tell second", "below")),
        *(s.Start(), s.Start("below"), tell(1), tell(1, "second"), s.Pause(300), s.Stop("below"), after(0.6), s.Stop()),
    )
    cases.append(("another container stops", Scenario({"timed": same}, below, 4000)))
    return _about("instances", "18 23 32 34 35", *cases)


def _phases() -> TestPurpose:
    """Timers wait when their component is stopped, removed or started again."""
    body = scheduling(once(0.4, 1), repeated(0.3, 0.2, 9, 1, SECOND), once(0.2, 2, THIRD))
    pending = (tell(1), s.Pause(100), s.Stop())
    cases = [("stop", alone(body, *pending, after(0.8), s.Start(), tell(2), after(0.2)))]
    cases.append(("restart at once", alone(body, *pending, s.Start(), tell(2), after(0.9))))
    cases.append(("removal", alone(body, *pending, s.RemoveComponent("timed"), after(0.8))))
    ended = scheduling(once(0.9, 1), once(1, 1, SECOND), made(s.CANCEL, 1, 2))
    cases.append(("restart, and a cancel", alone(ended, *pending, s.Start(), tell(2), after(0.9))))
    waits = scheduling(once(0.3, 1), *_HOLDS, policies=(PASSIVE, SCHEDULES))
    stopped = (
        *(s.Invoke("tell", 1, thread="holder"), s.ReachGate(INSIDE), s.Pause(600), s.Stop(thread="stopper")),
        *(s.Settle("stopper"), s.OpenGate(INSIDE), s.Join("holder"), s.Join("stopper"), after(0)),
    )
    cases.append(("stop while one waits for its component", alone(waits, *stopped)))
    inner = (
        *(s.CreateContainer("inner"), s.AddComponent("timed", "inner")),
        *(s.GetPortElement("timed", PORT, "tell", "inner"), s.Start("inner"), tell(1), s.Pause(100)),
        *(s.RemoveContainer("inner"), after(0.8)),
    )
    cases.append(("removal of the container", Scenario({"timed": body}, inner, 4000)))
    running = (tell(1), s.Pause(600), s.Stop(), after(0.5), s.Start(), tell(2), after(0.3))
    cases.append(("stop of one that repeats", alone(body, *running)))
    anew = (*identified(once(0.3, 1), once(0.4, 1), once(0.5, 1, SECOND), before=1), made(s.CANCEL, 2, 2))
    whole = scheduling(once(0.2, 3, SECOND), *anew, repeated(0.2, 0.3, 3, 1, THIRD))
    again = (tell(3), after(0.2), s.Stop(), s.Start(), tell(1), tell(2), after(0.8))
    cases.append(("everything after a restart", alone(whole, *again)))
    return _about("phases", "31 35", *cases)


def _startup() -> TestPurpose:
    """Timers are made in on_startup, which may last longer than they do."""
    cases = [("returns at once", alone(scheduling(plan={"on_startup": (once(0.3),)}), after(0.3)))]
    ended = scheduling(plan={"on_startup": (once(0.3), made(s.CANCEL))})
    cases.append(("cancels", alone(ended, after(0.4))))
    lasting = scheduling(plan={"on_startup": (once(0.3), *_HOLDS)})
    steps = (
        *(s.AddComponent("timed"), s.Start(thread="starter"), s.ReachGate(INSIDE), s.Pause(700), s.OpenGate(INSIDE)),
        *(s.Join("starter"), after(0.1), s.Stop()),
    )
    cases.append(("lasts longer", Scenario({"timed": lasting}, steps, 4000)))
    return _about("in on_startup", "17 35", *cases)


def _protection() -> TestPurpose:
    """A timer expires while its component is executed: by a call, by itself, or by another trigger."""
    cases = []
    for policy in (PASSIVE, ACTIVE, UNPROTECTED):
        held = scheduling(once(0.3, 1), *_HOLDS, policies=(policy, SCHEDULES))
        steps: tuple[Step, ...] = while_held(700, 0)
        cases.append((f"during a call, {policy.definition}", alone(held, *steps)))
    rounds = scheduling(repeated(0.2, 0.4, 3, 1), *_HOLDS, policies=(PASSIVE, SCHEDULES))
    steps = while_held(500, 0.8)
    cases.append(("during a call, rounds", alone(rounds, *steps)))
    begun = (repeated(0.3, 0.4, 3),)
    second = scheduling(*_HOLDS, policies=(PASSIVE, SCHEDULES), plan={"on_startup": begun})
    cases.append(("during a call, the second round", alone(second, s.Pause(450), *while_held(500, 0.2))))
    running = scheduling(policies=(SELF, SCHEDULES), plan={"on_startup": (once(0.3),), "run": _HOLDS})
    run = (s.ReachGate(INSIDE), s.Pause(700), s.OpenGate(INSIDE), s.Pause(200))
    cases.append(("during run", alone(running, *run)))
    for policy, port in ((PASSIVE, PORT), (ACTIVE, PORT), (ACTIVE, OTHER_PORT)):
        calling = scheduling(once(0.3, 1), policies=(policy, SCHEDULES), on_trigger=_HOLDS)
        steps = (
            *(s.GetPortElement("timed", port, "api"), tell(1), s.ReachGate(INSIDE)),
            *(s.Invoke("api", 9, thread="caller"), s.Settle("caller"), s.Pause(50), s.OpenGate(INSIDE)),
            s.Join("caller"),
        )
        cases.append((f"a call during a trigger, {policy.definition}, {port}", alone(calling, *steps)))
    two = scheduling(once(0.2, 1), once(0.5, 1, SECOND), policies=(PASSIVE, SCHEDULES), on_trigger=_HOLDS)
    steps = (tell(1), s.ReachGate(INSIDE), s.Pause(700), s.OpenGate(INSIDE), after(0))
    cases.append(("during another trigger", alone(two, *steps)))
    kinds = scheduling(once(0.5, 1), sporadic(5, 1, 1), policies=(PASSIVE, SCHEDULES, TIMERS), on_trigger=_HOLDS)
    steps = (tell(1), s.ReachGate(INSIDE), s.Pause(900), s.OpenGate(INSIDE), after(0))
    cases.append(("during a trigger, an index timer", alone(kinds, *steps)))
    return _about("protection", "36", *cases)


def _missed() -> TestPurpose:
    """A trigger, or a call, lasts for more than two intervals."""
    held = scheduling(repeated(0.4, 0.8, 9, 1), policies=(PASSIVE, SCHEDULES), on_trigger=_HOLDS)
    steps = (tell(1), s.ReachGate(INSIDE), s.Pause(2000), s.OpenGate(INSIDE), after(1.6))
    cases = [("one", alone(held, *steps))]
    called = scheduling(repeated(0.4, 0.8, 5, 1), *_HOLDS, policies=(PASSIVE, SCHEDULES))
    late: tuple[Step, ...] = while_held(2400, 1.6)
    cases.append(("during a call", alone(called, *late)))
    return _about("long triggers", "22 24 30", *cases)


def _raising() -> TestPurpose:
    """Handlers raise: their timers, others of their component, and one that is made afterwards; those of another component."""
    orders = (repeated(0.2, 0.3, 4, 1), once(0.7, 1, SECOND), once(0.3, 2, THIRD))
    raising = scheduling(*orders, on_trigger=(*ASKS, s.RaiseError()))
    other = scheduling(repeated(0.25, 0.3, 3, 1))
    steps = (tell(1, "raising"), tell(1, "other"), after(1.1), tell(2, "raising"), after(0.3))
    case = ("beside others", together({"raising": raising, "other": other}, *steps))
    return _about("handlers raise", "18 20 23 34", case)


def _unusual() -> TestPurpose:
    """No delay, and no rounds."""
    cases = [("no delay", alone(scheduling(once(0, 1), once(0.3, 1, SECOND)), tell(1), after(0.3)))]
    start = scheduling(repeated(0, 0.3, 3, 1))
    cases.append(("no delay, and an interval", alone(start, tell(1), after(0.6))))
    none = scheduling(repeated(0.2, 0.2, 0, 1), once(0.3, 1, SECOND), own(s.CANCEL, 1, 2))
    cases.append(("no rounds", alone(none, tell(1), after(1.8), tell(2), after(0.4))))
    return _about("unusual times", "19 23", *cases)


def _told() -> TestPurpose:
    """What triggers tell: single and repeated ones of different length, and one that had to wait for its component."""
    body = scheduling(once(0.7, 1), repeated(0.3, 0.5, 3, 1, SECOND))
    cases = [("at once", alone(body, s.Pause(400), tell(1), after(1.3)))]
    held = scheduling(once(0.3, 1), *_HOLDS, policies=(PASSIVE, SCHEDULES))
    steps = while_held(900, 0)
    cases.append(("after waiting", alone(held, *steps)))
    return _about("times told", "24 27", *cases)


def _in_triggers() -> TestPurpose:
    """Timers are made and cancelled inside triggers."""
    chain = scheduling(once(0.2, 1), on_trigger=(*ASKS, repeated(0.2, 0.2, 2, handler=THIRD)))
    cases = [("one makes others", alone(chain, tell(1), after(0.3)))]
    single = scheduling(once(0.2, 1), on_trigger=(*ASKS, once(0.3, handler=THIRD)))
    cases.append(("each makes one", alone(single, tell(1), after(0.9))))
    makes = (once(0.4, handler=THIRD),)
    late = scheduling(once(0.2, 1), *_HOLDS, policies=(PASSIVE, SCHEDULES), on_trigger=(*ASKS, *makes))
    cases.append(("one that had to wait makes one", alone(late, *while_held(500, 0.5))))
    other = scheduling(once(0.5, 1, SECOND), once(0.2, 1), on_trigger=(made(s.CANCEL), made(s.IS_CANCELLED)))
    cases.append(("one cancels another", alone(other, tell(1), after(0.6))))
    return _about("in triggers", "01 31 33", *cases)
