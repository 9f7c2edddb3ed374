"""Building blocks of mutants that check models: they refuse more than the reference tool chain, or report fewer problems."""

from __future__ import annotations

import functools
import re
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any, get_args, get_type_hints

import msgspec

from ucm_cts.adapters.contract.metamodel.common import Element
from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.contract.metamodel.names import Scope
from ucm_cts.adapters.contract.metamodel.reading import Problem, Reading, Source, whole
from ucm_cts.adapters.mutants.toolchain.registry import Derive, breaks, complaining_where, replacing_rule
from ucm_cts.adapters.reference.toolchain.checking import Complaint, FindComplaints, Rule
from ucm_cts.adapters.reference.toolchain.program import Program


def deaf(program: Program, when: Callable[[Problem, Model], object]) -> Program:
    """``program``, but problems in reading for which ``when`` holds do not count. It is given what could be read, too."""

    def read(text: Source, file: str) -> Reading:
        reading = program.read(text, file)
        reported = tuple(problem for problem in reading.problems if not when(problem, reading.model))
        return msgspec.structs.replace(reading, problems=reported)

    return replace(program, read=read)


def overhearing(program: Program, kind: str, tag: str, attribute: str) -> Program:
    """``program``, but problems of ``kind`` with ``attribute`` of elements of ``tag`` do not count when models are read."""

    def overheard(problem: Problem, _: Model) -> bool:
        return (problem.kind, problem.element) == (kind, tag) and mentions(problem.message, attribute)

    return deaf(program, overheard)


def mentions(message: str, attribute: str) -> bool:
    """Whether ``attribute`` is one of the words of ``message``."""
    return attribute in re.findall(r"\w+", message)


def without(program: Program, *rules: str) -> Program:
    """``program`` without the ``rules`` of these names."""
    for name in rules:
        program = replacing_rule(program, name, None)
    return program


def forgiving(program: Program, name: str, when: Callable[[Any], object]) -> Program:
    """``program``, but what the rule ``name`` says of elements for which ``when`` holds does not count."""
    known = program.rules[name].complaints

    def complaints(element: Element, scope: Scope) -> Iterator[Complaint]:
        return (complaint for complaint in known(element, scope) if not when(complaint[0]))

    return replacing_rule(program, name, complaints)


def lacks(problem: Problem, attribute: str, *tags: str) -> bool:
    """Whether ``problem`` is that an element of ``tags``, or any element if there are none, has no ``attribute``."""
    said = problem.message.endswith(f" has no {attribute}; give it one")
    return problem.kind == "missing attribute" and said and (not tags or problem.element in tags)


def replaces_rule(
    name: str, *requirements: str, also: tuple[str, ...] = (), declares: tuple[str, ...] = ()
) -> Callable[[FindComplaints], Derive]:
    """Register a rule function as the mutant that has it in place of the rule ``name``."""

    def register(complaints: FindComplaints) -> Derive:
        def derive(program: Program) -> Program:
            return replacing_rule(program, name, complaints)

        return breaks(*requirements, also=also, declares=declares)(functools.wraps(complaints)(derive))

    return register


def complains_only_where(
    rule: str, *requirements: str, declares: tuple[str, ...] = ()
) -> Callable[[Callable[[Any, Any, Scope], bool]], Derive]:
    """Register a condition as the mutant in which complaints of ``rule`` count only where it holds.

    Its arguments are the wrong element, the checked element and that element's scope.
    """

    def register(holds: Callable[[Any, Any, Scope], bool]) -> Derive:
        def derive(program: Program) -> Program:
            return complaining_where(program, rule, lambda wrong, element, scope, _: holds(wrong, element, scope))

        return breaks(*requirements, declares=declares)(functools.wraps(holds)(derive))

    return register


When = Callable[[Any, Scope], object]
"""Whether an element, which stands where the scope says, is refused. The annotation of the first parameter says which elements are asked about."""


def refusing(when: When) -> Derive:
    """The reference tool chain with one rule more: elements for which ``when`` holds are wrong."""

    def complaints(element: Element, scope: Scope) -> Iterator[Complaint]:
        if when(element, scope):
            yield element, "this is not how it is done"

    @functools.wraps(when)
    def derive(program: Program) -> Program:
        kind = next(iter(get_type_hints(when).values()))
        rule = Rule("overzealous", "", get_args(kind) or (kind,), complaints)
        return replace(program, rules={**program.rules, rule.name: rule})

    return derive


def refuses(*requirements: str, also: tuple[str, ...] = (), declares: tuple[str, ...] = ()) -> Callable[[When], Derive]:
    """Register a condition as the mutant that refuses each element for which it holds."""
    return lambda when: breaks(*requirements, also=also, declares=declares)(refusing(when))


def refusing_text(program: Program, pattern: bytes) -> Program:
    """``program``, but models in whose text the regular expression ``pattern`` is found are wrong to it."""

    def read(text: Source, file: str) -> Reading:
        reading = program.read(text, file)
        problem = Problem(kind="text", line=1, element="", message="is not written like that")
        return msgspec.structs.replace(reading, problems=(problem,)) if re.search(pattern, whole(text)) else reading

    return replace(program, read=read)
