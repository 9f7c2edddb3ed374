"""Tool chains that change the text of the IDL that the reference generates."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import replace

from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.mutants.toolchain.registry import Derive
from ucm_cts.adapters.reference.toolchain.program import Program

Files = Mapping[str, str]

MODEL = "model.idl"
"""The file that holds what follows from the model."""

STANDARD = "ucm.idl"
"""The file that holds what clause 12 prints."""

GUARD = "\n#endif\n"


def rewritten(program: Program, rewrite: Callable[[Files], Files]) -> Program:
    """``program`` with other files of IDL."""
    generate = program.generators["idl"]

    def wrong(model: Model) -> Files:
        return rewrite(generate(model))

    return replace(program, generators={**program.generators, "idl": wrong})


Replacement = str | Callable[[re.Match[str]], str]


def replaced(name: str, pattern: str, replacement: Replacement, file: str = MODEL) -> Derive:
    """Called ``name``: in ``file``, ``replacement`` stands for each match of ``pattern``."""

    def derive(program: Program) -> Program:
        return rewritten(program, lambda files: {**files, file: re.sub(pattern, replacement, files[file])})

    derive.__name__ = name
    return derive


def appended(name: str, text: str) -> Derive:
    """Called ``name``: ``text`` is the last declaration."""

    def derive(program: Program) -> Program:
        return rewritten(program, lambda files: {**files, MODEL: files[MODEL].replace(GUARD, f"\n{text}\n{GUARD}")})

    derive.__name__ = name
    return derive
