"""Tool chains that are wrong about modules, names and what stands where (9.1)."""

from __future__ import annotations

from collections.abc import Iterator

from ucm_cts.adapters.contract.metamodel.aspects import NonfunctionalAspectModule
from ucm_cts.adapters.contract.metamodel.common import Named, SimpleComment, walk
from ucm_cts.adapters.contract.metamodel.components import CompositeComponentImplementation
from ucm_cts.adapters.contract.metamodel.contracts import ContractModule
from ucm_cts.adapters.contract.metamodel.modules import ApplicationModule, Model, PlatformModule
from ucm_cts.adapters.contract.metamodel.names import SEPARATOR, Scope
from ucm_cts.adapters.contract.metamodel.reading import Problem
from ucm_cts.adapters.mutants.toolchain.registry import breaks, replacing_rule
from ucm_cts.adapters.mutants.toolchain.strictness import refusing
from ucm_cts.adapters.mutants.toolchain.tolerance import deaf, lacks, without
from ucm_cts.adapters.reference.toolchain.checking import Complaint
from ucm_cts.adapters.reference.toolchain.program import Program
from ucm_cts.adapters.reference.toolchain.rules.contracts.references import Typed


@breaks("R-9-01", task="check")
def one_kind_of_module_a_file(program: Program) -> Program:
    """Knows models of applications and models of platforms, but none with both."""

    def both(model: Model, _scope: Scope) -> bool:
        kinds = {type(module) for module in model.modules}
        return {ApplicationModule, PlatformModule} <= kinds and any(m.submodules for m in _gathering(model))

    return refusing(program, Model, both)


def _gathering(model: Model) -> Iterator[ApplicationModule | PlatformModule]:
    return (module for module in model.modules if isinstance(module, ApplicationModule | PlatformModule))


def _misplaced(program: Program, *tags: str) -> Program:
    return deaf(program, lambda problem, _: problem.kind == "misplaced element" and problem.element in tags)


@breaks("R-9.1.2-03", task="check")
def attributes_anywhere(program: Program) -> Program:
    """Takes attributes wherever they stand."""
    return _misplaced(program, "Attribute")


@breaks("R-9.1.2-05", "R-9.1.2-06", task="check", declares=("pattern-parameters=refused",))
def parameters_anywhere(program: Program) -> Program:
    """Takes configuration parameters wherever they stand, in patterns, too, although it says otherwise."""
    return _misplaced(program, "ConfigurationParameter")


@breaks("R-9.1.2-09", task="check")
def annotation_definitions_anywhere(program: Program) -> Program:
    """Takes definitions of annotations outside of contract modules."""
    return _misplaced(program, "AnnotationDefinition")


@breaks("R-9.1.2-10", task="check", also=("R-9.5.2.2-02",))
def composites_without_annotations(program: Program) -> Program:
    """Knows no annotations of composites."""
    return refusing(program, CompositeComponentImplementation, lambda composite, _: composite.annotations)


@breaks("R-9.1.4.1-01", "R-9.1.4.4-01", "R-9.2.2.1-02", "R-9.2.4.3-03", "R-9.2.4.6-01", "R-9.2.6.1-01", task="check")
def names_may_be_missing(program: Program) -> Program:
    """Takes declarations without names."""
    program = deaf(program, lambda problem, _: lacks(problem, "name"))
    return without(program, "names_are_not_empty", "modules_have_names", "fields_have_names", "cases_have_names")


@breaks("R-9.1.4.1-03", task="check", also=("R-9.4.2.1-02",))
def one_name_for_all_kinds(program: Program) -> Program:
    """Takes it for an error that a port element is called like a contract module beside its policy."""

    def shared(module: NonfunctionalAspectModule, _scope: Scope) -> bool:
        contracts = {contract.name for contract in module.contract_modules}
        return any(element.name in contracts for d in module.policy_definitions for element in d.port_elements)

    return refusing(program, NonfunctionalAspectModule, shared)


@breaks("R-9.1.4.1-04", task="check", declares=("comment-elements=simple",))
def one_comment_an_element(program: Program) -> Program:
    """Takes the second comment of an element for an error."""
    return refusing(program, Named, lambda named, _: len(named.comments) > 1)


@breaks("R-9.1.4.3-01", task="check", declares=("comment-elements=simple",))
def comments_of_types_only(program: Program) -> Program:
    """Knows comments of types and modules, and none of their parts."""

    def inside(module: ContractModule, _scope: Scope) -> bool:
        return any(method.comments for interface in module.interfaces for method in getattr(interface, "methods", ()))

    return refusing(program, ContractModule, inside)


@breaks("R-9.1.4.3-02", task="check", declares=("comment-elements=simple",))
def comments_are_plain(program: Program) -> Program:
    """Takes comments that look like markup for errors."""
    return refusing(program, SimpleComment, lambda comment, _: "<" in comment.text)


@breaks("R-9.1.4.4-02", task="check", declares=("comment-elements=simple",))
def modules_without_comments(program: Program) -> Program:
    """Knows no comments of platform modules."""
    return refusing(program, PlatformModule, lambda module, _: module.comments)


@breaks("R-9.1.4.4-03", task="check")
def anything_outermost(program: Program) -> Program:
    """Takes files whose outermost element is no module."""

    def outermost(problem: Problem, model: Model) -> bool:
        return problem.kind == "misplaced element" and not model.modules

    return deaf(program, outermost)


@breaks("R-9.1.4.4-05", task="check")
def last_names_count(program: Program) -> Program:
    """Looks for the last name of a path wherever it may be declared."""

    def data_types_exist(typed: Typed, scope: Scope) -> Iterator[Complaint]:
        last = typed.type.rpartition(SEPARATOR)[2]
        waiting = [scope.root]
        while waiting and typed.type:
            around = waiting.pop()
            if last in around.members:
                return
            waiting += [inner for modules in around.modules.values() for inner in modules]
        if typed.type:
            yield typed, f"{last} is not declared"

    return replacing_rule(program, "data_types_exist", data_types_exist)


@breaks("R-9.1.4.1-02", task="check", declares=("modules-given-twice=refused",))
def modules_in_pieces(program: Program) -> Program:
    """Reads two modules of one name as one, although it says that this is an error."""
    return program


@breaks("R-9.1.4.7-01", task="check")
def applications_have_parts(program: Program) -> Program:
    """Takes an application module without modules for an error."""
    return refusing(program, ApplicationModule, lambda module, _: not module.submodules)


@breaks("R-9.1.4.8-01", task="check")
def platforms_have_parts(program: Program) -> Program:
    """Takes a platform module without modules for an error."""
    return refusing(program, PlatformModule, lambda module, _: not module.submodules)


@breaks("R-9.1.4.7-02", task="check")
def applications_hold_anything(program: Program) -> Program:
    """Takes whatever stands in an application module."""
    return _holding(program, ApplicationModule)


@breaks("R-9.1.4.8-02", task="check")
def platforms_hold_anything(program: Program) -> Program:
    """Takes whatever stands in a platform module."""
    return _holding(program, PlatformModule)


@breaks("R-9.2.2.15-03", task="check")
def contracts_hold_anything(program: Program) -> Program:
    """Takes declarations of components, interactions and aspects in contract modules."""
    return _holding(program, ContractModule)


def _holding(program: Program, kind: type[Named]) -> Program:
    """Takes what does not belong there in a ``kind`` that has nothing else."""

    def inside(problem: Problem, model: Model) -> bool:
        outermost = [module for module in model.modules if isinstance(module, kind)]
        return problem.kind == "misplaced element" and any(len(list(walk(module))) == 1 for module in outermost)

    return deaf(program, inside)
