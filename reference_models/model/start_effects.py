"""After a start or stop: the model takes over which members are operational, and with which connections."""

from __future__ import annotations

from collections.abc import Sequence

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.trace import Enter, MaybeReference, Reference, Return
from ucm_cts.reference_models.model.hindrance import is_forgiving
from ucm_cts.reference_models.model.operation import OperationInProgress, Result
from ucm_cts.reference_models.model.runtime import Container, Member, Runtime


def forget_start(member: Member) -> None:
    """A stop does not shut it down any more."""
    member.container.startup_order.pop(member, None)


def take_over_start(runtime: Runtime, ongoing: OperationInProgress, step: s.Start, end: Result) -> None:
    """A start ended."""
    returned = isinstance(end, Return)
    container = ongoing.container
    reached = _called(runtime, ongoing, "on_startup")
    own = [m for m in reached if m.container is container]
    _reached_unseen(runtime, container)
    if not runtime.shows_missing and not runtime.with_policies:
        runtime.shows_missing = _shows_missing(ongoing, own, returned)
    if not returned:
        failing = any(m.raises("on_startup") for m in container.live_members())
        half_way = any(not ongoing.received(m, "on_shutdown") for m in own)
        unseen = is_forgiving(runtime, ongoing) and all(m.doubtful for m in container.live_members())
        taken_back = {m.container.name: m.container for m in _called(runtime, ongoing, "on_shutdown")}
        unclear = container.started is not False or failing or half_way or unseen
        if unclear and (container.started is not True or own or container.name in taken_back):
            container.suspend()
            container.failed = ongoing.step_number, ongoing.call, end.n
        for other in (*taken_back.values(), *(m.container for m in reached)):
            if other is not container:
                other.suspend()
        return
    if container.started is not True:
        container.startup_order = {}
    for member in container.live_members():
        for callback in ongoing.received(member, "on_startup"):
            _resolve(member, callback, runtime.shows_missing)
        unclear = member.lingering or member.doubtful or member.instance is None
        member.suspended = unclear or member.raises("on_startup")
    order = {c.body: n for n, c in enumerate(ongoing.callbacks) if c.hook == "on_startup"}
    for member in sorted(reached, key=lambda m: order[m.body]):
        member.operational = True
        member.startups += 1
        member.container.startup_order.setdefault(member)
        if member.container is not container:
            member.container.started = True
    container.started = True


def _called(runtime: Runtime, ongoing: OperationInProgress, hook: s.Hook) -> list[Member]:
    """The instances, in whichever container, that received ``hook`` meanwhile."""
    if hook not in ongoing.hooks:
        return []
    if runtime.shares_bodies:  # then a body does not say which instance it is
        everywhere = (m for c in runtime.containers.values() for m in c.live_members())
        return [m for m in everywhere if ongoing.received(m, hook)]
    members = [runtime.bodies.get(body) for body, own in ongoing.by_body.items() if any(c.hook == hook for c in own)]
    return [m for m in members if m is not None and not m.gone]


def _shows_missing(ongoing: OperationInProgress, reached: list[Member], returned: bool) -> bool:
    """Was a start refused because of a port element that was never connected, or was nothing handed over for it?"""
    if not returned:
        members = ongoing.container.live_members() if ongoing.container.started is False else []
        unclear = any(m.suspended or m.raises("on_startup") for m in members)
        return not unclear and any(_never_connected(m) for m in members)
    return any(
        not handed_over(callback).get(port)
        for member in reached
        for port in _never_connected(member)
        for callback in ongoing.received(member, "on_startup")
    )


def _never_connected(member: Member) -> set[str]:
    return set(member.declaration.requires) - {connection.port for connection in member.connections}


def take_over_stop(runtime: Runtime, ongoing: OperationInProgress, step: s.Stop, end: Result) -> None:
    """A stop ended."""
    returned = isinstance(end, Return)
    container = ongoing.container
    _reached_unseen(runtime, container)
    for member in _called(runtime, ongoing, "on_shutdown"):
        member.operational = False
        if not returned:
            member.container.suspend()
        elif member.container is not container:
            member.container.started = False
    if not returned:
        if container.started is not False:
            container.suspend()
            container.failed = ongoing.step_number, ongoing.call, end.n
        return
    container.started = False
    container.startup_order = {}
    for member in container.live_members():
        member.operational = member.lingering = False
        member.suspended = member.doubtful or _unsure(member)


def _unsure(member: Member) -> bool:
    """Is it open whether the instance is configured?"""
    doubtful = [c.port for c in member.connections if c.live is None]
    open_ports = set(doubtful) - {c.port for c in member.live_connections()} if doubtful else doubtful
    return bool(open_ports) or member.instance is None or member.raises("on_init", "set_container_interface")


def handed_over(startup: Enter) -> dict[str, list[MaybeReference]]:
    """The non-null references of ``on_startup`` by port element name; several entries of one name are one."""
    by_port: dict[str, list[MaybeReference]] = {}
    for dependency in startup.dependencies or ():
        by_port.setdefault(dependency.port, []).extend(r for r in dependency.references if r is not None)
    return by_port


def _resolve(member: Member, startup: Enter, shows_missing: bool) -> None:
    """What on_startup handed over shows which of the doubtful connections stand. A proxy shows that only in a framework that
    ``shows_missing`` connections, and never of one whose provider is gone: there may be nothing behind it.
    """
    given = handed_over(startup)
    for connection in member.connections:
        if connection.live is not None:
            continue
        of_port = [c for c in member.connections if c.port == connection.port and c.live is not False]
        references = given.get(connection.port, [])
        outlives = connection.provider is not None and connection.provider.gone
        proxies = bool(references) and not any(isinstance(r, Reference) for r in references)
        if proxies and (outlives or not shows_missing):
            continue
        if len(references) == len(of_port):
            connection.live = True
        elif not references:
            connection.live = False
        elif all(isinstance(r, Reference) for r in (*references, *(c.reference for c in of_port))):
            twins = [c for c in of_port if c.reference == connection.reference]
            if len(twins) == 1 or connection.reference not in references:
                connection.live = connection.reference in references


def _reached_unseen(runtime: Runtime, container: Container) -> None:
    """The manager's start or stop may have reached sub-containers without members, where no callback shows it."""
    if len(runtime.containers) > 1 and container is runtime.containers[s.MANAGER]:
        for other in runtime.containers.values():
            if other is not container and not other.live_members():
                other.started = None


def is_stopped_late(runtime: Runtime, stopped: Sequence[Member]) -> bool:
    """Was a member stopped before one that was started after it, for certain? Threads may start two at a time."""
    latest: dict[int, int] = {}
    for member in stopped:
        began = runtime.startups.get(member.body)
        if began is None:
            continue
        moment, thread = began
        if latest.get(thread, moment) < moment:
            return True
        latest[thread] = moment
    return False
