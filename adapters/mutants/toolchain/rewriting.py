"""Tool chains that change the text of what the reference generates."""

from __future__ import annotations

import functools
import re
from collections.abc import Callable, Mapping
from dataclasses import replace

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
