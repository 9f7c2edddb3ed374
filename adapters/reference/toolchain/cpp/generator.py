"""C++11 and C++03 from a well-formed model: one header with all declarations, each before it is used, and the support header."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from ucm_cts.adapters.contract.metamodel import components, contracts, interactions
from ucm_cts.adapters.contract.metamodel.aspects import TechnicalPolicyDefinition
from ucm_cts.adapters.contract.metamodel.common import Element, Named
from ucm_cts.adapters.contract.metamodel.modules import MODULES, Model
from ucm_cts.adapters.contract.metamodel.names import Declared, Names, each_element
from ucm_cts.adapters.reference.toolchain.clashes import refuse_clashes
from ucm_cts.adapters.reference.toolchain.cpp import interfaces
from ucm_cts.adapters.reference.toolchain.cpp.components import (
    Body,
    body_definition,
    body_of,
    clashing_names,
    ports_used,
)
from ucm_cts.adapters.reference.toolchain.cpp.names import identifier, namespace
from ucm_cts.adapters.reference.toolchain.cpp.support import SUPPORT_FILE, support
from ucm_cts.adapters.reference.toolchain.cpp.types import (
    ABSTRACT,
    CPP03,
    CPP11,
    DATA,
    INTERFACES,
    Standard,
    constant_definition,
    exception_definition,
    find,
    names_in_value,
    type_definition,
)
from ucm_cts.adapters.reference.toolchain.reaching import Reaching

LANGUAGES = ("c++", "cpp")
"""The beginnings of the language names that these generators serve, in any case."""

_DECLARED = (
    contracts.DataType,
    *ABSTRACT,
    contracts.Constant,
    contracts.Exception_,
    contracts.Interface,
    interactions.PortType,
    TechnicalPolicyDefinition,
    components.ComponentType,
    components.AtomicComponentImplementation,
    *MODULES,
)
"""What modules declare that headers have something of."""


def generate_cpp11(model: Model) -> Mapping[str, str]:
    """Files by their paths. Raises ``CannotBeMapped``."""
    refuse_clashes(model, identifier, "13.2.3", "C++11", members=False)
    return Generation(model, CPP11).files()


def generate_cpp03(model: Model) -> Mapping[str, str]:
    """Files by their paths; a source file is among them if there are constants that no header may define."""
    return Generation(model, CPP03).files()


@dataclass
class Piece:
    """A declaration: where it stands, its text, what must stand before it, and what goes to a source file."""

    place: tuple[str, ...]
    text: str
    after: Sequence[str] = ()
    source: str = ""


class Generation:
    """Generates from one model for one standard."""

    def __init__(self, model: Model, standard: Standard) -> None:
        self._model = model
        self._standard = standard
        self._names = Names(model)
        self._declared = list(self._walk())
        self._pieces: dict[str, Piece] = {}
        self._wanted: dict[str, tuple[Declared, interfaces.Bindings]] = {}
        self._of_port_elements: set[str] = set()
        self._abstract = Reaching(self._parts, lambda one: "abstract" if isinstance(one.element, ABSTRACT) else "")

    def files(self) -> Mapping[str, str]:
        """All files, by their paths."""
        bodies = [body_of(d) for d in self._declared if is_ours(d.element)]
        self._want_interfaces(bodies)
        for declared in self._declared:
            self._enter(declared)
        for interface, bindings in self._wanted.values():
            self._enter_interface(interface, bindings)
        self._enter_bodies(bodies)
        name = header_name(self._model)
        made = {SUPPORT_FILE: support(self._standard.modern), f"{name}.hpp": self._header(name)}
        sources = [piece for piece in self._pieces.values() if piece.source]
        if sources:
            defined = "".join(_in_namespace(p.place, p.source) for p in sources)
            made[f"{name}.cpp"] = f'#include "{name}.hpp"\n\n{defined}'
        return made

    def _walk(self) -> Iterator[Declared]:
        """What modules declare, and the modules inside others; of what is declared twice the first."""
        seen: set[tuple[type[Element], str]] = set()
        for element, scope in each_element(self._model, self._names, *_DECLARED):
            if isinstance(element, Named) and scope.around is not None:
                declared = Declared(element, scope)
                key = type(element), declared.path
                if key not in seen:
                    seen.add(key)
                    yield declared

    def _want_interfaces(self, bodies: Sequence[Body]) -> None:
        for declared in self._declared:
            element = declared.element
            if isinstance(element, contracts.Interface):
                self._want(declared, (), False)
            elif isinstance(element, interactions.PortType | TechnicalPolicyDefinition):
                for port_element in element.port_elements:
                    self._want(find(port_element.interface, declared.scope, *INTERFACES), (), True)
            elif isinstance(element, components.ComponentType):
                for used in ports_used(declared):
                    if used.interface is not None:
                        self._want(used.interface, used.bindings, True)
        for body in bodies:
            for used in body.used:
                if used.interface is not None:
                    self._want(used.interface, used.bindings, True)

    def _want(self, interface: Declared, bindings: interfaces.Bindings, of_port_element: bool) -> None:
        if of_port_element and interfaces.is_complete(interface, bindings):
            self._of_port_elements.add(_key(interface, bindings))
        waiting = [interface]
        while waiting:
            one = waiting.pop()
            key = _key(one, bindings)
            if key in self._wanted or not interfaces.is_complete(one, bindings):
                continue
            self._wanted[key] = (one, interfaces.needed(one, bindings))
            used = [used for used in self._mentioned(one, bindings) if isinstance(used.element, contracts.Interface)]
            waiting += reversed(used)

    def _mentioned(self, interface: Declared, bindings: interfaces.Bindings) -> Iterator[Declared]:
        element = interface.element
        assert isinstance(element, contracts.Interface)
        yield from interfaces.base_interfaces(interface)
        for reference in interfaces.mentioned(element):
            yield interfaces.resolve(reference, interface.scope, bindings)

    def _enter(self, declared: Declared) -> None:
        element, place = declared.element, namespace(declared.scope.path)
        if isinstance(element, contracts.DataType) and not self._is_abstract(declared):
            self._pieces[declared.path] = Piece(
                place, type_definition(declared, self._standard), self._part_paths(declared)
            )
        elif isinstance(element, contracts.Exception_):
            text = exception_definition(declared, self._standard)
            self._pieces[declared.path] = Piece(place, text, self._part_paths(declared))
        elif isinstance(element, contracts.Constant):
            constant = constant_definition(declared, self._standard)
            after = [*self._part_paths(declared), *self._constants_in(element.value, declared)]
            self._pieces[declared.path] = Piece(place, constant.declaration, after, constant.definition)

    def _part_paths(self, declared: Declared) -> list[str]:
        return [part.path for part in self._parts(declared)]

    def _parts(self, declared: Declared) -> Iterator[Declared]:
        """The data types that ``declared`` is made of, each reference to one once."""
        element, scope = declared.element, declared.scope
        named = [getattr(f, "type", "") for f in (*getattr(element, "fields", ()), *getattr(element, "cases", ()))]
        named += [getattr(element, "type", ""), getattr(element, "selector_type", "")]
        return (find(reference, scope, *DATA) for reference in dict.fromkeys(named) if reference)

    def _constants_in(self, value: str, declared: Declared) -> Iterator[str]:
        for name in names_in_value(value):
            found = declared.scope.find(name, contracts.Constant)
            if found is not None:
                yield found.path

    def _is_abstract(self, declared: Declared) -> bool:
        """Whether an abstract type is part of ``declared``, so that nothing can be generated for it alone."""
        return bool(self._abstract.marks(declared))

    def _enter_interface(self, interface: Declared, bindings: interfaces.Bindings) -> None:
        key = _key(interface, bindings)
        text = interfaces.interface_definition(interface, bindings, key in self._of_port_elements, self._standard)
        bases = {_key(base, bindings) for base in interfaces.base_interfaces(interface)}
        types = [u.path for u in self._mentioned(interface, bindings) if isinstance(u.element, contracts.DataType)]
        self._pieces[key] = Piece(namespace(interface.scope.path), text, [*sorted(bases), *types])

    def _enter_bodies(self, bodies: Sequence[Body]) -> None:
        beside: dict[tuple[str, ...], list[Body]] = {}
        for body in bodies:
            beside.setdefault(namespace(body.declared.scope.path), []).append(body)
        clashing = {place: clashing_names(there, self._standard) for place, there in beside.items()}
        for body in bodies:
            place = namespace(body.declared.scope.path)
            text = body_definition(body, clashing[place], self._standard)
            self._pieces[f"body {body.declared.path}"] = Piece(place, text)

    def _header(self, name: str) -> str:
        guard = f"{name.upper()}_HPP"
        first = [f"#ifndef {guard}\n#define {guard}\n\n", f'#include "{SUPPORT_FILE}"\n\n']
        for declared in self._declared:
            if isinstance(declared.element, MODULES):
                first.append(_in_namespace(namespace(declared.path), ""))
        for module in self._model.modules:
            first.append(_in_namespace(namespace(f"::{module.name}"), ""))
        for interface, bindings in self._wanted.values():
            first.append(
                _in_namespace(namespace(interface.scope.path), f"class {interfaces.class_name(interface, bindings)};\n")
            )
        return "".join([*first, "\n", *self._ordered(), "\n#endif\n"])

    def _ordered(self) -> Iterator[str]:
        """The declarations, each after what it needs; those of one namespace that follow each other stand in one block."""
        place: tuple[str, ...] | None = None
        waiting: list[str] = []
        for piece in _in_order(self._pieces):
            if piece.place != place and waiting:
                yield _in_namespace(place or (), "\n" + "\n".join(waiting) + "\n")
                waiting = []
            place = piece.place
            waiting.append(piece.text)
        if waiting:
            yield _in_namespace(place or (), "\n" + "\n".join(waiting) + "\n")


def _in_order(pieces: Mapping[str, Piece]) -> list[Piece]:
    ordered: list[Piece] = []
    entered: set[str] = set()

    def enter(start: str) -> None:
        waiting: list[tuple[str, bool]] = [(start, False)]
        while waiting:
            key, done = waiting.pop()
            if done:
                ordered.append(pieces[key])
            elif key in pieces and key not in entered:
                entered.add(key)
                waiting.append((key, True))
                waiting.extend((other, False) for other in reversed(tuple(pieces[key].after)))

    for key in sorted(pieces, key=lambda key: key.startswith("body ")):
        enter(key)
    return ordered


def _key(interface: Declared, bindings: interfaces.Bindings) -> str:
    return f"interface {interface.path} {' '.join(actual.path for _, actual in interfaces.needed(interface, bindings))}"


def _in_namespace(place: tuple[str, ...], text: str) -> str:
    opened = " ".join(f"namespace {part} {{" for part in place)
    return f"{opened}\n{text}" + "}" * len(place) + "\n" if text else f"{opened} {'}' * len(place)}\n"


def header_name(model: Model) -> str:
    """What the header with all declarations is called, without its ending."""
    return identifier(model.modules[-1].name) if model.modules else "model"


def is_ours(element: Element) -> bool:
    """Whether bodies of ``element`` are written in C++, as far as its language says."""
    if not isinstance(element, components.AtomicComponentImplementation):
        return False
    language = element.language.rpartition("::")[2].lower()
    return not language or language.startswith(LANGUAGES)
