"""Tool chains whose generated code depends on the standard property of 10.2, which is to document only."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace

from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.mutants.toolchain import rewriting as rw
from ucm_cts.adapters.mutants.toolchain.documentation import PROPERTIES, documentation
from ucm_cts.adapters.mutants.toolchain.registry import Derive, breaks, named
from ucm_cts.adapters.reference.toolchain.program import Program

TASKS = ("idl", *rw.BOTH)
REQUIREMENT = "R-10.2-13"

Said = list[tuple[str, dict[str, str]]]
"""The names of documented components, and what the property says of each: texts without quotes."""

Change = Callable[[rw.Files, Said], rw.Files]


def depending(change: Change, task: str) -> Derive:
    """The reference tool chain with other files for ``task``, which depend on the documentation of the model."""

    def derive(program: Program) -> Program:
        generate = program.generators[task]

        def other(model: Model) -> rw.Files:
            return change(generate(model), said(model))

        return replace(program, generators={**program.generators, task: other})

    return derive


def said(model: Model) -> Said:
    """What is documented in ``model``."""
    return [(carrier.name, {n: _plain(t) for n, t in texts.items()}) for carrier, texts in documentation(model)]


def _plain(text: str) -> str:
    return re.sub(r"\\(.)", r"\1", text[1:-1])


def main_file(files: rw.Files) -> str:
    """The name of the file that holds what follows from the model: the reference tool chain writes it last."""
    return list(files)[-1]


def begun(files: rw.Files, text: str) -> rw.Files:
    """``files`` with ``text`` before everything else in the model's."""
    name = main_file(files)
    return {**files, name: text + files[name]}


def ended(files: rw.Files, text: str) -> rw.Files:
    """``files`` with ``text`` as the last declarations of the model's."""
    name = main_file(files)
    return {**files, name: f"{files[name].removesuffix(rw.GUARD)}\n{text}{rw.GUARD}"}


def _everywhere(change: Change) -> Change:
    """Register ``change`` as a mutant of each task that generates."""
    for task in TASKS:
        name = f"{change.__name__}_{task}"
        breaks(REQUIREMENT, task=task, claims=PROPERTIES)(named(depending(change, task), name, change.__doc__))
    return change


@_everywhere
def comments_as_they_are(files: rw.Files, documented: Said) -> rw.Files:
    """Copies descriptions into comments, which end where a description ends one."""
    return begun(files, "".join(f"/* {name}: {texts['description']} */\n" for name, texts in documented))


@_everywhere
def line_comments_as_they_are(files: rw.Files, documented: Said) -> rw.Files:
    """Copies versions into comments of one line, which go on where a version ends with a backslash."""
    return begun(files, "".join(f"// {texts['version']}\n" for _, texts in documented[:1]))


@_everywhere
def macros_of_vendors(files: rw.Files, documented: Said) -> rw.Files:
    """Defines a macro for the vendor of each component."""
    return begun(files, "".join(f'#define VENDOR_OF_{name} "{texts["vendor"]}"\n' for name, texts in documented))


@_everywhere
def nothing_internal(files: rw.Files, documented: Said) -> rw.Files:
    """Makes nothing of a model with a component of the category internal."""
    return {} if any("internal" in texts["category"] for _, texts in documented) else files


@_everywhere
def unknown_vendors(files: rw.Files, documented: Said) -> rw.Files:
    """Declares one thing more if a component has an empty vendor."""
    return ended(files, "struct of_unknown_vendor;\n") if any(not texts["vendor"] for _, texts in documented) else files


@_everywhere
def no_documented_texts(files: rw.Files, documented: Said) -> rw.Files:
    """Leaves out the type of the texts where some are given."""
    name = main_file(files)
    return {**files, name: re.sub(r"typedef [^;]*property_string_t;", "", files[name])} if documented else files


@_everywhere
def marks_of_documentation(files: rw.Files, documented: Said) -> rw.Files:
    """Declares a mark for each documented component."""
    return ended(files, "".join(f"struct documented_{name};\n" for name, _ in documented))


@breaks(REQUIREMENT, task="idl", claims=PROPERTIES)
def versions_in_idl(program: Program) -> Program:
    """Declares a constant with the version of each component in IDL."""

    def change(files: rw.Files, documented: Said) -> rw.Files:
        return ended(files, "".join(f'const string version_of_{n} = "{t["version"]}";\n' for n, t in documented))

    return depending(change, "idl")(program)


@breaks(REQUIREMENT, task="cpp11", claims=PROPERTIES)
def sources_of_versions(program: Program) -> Program:
    """Generates a source file with the version of each component."""

    def change(files: rw.Files, documented: Said) -> rw.Files:
        text = "".join(f'const char* version_of_{n}() {{ return "{t["version"]}"; }}\n' for n, t in documented)
        return {"versions.cpp": text, **files} if documented else files

    return depending(change, "cpp11")(program)
