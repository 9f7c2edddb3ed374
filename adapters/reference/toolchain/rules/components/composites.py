"""Rules of 9.5.5.1, 9.5.5.3 and 9.5.5.6: parts of composites and port delegations."""

from __future__ import annotations

from collections.abc import Iterator
from operator import attrgetter
from typing import NamedTuple

from ucm_cts.adapters.contract.metamodel import components as mc
from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.contract.metamodel.names import Declared, Scope
from ucm_cts.adapters.reference.toolchain.checking import Complaint, rule
from ucm_cts.adapters.reference.toolchain.rules.circles import circle, circle_complaint
from ucm_cts.adapters.reference.toolchain.rules.components import part_ports


@rule("R-9.5.5.1-02", mc.CompositeComponentImplementation)
def has_some_part(composite: mc.CompositeComponentImplementation, _scope: Scope) -> Iterator[Complaint]:
    """A composite has a part."""
    if not composite.parts:
        yield composite, f"composite {composite.name} has no part; add one"


@rule("R-9.5.5.3-01", mc.AssemblyPart, judged_by=attrgetter("instance_of"))
def parts_are_components(part: mc.AssemblyPart, scope: Scope) -> Iterator[Complaint]:
    """A part is an instance of a component that is there."""
    if scope.find(part.instance_of, *part_ports.COMPONENTS) is None:
        yield (
            part,
            f"part {part.name} is a '{part.instance_of}', which is no component type or implementation; declare it",
        )


@rule("R-9.5.5.3-04", Model)
def composites_do_not_contain_themselves(_model: Model, root: Scope) -> Iterator[Complaint]:
    """Containing comes to an end."""
    yield from circle_complaint(
        circle(root, [mc.CompositeComponentImplementation], _composite_parts),
        "contains",
        "composite ",
        "let one of the parts be something else",
    )


def _composite_parts(composite: Declared) -> Iterator[Declared]:
    assert isinstance(composite.element, mc.CompositeComponentImplementation)
    for part in composite.element.parts:
        component = composite.scope.find(part.instance_of, *part_ports.COMPONENTS)
        if component is not None and isinstance(component.element, mc.CompositeComponentImplementation):
            yield component


class Ends(NamedTuple):
    """Both ports of a delegation; None for what is not there."""

    delegation: mc.PortDelegation
    part: str
    port: str
    outer: Declared | None
    inner: Declared | None

    @property
    def both(self) -> tuple[part_ports.Specified, part_ports.Specified] | None:
        """What their specifications mean; None if one of both is not there."""
        outer = part_ports.specified(self.outer) if self.outer is not None else None
        inner = part_ports.specified(self.inner) if self.inner is not None else None
        return (outer, inner) if outer is not None and inner is not None else None


def _ends(composite: mc.CompositeComponentImplementation, scope: Scope) -> list[Ends]:
    """The ports of each delegation that leads to one end."""
    return scope.remembered_last("delegated", id(composite), lambda: list(_find_ends(composite, scope)))


def _find_ends(composite: mc.CompositeComponentImplementation, scope: Scope) -> Iterator[Ends]:
    own = scope.find(composite.type, mc.ComponentType)
    for delegation in composite.delegations:
        if len(_targets(delegation)) != 1:
            continue
        ((part_name, port_name),) = _targets(delegation)
        part = part_ports.part_called(composite, part_name, scope)
        its_type = part_ports.component_type(part.instance_of, scope) if part is not None else None
        yield Ends(
            delegation,
            part_name,
            port_name,
            part_ports.port_of(own, delegation.port) if own is not None else None,
            part_ports.port_of(its_type, port_name) if its_type is not None else None,
        )


def _targets(delegation: mc.PortDelegation) -> set[tuple[str, str]]:
    """Part and port of each end, in whichever way it is written."""
    written = {(end.part, end.port) for end in delegation.ends}
    if delegation.internal_part or delegation.internal_port:
        written.add((delegation.internal_part, delegation.internal_port))
    return written


@rule("R-9.5.5.6-01", mc.CompositeComponentImplementation)
def delegated_ports_are_the_composites(
    composite: mc.CompositeComponentImplementation, scope: Scope
) -> Iterator[Complaint]:
    """The external port belongs to the composite's type."""
    own = scope.find(composite.type, mc.ComponentType)
    for delegation in composite.delegations:
        if own is not None and part_ports.port_of(own, delegation.port) is None:
            yield delegation, f"'{delegation.port}' is no port of {composite.type}; delegate one of those"


@rule("R-9.5.5.6-02", mc.PortDelegation)
def delegations_have_one_inner_end(delegation: mc.PortDelegation, _scope: Scope) -> Iterator[Complaint]:
    """A delegation leads to one port."""
    if not _targets(delegation):
        yield delegation, f"the delegation of {delegation.port} leads nowhere; add a ConnectionEnd"
    elif len(delegation.ends) > 1 or len(_targets(delegation)) > 1:
        yield delegation, f"the delegation of {delegation.port} leads to several ports; keep one of them"


@rule("R-9.5.5.6-03", mc.CompositeComponentImplementation)
def delegations_lead_to_ports_of_parts(
    composite: mc.CompositeComponentImplementation, scope: Scope
) -> Iterator[Complaint]:
    """The inner end is at a port of a part."""
    for ends in _ends(composite, scope):
        part = part_ports.part_called(composite, ends.part, scope)
        if part is None:
            yield ends.delegation, f"'{ends.part}' is no part of composite {composite.name}; name one of those"
        elif ends.inner is None and part_ports.component_type(part.instance_of, scope) is not None:
            yield ends.delegation, f"'{ends.port}' is no port of part {part.name}; name one of those"


@rule("R-9.5.5.6-04", mc.CompositeComponentImplementation)
def delegated_ports_have_one_specification(
    composite: mc.CompositeComponentImplementation, scope: Scope
) -> Iterator[Complaint]:
    """Both ports have the same port type, or the same role."""
    for ends in _ends(composite, scope):
        if ends.both is not None and not ends.both[0].same_target(ends.both[1]):
            port = f"{ends.part}.{ends.port}"
            yield (
                ends.delegation,
                f"{ends.delegation.port} and {port} are not specified alike; delegate to another port",
            )


@rule("R-9.5.5.6-05", mc.CompositeComponentImplementation, under="delegation-bindings=same")
def delegated_ports_bind_alike(composite: mc.CompositeComponentImplementation, scope: Scope) -> Iterator[Complaint]:
    """The same stands for the same at both ports."""
    for ends in _ends(composite, scope):
        both = ends.both
        if both is not None and both[0].same_target(both[1]) and not both[0].same_bindings(both[1]):
            port = f"{ends.part}.{ends.port}"
            yield ends.delegation, f"{ends.delegation.port} and {port} bind different types; delegate to another port"


@rule("R-9.5.5.6-07", mc.CompositeComponentImplementation, under="double-delegation=refused")
def ports_are_delegated_once(composite: mc.CompositeComponentImplementation, _scope: Scope) -> Iterator[Complaint]:
    """A port is delegated to one part only."""
    seen: set[str] = set()
    for delegation in composite.delegations:
        if delegation.port in seen:
            yield delegation, f"{delegation.port} is delegated already; keep one of both delegations"
        seen.add(delegation.port)


@rule("R-9.5.5.6-07", mc.CompositeComponentImplementation, under="delegated-and-connected=refused")
def delegated_ports_are_not_connected(
    composite: mc.CompositeComponentImplementation, _scope: Scope
) -> Iterator[Complaint]:
    """A port that stands for the composite's is in no connection inside."""
    connected = {(end.part, end.port) for connection in composite.connections for end in connection.ends}
    for delegation in composite.delegations:
        for part, port in sorted(_targets(delegation) & connected):
            yield delegation, f"{part}.{port} is connected, too; take it out of the connection or do not delegate it"
