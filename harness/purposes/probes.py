"""The probe models (suite/models/probes): which port elements and attributes each kind of probe has."""

from __future__ import annotations

import functools
from dataclasses import dataclass
from pathlib import Path

from lxml import etree

PROBE_MODEL = Path(__file__).parents[2] / "suite" / "models" / "probes" / "probes.xml"


@dataclass(frozen=True)
class ProbeType:
    """A component type of the probe model. Port elements are spelled ``port.element``, as in scenario scripts."""

    name: str
    provides: tuple[str, ...]
    requires: tuple[str, ...]
    attributes: tuple[str, ...]


@functools.cache
def load_probe_types(path: Path = PROBE_MODEL) -> dict[str, ProbeType]:
    """All component types of the model at ``path``, by name. The model ships with the suite and is trusted."""
    parser = etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=False)
    root = etree.parse(path, parser).getroot()
    elements: dict[str, list[tuple[str, str]]] = {}
    for module in root.iter("InteractionModule"):
        for port_type in module.iter("PortType"):
            name = f"::{module.get('name')}::{port_type.get('name')}"
            elements[name] = [(e.get("name", ""), e.get("kind", "")) for e in port_type.iter("PortElement")]
    types = {}
    for component in root.iter("ComponentType"):
        ports = [
            (f"{port.get('name')}.{element}", kind)
            for port in component.iter("Port")
            for spec in port.iter("PortTypeSpec")
            for element, kind in elements[spec.get("type", "")]
        ]
        types[component.get("name", "")] = ProbeType(
            component.get("name", ""),
            tuple(p for p, kind in ports if kind == "PROVIDED"),
            tuple(p for p, kind in ports if kind == "REQUIRED"),
            tuple(a.get("name", "") for a in component.iter("Attribute")),
        )
    return types
