"""Whole models that keep all rules of clause 9 by construction, by hypothesis: contracts, a platform, and components that use it."""

from __future__ import annotations

from dataclasses import dataclass, field

from hypothesis import strategies as st

from ucm_cts.adapters.contract.metamodel import aspects as a
from ucm_cts.adapters.contract.metamodel import components as m
from ucm_cts.adapters.contract.metamodel import contracts as c
from ucm_cts.adapters.contract.metamodel import interactions as i
from ucm_cts.adapters.contract.metamodel.modules import ApplicationModule, Model, Module, PlatformModule
from ucm_cts.harness.toolchains.corpus.legal_contracts import SOME, Drawing, Known, Path

_LANGUAGES = ("C++11", "C", "Ada_2012")


@dataclass
class Interaction:
    """A pattern with two roles, a connector, and for each role a port type; the same types stand for its abstract ones
    wherever it is used, so that all its ports fit.
    """

    pattern: Path
    connector: Path
    roles: tuple[str, str]
    items: tuple[i.InteractionItem, ...]
    apis: tuple[Path, Path]
    abstract: dict[Path, Path] = field(default_factory=dict)
    actual: dict[str, Path] = field(default_factory=dict)


@dataclass
class Policy:
    """A policy definition, the parameters that it has and inherits, and the abstract types that its interfaces use."""

    definition: Path
    applicability: str
    parameters: list[tuple[Path, c.ConfigurationParameter]]
    abstract: tuple[Path, ...]


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
    interaction_module, interaction = _interaction_module(drawing, (*inside, drawing.name()))
    aspect_module, policies = _aspect_module(drawing, (*inside, drawing.name()))
    drawing.data_types = platform_data_types
    around = (drawing.name(),) if draw(st.booleans()) else ()
    component_module = _Components(drawing, interaction, policies).module((*around, drawing.name()))
    platform: tuple[Module, ...] = (interaction_module, aspect_module)
    if inside:
        platform = (PlatformModule(name=inside[0], submodules=(interaction_module, aspect_module)),)
    application: Module = component_module
    if around:
        application = ApplicationModule(name=around[0], submodules=(component_module,))
    return Model(modules=tuple(draw(st.permutations([data, extra, *platform, application]))))


# the platform


def _interaction_module(drawing: Drawing, here: Path) -> tuple[i.InteractionModule, Interaction]:
    """An interaction with data, and perhaps an interface, that goes from one role to another."""
    draw = drawing.draw
    contract = (*here, drawing.name())
    data, service = c.AbstractDataType(name=drawing.name()), c.AbstractInterface(name=drawing.name())
    natures = {"DATA": (*contract, data.name)}
    if draw(st.booleans()):
        natures["INTERFACE"] = (*contract, service.name)
    api = drawing.interface(contract, [], (natures["DATA"],))
    apis = [(*contract, api.name)] + ([natures["INTERFACE"]] if "INTERFACE" in natures else [])
    items = tuple(i.InteractionItem(name=drawing.name(), nature=nature) for nature in natures)
    roles = (drawing.name(), drawing.name())
    involved = tuple(i.InvolvedItem(item=item.name) for item in items)
    base, extended = _patterns(drawing, here, roles, items, involved)
    pattern = extended or base
    used = Interaction((*here, pattern.name), (*here, drawing.name()), roles, items, _port_types_of(drawing, here))
    port_types = [
        i.PortType(
            name=path[-1],
            port_elements=tuple(
                i.PortElement(name=f"element{n}", interface=drawing.refer(target, here), kind=kind)
                for n, target in enumerate(apis)
            ),
        )
        for path, kind in zip(used.apis, ("REQUIRED", "PROVIDED"), strict=True)
    ]
    for item, abstract in zip(items, natures.values(), strict=True):
        known = drawing.one(drawing.data_types if item.nature == "DATA" else drawing.interfaces)
        used.abstract[abstract] = used.actual[item.name] = known.path
    connector = i.ConnectorDefinition(
        name=used.connector[-1],
        pattern=drawing.refer(used.pattern, here),
        ports=tuple(
            i.ConnectorPort(
                name=f"port{n}",
                port_role=f"{drawing.refer(used.pattern, here)}.{role}",
                api=drawing.refer(used.apis[n], here),
            )
            for n, role in enumerate(roles)
        ),
        item_bindings=tuple(
            i.ItemBinding(
                interaction_item=f"{drawing.refer(used.pattern, here)}.{item.name}",
                connector_item=drawing.refer(abstract, here),
            )
            for item, abstract in zip(items, natures.values(), strict=True)
        ),
        configuration_parameters=drawing.parameters(here),
    )
    module = i.InteractionModule(
        name=here[-1],
        contract_modules=(
            c.ContractModule(
                name=contract[-1], data_types=(data,), interfaces=(service, api) if "INTERFACE" in natures else (api,)
            ),
        ),
        patterns=tuple(draw(st.permutations([p for p in (base, extended) if p is not None]))),
        connectors=(drawing.annotated(connector, here),),
        port_types=tuple(draw(st.permutations(port_types))),
    )
    if draw(st.booleans()):
        module = _with_submodule(drawing, module)
    return module, used


def _port_types_of(drawing: Drawing, here: Path) -> tuple[Path, Path]:
    return (*here, drawing.name()), (*here, drawing.name())


def _with_submodule(drawing: Drawing, module: i.InteractionModule) -> i.InteractionModule:
    inner = i.InteractionModule(name=drawing.name(), patterns=(i.InteractionPattern(name=drawing.name()),))
    return i.InteractionModule(
        name=module.name,
        interaction_modules=(inner,),
        contract_modules=module.contract_modules,
        patterns=module.patterns,
        connectors=module.connectors,
        port_types=module.port_types,
    )


def _patterns(
    drawing: Drawing,
    here: Path,
    names: tuple[str, str],
    items: tuple[i.InteractionItem, ...],
    involved: tuple[i.InvolvedItem, ...],
) -> tuple[i.InteractionPattern, i.InteractionPattern | None]:
    """A pattern with both roles, or one with the first and another that adds the second; items are the first one's."""
    roles = [
        i.InteractionRole(name=name, lower_multiplicity=1, upper_multiplicity=upper, involved_items=involved)
        for name, upper in zip(names, (-1, drawing.draw(st.sampled_from([-1, 1, 5]))), strict=True)
    ]
    if drawing.draw(st.booleans()):
        return i.InteractionPattern(name=drawing.name(), roles=tuple(roles), items=items), None
    base = i.InteractionPattern(name=drawing.name(), roles=(roles[0],), items=items)
    extends = drawing.refer((*here, base.name), here)
    return base, i.InteractionPattern(name=drawing.name(), extends=extends, roles=(roles[1],))


def _aspect_module(drawing: Drawing, here: Path) -> tuple[a.NonfunctionalAspectModule, list[Policy]]:
    draw = drawing.draw
    one = a.TechnicalAspect(
        name=drawing.name(), multiplicity=draw(st.sampled_from(["exactlyOne", "atLeastOne", "atMostOne", "anyNumber"]))
    )
    free = a.TechnicalAspect(name=drawing.name(), multiplicity="anyNumber")
    contract = (*here, drawing.name())
    abstract = c.AbstractDataType(name=drawing.name())
    plain = drawing.interface(contract, [])
    typed = drawing.interface(contract, [], ((*contract, abstract.name),))
    definitions: list[a.TechnicalPolicyDefinition] = []
    policies: list[Policy] = []
    for aspect, applicability, uses in ((one, "onComponent", typed), (free, "onPort", plain), (free, "onBoth", plain)):
        element = i.PortElement(
            name=drawing.name(),
            interface=drawing.refer((*contract, uses.name), here),
            kind=draw(st.sampled_from(["PROVIDED", "REQUIRED"])),
        )
        definition = a.TechnicalPolicyDefinition(
            name=drawing.name(),
            technical_aspect=drawing.refer((*here, aspect.name), here),
            applicability=applicability,
            port_elements=(element,),
            configuration_parameters=drawing.parameters(here),
        )
        path = (*here, definition.name)
        parameters = [(path, parameter) for parameter in definition.configuration_parameters]
        bound = ((*contract, abstract.name),) if uses is typed else ()
        definitions.append(drawing.annotated(definition, here))
        if draw(st.booleans()):
            definition = a.TechnicalPolicyDefinition(
                name=drawing.name(),
                technical_aspect=drawing.refer((*here, aspect.name), here),
                applicability=applicability,
                extends=drawing.refer(path, here),
                configuration_parameters=drawing.parameters(here),
            )
            path = (*here, definition.name)
            parameters += [(path, parameter) for parameter in definition.configuration_parameters]
            definitions.append(definition)
        policies.append(Policy(path, applicability, parameters, bound))
    languages = a.ProgrammingLanguages(languages=tuple(a.Language(name=name) for name in _LANGUAGES))
    inner = a.NonfunctionalAspectModule(
        name=drawing.name(), technical_aspects=(a.TechnicalAspect(name=drawing.name(), multiplicity="atMostOne"),)
    )
    module = a.NonfunctionalAspectModule(
        name=here[-1],
        nonfunctional_aspect_modules=(inner,) if draw(st.booleans()) else (),
        contract_modules=(c.ContractModule(name=contract[-1], data_types=(abstract,), interfaces=(plain, typed)),),
        technical_aspects=(one, free),
        policy_definitions=tuple(draw(st.permutations(definitions))),
        supported_languages=(languages,),
    )
    return module, policies


# components


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
            language=self.draw(st.sampled_from(_LANGUAGES)),
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
