"""Properties about timers of both kinds: components with them are added and started, and no others get their service (10.3)."""

from __future__ import annotations

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Declaration
from ucm_cts.adapters.contract.trace import Raise
from ucm_cts.reference_models.conclusions import Conclusions, takes
from ucm_cts.reference_models.model import execution_policies as policies
from ucm_cts.reference_models.model.callback_history import Callback
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.operation import OperationInProgress
from ucm_cts.reference_models.model.runtime import Member, has_meaningless_values, raises
from ucm_cts.reference_models.model.service_policies import has_several_clocks, has_timers, policies_of, policy_elements
from ucm_cts.reference_models.model.timer_events import Kind, Timer, TimerCallback
from ucm_cts.reference_models.model.timer_options import option_of
from ucm_cts.reference_models.properties.declaration import Property, property_at

OfKind = dict[Kind, str]
"""A requirement of each kind of timers."""

EARLY: OfKind = {"index": "R-10.3.2-25", "object": "R-10.3.1-19"}
LATE: OfKind = {"index": "R-10.3.2-26", "object": "R-10.3.1-20"}
RATE: OfKind = {"index": "R-10.3.2-32", "object": "R-10.3.1-22"}
PHASES: OfKind = {"index": "R-10.3.2-42", "object": "R-10.3.1-35"}
"""What several modules ask: never early, not late, at the rate, and in operational phases only."""

_WORDS = {s.INDEX_TIMERS: "index timers", s.OBJECT_TIMERS: "object timers"}
_SUPPORTED = {s.INDEX_TIMERS: "R-10.3.2-19", s.OBJECT_TIMERS: "R-10.3.1-16"}
_SEVERAL = {s.INDEX_TIMERS: "R-10.3-09", s.OBJECT_TIMERS: "R-10.3-10"}
_NOT_WITHOUT = {s.INDEX_TIMERS: "R-10.3.2-24", s.OBJECT_TIMERS: "R-10.3.1-17"}


@property_at("ended", *_SUPPORTED.values(), *_SEVERAL.values(), at=("add_component", "start"), feature="timers")
def timers_supported(check: Property, runtime: ObservedRuntime, ongoing: OperationInProgress) -> Conclusions:
    """A component with timers is added and started; one with two policies of one definition may be refused."""
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
            yield from _started(check, runtime, ongoing, member)


def _started(check: Property, runtime: ObservedRuntime, ongoing: OperationInProgress, member: Member) -> Conclusions:
    for definition, words in _WORDS.items():
        number = len(policies_of(member.declaration, definition))
        if number == 1:
            yield check.kept(_SUPPORTED[definition])
            others = ongoing.container.live_members()
            has_both = len(policies_of(member.declaration, *_WORDS)) == len(_WORDS)
            if has_both or any(not has_timers(other.declaration, definition) for other in others):
                yield check.kept(_SEVERAL[definition])
        elif number and not (yield from takes(runtime, _second(runtime, definition), "separate")):
            yield check.fail(
                "second policy",
                expected=f"'{member.lane}', which has two policies for {words}, is refused, as declared",
                observed="start returned",
                event=ongoing.end,
                requirement=_SEVERAL[definition],
            )


def _second(runtime: ObservedRuntime, definition: str) -> str:
    """The option that says whether a component may have two policies with this ``definition``."""
    return option_of(runtime, "object" if definition == s.OBJECT_TIMERS else "index", "second-timer-policy")


def _refused(
    check: Property, runtime: ObservedRuntime, declaration: Declaration, operation: str, end: Raise
) -> Conclusions:
    timers = {one: len(policies_of(declaration, one)) for one in _WORDS if has_timers(declaration, one)}
    others = policies_of(declaration, s.COMPONENT_TRACE, s.PORT_TRACE)
    excused = others or has_several_clocks(declaration) or policies.is_contradictory(declaration)
    excused = excused or policies.extended_policy(declaration) is not None or policies.has_unknown_policy(declaration)
    if not timers or excused or raises(declaration, "on_init", "on_startup", "set_container_interface"):
        return
    twice = [one for one, number in timers.items() if number > 1]
    if twice:
        if not (yield from takes(runtime, _second(runtime, twice[0]), "refused")):
            expected = f"a component with two policies for {_WORDS[twice[0]]} is added and started, as declared"
            requirement = _SEVERAL[twice[0]]
            yield check.refused(operation, end, expected=expected, cause="second policy", requirement=requirement)
        return
    *_, last = timers
    requirement = _SUPPORTED[last] if len(timers) == 1 else _SEVERAL[last]
    expected = f"a component with {' and '.join(_WORDS[one] for one in timers)} is added and started"
    yield check.refused(operation, end, expected=expected, requirement=requirement)


@property_at("entered", *_NOT_WITHOUT.values(), at=("on_startup",), feature="timers")
def no_timers_without_policy(check: Property, runtime: ObservedRuntime, callback: Callback) -> Conclusions:
    """on_startup hands over no reference of a timer service to a component without its policy."""
    event, member, ongoing, _ = callback
    if member is None or member.operational:
        return
    given = {d.port for d in event.dependencies or () if any(r is not None for r in d.references)}
    for definition, words in _WORDS.items():
        of_others = {e for d in runtime.scenario.components.values() for e in policy_elements(d, definition)}
        if has_timers(member.declaration, definition) or not of_others:
            continue
        own = {*member.declaration.requires, *policy_elements(member.declaration, *_WORDS)}
        wrong = sorted(of_others & given - own)
        if not wrong:
            yield check.kept(_NOT_WITHOUT[definition])
            continue
        yield check.fail(
            "without policy",
            expected=f"'{member.lane}', which has no {words}, is handed no reference for {wrong[0]}",
            observed="it was handed one",
            during=(ongoing, event),
            requirement=_NOT_WITHOUT[definition],
        )


def both(*requirements: OfKind) -> tuple[str, ...]:
    """Those of both kinds, each once."""
    return tuple(dict.fromkeys(id_ for one in requirements for id_ in one.values()))


def at_of(timer: Timer, *callbacks: TimerCallback) -> tuple[int, ...]:
    """The events of a finding: how the timer was started, and its callbacks."""
    return (timer.call.request.n, *(c.n for c in callbacks))
