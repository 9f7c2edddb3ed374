"""Properties about policies of 10.5 and their parameters: they are taken, and offsets and periods hold for each component (10.5.1)."""

from __future__ import annotations

import itertools
from collections.abc import Iterator

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.scenario import Declaration
from ucm_cts.adapters.contract.trace import Raise, Return
from ucm_cts.reference_models.conclusions import Conclusions, takes
from ucm_cts.reference_models.model import execution_policies as policies
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.operation import OperationInProgress
from ucm_cts.reference_models.model.paced_events import PacedPhase
from ucm_cts.reference_models.model.paced_phases import granularity, lateness, paced_phases, shown
from ucm_cts.reference_models.model.runtime import has_meaningless_values, raises
from ucm_cts.reference_models.model.service_policies import BESIDE_EXECUTION, policies_of
from ucm_cts.reference_models.properties.declaration import Property, property_at

_SUPPORT = {
    s.PERIODIC_SELF_EXECUTING: "R-10.5.1-19",
    s.BACKGROUND: "R-10.5.1-20",
    s.SPORADIC_ACTIVE: "R-10.5.1-21",
    s.PERIODIC_ACTIVE: "R-10.5.1-22",
}
_PRIORITIES, _PRIORITY_CHANGES_NOTHING = "R-10.5.1-24", "R-10.5.1-27"
_OFFSETS = {
    s.PERIODIC_SELF_EXECUTING: "R-10.5.1-28",
    s.BACKGROUND: "R-10.5.1-29",
    s.PERIODIC_ACTIVE: "R-10.5.1-30",
}
_CONFIGURES = "R-10.5.1-31"

_ENOUGH = 5
"""So many runs show the period of a component."""

_HIGHEST, _LOWEST = 1, policies.LOWEST_PRIORITY


@property_at("ended", *_SUPPORT.values(), _PRIORITIES, at=("add_component", "start"), feature="paced")
def extended_policy_supported(check: Property, runtime: ObservedRuntime, ongoing: OperationInProgress) -> Conclusions:
    """A component with a policy of 10.5 and sensible values is added and started; values that the vendor declares refused are."""
    if isinstance(ongoing.step, s.AddComponent):
        declaration = runtime.scenario.components.get(ongoing.step.component)
        may_be_added = ongoing.container.started is False
        if not isinstance(ongoing.end, Raise) or declaration is None or not may_be_added:
            return
        if not has_meaningless_values(declaration, ongoing.step):
            yield from _refused(check, runtime, declaration, "add_component", ongoing.end)
        return
    for member in ongoing.container.live_members():
        policy = policies.extended_policy(member.declaration)
        if policy is None:
            continue
        if isinstance(ongoing.end, Raise):
            if len(ongoing.container.live_members()) == 1 and member.connected:
                yield from _refused(check, runtime, member.declaration, "start", ongoing.end)
        elif not ongoing.judged:
            continue
        elif "on_startup" in [c.hook for c in ongoing.by_body.get(member.body, ())]:
            yield from _started(check, runtime, policy, ongoing.end)


def _started(check: Property, runtime: ObservedRuntime, policy: s.Policy, end: Return) -> Conclusions:
    if wrong := policies.wrong_value(policy):
        yield check.fail(
            "out of range",
            expected=f"{wrong} is refused, as declared, when the component is started at latest",
            observed="start returned",
            event=end,
            requirement=_PRIORITIES if _is_priority(policy, wrong) else _SUPPORT[policy.definition],
        )
        return
    priority = policy.settings.get(s.PRIORITY[policy.definition])
    if priority == 0 and not (yield from takes(runtime, "priority-zero", "accepted")):
        yield check.fail(
            "zero",
            expected="a component with priority 0 is refused, as declared, when it is started at latest",
            observed="start returned",
            event=end,
            requirement=_PRIORITIES,
        )
        return
    yield check.kept(_SUPPORT[policy.definition])
    if priority in (0, _HIGHEST, _LOWEST):
        yield check.kept(_PRIORITIES)


def _refused(
    check: Property, runtime: ObservedRuntime, declaration: Declaration, operation: str, end: Raise
) -> Conclusions:
    policy = policies.extended_policy(declaration)
    if policy is None:
        return
    wrong = policies.wrong_value(policy)
    if wrong and _is_priority(policy, wrong):
        yield check.kept(_PRIORITIES)
    applied = [p for p in declaration.policies if p.definition in s.EXTENDED]
    excused = bool(wrong) or policies.is_contradictory(declaration) or len(applied) > 1
    excused = excused or bool(policies_of(declaration, *BESIDE_EXECUTION)) or policies.has_unknown_policy(declaration)
    if excused or raises(declaration, "on_init", "on_startup", "set_container_interface"):
        return
    is_zero = policy.settings.get(s.PRIORITY[policy.definition]) == 0
    if is_zero and (yield from takes(runtime, "priority-zero", "refused")):
        yield check.kept(_PRIORITIES)
        return
    own = _PRIORITIES if is_zero else _SUPPORT[policy.definition]
    expected = f"a component with the policy {policy.definition} is added and started"
    yield check.refused(operation, end, expected=expected, requirement=own)


def _is_priority(policy: s.Policy, wrong: str) -> bool:
    return wrong.startswith(s.PRIORITY[policy.definition])


@property_at("closed", *_OFFSETS.values(), feature="paced", timed=True)
def offset_passes(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """Nothing that is asked for, or comes by itself, is executed before the offset has passed."""
    for phase in paced_phases(runtime, *_OFFSETS):
        if not phase.executions:
            continue
        first = phase.executions[0]
        due = phase.first(latest=False)
        requirement = _OFFSETS[phase.policy.definition]
        if first.t < due - granularity(runtime):
            yield check.fail(
                "early",
                expected=f"'{phase.member.lane}' is executed when its offset of {shown(phase.offset)} has passed",
                observed=f"it was executed {shown(due - first.t)} too early",
                at=(phase.begin, first.enter.n),
                requirement=requirement,
            )
        elif phase.offset and (first.invocation is None or first.asked < due):
            yield check.kept(requirement)


@property_at("closed", _CONFIGURES, feature="paced", timed=True)
def each_has_its_period(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """Of two components with the same policy and different periods each runs at its own."""
    chained = runtime.ics.reading("period-anchor") == "chained"
    rated = [(phase, rate) for phase in paced_phases(runtime, s.PERIODIC_SELF_EXECUTING) for rate in _rate(phase)]
    for (one, rate), (other, _) in itertools.permutations(rated, 2):
        if one.member is other.member or one.period == other.period:
            continue
        if chained and one.period < other.period:
            continue  # each of its runs may be later than a period by as much as is declared
        if abs(rate - one.period) <= abs(rate - other.period):
            yield check.kept()
            continue
        yield check.fail(
            "another's",
            expected=f"'{one.member.lane}' runs each {shown(one.period)}, as its policy is configured",
            observed=f"it ran each {shown(rate)}; {shown(other.period)} is the period of '{other.member.lane}'",
            at=(one.executions[0].enter.n, one.executions[-1].enter.n),
        )


def _rate(phase: PacedPhase) -> Iterator[int]:
    """The mean distance of its runs, until one of them lasted for a period, if there are enough."""
    runs = phase.executions[: phase.overrun]
    if len(runs) > _ENOUGH:
        yield round((runs[-1].t - runs[0].t) / (len(runs) - 1))


@property_at("closed", _PRIORITY_CHANGES_NOTHING, feature="paced", timed=True)
def executed_at_any_priority(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """Of two components with the same policy and different priorities both are executed."""
    for one, other in itertools.permutations(paced_phases(runtime), 2):
        is_pair = one.policy.definition == other.policy.definition and one.priority != other.priority
        if not is_pair or one.member is other.member or not other.executions:
            continue
        is_background = one.policy.definition == s.BACKGROUND
        if is_background and one.number and runtime.ics.reading("background-again") == "once-a-life":
            continue
        asked = [i.t for i in one.invocations] if s.EXTENDED[one.policy.definition] == s.ACTIVE else [one.first(True)]
        latest = max([*asked[:1], one.first(True)]) + 2 * one.period + lateness(runtime)
        if one.executions:
            yield check.kept()
        elif asked and latest < one.ended_at:
            yield check.fail(
                "never",
                expected=f"'{one.member.lane}' with priority {one.priority} is executed, as '{other.member.lane}' is",
                observed="it was not",
                at=(one.begin, other.executions[0].enter.n),
            )
