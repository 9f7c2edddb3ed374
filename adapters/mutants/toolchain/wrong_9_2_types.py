"""Tool chains that are wrong about what a model says of types: too strict, too lax, or wrong at the bounds (9.2.2 to 9.2.5)."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from ucm_cts.adapters.contract.metamodel.contracts import (
    INTEGER_RANGES,
    Alias,
    Array,
    Attribute,
    ContractModule,
    Enumeration,
    NativeType,
    PrimitiveChar,
    PrimitiveFloat,
    PrimitiveInteger,
    Sequence,
    StringType,
    Structure,
    StructureField,
    Union,
)
from ucm_cts.adapters.contract.metamodel.modules import PlatformModule
from ucm_cts.adapters.contract.metamodel.names import Scope
from ucm_cts.adapters.contract.metamodel.reading import Problem
from ucm_cts.adapters.mutants.toolchain.registry import breaks, replacing_rule
from ucm_cts.adapters.mutants.toolchain.strictness import refusing
from ucm_cts.adapters.mutants.toolchain.tolerance import deaf, lacks, without
from ucm_cts.adapters.reference.toolchain.checking import Complaint
from ucm_cts.adapters.reference.toolchain.program import Program
from ucm_cts.adapters.reference.toolchain.rules.contracts.actual_types import actual_type
from ucm_cts.adapters.reference.toolchain.rules.contracts.references import OF_ONE_CLASS, Typed, index_kind

Indexed = Enumeration | Sequence


@breaks("R-9.2.2.4-02", "R-9.2.4.3-04", task="check", also=("R-9.1.4.4-05", *OF_ONE_CLASS))
def types_may_be_missing(program: Program) -> Program:
    """Takes what should have a data type without one."""
    typed = ("StructureField", "UnionCase", "Alias", "Array", "Sequence", "ExceptionField", "ConfigurationParameter")
    return without(deaf(program, lambda problem, _: lacks(problem, "type", *typed)), "data_types_are_named")


@breaks("R-9.2.2.7-02", task="check")
def attributes_have_defaults(program: Program) -> Program:
    """Takes an attribute without default value for an error."""
    return refusing(program, Attribute, lambda attribute, _: attribute.default_value is None)


@breaks("R-9.2.2.8-01", task="check")
def one_annotation_a_type(program: Program) -> Program:
    """Takes the second annotation of a structure for an error."""
    return refusing(program, Structure, lambda structure, _: len(structure.annotations) > 1)


@breaks("R-9.2.2.8-02", task="check")
def annotations_anywhere(program: Program) -> Program:
    """Takes annotations wherever they stand."""
    return deaf(program, lambda problem, _: problem.kind == "misplaced element" and problem.element == "Annotation")


@breaks("R-9.2.2.15-01", task="check")
def contract_modules_declare_something(program: Program) -> Program:
    """Takes an empty contract module at the root for an error."""

    def empty(module: ContractModule, scope: Scope) -> bool:
        return module == ContractModule(line=module.line, name=module.name) and scope.around is None

    return refusing(program, ContractModule, empty)


@breaks("R-9.2.2.15-05", task="check")
def platforms_without_contracts(program: Program) -> Program:
    """Takes contracts in contract modules of platforms for errors."""
    return refusing(program, PlatformModule, lambda module, _: _holds_contracts(module))


def _holds_contracts(module: PlatformModule) -> bool:
    return any(isinstance(inner, ContractModule) and inner.interfaces for inner in module.submodules)


@breaks("R-9.2.3.2-01", task="check")
def no_unsigned_integers_of_64_bits(program: Program) -> Program:
    """Does not know the kind ULONGLONG."""
    return refusing(program, PrimitiveInteger, lambda integer, _: integer.kind == "ULONGLONG")


@breaks("R-9.2.3.3-01", task="check")
def no_long_doubles(program: Program) -> Program:
    """Does not know the kind LONGDOUBLE."""
    return refusing(program, PrimitiveFloat, lambda number, _: number.kind == "LONGDOUBLE")


@breaks("R-9.2.3.4-01", task="check")
def no_wide_characters(program: Program) -> Program:
    """Does not know the kind CHAR32 of characters."""
    return refusing(program, PrimitiveChar, lambda character, _: character.kind == "CHAR32")


@breaks("R-9.2.5.2-01", task="check")
def no_wide_strings(program: Program) -> Program:
    """Does not know strings of CHAR32."""
    return refusing(program, StringType, lambda string, _: string.char_base == "CHAR32")


def _any_word(program: Program, tag: str, attribute: str) -> Program:
    def unheard(problem: Problem, _model: object) -> bool:
        return (problem.kind == "bad literal" and problem.element == tag) or lacks(problem, attribute, tag)

    return deaf(program, unheard)


@breaks("R-9.2.3.2-02", task="check")
def integers_of_any_kind(program: Program) -> Program:
    """Takes any word for a kind of integer, or none."""
    return _any_word(program, "PrimitiveInteger", "kind")


@breaks("R-9.2.3.3-02", "R-9.2.3.3-04", task="check")
def floats_of_any_kind(program: Program) -> Program:
    """Takes any word for a kind of float, FIXED among them."""
    return _any_word(program, "PrimitiveFloat", "kind")


@breaks("R-9.2.3.4-02", task="check")
def characters_of_any_kind(program: Program) -> Program:
    """Takes any word for a kind of character, or none."""
    return _any_word(program, "PrimitiveChar", "kind")


@breaks("R-9.2.5.2-02", task="check")
def strings_of_anything(program: Program) -> Program:
    """Takes any word for the base of a string, or none."""
    return _any_word(program, "StringType", "charBase")


@breaks("R-9.2.4.6-07", task="check")
def defaults_of_any_kind(program: Program) -> Program:
    """Takes any word for whether a case is the default."""
    return deaf(program, lambda problem, _: problem.kind == "bad literal" and problem.element == "UnionCase")


@breaks("R-9.2.4.1-01", "R-9.2.4.7-03", task="check", also=("R-9.2.4.1-02",))
def index_types_may_be_missing(program: Program) -> Program:
    """Takes what should have an index type without one."""

    def index_types_exist(indexed: Indexed, scope: Scope) -> Iterator[Complaint]:
        if indexed.index_type:
            yield from program.rules["index_types_exist"].look(indexed, scope)

    program = deaf(program, lambda problem, _: lacks(problem, "indexType"))
    return replacing_rule(program, "index_types_exist", index_types_exist)


@breaks("R-9.2.4.2-01", task="check")
def no_aliases_of_strings(program: Program) -> Program:
    """Renames anything but strings."""

    def of_string(alias: Alias, scope: Scope) -> bool:
        found = actual_type(alias.type, scope)
        return found is not None and isinstance(found.element, StringType)

    return refusing(program, Alias, of_string)


@breaks("R-9.2.4.3-01", task="check")
def structures_in_structures(program: Program) -> Program:
    """Takes a field that is a structure twice in one structure for an error."""

    def twice(structure: Structure, scope: Scope) -> bool:
        found = [scope.find(field.type, Structure) for field in structure.fields]
        return len([one for one in found if one is not None]) > 1

    return refusing(program, Structure, twice)


def _lax(program: Program, rule: str, kind: type[object]) -> Program:
    """``program`` whose ``rule`` does not look at elements of ``kind``."""

    def look(element: Typed, scope: Scope) -> Iterator[Complaint]:
        if not isinstance(element, kind):
            yield from program.rules[rule].look(element, scope)

    return replacing_rule(program, rule, look)


@breaks("R-9.2.4.4-01", "R-9.2.2.4-04", task="check")
def fields_of_interfaces(program: Program) -> Program:
    """Takes interfaces as types of fields."""
    return _lax(program, "interfaces_are_no_data_types", StructureField)


@breaks("R-9.2.5.4-01", "R-9.2.2.4-04", task="check")
def sequences_of_interfaces(program: Program) -> Program:
    """Takes interfaces as elements of sequences."""
    return _lax(program, "interfaces_are_no_data_types", Sequence)


@breaks("R-9.2.4.7-03", "R-9.2.4.1-02", "R-9.2.4.1-03", task="check")
def enumerations_of_any_index(program: Program) -> Program:
    """Takes enumerations that are indexed by whatever has a name, or none."""
    return _lax(_lax(program, "index_types_exist", Enumeration), "named_index_types_are_integers", Enumeration)


@breaks("R-9.2.4.5-01", task="check", also=("R-9.2.4.6-01", "R-9.2.4.6-02", "R-9.2.4.6-08"))
def unions_of_numbers(program: Program) -> Program:
    """Takes a union of different data types for an error."""

    def mixed(union: Union, _scope: Scope) -> bool:
        return len({case.type for case in union.cases}) > 1

    return refusing(program, Union, mixed)


@breaks("R-9.2.4.6-06", task="check", also=("R-9.2.4.6-08",))
def default_cases_come_last(program: Program) -> Program:
    """Takes a default case before others for an error."""
    return refusing(program, Union, lambda union, _: any(case.default_case for case in union.cases[:-1]))


@breaks("R-9.2.4.7-01", task="check")
def enumerations_do_not_count(program: Program) -> Program:
    """Takes an enumeration of the values 4, 5 and 6 for an error."""
    return refusing(program, Enumeration, lambda e, _: [one.value for one in e.enumerators] == [4, 5, 6])


@breaks("R-9.2.4.8-01", task="check")
def enumerators_count_themselves(program: Program) -> Program:
    """Takes enumerators without value."""
    return deaf(program, lambda problem, _: lacks(problem, "value", "Enumerator"))


def _any_number(program: Program, *tags: str) -> Program:
    return deaf(program, lambda problem, _: problem.kind == "bad number" and problem.element in tags)


@breaks("R-9.2.4.8-02", task="check")
def index_values_of_any_kind(program: Program) -> Program:
    """Takes words and fractions for index values."""
    return _any_number(program, "Enumerator")


@breaks("R-9.2.4.11-02", task="check")
def sizes_of_any_kind(program: Program) -> Program:
    """Takes words and fractions for sizes of arrays."""
    return _any_number(program, "ArrayDimension")


@breaks("R-9.2.5.1-02", task="check")
def greatest_sizes_of_any_kind(program: Program) -> Program:
    """Takes words and fractions for greatest sizes."""
    return _any_number(program, "StringType", "Sequence")


@breaks("R-9.2.4.11-01", task="check")
def sizes_may_be_missing(program: Program) -> Program:
    """Takes dimensions without size."""
    return deaf(program, lambda problem, _: lacks(problem, "size", "ArrayDimension"))


@breaks("R-9.2.5.1-01", task="check", declares=("absent-max-size=refused",))
def greatest_sizes_may_be_missing(program: Program) -> Program:
    """Takes strings and sequences without greatest size, although it says that it does not."""
    return deaf(program, lambda problem, _: lacks(problem, "maxSize", "Sequence"))


@breaks("R-9.2.5.2-03", task="check")
def strings_of_255_characters(program: Program) -> Program:
    """Takes a string longer than 255 for an error."""
    return refusing(program, StringType, lambda string, _: (string.max_size or 0) > 255)


@breaks("R-9.2.5.4-03", task="check")
def sequences_are_bounded(program: Program) -> Program:
    """Takes a sequence without bound for an error."""
    return refusing(program, Sequence, lambda sequence, _: sequence.max_size == -1)


@breaks("R-9.2.5.3-01", task="check", declares=("native-types=supported",))
def native_types_unknown(program: Program) -> Program:
    """Refuses native types, although it says that it knows them."""
    return refusing(program, NativeType, lambda *_: True)


@breaks("R-9.2.5.3-02", task="check", declares=("native-types=supported",))
def native_types_of_any_size(program: Program) -> Program:
    """Takes native types without a greatest size."""
    return deaf(program, lambda problem, _: problem.element == "NativeType")


@breaks("R-9.2.5.3-01", task="check", declares=("native-types=unsupported",))
def native_types_unseen(program: Program) -> Program:
    """Takes native types, although it says that it does not know them."""
    return program


def _index_values(beyond: int) -> Callable[[Enumeration, Scope], Iterator[Complaint]]:
    """The rule about index values whose upper bound is off by ``beyond``."""

    def index_values_are_in_range(enumeration: Enumeration, scope: Scope) -> Iterator[Complaint]:
        low, high = INTEGER_RANGES[index_kind(enumeration.index_type, scope) or "LONGLONG"]
        for enumerator in enumeration.enumerators:
            if not low <= (enumerator.value or 0) <= high + beyond:
                yield enumerator, "out of range"

    return index_values_are_in_range


@breaks("R-9.2.4.8-03", task="check")
def index_values_one_too_many(program: Program) -> Program:
    """Takes index values up to one more than the greatest."""
    return replacing_rule(program, "index_values_are_in_range", _index_values(1))


@breaks("R-9.2.4.8-03", task="check")
def index_values_one_too_few(program: Program) -> Program:
    """Takes index values below the greatest only."""
    return replacing_rule(program, "index_values_are_in_range", _index_values(-1))


@breaks("R-9.2.4.11-03", task="check", also=("R-9.2.4.9-04",))
def sizes_one_too_few(program: Program) -> Program:
    """Takes sizes below the greatest value of the index only."""
    return refusing(program, Array, lambda array, scope: _at_bound(array, scope))


def _at_bound(array: Array, scope: Scope) -> bool:
    bounds = [(d.size, INTEGER_RANGES[index_kind(d.index_type, scope) or "LONGLONG"][1]) for d in array.dimensions]
    return any(size == most for size, most in bounds)


@breaks("R-9.2.4.11-03", task="check")
def last_indices_count(program: Program) -> Program:
    """Holds the last index against the range, not the size."""

    def sizes_are_in_range(array: Array, scope: Scope) -> Iterator[Complaint]:
        for dimension in array.dimensions:
            kind = index_kind(dimension.index_type, scope)
            if kind is not None and dimension.size is not None and dimension.size - 1 > INTEGER_RANGES[kind][1]:
                yield dimension, "out of range"

    return replacing_rule(program, "sizes_are_in_range", sizes_are_in_range)


@breaks("R-9.2.4.11-04", task="check")
def arrays_of_two_elements(program: Program) -> Program:
    """Takes an array of one element for an error."""
    return refusing(program, Array, lambda array, _: any(dimension.size == 1 for dimension in array.dimensions))
