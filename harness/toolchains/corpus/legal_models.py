"""Whole models that keep all rules of clause 9 by construction, by hypothesis: contracts, a platform, and components that use it."""

from __future__ import annotations

from hypothesis import strategies as st

from ucm_cts.adapters.contract.metamodel import components as m
from ucm_cts.adapters.contract.metamodel import contracts as c
from ucm_cts.adapters.contract.metamodel.modules import ApplicationModule, Model, Module, PlatformModule
from ucm_cts.harness.toolchains.corpus.legal_contracts import SOME, Drawing, Known, Path
from ucm_cts.harness.toolchains.corpus.legal_platforms import (
    LANGUAGES,
    Interaction,
    Policy,
    aspect_module,
    interaction_module,
)


@st.composite
def legal_models(draw: st.DrawFn) -> Model:
    """A model that no rule has anything against."""
    drawing = Drawing(draw)
    data = drawing.contract_module((drawing.name(),))
    service = c.Interface(name=drawing.name())
    extra = c.ContractModule(name=drawing.name(), interfaces=(service,))
    drawing.interfaces.append(Known((extra.name, service.name), service))
    platform_data_types = list(drawing.data_types)
    inside = (drawing.name(),) if draw(st.booleans()) else ()
    interactions, interaction = interaction_module(drawing, (*inside, drawing.name()))
    aspects, policies = aspect_module(drawing, (*inside, drawing.name()))
    drawing.data_types = platform_data_types
    around = (drawing.name(),) if draw(st.booleans()) else ()
    component_module = _Components(drawing, interaction, policies).module((*around, drawing.name()))
    platform: tuple[Module, ...] = (interactions, aspects)
    if inside:
        platform = (PlatformModule(name=inside[0], submodules=(interactions, aspects)),)
    application: Module = component_module
    if around:
        application = ApplicationModule(name=around[0], submodules=(component_module,))
    return Model(modules=tuple(draw(st.permutations([data, extra, *platform, application]))))


class _Components:
    """What uses the platform: types with a port for each role, implementations with policies, a composite of all."""

    def __init__(self, drawing: Drawing, interaction: Interaction, policies: list[Policy]) -> None:
        self.drawing = drawing
        self.draw = drawing.draw
        self.interaction = interaction
        self.policies = policies
        self.here: Path = ()

    def module(self, here: Path) -> m.ComponentModule:
        """The component module called like the last of ``here``."""
        self.here = here
        types = [self._type((self._port(role),)) for role in (0, 1)]
        refining = self._refining(types[0])
        outer = self._type((self._port(1),))
        implementations = [self._atomic(one) for one in (*types, refining)]
        managed = tuple(m.ManagedComponent(name=self._refer(one.name)) for one in implementations)
        uses = self._uses(managed, types)
        named = tuple(m.TechnicalPolicy(name=self._refer(use.name)) for use in uses)
        implementations = [self._with(one, named) for one in implementations]
        composite = self._composite(outer, types, implementations)
        contract = c.ContractModule(name=self.drawing.name(), constants=())
        return m.ComponentModule(
            name=here[-1],
            component_modules=(m.ComponentModule(name=self.drawing.name()),) if self.draw(st.booleans()) else (),
            contract_modules=(contract,) if self.draw(st.booleans()) else (),
            component_types=tuple(self.draw(st.permutations([*types, refining, outer]))),
            implementations=(*implementations, composite),
            technical_policies=tuple(uses),
        )

    def _refer(self, *names: str) -> str:
        return self.drawing.refer((*self.here, *names), self.here)

    def _there(self, path: Path) -> str:
        return self.drawing.refer(path, self.here)

    def _port(self, role: int, refines: str = "", by_role: bool = False) -> m.Port:
        used = self.interaction
        spec: m.PortTypeSpec | m.PortRoleSpec = m.PortTypeSpec(
            type=self._there(used.apis[role]),
            bindings=tuple(
                m.AbstractTypeBinding(abstract_type=self._there(abstract), actual_type=self._there(actual))
                for abstract, actual in used.abstract.items()
            ),
        )
        if by_role:
            pattern = self._there(used.pattern)
            spec = m.PortRoleSpec(
                role=f"{pattern}.{used.roles[role]}",
                bindings=tuple(
                    m.InteractionItemBinding(
                        item=f"{pattern}.{item.name}", actual_type=self._there(used.actual[item.name])
                    )
                    for item in used.items
                ),
            )
        port = m.Port(name=self.drawing.name(), refines_port=refines, specs=(spec,))
        return self.drawing.annotated(port, self.here)

    def _type(self, ports: tuple[m.Port, ...], refines: str = "") -> m.ComponentType:
        extra = (self._port(0, by_role=True),) if self.draw(st.booleans()) else ()
        component = m.ComponentType(
            name=self.drawing.name(),
            refines=refines,
            ports=(*ports, *extra),
            attributes=tuple(self.drawing.attribute(self.here) for _ in range(self.draw(SOME))),
        )
        return self.drawing.annotated(component, self.here)

    def _refining(self, refined: m.ComponentType) -> m.ComponentType:
        refines = self._refer(refined.name)
        ports = (self._port(0, f"{refines}.{refined.ports[0].name}"),) if self.draw(st.booleans()) else ()
        return self._type(ports, refines)

    def _atomic(self, component: m.ComponentType) -> m.AtomicComponentImplementation:
        implementation = m.AtomicComponentImplementation(
            name=self.drawing.name(),
            type=self._refer(component.name),
            language=self.draw(st.sampled_from(LANGUAGES)),
        )
        return self.drawing.annotated(implementation, self.here)

    def _with(
        self, implementation: m.AtomicComponentImplementation, policies: tuple[m.TechnicalPolicy, ...]
    ) -> m.AtomicComponentImplementation:
        return m.AtomicComponentImplementation(
            name=implementation.name,
            comments=implementation.comments,
            annotations=implementation.annotations,
            type=implementation.type,
            language=implementation.language,
            policies=policies,
        )

    def _uses(
        self, managed: tuple[m.ManagedComponent, ...], types: list[m.ComponentType]
    ) -> list[m.ComponentTechnicalPolicy]:
        """A policy of each definition for all implementations; those for ports are for the first port of each type."""
        uses: list[m.ComponentTechnicalPolicy] = []
        for policy in self.policies:
            plain = m.ComponentTechnicalPolicy(
                name=self.drawing.name(),
                technical_policy_definition=self._there(policy.definition),
                managed_components=managed,
                bindings=tuple(
                    m.AbstractTypeBinding(
                        abstract_type=self._there(abstract), actual_type=self.drawing.data_type(self.here)
                    )
                    for abstract in policy.abstract
                ),
                configuration_values=tuple(
                    c.ConfigurationParameterValue(
                        configuration_parameter=f"{self._there(owner)}.{parameter.name}",
                        value=self.drawing.value_of(parameter.type, self.here),
                    )
                    for owner, parameter in policy.parameters
                    if self.draw(st.booleans())
                ),
            )
            ports = tuple(m.ManagedPort(name=f"{self._refer(one.name)}.{one.ports[0].name}") for one in types)
            on_ports = policy.applicability == "onPort" or (
                policy.applicability == "onBoth" and self.draw(st.booleans())
            )
            uses.append(self._on_ports(plain, ports) if on_ports else plain)
        return uses

    def _on_ports(
        self, plain: m.ComponentTechnicalPolicy, ports: tuple[m.ManagedPort, ...]
    ) -> m.ComponentPortTechnicalPolicy:
        return m.ComponentPortTechnicalPolicy(
            name=plain.name,
            technical_policy_definition=plain.technical_policy_definition,
            managed_components=plain.managed_components,
            bindings=plain.bindings,
            configuration_values=plain.configuration_values,
            managed_ports=ports,
        )

    def _composite(
        self,
        outer: m.ComponentType,
        types: list[m.ComponentType],
        implementations: list[m.AtomicComponentImplementation],
    ) -> m.CompositeComponentImplementation:
        """Both roles in a connection, and one part more that the composite's own port stands for."""
        instances = [self.draw(st.sampled_from([t.name, n.name])) for t, n in zip(types, implementations, strict=False)]
        parts = [m.AssemblyPart(name=self.drawing.name(), instance_of=self._refer(instance)) for instance in instances]
        inner = m.AssemblyPart(name=self.drawing.name(), instance_of=self._refer(instances[1]))
        definition = self.draw(st.sampled_from([self.interaction.connector, self.interaction.pattern]))
        connection = m.Connection(
            name=self.drawing.name(),
            definition=self._there(definition),
            ends=tuple(
                m.ConnectionEnd(name=self.drawing.name(), part=part.name, port=type_.ports[0].name)
                for part, type_ in zip(parts, types, strict=True)
            ),
        )
        composite = m.CompositeComponentImplementation(
            name=self.drawing.name(),
            type=self._refer(outer.name),
            parts=tuple(self.draw(st.permutations([*parts, inner]))),
            connections=(self.drawing.annotated(connection, self.here),),
            delegations=(self._delegation(outer.ports[0].name, inner.name, types[1].ports[0].name),),
        )
        return self.drawing.annotated(composite, self.here)

    def _delegation(self, port: str, part: str, inner: str) -> m.PortDelegation:
        if self.draw(st.booleans()):
            return m.PortDelegation(name=self.drawing.name(), port=port, internal_part=part, internal_port=inner)
        end = m.ConnectionEnd(name=self.drawing.name(), part=part, port=inner)
        return m.PortDelegation(name=self.drawing.name(), port=port, ends=(end,))
