"""A legal model as large as one likes, of the mix that architectures have: contracts, component types and implementations with
policies, composites with connections, over the core models.
"""

from __future__ import annotations

from collections.abc import Iterator

from ucm_cts.adapters.contract.metamodel import aspects, components, contracts
from ucm_cts.adapters.contract.metamodel.common import walk, without_lines
from ucm_cts.adapters.contract.metamodel.modules import Model, Module
from ucm_cts.adapters.contract.metamodel.reading import read_model
from ucm_cts.harness.models.core_models import CORE

STRUCTURES = 30
INTERFACES = 20
TYPES = 24
PARTS = 24
COMPOSITES = 4


def large_model(elements: int) -> Model:
    """A model of about ``elements`` elements: the core models and at least one block of the mix."""
    core = tuple(_core())
    left = elements - sum(1 for module in core for _ in walk(module))
    one = block(0)
    blocks = max(1, round(left / sum(1 for module in one for _ in walk(module))))
    return Model(modules=(*core, *(module for number in range(blocks) for module in block(number))))


def _core() -> Iterator[Module]:
    for path in sorted(CORE.glob("*.xml")):
        yield from without_lines(read_model(path.read_bytes(), path.name).model).modules
    yield aspects.NonfunctionalAspectModule(
        name="platform",
        supported_languages=(aspects.ProgrammingLanguages(languages=(aspects.Language(name="C++11"),)),),
    )


def block(number: int) -> tuple[contracts.ContractModule, components.ComponentModule]:
    """Contracts, and the components that use them."""
    return _contracts(f"data_{number}"), _components(f"components_{number}", f"::data_{number}")


def _contracts(name: str) -> contracts.ContractModule:
    data_types: list[contracts.DataType] = [
        contracts.PrimitiveInteger(name="count_t", kind="LONG"),
        contracts.PrimitiveInteger(name="index_t", kind="USHORT"),
        contracts.PrimitiveFloat(name="distance_t", kind="DOUBLE"),
        contracts.PrimitiveBoolean(name="valid_t"),
        contracts.StringType(name="label_t", char_base="CHAR8", max_size=64),
        contracts.Enumeration(
            name="mode_t",
            index_type="UBYTE",
            enumerators=tuple(contracts.Enumerator(name=f"mode_{n}", value=n) for n in range(12)),
        ),
    ]
    simple = ("count_t", "distance_t", "valid_t", "label_t", "mode_t")
    for n in range(STRUCTURES):
        inner = f"structure_{n - 1}" if n % 5 else "count_t"
        fields = (*(simple[f % len(simple)] for f in range(n % 7 + 3)), inner)
        data_types += [
            contracts.Structure(
                name=f"structure_{n}",
                fields=tuple(contracts.StructureField(name=f"field_{f}", type=t) for f, t in enumerate(fields)),
            ),
            contracts.Sequence(name=f"sequence_{n}", type=f"structure_{n}", index_type="ULONG", max_size=100),
            contracts.Alias(name=f"alias_{n}", type=f"sequence_{n}"),
            contracts.Array(
                name=f"array_{n}",
                type=f"::{name}::structure_{n}",
                dimensions=(contracts.ArrayDimension(size=16, index_type="UBYTE"),),
            ),
        ]
    return contracts.ContractModule(
        name=name,
        data_types=tuple(data_types),
        constants=tuple(contracts.Constant(name=f"LIMIT_{n}", type="count_t", value=str(n)) for n in range(20)),
        exceptions=tuple(
            contracts.Exception_(name=f"failure_{n}", fields=(contracts.ExceptionField(name="reason", type="label_t"),))
            for n in range(5)
        ),
        interfaces=tuple(_interface(n) for n in range(INTERFACES)),
    )


def _interface(number: int) -> contracts.Interface:
    directions = ("IN", "INOUT", "OUT", "RETURN")
    return contracts.Interface(
        name=f"service_{number}",
        attributes=(contracts.Attribute(name="state", type="mode_t", mode="READ"),),
        methods=tuple(
            contracts.Method(
                name=f"operation_{m}",
                parameters=tuple(
                    contracts.Parameter(
                        name=f"parameter_{p}", direction=direction, type=f"structure_{(number + m + p) % STRUCTURES}"
                    )
                    for p, direction in enumerate(directions)
                ),
                raised_exceptions=(contracts.RaisedException(exception=f"failure_{m % 5}"),),
            )
            for m in range(6)
        ),
    )


_MESSAGE = "::messages::message_interaction_api::message_type_t"
_SERVICE = "::services::service_interaction_api::service_intf_t"
_PORTS = {
    "data_in": ("::messages::message_receiver_port", _MESSAGE, "structure_1"),
    "data_out": ("::messages::message_emitter_port", _MESSAGE, "structure_1"),
    "served": ("::services::service_server_tport", _SERVICE, "service_1"),
    "used": ("::services::service_client_tport", _SERVICE, "service_1"),
}


def _components(name: str, data: str) -> components.ComponentModule:
    implementations = [f"implementation_{n}" for n in range(TYPES)]
    return components.ComponentModule(
        name=name,
        component_types=tuple(_type(f"type_{n}", data) for n in range(TYPES)),
        implementations=(
            *(
                components.AtomicComponentImplementation(
                    name=implementation,
                    type=f"type_{n}",
                    language="C++11",
                    policies=(components.TechnicalPolicy(name="execution"), components.TechnicalPolicy(name="tracing")),
                )
                for n, implementation in enumerate(implementations)
            ),
            *(_composite(f"composite_{n}", f"type_{n}") for n in range(COMPOSITES)),
        ),
        technical_policies=(
            _policy("execution", "::component_execution_policies::protected_passive_component", implementations),
            _policy("tracing", "::container_services::trace_service::component_trace", implementations),
        ),
    )


def _type(name: str, data: str) -> components.ComponentType:
    return components.ComponentType(
        name=name,
        attributes=(
            contracts.Attribute(name="rate", type=f"{data}::distance_t", mode="READWRITE", default_value="1.5"),
        ),
        ports=tuple(
            components.Port(
                name=port,
                specs=(
                    components.PortTypeSpec(
                        type=port_type,
                        bindings=(
                            components.AbstractTypeBinding(abstract_type=abstract, actual_type=f"{data}::{actual}"),
                        ),
                    ),
                ),
            )
            for port, (port_type, abstract, actual) in _PORTS.items()
        ),
    )


def _policy(name: str, definition: str, implementations: list[str]) -> components.ComponentTechnicalPolicy:
    return components.ComponentTechnicalPolicy(
        name=name,
        technical_policy_definition=definition,
        managed_components=tuple(components.ManagedComponent(name=managed) for managed in implementations),
    )


def _composite(name: str, type_: str) -> components.CompositeComponentImplementation:
    """Parts in a row: each sends to the next and calls it."""
    connections: list[components.Connection] = []
    for n in range(PARTS - 1):
        connections += [
            _connection(f"message_{n}", "::messages::simple_message_connector", n, "data_out", "data_in"),
            _connection(f"call_{n}", "::services::simple_service_connector", n, "used", "served"),
        ]
    return components.CompositeComponentImplementation(
        name=name,
        type=type_,
        parts=tuple(components.AssemblyPart(name=f"part_{n}", instance_of=f"implementation_{n}") for n in range(PARTS)),
        connections=tuple(connections),
        delegations=(
            _delegation("data_in", 0),
            _delegation("served", 0),
            _delegation("data_out", PARTS - 1),
            _delegation("used", PARTS - 1),
        ),
    )


def _connection(name: str, definition: str, part: int, sending: str, receiving: str) -> components.Connection:
    return components.Connection(
        name=name,
        definition=definition,
        ends=(
            components.ConnectionEnd(name="from", part=f"part_{part}", port=sending),
            components.ConnectionEnd(name="to", part=f"part_{part + 1}", port=receiving),
        ),
    )


def _delegation(port: str, part: int) -> components.PortDelegation:
    return components.PortDelegation(
        name=port, port=port, ends=(components.ConnectionEnd(name="inner", part=f"part_{part}", port=port),)
    )
