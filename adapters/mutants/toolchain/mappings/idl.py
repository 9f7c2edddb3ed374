"""Tool chains that generate wrong IDL, one thing each: what the reference generates, with one text replaced."""

from __future__ import annotations

from dataclasses import replace

from ucm_cts.adapters.contract.metamodel.aspects import TechnicalPolicyDefinition
from ucm_cts.adapters.contract.metamodel.common import Named, walk
from ucm_cts.adapters.contract.metamodel.components import CompositeComponentImplementation
from ucm_cts.adapters.contract.metamodel.contracts import Annotation
from ucm_cts.adapters.contract.metamodel.interactions import InteractionPattern
from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.contract.metamodel.names import SEPARATOR, Names, each_element
from ucm_cts.adapters.mutants.toolchain import rewriting as rw
from ucm_cts.adapters.mutants.toolchain.registry import breaks, named
from ucm_cts.adapters.reference.toolchain.idl.generator import files_of
from ucm_cts.adapters.reference.toolchain.idl.names import identifier
from ucm_cts.adapters.reference.toolchain.program import Program

APPENDED: dict[str, tuple[str, str]] = {
    "component_beside_its_interface": ("R-12.1-02", "component Extra { attribute long number; };"),
    "value_types": ("R-12.1-02", "valuetype extra { public long number; };"),
    "untyped_values": ("R-12.1-02", "typedef any extra;"),
}
"""By the mutant's name: the requirement that it breaks, and what it declares besides."""


for _file, _table in rw.table("mappings/idl.yaml", dict[str, dict[str, rw.Wrong]]).items():
    for _name, _one in _table.items():
        _register = breaks(_one.breaks, task="idl", also=tuple(_one.also.split()), declares=_one.declares)
        _register(named(rw.replacing(_one.edits, _file), _name))
for _name, (_requirement, _text) in APPENDED.items():
    breaks(_requirement, task="idl")(named(rw.appended(_text), _name))


@breaks("R-12.7-02", "R-12.7-03", "R-12.7-06", task="idl", also=("R-12.7-04", "R-12.7-05"))
def generates_what_no_compiler_sees(program: Program) -> Program:
    """All that follows from the model stands in a branch that is never taken."""
    begin = "\n#ifdef NEVER_DEFINED\n"
    return rw.rewritten(program, lambda files: {**files, rw.MODEL: f"{begin}{files[rw.MODEL]}{rw.GUARD}"})


@breaks("R-12.4.1-10", task="idl")
def bound_of_another_branch(program: Program) -> Program:
    """A macro has the right number where it does not count."""
    made = "\n#if defined(TEXT_BOUND) || 2 < 1\n#define BOUND 16\n#else\n#define BOUND 17\n#endif\n"
    program = rw.replaced(r"string<16>", "string<BOUND>")(program)
    return rw.rewritten(program, lambda files: {**files, rw.MODEL: f"{made}{files[rw.MODEL]}"})


@breaks("R-12.7-07", task="idl")
def declarations_at_the_root(program: Program) -> Program:
    """What stands in a module inside a component module is declared at the root."""
    program = rw.replaced(r"( *)typedef boolean flag_t;", r"\1typedef long other_flag_t;")(program)
    return rw.appended("typedef boolean flag_t;")(program)


@breaks("R-12.7-08", task="idl", also=("R-12.8.4-04", "R-12.1-03"))
def templates_are_plain_modules(program: Program) -> Program:
    """Abstract types are named like others, in modules without parameters."""
    program = rw.replaced(r"(module [a-z_]+)<(?:typename|interface) \w+> \{", r"\1 {")(program)
    program = rw.replaced(r" *module ::.*<.*> (\w+);\n", "")(program)
    return rw.replaced(r"\b\w+_(message_api|stream_api|more_api|watching_api)::", r"::PortElementObject //")(program)


@breaks("R-12-01", task="idl")
def generates_nothing(program: Program) -> Program:
    """There is no file."""
    return rw.rewritten(program, lambda files: {})


@breaks("R-12.1-03", task="idl")
def names_clash_in_idl(program: Program) -> Program:
    """Names that differ in case only, and enumerators of two enumerations, stand in one scope."""
    return replace(program, generators={**program.generators, "idl": files_of})


def _declaring(program: Program, kind: type[Named]) -> Program:
    """An empty interface is made of each element of ``kind``, except in template modules."""
    generate = program.generators["idl"]

    def more(model: Model) -> rw.Files:
        files = generate(model)
        text = ""
        for element, scope in each_element(model, Names(model)):
            path = [identifier(part) for part in scope.path.split(SEPARATOR) if part]
            if isinstance(element, kind) and path and not any(f"module {part}<" in files[rw.MODEL] for part in path):
                opened = "".join(f"module {part} {{ " for part in path)
                text += f"{opened}interface {identifier(element.name)} {{}};{' };' * len(path)}\n"
        return {**files, rw.MODEL: files[rw.MODEL].replace(rw.GUARD, f"\n{text}{rw.GUARD}")}

    return replace(program, generators={**program.generators, "idl": more})


@breaks("R-9.3.3.7-01", task="idl", also=("R-12.1-03", "R-12.7-12"))
def interfaces_of_patterns(program: Program) -> Program:
    """Patterns are interfaces."""
    return _declaring(program, InteractionPattern)


@breaks("R-9.4.1-07", task="idl", also=("R-12.1-03",))
def interfaces_of_policy_definitions(program: Program) -> Program:
    """Policy definitions are interfaces."""
    return _declaring(program, TechnicalPolicyDefinition)


@breaks("R-9.5.5.9-01", task="idl", also=("R-12.1-03",))
def interfaces_of_composites(program: Program) -> Program:
    """Composites are interfaces."""
    return _declaring(program, CompositeComponentImplementation)


@breaks("R-9.2.9.4-04", task="idl")
def annotated_models_become_nothing(program: Program) -> Program:
    """Nothing is made of a model with annotations."""
    generate = program.generators["idl"]

    def unless_annotated(model: Model) -> rw.Files:
        is_annotated = any(isinstance(element, Annotation) for module in model.modules for element in walk(module))
        return {} if is_annotated else generate(model)

    return replace(program, generators={**program.generators, "idl": unless_annotated})
