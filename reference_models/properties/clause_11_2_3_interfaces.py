"""Properties about the interfaces of connected port elements: both ends of a connection have the same one (11.2.3)."""

from __future__ import annotations

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.trace import Raise, Return
from ucm_cts.reference_models.conclusions import Concluded, Conclusions
from ucm_cts.reference_models.model.links import LinkState, differ, interface_of, is_misfit
from ucm_cts.reference_models.model.observed_runtime import ObservedRuntime
from ucm_cts.reference_models.model.operation import OperationInProgress, Result
from ucm_cts.reference_models.model.runtime import Connection
from ucm_cts.reference_models.properties.declaration import Property, property_at

_COMPATIBLE = "R-11.2.3-18"
_OPTION = "incompatible-ends"


@property_at("ended", _COMPATIBLE, at=("connect", "start"), feature="interactions")
def compatible_ends(check: Property, runtime: ObservedRuntime, ongoing: OperationInProgress) -> Conclusions:
    """Port elements with different interfaces are not connected, or their components never started, if so declared."""
    if runtime.ics.reading(_OPTION) != "refused":
        return
    if isinstance(ongoing.step, s.Connect):
        client, (_, provider) = ongoing.subject, runtime.reference(ongoing.step.to)
        provided = runtime.ports.get(ongoing.step.to, "")
        if client is None or provider is None or ongoing.step.port not in client.declaration.requires:
            return
        if isinstance(ongoing.end, Raise) and differ(client, ongoing.step.port, provider, provided):
            yield check.kept()
        return
    wrong, attached = _misfit(runtime, ongoing)
    if wrong and isinstance(ongoing.end, Raise):
        yield check.kept()
    elif wrong:
        yield check.fail(
            "started",
            expected=f"{wrong}, which has another interface than it is connected to, is not started",
            observed="start returned",
            at=(*attached, ongoing.call, ongoing.end.n),
            step=ongoing.step_number,
        )


def _misfit(runtime: ObservedRuntime, ongoing: OperationInProgress) -> tuple[str, tuple[int, ...]]:
    """The first port element of the container that is connected to another interface, and the event that attached it, if it
    was attached; empty if there is none.
    """
    for member in ongoing.container.live_members():
        for connection in member.connections:
            if connection.live is not False and _is_surely_misfit(runtime, connection):
                return f"{connection.port} of '{member.lane}'", ()
    for link in runtime.interactions.improper(ongoing.container):
        for end in link.misfits:
            own = interface_of(end.member, end.port)
            required, provided = (own, link.interface) if end in link.senders else (link.interface, own)
            if end.member.container is ongoing.container and not _offers_all(runtime, required, provided):
                return f"{end.port} of '{end.member.lane}'", (end.since,)
    return "", ()


def _is_surely_misfit(runtime: ObservedRuntime, connection: Connection) -> bool:
    """Have its ends different interfaces, and does the provided one lack a method of the required one?"""
    provider = connection.provider
    if provider is None or not is_misfit(connection):
        return False
    required, provided = interface_of(connection.client, connection.port), interface_of(provider, connection.provided)
    return not _offers_all(runtime, required, provided)


def _offers_all(runtime: ObservedRuntime, required: str, provided: str) -> bool:
    """Has the interface ``provided`` the same methods as ``required``, or does it inherit them (9.2.7.1)? Connecting these may be right."""
    wanted, offered = (runtime.scenario.interfaces.get(name) for name in (required, provided))
    if wanted is None or offered is None or not wanted.methods.items() <= offered.methods.items():
        return False
    return len(wanted.methods) == len(offered.methods) or 0 < len(wanted.methods.keys() & {*offered.inherited}) == len(
        wanted.methods
    )


@property_at("linked", _COMPATIBLE)
def compatible_attachment(
    check: Property, runtime: ObservedRuntime, link: LinkState | None, step: s.ConnectorCall, end: Result
) -> Concluded:
    """A port element of another interface than its connector's is refused, if so declared; compatible_ends has the rest."""
    if link is None or link.is_extended or not isinstance(step, s.Attach) or runtime.ics.reading(_OPTION) != "refused":
        return ()
    member = runtime.members.get(step.id)
    if member is None or isinstance(end, Return) or interface_of(member, step.port) == link.interface:
        return ()
    return check.kept()
