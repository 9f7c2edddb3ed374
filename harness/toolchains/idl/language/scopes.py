"""What names mean in a vendor's IDL: scopes, inherited ones too, template modules and their instances."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from ucm_cts.reference_models.mapping.idl import declarations as idl

MOST_STEPS = 100
"""Steps that following names, bases or aliases may take before it counts as a circle."""


@dataclass(eq=False)
class Scope:
    """What declares names: the root, a module, an interface, an operation, or anything with members."""

    around: Scope | None = None
    owner: Entry | None = None
    members: dict[str, list[Entry]] = field(default_factory=dict)

    def own(self, name: str) -> Entry | None:
        """The declaration of ``name`` here, rather than one that only announces it; IDL does not tell cases apart."""
        entries = self.members.get(name.lower(), [])
        return next((e for e in entries if not isinstance(e.declaration, idl.Forward)), entries[0] if entries else None)

    @property
    def entries(self) -> Iterator[Entry]:
        """All that is declared here, directly."""
        for entries in self.members.values():
            yield from entries


@dataclass(eq=False)
class Entry:
    """A declaration where it stands; ``inner`` is the scope that it opens, if it does. ``followed`` is set while the template of
    an instance is searched, to end circles.
    """

    declaration: idl.Declaration
    scope: Scope
    inner: Scope | None = None
    followed: bool = False

    @property
    def path(self) -> tuple[str, ...]:
        """Its name from the root."""
        names: list[str] = []
        entry: Entry | None = self
        while entry is not None:
            names.append(entry.declaration.name)
            entry = entry.scope.owner
        return tuple(reversed(names))


@dataclass(frozen=True)
class Actual:
    """What stands for the parameter of a template: a type, and where its names are looked up."""

    type: idl.Type
    scope: Scope
    bound: Bound


Bound = Mapping[str, Actual]
"""Arguments of template instances by the parameters' names in lower case."""

NOTHING: Bound = {}


@dataclass(frozen=True)
class Hit:
    """What a name means, seen through the template instances that led to it."""

    entry: Entry
    bound: Bound = field(default_factory=dict)


def build(files: Mapping[str, Sequence[idl.Declaration]]) -> Scope:
    """The root scope of all files together; a module that is opened again goes on."""
    root = Scope()
    for declarations in files.values():
        for declaration in declarations:
            _enter(declaration, root)
    return root


def _enter(declaration: idl.Declaration, scope: Scope) -> None:
    known = scope.members.setdefault(declaration.name.lower(), [])
    if isinstance(declaration, idl.Module):
        entry = next((e for e in known if isinstance(e.declaration, idl.Module)), None)
        if entry is None:
            entry = Entry(declaration, scope)
            entry.inner = Scope(scope, entry)
            known.append(entry)
        assert entry.inner is not None
        for one in (*(p for p in declaration.parameters if entry.inner.own(p.name) is None), *declaration.body):
            _enter(one, entry.inner)
        return
    entry = Entry(declaration, scope)
    known.append(entry)
    inner = _inside(declaration)
    if inner:
        entry.inner = Scope(scope, entry)
        for one in inner:
            _enter(one, entry.inner)
    if isinstance(declaration, idl.Enum):
        for enumerator in declaration.enumerators:
            scope.members.setdefault(enumerator.name.lower(), []).append(Entry(enumerator, scope))


def _inside(declaration: idl.Declaration) -> Sequence[idl.Declaration]:
    match declaration:
        case idl.Struct() | idl.Exception_() | idl.AnnotationDefinition():
            return declaration.members
        case idl.Union():
            return declaration.cases
        case idl.Interface():
            return declaration.body
        case idl.Operation():
            return declaration.parameters
    return ()


def resolve(name: str, scope: Scope, bound: Bound = NOTHING) -> Hit | None:
    """What the scoped ``name`` means in ``scope``; None if nothing, or if it is no name."""
    parts = name.split("::")
    if name in ("", "::"):
        return None
    if not parts[0]:
        around = scope
        while around.around is not None:
            around = around.around
        return _descend(_start(around, parts[1], bound), parts[2:])
    current: Scope | None = scope
    while current is not None:
        if current.owner is None or isinstance(current.owner.declaration, (idl.Module, idl.Interface)):
            found = _descend(_start(current, parts[0], bound), parts[1:])
            if found is not None:
                return found
        current = current.around
    return None


def _start(scope: Scope, name: str, bound: Bound) -> Hit | None:
    owner = scope.owner
    if owner is not None and isinstance(owner.declaration, idl.Interface):
        return member(Hit(owner, bound), name)
    entry = scope.own(name)
    return Hit(entry, bound) if entry is not None else None


def _descend(hit: Hit | None, parts: Sequence[str]) -> Hit | None:
    for part in parts:
        if hit is None:
            return None
        hit = member(hit, part)
    return hit


def member(hit: Hit, name: str) -> Hit | None:
    """What ``name`` means in the scope that ``hit`` opens, inherited names included."""
    if isinstance(hit.entry.declaration, idl.ModuleInstance):
        template = _instantiated(hit)
        return member(template, name) if template is not None else None
    inner = hit.entry.inner
    entry = inner.own(name) if inner is not None else None
    if entry is not None:
        return Hit(entry, hit.bound)
    for base in bases(hit):
        entry = base.entry.inner.own(name) if base.entry.inner is not None else None
        if entry is not None:
            return Hit(entry, base.bound)
    return None


def _instantiated(hit: Hit) -> Hit | None:
    instance = hit.entry.declaration
    assert isinstance(instance, idl.ModuleInstance)
    if hit.entry.followed:
        return None
    hit.entry.followed = True
    try:
        template = resolve(instance.template, hit.entry.scope, hit.bound)
    finally:
        hit.entry.followed = False
    if template is None or not isinstance(template.entry.declaration, idl.Module):
        return None
    parameters = template.entry.declaration.parameters
    actual = (Actual(argument, hit.entry.scope, hit.bound) for argument in instance.arguments)
    given = {p.name.lower(): a for p, a in zip(parameters, actual, strict=False)}
    return Hit(template.entry, {**template.bound, **given})


def bases(hit: Hit) -> list[Hit]:
    """The interfaces that an interface inherits from, directly or not, nearest first, each once."""
    found: dict[int, Hit] = {}
    waiting = [hit]
    while waiting:
        current = waiting.pop(0)
        declaration = current.entry.declaration
        if not isinstance(declaration, idl.Interface):
            continue
        for name in declaration.bases:
            base = resolve(name, current.entry.scope, current.bound)
            if base is not None and id(base.entry) not in found and base.entry is not hit.entry:
                found[id(base.entry)] = base
                waiting.append(base)
    return list(found.values())


def base_names(hit: Hit) -> set[str]:
    """The last part, in lower case, of the name of each interface that ``hit`` inherits from, whether it is there or not."""
    names = {base.entry.declaration.name.lower() for base in bases(hit)}
    for one in (hit, *bases(hit)):
        declaration = one.entry.declaration
        if isinstance(declaration, idl.Interface):
            names |= {name.rsplit("::", 1)[-1].lower() for name in declaration.bases}
    return names


def every(scope: Scope) -> Iterator[Entry]:
    """All entries in ``scope`` and inside them."""
    for entry in scope.entries:
        yield entry
        if entry.inner is not None:
            yield from every(entry.inner)


def is_parameter(hit: Hit | None) -> bool:
    """Whether ``hit`` is the parameter of a template."""
    return hit is not None and isinstance(hit.entry.declaration, idl.TemplateParameter)
