"""Edits of interaction modules, patterns, connectors and port types (9.3)."""

from __future__ import annotations

import copy

from lxml import etree

from ucm_cts.harness.toolchains.operators.interfaces import beside, named
from ucm_cts.harness.toolchains.operators.operator import breaks


@breaks("R-9.3.3.2-05", at="InteractionPattern")
def redefined_role(pattern: etree._Element) -> bool:
    """The parent has that role already."""
    return _taken_from_parent(pattern, "InteractionRole")


@breaks("R-9.3.3.2-07", at="InteractionPattern", under=("item-redefinition=refused",))
def redefined_item(pattern: etree._Element) -> bool:
    """The parent has that item already."""
    return _taken_from_parent(pattern, "InteractionItem")


def _taken_from_parent(pattern: etree._Element, tag: str) -> bool:
    parent = named(pattern, "InteractionPattern", str(pattern.get("extends", "")))
    theirs = parent.find(tag) if parent is not None else None
    if theirs is None or parent is pattern:
        return False
    pattern.append(copy.deepcopy(theirs))
    for involved in pattern[-1].findall("InvolvedItem"):
        pattern[-1].remove(involved)
    return True


@breaks("R-9.3.3.3-05", at="ItemBinding")
def other_nature(binding: etree._Element) -> bool:
    """What is bound is of another nature than the item."""
    owner, _, name = str(binding.get("interactionItem")).rpartition(".")
    pattern = named(binding, "InteractionPattern", owner)
    item = pattern.find(f"InteractionItem[@name='{name}']") if pattern is not None else None
    if item is None:
        return False
    item.set("nature", "INTERFACE" if item.get("nature") == "DATA" else "DATA")
    return True


@breaks("R-9.3.3.4-07", at="ConnectorDefinition")
def port_without_the_item(connector: etree._Element) -> bool:
    """The port of one role has nothing in its API that the item stands for, the port of the other role has."""
    ports = connector.findall("ConnectorPort")
    roles = [_role(port) for port in ports]
    involved = [
        {str(i.get("item")) for i in role.findall("InvolvedItem")} if role is not None else set() for role in roles
    ]
    bound = {str(b.get("interactionItem")).rpartition(".")[2] for b in connector.findall("ItemBinding")}
    if len(ports) != 2 or roles[0] is roles[1] or not involved[0] & involved[1] & bound:
        return False
    beside(connector, "PortType", name="port_type_for_nothing")
    ports[1].set("api", "port_type_for_nothing")
    return True


def _role(port: etree._Element) -> etree._Element | None:
    owner, _, name = str(port.get("portRole")).rpartition(".")
    pattern = named(port, "InteractionPattern", owner)
    return pattern.find(f"InteractionRole[@name='{name}']") if pattern is not None else None


@breaks("R-9.3.3.4-08", at="ItemBinding", under=("repeated-item-bindings=refused",))
def bound_to_another_type_too(binding: etree._Element) -> bool:
    """One item stands for two types."""
    module, _, name = str(binding.get("connectorItem")).rpartition("::")
    contracts = named(binding, "ContractModule", module)
    bound = contracts.find(f"*[@name='{name}']") if contracts is not None else None
    if contracts is None or bound is None:
        return False
    interface = bound.tag in ("Interface", "AbstractInterface")
    etree.SubElement(contracts, "AbstractInterface" if interface else "AbstractDataType", name="quite_another")
    again = copy.deepcopy(binding)
    again.set("connectorItem", f"{module}::quite_another")
    binding.addnext(again)
    return True


@breaks("R-9.3.4.6-04", at="ItemBinding", under=("unbound-items=required",))
def unbound(binding: etree._Element) -> bool:
    """A connector that does not bind an item of its roles."""
    owner, _, name = str(binding.get("interactionItem")).rpartition(".")
    pattern, connector = named(binding, "InteractionPattern", owner), binding.getparent()
    if pattern is None or connector is None or pattern.find(f"InteractionRole/InvolvedItem[@item='{name}']") is None:
        return False
    connector.remove(binding)
    return True
