"""Checks each kind of expectation: what is wrong with the vendor's IDL, if anything."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Mapping
from typing import Any

import msgspec

from ucm_cts.harness.toolchains.idl import facts_of_equivalents as equivalents
from ucm_cts.harness.toolchains.idl import facts_of_interfaces as interfaces
from ucm_cts.harness.toolchains.idl.annotations import defaulted, indexed, numbered, tagged
from ucm_cts.harness.toolchains.idl.language.scopes import Entry, Hit, Scope, every, resolve
from ucm_cts.harness.toolchains.idl.language.showing import show, show_kind, show_worth, type_of
from ucm_cts.harness.toolchains.idl.language.values import Chosen, equal, model_worth, worth
from ucm_cts.harness.toolchains.idl.results import NotExercised, Wrong
from ucm_cts.harness.toolchains.idl.subject import here, nearest
from ucm_cts.harness.toolchains.idl.vendor import Vendor, spelled
from ucm_cts.reference_models.mapping.idl import declarations as idl
from ucm_cts.reference_models.mapping.idl import expectations as exp

MISPLACED = "R-12.7-07"
INTERFACE_ATTRIBUTES = "R-12.6-10"

TYPES = (idl.Typedef, idl.Struct, idl.Union, idl.Enum, idl.Native)


def declares(vendor: Vendor, fact: exp.Declares) -> list[Wrong]:
    """Whether it is there at all, and is what it should be."""
    hit = vendor.at(fact.path)
    if hit is None:
        return _missing(vendor, fact)
    declaration = hit.entry.declaration
    kind = idl.kind_of(declaration)
    if fact.requirement == INTERFACE_ATTRIBUTES and vendor.reading("idl-interface-attributes") != "attributes":
        fact = msgspec.structs.replace(fact, kind=kind)  # an operation may stand for it
    if fact.kind in ("", kind):  # of which kind data types are is a matter of their own
        return []
    return [Wrong(f"{show_kind(fact.kind)} {fact.path[-1]}", f"{show_kind(kind)} of that name", declaration.place)]


def _missing(vendor: Vendor, fact: exp.Declares) -> list[Wrong]:
    around = here(vendor, fact.path[:-1]) if len(fact.path) > 1 else None
    needed = fact.needed or (
        fact.requirement == INTERFACE_ATTRIBUTES and vendor.reading("idl-interface-attributes") == "attributes"
    )
    if not needed or vendor.unreadable:
        raise NotExercised
    expected = f"{show_kind(fact.kind)} {'::'.join(fact.path)}"
    if fact.kind in ("operation", "attribute"):
        return [Wrong(expected, "no such thing", nearest(around))]
    elsewhere = [
        entry
        for entry in every(vendor.root)
        if entry.declaration.name == spelled(fact.path[-1]) and _is_like(entry.declaration, fact.kind)
    ]
    if elsewhere:
        found = elsewhere[0]
        return [Wrong(expected, f"only {'::'.join(found.path)}", found.declaration.place, MISPLACED)]
    return [Wrong(expected, "no such declaration", nearest(around))]


def _is_like(declaration: idl.Declaration, kind: str) -> bool:
    return isinstance(declaration, TYPES) if not kind else idl.kind_of(declaration) == kind


def means(vendor: Vendor, fact: exp.Means) -> list[Wrong]:
    """Whether a type is the one it should be."""
    hit = here(vendor, fact.path)
    declaration = hit.entry.declaration
    found = type_of(declaration)
    if fact.requirement == INTERFACE_ATTRIBUTES and not isinstance(declaration, idl.Attribute):
        raise NotExercised
    if found is None:
        return [
            Wrong(
                f"{fact.path[-1]} to be another name of {show(fact.type)}",
                f"a {idl.kind_of(declaration)}",
                declaration.place,
            )
        ]
    if not vendor.known(found, hit.entry.scope) or vendor.is_open(fact.type):
        raise NotExercised
    right = vendor.same(found, hit.entry.scope, fact.type)
    if fact.requirement == ULONGLONG:
        right = _unsigned_long_long(vendor, found, hit.entry.scope)
    if fact.requirement == BOOLEAN and right:
        right = _boolean(vendor, found)
    return [] if right else [Wrong(f"{show(fact.type)} {fact.path[-1]}", show(found), declaration.place)]


ULONGLONG = "R-12.3.1-08"
BOOLEAN = "R-12.3.1-13"


def _boolean(vendor: Vendor, found: idl.Type) -> bool:
    """The table prints bool (interpretation idl-boolean)."""
    name = "bool" if found == idl.Named("bool") else "boolean"
    vendor.met.setdefault("idl-boolean", set()).add(name)
    return vendor.reading("idl-boolean") in ("", "observed", name)


def _unsigned_long_long(vendor: Vendor, found: idl.Type, scope: Scope) -> bool:
    """The table prints unsigned long, which is too small (interpretation idl-ulonglong)."""
    name = str(vendor.meaning(found, scope)[1]).replace(" ", "-")
    readings = ("unsigned-long-long", "unsigned-long")
    if name in readings:
        vendor.met.setdefault("idl-ulonglong", set()).add(name)
    declared = vendor.reading("idl-ulonglong")
    return name == declared if declared in readings else name in readings


def selects(vendor: Vendor, fact: exp.Selects) -> list[Wrong]:
    """Whether the cases of a union are selected by the right type."""
    hit = here(vendor, fact.path, idl.Union)
    union = hit.entry.declaration
    assert isinstance(union, idl.Union)
    if not vendor.known(union.selector, hit.entry.scope) or vendor.is_open(fact.type):
        raise NotExercised
    if vendor.same(union.selector, hit.entry.scope, fact.type):
        return []
    return [Wrong(f"switch ({show(fact.type)})", f"switch ({show(union.selector)})", union.place)]


def _listed(declaration: idl.Declaration) -> tuple[idl.Declaration, ...]:
    match declaration:
        case idl.Struct() | idl.Exception_():
            return declaration.members
        case idl.Union():
            return declaration.cases
        case idl.Enum():
            return declaration.enumerators
    return ()


def lists(vendor: Vendor, fact: exp.Lists) -> list[Wrong]:
    """Whether members, cases or enumerators are just those of the model."""
    hit = here(vendor, fact.path, (idl.Struct, idl.Exception_, idl.Union, idl.Enum))
    declaration = hit.entry.declaration
    found = [one.name for one in _listed(declaration)]
    wanted = [_written(vendor, hit, name) for name in fact.names]
    if found == wanted or (not fact.ordered and sorted(found) == sorted(wanted)):
        return []
    return [Wrong(f"{fact.path[-1]} to have {_names(wanted)}", _names(found), declaration.place)]


def ordered(vendor: Vendor, fact: exp.Ordered) -> list[Wrong]:
    """Whether enumerators stand in an order that the model gives them; which they are is another fact's matter."""
    if vendor.reading("idl-enumerator-order") == "free":
        raise NotExercised
    hit = here(vendor, fact.path, idl.Enum)
    found = [one.name for one in _listed(hit.entry.declaration)]
    orders = [[_written(vendor, hit, name) for name in order] for order in fact.orders]
    if sorted(found) != sorted(orders[0]):
        raise NotExercised
    if found in orders:
        return []
    return [Wrong(f"{fact.path[-1]} to have {_names(orders[0])}", _names(found), hit.entry.declaration.place)]


def _written(vendor: Vendor, hit: Hit, name: str) -> str:
    found = vendor.inside(hit, name)
    return found.entry.declaration.name if found is not None else spelled(name)


def _names(names: list[str]) -> str:
    return ", ".join(names) or "nothing"


def labelled(vendor: Vendor, fact: exp.Labelled) -> list[Wrong]:
    """Whether a case holds for the enumerators it should."""
    hit = here(vendor, fact.path, idl.Case)
    case = hit.entry.declaration
    union = here(vendor, fact.path[:-1], idl.Union).entry
    assert isinstance(case, idl.Case)
    assert isinstance(union.declaration, idl.Union)
    found = _chosen(case, union)
    if found is None:
        raise NotExercised
    wanted = {vendor.like(path[-1], found | _others(case, union)) for path in fact.labels}
    default = None in case.labels
    right = found == wanted and not default
    if fact.default:
        right = found <= wanted if default else found == wanted | _others(case, union)
    if right:
        return []
    expected = ", ".join([*sorted(wanted), *(["default"] if fact.default else [])])
    observed = ", ".join([*sorted(found), *(["default"] if default else [])])
    return [Wrong(f"case {case.name} for {expected}", observed, case.place)]


def _chosen(case: idl.Case, union: Entry) -> set[str] | None:
    """The enumerators that a case names; None if one of them means nothing."""
    assert isinstance(union.declaration, idl.Union)
    selector = resolve(getattr(union.declaration.selector, "name", ""), union.scope)
    around = selector.entry.scope if selector is not None else union.scope
    values = [worth(label, around) or worth(label, union.scope) for label in _expressions(case)]
    return {value.name for value in values if isinstance(value, Chosen)} if all(values) else None


def _expressions(case: idl.Case) -> list[idl.Expression]:
    return [label for label in case.labels if label is not None]


def _others(case: idl.Case, union: Entry) -> set[str]:
    """The enumerators that no other case names."""
    assert isinstance(union.declaration, idl.Union)
    selector = resolve(getattr(union.declaration.selector, "name", ""), union.scope)
    if selector is None or not isinstance(selector.entry.declaration, idl.Enum):
        return set()
    rest = (_chosen(one, union) or set() for one in union.declaration.cases if one is not case)
    return {one.name.lower() for one in selector.entry.declaration.enumerators} - set(
        itertools.chain.from_iterable(rest)
    )


def valued(vendor: Vendor, fact: exp.Valued) -> list[Wrong]:
    """Whether a constant has its value."""
    hit = here(vendor, fact.path, idl.Constant)
    constant = hit.entry.declaration
    assert isinstance(constant, idl.Constant)
    wanted = model_worth(fact.value, vendor.value_kind(fact.type), hit.entry.scope)
    found = worth(constant.value, hit.entry.scope)
    if wanted is None:
        raise NotExercised
    if equal(found, wanted):
        return []
    return [Wrong(f"{constant.name} = {show_worth(wanted)}", show_worth(found), constant.place)]


def templated(vendor: Vendor, fact: exp.Templated) -> list[Wrong]:
    """Whether a module has the parameters it must have and none that it may not."""
    hit = here(vendor, fact.path, idl.Module)
    module = hit.entry.declaration
    assert isinstance(module, idl.Module)
    found = {parameter.name.lower() for parameter in module.parameters}
    names = {path: vendor.like(vendor.expected.abstract[path].name, found) for path in fact.allowed}
    required = {names[path] for path in fact.required}
    allowed = set(names.values())
    if fact.requirement == "R-12.7-12":
        propagation = vendor.reading("idl-template-propagation")
        if propagation == "containment":
            required |= allowed
        if propagation == "direct":
            allowed = required | {names[path] for path in fact.allowed if path[:-1] == fact.path}
        wrong = not required <= found <= allowed
    else:
        wrong = not required <= found
    if not wrong:
        return []
    expected = f"template parameters {', '.join(sorted(required)).upper()}" if required else "no template parameters"
    return [Wrong(expected, ", ".join(sorted(found)) or "none", module.place)]


def parametrized(vendor: Vendor, fact: exp.Parametrized) -> list[Wrong]:
    """Whether a template parameter has the right name and keyword."""
    hit = here(vendor, fact.path, idl.Module)
    module = hit.entry.declaration
    assert isinstance(module, idl.Module)
    name = vendor.expected.abstract[fact.parameter].name
    plain = spelled(name)
    found = next((p for p in module.parameters if vendor.pattern(name).fullmatch(p.name)), None)
    if found is None:
        raise NotExercised
    if fact.keyword:
        right = found.kind == fact.keyword
        return [] if right else [Wrong(f"{fact.keyword} {plain.upper()}", f"{found.kind} {found.name}", found.place)]
    spellings = {"upper": name.upper(), "first": name[:1].upper() + name[1:]}
    fitting = {key for key, one in spellings.items() if vendor.pattern(one, 0).fullmatch(found.name)}
    wanted = vendor.reading("idl-template-names")
    right = wanted in fitting if wanted in spellings else bool(fitting)
    vendor.met.setdefault("idl-template-names", set()).update(fitting)
    shown = spelled(spellings.get(wanted, name.upper()))
    return [] if right else [Wrong(f"parameter {shown}", found.name, found.place)]


def undeclared(vendor: Vendor, fact: exp.Undeclared) -> list[Wrong]:
    """Whether nothing has been made of what has no mapping."""
    here(vendor, fact.path[:1])
    hit = vendor.at(fact.path)
    if hit is None:
        return []
    declaration = hit.entry.declaration
    kind = idl.kind_of(declaration)
    if kind in ("connector", "porttype") and vendor.reading("idl-output") == "both":
        return []
    return [Wrong(f"nothing called {fact.path[-1]}", show_kind(kind), declaration.place)]


FACTS: Mapping[type[exp.Expected], Callable[[Vendor, Any], list[Wrong]]] = {
    exp.Declares: declares,
    exp.Means: means,
    exp.Selects: selects,
    exp.Lists: lists,
    exp.Ordered: ordered,
    exp.Labelled: labelled,
    exp.Valued: valued,
    exp.Templated: templated,
    exp.Parametrized: parametrized,
    exp.Undeclared: undeclared,
    exp.Takes: interfaces.takes,
    exp.TakesType: interfaces.takes_type,
    exp.Raises: interfaces.raises,
    exp.Only: interfaces.only,
    exp.Inherits: interfaces.inherits,
    exp.InheritsNone: interfaces.inherits_none,
    exp.Access: interfaces.access,
    exp.Getter: interfaces.getter,
    exp.NoGetter: interfaces.no_getter,
    exp.NoMember: interfaces.no_member,
    exp.Equivalent: equivalents.equivalent,
    exp.EquivalentMember: equivalents.equivalent_member,
    exp.EquivalentComponent: equivalents.equivalent_component,
    exp.OnlyInteractions: equivalents.only_interactions,
    exp.Numbered: numbered,
    exp.Tagged: tagged,
    exp.Indexed: indexed,
    exp.Defaulted: defaulted,
}
"""Checks one expectation; raises ``NotExercised`` if its subject is absent."""
