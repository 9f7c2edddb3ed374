"""Tool chains that are wrong about the syntax of values, or about which values a type has (9.2.2.6, 9.2.3.2, 9.2.6)."""

from __future__ import annotations

import functools
import re
from collections.abc import Callable, Iterator
from typing import Any

from ucm_cts.adapters.contract.metamodel.contracts import (
    INTEGER_RANGES,
    Alias,
    Constant,
    PrimitiveBoolean,
    PrimitiveFloat,
)
from ucm_cts.adapters.contract.metamodel.names import Scope
from ucm_cts.adapters.mutants.toolchain.checking import complains_only_where, deaf, lacks, refuses, refusing, without
from ucm_cts.adapters.mutants.toolchain.registry import breaks, named, replacing_rule
from ucm_cts.adapters.reference.toolchain.checking import Complaint
from ucm_cts.adapters.reference.toolchain.program import Program
from ucm_cts.adapters.reference.toolchain.rules.contracts.actual_types import actual_type
from ucm_cts.adapters.reference.toolchain.rules.contracts.constant_syntax import NotAConstant
from ucm_cts.adapters.reference.toolchain.rules.contracts.constant_values import NoValueOfType, Ranges, fit

Fits = Callable[[Constant, Scope], None]


def _fitting(program: Program, fits: Fits) -> Program:
    """``program`` in which ``fits`` decides whether a constant has a value of its type."""

    def complaints(constant: Constant, scope: Scope) -> Iterator[Complaint]:
        try:
            fits(constant, scope)
        except NoValueOfType as error:
            yield constant, str(error)
        except NotAConstant:
            pass

    return replacing_rule(program, "constants_are_values_of_their_types", complaints)


def _with_ranges(program: Program, ranges: Ranges) -> Program:
    return _fitting(program, lambda constant, scope: fit(constant.value, constant.type, scope, ranges))


def _off_by_one(kind: str, requirement: str, also: tuple[str, ...]) -> None:
    least, most = INTEGER_RANGES[kind]

    for name, what, beyond in (("too_wide", "one beyond", 1), ("too_narrow", "only inside", -1)):
        ranges = {**INTEGER_RANGES, kind: (least - beyond, most + beyond)}
        derive = named(
            functools.partial(_with_ranges, ranges=ranges),
            f"{name}_{kind.lower()}",
            f"Takes constants of {kind} {what} its bounds.",
        )
        breaks(requirement, also=also)(derive)


_SAME = ("R-9.1.4.4-05", "R-9.2.4.2-02", "R-9.2.6.1-02", "R-9.2.6.1-03", "R-9.2.6.1-04")
"""Requirements that say of all constants, or of names in values, what 9.2.3.2 says of each kind."""

for _number, _kind in enumerate(INTEGER_RANGES, 3):
    _off_by_one(_kind, f"R-9.2.3.2-{_number:02}", _SAME)


@breaks("R-9.2.3.2-03", also=("R-9.2.6.1-03", "R-9.2.6.1-04"))
def bytes_are_octets(program: Program) -> Program:
    """Takes BYTE for an octet, which goes from 0 to 255."""
    return _with_ranges(program, {**INTEGER_RANGES, "BYTE": (0, 255)})


def _reading(program: Program, pattern: str, meant: str) -> Program:
    """``program`` to which values of ``pattern`` mean something else."""

    def reread(constant: Constant) -> str:
        return re.sub(pattern, meant, constant.value)

    return _fitting(program, lambda constant, scope: fit(reread(constant), constant.type, scope))


@breaks("R-9.2.6.1-03", also=("R-9.2.6.1-04",))
def octal_is_decimal(program: Program) -> Program:
    """Reads numbers with a leading zero as decimal ones."""
    return _reading(program, r"^(-?)0+([1-9]\d*)$", r"\1\2")


@breaks("R-9.2.3.3-04")
def fixed_point_values(program: Program) -> Program:
    """Knows numbers with a fixed point."""

    def complaints(constant: Constant, scope: Scope) -> Iterator[Complaint]:
        if not re.fullmatch(r"[\d.]+[dD]", constant.value):
            yield from program.rules["constants_follow_the_grammar"].complaints(constant, scope)

    return replacing_rule(program, "constants_follow_the_grammar", complaints)


@breaks("R-9.2.4.2-02")
def aliases_are_not_followed(program: Program) -> Program:
    """Takes any value for a constant whose type is an alias."""

    def fits(constant: Constant, scope: Scope) -> None:
        found = scope.find(constant.type, Alias)
        if found is None:
            fit(constant.value, constant.type, scope)

    return _fitting(program, fits)


@breaks("R-9.2.6.1-01", "R-9.2.2.6-01")
def values_may_be_missing(program: Program) -> Program:
    """Takes constants without value."""
    return without(deaf(program, lambda problem, _: lacks(problem, "value", "Constant")), "values_are_given")


@refuses("R-9.2.6.1-02")
def no_constants_of_long_doubles(constant: Constant, scope: Scope) -> bool:
    """Takes a constant of the kind LONGDOUBLE for an error."""
    found = actual_type(constant.type, scope)
    return found is not None and isinstance(found.element, PrimitiveFloat) and found.element.kind == "LONGDOUBLE"


@breaks("R-9.2.6.1-04", declares=("text-values=quoted",))
def strings_of_any_length(program: Program) -> Program:
    """Takes text that is longer than the string."""

    def fits(constant: Constant, scope: Scope) -> None:
        try:
            fit(constant.value, constant.type, scope)
        except NoValueOfType as error:
            if "characters" not in str(error):
                raise

    return _fitting(program, fits)


@complains_only_where("constants_are_values_of_their_types", "R-9.2.6.1-04")
def numbers_are_truth_values(constant: Constant, _: Any, scope: Scope) -> bool:
    """Accepts 0 and 1 for FALSE and TRUE."""
    found = actual_type(constant.type, scope)
    is_boolean = found is not None and isinstance(found.element, PrimitiveBoolean)
    return not (is_boolean and constant.value in ("0", "1"))


@breaks("R-9.2.6.1-02", declares=("text-values=quoted",))
@refusing
def characters_have_no_octal_numbers(constant: Constant, _: Scope) -> bool:
    """Does not know characters that are given by more than one octal digit."""
    return bool(re.search(r"\\[0-7]{2,3}", constant.value))


@breaks("R-9.2.6.1-02", declares=("text-values=quoted",))
@refusing
def strings_are_one_literal(constant: Constant, _: Scope) -> bool:
    """Does not know that strings which follow each other are one."""
    return '" "' in constant.value
