"""What mutants are made of: refusing more than the reference tool chain does, or overhearing what its reader says."""

from __future__ import annotations

import functools
import re
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any, get_args, get_type_hints

import msgspec

from ucm_cts.adapters.contract.metamodel.common import Element
from ucm_cts.adapters.contract.metamodel.names import Scope
from ucm_cts.adapters.contract.metamodel.reading import Problem, Reading
from ucm_cts.adapters.mutants.toolchain.registry import Derive, breaks
from ucm_cts.adapters.reference.toolchain.checking import Complaint, Rule
from ucm_cts.adapters.reference.toolchain.program import Program

When = Callable[[Any, Scope], object]
"""Whether an element, which stands where the scope says, is refused. The annotation of the first parameter says which elements are asked about."""


def refusing(when: When) -> Derive:
    """The reference tool chain with one rule more: elements for which ``when`` holds are wrong."""

    def look(element: Element, scope: Scope) -> Iterator[Complaint]:
        if when(element, scope):
            yield element, "this is not how it is done"

    @functools.wraps(when)
    def derive(program: Program) -> Program:
        kind = next(iter(get_type_hints(when).values()))
        rule = Rule("overzealous", "", get_args(kind) or (kind,), look)
        return replace(program, rules={**program.rules, rule.name: rule})

    return derive


def refuses(*requirements: str, also: tuple[str, ...] = (), declares: tuple[str, ...] = ()) -> Callable[[When], Derive]:
    """Register a condition as the mutant that refuses each element for which it holds."""
    return lambda when: breaks(*requirements, also=also, declares=declares)(refusing(when))


def refusing_text(program: Program, pattern: bytes) -> Program:
    """``program``, but models in whose text the regular expression ``pattern`` is found are wrong to it."""

    def read(text: bytes, file: str) -> Reading:
        reading = program.read(text, file)
        problem = Problem(kind="text", line=1, element="", message="is not written like that")
        return msgspec.structs.replace(reading, problems=(problem,)) if re.search(pattern, text) else reading

    return replace(program, read=read)
