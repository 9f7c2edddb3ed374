"""Runs a compiler, or a compiled program, within limits of time, memory and output, and reads its messages line by line."""

from __future__ import annotations

import json
import os
import re
import shutil
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.toolchains.commands import bounded
from ucm_cts.harness.toolchains.commands.bounded import Ended
from ucm_cts.harness.toolchains.cpp.disguise import TAG, Disguise

STANDARDS = {"cpp11": "-std=c++11", "cpp03": "-std=c++03"}

_OUTPUT = 16 << 20
_LIMITED = 'ulimit -v "$0"; ulimit -f "$1"; ulimit -c 0; ulimit -s "$(ulimit -H -s)"; shift; exec "$@"'


class Compiler(Value, frozen=True):
    """The compiler: ``command`` is its name and its options, such as folders of headers.

    ``seconds`` is how long one run may take, ``memory`` how many MiB. ``sandbox``: it, and what it makes, run in a sandbox where
    there is one; they see what their words name.
    """

    command: tuple[str, ...] = ("g++",)
    seconds: float = 60.0
    memory: int = 4096
    sandbox: bool = True
    network: bool = True
    """Whether there is a network in the sandbox."""


@dataclass(frozen=True)
class Error:
    """What the compiler has against a line; ``notes`` are other places that it names, as file and line."""

    file: str
    line: int
    message: str
    fatal: bool = False
    notes: tuple[tuple[str, int], ...] = ()


class Layout(Value, frozen=True):
    """Where generated files are: ``include`` are the folders where headers are searched, ``headers`` patterns of those that a
    user includes, and ``sources`` patterns of files that are linked, None for those that are found to be needed. ``libraries``
    are words for the linker that follow.
    """

    include: tuple[str, ...] = (".",)
    headers: tuple[str, ...] = ("**/*.h", "**/*.hh", "**/*.hpp", "**/*.hxx")
    sources: tuple[str, ...] | None = None
    libraries: tuple[str, ...] = ()


LAYOUT = Layout()
"""Where files are unless the vendor says otherwise."""


@dataclass(frozen=True)
class Headers:
    """Generated files: ``names`` of headers below ``folder``, which is laid out as ``layout`` says."""

    folder: Path
    names: tuple[str, ...]
    layout: Layout = LAYOUT

    @property
    def options(self) -> list[str]:
        """The options that name the folders."""
        return [word for below in self.layout.include for word in ("-I", str(self.folder / below))]

    def include(self, name: str) -> str:
        """The directive for the header ``name``: by its whole path, which no folder that is looked in can make another's."""
        return f'#include "{self.folder / name}"'

    @property
    def all_included(self) -> list[str]:
        """The directives for all of them that have one."""
        return [self.include(name) for name in self.names if can_be_named(name)]


_SYSTEM_HEADER = re.compile(r"^([ \t]*#[ \t]*pragma[ \t]+\w+[ \t]+)system_header\b", re.MULTILINE)


def judged_like_all(text: str) -> str:
    """A header's ``text`` without the pragma that makes it one of the system's, of which compilers tell no extensions."""
    return _SYSTEM_HEADER.sub(r"\1system_headed", text)


def can_be_named(name: str) -> bool:
    """Whether there is a directive that includes the file ``name``."""
    return name.isprintable() and '"' not in name


class NoCompiler(Exception):
    """The compiler cannot be run; the message says why and what to do."""


def run(words: Sequence[str], folder: Path, compiler: Compiler, needed: Sequence[Path] = ()) -> Ended:
    """Run ``words`` in ``folder`` within the limits of ``compiler``; files and folders that they do not name are ``needed``.

    Raises ``NoCompiler`` if there is no such program.
    """
    limits = [str(compiler.memory * 1024), str(_OUTPUT * 16 // 512)]
    shell = ["/bin/sh", "-c", _LIMITED, *limits, *words]
    environment = {**os.environ, "LC_ALL": "C.UTF-8"}
    seen: list[str | Path] = [*_paths_in(words), *needed]
    view = bounded.view_for(seen, compiler.memory, sandbox=compiler.sandbox, network=compiler.network)
    ended = bounded.run(
        shell,
        folder,
        compiler,
        kept=_OUTPUT,
        flood=_OUTPUT * 4,
        apart=True,
        environment=environment,
        view=view,
    )
    if ended.incident and ended.incident.kind == "unreachable":
        raise NoCompiler(ended.problem)
    if ended.status == 127 and not can_be_run(words[0]):
        raise NoCompiler(f"no program '{words[0]}' can be run; install it or name another compiler")
    return ended


def _paths_in(words: Sequence[str]) -> list[str]:
    """The files and folders that options and arguments name."""
    return [word[word.index("/") :] for word in words if "/" in word and "\0" not in word]


def can_be_run(program: str) -> bool:
    """Whether the operating system finds ``program``."""
    return shutil.which(program) is not None


@dataclass(frozen=True)
class Compiled:
    """What the compiler said of a translation unit; ``problem`` is why it said nothing that counts."""

    errors: tuple[Error, ...]
    problem: str = ""

    @property
    def ended_early(self) -> bool:
        """Whether it gave up before the end."""
        return bool(self.problem) or any(error.fatal for error in self.errors)


def compile_text(
    text: str,
    folder: Path,
    headers: Headers,
    standard: str,
    compiler: Compiler,
    made: Path | None = None,
    linked: Sequence[str] = (),
) -> Compiled:
    """Compile ``text``, a translation unit that includes ``headers``; with ``made`` link it with what ``linked`` names,
    too. ``folder`` is where it is written to. Raises ``NoCompiler``.
    """
    disguise = Disguise()
    source = folder / "probes.cpp"
    source.write_text(disguise.put_on(text), encoding="utf-8")
    words = [*compiler.command, STANDARDS[standard], "-pedantic-errors", *headers.options]
    words += ["-O0", str(source), *linked, "-o", str(made)] if made else ["-fsyntax-only", str(source)]
    structured = [*words, "-fmax-errors=0", "-fdiagnostics-format=json"]
    ended = run(structured, folder, compiler)
    text = disguise.taken_off(ended.errors)
    found = _read_json(text)
    if ended.status not in (0, None) and (not found or not all(is_own(e.file) for e in found)):
        all_of_them = ["-ferror-limit=0"] if "clang" in text.partition(":")[0] else []
        ended = run([*words, *all_of_them], folder, compiler)
        text = disguise.taken_off(ended.errors)
        found = read_errors(text)
    if ended.problem:
        return Compiled(tuple(found or ()), ended.problem)
    if ended.status != 0 and not found:
        line = next((s for s in text.splitlines() if s.strip()), f"status {ended.status}")
        return Compiled((), f"the compiler failed: {line.strip()[:300]}")
    return Compiled(tuple(found or ()))


_TAG = re.compile(f"{TAG}$", re.ASCII)
_OWN = ("R-", "body#", "support#")


def is_tag(file: str) -> bool:
    """Whether ``file`` is a name that probes give themselves."""
    return _TAG.match(file) is not None


def is_own(file: str) -> bool:
    """Whether ``file`` is the name of one probe, or of what it is made of."""
    return is_tag(file) and file.startswith(_OWN)


def _read_json(errors: str) -> list[Error] | None:
    """The errors of every array of diagnostics, one a source file; None if there is none."""
    found: list[Error] | None = None
    for line in errors.splitlines():
        if line.startswith("["):
            try:
                diagnostics = json.loads(line)
            except ValueError:
                continue
            found = (found or []) + list(_of_json(diagnostics))
    return found


def _of_json(diagnostics: list[dict[str, Any]]) -> Iterator[Error]:
    for diagnostic in diagnostics:
        kind = diagnostic.get("kind", "")
        if kind in ("error", "fatal error", "sorry, unimplemented"):
            file, line = _place(diagnostic)
            notes = tuple(_place(child) for child in diagnostic.get("children", ()))
            yield Error(file, line, diagnostic.get("message", ""), kind == "fatal error", notes)


def _place(diagnostic: dict[str, Any]) -> tuple[str, int]:
    for location in diagnostic.get("locations", ()):
        caret = location.get("caret", {})
        return caret.get("file", ""), int(caret.get("line", 0))
    return "", 0


_LINE = re.compile(
    r"(?P<file>[^\s:(][^:(]*)[:(](?P<line>\d+)(?:[:,]\d+)?\)?:\s*"
    r"(?P<kind>error|fatal error|note|required from|recursively required)?(?: [A-Z]+\d+)?:?\s*(?P<message>.*)$"
)


def read_errors(errors: str) -> list[Error]:
    """Errors as compilers print them; one inside a template counts for the probe that it was instantiated for, which is named
    before the error or in notes after it.
    """
    found: list[Error] = []
    around = ""
    for line in errors.splitlines():
        match = _LINE.match(line)
        if match is None:
            undefined = re.match(r".*(undefined reference to .*|multiple definition of .*)", line)
            if undefined:
                found.append(Error("", 0, undefined[1]))
            if ": In " in line:
                around = ""
            continue
        file, kind = match["file"], match["kind"] or ""
        if kind in ("error", "fatal error"):
            place = (file, int(match["line"]))
            notes = () if is_tag(file) else (place,)
            tag = file if is_own(file) else around or file
            found.append(Error(tag, place[1], match["message"], kind == "fatal error", notes))
        elif is_own(file) and kind == "note" and found and not is_own(found[-1].file):
            last = found.pop()
            found.append(Error(file, last.line, last.message, last.fatal, ((last.file, last.line),)))
        elif is_own(file) and "required from" in line:
            around = file
    return found
