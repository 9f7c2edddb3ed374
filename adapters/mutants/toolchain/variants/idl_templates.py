"""Tool chains that make and name template modules (12.7) otherwise than the reference one, and declare it."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace

from ucm_cts.adapters.contract.metamodel.aspects import TechnicalPolicyDefinition
from ucm_cts.adapters.contract.metamodel.common import Element, Named, children, walk
from ucm_cts.adapters.contract.metamodel.contracts import Constant, Exception_
from ucm_cts.adapters.contract.metamodel.interactions import ConnectorDefinition, PortType
from ucm_cts.adapters.contract.metamodel.modules import MODULES, Module
from ucm_cts.adapters.contract.metamodel.names import Declared
from ucm_cts.adapters.mutants.toolchain import rewriting as rw
from ucm_cts.adapters.mutants.toolchain.registry import variant
from ucm_cts.adapters.reference.toolchain.idl.generator import generate
from ucm_cts.adapters.reference.toolchain.idl.names import ABSTRACT, TYPES, Templates
from ucm_cts.adapters.reference.toolchain.program import Program


@variant(task="idl", declares=("idl-template-names=first",))
@rw.rewriting
def first_letters_are_capitals(files: rw.Files) -> rw.Files:
    """Template parameters have the model's names with a capital in front."""
    text = files[rw.MODEL]
    lists = re.findall(r"\bmodule \w+<([^>]*)> \{", text)
    for name in {name for given in lists for name in re.findall(r"(?:typename|interface) (\w+)", given)}:
        text = re.sub(rf"(?<![\w:]){name}\b", name.capitalize(), text)
    return {**files, rw.MODEL: text}


class _Containing(Templates):
    """Whatever a module holds, and what that uses in any roundabout way, makes it a template."""

    def parameters(self, module: Module) -> list[Declared]:
        scope = self._names.inside(module)
        found: dict[str, Declared] = {}
        for element in children(module):
            if isinstance(element, MODULES):
                found |= {one.path: one for one in self.parameters(element)}
            elif isinstance(element, Named):
                found |= {one.path: one for one in _reached(Declared(element, scope))}
        return list(found.values())


_USING = (*TYPES, Constant, Exception_, PortType, TechnicalPolicyDefinition, ConnectorDefinition)
_REFERENCES = ("type", "selector_type", "exception", "interface", "connector_item", "api")


def _reached(declared: Declared) -> Iterator[Declared]:
    """The abstract types that ``declared`` is or uses, itself or in what it uses."""
    waiting, met = [declared], set[tuple[str, type[Element]]]()
    while waiting:
        current = waiting.pop()
        key = current.path, type(current.element)
        if key in met or not isinstance(current.element, _USING):
            continue
        met.add(key)
        if isinstance(current.element, ABSTRACT):
            yield current
        for part in walk(current.element):
            for name in _REFERENCES:
                found = current.scope.find(getattr(part, name, "") or "", *TYPES, Exception_, PortType)
                waiting += [found] if found is not None else []


@variant(task="idl", declares=("idl-template-propagation=containment",))
def templates_around_all_templates(program: Program) -> Program:
    """A module that holds a template, or uses an abstract type in any roundabout way, is a template, too."""
    generators = {**program.generators, "idl": lambda model: generate(model, _Containing)}
    return replace(program, generators=generators)
