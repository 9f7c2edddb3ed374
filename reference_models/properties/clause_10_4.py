"""Properties that hold for what comes to a component through any connector of 10.4: its phase, and its execution policy."""

from __future__ import annotations

from collections.abc import Mapping

from ucm_cts.adapters.contract.platform_interfaces import NOTIFY, REQUEST_RESPONSE, RESPONSE, SHARED_DATA
from ucm_cts.adapters.contract.scenario import Start
from ucm_cts.reference_models.conclusions import Concluded, Conclusions
from ucm_cts.reference_models.model import execution_policies as policies
from ucm_cts.reference_models.model import executions as ex
from ucm_cts.reference_models.model.method_calls import Delivery
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.runtime import lane
from ucm_cts.reference_models.properties.declaration import Property, property_at

_PHASES: Mapping[str, str] = {REQUEST_RESPONSE: "R-10.4.1.2-19", SHARED_DATA: "R-10.4.2.2-04"}
_PROTECTED: Mapping[str, str] = {REQUEST_RESPONSE: "R-10.4.1.2-18", SHARED_DATA: "R-10.4.2.2-05"}
"""The requirements by connector."""


@property_at("delivered", *_PHASES.values(), feature="extended")
def entered_in_phase(check: Property, runtime: ObservedRuntime, delivery: Delivery) -> Concluded:
    """A connector enters no component that is not operational."""
    link, receiver = delivery.link, delivery.receiver
    if link is None or not link.is_extended or receiver is None or receiver.suspended:
        return ()
    starting = any(isinstance(o.step, Start) for o in runtime.interactions.in_progress.values())
    if receiver.operational or starting or receiver.container.started is not False:
        return ()
    return check.fail(
        "not operational",
        expected=f"{delivery.enter.method} enters '{receiver.lane}' while it is operational",
        observed="it was entered outside the operational phase",
        at=(delivery.enter.n,),
        requirement=_PHASES[link.connector],
    )


@property_at("began", *_PROTECTED.values(), feature="extended")
def called_back_alone(check: Property, runtime: ObservedRuntime, execution: ex.Execution) -> Conclusions:
    """A response or a notification enters a protected component when nothing else is inside."""
    enter = execution.enter
    connector = {RESPONSE: REQUEST_RESPONSE, NOTIFY: SHARED_DATA}.get(enter.method or "")
    if enter.hook != "method" or connector is None or not _is_end(runtime, connector, enter.body, enter.port):
        return
    declaration = runtime.scenario.components[enter.component]
    for other in execution.met:
        excluded = policies.exclusion(declaration, runtime.ics, execution.way, other.way)
        if excluded and ex.is_guarded(runtime.ics, execution, other):
            yield check.fail(
                "inside",
                expected=f"nothing else executes '{lane(*enter.body)}' when {enter.method} enters it",
                observed=f"its {other.way} was executed",
                at=(other.enter.n, enter.n),
                requirement=_PROTECTED[connector],
            )
            return


def _is_end(runtime: ObservedRuntime, connector: str, body: tuple[str, int], port: str | None) -> bool:
    """Is that port element of the body an end of a connection with this connector?"""
    member = runtime.bodies.get(body)
    links = [k for k in runtime.interactions.links.values() if k.connector == connector]
    return any(end.member is member and end.port == port for link in links for end in link.ends)
