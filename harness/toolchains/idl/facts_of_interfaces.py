"""Checks expectations of interfaces: operations, attributes, ancestors and getters."""

from __future__ import annotations

from collections.abc import Iterator

from ucm_cts.harness.toolchains.idl.language.scopes import Hit, base_names, bases, resolve
from ucm_cts.harness.toolchains.idl.language.showing import show
from ucm_cts.harness.toolchains.idl.results import NotExercised, Wrong
from ucm_cts.harness.toolchains.idl.subject import here
from ucm_cts.harness.toolchains.idl.vendor import Vendor, spelled
from ucm_cts.reference_models.mapping.idl import expectations as exp
from ucm_cts.reference_models.mapping.idl.declarations import Attribute, Interface, Operation, kind_of


def takes(vendor: Vendor, fact: exp.Takes) -> list[Wrong]:
    """Whether an operation has the parameters it should: directions, order, and names if those count.

    Names that are the model's say which parameter is meant, so they may not be in another order.
    """
    hit = here(vendor, fact.path, Operation)
    operation = hit.entry.declaration
    assert isinstance(operation, Operation)
    found = [(p.direction, p.name) for p in operation.parameters]
    wanted = [(direction, _written(vendor, hit, name)) for direction, name in fact.parameters]
    directions = [direction for direction, _ in found] == [direction for direction, _ in wanted]
    names = vendor.reading("idl-parameter-names") == "kept" or _same_names(found, wanted)
    if found == wanted or (directions and not names):
        return []
    return [Wrong(f"{fact.path[-1]}({_shown(wanted)})", f"({_shown(found)})", operation.place)]


def _same_names(found: list[tuple[str, str]], wanted: list[tuple[str, str]]) -> bool:
    return {name for _, name in found} == {name for _, name in wanted}


def takes_type(vendor: Vendor, fact: exp.TakesType) -> list[Wrong]:
    """Whether a parameter has its type: that of its name, or of its position if the names are others."""
    hit = here(vendor, fact.path[:-1], Operation)
    operation = hit.entry.declaration
    assert isinstance(operation, Operation)
    found = [(p.direction, p.name) for p in operation.parameters]
    wanted = [(direction, _written(vendor, hit, name)) for direction, name in fact.parameters]
    if _same_names(found, wanted):
        name = wanted[fact.position][1]
        parameter = next(p for p in operation.parameters if p.name == name)
    elif [direction for direction, _ in found] == [direction for direction, _ in wanted]:
        parameter = operation.parameters[fact.position]
    else:
        raise NotExercised
    if not vendor.known(parameter.type, hit.entry.scope) or vendor.is_open(fact.type):
        raise NotExercised
    if vendor.same(parameter.type, hit.entry.scope, fact.type):
        return []
    return [Wrong(f"{show(fact.type)} {parameter.name}", show(parameter.type), parameter.place)]


def _written(vendor: Vendor, hit: Hit, name: str) -> str:
    found = vendor.inside(hit, name)
    return found.entry.declaration.name if found is not None else spelled(name)


def _shown(parameters: list[tuple[str, str]]) -> str:
    return ", ".join(" ".join(one) for one in parameters)


def raises(vendor: Vendor, fact: exp.Raises) -> list[Wrong]:
    """Whether an operation raises just the exceptions it should."""
    hit = here(vendor, fact.path, Operation)
    operation = hit.entry.declaration
    assert isinstance(operation, Operation)
    found = [(name, resolve(name, hit.entry.scope)) for name in operation.raises]
    if any(one is None for _, one in found):
        raise NotExercised
    entries = {id(one.entry) for _, one in found if one is not None}
    wanted = [vendor.at(path) for path in fact.exceptions]
    if any(one is None for one in wanted):
        raise NotExercised
    if entries == {id(one.entry) for one in wanted if one is not None}:
        return []
    expected = ", ".join("::".join(path) for path in fact.exceptions) or "nothing"
    observed = ", ".join(operation.raises) or "nothing"
    return [Wrong(f"{fact.path[-1]} to raise {expected}", observed, operation.place)]


def only(vendor: Vendor, fact: exp.Only) -> list[Wrong]:
    """Whether an interface has nothing of a kind, inherited or not, that the model does not have."""
    hit = here(vendor, fact.path, Interface)
    wanted = {id(found.entry) for name in fact.names if (found := vendor.inside(hit, name)) is not None}
    tolerated = tuple(spelled(name) for name in fact.tolerated)
    patterns = [vendor.pattern(one) for one in fact.patterns]
    wrong = []
    for holder in (hit, *_superfluous(vendor, hit, fact)):
        for entry in holder.entry.inner.entries if holder.entry.inner is not None else ():
            name = entry.declaration.name
            if (
                kind_of(entry.declaration) == fact.kind
                and id(entry) not in wanted
                and not name.endswith(tolerated)
                and not any(pattern.fullmatch(name) for pattern in patterns)
            ):
                place = entry.declaration.place if holder is hit else hit.entry.declaration.place
                observed = name if holder is hit else f"{name}, inherited from {'::'.join(holder.entry.path)}"
                wrong.append(Wrong(f"no {fact.kind} of the name in {fact.path[-1]}", observed, place))
    return wrong


def _superfluous(vendor: Vendor, hit: Hit, fact: exp.Only) -> list[Hit]:
    """The interfaces that one inherits from though the model has no such ancestor; none where the IDL leaves that open.

    Another fact is about the members of PortElementObject.
    """
    ancestors = [vendor.at(path) for path in fact.ancestors]
    if any(one is None for one in ancestors):
        return []
    due = {id(one.entry) for one in ancestors if one is not None}
    return [one for one in bases(hit) if id(one.entry) not in due and one.entry.declaration.name != "PortElementObject"]


def inherits(vendor: Vendor, fact: exp.Inherits) -> list[Wrong]:
    """Whether an interface has an ancestor."""
    hit = here(vendor, fact.path, Interface)
    base = vendor.at(fact.base)
    standard = len(fact.base) == 1
    named = any(map(vendor.pattern(fact.base[-1]).fullmatch, base_names(hit)))
    if base is None and not standard and not vendor.missing:
        raise NotExercised
    if any(one.entry is base.entry for one in bases(hit)) if base is not None else named:
        return []
    if standard and named:
        return []
    interface = hit.entry.declaration
    assert isinstance(interface, Interface)
    observed = ", ".join(interface.bases) or "nothing"
    return [Wrong(f"{interface.name} to inherit from {'::'.join(fact.base)}", observed, interface.place)]


def inherits_none(vendor: Vendor, fact: exp.InheritsNone) -> list[Wrong]:
    """Whether an interface has none of some ancestors."""
    hit = here(vendor, fact.path, Interface)
    found = [base for base in fact.bases if base.lower() in base_names(hit)]
    interface = hit.entry.declaration
    return [Wrong(f"{interface.name} not to inherit from {base}", "it does", interface.place) for base in found[:1]]


def access(vendor: Vendor, fact: exp.Access) -> list[Wrong]:
    """Whether an attribute can be written just if it should."""
    attribute = here(vendor, fact.path, Attribute).entry.declaration
    assert isinstance(attribute, Attribute)
    if attribute.readonly == fact.readonly:
        return []
    words = ("attribute", "readonly attribute")
    return [Wrong(f"{words[fact.readonly]} {attribute.name}", words[attribute.readonly], attribute.place)]


def operations(hit: Hit) -> Iterator[Hit]:
    """The operations of an interface, inherited ones too."""
    return (one for one in _members(hit) if isinstance(one.entry.declaration, Operation))


def attributes(hit: Hit) -> Iterator[Hit]:
    """The attributes of an interface, inherited ones too."""
    return (one for one in _members(hit) if isinstance(one.entry.declaration, Attribute))


def _members(hit: Hit) -> Iterator[Hit]:
    for one in (hit, *bases(hit)):
        for entry in one.entry.inner.entries if one.entry.inner is not None else ():
            yield Hit(entry, one.bound)


def _holder(vendor: Vendor, path: exp.Path, otherwise: exp.Path) -> Hit:
    hit = vendor.at(path)
    return (
        hit if hit is not None and isinstance(hit.entry.declaration, Interface) else here(vendor, otherwise, Interface)
    )


def _allowed(vendor: Vendor, names: tuple[str, ...]) -> tuple[str, ...]:
    if len(names) == 3:  # of a policy: the readings of idl-policy-getters, in this order
        chosen = {"instance": names[:1], "definition": names[1:2], "component-and-instance": names[2:]}
        names = chosen.get(vendor.reading("idl-policy-getters"), names)
    return names


def _getters(vendor: Vendor, holder: Hit, names: tuple[str, ...]) -> list[Hit]:
    found: list[Hit] = []
    for name in _allowed(vendor, names):
        usual, any_way = vendor.pattern(name, usual=True), vendor.pattern(name)
        like = [one for one in operations(holder) if usual.fullmatch(one.entry.declaration.name)]
        if not like:
            others = [one for one in operations(holder) if any_way.fullmatch(one.entry.declaration.name)]
            like = others if len({one.entry.declaration.name for one in others}) == 1 else []
        found += like
    return found


def getter(vendor: Vendor, fact: exp.Getter) -> list[Wrong]:
    """Whether the operation that hands out a port element is there, takes and raises nothing, and returns the right interface."""
    holder = _holder(vendor, fact.path, fact.otherwise)
    found = _getters(vendor, holder, fact.names)
    place = holder.entry.declaration.place
    if fact.aspect == "presence":
        if found:
            return []
        missing = vendor.missing and any(resolve(n, holder.entry.scope) is None for n in _base_list(holder))
        if not fact.needed or vendor.unreadable or missing:
            raise NotExercised
        return [
            Wrong(f"operation {spelled(fact.names[0])} of {holder.entry.declaration.name}", "no such operation", place)
        ]
    if not found:
        raise NotExercised
    hit = found[0]
    operation = hit.entry.declaration
    assert isinstance(operation, Operation)
    if fact.aspect == "arguments":
        parameters = [(p.direction, p.name) for p in operation.parameters]
        if parameters:
            return [Wrong(f"{operation.name}()", f"({_shown(parameters)})", operation.place)]
        raised = ", ".join(operation.raises)
        return [Wrong(f"{operation.name} to raise nothing", raised, operation.place)] if raised else []
    if not vendor.known(operation.returns, hit.entry.scope, hit.bound) or vendor.is_open(fact.returns):
        raise NotExercised
    unlike = _unlike(vendor, hit, operation, fact)
    return [Wrong(f"{operation.name} to return {unlike[0]}", unlike[1], operation.place)] if unlike is not None else []


def _base_list(hit: Hit) -> tuple[str, ...]:
    interface = hit.entry.declaration
    return interface.bases if isinstance(interface, Interface) else ()


def _unlike(vendor: Vendor, hit: Hit, operation: Operation, fact: exp.Getter) -> tuple[str, str] | None:
    """What the result of a getter should be, and what it is; None if it is that."""
    expected, observed = show(fact.returns), show(operation.returns)
    if fact.bound is None:
        is_same = vendor.same(operation.returns, hit.entry.scope, fact.returns, hit.bound)
        return None if is_same else (expected, observed)
    name = getattr(operation.returns, "name", "")
    returned = resolve(name, hit.entry.scope, hit.bound) if name else None
    if returned is None or not isinstance(returned.entry.declaration, Interface):
        return expected, observed
    by_name = {one.entry.declaration.name.lower(): one for one in operations(returned)}
    for signature in fact.bound.signatures:
        unlike = _unlike_bound(vendor, by_name.get(vendor.like(signature.name, by_name)), signature)
        if unlike is not None:
            return f"{expected} {unlike[0]}", f"{observed} {unlike[1]}"
    attributes_by_name = {one.entry.declaration.name.lower(): one for one in attributes(returned)}
    for name, type_ in fact.bound.attributes:
        found = attributes_by_name.get(vendor.like(name, attributes_by_name))
        if found is None and not by_name and not attributes_by_name:
            continue  # attributes of interfaces may be left out (interpretation idl-interface-attributes)
        if found is None:
            return f"{expected} with an attribute {name}", f"{observed} without it"
        attribute = found.entry.declaration
        assert isinstance(attribute, Attribute)
        if not vendor.same(attribute.type, found.entry.scope, type_, found.bound):
            of = f"as the type of {attribute.name}"
            return f"{expected} with {show(type_)} {of}", f"{observed} with {show(attribute.type)} {of}"
    return None


def _unlike_bound(vendor: Vendor, hit: Hit | None, signature: exp.Signature) -> tuple[str, str] | None:
    """What the operation of a bound interface should have, with the types that are bound, and what it has; None if it has that."""
    if hit is None:
        return f"with an operation {signature.name}", "without it"
    operation = hit.entry.declaration
    assert isinstance(operation, Operation)
    if len(operation.parameters) != len(signature.parameters):
        return f"with {len(signature.parameters)} parameters of {operation.name}", f"with {len(operation.parameters)}"
    pairs = [("result", operation.returns, signature.returns)]
    pairs += [
        (p.name, p.type, type_) for p, (_, _, type_) in zip(operation.parameters, signature.parameters, strict=True)
    ]
    for what, found, wanted in pairs:
        if not vendor.same(found, hit.entry.scope, wanted, hit.bound):
            of = f"as {what} of {operation.name}"
            return f"with {show(wanted)} {of}", f"with {show(found)} {of}"
    return None


def no_getter(vendor: Vendor, fact: exp.NoGetter) -> list[Wrong]:
    """Whether there is no operation that hands out what is required, or has no API."""
    holder = _holder(vendor, fact.path, ())
    return [
        Wrong(f"no operation {one.entry.declaration.name}", "it is there", one.entry.declaration.place)
        for one in {id(hit.entry): hit for hit in _getters(vendor, holder, fact.names)}.values()
        if not _explained(vendor, fact, one)
    ]


def no_member(vendor: Vendor, fact: exp.NoMember) -> list[Wrong]:
    """Whether an interface has nothing that is called like a setting of the platform."""
    holder = _holder(vendor, fact.path, ())
    patterns = [vendor.pattern(name, usual=True) for name in fact.names]
    inside = holder.entry.inner.entries if holder.entry.inner is not None else ()
    return [
        Wrong(f"nothing called {entry.declaration.name}", "it is there", entry.declaration.place)
        for entry in inside
        if any(pattern.fullmatch(entry.declaration.name) for pattern in patterns)
    ]


def _explained(vendor: Vendor, fact: exp.NoGetter, hit: Hit) -> bool:
    """Whether another port's getter has the name by chance: a port's own name may hold an underscore."""
    name = hit.entry.declaration.name
    due = (n for one in vendor.expected.facts if isinstance(one, exp.Getter) for n in one.names)
    return any(vendor.pattern(n).fullmatch(name) for n in due)
