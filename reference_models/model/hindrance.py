"""Other containers as a reason to refuse an operation: if phases belong to the whole application, theirs may be one (11.2.2.2)."""

from __future__ import annotations

from ucm_cts.reference_models.model.operation import OperationInProgress
from ucm_cts.reference_models.model.runtime import Runtime

_CONFIGURING = frozenset(("add_component", "remove_component", "connect", "disconnect", "create_container"))


def is_forgiving(runtime: Runtime, ongoing: OperationInProgress) -> bool:
    """May the operation end in UCM_ERROR for a reason that the rows do not show?

    Other containers are looked at when that is first asked: most operations return, beside however many containers. It is asked
    before anything changes that the operation found when it was called.
    """
    if ongoing.forgiving is None:
        ongoing.forgiving = _is_hindered_elsewhere(runtime, ongoing)
    return ongoing.forgiving


def _is_hindered_elsewhere(runtime: Runtime, ongoing: OperationInProgress) -> bool:
    others = [c for c in runtime.containers.values() if c is not ongoing.container and not c.removed]
    if ongoing.operation in _CONFIGURING:
        return any(other.started is not False for other in others)
    if ongoing.operation == "start":
        return any(member.suspended or not member.connected for other in others for member in other.live_members())
    return False
