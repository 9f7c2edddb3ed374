"""Component types, implementations, policies and composites (9.5)."""

from __future__ import annotations

from ucm_cts.adapters.contract.metamodel.common import Element, Named
from ucm_cts.adapters.contract.metamodel.contracts import (
    Annotable,
    Attribute,
    ConfigurationParameterValue,
    ContractModule,
)


class AbstractTypeBinding(Element, frozen=True, kw_only=True):
    """The actual type that stands for an abstract one (9.5.3.7)."""

    abstract_type: str = ""
    actual_type: str = ""


class PortTypeSpec(Element, frozen=True, kw_only=True):
    """A port with an API: ``type`` is a port type (9.5.3.6)."""

    type: str = ""
    bindings: tuple[AbstractTypeBinding, ...] = ()


class InteractionItemBinding(Element, frozen=True, kw_only=True):
    """The actual type that stands for an item of a pattern (9.5.3.5)."""

    item: str = ""
    actual_type: str = ""


class PortRoleSpec(Element, frozen=True, kw_only=True):
    """A port without an API: ``role`` is ``pattern.role`` (9.5.3.4)."""

    role: str = ""
    bindings: tuple[InteractionItemBinding, ...] = ()


class Port(Annotable, frozen=True, kw_only=True):
    """Exactly one of ``specs``; ``refines_port`` is ``type.port``, empty if it refines none (9.5.3.2)."""

    refines_port: str = ""
    specs: tuple[PortTypeSpec | PortRoleSpec, ...] = ()


class ComponentType(Annotable, frozen=True, kw_only=True):
    """Ports and attributes, and those of the type that it refines (9.5.3.1)."""

    refines: str = ""
    ports: tuple[Port, ...] = ()
    attributes: tuple[Attribute, ...] = ()


class TechnicalPolicy(Element, frozen=True, kw_only=True):
    """In an implementation: a component technical policy by its name (9.5.4.1)."""

    name: str = ""


class AtomicComponentImplementation(Annotable, frozen=True, kw_only=True):
    """Code in a ``language`` for a component ``type`` (9.5.4.1)."""

    type: str = ""
    language: str = ""
    policies: tuple[TechnicalPolicy, ...] = ()


class ManagedComponent(Element, frozen=True, kw_only=True):
    """An atomic implementation that a policy applies to (9.5.4.2)."""

    name: str = ""


class ManagedPort(Element, frozen=True, kw_only=True):
    """A port that a policy applies to: ``name`` is ``type.port`` (9.5.4.3)."""

    name: str = ""


class ComponentTechnicalPolicy(Named, frozen=True, kw_only=True):
    """The use of a policy definition by implementations (9.5.4.2)."""

    technical_policy_definition: str = ""
    managed_components: tuple[ManagedComponent, ...] = ()
    bindings: tuple[AbstractTypeBinding, ...] = ()
    configuration_values: tuple[ConfigurationParameterValue, ...] = ()


class ComponentPortTechnicalPolicy(ComponentTechnicalPolicy, frozen=True, kw_only=True):
    """The use of a policy definition on ports (9.5.4.3)."""

    managed_ports: tuple[ManagedPort, ...] = ()


class AssemblyPart(Named, frozen=True, kw_only=True):
    """A component in a composite: ``instance_of`` is a type or an implementation (9.5.5.3)."""

    instance_of: str = ""


class ConnectionEnd(Named, frozen=True, kw_only=True):
    """A ``port`` of a ``part`` (9.5.5.5)."""

    part: str = ""
    port: str = ""


class Connection(Named, frozen=True, kw_only=True):
    """Parts joined by a connector or by a pattern (9.5.5.4)."""

    definition: str = ""
    ends: tuple[ConnectionEnd, ...] = ()


class PortDelegation(Named, frozen=True, kw_only=True):
    """A ``port`` of the composite that a part's port stands for, in either printed encoding: one of ``ends``, or
    ``internal_part`` and ``internal_port`` (9.5.5.6).
    """

    port: str = ""
    internal_part: str = ""
    internal_port: str = ""
    ends: tuple[ConnectionEnd, ...] = ()


class CompositeComponentImplementation(Annotable, frozen=True, kw_only=True):
    """Parts, their connections, and which of their ports stand for the composite's own (9.5.5.2)."""

    type: str = ""
    parts: tuple[AssemblyPart, ...] = ()
    connections: tuple[Connection, ...] = ()
    delegations: tuple[PortDelegation, ...] = ()


class ComponentModule(Named, frozen=True, kw_only=True):
    """Declarations of components (9.5.2.1)."""

    component_modules: tuple[ComponentModule, ...] = ()
    contract_modules: tuple[ContractModule, ...] = ()
    component_types: tuple[ComponentType, ...] = ()
    implementations: tuple[AtomicComponentImplementation | CompositeComponentImplementation, ...] = ()
    technical_policies: tuple[ComponentTechnicalPolicy, ...] = ()
