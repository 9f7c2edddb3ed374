"""A legal model of any size, with a mix of elements as in real architectures.

It has contracts, component types and implementations with policies, composites with connections, over the core models.
"""

from __future__ import annotations

import functools
from collections.abc import Iterable, Mapping
from pathlib import Path

import jinja2

from ucm_cts.adapters.contract.metamodel import aspects
from ucm_cts.adapters.contract.metamodel.common import walk, without_lines
from ucm_cts.adapters.contract.metamodel.modules import Model, Module
from ucm_cts.adapters.contract.metamodel.reading import read_model
from ucm_cts.harness.models.core_models import CORE

_MESSAGE = "::messages::message_interaction_api::message_type_t"
_SERVICE = "::services::service_interaction_api::service_intf_t"
MIX: Mapping[str, object] = {
    "STRUCTURES": 30,
    "INTERFACES": 20,
    "TYPES": 24,
    "PARTS": 24,
    "COMPOSITES": 4,
    "PORTS": (
        ("data_in", "::messages::message_receiver_port", _MESSAGE, "structure_1"),
        ("data_out", "::messages::message_emitter_port", _MESSAGE, "structure_1"),
        ("served", "::services::service_server_tport", _SERVICE, "service_1"),
        ("used", "::services::service_client_tport", _SERVICE, "service_1"),
    ),
    "CONNECTIONS": (
        ("message", "::messages::simple_message_connector", "data_out", "data_in"),
        ("call", "::services::simple_service_connector", "used", "served"),
    ),
    "POLICIES": (
        ("execution", "::component_execution_policies::protected_passive_component"),
        ("tracing", "::container_services::trace_service::component_trace"),
    ),
}
"""How much of what a block has, and the core definitions that it uses."""

_BLOCK = Path(__file__).with_name("block.xml.jinja")
_TEMPLATE = jinja2.Template(_BLOCK.read_text(encoding="utf-8"), trim_blocks=True, lstrip_blocks=True)


def large_model(elements: int) -> Model:
    """A model of about ``elements`` elements: the core models and at least one block of the mix."""
    left = elements - _size(_core())
    return model_of(block(number) for number in range(max(1, round(left / _size(block(0))))))


def model_of(blocks: Iterable[tuple[Module, ...]]) -> Model:
    """The core models and ``blocks``."""
    return Model(modules=(*_core(), *(module for modules in blocks for module in modules)))


def _size(modules: tuple[Module, ...]) -> int:
    return sum(1 for module in modules for _ in walk(module))


@functools.cache
def _core() -> tuple[Module, ...]:
    files = (read_model(path.read_bytes(), path.name) for path in sorted(CORE.glob("*.xml")))
    platform = aspects.NonfunctionalAspectModule(
        name="platform",
        supported_languages=(aspects.ProgrammingLanguages(languages=(aspects.Language(name="C++11"),)),),
    )
    return (*(module for reading in files for module in without_lines(reading.model).modules), platform)


def block(number: int, mix: Mapping[str, object] = MIX) -> tuple[Module, ...]:
    """Contracts, and the components that use them; ``mix`` has what ``MIX`` has."""
    xml = _TEMPLATE.render(mix, number=number)
    reading = read_model(xml.encode(), _BLOCK.name)
    assert not reading.problems, reading.problems[0]
    return without_lines(reading.model).modules
