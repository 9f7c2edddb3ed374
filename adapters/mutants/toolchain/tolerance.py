"""What mutants are made of: not hearing what the reader or a rule says, and doing without several rules."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

import msgspec

from ucm_cts.adapters.contract.metamodel.common import Element
from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.contract.metamodel.names import Scope
from ucm_cts.adapters.contract.metamodel.reading import Problem, Reading
from ucm_cts.adapters.mutants.toolchain.registry import replacing_rule
from ucm_cts.adapters.reference.toolchain.checking import Complaint
from ucm_cts.adapters.reference.toolchain.program import Program


def deaf(program: Program, when: Callable[[Problem, Model], object]) -> Program:
    """``program``, but problems in reading for which ``when`` holds do not count. It is given what could be read, too."""

    def read(text: bytes, file: str) -> Reading:
        reading = program.read(text, file)
        told = tuple(problem for problem in reading.problems if not when(problem, reading.model))
        return msgspec.structs.replace(reading, problems=told)

    return replace(program, read=read)


def without(program: Program, *rules: str) -> Program:
    """``program`` without the ``rules`` of these names."""
    for name in rules:
        program = replacing_rule(program, name, None)
    return program


def forgiving(program: Program, name: str, when: Callable[[Any], object]) -> Program:
    """``program``, but what the rule ``name`` says of elements for which ``when`` holds does not count."""
    known = program.rules[name].look

    def look(element: Element, scope: Scope) -> Iterator[Complaint]:
        return (complaint for complaint in known(element, scope) if not when(complaint[0]))

    return replacing_rule(program, name, look)


def lacks(problem: Problem, attribute: str, *tags: str) -> bool:
    """Whether ``problem`` is that an element of ``tags``, or any element if there are none, has no ``attribute``."""
    told = problem.message.endswith(f" has no {attribute}; give it one")
    return problem.kind == "missing attribute" and told and (not tags or problem.element in tags)
