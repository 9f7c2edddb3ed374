"""Checks expectations of connectors, port types and components, which clause 9 shows in IDL.

Only vendors who declare that both clauses bind are asked. Where none of the model's is there, nothing is judged; where one is, all are due.
"""

from __future__ import annotations

from ucm_cts.harness.toolchains.idl.language.scopes import Hit, every, resolve
from ucm_cts.harness.toolchains.idl.language.showing import show
from ucm_cts.harness.toolchains.idl.results import NotExercised, Wrong
from ucm_cts.harness.toolchains.idl.subject import here, nearest
from ucm_cts.harness.toolchains.idl.vendor import Vendor, spelled
from ucm_cts.reference_models.mapping.idl import declarations as idl
from ucm_cts.reference_models.mapping.idl import expectations as exp


def equivalent(vendor: Vendor, fact: exp.Equivalent) -> list[Wrong]:
    """Whether an element is there as clause 9 shows it."""
    _is_judged(vendor)
    hit = vendor.at(fact.path)
    if hit is not None and idl.kind_of(hit.entry.declaration) == fact.kind:
        return []
    observed = idl.kind_of(hit.entry.declaration) if hit is not None else "no such declaration"
    return [Wrong(f"{fact.kind} {fact.path[-1]}", observed, nearest(vendor.at(fact.path[:-1])))]


def equivalent_member(vendor: Vendor, fact: exp.EquivalentMember) -> list[Wrong]:
    """Whether a connector or port type has a member of the right keyword and type."""
    _is_judged(vendor)
    hit = here(vendor, fact.path, idl.Extended)
    extended = hit.entry.declaration
    assert isinstance(extended, idl.Extended)
    if extended.kind != fact.kind:
        raise NotExercised
    wanted = f"{fact.keyword} {fact.name} of {fact.path[-1]}"
    found = next((one for one in extended.members if one.name == spelled(fact.name)), None)
    if found is None or found.kind != fact.keyword:
        observed = "no such member" if found is None else f"{found.kind} {found.name}"
        return [Wrong(wanted, observed, extended.place)]
    if _is_type(vendor, hit, found, fact.type):
        return []
    return [Wrong(f"{wanted}, of type {'::'.join(fact.type)}", show(found.type), found.place)]


def _is_type(vendor: Vendor, hit: Hit, member: idl.ExtendedMember, path: exp.Path) -> bool:
    """Whether the type is what stands at ``path``; true where the model or the IDL leaves that open."""
    wanted = vendor.at(path) if path else None
    name = member.type.name if isinstance(member.type, idl.Named) else ""
    found = resolve(name, hit.entry.scope) if name else None
    return wanted is None or found is None or found.entry is wanted.entry


def equivalent_component(vendor: Vendor, fact: exp.EquivalentComponent) -> list[Wrong]:
    """Whether a component, wherever it stands, has the ports, the attributes or the ancestor of its type."""
    _is_judged(vendor)
    name = spelled(fact.path[-1])
    for entry in every(vendor.root):
        extended = entry.declaration
        if isinstance(extended, idl.Extended) and extended.kind == "component" and extended.name == name:
            return _compared(extended, fact)
    raise NotExercised


def _compared(extended: idl.Extended, fact: exp.EquivalentComponent) -> list[Wrong]:
    wanted = sorted(spelled(name) for name in fact.names)
    match fact.aspect:
        case "ports":
            found = [one.name if one.kind == "port" else f"{one.kind} {one.name}" for one in extended.members]
        case "attributes":
            found = [one.name for one in extended.attributes]
        case _:
            found = [base.rpartition("::")[2] for base in extended.bases]
    if sorted(found) == wanted:
        return []
    shown = f"{fact.aspect} of component {extended.name}: {', '.join(wanted) or 'none'}"
    return [Wrong(shown, ", ".join(found) or "none", extended.place)]


def only_interactions(vendor: Vendor, fact: exp.OnlyInteractions) -> list[Wrong]:
    """Whether the module of an interaction module holds connectors, port types and modules only."""
    _is_judged(vendor)
    hit = here(vendor, fact.path, idl.Module)
    inside = hit.entry.inner.entries if hit.entry.inner is not None else ()
    allowed = ("connector", "porttype", "module", "template parameter")
    others = [one.declaration for one in inside if idl.kind_of(one.declaration) not in allowed]
    return [
        Wrong(f"connectors and port types only in {fact.path[-1]}", f"{idl.kind_of(one)} {one.name}", one.place)
        for one in others[:1]
    ]


def _is_judged(vendor: Vendor) -> None:
    """Raise ``NotExercised`` unless the vendor declares both and has something of the model in the manner of clause 9."""
    if vendor.reading("idl-output") != "both":
        raise NotExercised
    due = [fact for fact in vendor.expected.facts if isinstance(fact, exp.Equivalent)]
    hits = [vendor.at(fact.path) for fact in due]
    if not any(hit is not None and isinstance(hit.entry.declaration, idl.Extended) for hit in hits):
        raise NotExercised
