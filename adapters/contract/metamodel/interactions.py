"""Interaction patterns, connector definitions and port types (9.3)."""

from __future__ import annotations

from ucm_cts.adapters.contract.metamodel.common import Element, Named
from ucm_cts.adapters.contract.metamodel.contracts import ConfigurationParameter, ContractModule


class InteractionItem(Named, frozen=True, kw_only=True):
    """What an interaction carries (9.3.3.3).

    ``nature``: DATA or INTERFACE.
    """

    nature: str = ""


class InvolvedItem(Element, frozen=True, kw_only=True):
    """An item of the pattern that a role handles (9.3.3.4)."""

    item: str = ""


class InteractionRole(Named, frozen=True, kw_only=True):
    """A role of a pattern (9.3.3.4).

    ``lower_multiplicity``: the least number of ports that play it; None if the model gives none.
    ``upper_multiplicity``: the greatest number; -1 is no limit, None if the model gives none.
    ``involved_items``: the items that it handles.
    """

    lower_multiplicity: int | None = None
    upper_multiplicity: int | None = None
    involved_items: tuple[InvolvedItem, ...] = ()


class InteractionPattern(Named, frozen=True, kw_only=True):
    """An interaction pattern (9.3.3.2).

    ``extends``: reference to its parent, whose roles and items it inherits; empty if there is none.
    ``roles``: its own roles.
    ``items``: its own items.
    """

    extends: str = ""
    roles: tuple[InteractionRole, ...] = ()
    items: tuple[InteractionItem, ...] = ()


class ConnectorPort(Named, frozen=True, kw_only=True):
    """A role with an API (9.3.4.6).

    ``port_role``: reference to the role, as ``pattern.role``.
    ``api``: reference to a port type, empty if none is given.
    """

    port_role: str = ""
    api: str = ""


class ItemBinding(Element, frozen=True, kw_only=True):
    """The type that stands for an item (9.3.4.6).

    ``interaction_item``: reference to the item, as ``pattern.item``.
    ``connector_item``: reference to the type.
    """

    interaction_item: str = ""
    connector_item: str = ""


class ConnectorDefinition(Named, frozen=True, kw_only=True):
    """A pattern with APIs and parameters (9.3.4)."""

    pattern: str = ""
    ports: tuple[ConnectorPort, ...] = ()
    item_bindings: tuple[ItemBinding, ...] = ()
    configuration_parameters: tuple[ConfigurationParameter, ...] = ()


class PortElement(Named, frozen=True, kw_only=True):
    """An interface of a port (9.3.5.2).

    ``interface``: reference to the interface.
    ``kind``: PROVIDED or REQUIRED, as the component sees it.
    """

    interface: str = ""
    kind: str = ""


class PortType(Named, frozen=True, kw_only=True):
    """The port elements of a port (9.3.5.1)."""

    port_elements: tuple[PortElement, ...] = ()


class InteractionModule(Named, frozen=True, kw_only=True):
    """Declarations of interactions, the text's InteractionDefinitionModule (9.3.2.1)."""

    interaction_modules: tuple[InteractionModule, ...] = ()
    contract_modules: tuple[ContractModule, ...] = ()
    patterns: tuple[InteractionPattern, ...] = ()
    connectors: tuple[ConnectorDefinition, ...] = ()
    port_types: tuple[PortType, ...] = ()
