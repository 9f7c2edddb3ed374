"""Properties about the operational phases of components with a policy of 10.5: no execution outside of them (10.5.2)."""

from __future__ import annotations

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.reference_models.conclusions import Conclusions
from ucm_cts.reference_models.model.execution_policies import extended_policy, managed_ports
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.paced_events import PacedPhase
from ucm_cts.reference_models.model.paced_phases import paced_phases
from ucm_cts.reference_models.model.phases import is_outside
from ucm_cts.reference_models.properties.declaration import Property, property_at

_PHASES, _RESTARTS = "R-10.5.2-20", "R-10.5.2-21"


def of_phase(phase: PacedPhase, requirement: str) -> str:
    """The requirement that was broken in ``phase``: after a restart the one about restarts."""
    return _RESTARTS if phase.number else requirement


@property_at("closed", _PHASES, feature="paced")
def executed_in_its_phases(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """A run or a paced execution begins after on_startup has returned, and before stop or removal has."""
    for member in list(runtime.bodies.values()):
        if extended_policy(member.declaration) is None or member.suspended:
            continue
        managed = managed_ports(member.declaration)
        for execution in runtime.executions.of(member.body):
            enter = execution.enter
            if execution.way != "run" and execution.way not in managed:
                continue
            if execution.way != "run" and execution.call is not None and is_outside(runtime, member, execution.call.n):
                continue  # whoever calls a component that is not operational gets what 11.2.3 says
            if is_outside(runtime, member, enter.n):
                yield check.fail(
                    "not operational",
                    expected=f"'{member.lane}' is executed after its on_startup returned and before stop returned",
                    observed=f"its {execution.way} was entered outside of that",
                    at=(enter.n,),
                )
                break


@property_at("closed", _PHASES, feature="paced")
def idle_after_its_phase(check: Property, runtime: ObservedRuntime) -> Conclusions:
    """Something was due when the phase ended, time passed, and it was not executed."""
    for phase in paced_phases(runtime):
        entered = [e.enter.n for e in runtime.executions.of(phase.member.body)]
        stopped = phase.closed
        due = max(phase.first(latest=True), phase.ended_at + phase.period)
        later = [p for p in runtime.interactions.pauses if p.n > stopped and p.t > due]
        is_active = s.EXTENDED[phase.policy.definition] == s.ACTIVE
        waiting = [i for i in phase.invocations if not i.executions and i.n < phase.until]
        is_due = (
            bool(waiting) if is_active else phase.policy.definition == s.PERIODIC_SELF_EXECUTING or not phase.executions
        )
        if is_due and later and not any(stopped < n < later[-1].n for n in entered):
            yield check.kept()
