"""Rules of 9.3.4, and of 9.3.3 as far as connectors keep them: patterns, ports and item bindings of connector definitions."""

from __future__ import annotations

from collections.abc import Iterator

from ucm_cts.adapters.contract.metamodel import contracts as c
from ucm_cts.adapters.contract.metamodel import interactions as mi
from ucm_cts.adapters.contract.metamodel.names import Declared, Scope, lineage, member_of
from ucm_cts.adapters.reference.toolchain.checking import Complaint, rule
from ucm_cts.adapters.reference.toolchain.rules.handling import handles


@rule("R-9.3.4-01", mi.ConnectorDefinition)
def refines_a_pattern(connector: mi.ConnectorDefinition, scope: Scope) -> Iterator[Complaint]:
    """What a connector is for is a pattern that is there."""
    if _pattern(connector, scope) is None:
        yield connector, f"connector {connector.name} is for '{connector.pattern}', which is no pattern; declare it"


@rule("R-9.3.4-03", mi.ConnectorDefinition)
def ports_play_roles_of_the_pattern(connector: mi.ConnectorDefinition, scope: Scope) -> Iterator[Complaint]:
    """The role of a port is one of the connector's own pattern or of that one's ancestors."""
    own = _held(connector, scope, "roles")
    for port in connector.ports:
        role = scope.member(port.port_role, mi.InteractionPattern, "roles")
        if role is None:
            yield port, f"port {port.name} plays '{port.port_role}', which is no role; say pattern.role"
        elif own is not None and id(role.element) not in own:
            yield (
                port,
                f"port {port.name} plays {port.port_role}, which is no role of {connector.pattern}; choose one of those",
            )


@rule("R-9.3.4.4-01", mi.ConnectorPort)
def apis_are_port_types(port: mi.ConnectorPort, scope: Scope) -> Iterator[Complaint]:
    """The API of a connector port is a port type that is there."""
    if port.api and scope.find(port.api, mi.PortType) is None:
        yield port, f"port {port.name} has the API '{port.api}', which is no port type; declare it"


@rule("R-9.3.4.4-02", mi.ConnectorPort, under="connector-port-api=required")
def ports_have_apis(port: mi.ConnectorPort, _scope: Scope) -> Iterator[Complaint]:
    """Connectors exist to give roles an API."""
    if not port.api:
        yield port, f"port {port.name} has no API; name a port type"


@rule("R-9.3.4.6-02", mi.ConnectorDefinition)
def bindings_are_of_items_of_the_pattern(connector: mi.ConnectorDefinition, scope: Scope) -> Iterator[Complaint]:
    """The item of a binding is one of the connector's own pattern or of that one's ancestors."""
    own = _held(connector, scope, "items")
    for binding in connector.item_bindings:
        item = _item(binding, scope)
        if item is None:
            yield binding, f"'{binding.interaction_item}' is no item; say pattern.item"
        elif own is not None and id(item) not in own:
            yield binding, f"{binding.interaction_item} is no item of {connector.pattern}; choose one of those"


@rule("R-9.3.4.6-03", mi.ItemBinding)
def items_are_bound_to_types(binding: mi.ItemBinding, scope: Scope) -> Iterator[Complaint]:
    """What stands for an item is a type; constants and exceptions are another rule's."""
    if _bound(binding, scope) is None and scope.find(binding.connector_item, c.Constant, c.Exception_) is None:
        yield (
            binding,
            f"{binding.interaction_item} is bound to '{binding.connector_item}', which is no data type or interface; declare it",
        )


@rule("R-9.3.3.3-05", mi.ItemBinding)
def bound_types_have_the_nature_of_the_item(binding: mi.ItemBinding, scope: Scope) -> Iterator[Complaint]:
    """A data type stands for data, an interface for an interface."""
    item, bound = _item(binding, scope), _bound(binding, scope)
    if item is None or bound is None:
        return
    nature = "INTERFACE" if isinstance(bound.element, c.Interface | c.AbstractInterface) else "DATA"
    if item.nature in ("DATA", "INTERFACE") and item.nature != nature:
        yield (
            binding,
            f"{binding.connector_item} is of nature {nature}, item {item.name} of nature {item.nature}; bind another type",
        )


@rule("R-9.3.3.4-08", mi.ConnectorDefinition, under="repeated-item-bindings=refused")
def items_are_bound_to_one_type(connector: mi.ConnectorDefinition, scope: Scope) -> Iterator[Complaint]:
    """One type stands for an item."""
    seen: dict[int, Declared] = {}
    for binding in connector.item_bindings:
        item, bound = _item(binding, scope), _bound(binding, scope)
        if item is not None and bound is not None and seen.setdefault(id(item), bound).element is not bound.element:
            yield binding, f"item {item.name} is bound to {seen[id(item)].path} already; take one binding out"


@rule("R-9.3.4.6-04", mi.ConnectorDefinition, under="unbound-items=required")
def items_of_roles_are_bound(connector: mi.ConnectorDefinition, scope: Scope) -> Iterator[Complaint]:
    """A connector says what stands for each item that its roles involve."""
    pattern = _pattern(connector, scope)
    bound = {id(_item(binding, scope)) for binding in connector.item_bindings}
    for ancestor in lineage(pattern) if pattern is not None else ():
        assert isinstance(ancestor.element, mi.InteractionPattern)
        for role in ancestor.element.roles:
            for involved in role.involved_items:
                item = member_of(ancestor, "items", involved.item)
                if item is not None and id(item.element) not in bound:
                    yield (
                        connector,
                        f"connector {connector.name} does not bind item {involved.item}; add an ItemBinding",
                    )


@rule("R-9.3.3.4-07", mi.ConnectorDefinition)
def ports_of_an_item_handle_its_type(connector: mi.ConnectorDefinition, scope: Scope) -> Iterator[Complaint]:
    """If the ports of one role handle the type of an item, those of the other roles that involve it do, too."""
    for binding in connector.item_bindings:
        item, bound = _item(binding, scope), _bound(binding, scope)
        if item is None or bound is None:
            continue
        groups = _ports_that_involve(item, connector, scope)
        handling = [any(handles(api, bound) for _, api in group) for group in groups]
        for group, handled in zip(groups, handling, strict=True):
            if not handled and any(handling):
                port = group[0][0]
                yield (
                    port,
                    f"port {port.name} does not handle {bound.element.name}, as the other ports of item {item.name} do; "
                    "give it another port type",
                )


Ports = list[tuple[mi.ConnectorPort, Declared]]


def _ports_that_involve(item: mi.InteractionItem, connector: mi.ConnectorDefinition, scope: Scope) -> list[Ports]:
    """The connector's ports with their port types, a list for each role that involves ``item``."""
    groups: dict[int, Ports] = {}
    for port in connector.ports:
        role = scope.member(port.port_role, mi.InteractionPattern, "roles")
        api = scope.find(port.api, mi.PortType) if port.api else None
        if role is None or api is None:
            continue
        names = {involved.item for involved in getattr(role.element, "involved_items", ())}
        if item.name in names:
            groups.setdefault(id(role.element), []).append((port, api))
    return list(groups.values())


def _pattern(connector: mi.ConnectorDefinition, scope: Scope) -> Declared | None:
    return scope.find(connector.pattern, mi.InteractionPattern)


def _held(connector: mi.ConnectorDefinition, scope: Scope, field: str) -> set[int] | None:
    """The identities of what the connector's pattern and its ancestors have in ``field``; None if there is no pattern."""
    pattern = _pattern(connector, scope)
    if pattern is None:
        return None
    return {id(one) for ancestor in lineage(pattern) for one in getattr(ancestor.element, field)}


def _item(binding: mi.ItemBinding, scope: Scope) -> mi.InteractionItem | None:
    found = scope.member(binding.interaction_item, mi.InteractionPattern, "items")
    return found.element if found is not None and isinstance(found.element, mi.InteractionItem) else None


def _bound(binding: mi.ItemBinding, scope: Scope) -> Declared | None:
    return scope.find(binding.connector_item, c.DataType, c.AbstractDataType, c.Interface, c.AbstractInterface)
