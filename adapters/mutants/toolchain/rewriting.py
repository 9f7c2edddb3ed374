"""What mutants of mappings are made of: other text in place of what the reference tool chain generates, IDL or C++."""

from __future__ import annotations

import functools
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.mutants.toolchain.registry import Derive, breaks, named
from ucm_cts.adapters.reference.toolchain.program import Program

Files = Mapping[str, str]

MODEL = "model.idl"
"""The file that holds what follows from the model."""

STANDARD = "ucm.idl"
"""The file that holds what clause 12 prints."""

GUARD = "\n#endif\n"


def rewritten(program: Program, rewrite: Callable[[Files], Files], task: str = "idl") -> Program:
    """``program`` with other files for ``task``."""
    generate = program.generators[task]

    def other(model: Model) -> Files:
        return rewrite(generate(model))

    return replace(program, generators={**program.generators, task: other})


def rewriting(rewrite: Callable[[Files], Files], task: str = "idl") -> Derive:
    """The reference tool chain with other files for ``task``."""
    return functools.wraps(rewrite)(lambda program: rewritten(program, rewrite, task))


Replacement = str | Callable[[re.Match[str]], str]


def replaced(pattern: str, replacement: Replacement, file: str = MODEL) -> Derive:
    """In ``file``, ``replacement`` stands for each match of ``pattern``."""
    return lambda program: rewritten(program, lambda files: {**files, file: re.sub(pattern, replacement, files[file])})


def appended(text: str) -> Derive:
    """``text`` is the last declaration of the model's file."""
    return replaced(f"{GUARD}$", lambda _: f"\n{text}\n{GUARD}")


def replace_each(
    table: Mapping[str, tuple[str, str, str]],
    file: str = MODEL,
    also: Mapping[str, tuple[str, ...]] = {},
    declares: Mapping[str, tuple[str, ...]] = {},
) -> None:
    """Make each row of ``table`` a mutant: the requirement that it breaks, a pattern in ``file``, and what stands there instead.

    ``also`` and ``declares`` are by the mutant's name.
    """
    for name, (requirement, pattern, replacement) in table.items():
        register = breaks(requirement, task="idl", also=also.get(name, ()), declares=declares.get(name, ()))
        register(named(replaced(pattern, replacement, file), name))


BOTH = ("cpp11", "cpp03")
CPP11 = ("cpp11",)
CPP03 = ("cpp03",)

Edits = Mapping[str, str]
"""Patterns, over lines, and what stands for each match in every file; one is replaced after the other."""


def edited(task: str, edits: Edits) -> Derive:
    """Makes ``edits`` in what ``task`` generates."""

    def rewrite(files: Files) -> Files:
        changed = dict(files)
        for pattern, replacement in edits.items():
            changed = {name: re.sub(pattern, replacement, text, flags=re.DOTALL) for name, text in changed.items()}
        return changed

    return lambda program: rewritten(program, rewrite, task)


def sentence(name: str) -> str:
    """What a name says."""
    return f"{name.replace('_', ' ').capitalize()}."


@dataclass(frozen=True)
class Wrong:
    """``edits`` break each requirement of ``breaks`` for the standards of ``tasks``; the same defect breaks those of ``also`` besides.

    ``declares`` are the readings that the tool chain claims.
    """

    breaks: str
    edits: Edits
    also: str = ""
    tasks: Sequence[str] = BOTH
    declares: tuple[str, ...] = ()


SHOWN_BY: dict[str, str] = {}
"""By the mutant's name: the mapping model that shows what is wrong."""


def register(model: str, wrong: Mapping[str, Wrong]) -> None:
    """Make each a mutant for each standard that it concerns, which ``model``, one of the mapping's, shows.

    Its name ends with the standard.
    """
    for says, one in wrong.items():
        for task in one.tasks:
            name = f"{says}_{task}"
            SHOWN_BY[name] = model
            entered = breaks(*one.breaks.split(), task=task, also=tuple(one.also.split()), declares=one.declares)
            entered(named(edited(task, one.edits), name, sentence(says)))
