"""Interaction patterns, connector definitions and port types (9.3)."""

from __future__ import annotations

from ucm_cts.adapters.contract.metamodel.common import Element, Named
from ucm_cts.adapters.contract.metamodel.contracts import ConfigurationParameter, ContractModule


class InteractionItem(Named, frozen=True, kw_only=True):
    """What an interaction carries; ``nature`` is DATA or INTERFACE (9.3.3.3)."""

    nature: str = ""


class InvolvedItem(Element, frozen=True, kw_only=True):
    """An item of the pattern that a role handles (9.3.3.4)."""

    item: str = ""


class InteractionRole(Named, frozen=True, kw_only=True):
    """How many may play it; an ``upper_multiplicity`` of -1 is no limit, None means that the model gives none (9.3.3.4)."""

    lower_multiplicity: int | None = None
    upper_multiplicity: int | None = None
    involved_items: tuple[InvolvedItem, ...] = ()


class InteractionPattern(Named, frozen=True, kw_only=True):
    """Roles and items, and those of the pattern that it extends (9.3.3.2)."""

    extends: str = ""
    roles: tuple[InteractionRole, ...] = ()
    items: tuple[InteractionItem, ...] = ()


class ConnectorPort(Named, frozen=True, kw_only=True):
    """A role with an API: ``port_role`` is ``pattern.role``, ``api`` a port type, empty if none is given (9.3.4.6)."""

    port_role: str = ""
    api: str = ""


class ItemBinding(Element, frozen=True, kw_only=True):
    """Which type of the API stands for an item: ``interaction_item`` is ``pattern.item`` (9.3.4.6)."""

    interaction_item: str = ""
    connector_item: str = ""


class ConnectorDefinition(Named, frozen=True, kw_only=True):
    """A pattern with APIs and parameters (9.3.4)."""

    pattern: str = ""
    ports: tuple[ConnectorPort, ...] = ()
    item_bindings: tuple[ItemBinding, ...] = ()
    configuration_parameters: tuple[ConfigurationParameter, ...] = ()


class PortElement(Named, frozen=True, kw_only=True):
    """``kind`` is PROVIDED or REQUIRED, as the component sees it (9.3.5.2)."""

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
