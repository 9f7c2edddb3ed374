"""Scenarios of self-executing components that run each period or once in the background (10.5).

Each run passes a gate, so that a scenario waits for runs and not for time.
"""

from __future__ import annotations

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Action, Declaration, Policy, Scenario, Step
from ucm_cts.harness.purposes.container_services import HAS_CLOCK
from ucm_cts.harness.purposes.derived.paced_policies import NAMES, OTHER_PORT, PORT, policy, purposes_about
from ucm_cts.harness.purposes.scripts import TestPurpose

_RAN, _INSIDE = "ran", "inside"
"""Gates: runs pass ``ran``; ``inside`` holds them until it is opened."""

_SHORT, _USUAL, _LONG = 10, 20, 300
"""Periods in milliseconds. With the long one lateness shows."""

_MANY, _VERY_MANY = 31, 61
_ODD, _SERIES = 21, 300
"""A period that is no multiple of usual ticks, and more runs than a byte counts. After so many, two parts of a hundred show."""

_WRAPPED = (65_537, 2_147_484, 4_294_968)
"""Milliseconds of which, or of whose microseconds, few are left where they are kept in 16 or 32 bits."""

_SEVERAL = 9
_BACKGROUND, _PERIODIC = s.BACKGROUND, s.PERIODIC_SELF_EXECUTING
_ELSEWHERE = "elsewhere"


def run_purposes() -> list[TestPurpose]:
    """Rates, offsets, long runs, runs that raise, phases, several components."""
    return [_rates(), _overruns(), _background(), *_offsets(), *_phases(), *_exclusion(), _several(), _beside()]


def _runner(*policies: Policy, gate: str = _RAN, after: tuple[Action, ...] = ()) -> Declaration:
    return Declaration((PORT, OTHER_PORT), policies=policies, plan={"run": (s.HoldAtGate(gate), *after)})


def _scenario(components: dict[str, Declaration], *steps: Step, gates: tuple[str, ...] = (_RAN,)) -> Scenario:
    """The components are added to the manager, runs pass the ``gates``, and at the end it is stopped."""
    added: list[Step] = [s.AddComponent(name) for name in components]
    return Scenario(components, (*added, *map(s.OpenGate, gates), *steps, s.Stop(), s.GetComponents()))


def _runs(count: int) -> s.ReachGate:
    """Wait until there have been so many."""
    return s.ReachGate(_RAN, total=count)


def _rates() -> TestPurpose:
    name = NAMES[_PERIODIC]
    cases = []
    for period, count in ((_SHORT, _MANY), (_USUAL, _VERY_MANY), (_LONG, 3)):
        runner = _runner(policy(_PERIODIC, period))
        cases.append((f"each {period} ms", _scenario({"runner": runner}, s.Start(), _runs(count))))
    cases.append(("each 10.5 ms", _scenario({"runner": _runner(policy(_PERIODIC, 10.5))}, s.Start(), _runs(_MANY))))
    series = (s.Start(), s.Pause(_SERIES * _ODD), _runs(_SERIES))
    cases.append((f"a series of {_SERIES}", _scenario({"runner": _runner(policy(_PERIODIC, _ODD))}, *series)))
    seconds = _runner(policy(_PERIODIC, 1050, 1020))
    cases.append(("each 1,050 ms after 1,020 ms", _scenario({"runner": seconds}, s.Start(), _runs(1), _runs(2))))
    raising = _runner(policy(_PERIODIC, _USUAL), after=(s.RaiseError(),))
    cases.append(("runs that raise", _scenario({"runner": raising}, s.Start(), _runs(1), s.Pause(60))))
    return purposes_about(f"{name}/rates", "2-01 2-02 2-03 2-04", *cases)


def _overruns() -> TestPurpose:
    """A run is held for many periods; then all runs pass."""
    cases = []
    for period, held in ((_USUAL, 200), (_USUAL, 50), (100, 350)):
        runner = _runner(policy(_PERIODIC, period), gate=_INSIDE)
        steps: list[Step] = [s.Start(), s.ReachGate(_INSIDE), s.Pause(held), s.OpenGate(_INSIDE)]
        steps.append(s.ReachGate(_INSIDE, total=held // period + 4))
        cases.append((f"a run of {held} ms, each {period} ms", _scenario({"runner": runner}, *steps, gates=())))
    return purposes_about(f"{NAMES[_PERIODIC]}/long runs", "2-03 2-04", *cases)


def _background() -> TestPurpose:
    cases = []
    for what, after in (("", ()), (" that raises", (s.RaiseError(),))):
        runner = _runner(policy(_BACKGROUND), after=after)
        steps = (s.Start(), _runs(1), s.Pause(150))
        cases.append((f"one run{what}", _scenario({"runner": runner}, *steps)))
    runner = _runner(policy(_BACKGROUND), gate=_INSIDE)
    held = (s.Start(), s.ReachGate(_INSIDE), s.Pause(60), s.OpenGate(_INSIDE), s.Pause(60))
    cases.append(("a long run", _scenario({"runner": runner}, *held, gates=())))
    return purposes_about(f"{NAMES[_BACKGROUND]}/once", "2-05 2-06", *cases)


def _offsets() -> list[TestPurpose]:
    purposes = []
    for definition, requirements, count in (
        (_PERIODIC, "1-19 1-28 2-02 2-03", 3),
        (_BACKGROUND, "1-20 1-29 2-05 2-06", 1),
    ):
        cases = []
        for offset, period in ((0, 40), (15, 40), (60, 25), (250, 40)):
            runner = _runner(policy(definition, period, offset))
            cases.append((f"{offset} ms", _scenario({"runner": runner}, s.Start(), _runs(count), s.Pause(50))))
        runner = _runner(policy(definition, 40, 60))
        components = {"first": _runner(policy(definition, 40)), "later": runner}
        steps = (
            s.CreateContainer(_ELSEWHERE),
            s.AddComponent("first"),
            s.AddComponent("later", _ELSEWHERE),
            s.OpenGate(_RAN),
            s.Start(),
            s.Pause(90),
            s.Start(_ELSEWHERE),
            s.ReachGate(_RAN, more=count),
            s.Pause(120),
            s.Stop(_ELSEWHERE),
            s.Pause(150),
            s.Stop(),
        )
        cases.append(("a container that is started later", Scenario(components, steps)))
        beside = _runner(policy(definition, 40, 60), HAS_CLOCK)
        cases.append(("beside a clock", _scenario({"runner": beside}, s.Start(), _runs(count), s.Pause(50))))
        cases.append(("a second instance", _second(definition, count)))
        cases.append(("long ones", _long_times(definition)))
        purposes.append(purposes_about(f"{NAMES[definition]}/offsets", requirements, *cases))
    return purposes


def _long_times(definition: str) -> Scenario:
    """Offsets that do not pass, and periods that do not pass after the first run."""
    components = {f"after {n} ms": _runner(policy(definition, _USUAL, n)) for n in _WRAPPED}
    if definition == _PERIODIC:
        components |= {f"each {n} ms": _runner(policy(definition, n)) for n in _WRAPPED}
    first_runs = (_runs(len(_WRAPPED)),) if definition == _PERIODIC else ()
    return _scenario(components, s.Start(), *first_runs, s.Pause(250))


def _second(definition: str, count: int) -> Scenario:
    """Of two instances the first one is removed, and both the second one and another component run."""
    components = {"runner": _runner(policy(definition, _USUAL, 60)), "other": _runner(policy(definition, _USUAL, 30))}
    steps: tuple[Step, ...] = (
        s.AddComponent("runner", bind="first"),
        s.AddComponent("runner", bind="second"),
        s.AddComponent("other"),
        s.OpenGate(_RAN),
        s.Start(),
        _runs(3 * count),
        s.Stop(),
        s.RemoveComponent("first"),
        s.Start(),
        s.ReachGate(_RAN, more=2 * count),
        s.Pause(150),
        s.Stop(),
    )
    return Scenario(components, steps)


def _phases() -> list[TestPurpose]:
    """Stop and restart, also while the offset still passes; removal."""
    purposes = []
    for definition, count in ((_PERIODIC, 3), (_BACKGROUND, 1)):
        runner = {"runner": _runner(policy(definition, _USUAL, 30))}
        again = (s.Start(), _runs(count), s.Stop(), s.Pause(80), s.Start(), _runs(2 * count), s.Stop(), s.Pause(80))
        restarted = s.Start(), s.ReachGate(_RAN, more=count), s.Pause(60)
        cases = [("restart", _scenario(runner, *again)), ("three times", _scenario(runner, *again, *restarted))]
        waits = {"runner": _runner(policy(definition, _USUAL, 120))}
        cut = (s.Start(), s.Pause(20), s.Stop(), s.Pause(180))
        cases.append(("stop before the offset has passed", _scenario(waits, *cut)))
        held = {"runner": _runner(policy(definition, _USUAL), gate=_INSIDE)}
        stopping = (s.Start(), s.ReachGate(_INSIDE), s.Stop(thread="stopper"), s.Settle("stopper"))
        while_held = (*stopping, s.OpenGate(_INSIDE), s.Join("stopper"), s.Pause(80))
        cases.append(("stop during a run", _scenario(held, *while_held, gates=())))
        begun = (s.Start(), s.ReachGate(_INSIDE), s.Stop(thread="stopper"), s.Pause(30), s.Start(thread="stopper"))
        left = (s.Pause(30), s.OpenGate(_INSIDE), s.Join("stopper"), s.Pause(6 * _USUAL), s.Stop(), s.Pause(80))
        cases.append(("restart during a run", _scenario(held, *begun, *left, gates=())))
        moved = (s.Start(), s.Pause(80), s.Stop(), s.Start(), s.Pause(90), s.ReachGate(_RAN, more=count), s.Pause(60))
        cases.append(("restart just before the offset has passed", _scenario(waits, *moved)))
        once_more = (*cut, s.Start(), s.ReachGate(_RAN, more=count))
        cases.append(("restart before the offset has passed", _scenario(waits, *once_more)))
        removed = (s.Start(), s.Pause(20), s.Stop(), s.RemoveComponent("runner"), s.Pause(180), s.Start(), s.Pause(60))
        cases.append(("removal before the offset has passed", _scenario(waits, *removed)))
        own = "2-04" if definition == _PERIODIC else "2-05"
        purposes.append(purposes_about(f"{NAMES[definition]}/phases", f"2-20 2-21 {own}", *cases))
    return purposes


def _exclusion() -> list[TestPurpose]:
    """A run is held for several periods while ports are called, and a call is held while runs are due."""
    purposes = []
    for definition in (_PERIODIC, _BACKGROUND):
        runner = _runner(policy(definition, _USUAL), gate=_INSIDE)
        ways: tuple[Step, ...] = (
            s.GetPortElement("runner", PORT, "api"),
            s.GetPortElement("runner", OTHER_PORT, "aux"),
        )
        calls = (s.Invoke("api", 1, thread="one"), s.Settle("one"), s.Invoke("aux", 2, thread="two"), s.Settle("two"))
        joined = (s.Join("one"), s.Join("two"))
        held = (*ways, s.Start(), s.ReachGate(_INSIDE), *calls, s.Pause(220), s.OpenGate(_INSIDE), *joined)
        cases = [("run and ports", _scenario({"runner": runner}, *held, s.Pause(50), gates=()))]
        both = Declaration(
            (PORT, OTHER_PORT),
            policies=(policy(definition, _USUAL, 40),),
            plan={"run": (s.HoldAtGate(_RAN),), "exchange": (s.HoldAtGate(_INSIDE),)},
        )
        for first, then in (("api", "aux"), ("aux", "api")):
            inside = (
                *(s.Invoke(first, 1, thread="one"), s.ReachGate(_INSIDE)),
                *(s.Invoke(then, 2, thread="two"), s.Settle("two"), s.Pause(220), s.OpenGate(_INSIDE)),
                *(s.Join("one"), s.Join("two"), _runs(1)),
            )
            cases.append((f"{first} and run", _scenario({"runner": both}, *ways, s.Start(), *inside)))
        again = (
            s.Start(),
            s.Stop(),
            s.Start(),
            s.ReachGate(_INSIDE),
            *calls,
            s.Pause(40),
            s.OpenGate(_INSIDE),
            *joined,
        )
        cases.append(("after a restart", _scenario({"runner": runner}, *ways, *again, gates=())))
        purposes.append(purposes_about(f"{NAMES[definition]}/exclusion", "2-18", *cases))
    return purposes


def _several() -> TestPurpose:
    """Components with different values beside each other."""
    cases = []
    slow, fast = policy(_PERIODIC, 60, priority=1), policy(_PERIODIC, _USUAL, 10, priority=255)
    for names in (("slow", "fast"), ("fast", "slow")):
        components = {name: _runner({"slow": slow, "fast": fast}[name]) for name in names}
        cases.append((", ".join(names), _scenario(components, s.Start(), _runs(32))))
    same = {
        name: _runner(policy(_PERIODIC, _USUAL, priority=n)) for name, n in (("one", 255), ("two", 1), ("three", 1))
    }
    cases.append(("three priorities", _scenario(same, s.Start(), _runs(30))))
    twice = {"runner": _runner(policy(_PERIODIC, _USUAL))}
    again = (s.AddComponent("runner", bind="second"), s.Start(), _runs(40))
    cases.append(("two instances", _scenario(twice, *again)))
    mixed = {"periodic": _runner(policy(_PERIODIC, _USUAL, 5)), "background": _runner(policy(_BACKGROUND, 0, 50))}
    cases.append(("both kinds", _scenario(mixed, s.Start(), _runs(20))))
    for definition in (_PERIODIC, _BACKGROUND):
        many = {f"number {n}": _runner(policy(definition, 60, 5 * n)) for n in range(1, _SEVERAL + 1)}
        waiting = (_runs(_SEVERAL if definition == _BACKGROUND else 3 * _SEVERAL), s.Pause(50))
        cases.append((f"{_SEVERAL} of {NAMES[definition]}", _scenario(many, s.Start(), *waiting)))
    return purposes_about("periodic self-executing/several", "1-27 1-31 2-01", *cases)


def _beside() -> TestPurpose:
    """While a background run is held, start comes back and another component is called."""
    cases = []
    other = Declaration((PORT,))
    for first in ("runner", "other"):
        runner = _runner(policy(_BACKGROUND, priority=1), gate=_INSIDE)
        components = {first: runner if first == "runner" else other}
        components |= {"runner": runner, "other": other}
        steps = (
            s.GetPortElement("other", PORT, "api"),
            s.Start(thread="starter"),
            s.ReachGate(_INSIDE),
            s.Join("starter"),
            s.Invoke("api", 1, thread="caller"),
            s.Join("caller"),
            s.OpenGate(_INSIDE),
        )
        cases.append((f"{first} first", _scenario(components, *steps, gates=())))
    both = {"runner": _runner(policy(_BACKGROUND), gate=_INSIDE), "later": _runner(policy(_BACKGROUND, 0, 30))}
    held = (s.Start(), s.ReachGate(_INSIDE), _runs(1), s.Pause(250), s.OpenGate(_INSIDE), s.Pause(20))
    cases.append(("another one in the background", _scenario(both, *held)))
    components = {"runner": _runner(policy(_BACKGROUND), gate=_INSIDE), "other": other}
    elsewhere: tuple[Step, ...] = (
        *(s.CreateContainer(_ELSEWHERE), s.AddComponent("runner"), s.AddComponent("other", _ELSEWHERE)),
        *(s.Start(), s.ReachGate(_INSIDE), s.Start(_ELSEWHERE, thread="starter"), s.Join("starter")),
        *(s.OpenGate(_INSIDE), s.Stop(_ELSEWHERE), s.Stop()),
    )
    cases.append(("start of another container", Scenario(components, elsewhere)))
    return purposes_about(f"{NAMES[_BACKGROUND]}/beside others", "2-06 2-07", *cases)
