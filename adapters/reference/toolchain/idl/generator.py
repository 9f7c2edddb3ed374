"""Generates IDL 4 of a well-formed model (clause 12): one file for the model, and one for the container programming model.

IDL wants declarations before their use and UCM does not, so declarations are put in an order of their own and modules are opened
again as often as that needs; interfaces that only appear in signatures are announced. Template modules cannot be
opened again, so they are written in one piece.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, field

from ucm_cts.adapters.contract.metamodel import components as mc
from ucm_cts.adapters.contract.metamodel.common import Named, children
from ucm_cts.adapters.contract.metamodel.contracts import Constant, DataType, Exception_, Interface
from ucm_cts.adapters.contract.metamodel.modules import MODULES, Model, Module
from ucm_cts.adapters.contract.metamodel.names import Declared, Names, Scope
from ucm_cts.adapters.reference.toolchain.clashes import refuse_clashes
from ucm_cts.adapters.reference.toolchain.idl.components import PORT_ELEMENT_OBJECT, Components, port_element_interfaces
from ucm_cts.adapters.reference.toolchain.idl.names import Templates, folded, identifier, parameter
from ucm_cts.adapters.reference.toolchain.idl.references import Reference, references
from ucm_cts.adapters.reference.toolchain.idl.standard import STANDARD
from ucm_cts.adapters.reference.toolchain.idl.types import Lines, constant, data_type, exception, interface
from ucm_cts.adapters.reference.toolchain.reaching import Reaching

DECLARED = (DataType, Constant, Exception_, Interface, mc.ComponentType, mc.AtomicComponentImplementation)
"""What becomes a declaration."""

HEAD = ["#ifndef MODEL_IDL", "#define MODEL_IDL", '#include "ucm.idl"', ""]


def generate(model: Model, templates: type[Templates] = Templates) -> Mapping[str, str]:
    """The files of ``model``, by their names; ``templates`` says which modules become templates. Raises ``CannotBeMapped``."""
    refuse_clashes(model, folded, "12.2", "IDL", members=True)
    return files_of(model, templates)


def files_of(model: Model, templates: type[Templates] = Templates) -> Mapping[str, str]:
    """The files of ``model``, by their names, in which names may clash; ``templates`` as for ``generate``."""
    writer = Writer(model, templates)
    lines = [*HEAD, *writer.written(), "", "#endif", ""]
    return {"ucm.idl": STANDARD, "model.idl": "\n".join(lines)}


@dataclass(eq=False, slots=True)
class Unit:
    """What is written in one piece in the modules of ``path``: a declaration, or a template module with all that it holds.

    ``references`` is None as long as nobody asked for them.
    """

    path: tuple[str, ...]
    element: Named
    scope: Scope
    inside: list[Unit] = field(default_factory=list)
    references: list[Reference] | None = None


class Writer:
    """Puts the declarations of a model in order and writes them."""

    def __init__(self, model: Model, templates: type[Templates]) -> None:
        self._names = Names(model)
        self._templates = templates(self._names)
        self._components = Components(model, self._names, self._templates)
        self._with_base = port_element_interfaces(model, self._names)
        self._bases = Reaching(_parents, lambda one: "has the base" if one.path in self._with_base else "")
        self._units: dict[int, list[Unit]] = {}
        self._top = [unit for module in model.modules for unit in self._of_module(module, self._names.root, ())]
        self._done: set[int] = set()
        self._announced: set[int] = set()

    def _of_module(self, module: Module, around: Scope, path: tuple[str, ...]) -> Iterator[Unit]:
        """The units of a module: itself if it is a template, else those of what it holds."""
        scope = self._names.inside(module)
        inner = (*path, identifier(module.name))
        template = bool(self._templates.parameters(module))
        units: list[Unit] = []
        for child in children(module):
            if isinstance(child, MODULES):
                units += self._of_module(child, scope, () if template else inner)
            elif isinstance(child, DECLARED):
                units.append(Unit(() if template else inner, child, scope))
        for unit in units:
            self._enter(unit, unit)
        if template:
            units = [Unit(path, module, around, units)]
            self._enter(units[0], units[0])
        yield from units

    def _enter(self, unit: Unit, whole: Unit) -> None:
        """Note that ``unit`` is a part of ``whole``, or the same."""
        known = self._units.setdefault(id(unit.element), [])
        if not any(one is whole for one in known):
            known.append(whole)
        for one in unit.inside:
            self._enter(one, whole)

    def _unit(self, declared: Declared, here: Collection[int]) -> Unit | None:
        """The unit among those ``here``, by their identities, in which ``declared`` is written; None if it is in none."""
        return next((unit for unit in self._units.get(id(declared.element), ()) if id(unit) in here), None)

    def written(self) -> Lines:
        """All declarations of the model."""
        return self._wrapped(self._ordered(self._top))

    def _ordered(self, units: list[Unit]) -> Iterator[tuple[tuple[str, ...], Lines]]:
        """Units with all that they need before them, each with the modules around it."""
        here = {id(unit) for unit in units}
        waiting = [(unit, False) for unit in reversed(units)]
        begun: set[int] = set()
        while waiting:
            unit, ready = waiting.pop()
            if id(unit) in self._done or (not ready and id(unit) in begun):
                continue
            if ready:
                self._done.add(id(unit))
                yield from self._announcements(unit, here)
                unit.references = []  # nobody asks again
                yield unit.path, self._text(unit)
                continue
            begun.add(id(unit))
            waiting.append((unit, True))
            waiting += [(one, False) for one in reversed(self._needed(unit, here))]

    def _needed(self, unit: Unit, here: Collection[int]) -> list[Unit]:
        """The units that must stand before ``unit``; interfaces in signatures need only be announced."""
        found = []
        for declared, strong in self._references(unit):
            whole = self._unit(declared, here)
            if whole is not None and whole is not unit and (strong or whole.inside):
                found.append(whole)
        return found

    def _announcements(self, unit: Unit, here: Collection[int]) -> Iterator[tuple[tuple[str, ...], Lines]]:
        for declared, strong in self._references(unit):
            whole = self._unit(declared, here)
            if whole is None or strong or whole.inside or whole is unit:
                continue
            if id(whole) not in self._done and id(whole) not in self._announced:
                self._announced.add(id(whole))
                yield whole.path, [f"interface {identifier(declared.element.name)};"]

    def _references(self, unit: Unit) -> list[Reference]:
        """What the elements of ``unit`` refer to."""
        if unit.references is None:
            unit.references = list(self._find_references(unit))
        return unit.references

    def _find_references(self, unit: Unit) -> Iterator[Reference]:
        for part in unit.inside:
            yield from self._references(part)
        if not unit.inside:
            yield from references(unit.element, unit.scope)
        if isinstance(unit.element, mc.AtomicComponentImplementation):
            for policy, scope in self._components.policies(unit.element, unit.scope):
                yield from references(policy, scope)

    def _text(self, unit: Unit) -> Lines:
        element, scope = unit.element, unit.scope
        match element:
            case DataType():
                return data_type(element, scope)
            case Constant():
                return constant(element, scope)
            case Exception_():
                return exception(element, scope)
            case Interface():
                bases = [PORT_ELEMENT_OBJECT] if self._is_first_with_base(Declared(element, scope)) else []
                return interface(element, scope, bases)
            case mc.ComponentType():
                return self._components.component_type(element, scope)
            case mc.AtomicComponentImplementation():
                return self._components.body(element, scope)
        return self._template(unit)

    def _is_first_with_base(self, declared: Declared) -> bool:
        """Whether a port element uses the interface and none of its ancestors is used so."""
        return declared.path in self._with_base and not self._bases.marks(declared)

    def _template(self, unit: Unit) -> Lines:
        module = unit.element
        assert isinstance(module, MODULES)
        lines = self._wrapped(self._ordered(unit.inside))
        if not lines:
            return []
        given = ", ".join(
            f"{'interface' if type(one.element).__name__ == 'AbstractInterface' else 'typename'} {parameter(one.element)}"
            for one in self._templates.parameters(module)
        )
        return [f"module {identifier(module.name)}<{given}> {{", *(f"    {line}" for line in lines), "};"]

    def _wrapped(self, pieces: Iterator[tuple[tuple[str, ...], Lines]]) -> Lines:
        """The pieces in their modules; neighbours share those that they have in common."""
        lines, around = Lines(), tuple[str, ...]()
        for path, text in pieces:
            if not text:
                continue
            common = 0
            while common < min(len(path), len(around)) and path[common] == around[common]:
                common += 1
            lines += [f"{'    ' * level}}};" for level in range(len(around) - 1, common - 1, -1)]
            lines += [f"{'    ' * level}module {path[level]} {{" for level in range(common, len(path))]
            lines += [f"{'    ' * len(path)}{line}" for line in text]
            around = path
        return lines + [f"{'    ' * level}}};" for level in range(len(around) - 1, -1, -1)]


def _parents(interface: Declared) -> list[Declared]:
    """The interfaces that ``interface`` inherits directly."""
    element, scope = interface
    assert isinstance(element, Interface)
    found = (scope.find(one.interface, Interface) for one in element.inherited_interfaces)
    return [one for one in found if one is not None]
