"""What clause 9 shows of models in IDL beside clause 12: connectors, port types and components (9.3.2.3 to 9.5.3.10)."""

from __future__ import annotations

from collections.abc import Iterator

from ucm_cts.adapters.contract.metamodel.common import Named
from ucm_cts.adapters.contract.metamodel.components import ComponentType, PortTypeSpec
from ucm_cts.adapters.contract.metamodel.contracts import Interface
from ucm_cts.adapters.contract.metamodel.interactions import ConnectorDefinition, InteractionModule, PortType
from ucm_cts.reference_models.mapping.idl import expectations as exp
from ucm_cts.reference_models.mapping.idl.subjects import Subject, path_of

OF_ELEMENTS = {"PROVIDED": ("provides", "R-9.3.5.5-02"), "REQUIRED": ("uses", "R-9.3.5.5-03")}


def equivalent_facts(subject: Subject) -> Iterator[exp.Expected]:
    """What is expected of an element where a vendor declares that both clauses bind (interpretation idl-equivalent-syntax)."""
    element, scope = subject
    match element:
        case InteractionModule():
            yield exp.OnlyInteractions(**subject.about("R-9.3.2.3-02"))
        case ConnectorDefinition():
            yield exp.Equivalent(**subject.about("R-9.3.4.7-01"), kind="connector")
            for port in element.ports:
                found = scope.find(port.api, PortType) if port.api else None
                type_ = path_of(found) if found is not None else exp.Path()
                if type_:
                    yield _holds(subject, "R-9.3.4.7-02", port, "connector", "mirrorport", type_)
        case PortType():
            yield exp.Equivalent(**subject.about("R-9.3.5.5-01"), kind="porttype")
            for one in element.port_elements:
                found = scope.find(one.interface, Interface)
                keyword, requirement = OF_ELEMENTS.get(one.kind, ("", ""))
                if keyword:
                    type_ = path_of(found) if found is not None else exp.Path()
                    yield _holds(subject, requirement, one, "porttype", keyword, type_)
        case ComponentType():
            ports = tuple(p.name for p in element.ports if any(isinstance(s, PortTypeSpec) for s in p.specs))
            attributes = tuple(one.name for one in element.attributes)
            base = element.refines.rpartition("::")[2]
            for requirement, aspect, names in (
                ("R-9.5.3.10-02", "ports", ports),
                ("R-9.5.3.10-04", "attributes", attributes),
                ("R-9.5.3.10-06", "base", (base,) if base else ()),
            ):
                yield exp.EquivalentComponent(**subject.about(requirement), aspect=aspect, names=names)


def _holds(
    subject: Subject, requirement: str, member: Named, kind: str, keyword: str, type_: exp.Path
) -> exp.EquivalentMember:
    about = subject.about(requirement, member, path=subject.path)
    return exp.EquivalentMember(**about, kind=kind, keyword=keyword, name=member.name, type=type_)
