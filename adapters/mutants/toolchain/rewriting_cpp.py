"""Tool chains that change the text of the C++ that the reference generates."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from ucm_cts.adapters.mutants.toolchain.registry import Derive, breaks, named
from ucm_cts.adapters.mutants.toolchain.rewriting import Files, rewritten

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
