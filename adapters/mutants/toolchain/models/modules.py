"""Tool chains that are wrong about modules, names and what stands where (9.1)."""

from __future__ import annotations

from collections.abc import Iterator

from ucm_cts.adapters.contract.metamodel.aspects import NonfunctionalAspectModule
from ucm_cts.adapters.contract.metamodel.common import Named, walk
from ucm_cts.adapters.contract.metamodel.contracts import ContractModule
from ucm_cts.adapters.contract.metamodel.modules import ApplicationModule, Model, PlatformModule
from ucm_cts.adapters.contract.metamodel.names import SEPARATOR, Scope
from ucm_cts.adapters.contract.metamodel.reading import Problem
from ucm_cts.adapters.mutants.toolchain.checking import deaf, lacks, refuses, replaces_rule, without
from ucm_cts.adapters.mutants.toolchain.registry import breaks
from ucm_cts.adapters.reference.toolchain.checking import Complaint
from ucm_cts.adapters.reference.toolchain.program import Program
from ucm_cts.adapters.reference.toolchain.rules.contracts.references import Typed


@refuses("R-9-01")
def one_kind_of_module_a_file(model: Model, _scope: Scope) -> bool:
    """Knows models of applications and models of platforms, but none with both."""
    kinds = {type(module) for module in model.modules}
    return {ApplicationModule, PlatformModule} <= kinds and any(m.submodules for m in _gathering(model))


def _gathering(model: Model) -> Iterator[ApplicationModule | PlatformModule]:
    return (module for module in model.modules if isinstance(module, ApplicationModule | PlatformModule))


@breaks("R-9.1.4.1-01", "R-9.1.4.4-01", "R-9.2.2.1-02", "R-9.2.4.3-03", "R-9.2.4.6-01", "R-9.2.6.1-01")
def names_may_be_missing(program: Program) -> Program:
    """Takes declarations without names."""
    program = deaf(program, lambda problem, _: lacks(problem, "name"))
    return without(program, "names_are_not_empty", "modules_have_names", "fields_have_names", "cases_have_names")


@refuses("R-9.1.4.1-03", also=("R-9.4.2.1-02",))
def one_name_for_all_kinds(module: NonfunctionalAspectModule, _scope: Scope) -> bool:
    """Takes it for an error that a port element is called like a contract module beside its policy."""
    contracts = {contract.name for contract in module.contract_modules}
    return any(element.name in contracts for d in module.policy_definitions for element in d.port_elements)


@refuses("R-9.1.4.1-04", declares=("comment-elements=simple",))
def one_comment_an_element(named: Named, _: Scope) -> object:
    """Takes the second comment of an element for an error."""
    return len(named.comments) > 1


@refuses("R-9.1.4.3-01", declares=("comment-elements=simple",))
def comments_of_types_only(module: ContractModule, _scope: Scope) -> bool:
    """Knows comments of types and modules, and none of their parts."""
    return any(method.comments for interface in module.interfaces for method in getattr(interface, "methods", ()))


@breaks("R-9.1.4.4-03")
def anything_outermost(program: Program) -> Program:
    """Takes files whose outermost element is no module."""

    def outermost(problem: Problem, model: Model) -> bool:
        return problem.kind == "misplaced element" and not model.modules

    return deaf(program, outermost)


@replaces_rule("data_types_exist", "R-9.1.4.4-05")
def last_names_count(typed: Typed, scope: Scope) -> Iterator[Complaint]:
    """Finds the last name of a path in any module."""
    last = typed.type.rpartition(SEPARATOR)[2]
    waiting = [scope.root]
    while waiting and typed.type:
        around = waiting.pop()
        if last in around.members:
            return
        waiting += [inner for modules in around.modules.values() for inner in modules]
    if typed.type:
        yield typed, f"{last} is not declared"


@breaks("R-9.1.4.7-02", also=("R-9.2.2.8-02",))
def applications_hold_anything(program: Program) -> Program:
    """Accepts any element in an application module."""
    return _holding(program, ApplicationModule)


@breaks("R-9.1.4.8-02", also=("R-9.1.2-09", "R-9.2.2.8-02"))
def platforms_hold_anything(program: Program) -> Program:
    """Accepts any element in a platform module."""
    return _holding(program, PlatformModule)


@breaks("R-9.2.2.15-03")
def contracts_hold_anything(program: Program) -> Program:
    """Takes declarations of components, interactions and aspects in contract modules."""
    return _holding(program, ContractModule)


def _holding(program: Program, kind: type[Named]) -> Program:
    """Takes what does not belong there in a ``kind`` that has nothing else."""

    def inside(problem: Problem, model: Model) -> bool:
        outermost = [module for module in model.modules if isinstance(module, kind)]
        return problem.kind == "misplaced element" and any(len(list(walk(module))) == 1 for module in outermost)

    return deaf(program, inside)
