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
    """The type that stands for an abstract one (9.5.3.7).

    ``abstract_type``: reference to the abstract type.
    ``actual_type``: reference to the actual type.
    """

    abstract_type: str = ""
    actual_type: str = ""


class PortTypeSpec(Element, frozen=True, kw_only=True):
    """The specification of a port with an API (9.5.3.6).

    ``type``: reference to a port type.
    ``bindings``: the actual types of its abstract types.
    """

    type: str = ""
    bindings: tuple[AbstractTypeBinding, ...] = ()


class InteractionItemBinding(Element, frozen=True, kw_only=True):
    """The type that stands for an item of a pattern (9.5.3.5).

    ``item``: reference to the item, as ``pattern.item``.
    ``actual_type``: reference to the actual type.
    """

    item: str = ""
    actual_type: str = ""


class PortRoleSpec(Element, frozen=True, kw_only=True):
    """The specification of a port without an API (9.5.3.4).

    ``role``: reference to the role, as ``pattern.role``.
    ``bindings``: the types of the role's items.
    """

    role: str = ""
    bindings: tuple[InteractionItemBinding, ...] = ()


class Port(Annotable, frozen=True, kw_only=True):
    """A port of a component type (9.5.3.2).

    ``refines_port``: reference to the port that it refines, as ``type.port``; empty if there is none.
    ``specs``: its specification; exactly one in a legal model.
    """

    refines_port: str = ""
    specs: tuple[PortTypeSpec | PortRoleSpec, ...] = ()


class ComponentType(Annotable, frozen=True, kw_only=True):
    """A component type (9.5.3.1).

    ``refines``: reference to its parent, whose ports and attributes it inherits; empty if there is none.
    ``ports``: its own ports.
    ``attributes``: its own attributes.
    """

    refines: str = ""
    ports: tuple[Port, ...] = ()
    attributes: tuple[Attribute, ...] = ()


class TechnicalPolicy(Element, frozen=True, kw_only=True):
    """In an implementation: a component technical policy by its name (9.5.4.1)."""

    name: str = ""


class AtomicComponentImplementation(Annotable, frozen=True, kw_only=True):
    """A component that is code (9.5.4.1).

    ``type``: reference to its component type.
    ``language``: the name of its programming language.
    ``policies``: the policies that it names.
    """

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
    """The use of a policy definition by implementations (9.5.4.2).

    ``technical_policy_definition``: reference to the definition.
    ``managed_components``: the implementations that it applies to.
    ``bindings``: the actual types of the definition's abstract types.
    ``configuration_values``: the values of the definition's parameters.
    """

    technical_policy_definition: str = ""
    managed_components: tuple[ManagedComponent, ...] = ()
    bindings: tuple[AbstractTypeBinding, ...] = ()
    configuration_values: tuple[ConfigurationParameterValue, ...] = ()


class ComponentPortTechnicalPolicy(ComponentTechnicalPolicy, frozen=True, kw_only=True):
    """The use of a policy definition on ports (9.5.4.3)."""

    managed_ports: tuple[ManagedPort, ...] = ()


class AssemblyPart(Named, frozen=True, kw_only=True):
    """A component in a composite (9.5.5.3).

    ``instance_of``: reference to a component type or an implementation.
    """

    instance_of: str = ""


class ConnectionEnd(Named, frozen=True, kw_only=True):
    """One end of a connection or a delegation (9.5.5.5).

    ``part``: the name of a part of the composite.
    ``port``: the name of a port of that part.
    """

    part: str = ""
    port: str = ""


class Connection(Named, frozen=True, kw_only=True):
    """Parts that are joined (9.5.5.4).

    ``definition``: reference to a connector or a pattern.
    ``ends``: the joined ports.
    """

    definition: str = ""
    ends: tuple[ConnectionEnd, ...] = ()


class PortDelegation(Named, frozen=True, kw_only=True):
    """A port of a composite for which a part's port stands, in either printed encoding (9.5.5.6).

    ``port``: the name of the composite's port.
    ``internal_part``: the name of the part, empty if ``ends`` gives it.
    ``internal_port``: the name of the part's port, empty if ``ends`` gives it.
    ``ends``: the part's port; one end in a legal model.
    """

    port: str = ""
    internal_part: str = ""
    internal_port: str = ""
    ends: tuple[ConnectionEnd, ...] = ()


class CompositeComponentImplementation(Annotable, frozen=True, kw_only=True):
    """A component made of parts (9.5.5.2).

    ``type``: reference to its component type.
    ``parts``: its components.
    ``connections``: the connections between its parts.
    ``delegations``: which ports of parts stand for its own ports.
    """

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
