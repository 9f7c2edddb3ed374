"""Conformant tool chains that claim the standard properties of 10.2, and use the freedoms that the text leaves."""

from __future__ import annotations

import json

from ucm_cts.adapters.contract.metamodel import contracts as c
from ucm_cts.adapters.contract.metamodel.common import Element
from ucm_cts.adapters.contract.metamodel.names import Scope
from ucm_cts.adapters.mutants.toolchain import rewriting as rw
from ucm_cts.adapters.mutants.toolchain.checking import refusing
from ucm_cts.adapters.mutants.toolchain.documentation import PARAMETERS, PROPERTIES
from ucm_cts.adapters.mutants.toolchain.mappings.properties import TASKS, Said, begun, depending, main_file
from ucm_cts.adapters.mutants.toolchain.models.properties import lacking
from ucm_cts.adapters.mutants.toolchain.registry import complaining_where, named, variant
from ucm_cts.adapters.mutants.toolchain.variants.data import bare_text
from ucm_cts.adapters.reference.toolchain.program import Program
from ucm_cts.adapters.reference.toolchain.rules.contracts.actual_types import actual_type


@variant(claims=PROPERTIES, declares=("property-values=optional",))
def values_are_optional(program: Program) -> Program:
    """Lets values of the property be missing, as the reference tool chain does, and declares it."""
    return program


@variant(claims=PROPERTIES, declares=("property-values=required",))
@refusing
def all_values_are_required(annotation: c.Annotation, _: Scope) -> bool:
    """Refuses a property that lacks a value."""
    return lacking(annotation, *PARAMETERS)


@variant(claims=PROPERTIES, declares=("text-values=bare",))
def bare_texts_of_properties(program: Program) -> Program:
    """Reads texts without quotes, those of properties, too, which may then be nothing at all."""
    for name in ("values_fit_their_parameters", "values_are_given"):
        program = complaining_where(program, name, lambda wrong, _element, scope, _: not _sets_a_text(wrong, scope))
    return bare_text(program)


def _sets_a_text(value: Element, scope: Scope) -> bool:
    """Whether ``value`` is that of a parameter of an annotation which is a string."""
    if not isinstance(value, c.ConfigurationParameterValue):
        return False
    parameter = scope.member(value.configuration_parameter, c.AnnotationDefinition, "configuration_parameters")
    found = parameter and actual_type(getattr(parameter.element, "type", ""), parameter.scope)
    return found is not None and isinstance(found.element, c.StringType)


def _in_comments(files: rw.Files, documented: Said) -> rw.Files:
    """Writes what the property says into comments, where nothing in it can end them or go on with them."""
    lines = (f"// {name}: {parameter} {json.dumps(text)}.\n" for name, t in documented for parameter, text in t.items())
    return begun(files, "".join(lines))


def _laid_out(files: rw.Files, documented: Said) -> rw.Files:
    """Lays the files of documented models out in another way."""
    return {name: text.replace("\n", "\n\n") for name, text in files.items()} if documented else files


def _named_by_version(files: rw.Files, documented: Said) -> rw.Files:
    """Calls the file that follows from the model by a version."""
    name = main_file(files)
    others = {other: text for other, text in files.items() if other != name}
    return {**others, f"version_{len(documented)}_{name}": files[name]}


def _described(files: rw.Files, documented: Said) -> rw.Files:
    """Writes a page about the components beside the code."""
    return {"components.md": "".join(f"{name}: {texts}\n" for name, texts in documented), **files}


for _task in TASKS:
    for _change in (_in_comments, _laid_out, _named_by_version, *((_described,) if _task in rw.BOTH else ())):
        _name = f"documentation{_change.__name__}_{_task}"
        variant(task=_task, claims=PROPERTIES)(named(depending(_change, _task), _name, _change.__doc__))
