"""After an operation: the model takes over what was observed, so that one defect does not spill over the rest."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.trace import MaybeReference, Raise, Reference, Return
from ucm_cts.reference_models.model.hindrance import is_forgiving
from ucm_cts.reference_models.model.operation import OperationInProgress, Result
from ucm_cts.reference_models.model.runtime import NO_ID, Connection, Container, Member, Runtime, raises
from ucm_cts.reference_models.model.start_effects import forget_start, take_over_start, take_over_stop

_PHASES = frozenset(("on_startup", "on_shutdown"))


def apply(runtime: Runtime, ongoing: OperationInProgress, end: Result) -> None:
    """Bring ``runtime`` up to date with the operation that just ended."""
    if type(end) is Raise:
        is_forgiving(runtime, ongoing)
    if not ongoing.hooks.isdisjoint(_PHASES):
        _linger(runtime, ongoing, end)
    _TAKEN_OVER[ongoing.operation](runtime, ongoing, ongoing.step, end)
    if ongoing.lost:
        _lose_track(ongoing)
    if ongoing.callbacks:
        removes = ongoing.operation in ("remove_component", "remove_container")
        for body in ongoing.by_body:
            member = runtime.bodies.get(body)
            if member is None:
                continue
            if removes and _has_uncertain_connection(member):
                member.suspended = True
            if member.suspended:
                _follow(ongoing, member)


def _linger(runtime: Runtime, ongoing: OperationInProgress, end: Result) -> None:
    """An instance whose on_shutdown made the operation raise may be operational, until on_startup comes again or a stop returns."""
    for body, callbacks in ongoing.by_body.items():
        member = runtime.bodies.get(body)
        phases = [c.hook for c in callbacks if c.hook in _PHASES]
        if member is None or not phases:
            continue
        member.lingering = phases[-1] == "on_shutdown" and isinstance(end, Raise) and member.raises("on_shutdown")
        if member.lingering:
            member.suspended = True
            if ongoing.operation in ("start", "stop"):
                member.container.suspend()


def _added(runtime: Runtime, ongoing: OperationInProgress, step: s.AddComponent, end: Result) -> None:
    value = end.value if isinstance(end, Return) else None
    declaration = runtime.scenario.components.get(step.component)
    bodies = [body for body in (*ongoing.by_body, *ongoing.created) if body not in runtime.bodies]
    own = [b for b in bodies if b[0] == step.component]
    if not isinstance(value, int) or isinstance(value, bool):
        if declaration is not None and raises(declaration, "on_init", "set_container_interface"):
            ongoing.container.failed_adds += 1
        runtime.discarded.update(body for body in bodies if body in ongoing.by_body)
        return
    member = Member(
        name=step.bind or step.component,
        component=step.component,
        declaration=declaration or s.Declaration(),
        container=ongoing.container,
        id=value,
        instance=own[0][1] if own else None,
        late=ongoing.container.started is not False,
    )
    member.suspended = (
        not own
        or declaration is None
        or not ongoing.judged
        or raises(declaration, "on_init", "set_container_interface")
    )
    twins = list(ongoing.container.present.with_id(value))
    for twin in twins:
        if twin.leaving:  # its id is free, so the removal that failed did remove it
            runtime.leave(twin)
            for connection in twin.connections:
                connection.live = False
    twins = [m for m in twins if not m.gone]
    for unsure in (member, *twins) if twins or declaration is None or ongoing.is_after_removal else ():
        unsure.suspended = True
        unsure.mark_doubtful()
    runtime.enrol(member)
    if ongoing.received(member, "on_startup"):
        member.operational = True
        member.startups = 1
        if ongoing.container.started:
            ongoing.container.startup_order[member] = None
        else:
            member.suspended = True
    ongoing.subject = member


def _found(runtime: Runtime, ongoing: OperationInProgress, step: s.GetPortElement, end: Result) -> None:
    if isinstance(end, Return):
        recognised = isinstance(end.value, Reference) or end.value == "opaque"
        reference: MaybeReference = end.value if recognised else None  # type: ignore[assignment]
        owner = runtime.provider_of(reference)
        runtime.references[step.bind] = (reference, owner or ongoing.subject or runtime.members.get(step.id))
        runtime.ports[step.bind] = reference.port if isinstance(reference, Reference) and owner else step.port


def _connected(runtime: Runtime, ongoing: OperationInProgress, step: s.Connect, end: Result) -> None:
    member = ongoing.subject
    if member is None:
        return
    reference, provider = runtime.reference(step.to)
    if isinstance(end, Raise):
        if member.body in ongoing.by_body:  # it began: it is open what stands
            member.suspended = True
            for earlier in member.live_connections(step.port):
                earlier.live = None
            port = runtime.ports.get(step.to, "")
            runtime.connect(Connection(step.bind, NO_ID, member, step.port, reference, provider, port, live=None))
        return
    value = end.value
    if not isinstance(value, int) or step.port not in member.declaration.requires or step.to == s.NIL:
        member.suspended = True
        return
    connection = Connection(step.bind, value, member, step.port, reference, provider, runtime.ports.get(step.to, ""))
    replaced = bool(ongoing.received(member, "on_disconnect"))
    for earlier in member.live_connections(step.port):
        earlier.live = False if replaced or earlier.id == value else None
    for twin in runtime.remembered.with_id(value):
        if twin.client.container is not member.container:
            continue
        if twin.live:
            twin.ambiguous = connection.ambiguous = True
            twin.client.suspended = member.suspended = True
        twin.live = twin.live or False  # its id is free, so a doubtful one does not stand
    connection.stale = provider is not None and provider.gone
    if connection.stale:
        connection.live = None
        member.suspended = True
    runtime.connect(connection)
    runtime.forget_repetitions(member)
    member.once_connected.add(step.port)
    runtime.connections[step.bind] = connection
    if ongoing.received(member, "on_startup"):
        member.handed_over = tuple(c for c in member.connections if c.live is not False)
        if ongoing.judged and not member.suspended:  # late connections are taken at once
            member.operational = True
            member.startups += 1
            forget_start(member)
            ongoing.container.startup_order[member] = None
        else:
            member.suspended = True


def _disconnected(runtime: Runtime, ongoing: OperationInProgress, step: s.Disconnect, end: Result) -> None:
    connection = ongoing.connection
    if connection is None:
        return
    if isinstance(end, Raise):
        if connection.live is None and _is_not_there(ongoing, connection.client, end):
            connection.live = False
        elif connection.client.body in ongoing.by_body:
            connection.live = None
            connection.client.suspended = True
        return
    connection.live = False
    client = connection.client
    if ongoing.received(client, "on_shutdown"):  # it is not left half-connected
        client.operational = False
        forget_start(client)
    if any(c.live is None and c.port == connection.port for c in client.connections):
        client.suspended = True


def _component_removed(runtime: Runtime, ongoing: OperationInProgress, step: s.RemoveComponent, end: Result) -> None:
    member = ongoing.subject
    if member is None:
        return
    if isinstance(end, Return):
        _removed(runtime, ongoing, [member])
    elif member.leaving and _is_not_there(ongoing, member, end):
        _gone_after_all(runtime, member)
    elif ongoing.received(member, "on_remove"):
        _perhaps_removed(runtime, [member])


def _is_not_there(ongoing: OperationInProgress, owner: Member, end: Raise) -> bool:
    """Does its own container say that what ``owner`` is or has is not there? Another container need not know it."""
    return end.error == "NOT_FOUND" and ongoing.container is owner.container


def _gone_after_all(runtime: Runtime, member: Member) -> None:
    """A removal failed, and now the container says that the component is not there: that removal did remove it.

    A connection whose on_disconnect raised may have been kept all the same (callback-failure).
    """
    for connection in member.connections:
        connection.live = None if connection.live is None and member.raises("on_disconnect") else False
    runtime.let_go(member)
    container = member.container
    container.of_doubt = any(other.doubtful for other in container.live_members())


def _container_created(runtime: Runtime, ongoing: OperationInProgress, step: s.CreateContainer, end: Result) -> None:
    if isinstance(end, Return):
        earlier = runtime.containers.get(step.bind)
        if earlier is not None:  # the variable is bound anew; the container it held is still there
            runtime.containers[f"{step.bind}, {len(runtime.containers)}"] = earlier
        cascading = runtime.containers[s.MANAGER].started is not False  # its phase may become the new one's
        runtime.containers[step.bind] = Container(step.bind, started=None if cascading else False)


def _container_removed(runtime: Runtime, ongoing: OperationInProgress, step: s.RemoveContainer, end: Result) -> None:
    container = runtime.containers.get(step.container)
    known = container is not None and not container.removed and container.name != s.MANAGER
    if not known or container is None:
        return
    if isinstance(end, Return):
        _removed(runtime, ongoing, container.live_members())
        container.removed = True
        container.doubtful = False
    elif ongoing.callbacks:
        for member in container.live_members():
            member.not_undone = ongoing.not_undone(member)
            member.not_shut_down = ongoing.not_shut_down(member)
        _perhaps_removed(runtime, container.live_members())
        was_started = container.started
        container.suspend()
        container.failed = ongoing.step_number, ongoing.call, end.n
        container.started = was_started and None  # one that was not started does not run
        container.doubtful = True


def _destroyed(runtime: Runtime, ongoing: OperationInProgress, step: s.Destroy, end: Result) -> None:
    runtime.destroyed = True
    for container in runtime.containers.values():
        for member in container.members:
            member.operational = False
            if isinstance(end, Return):
                runtime.leave(member)


def _perhaps_removed(runtime: Runtime, members: Sequence[Member]) -> None:
    """The removal failed, but part of it happened: it is open what is left."""
    for client, used in runtime.clients_of(members):
        client.suspended = True
        for connection in used:
            connection.live = None
    for member in members:
        member.suspended = member.leaving = True
        member.mark_doubtful()
        for connection in member.live_connections():
            connection.live = None


def _removed(runtime: Runtime, ongoing: OperationInProgress, removed: Sequence[Member]) -> None:
    for client, used in runtime.clients_of(removed):
        undone = len(ongoing.received(client, "on_disconnect")) >= len(used)
        for connection in used:
            connection.live = False if undone else _still_stands(connection)
        if ongoing.received(client, "on_shutdown"):
            client.operational = False
        client.suspended = client.suspended or any(connection.live is None for connection in used)
    for member in removed:
        member.operational = False
        forget_start(member)
        for connection in member.connections:
            connection.live = False
        runtime.let_go(member)


def _still_stands(connection: Connection) -> bool | None:
    """Does the connection of a client stand whose provider was removed without on_disconnect? None if that is open.

    An emitter keeps its connection: other receivers have it, too, or its on_disconnect would have shown that it is undone.
    """
    client = connection.client
    if connection.provider is not None or not connection.takers:
        return None
    others = any(not taker.gone for taker in connection.takers)
    return True if others or client.declaration.connectable or client.operational else None


def _has_uncertain_connection(member: Member) -> bool:
    """May its callbacks be of a connection of which it is open whether it stood?"""
    return not member.gone and any(c.live is None for c in member.connections)


def _follow(ongoing: OperationInProgress, member: Member) -> None:
    """The state of a suspended instance follows its callbacks."""
    for callback in ongoing.by_body.get(member.body, ()):
        if callback.hook == "on_startup":
            member.operational = True
        elif callback.hook == "on_shutdown":
            member.operational = False


def _lose_track(ongoing: OperationInProgress) -> None:
    if ongoing.operation in ("start", "stop"):
        ongoing.container.suspend()
    for member, _ in ongoing.roles:
        if member is not None:
            member.suspended = True


_TAKEN_OVER: dict[str, Callable[[Runtime, OperationInProgress, Any, Result], None]] = {
    "add_component": _added,
    "remove_component": _component_removed,
    "get_port_element": _found,
    "connect": _connected,
    "disconnect": _disconnected,
    "start": take_over_start,
    "stop": take_over_stop,
    "get_components": lambda runtime, ongoing, step, end: None,
    "create_container": _container_created,
    "remove_container": _container_removed,
    "destroy": _destroyed,
}
