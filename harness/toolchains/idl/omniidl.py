"""Compiles generated IDL with omniidl as well, where it is installed and knows all that the files use.

omniidl knows neither annotations, which are blanked in place, nor template modules, nor IDL 4's names of integers.
"""

from __future__ import annotations

import re
import shutil
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

from ucm_cts.harness.toolchains.commands import bounded
from ucm_cts.harness.toolchains.idl.language.preprocessing import Preprocessed
from ucm_cts.harness.toolchains.idl.language.problems import Problem
from ucm_cts.harness.toolchains.idl.language.reading import read_files
from ucm_cts.harness.toolchains.idl.language.scopes import build, every
from ucm_cts.harness.toolchains.idl.language.showing import type_of
from ucm_cts.reference_models.mapping.idl import declarations as idl


@dataclass(frozen=True)
class _Limits:
    seconds: float = 60.0
    memory: int = 1024


LIMITS = _Limits()
"""What omniidl may take: seconds and MiB."""

NEW_TYPES = ("int8", "uint8", "int16", "uint16", "int32", "uint32", "int64", "uint64")

TOLERATED = re.compile(r"Value too large for long long|.* clashes with (use of )?identifier ")
"""What is not held against IDL: omniidl reads the least value of long long without its sign; and a name that was used in a scope
cannot be declared there, which a name of clause 12.10 does itself.
"""


@dataclass(frozen=True)
class Opinion:
    """``agreed``, ``refused`` with problems, or ``none`` with the reason why there is no opinion."""

    verdict: Literal["agreed", "refused", "none"]
    problems: tuple[Problem, ...] = ()
    reason: str = ""


ASKED_ABOUT = "R-12.1-03"
"""The requirement that omniidl helps to decide."""


def missing() -> str:
    """Why omniidl cannot be asked at all; empty if it can."""
    return "" if shutil.which("omniidl") else "omniidl is not installed; Debian's package is omniidl"


def opinion(files: Mapping[str, str], sandbox: bool = True, network: bool = True) -> Opinion:
    """What omniidl thinks of ``files`` (name to text), taken together in the order of their includes.

    ``sandbox``: it runs in one where there is one, with a ``network`` or without.
    """
    program = shutil.which("omniidl")
    if program is None:
        return Opinion("none", reason=missing())
    read = read_files(files)
    if read.problems:
        return Opinion("none", reason=f"not read by the suite: {read.problems[0]}")
    beyond = next(_beyond(read.declarations), "")
    if beyond or read.missing:
        return Opinion("none", reason=beyond or f"{read.missing[0]} is not among the files")
    with bounded.own_folder() as folder:
        (folder / "all.idl").write_text("\n".join(joined(files, read.left)) + "\n")
        view = bounded.view_for([program], LIMITS.memory, sandbox=sandbox, network=network)
        ran = bounded.run([program, "-N", "-nf", "-nc", "all.idl"], folder, LIMITS, apart=True, view=view)
    if ran.problem:
        return Opinion("none", reason=f"omniidl came to no end: {ran.problem}")
    if ran.status == 0:
        return Opinion("agreed")
    problems = _problems(ran.errors + ran.output, list(files))
    held = tuple(problem for problem in problems if not TOLERATED.match(problem.text))
    return (
        Opinion("refused", held) if held else Opinion("none", reason=f"not held against it: {ran.errors.strip()[:300]}")
    )


def _beyond(files: Mapping[str, tuple[idl.Declaration, ...]]) -> Iterator[str]:
    """Why omniidl cannot say anything."""
    for entry in every(build(files)):
        declaration = entry.declaration
        if isinstance(declaration, idl.ModuleInstance) or (
            isinstance(declaration, idl.Module) and declaration.parameters
        ):
            yield f"{declaration.name} is a template module or an instance of one"
        if isinstance(declaration, idl.Extended):
            yield f"{declaration.name} is a {declaration.kind}"
        type_ = type_of(declaration)
        while isinstance(type_, (idl.SequenceOf, idl.ArrayOf, idl.Annotated)):
            type_ = type_.type if isinstance(type_, idl.Annotated) else type_.element
        if type_ == idl.Named("bool"):
            yield f"{declaration.name} is of type bool, which clause 12 prints"
        if isinstance(type_, idl.Basic) and type_.name in NEW_TYPES:
            yield f"{declaration.name} is of type {type_.name}"


def joined(files: Iterable[str], left: Preprocessed) -> Iterator[str]:
    """The lines of all files as a preprocessor would hand them on: each file once, where it is first included, under its number
    among ``files``, because names may hold anything.
    """
    done: set[str] = set()
    numbers = {name: number for number, name in enumerate(files)}

    def lines(name: str) -> Iterator[str]:
        if name in done:
            return
        done.add(name)
        yield f'# 1 "{numbers[name]}"'
        included = dict(left.includes[name])
        for number, line in enumerate(without_annotations(left.texts[name]).split("\n"), 1):
            if number in included:
                yield from lines(included[number])
                yield f'# {number} "{numbers[name]}"'
            yield line

    for name in left.roots:
        yield from lines(name)


_ANNOTATION = re.compile(
    r"@\s*annotation\s+\w+\s*\{[^{}]*\}\s*;?"
    r"|@\s*(?:::)?\w+(?:::\w+)*(?:\s*\((?:\"(?:\\.|[^\"\\\n])*\"|'(?:\\.|[^'\\\n])+'|[^()\"']|\([^()]*\))*\))?"
    r"|(?P<kept>\"(?:\\.|[^\"\\\n])*\")",
    re.IGNORECASE,
)


def without_annotations(text: str) -> str:
    """``text``, which has no comments, with blanks instead of annotations."""
    return _ANNOTATION.sub(lambda m: m[0] if m["kept"] else re.sub(r"[^\n]", " ", m[0]), text)


def _problems(output: str, files: Sequence[str]) -> Iterator[Problem]:
    for line in output.splitlines():
        found = re.match(r"(\d+):(\d+): (?!\s)(.*)", line)
        if found and int(found[1]) < len(files) and not found[3].startswith(("Warning", "(")):
            yield Problem(files[int(found[1])], int(found[2]), 1, found[3])
