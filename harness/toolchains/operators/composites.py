"""Edits of composites, connections and delegations (9.5.5)."""

from __future__ import annotations

import copy
from collections.abc import Iterator

from lxml import etree

from ucm_cts.harness.toolchains.corpus import declarations as decl
from ucm_cts.harness.toolchains.operators.operator import breaks, keeps

IMPLEMENTATIONS = ("AtomicComponentImplementation", "CompositeComponentImplementation")


@keeps("R-9.5.5.3-02", at="Part")
def part_once_more(part: etree._Element) -> bool:
    """A composite may have two parts of one component."""
    composite = part.getparent()
    if composite is None:
        return False
    _part(composite, str(part.get("instanceOf")))
    return True


@breaks("R-9.5.5.3-04", at="CompositeComponentImplementation")
def part_of_a_part(composite: etree._Element) -> None:
    """The composite has a part that has the composite as a part."""
    other = etree.Element("CompositeComponentImplementation", name="other_composite", type=str(composite.get("type")))
    composite.addnext(other)
    _part(other, decl.path(composite))
    _part(composite, decl.path(other))


@breaks("R-9.5.5.4-04", at="Connection")
def end_with_an_api_of_its_own(connection: etree._Element) -> bool:
    """The connector has no port with the port type of one of the ends."""
    connector = decl.resolved(connection, str(connection.get("definition")), "ConnectorDefinition")
    if connector is None:
        return False
    port_type = _stray_port_type(connector)
    if port_type is None:
        return False
    _stray_end(connection, etree.Element("PortTypeSpec", type=decl.path(port_type)))
    return True


def _stray_port_type(beside: etree._Element) -> etree._Element | None:
    """A new port type with an element that no other has, so that it differs by its name and by what it holds."""
    interface = decl.spare_interface(beside)
    if not interface:
        return None
    port_type = etree.Element("PortType", name="stray_port_type")
    etree.SubElement(port_type, "PortElement", name="stray_element", interface=interface, kind="PROVIDED")
    beside.addnext(port_type)
    return port_type


@breaks("R-9.5.5.4-05", at="Connection")
def end_with_a_role_of_its_own(connection: etree._Element) -> bool:
    """The pattern does not have the role of one of the ends."""
    pattern = decl.resolved(connection, str(connection.get("definition")), "InteractionPattern")
    if pattern is None:
        return False
    stray = etree.Element("InteractionPattern", name="stray_pattern")
    etree.SubElement(stray, "InteractionRole", name="stray_role", lowerMultiplicity="0", upperMultiplicity="-1")
    pattern.addnext(stray)
    _stray_end(connection, etree.Element("PortRoleSpec", role=f"{decl.path(stray)}.stray_role"))
    return True


def _stray_end(connection: etree._Element, spec: etree._Element) -> None:
    """Give ``connection`` an end at a new part with one port of specification ``spec``."""
    composite = connection.getparent()
    assert composite is not None
    component = etree.Element("ComponentType", name="stray_type")
    etree.SubElement(component, "Port", name="stray_port").append(spec)
    composite.addnext(component)
    part = _part(composite, decl.path(component))
    etree.SubElement(connection, "ConnectionEnd", name="stray_end", part=part, port="stray_port")


@breaks("R-9.5.5.4-06", at="Connection")
def one_more_than_a_role_allows(connection: etree._Element) -> bool:
    """Two ends play a role that allows one."""
    for end in connection.findall("ConnectionEnd"):
        role, composite = _role_of(end), connection.getparent()
        if role is None or composite is None:
            continue
        role.set("lowerMultiplicity", "0")
        role.set("upperMultiplicity", "1")
        again = copy.deepcopy(end)
        again.set("name", "surplus_end")
        again.set("part", _part(composite, str(_part_of(end).get("instanceOf"))))
        connection.append(again)
        return True
    return False


@breaks("R-9.5.5.4-07", at="Connection", under=("role-minimum=check",))
def fewer_than_a_role_wants(connection: etree._Element) -> bool:
    """No end plays a role that wants one."""
    ends = connection.findall("ConnectionEnd")
    for role in [_role_of(end) for end in ends]:
        if role is not None and int(str(role.get("lowerMultiplicity"))) > 0:
            for end in [end for end in ends if _role_of(end) is role]:
                connection.remove(end)
            return True
    return False


def _role_of(end: etree._Element) -> etree._Element | None:
    """The role that an end plays, where its connector has one port for it or its pattern has the role itself."""
    connection, spec = end.getparent(), _spec_of(end)
    if connection is None or spec is None:
        return None
    reference = str(connection.get("definition"))
    connector = decl.resolved(connection, reference, "ConnectorDefinition")
    if connector is None:
        return _member_role(spec, "role") if spec.tag == "PortRoleSpec" else None
    port_type = decl.resolved(spec, str(spec.get("type")), "PortType")
    ports = [
        p for p in connector.findall("ConnectorPort") if decl.resolved(p, str(p.get("api")), "PortType") is port_type
    ]
    return _member_role(ports[0], "portRole") if len(ports) == 1 else None


def _member_role(element: etree._Element, attribute: str) -> etree._Element | None:
    return decl.member(element, str(element.get(attribute)), "InteractionPattern", "InteractionRole")


@breaks("R-9.5.5.4-08", at="Connection", under=("connected-types=check",))
def ends_that_bind_differently(connection: etree._Element) -> bool:
    """Two ends bind one abstract type or item to different types."""
    specs = [spec for end in connection.findall("ConnectionEnd") if (spec := _spec_of(end)) is not None]
    return _bound_differently(specs)


def _bound_differently(specs: list[etree._Element]) -> bool:
    """Let the second of two specifications that bind the same bind it to something else."""
    for binding, other in _shared(specs):
        new = decl.spare_like(other, str(binding.get("actualType")))
        other.set("actualType", new)
        return bool(new)
    return False


def _shared(specs: list[etree._Element]) -> Iterator[tuple[etree._Element, etree._Element]]:
    for spec in specs:
        for other in specs:
            for binding in spec if spec is not other else ():
                for same in other:
                    keys = ("abstractType", "item", "actualType")
                    if [binding.get(k) for k in keys] == [same.get(k) for k in keys] and same.get("actualType"):
                        yield binding, same


@breaks("R-9.5.5.6-04", at="PortDelegation")
def delegation_to_another_api(delegation: etree._Element) -> bool:
    """The inner port has a port type of its own."""
    end, composite = delegation.find("ConnectionEnd"), delegation.getparent()
    spec = _spec_of(end) if end is not None else None
    port_type = decl.resolved(spec, str(spec.get("type")), "PortType") if spec is not None else None
    other = _stray_port_type(port_type) if port_type is not None else None
    if end is None or composite is None or other is None:
        return False
    component = etree.Element("ComponentType", name="stray_type")
    port = etree.SubElement(component, "Port", name="stray_port")
    composite.addnext(component)
    etree.SubElement(port, "PortTypeSpec", type=decl.path(other))
    end.set("part", _part(composite, decl.path(component)))
    end.set("port", "stray_port")
    return True


@breaks("R-9.5.5.6-05", at="PortDelegation", under=("delegation-bindings=same",))
def delegation_to_other_bindings(delegation: etree._Element) -> bool:
    """The inner port binds something else."""
    end, composite = delegation.find("ConnectionEnd"), delegation.getparent()
    inner = _spec_of(end) if end is not None else None
    own = decl.resolved(composite, str(composite.get("type")), "ComponentType") if composite is not None else None
    outer = _spec_in(own, str(delegation.get("port"))) if own is not None else None
    return inner is not None and outer is not None and _bound_differently([outer, inner])


@breaks("R-9.5.5.6-07", at="PortDelegation", under=("double-delegation=refused",))
def delegated_twice(delegation: etree._Element) -> bool:
    """An external port is delegated to two parts."""
    end, composite = delegation.find("ConnectionEnd"), delegation.getparent()
    if end is None or composite is None:
        return False
    again = copy.deepcopy(delegation)
    again.set("name", "second_delegation")
    again[0].set("part", _part(composite, str(_part_of(end).get("instanceOf"))))
    delegation.addnext(again)
    return True


def _part(composite: etree._Element, component: str) -> str:
    """The name of a new part of ``composite``."""
    part = etree.Element("Part", name="spare_part", instanceOf=component)
    last = composite.findall("Part")[-1:]
    if last:
        last[0].addnext(part)
    else:
        composite.append(part)
    return "spare_part"


def _part_of(end: etree._Element) -> etree._Element:
    composite = next(end.iterancestors("CompositeComponentImplementation"))
    part = composite.find(f"Part[@name='{end.get('part')}']")
    assert part is not None
    return part


def _spec_of(end: etree._Element) -> etree._Element | None:
    """The specification of the port of an end, if the part's component type has it itself."""
    part = _part_of(end)
    component = decl.resolved(part, str(part.get("instanceOf")), *IMPLEMENTATIONS, "ComponentType")
    if component is not None and component.tag in IMPLEMENTATIONS:
        component = decl.resolved(component, str(component.get("type")), "ComponentType")
    return _spec_in(component, str(end.get("port"))) if component is not None else None


def _spec_in(component: etree._Element, port_name: str) -> etree._Element | None:
    port = component.find(f"Port[@name='{port_name}']")
    return next((s for s in port if s.tag in ("PortTypeSpec", "PortRoleSpec")), None) if port is not None else None
