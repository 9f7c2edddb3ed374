"""Tool chains that are wrong about what a model says of types: too strict, too lax, or wrong at the bounds (9.2.2 to 9.2.5)."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from ucm_cts.adapters.contract.metamodel import contracts as c
from ucm_cts.adapters.contract.metamodel.modules import PlatformModule
from ucm_cts.adapters.contract.metamodel.names import Scope
from ucm_cts.adapters.mutants.toolchain.checking import deaf, lacks, refuses, replaces_rule, without
from ucm_cts.adapters.mutants.toolchain.registry import breaks, replacing_rule
from ucm_cts.adapters.reference.toolchain.checking import Complaint
from ucm_cts.adapters.reference.toolchain.program import Program
from ucm_cts.adapters.reference.toolchain.rules.contracts.actual_types import actual_type
from ucm_cts.adapters.reference.toolchain.rules.contracts.references import OF_ONE_CLASS, Typed, index_kind

Indexed = c.Enumeration | c.Sequence


@breaks("R-9.2.2.4-02", "R-9.2.4.3-04", also=("R-9.1.4.4-05", *OF_ONE_CLASS))
def types_may_be_missing(program: Program) -> Program:
    """Takes what should have a data type without one."""
    typed = ("StructureField", "UnionCase", "Alias", "Array", "Sequence", "ExceptionField", "ConfigurationParameter")
    return without(deaf(program, lambda problem, _: lacks(problem, "type", *typed)), "data_types_are_named")


@refuses("R-9.2.2.15-01")
def contract_modules_declare_something(module: c.ContractModule, scope: Scope) -> bool:
    """Takes an empty contract module at the root for an error."""
    return module == c.ContractModule(line=module.line, name=module.name) and scope.around is None


@refuses("R-9.2.2.15-05")
def platforms_without_contracts(module: PlatformModule, _: Scope) -> object:
    """Takes contracts in contract modules of platforms for errors."""
    return _holds_contracts(module)


def _holds_contracts(module: PlatformModule) -> bool:
    return any(isinstance(inner, c.ContractModule) and inner.interfaces for inner in module.submodules)


@breaks("R-9.2.4.1-01", "R-9.2.4.7-03", also=("R-9.2.4.1-02",))
def index_types_may_be_missing(program: Program) -> Program:
    """Takes what should have an index type without one."""

    def index_types_exist(indexed: Indexed, scope: Scope) -> Iterator[Complaint]:
        if indexed.index_type:
            yield from program.rules["index_types_exist"].complaints(indexed, scope)

    program = deaf(program, lambda problem, _: lacks(problem, "indexType"))
    return replacing_rule(program, "index_types_exist", index_types_exist)


@refuses("R-9.2.4.2-01")
def no_aliases_of_strings(alias: c.Alias, scope: Scope) -> bool:
    """Renames anything but strings."""
    found = actual_type(alias.type, scope)
    return found is not None and isinstance(found.element, c.StringType)


@refuses("R-9.2.4.3-01")
def structures_in_structures(structure: c.Structure, scope: Scope) -> bool:
    """Takes a field that is a structure twice in one structure for an error."""
    found = [scope.find(field.type, c.Structure) for field in structure.fields]
    return len([one for one in found if one is not None]) > 1


def _ignoring(program: Program, rule: str, kind: type[object]) -> Program:
    """``program`` whose ``rule`` ignores elements of ``kind``."""

    def complaints(element: Typed, scope: Scope) -> Iterator[Complaint]:
        if not isinstance(element, kind):
            yield from program.rules[rule].complaints(element, scope)

    return replacing_rule(program, rule, complaints)


@breaks("R-9.2.4.4-01", "R-9.2.2.4-04")
def fields_of_interfaces(program: Program) -> Program:
    """Takes interfaces as types of fields."""
    return _ignoring(program, "interfaces_are_no_data_types", c.StructureField)


@breaks("R-9.2.5.4-01", "R-9.2.2.4-04")
def sequences_of_interfaces(program: Program) -> Program:
    """Takes interfaces as elements of sequences."""
    return _ignoring(program, "interfaces_are_no_data_types", c.Sequence)


@breaks("R-9.2.4.7-03", "R-9.2.4.1-02", "R-9.2.4.1-03")
def enumerations_of_any_index(program: Program) -> Program:
    """Accepts enumerations with any index type, or none."""
    return _ignoring(
        _ignoring(program, "index_types_exist", c.Enumeration), "named_index_types_are_integers", c.Enumeration
    )


@refuses("R-9.2.4.5-01", also=("R-9.2.4.6-01", "R-9.2.4.6-02", "R-9.2.4.6-08"))
def unions_of_numbers(union: c.Union, _scope: Scope) -> bool:
    """Takes a union of different data types for an error."""
    return len({case.type for case in union.cases}) > 1


@refuses("R-9.2.4.6-06", also=("R-9.2.4.6-08",))
def default_cases_come_last(union: c.Union, _: Scope) -> object:
    """Takes a default case before others for an error."""
    return any(case.default_case for case in union.cases[:-1])


@refuses("R-9.2.4.7-01")
def enumerations_do_not_count(e: c.Enumeration, _: Scope) -> object:
    """Takes an enumeration of the values 4, 5 and 6 for an error."""
    return [one.value for one in e.enumerators] == [4, 5, 6]


@breaks("R-9.2.5.3-02", declares=("native-types=supported",))
def native_types_of_any_size(program: Program) -> Program:
    """Takes native types without a greatest size."""
    return deaf(program, lambda problem, _: problem.element == "NativeType" and problem.kind != "misplaced element")


def _index_values(beyond: int) -> Callable[[c.Enumeration, Scope], Iterator[Complaint]]:
    """The rule about index values whose upper bound is off by ``beyond``."""

    def index_values_are_in_range(enumeration: c.Enumeration, scope: Scope) -> Iterator[Complaint]:
        low, high = c.INTEGER_RANGES[index_kind(enumeration.index_type, scope) or "LONGLONG"]
        for enumerator in enumeration.enumerators:
            if not low <= (enumerator.value or 0) <= high + beyond:
                yield enumerator, "out of range"

    return index_values_are_in_range


@breaks("R-9.2.4.8-03")
def index_values_one_too_many(program: Program) -> Program:
    """Takes index values up to one more than the greatest."""
    return replacing_rule(program, "index_values_are_in_range", _index_values(1))


@breaks("R-9.2.4.8-03")
def index_values_one_too_few(program: Program) -> Program:
    """Takes index values below the greatest only."""
    return replacing_rule(program, "index_values_are_in_range", _index_values(-1))


@refuses("R-9.2.4.11-03", also=("R-9.2.4.9-04",))
def sizes_one_too_few(array: c.Array, scope: Scope) -> object:
    """Takes sizes below the greatest value of the index only."""
    return _at_bound(array, scope)


def _at_bound(array: c.Array, scope: Scope) -> bool:
    bounds = [(d.size, c.INTEGER_RANGES[index_kind(d.index_type, scope) or "LONGLONG"][1]) for d in array.dimensions]
    return any(size == most for size, most in bounds)


@replaces_rule("sizes_are_in_range", "R-9.2.4.11-03")
def last_indices_count(array: c.Array, scope: Scope) -> Iterator[Complaint]:
    """Holds the last index against the range, not the size."""
    for dimension in array.dimensions:
        kind = index_kind(dimension.index_type, scope)
        if kind is not None and dimension.size is not None and dimension.size - 1 > c.INTEGER_RANGES[kind][1]:
            yield dimension, "out of range"


@refuses("R-9.2.4.11-04")
def arrays_of_two_elements(array: c.Array, _: Scope) -> object:
    """Takes an array of one element for an error."""
    return any(dimension.size == 1 for dimension in array.dimensions)
