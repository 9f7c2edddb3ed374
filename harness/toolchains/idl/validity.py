"""Checks parsed IDL: no declaration twice, each name declared, and before it is used, no other building blocks."""

from __future__ import annotations

from collections.abc import Iterator

from ucm_cts.harness.toolchains.idl.language.reading import Files
from ucm_cts.harness.toolchains.idl.language.scopes import Entry, Scope, build, every, resolve
from ucm_cts.harness.toolchains.idl.language.showing import type_of
from ucm_cts.harness.toolchains.idl.results import Wrong
from ucm_cts.harness.toolchains.idl.vendor import Vendor
from ucm_cts.reference_models.mapping.idl import declarations as idl

COMPONENTS = ("component", "connector", "porttype")
"""What the equivalent syntax of clause 9 declares (interpretation idl-equivalent-syntax)."""

OTHER_TYPES = ("any", "Object")


def invalid(vendor: Vendor, read: Files) -> Iterator[Wrong]:
    """What is declared twice, and names that mean nothing; those in or of files that are not there are let alone."""
    yield from _twice(vendor.root)
    if read.missing or read.problems:
        return
    for entry in every(vendor.root):
        if isinstance(entry.declaration, idl.AnnotationDefinition) or _in_annotation(entry):
            continue
        for name in _names(vendor, entry):
            place = entry.declaration.place
            yield Wrong("every name to mean something", f"'{name}' in {entry.declaration.name}", place)
        for name in _late(entry):
            observed = f"{entry.declaration.name} uses '{name}', which is declared after it"
            yield Wrong("each name to be declared before it is used", observed, entry.declaration.place)


def not_included(vendor: Vendor, read: Files) -> Iterator[Wrong]:
    """Names in a file that no other one includes, if only files that it does not include declare them: it is no IDL by itself."""
    roots = read.left.roots
    if len(roots) < 2 or read.missing or read.problems:
        return
    for root in roots:
        within = _included(root, read)
        own = build({name: found for name, found in read.declarations.items() if name in within})
        alone = Vendor(own, vendor.expected, vendor.readings, unreadable=False, missing=False)
        for entry in every(own):
            if isinstance(entry.declaration, idl.AnnotationDefinition) or _in_annotation(entry):
                continue
            for name in _names(alone, entry):
                observed = f"'{name}' in {entry.declaration.name}, which {root} neither declares nor includes"
                yield Wrong("each file to include what it uses", observed, entry.declaration.place)
                break


def _included(root: str, read: Files) -> set[str]:
    """The file ``root`` and all that it includes, itself or by way of others."""
    found, waiting = {root}, [root]
    while waiting:
        new = {name for _, name in read.left.includes.get(waiting.pop(), ())} - found
        found |= new
        waiting += new
    return found


def _late(entry: Entry) -> Iterator[str]:
    """The names in a declaration that the same file declares only after it; interfaces that are no bases need only be announced."""
    declaration = entry.declaration
    in_full = _scoped(declaration)
    type_ = type_of(declaration)
    announced = [] if type_ is None else list(_of_type(type_))
    for name in (*in_full, *announced):
        hit = resolve(name, entry.scope)
        if hit is None or isinstance(hit.entry.declaration, (idl.Module, idl.ModuleInstance)):
            continue
        found = hit.entry.declaration
        known = [found] if name in in_full else [found, *_announcing(hit.entry)]
        here = [one.place for one in known if one.place.file == declaration.place.file and one.place.line]
        if len(here) == len(known) and all(_position(place) > _position(declaration.place) for place in here):
            yield name


def _announcing(entry: Entry) -> list[idl.Declaration]:
    """The forward declarations of what ``entry`` declares."""
    same_name = entry.scope.members.get(entry.declaration.name.lower(), [])
    return [one.declaration for one in same_name if isinstance(one.declaration, idl.Forward)]


def _position(place: idl.Place) -> tuple[int, int]:
    return place.line, place.column


def _in_annotation(entry: Entry) -> bool:
    owner = entry.scope.owner
    return owner is not None and isinstance(owner.declaration, idl.AnnotationDefinition)


def _twice(scope: Scope) -> Iterator[Wrong]:
    for entries in scope.members.values():
        met: dict[str, idl.Declaration] = {}
        for entry in entries:
            declaration = entry.declaration
            if isinstance(declaration, (idl.Forward, idl.AnnotationDefinition)):
                continue
            first = met.setdefault(declaration.place.file, declaration)
            if first is not declaration:
                observed = f"{declaration.name} again, after line {first.place.line}"
                yield Wrong("each name to be declared once", observed, declaration.place)
            if entry.inner is not None and isinstance(
                declaration, (idl.Module, idl.Interface, idl.Struct, idl.Union, idl.Operation)
            ):
                yield from _twice(entry.inner)


def _names(vendor: Vendor, entry: Entry) -> Iterator[str]:
    """The names in a declaration that mean nothing."""
    declaration, scope = entry.declaration, entry.scope
    types = [type_of(declaration), getattr(declaration, "selector", None)]
    types += declaration.arguments if isinstance(declaration, idl.ModuleInstance) else ()
    for type_ in types:
        if type_ is not None and not vendor.known(type_, scope):
            yield from _of_type(type_)
    scoped = list(_scoped(declaration))
    expressions = [declaration.value] if isinstance(declaration, idl.Constant) else []
    around = scope
    if isinstance(declaration, idl.Case):
        expressions = [label for label in declaration.labels if label is not None]
        selector = _selector(scope)
        around = selector.scope if selector is not None else scope
    scoped += [name for expression in expressions for name in _of_expression(expression)]
    yield from (name for name in scoped if resolve(name, scope) is None and resolve(name, around) is None)


def _selector(scope: Scope) -> Entry | None:
    """The enumeration that selects the cases of a union: its enumerators may stand in the cases without their scope."""
    union = scope.owner
    if union is None or not isinstance(union.declaration, idl.Union):
        return None
    hit = resolve(getattr(union.declaration.selector, "name", ""), union.scope)
    return hit.entry if hit is not None else None


def _scoped(declaration: idl.Declaration) -> tuple[str, ...]:
    match declaration:
        case idl.Interface():
            return declaration.bases
        case idl.Operation():
            return declaration.raises
        case idl.ModuleInstance():
            return (declaration.template,)
        case idl.Struct():
            return (declaration.base,) if declaration.base else ()
    return ()


def _of_type(type_: idl.Type) -> Iterator[str]:
    match type_:
        case idl.Named():
            yield type_.name
        case idl.SequenceOf() | idl.ArrayOf():
            yield from _of_type(type_.element)
        case idl.Annotated():
            yield from _of_type(type_.type)


def _of_expression(expression: idl.Expression) -> Iterator[str]:
    waiting = [expression]
    while waiting:
        match waiting.pop():
            case idl.Named(name):
                yield name
            case idl.Unary(_, operand):
                waiting.append(operand)
            case idl.Binary(_, left, right):
                waiting += [left, right]


def building_blocks(vendor: Vendor, read: Files) -> Iterator[Wrong]:
    """What belongs to other building blocks than those that 12.1 retains, and template modules (12.7)."""
    for entry in every(vendor.root):
        declaration = entry.declaration
        if isinstance(declaration, idl.Extended):
            if declaration.kind not in COMPONENTS or vendor.reading("idl-output") != "both":
                yield _other(declaration, idl.kind_of(declaration))
        elif isinstance(declaration, idl.Operation) and declaration.oneway:
            yield _other(declaration, "a oneway operation")
        else:
            type_ = type_of(declaration)
            if isinstance(type_, idl.Basic) and type_.name in OTHER_TYPES:
                yield _other(declaration, type_.name)


def _other(declaration: idl.Declaration, what: str) -> Wrong:
    return Wrong(
        "core data types, annotations, basic interfaces and template modules only",
        f"{what} {declaration.name}",
        declaration.place,
    )
