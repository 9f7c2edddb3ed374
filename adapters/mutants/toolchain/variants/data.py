"""Tool chains that read the open places of 9.1 and of 9.2 up to the constants in one way or the other, and declare it."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace

from ucm_cts.adapters.contract.metamodel import contracts as c
from ucm_cts.adapters.contract.metamodel.common import Element, walk
from ucm_cts.adapters.contract.metamodel.modules import Module
from ucm_cts.adapters.contract.metamodel.names import Scope
from ucm_cts.adapters.mutants.toolchain.checking import deaf, refusing, refusing_text
from ucm_cts.adapters.mutants.toolchain.registry import replacing_rule, variant
from ucm_cts.adapters.reference.toolchain.checking import Complaint, Rule
from ucm_cts.adapters.reference.toolchain.program import Program
from ucm_cts.adapters.reference.toolchain.rules.contracts.actual_types import actual_type


@variant(declares=("declarations-elsewhere=extension", "pattern-parameters=accepted"))
def declarations_anywhere(program: Program) -> Program:
    """Extends the meta-model so that any declaration may stand in any module."""
    return deaf(program, lambda problem, model: problem.kind == "misplaced element" and model.modules)


@variant(declares=("modules-given-twice=refused",))
@refusing
def modules_in_one_piece(module: Module, scope: Scope) -> bool:
    """Refuses a second module of one kind and name at one place."""
    same = [d.element for d in scope.members[module.name] if type(d.element) is type(module)]
    return same[0] is not module


@variant(declares=("default-case-values=required",))
@refusing
def default_cases_name_values(union: c.Union, _: Scope) -> object:
    """Refuses a default case that names no value."""
    return any(not case.selector_values for case in union.cases)


@variant(declares=("selectors-without-case=refused",))
@refusing
def all_selector_values_have_cases(union: c.Union, scope: Scope) -> bool:
    """Refuses a union without default that has no case for some value."""
    selector = actual_type(union.selector_type, scope)
    named = {value.enumerator for case in union.cases for value in case.selector_values}
    known = {enumerator.name for enumerator in getattr(selector and selector.element, "enumerators", ())}
    return bool(known - named) and not any(case.default_case for case in union.cases)


@variant(declares=("index-values=32-bit",))
@refusing
def longs_of_32_bits(element: Element, _: Scope) -> object:
    """Refuses index values and sizes of more than 32 bits."""
    return any(_is_longer(element, field) for field in _NUMBERS)


_NUMBERS = ("value", "size", "max_size")


def _is_longer(element: Element, field: str) -> bool:
    number = getattr(element, field, None)
    return isinstance(number, int) and not -(2**31) <= number < 2**31


@variant(declares=("text-values=bare",))
def bare_text(program: Program) -> Program:
    """Reads characters and strings without quotes."""
    name = "constants_are_values_of_their_types"
    known = program.rules[name].complaints

    def complaints(constant: c.Constant, scope: Scope) -> Iterator[Complaint]:
        found = actual_type(constant.type, scope)
        if found is not None and isinstance(found.element, c.PrimitiveChar) and len(constant.value) != 1:
            yield constant, f"{constant.value} is not one character"
        elif found is not None and isinstance(found.element, c.PrimitiveChar | c.StringType):
            most = getattr(found.element, "max_size", None) or len(constant.value)
            if len(constant.value) > most >= 0:
                yield constant, f"{constant.value} has more than {most} characters"
        else:
            yield from known(constant, scope)

    def follows(constant: c.Constant, scope: Scope) -> Iterator[Complaint]:
        found = actual_type(constant.type, scope)
        if found is None or not isinstance(found.element, c.PrimitiveChar | c.StringType):
            yield from program.rules["constants_follow_the_grammar"].complaints(constant, scope)

    return replacing_rule(replacing_rule(program, name, complaints), "constants_follow_the_grammar", follows)


_LITERAL = re.compile(
    r"-?(0[xX][0-9a-fA-F]+|\d+\.?\d*([eE][-+]?\d+)?|\.\d+([eE][-+]?\d+)?)|\".*\"|'.*'|[A-Za-z_]\w*", re.DOTALL
)
"""A number, a text, or a name, which must be that of an enumerator or a truth value."""

_DECLARATIONS = (c.Alias, c.Array, c.Sequence, c.Structure, c.Interface, c.Constant)


def _uncertain_names(element: Element, scope: Scope) -> Iterator[Complaint]:
    for part in walk(element):
        for field in ("type", "interface", "exception"):
            reference = getattr(part, field, "") or ""
            if reference and not reference.startswith("::") and reference.partition("::")[0] not in scope.members:
                yield element, f"{reference} begins outside of its module"


def _uncertain_values(constant: c.Constant, scope: Scope) -> Iterator[Complaint]:
    if not _LITERAL.fullmatch(constant.value) or scope.find(constant.value, c.Constant):
        yield constant, f"{constant.value} is no literal"


def _uncertain_index_types(element: Element, _: Scope) -> Iterator[Complaint]:
    kind = getattr(element, "index_type", "") or "ULONG"
    if kind not in ("BYTE", "UBYTE", "SHORT", "USHORT", "LONG", "ULONG", "LONGLONG", "ULONGLONG"):
        yield element, f"{kind} is no kind of integers"


@variant(
    declares=(
        "comment-elements=xml",
        "declarations-elsewhere=refused",
        "index-types=kinds",
        "relative-names=own-module",
        "value-syntax=literals",
    )
)
def reads_only_what_is_certain(program: Program) -> Program:
    """Refuses comments that are elements, names that begin outside of their module, expressions and names of index types."""
    rules = (
        Rule("certain_names", "", _DECLARATIONS, _uncertain_names),
        Rule("certain_values", "", (c.Constant,), _uncertain_values),
        Rule("certain_index_types", "", (c.Enumeration, c.Sequence, c.ArrayDimension), _uncertain_index_types),
    )
    program = replace(program, rules={**program.rules, **{rule.name: rule for rule in rules}})
    return refusing_text(program, rb"<SimpleComment")
