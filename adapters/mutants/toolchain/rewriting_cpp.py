"""Tool chains that change the text of the C++ that the reference generates."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.mutants.toolchain.registry import Derive, breaks
from ucm_cts.adapters.reference.toolchain.program import Program

Files = Mapping[str, str]

BOTH = ("cpp11", "cpp03")
CPP11 = ("cpp11",)
CPP03 = ("cpp03",)

Edit = tuple[str, str]
"""A pattern, over lines, and what stands for each match in every file."""


def regenerated(program: Program, task: str, rewrite: Callable[[Files], Files]) -> Program:
    """``program`` with other files for ``task``."""
    generate = program.generators[task]

    def other(model: Model) -> Files:
        return rewrite(generate(model))

    return replace(program, generators={**program.generators, task: other})


def edited(name: str, task: str, says: str, edits: Sequence[Edit]) -> Derive:
    """Called ``name``: makes ``edits``, one after the other, in what ``task`` generates."""

    def rewrite(files: Files) -> Files:
        changed = dict(files)
        for pattern, replacement in edits:
            changed = {name: re.sub(pattern, replacement, text, flags=re.DOTALL) for name, text in changed.items()}
        return changed

    def derive(program: Program) -> Program:
        return regenerated(program, task, rewrite)

    derive.__name__ = name
    derive.__doc__ = says
    return derive


@dataclass(frozen=True)
class Wrong:
    """``model``, one of the mapping's, shows that ``breaks`` are broken by ``edits``; ``also`` are those that the same defect breaks
    besides.
    """

    model: str
    breaks: str
    edits: Sequence[Edit]
    also: str = ""
    tasks: Sequence[str] = BOTH
    declares: tuple[str, ...] = ()


SHOWN_BY: dict[str, str] = {}
"""By the mutant's name: the mapping model that shows what is wrong."""


def register(wrong: Mapping[str, Wrong]) -> None:
    """Make each a mutant for each standard that it concerns; its name ends with the standard."""
    for says, one in wrong.items():
        for task in one.tasks:
            name = f"{says}_{task}"
            SHOWN_BY[name] = one.model
            entered = breaks(*one.breaks.split(), task=task, also=tuple(one.also.split()), declares=one.declares)
            entered(edited(name, task, f"{says.replace('_', ' ').capitalize()}.", one.edits))
