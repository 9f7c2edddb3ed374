"""Tool chains that print one finding at a time, whichever: what they print decides nothing about what they refuse."""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.contract.metamodel.reading import Source
from ucm_cts.adapters.mutants.toolchain.registry import variant
from ucm_cts.adapters.reference.toolchain.diagnostics import Diagnostic
from ucm_cts.adapters.reference.toolchain.program import Program

Choose = Callable[[Sequence[Diagnostic]], Diagnostic]


@dataclass(frozen=True)
class _PrintsOne(Program):
    """A program that prints the one diagnostic which ``choose`` takes."""

    choose: Choose = lambda found: found[0]

    def check(self, text: Source, file: str) -> tuple[Model | None, list[Diagnostic]]:
        model, found = super().check(text, file)
        return model, [self.choose(found)] if found else []


def _printing(program: Program, choose: Choose) -> Program:
    return _PrintsOne(program.read, program.rules, program.generators, choose=choose)


@variant()
def prints_first(program: Program) -> Program:
    """Prints the first of its findings only."""
    return _printing(program, lambda found: found[0])


@variant()
def prints_last(program: Program) -> Program:
    """Prints the last of its findings only."""
    return _printing(program, lambda found: found[-1])


@variant()
def prints_random(program: Program) -> Program:
    """Prints one of its findings, drawn for each model."""
    return _printing(program, lambda found: random.Random(str(found[0])).choice(found))
