"""Generators of IDL that have connectors, port types and components beside clause 12's declarations: a right one, and wrong ones."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from ucm_cts.adapters.contract.metamodel.components import ComponentType, PortTypeSpec
from ucm_cts.adapters.contract.metamodel.contracts import AbstractDataType, AbstractInterface, Interface
from ucm_cts.adapters.contract.metamodel.interactions import ConnectorDefinition, PortType
from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.contract.metamodel.names import SEPARATOR, Names, Scope, each_element
from ucm_cts.adapters.mutants.toolchain import rewriting as rw
from ucm_cts.adapters.mutants.toolchain.registry import Derive, breaks, named, variant
from ucm_cts.adapters.reference.toolchain.idl.names import absolute, identifier
from ucm_cts.adapters.reference.toolchain.idl.types import attribute
from ucm_cts.adapters.reference.toolchain.program import Program

BOTH = ("idl-output=both",)
KEYWORDS = {"PROVIDED": "provides", "REQUIRED": "uses"}


def with_equivalents(program: Program) -> Program:
    """Declares connectors and port types in their modules and components in modules beside, for models without abstract types."""
    generate = program.generators["idl"]

    def more(model: Model) -> rw.Files:
        files = generate(model)
        text = "\n".join(_equivalents(model))
        return {**files, rw.MODEL: files[rw.MODEL].replace(rw.GUARD, f"\n{text}\n{rw.GUARD}")}

    return replace(program, generators={**program.generators, "idl": more})


def _equivalents(model: Model) -> Iterator[str]:
    elements = list(each_element(model, Names(model)))
    if any(isinstance(element, (AbstractDataType, AbstractInterface)) for element, _ in elements):
        return
    yield from (_within(scope, _port_type(one, scope)) for one, scope in elements if isinstance(one, PortType))
    yield from (
        _within(scope, _connector(one, scope)) for one, scope in elements if isinstance(one, ConnectorDefinition)
    )
    for one, scope in elements:
        if isinstance(one, ComponentType):
            yield f"module components_of_{identifier(scope.path.rpartition(SEPARATOR)[2])} {{ {_component(one, scope)} }};"


def _within(scope: Scope, text: str) -> str:
    path = [identifier(part) for part in scope.path.split(SEPARATOR) if part]
    return f"{''.join(f'module {part} {{ ' for part in path)}{text}{' };' * len(path)}"


def _port_type(port_type: PortType, scope: Scope) -> str:
    found = ((one, scope.find(one.interface, Interface)) for one in port_type.port_elements)
    lines = (f"{KEYWORDS[one.kind]} {absolute(to)} {identifier(one.name)};" for one, to in found if to is not None)
    return f"porttype {identifier(port_type.name)} {{ {' '.join(lines)} }};"


def _connector(connector: ConnectorDefinition, scope: Scope) -> str:
    found = ((one, scope.find(one.api, PortType)) for one in connector.ports)
    lines = (f"mirrorport {absolute(to)} {identifier(one.name)};" for one, to in found if to is not None)
    return f"connector {identifier(connector.name)} {{ {' '.join(lines)} }};"


def _component(component: ComponentType, scope: Scope) -> str:
    lines = [line for one in component.attributes for line in attribute(one, scope)]
    for port in component.ports:
        for spec in port.specs:
            found = scope.find(spec.type, PortType) if isinstance(spec, PortTypeSpec) else None
            lines += [f"port {absolute(found)} {identifier(port.name)};"] if found is not None else []
    base = f" : {identifier(component.refines.rpartition(SEPARATOR)[2])}" if component.refines else ""
    return f"component {identifier(component.name)}{base} {{ {' '.join(lines)} }};"


variant(task="idl", declares=BOTH)(with_equivalents)

WRONG: dict[str, tuple[str, rw.Edits]] = {
    "interaction_modules_hold_types": (
        "R-9.3.2.3-02",
        {r"(porttype \w+ \{[^{}]*\};)": r"\1 typedef long added_t;"},
    ),
    "connectors_are_port_types": ("R-9.3.4.7-01", {r"\bconnector (?=\w+ \{)": "porttype "}),
    "connector_ports_are_no_mirrors": ("R-9.3.4.7-02", {r"\bmirrorport ": "port "}),
    "one_port_type_forgotten": ("R-9.3.5.5-01", {r"\A([\s\S]*)porttype \w+ \{[^{}]*\};": r"\1"}),
    "what_is_provided_is_forgotten": ("R-9.3.5.5-02", {r"provides \S+ \w+;": ""}),
    "what_is_provided_is_another_interface": (
        "R-9.3.5.5-02",
        {r"provides (\S+)( \w+;)": r"provides ::PortElementObject\2"},
    ),
    "what_is_used_is_provided": ("R-9.3.5.5-03", {r"\buses (?=\S+ \w+;)": "provides "}),
    "components_have_facets": ("R-9.5.3.10-02", {r"(component \w+[^{]*\{)": r"\1 provides ::PortElementObject extra;"}),
    "components_lose_attributes": (
        "R-9.5.3.10-04",
        {r"(component \w+[^{]*\{[^}]*?)(?:readonly )?attribute \S+ \w+;": r"\1"},
    ),
    "components_lose_their_base": ("R-9.5.3.10-06", {r"(component \w+) : \w+": r"\1"}),
}
"""By the mutant's name: the requirement that it breaks, and its edits of what ``with_equivalents`` generates."""


def _wrong(edits: rw.Edits) -> Derive:
    return lambda program: rw.replacing(edits)(with_equivalents(program))


for _name, (_requirement, _edits) in WRONG.items():
    breaks(_requirement, task="idl", declares=BOTH)(named(_wrong(_edits), _name, rw.sentence(_name)))
