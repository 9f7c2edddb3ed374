"""Which types does a port handle? Those of its interfaces, of their methods and attributes, and what these are made of."""

from __future__ import annotations

from collections.abc import Iterator

from ucm_cts.adapters.contract.metamodel import contracts as c
from ucm_cts.adapters.contract.metamodel.aspects import TechnicalPolicyDefinition
from ucm_cts.adapters.contract.metamodel.interactions import PortType
from ucm_cts.adapters.contract.metamodel.names import Declared

_TYPES = (c.DataType, c.AbstractDataType, c.Interface, c.AbstractInterface)


def handles(port_type: Declared, wanted: Declared) -> bool:
    """Whether an API written as ``port_type`` has anything to do with the type ``wanted``."""
    return any(one.element is wanted.element for one in (port_type, *handled(port_type)))


def handled(*starts: Declared) -> Iterator[Declared]:
    """All types that port types and policy definitions have to do with, each once."""
    seen = {id(start.element) for start in starts}
    waiting = list(starts)
    while waiting:
        current = waiting.pop()
        for reference in _references(current):
            found = current.scope.find(reference, *_TYPES)
            if found is not None and id(found.element) not in seen:
                seen.add(id(found.element))
                waiting.append(found)
                yield found


def _references(declared: Declared) -> Iterator[str]:
    """The names of types by which a declaration says what it consists of."""
    element = declared.element
    if isinstance(element, PortType | TechnicalPolicyDefinition):
        yield from (port_element.interface for port_element in element.port_elements)
    elif isinstance(element, c.Interface):
        yield from (inherited.interface for inherited in element.inherited_interfaces)
        yield from (attribute.type for attribute in element.attributes)
        yield from (parameter.type for method in element.methods for parameter in method.parameters)
    elif isinstance(element, c.Structure):
        yield from (field.type for field in element.fields)
    elif isinstance(element, c.Union):
        yield from (case.type for case in element.cases)
    elif isinstance(element, c.Alias | c.Array | c.Sequence):
        yield element.type
