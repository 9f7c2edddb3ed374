"""Scenarios of index timers (10.3.2): sporadic and periodic ones, several at once, dates, cancels, phases, and protection."""

from __future__ import annotations

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import CallMethod, Declaration, Policy, Step
from ucm_cts.harness.purposes.derived.through_components import through_components
from ucm_cts.harness.purposes.derived.timer_steps import (
    ACTIVE,
    INSIDE,
    OTHER_PORT,
    PASSIVE,
    PORT,
    READ_CLOCKS,
    SELF,
    SERVICE,
    TIMERS,
    UNPROTECTED,
    WITH_CLOCK,
    after,
    alone,
    cancel,
    cancel_own,
    dated,
    is_canceled,
    periodic,
    purposes_about,
    relative,
    sporadic,
    tell,
    timed,
    together,
    two_instances,
    while_held,
)
from ucm_cts.harness.purposes.scripts import TestPurpose
from ucm_cts.reference_models.model.clock_readings import LOCAL, SYNCHRONIZED

_LARGE = (0, 300, s.LARGEST_NUMBER)
"""Numbers that not every type of numbers has."""

_ALIKE = (1, 2**8 + 1, 2**16 + 1, 2**31 + 1)
"""Numbers that are the same where numbers are kept in 8, 16 or 31 bits."""

_DOZENS = 100


def index_timer_purposes() -> list[TestPurpose]:
    """All purposes of 10.3.2."""
    return [
        _support(),
        _sporadic(),
        _several(),
        _periodic(),
        _cancel(),
        _instances(),
        _phases(),
        _startup(),
        _protection(),
        through_components(_protection()),
        _missed(),
        _raising(),
        _unusual(),
        *_dates(),
        _told(),
        _in_callbacks(),
    ]


def _support() -> TestPurpose:
    """Each execution policy with timers; a component without; all four operations; a second policy."""
    orders = (sporadic(5, 1, 1), is_canceled(5, 2), cancel(5, 3), periodic(6, 1, 1, 4), cancel(6, 5))
    cases = [
        (policy.definition, alone(timed(*orders, policies=(policy, TIMERS)), s.GetComponents()))
        for policy in (SELF, ACTIVE, PASSIVE, UNPROTECTED)
    ]
    cases.append(("all operations", alone(timed(*orders), *map(tell, (1, 2, 3, 2, 4, 5)))))
    plain = {"plain": Declaration((PORT,)), "timed": timed(sporadic(5, 1, 1))}
    cases.append(("beside a component without", together(plain, tell(1, "timed"), tell(1, "plain"), after(1))))
    each = {
        "active": timed(sporadic(5, 1), policies=(ACTIVE, TIMERS)),
        "passive": timed(sporadic(5, 1), policies=(PASSIVE, TIMERS)),
        "unprotected": timed(sporadic(5, 1), policies=(UNPROTECTED, TIMERS)),
    }
    cases.append(("one of each policy", together(each, *(tell(1, name) for name in each), after(1))))
    other = Policy(s.INDEX_TIMERS, element="other.timer_service")
    both = (
        sporadic(5, 1, 1),
        CallMethod("other.timer_service", s.START_SPORADIC, (5, relative(2)), given=1),
    )
    cases.append(("two policies", alone(timed(*both, policies=(TIMERS, other)), tell(1), after(2))))
    return purposes_about("support", "19 20 21 23 24 .09", *cases)


def _sporadic() -> TestPurpose:
    """One timer; another component of the same implementation has none; timers that are started at different moments."""
    implementation = timed(sporadic(5, 1, 1))
    steps = (
        *(s.AddComponent("timed"), s.AddComponent("timed", bind="idle")),
        *(s.GetPortElement("timed", PORT, "tell"), s.Start(), tell(1), after(4), s.Stop()),
    )
    cases = [("once", s.Scenario({"timed": implementation}, steps, 4000))]
    apart = (tell(1), s.Pause(500), tell(2), after(1.1))
    cases.append(("one after the other", alone(timed(sporadic(1, 1, 1), sporadic(2, 1, 2)), *apart)))
    later = (s.Pause(700), tell(1), s.Pause(600), tell(2), after(1.2))
    cases.append(("long after the start", alone(timed(sporadic(1, 1, 1), sporadic(2, 1, 2)), *later)))
    again = (tell(1), after(1), tell(1), after(1))
    cases.append(("again when it has come", alone(timed(sporadic(5, 1, 1)), *again)))
    return purposes_about("sporadic", "20 21 22 25 26 27 29 41", *cases)


def _several() -> TestPurpose:
    """Numbers of any size, timers that wait at once, and dozens of them."""
    orders = tuple(sporadic(number, seconds, 1) for number, seconds in zip((7, *_LARGE), (2, 1, 2, 1), strict=True))
    cases = [("numbers", alone(timed(*orders), tell(1), after(2)))]
    alike = tuple(sporadic(number, seconds, 1) for number, seconds in zip(_ALIKE, (2, 1, 2, 1), strict=True))
    cases.append(("numbers whose low bytes are one", alone(timed(*alike), tell(1), after(2))))
    kinds = (periodic(1, 1, 1, 1), sporadic(2, 2, 1), periodic(3, 2, 1, 1), sporadic(4, 1, 1), sporadic(9, 3, 1))
    cases.append(("five at once", alone(timed(*kinds), tell(1), after(3.1))))
    many = tuple(sporadic(number, 1 + number % 2, 1) for number in range(1, _DOZENS + 1))
    others = {name: timed(sporadic(5, 1), periodic(6, 1, 1)) for name in ("second", "third")}
    steps = (tell(1, "many"), tell(1, "second"), tell(1, "third"), after(2.1))
    cases.append(("dozens", together({"many": timed(*many), **others}, *steps)))
    long = tuple(sporadic(number, seconds, 1) for number, seconds in enumerate((257, 65537, 4295, 4294968), 1))
    cases.append(("long times", alone(timed(*long), tell(1), after(2))))
    used = (tell(1), s.Pause(500), tell(2), after(2.6))
    cases.append(("a number in use", alone(timed(sporadic(5, 3, 1), sporadic(6, 2, 1), sporadic(5, 1, 2)), *used)))
    twice = timed(periodic(5, 1, 1, 1), sporadic(6, 2, 1), periodic(5, 1, 1, 2))
    cases.append(("a periodic number in use", alone(twice, *used)))
    single = timed(periodic(5, 1, 1, 1), sporadic(5, 1, 2))
    cases.append(("a periodic number in use, for one callback", alone(single, *used)))
    endless = timed(sporadic(5, 2, 1), periodic(5, 1, 1, 2))
    cases.append(("a number in use, from now on periodic", alone(endless, *used, after(1))))
    return purposes_about("several", "21 26 33 34 36", *cases)


def _periodic() -> TestPurpose:
    """Delays and rates that differ, until somebody cancels."""
    orders = (periodic(1, 2, 1, 1), periodic(2, 1, 2, 1), cancel(1, 2))
    cases = [("two rates", alone(timed(*orders), tell(1), after(5.1), tell(2), after(1.7)))]
    cases.append(("one second", alone(timed(periodic(300, 1, 1, 1)), tell(1), after(12.1))))
    own = (tell(1), after(3))
    cases.append(("cancelled in its callback", alone(timed(periodic(1, 1, 1, 1), on_timeout=(cancel_own(),)), *own)))
    return purposes_about("periodic", "30 31 32 36 38 39", *cases)


def _cancel() -> TestPurpose:
    """One of three is cancelled; a number is asked for before and after; cancelled numbers are started anew."""
    three = (
        sporadic(1, 1, 1),
        sporadic(2, 1, 1),
        periodic(3, 1, 1, 1),
        cancel(2, 2),
        is_canceled(1, 3),
        is_canceled(3, 3),
    )
    cases = [("one of three", alone(timed(*three), tell(1), s.Pause(200), tell(2), tell(3), after(2)))]
    asked = (is_canceled(5, 3), is_canceled(6, 3))
    orders = (sporadic(5, 1, 1), periodic(6, 1, 1, 1), cancel(5, 2), cancel(6, 2), *asked)
    steps = (tell(1), tell(3), tell(2), tell(3), s.Pause(100), tell(1), tell(3), after(2), tell(2), tell(3), after(1))
    cases.append(("asked before and after", alone(timed(*orders), *steps)))
    expired = (tell(1), tell(3), after(1), tell(3), tell(2), tell(3), tell(1), tell(3), after(1))
    over = timed(sporadic(5, 1, 1), cancel(5, 2), is_canceled(5, 3), is_canceled(77, 3))
    cases.append(("too late", alone(over, *expired)))
    at_last = (tell(1), s.Pause(900), tell(2), after(1.2))
    cases.append(("just before it is due", alone(timed(sporadic(1, 1, 1), cancel(1, 2)), *at_last)))
    unknown = timed(sporadic(1, 1, 1), periodic(2, 1, 1, 1), cancel(9, 2), cancel(0, 2), cancel(1, 3))
    others = (tell(1), s.Pause(200), tell(2), after(1), tell(3), after(1))
    cases.append(("numbers that nobody started", alone(unknown, *others)))
    twice = timed(sporadic(1, 1, 1), sporadic(2, 1, 1), cancel(2, 2), is_canceled(2, 3))
    cases.append(("twice", alone(twice, *map(tell, (1, 2, 3, 3, 2)), after(1))))
    anew = timed(periodic(6, 1, 1, 1), cancel(6, 2), periodic(6, 1, 2, 3), sporadic(6, 1, 5))
    cases.append(
        ("started anew", alone(anew, tell(1), after(1), tell(2), tell(3), after(3), tell(2), tell(5), after(2)))
    )
    twice = timed(
        periodic(5, 1, 1, 1), sporadic(6, 2, 1), periodic(5, 1, 1, 2), sporadic(6, 2, 2), cancel(5, 3), cancel(6, 3)
    )
    ended = (tell(1), s.Pause(500), tell(2), s.Pause(800), tell(3), after(1.6))
    cases.append(("of numbers that were started twice", alone(twice, *ended)))
    for which, order, afterwards in (("one", sporadic(5, 1, 1), 0.2), ("a periodic one", periodic(5, 1, 1, 1), 2.2)):
        held = timed(order, s.HoldAtGate(INSIDE), cancel(5, 1), policies=(PASSIVE, TIMERS))
        cases.append((f"of {which} that waits for its component", alone(held, *while_held(1500, afterwards))))
    anew = timed(sporadic(5, 1), s.HoldAtGate(INSIDE), cancel(5), sporadic(5, 2), policies=(PASSIVE, TIMERS))
    cases.append(("of one that waits for its component, and started anew", alone(anew, *while_held(1500, 2))))
    large = [
        order for number in _LARGE for order in (sporadic(number, 1, 1), cancel(number, 2), is_canceled(number, 3))
    ]
    of_all = alone(timed(*large), tell(1), s.Pause(200), tell(3), tell(2), tell(3), after(1))
    cases.append(("of numbers of any size", of_all))
    alike = (*(sporadic(number, 1, 1) for number in _ALIKE), *(is_canceled(number, 3) for number in _ALIKE))
    ends = (cancel(_ALIKE[1], 2), cancel(_ALIKE[3], 2))
    two = alone(timed(*alike, *ends), tell(1), s.Pause(200), tell(3), tell(2), tell(3), after(1))
    cases.append(("of numbers whose low bytes are one", two))
    return purposes_about("cancel", "22 38 39 40 .04", *cases)


def _instances() -> TestPurpose:
    """Equal numbers in two instances, in one container and in two."""
    names = {"one": timed(sporadic(5, 1, 1), cancel(5, 2)), "other": timed(sporadic(5, 2, 1))}
    cases = [("equal numbers", together(names, tell(1, "one"), tell(1, "other"), after(2)))]
    steps = (tell(1, "other"), tell(1, "one"), s.Pause(100), tell(2, "one"), after(2))
    cases.append(("one cancels", together(names, *steps)))
    same = timed(periodic(5, 1, 1, 1), cancel(5, 2))
    below = (
        *(s.CreateContainer("below"), s.AddComponent("timed"), s.AddComponent("timed", "below", bind="second")),
        *(s.GetPortElement("timed", PORT, "tell"), s.GetPortElement("second", PORT, "tell second", "below")),
        *(s.Start(), s.Start("below"), tell(1), tell(1, "second"), after(1)),
        *(s.Stop("below"), after(1.1), tell(2), after(1), s.Stop()),
    )
    cases.append(("another container stops", s.Scenario({"timed": same}, below, 4000)))
    cases.append(("of one implementation", two_instances(same, after(2.1))))
    outer = (
        *(s.AddComponent("timed"), s.GetPortElement("timed", PORT, "tell"), s.CreateContainer("below")),
        *(
            s.AddComponent("timed", "below", bind="second"),
            s.Start(),
            tell(1),
            s.Pause(300),
            s.Start("below"),
            after(1),
        ),
        *(s.Stop("below"), s.RemoveContainer("below"), after(2), s.Stop()),
    )
    cases.append(("another container comes and goes", s.Scenario({"timed": same}, outer, 4000)))
    return purposes_about("instances", "21 22 30 37 38 42", *cases)


def _phases() -> TestPurpose:
    """Timers wait when their component is stopped, removed or started again."""
    body = timed(sporadic(1, 1, 1), periodic(2, 1, 1, 1), sporadic(9, 1, 2))
    pending = (tell(1), s.Pause(300), s.Stop())
    cases = [("stop", alone(body, *pending, after(1.7), s.Start(), tell(2), after(1)))]
    cases.append(("restart at once", alone(body, *pending, s.Start(), tell(2), after(2.1))))
    cases.append(("removal", alone(body, *pending, s.RemoveComponent("timed"), after(1.7))))
    inner = (
        *(
            s.CreateContainer("inner"),
            s.AddComponent("timed", "inner"),
            s.GetPortElement("timed", PORT, "tell", "inner"),
        ),
        *(s.Start("inner"), tell(1), s.Pause(300), s.RemoveContainer("inner"), after(1.7)),
    )
    cases.append(("removal of the container", s.Scenario({"timed": body}, inner, 4000)))
    cancelled = timed(sporadic(1, 1, 1), periodic(2, 1, 1, 1), cancel(1, 2), cancel(2, 2), is_canceled(1, 3))
    again = (tell(1), tell(2), s.Stop(), s.Start(), s.Pause(1500), tell(1), tell(3), after(1))
    cases.append(("restart after a cancel", alone(cancelled, *again)))
    successor = (s.AddComponent("timed", bind="next"), s.Start(), after(1.2))
    cases.append(("another instance follows", alone(body, *pending, s.RemoveComponent("timed"), *successor)))
    waits = timed(sporadic(5, 1, 1), s.HoldAtGate(INSIDE), policies=(PASSIVE, TIMERS))
    stopped = (
        *(s.Invoke("tell", 1, thread="holder"), s.ReachGate(INSIDE), s.Pause(1300), s.Stop(thread="stopper")),
        *(s.Settle("stopper"), s.OpenGate(INSIDE), s.Join("holder"), s.Join("stopper"), after(0)),
    )
    cases.append(("stop while one waits for its component", alone(waits, *stopped)))
    running = (tell(1), after(1.6), s.Stop(), after(1.2), s.Start(), tell(1), after(1))
    cases.append(("stop of one that repeats", alone(body, *running)))
    return purposes_about("phases", "30 42", *cases)


def _startup() -> TestPurpose:
    """Timers are set in on_startup, which may last longer than they do."""
    setting = {"on_startup": (sporadic(7, 1),)}
    cases = [("returns at once", alone(timed(plan=setting), after(1)))]  # type: ignore[arg-type]
    ended = timed(plan={"on_startup": (sporadic(7, 1), cancel(7))})
    cases.append(("cancels", alone(ended, after(1))))
    lasting = timed(plan={"on_startup": (sporadic(7, 1), s.HoldAtGate(INSIDE))})
    steps = (
        *(s.AddComponent("timed"), s.Start(thread="starter"), s.ReachGate(INSIDE), s.Pause(1500), s.OpenGate(INSIDE)),
        *(s.Join("starter"), after(0.1), s.Stop()),
    )
    cases.append(("lasts longer", s.Scenario({"timed": lasting}, steps, 4000)))
    return purposes_about("in on_startup", "23 42", *cases)


def _protection() -> TestPurpose:
    """A timer expires while its component is executed: by a call, by itself, or by another callback."""
    cases = []
    for policy in (PASSIVE, ACTIVE, UNPROTECTED):
        held = timed(sporadic(5, 1, 1), s.HoldAtGate(INSIDE), policies=(policy, TIMERS))
        steps: tuple[Step, ...] = while_held(1500, 0)
        cases.append((f"during a call, {policy.definition}", alone(held, *steps)))
    running = timed(policies=(SELF, TIMERS), plan={"on_startup": (sporadic(5, 1),), "run": (s.HoldAtGate(INSIDE),)})
    run = (s.ReachGate(INSIDE), s.Pause(1500), s.OpenGate(INSIDE), s.Pause(200))
    cases.append(("during run", alone(running, *run)))
    for policy, port in ((PASSIVE, PORT), (ACTIVE, PORT), (ACTIVE, OTHER_PORT)):
        calling = timed(sporadic(5, 1, 1), policies=(policy, TIMERS), on_timeout=(s.HoldAtGate(INSIDE),))
        steps = (
            *(s.GetPortElement("timed", port, "api"), tell(1), s.ReachGate(INSIDE)),
            *(s.Invoke("api", 9, thread="caller"), s.Settle("caller"), s.Pause(50), s.OpenGate(INSIDE)),
            s.Join("caller"),
        )
        cases.append((f"a call during a callback, {policy.definition}, {port}", alone(calling, *steps)))
    held = timed(sporadic(5, 1, 1), policies=(PASSIVE, TIMERS), on_timeout=(s.HoldAtGate(INSIDE),))
    both = {"held": held, "other": timed(sporadic(5, 2, 1), sporadic(6, 4, 1))}
    steps = (tell(1, "held"), tell(1, "other"), s.ReachGate(INSIDE), s.Pause(1500), s.OpenGate(INSIDE), after(1.6))
    cases.append(("during a callback of another component", together(both, *steps)))
    two = timed(sporadic(1, 1, 1), sporadic(2, 2, 1), policies=(PASSIVE, TIMERS), on_timeout=(s.HoldAtGate(INSIDE),))
    steps = (tell(1), s.ReachGate(INSIDE), s.Pause(1600), s.OpenGate(INSIDE), after(0))
    cases.append(("during another callback", alone(two, *steps)))
    return purposes_about("protection", "43 44", *cases)


def _missed() -> TestPurpose:
    """A callback, or a call, lasts for more than two periods."""
    held = timed(periodic(1, 1, 1, 1), policies=(PASSIVE, TIMERS), on_timeout=(s.HoldAtGate(INSIDE),))
    steps = (tell(1), s.ReachGate(INSIDE), s.Pause(2450), s.OpenGate(INSIDE), after(2.6))
    cases = [("one", alone(held, *steps))]
    called = timed(periodic(1, 1, 1, 1), s.HoldAtGate(INSIDE), policies=(PASSIVE, TIMERS))
    late: tuple[Step, ...] = while_held(3450, 2.2)
    cases.append(("during a call", alone(called, *late)))
    return purposes_about("long callbacks", "30 32", *cases)


def _raising() -> TestPurpose:
    """Callbacks raise: their timers, others of their component, and one that is started afterwards; those of another component."""
    orders = (periodic(5, 1, 1, 1), sporadic(6, 2, 1), sporadic(7, 1, 2))
    raising = timed(*orders, on_timeout=(s.RaiseError(),))
    other = timed(periodic(8, 1, 1, 1))
    steps = (tell(1, "raising"), tell(1, "other"), after(3), tell(2, "raising"), after(1))
    case = ("beside others", together({"raising": raising, "other": other}, *steps))
    return purposes_about("callbacks raise", "21 26 30 36", case)


def _unusual() -> TestPurpose:
    """Delays of zero, and a rate with the flag of dates."""
    cases = [("no delay", alone(timed(sporadic(5, 0, 1), sporadic(6, 1, 1)), tell(1), after(1)))]
    cases.append(("no delay, and a rate", alone(timed(periodic(5, 0, 1, 1)), tell(1), after(2.2))))
    rate = CallMethod(SERVICE, s.START_PERIODIC, (5, relative(1), [1, s.ABSOLUTE_TIME]), given=1)
    cases.append(("a rate that is a date", alone(timed(rate, sporadic(6, 1, 1)), tell(1), after(3.2))))
    return purposes_about("unusual times", "25 32", *cases)


def _dates() -> list[TestPurpose]:
    """Dates that come, that have passed, and that are far away; by the clock that the vendor declares."""
    found = []
    for declared, clock in (("observed|local", LOCAL), ("observed|synchronized", SYNCHRONIZED)):
        orders = (
            *READ_CLOCKS,
            dated(5, 2, 1, clock),
            dated(6, 3600, 1, clock),
            dated(7, 3, 2, clock),
            dated(8, -10, 3, clock),
        )
        body = timed(*orders, policies=WITH_CLOCK, on_timeout=READ_CLOCKS)
        ask = s.Pause(1)  # shows the calendar clock before and after, so that a clock that was set is noticed
        cases = [("two dates", alone(body, ask, tell(1), s.Pause(600), tell(2), after(3.1), ask))]
        cases.append(("a date that has passed", alone(body, ask, tell(3), after(0.2), ask)))
        again = timed(*READ_CLOCKS, dated(5, 2, 1, clock, rate=1), policies=WITH_CLOCK, on_timeout=READ_CLOCKS)
        cases.append(("a periodic timer", alone(again, ask, tell(1), after(4.2), ask)))
        ended = timed(
            dated(5, 2, 1, clock), dated(6, 1, 1, clock, rate=1), cancel(5, 2), cancel(6, 2), policies=WITH_CLOCK
        )
        cases.append(("cancelled", alone(ended, tell(1), after(1), tell(2), after(2))))
        found.append(purposes_about(f"dates of {clock}", "28 38", *cases, under=f"absolute-clock={declared}"))
    return found


def _told() -> TestPurpose:
    """What callbacks tell: of relative times, of a rate, and of a callback that had to wait for its component."""
    body = timed(sporadic(5, 1, 1), periodic(6, 1, 2, 1), policies=WITH_CLOCK, on_timeout=READ_CLOCKS)
    cases = [("at once", alone(body, s.Pause(1), tell(1), after(3), s.Pause(1)))]
    held = timed(
        sporadic(5, 1, 1),
        s.HoldAtGate(INSIDE),
        policies=(PASSIVE, *WITH_CLOCK),
        on_timeout=READ_CLOCKS,
    )
    steps = (s.Pause(1), *while_held(4500, 0), s.Pause(1))
    cases.append(("after waiting", alone(held, *steps, patience=8000)))
    return purposes_about("times told", "35", *cases)


def _in_callbacks() -> TestPurpose:
    """Timers are started and cancelled inside callbacks."""
    chain = timed(sporadic(1, 1, 1), on_timeout=(sporadic(50, 1),))
    cases = [("one starts the next", alone(chain, tell(1), after(3)))]
    anew = timed(periodic(1, 1, 1, 1), on_timeout=(cancel_own(), periodic(1, 2, 2)))
    cases.append(("one starts itself anew", alone(anew, tell(1), after(3))))
    late = timed(sporadic(1, 1, 1), s.HoldAtGate(INSIDE), policies=(PASSIVE, TIMERS), on_timeout=(sporadic(50, 1),))
    cases.append(("one that had to wait starts the next", alone(late, *while_held(1600, 1.1))))
    other = timed(sporadic(1, 1, 1), periodic(2, 2, 1, 1), on_timeout=(cancel(2), is_canceled(2)))
    cases.append(("one cancels another", alone(other, tell(1), after(2.5))))
    return purposes_about("in callbacks", "22 38 40 41", *cases)
