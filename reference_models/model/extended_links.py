"""What connections with connectors of 10.4 have in common: their ends and values, what disturbs them, and what is waited for in vain."""

from __future__ import annotations

from collections.abc import Collection, Iterator

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.data_values import printed
from ucm_cts.adapters.contract.platform_interfaces import CONNECTOR_PORTS, named_interfaces
from ucm_cts.adapters.contract.trace import Event
from ucm_cts.reference_models.model.links import End, LinkState, element_names
from ucm_cts.reference_models.model.messages import waited_for
from ucm_cts.reference_models.model.method_calls import Operation
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.runtime import Member

_LONGEST = 200


def value_shown(value: object) -> str:
    """A value that a connection carries, for people; of a long one the beginning."""
    return printed(value, _LONGEST)


def end_at(link: LinkState, member: object, port: str, moment: int) -> End | None:
    """The end that ``port`` of ``member`` was at that moment, or is still called at."""
    ends = [end for end in link.ends if end.member is member and end.port == port and end.since < moment]
    return max(ends, key=lambda end: end.since, default=None)


def fits(runtime: ObservedRuntime, member: Member, step: s.Attach, link: LinkState) -> bool:
    """Has the component the port elements of that connector port, with the interfaces of the connection, and are they free?"""
    kind = CONNECTOR_PORTS.get(step.role)
    if kind is None or kind.connector != link.connector:
        return False
    due = named_interfaces("", runtime.scenario.types[link.interface])
    names = element_names(member.declaration, step.port, kind)
    interfaces = runtime.scenario.interfaces
    return len(names) == len(kind.elements) and all(
        interfaces.get(member.declaration.ports.get(name, "")) == due[f".{element.interface}"]
        and (element.provided or len(member.live_connections(name)) <= 1)
        for element, name in names.items()
    )


def changes_between(
    runtime: ObservedRuntime, begin: int, end: int, among: Collection[Member] = ()
) -> Iterator[Operation]:
    """Operations between these events that stop or remove components, undo connections, or break or mend them.

    ``among``: a stop of a container that has none of these components does not count. A stop of the manager always does.
    """
    places = {id(member.container) for member in among}
    return (
        o
        for o in runtime.interactions.changes
        if (o.step.undoes or isinstance(o.step, s.Mend)) and o.overlaps(begin, end) and not _is_elsewhere(o, places)
    )


def _is_elsewhere(operation: Operation, places: Collection[int]) -> bool:
    """Does it stop a container that is none of ``places``, and not the manager?"""
    container = operation.container
    is_stop = isinstance(operation.step, s.Stop) and operation.step.container != s.MANAGER
    return is_stop and bool(places) and container is not None and id(container) not in places


def overdue_since(runtime: ObservedRuntime, member: Member, since: Event) -> int:
    """The event at which an entry of a method of ``member`` had been waited for in vain, with all patience, after the event
    ``since``; 0 if there is none.
    """
    gates = {a.gate for a in member.declaration.plan.get("method", ()) if isinstance(a, s.HoldAtGate)}
    for wait in runtime.interactions.waits:
        is_for_it = isinstance(wait.step, s.ReachGate) and wait.step.gate in gates
        if is_for_it and wait.timeout.n > since.n and waited_for(runtime, wait.timeout, since.t):
            return wait.timeout.n
    return 0
