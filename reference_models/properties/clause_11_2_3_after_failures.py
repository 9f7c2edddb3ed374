"""Properties about what follows a failure (11.2.2, callback-failure).

The text leaves open how far an operation came in which a body raised, and not that sound members are left behind.
"""

from __future__ import annotations

from collections.abc import Iterable

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.trace import Raise, Return
from ucm_cts.reference_models.conclusions import Concluded
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.operation import OperationInProgress
from ucm_cts.reference_models.model.runtime import Container, Member, lane
from ucm_cts.reference_models.properties.declaration import Property, property_at

_STARTS_ALL, _STOPS_ALL = "R-11.2.2.1-11", "R-11.2.2.1-12"
_REMOVES_ALL, _DESTROYS_ALL, _DISCONNECTS_ALL = "R-11.2.2.2-04", "R-11.2.2.2-05", "R-11.2.1.3-05"


@property_at("unsettled", _STARTS_ALL, _STOPS_ALL, at=("start", "stop"))
def nobody_left_behind(check: Property, runtime: ObservedRuntime, ongoing: OperationInProgress) -> Concluded:
    """A start or a stop that returns after one that failed leaves no sound member out."""
    container = ongoing.container
    if not isinstance(ongoing.end, Return) or container.started is not None or runtime.destroyed or container.doubtful:
        return ()
    starts = ongoing.operation == "start"
    if starts and container.failed and isinstance(runtime.scenario.steps[container.failed[0]], s.Stop):
        return ()  # it may count as started still, and then start changes nothing
    sound = [m for m in container.live_members() if m.is_sound and not m.doubtful and not m.late]
    left = [m for m in sound if (m.phase == "on_startup") != starts and (m.phase or starts)]
    if not left:
        return ()
    hook = "on_startup" if starts else "on_shutdown"
    return _left(check, ongoing, container, left, hook, _STARTS_ALL if starts else _STOPS_ALL)


@property_at("unsettled", _REMOVES_ALL, _DESTROYS_ALL, _DISCONNECTS_ALL, at=("remove_container", "destroy"))
def nobody_dropped(check: Property, runtime: ObservedRuntime, ongoing: OperationInProgress) -> Concluded:
    """When remove_container or destroy returned although a body raised, or a container is gone after a remove_container that
    failed, each sound member was shut down, was told of each connection that was undone, and has received on_remove.
    """
    step = ongoing.step
    if isinstance(step, s.RemoveContainer):
        container = runtime.containers.get(step.container)
        is_gone = isinstance(ongoing.end, Raise) and ongoing.end.error == "NOT_FOUND"
        if container is None or container.removed or not (isinstance(ongoing.end, Return) or is_gone):
            return ()
        if is_gone and not container.doubtful:
            return ()
        members: Iterable[Member] = container.live_members()
    elif isinstance(ongoing.end, Return) and not runtime.destroyed:
        there = [c for c in runtime.containers.values() if not c.removed]  # what is added to another one is open
        members = [m for c in there for m in c.live_members()]
    else:
        return ()
    removes = _REMOVES_ALL if isinstance(step, s.RemoveContainer) else _DESTROYS_ALL
    container = runtime.containers.get(getattr(step, "container", ""), ongoing.container)
    sound = [member for member in members if member.is_sound]
    for hook, requirement, is_due in (
        ("on_shutdown", removes, ongoing.not_shut_down),
        ("on_disconnect", _DISCONNECTS_ALL, ongoing.not_undone),
        ("on_remove", removes, _not_removed),
    ):
        left = [member for member in sound if is_due(member)]
        if left:
            return _left(check, ongoing, container, left, hook, requirement)
    return ()


def _not_removed(member: Member) -> bool:
    return not member.told_of_removal


@property_at("unsettled", "R-11.2.3-08", at=("connect",))
def port_is_free(check: Property, runtime: ObservedRuntime, ongoing: OperationInProgress) -> Concluded:
    """A port is connected again when its connection is certainly undone, although on_disconnect raised meanwhile."""
    member, step, end = ongoing.subject, ongoing.step, ongoing.end
    if member is None or not isinstance(step, s.Connect) or ongoing.container.started is not False:
        return ()
    _, provider = runtime.reference(step.to)
    earlier = [connection for connection in member.connections if connection.port == step.port]
    is_free = bool(earlier) and all(connection.live is False for connection in earlier)
    if not is_free or not member.raises("on_disconnect") or member.raises("on_connect") or member.doubtful:
        return ()
    known = [c for c in earlier if c.provider is provider and c.provided == runtime.ports.get(step.to)]
    if provider is None or provider.gone or provider.doubtful or not known:  # it was good enough before
        return ()
    if not isinstance(end, Raise):
        return check.kept()
    return check.refused(
        "connect",
        end,
        expected=f"{step.port} of '{member.lane}', whose connection has been undone, can be connected again",
        cause="not free",
    )


def _left(
    check: Property, ongoing: OperationInProgress, container: Container, left: list[Member], hook: str, requirement: str
) -> Concluded:
    """Names the operation that failed, which left them out, and the one that shows it."""
    step, begin, end = container.failed or (ongoing.step_number, 0, 0)
    names = ", ".join(f"'{member.lane}'" for member in left[:3])
    return check.fail(
        hook,
        expected=f"each member whose body does not raise has received {hook} when {ongoing.operation} is over",
        observed=f"{names} did not receive it",
        at=tuple(sorted((begin, end, ongoing.call, ongoing.end.n))) if begin else (ongoing.call, ongoing.end.n),
        step=step,
        requirement=requirement,
    )


_OVER: dict[str, str] = {
    "on_init": "R-11.2.3-05",
    "on_connect": "R-11.2.1.3-02",
    "on_disconnect": _DISCONNECTS_ALL,
    "on_startup": _STARTS_ALL,
    "on_shutdown": _STOPS_ALL,
    "on_remove": "R-11.2.1.2-06",
}
"""The requirement that a callback breaks which is not over when its operation has returned."""


@property_at("ended", *_OVER.values())
def callbacks_are_over(check: Property, runtime: ObservedRuntime, ongoing: OperationInProgress) -> Concluded:
    """An operation returns when its callbacks have returned: until then nothing is initialised, started or removed."""
    if not ongoing.inside or not isinstance(ongoing.end, Return):
        return ()
    callback = ongoing.inside[0]
    if callback.hook not in _OVER:
        return ()
    return check.fail(
        callback.hook,
        expected=f"{ongoing.operation} returns when {callback.hook} of '{lane(*callback.body)}' has returned",
        observed="it returned before",
        at=(callback.n, ongoing.end.n),
        step=ongoing.step_number,
        requirement=_OVER[callback.hook],
    )
