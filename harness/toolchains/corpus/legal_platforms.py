"""Legal interaction and aspect modules by hypothesis, and what components need to know of them."""

from __future__ import annotations

from dataclasses import dataclass, field

from hypothesis import strategies as st

from ucm_cts.adapters.contract.metamodel import aspects as a
from ucm_cts.adapters.contract.metamodel import contracts as c
from ucm_cts.adapters.contract.metamodel import interactions as i
from ucm_cts.harness.toolchains.corpus.legal_contracts import Drawing, Path

LANGUAGES = ("C++11", "C", "Ada_2012")


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


def interaction_module(drawing: Drawing, here: Path) -> tuple[i.InteractionModule, Interaction]:
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


def aspect_module(drawing: Drawing, here: Path) -> tuple[a.NonfunctionalAspectModule, list[Policy]]:
    """Technical aspects with policy definitions for components, ports and both."""
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
    languages = a.ProgrammingLanguages(languages=tuple(a.Language(name=name) for name in LANGUAGES))
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
