"""Tool chains whose C++ uses freedoms of clause 13: other forms, more than is asked, other files. Nothing may fail them."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import replace

from ucm_cts.adapters.contract.metamodel.common import walk
from ucm_cts.adapters.contract.metamodel.contracts import Annotation
from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.mutants.toolchain.registry import named, variant
from ucm_cts.adapters.mutants.toolchain.rewriting import BOTH, Files, Wrong, edited, rewriting, sentence, table
from ucm_cts.adapters.reference.toolchain.cpp.support import SUPPORT_FILE
from ucm_cts.adapters.reference.toolchain.program import Program


def _framework(files: Files) -> Files:
    """What components need stands in a namespace of the framework."""
    head, _, rest = files[SUPPORT_FILE].rpartition("namespace ucm {")
    moved = rest.replace("}  // namespace ucm", "} }").replace(" shared_ptr<", " ::ucm::shared_ptr<")
    moved = moved.replace("(::std::string name, shared_ptr<", "(::std::string name, ::ucm::shared_ptr<")
    named = {name: re.sub(r"::ucm::Port", "::framework::detail::Port", text) for name, text in files.items()}
    return {**named, SUPPORT_FILE: f"{head}namespace framework {{ namespace detail {{{moved}"}


def _one_file(files: Files) -> Files:
    """Everything stands in one header."""
    included = f'#include "{SUPPORT_FILE}"\n'
    return {name: text.replace(included, files[SUPPORT_FILE]) for name, text in files.items() if name != SUPPORT_FILE}


def _many_files(files: Files) -> Files:
    """Headers stand in folders and include each other."""
    made = {}
    for name, text in files.items():
        inner = f"detail/{name}"
        if name.endswith(".hpp"):
            made[inner] = text.replace('#include "', '#include "detail/')
            made[name] = f'#pragma once\n#include "{inner}"\n'
        else:
            made[name] = text
    return made


_CONNECTION = re.compile(r"typedef (::ucm::PortConnection< (\S+) >) (\w+);")


def _connections_derived(files: Files) -> Files:
    """Connection types derive from instances of the template."""

    def defined(match: re.Match[str]) -> str:
        instance, interface, name = match.groups()
        shared = "::ucm::shared_ptr" if "class shared_ptr" in files[SUPPORT_FILE] else "::std::shared_ptr"
        made = f"{name}(::std::string name, {shared}< {interface} > given) : {instance}(name, given) {{}}"
        return f"#ifndef HAS_{name}\n#define HAS_{name}\nstruct {name} : {instance} {{\n    {made}\n}};\n#endif"

    return {name: _CONNECTION.sub(defined, text) for name, text in files.items()}


_STRUCTURE = re.compile(r"class (\w+) \{\n  public:\n    \1\(\)([^\n]*) \{\}\n.*?\n  private:\n(.*?)\};\n", re.DOTALL)


_EXCEPTION = re.compile(r"class \w+ : public ::UCM::UserException \{\n.*?\n\};\n", re.DOTALL)
_ACCESSOR = re.compile(r"    [^\n]*\{ (?:return stored_|stored_)[^\n]*\n")


def _plain_members(files: Files) -> Files:
    """Fields of structures, unions and exceptions are members."""

    def structure(match: re.Match[str]) -> str:
        name, initial, stored = (match[i].replace("stored_selector", "_d").replace("stored_", "") for i in (1, 2, 3))
        return f"struct {name} {{\n    {name}(){initial} {{}}\n{stored}}};\n"

    def exception(match: re.Match[str]) -> str:
        return _ACCESSOR.sub("", match[0]).replace("  private:\n", "").replace("stored_", "")

    return {name: _EXCEPTION.sub(exception, _STRUCTURE.sub(structure, text)) for name, text in files.items()}


_DEFINED = re.compile(r"extern const ([^;=]*) = ([^;]*);\n")


def _floating_constants_in_headers(files: Files) -> Files:
    """Headers define constants of floating point types, and no source file is needed."""
    made = {name: text for name, text in files.items() if not name.endswith(".cpp")}
    for source in files.keys() - made.keys():
        for declaration, value in _DEFINED.findall(files[source]):
            declared = f"extern const {declaration};"
            made = {n: text.replace(declared, f"const {declaration} = {value};") for n, text in made.items()}
    return made


REWRITTEN: Mapping[str, tuple[Callable[[Files], Files], tuple[str, ...]]] = {
    "framework_namespace": (_framework, ()),
    "one_file": (_one_file, ()),
    "many_files": (_many_files, ()),
    "connections_derived": (_connections_derived, ()),
    "plain_members": (_plain_members, ("cpp-struct=plain",)),
}

for _says, _freedom in table("variants/cpp.yaml", dict[str, Wrong]).items():
    for _task in _freedom.tasks:
        _derive = named(edited(_task, _freedom.edits), f"{_says}_{_task}", sentence(_says))
        variant(task=_task, declares=_freedom.declares)(_derive)


for _says, (_rewrite, _declares) in REWRITTEN.items():
    for _task in BOTH:
        variant(task=_task, declares=_declares)(named(rewriting(_rewrite, _task), f"{_says}_{_task}", _rewrite.__doc__))

_derive = rewriting(_floating_constants_in_headers, "cpp03")
variant(task="cpp03", declares=("cpp03-float-constants=header",))(
    named(_derive, "floating_constants_in_headers_cpp03", _derive.__doc__)
)


@variant(task="cpp11")
def annotations_as_remarks_of_cpp11(program: Program) -> Program:
    """Says in a remark of each header how many annotations the model has."""
    generate = program.generators["cpp11"]

    def remarking(model: Model) -> Files:
        files = generate(model)
        number = sum(isinstance(element, Annotation) for module in model.modules for element in walk(module))
        return {name: f"// annotations: {number}\n{text}" for name, text in files.items()} if number else files

    return replace(program, generators={**program.generators, "cpp11": remarking})
