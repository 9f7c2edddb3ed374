"""Properties about components that many callers enter as fast as they can: tiny holes in their protection (10.1.3.2).

Counters inside the body tell who met whom. They prove something only if they find overlap where nobody protects.
"""

from __future__ import annotations

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.trace import Counted, Paused, Pushed, Return, Stressed
from ucm_cts.reference_models.conclusions import Conclusions, Measured
from ucm_cts.reference_models.model.executions import CALL_EXCLUSIONS, exclusion, protection_of
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.properties.declaration import Property, property_at


@property_at("told", *CALL_EXCLUSIONS)
def no_overlap_under_stress(
    check: Property, runtime: ObservedRuntime, event: Return | Pushed | Counted | Paused | Stressed
) -> Conclusions:
    """Callers that stress a protected component never meet inside."""
    if not isinstance(event, Stressed):
        return
    step = runtime.scenario.steps[event.step]
    assert isinstance(step, s.Stress)
    members = {runtime.reference(ref)[1] for ref in step.refs}
    member = members.pop() if len(members) == 1 else None
    if member is None or not member.serving:
        return
    ports = [runtime.ports[ref] for ref in step.refs]
    requirement = exclusion(member.declaration, runtime.ics, ports[0], ports[-1])
    if not requirement:
        if event.overlaps and protection_of(member.declaration) == "unprotected":
            yield check.kept("R-10.1.3.2-20")
        return
    yield Measured("calls stressed", event.calls)
    if event.overlaps:
        yield check.fail(
            "tiny hole",
            expected=f"callers of {' and '.join(dict.fromkeys(ports))} are never in '{member.lane}' at a time",
            observed=f"they met there {event.overlaps} times in {event.calls} calls",
            at=(event.n,),
            step=event.step,
            requirement=requirement,
        )
    elif event.control_overlaps and event.calls:
        yield check.kept(requirement)
        yield Measured("calls stressed beside a control that was found out", event.calls)
