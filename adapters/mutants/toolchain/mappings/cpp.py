"""Tool chains that generate wrong C++, one thing each: edits of what the reference generates, by the model that shows them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from ucm_cts.adapters.contract.metamodel.common import walk
from ucm_cts.adapters.contract.metamodel.contracts import Annotation, Constant
from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.mutants.toolchain.registry import breaks
from ucm_cts.adapters.mutants.toolchain.rewriting import Wrong, register, table
from ucm_cts.adapters.reference.toolchain.cpp.generator import Generation
from ucm_cts.adapters.reference.toolchain.cpp.types import CPP11
from ucm_cts.adapters.reference.toolchain.program import Program

for _model, _wrong in table("mappings/cpp.yaml", dict[str, dict[str, Wrong]]).items():
    register(_model, _wrong)


def _without_constants(program: Program, task: str) -> Program:
    generate = program.generators[task]

    def none_of_constants(model: Model) -> Mapping[str, str]:
        return {} if any(isinstance(element, Constant) for element in walk(model)) else generate(model)

    return replace(program, generators={**program.generators, task: none_of_constants})


@breaks("R-13-05", task="cpp11")
def nothing_generated_cpp11(program: Program) -> Program:
    """Writes nothing for models with constants."""
    return _without_constants(program, "cpp11")


@breaks("R-13-05", task="cpp03")
def nothing_generated_cpp03(program: Program) -> Program:
    """Writes nothing for models with constants."""
    return _without_constants(program, "cpp03")


@breaks("R-13-04", task="cpp11")
def enumerators_clash_in_cpp11(program: Program) -> Program:
    """Enumerators of two enumerations stand in one namespace."""
    return replace(program, generators={**program.generators, "cpp11": lambda model: Generation(model, CPP11).files()})


def _annotating(program: Program, task: str) -> Program:
    generate = program.generators[task]

    def annotating(model: Model) -> dict[str, str]:
        is_annotated = any(isinstance(element, Annotation) for module in model.modules for element in walk(module))
        files = generate(model)
        return {name: f"annotated\n{text}" for name, text in files.items()} if is_annotated else dict(files)

    return replace(program, generators={**program.generators, task: annotating})


@breaks("R-9.2.9.4-05", task="cpp11")
def annotations_are_words_of_cpp11(program: Program) -> Program:
    """Writes annotations into headers as if they were C++."""
    return _annotating(program, "cpp11")


@breaks("R-9.2.9.4-05", task="cpp03")
def annotations_are_words_of_cpp03(program: Program) -> Program:
    """Writes annotations into headers as if they were C++."""
    return _annotating(program, "cpp03")
