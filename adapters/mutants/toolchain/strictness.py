"""What mutants are made of: refusing more than the reference tool chain does, or overhearing what its reader says."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

import msgspec

from ucm_cts.adapters.contract.metamodel.common import Element
from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.contract.metamodel.names import Scope
from ucm_cts.adapters.contract.metamodel.reading import Problem, Reading
from ucm_cts.adapters.mutants.toolchain.tolerance import deaf
from ucm_cts.adapters.reference.toolchain.checking import Complaint, Rule
from ucm_cts.adapters.reference.toolchain.program import Program


def refusing(program: Program, kind: type[Element], when: Callable[[Any, Scope], object]) -> Program:
    """``program``, but elements of ``kind`` for which ``when`` holds are wrong to it."""

    def look(element: Element, scope: Scope) -> Iterator[Complaint]:
        if when(element, scope):
            yield element, "this is not how it is done"

    return replace(program, rules={**program.rules, "overzealous": Rule("overzealous", "", (kind,), look)})


def refusing_text(program: Program, pattern: bytes) -> Program:
    """``program``, but models in whose text the regular expression ``pattern`` is found are wrong to it."""

    def read(text: bytes, file: str) -> Reading:
        reading = program.read(text, file)
        problem = Problem(kind="text", line=1, element="", message="is not written like that")
        return msgspec.structs.replace(reading, problems=(problem,)) if re.search(pattern, text) else reading

    return replace(program, read=read)


def overhearing(program: Program, kind: str, tag: str, attribute: str) -> Program:
    """``program``, but problems of ``kind`` with ``attribute`` of elements of ``tag`` do not count when models are read."""

    def overheard(problem: Problem, _: Model) -> bool:
        return (problem.kind, problem.element) == (kind, tag) and _tells_of(attribute, problem.message)

    return deaf(program, overheard)


def _tells_of(attribute: str, message: str) -> bool:
    return attribute in re.findall(r"\w+", message)
