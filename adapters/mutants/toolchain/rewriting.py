"""Building blocks of mutants that generate IDL or C++: they replace parts of the text of the reference tool chain."""

from __future__ import annotations

import functools
import re
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import TypeVar

import msgspec

from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.contract.value import Value
from ucm_cts.adapters.mutants.toolchain.registry import Derive, breaks, named
from ucm_cts.adapters.reference.toolchain.program import Program

Files = Mapping[str, str]

MODEL = "model.idl"
"""The file that holds what follows from the model."""

STANDARD = "ucm.idl"
"""The file that holds what clause 12 prints."""

GUARD = "\n#endif\n"

Replacement = str | Callable[[re.Match[str]], str]

Edits = Mapping[str, Replacement]
"""Patterns, and what stands for each match; one is replaced after the other."""


def rewritten(program: Program, rewrite: Callable[[Files], Files], task: str = "idl") -> Program:
    """``program`` with other files for ``task``."""
    generate = program.generators[task]

    def other(model: Model) -> Files:
        return rewrite(generate(model))

    return replace(program, generators={**program.generators, task: other})


def rewriting(rewrite: Callable[[Files], Files], task: str = "idl") -> Derive:
    """The reference tool chain with other files for ``task``."""
    return functools.wraps(rewrite)(lambda program: rewritten(program, rewrite, task))


def substituted(text: str, edits: Edits, flags: int = 0) -> str:
    """``text`` with what stands for each match of the patterns of ``edits``, one after the other."""
    for pattern, replacement in edits.items():
        text = re.sub(pattern, replacement, text, flags=flags)
    return text


def replaced(pattern: str, replacement: Replacement, file: str = MODEL) -> Derive:
    """In ``file`` of IDL, ``replacement`` stands for each match of ``pattern``."""
    return replacing({pattern: replacement}, file)


def replacing(edits: Edits, file: str = MODEL) -> Derive:
    """Makes ``edits`` in ``file`` of IDL."""
    return lambda program: rewritten(program, lambda files: {**files, file: substituted(files[file], edits)})


def appended(text: str) -> Derive:
    """``text`` is the last declaration of the model's file."""
    return replaced(f"{GUARD}$", lambda _: f"\n{text}\n{GUARD}")


BOTH = ("cpp11", "cpp03")
CPP11 = ("cpp11",)
CPP03 = ("cpp03",)


def edited(task: str, edits: Edits) -> Derive:
    """Makes ``edits`` in every file of C++ that ``task`` generates."""
    return lambda program: rewritten(
        program,
        lambda files: {name: substituted(text, edits, re.DOTALL) for name, text in files.items()},
        task,
    )


def sentence(name: str) -> str:
    """What a name says."""
    return f"{name.replace('_', ' ').capitalize()}."


class Wrong(Value, frozen=True):
    """``edits`` break each requirement of ``breaks`` for the standards of ``tasks``; the same defect breaks those of ``also`` besides.

    ``declares`` are the readings that the tool chain claims. A variant breaks nothing.
    """

    edits: dict[str, str]
    breaks: str = ""
    also: str = ""
    tasks: tuple[str, ...] = BOTH
    declares: tuple[str, ...] = ()


Shape = TypeVar("Shape")


def table(path: str, shape: type[Shape]) -> Shape:
    """The table in the file ``path`` beside this module."""
    return msgspec.yaml.decode((Path(__file__).parent / path).read_bytes(), type=shape)


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
