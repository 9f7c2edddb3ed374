"""Links a program with the source files beside generated headers, and with libraries of the vendor."""

from __future__ import annotations

import fnmatch
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from ucm_cts.harness.toolchains.cpp.compiling import (
    STANDARDS,
    Compiled,
    Compiler,
    Headers,
    Layout,
    NoCompiler,
    compile_text,
    read_errors,
    run,
)

SUFFIXES = (".cpp", ".cc", ".cxx", ".C")


@dataclass(frozen=True)
class Linked:
    """``words`` of the command that links, after the program's own source; ``left_out`` says which files are not linked, and why."""

    words: tuple[str, ...] = ()
    left_out: tuple[str, ...] = ()


def linked(headers: Headers, standard: str, compiler: Compiler, folder: Path) -> Linked:
    """What a program that uses ``headers`` is linked with; ``folder`` is for what is made of it. Raises ``NoCompiler``.

    Source files that the vendor names are linked as they are. If the vendor names none, those that compile become an archive, from
    which the linker takes what the program needs: a demonstration with a main of its own, or a body that the user has yet
    to write, is no part of what is certified.
    """
    layout = headers.layout
    if layout.sources is not None:
        names = sorted(str(p.relative_to(headers.folder)) for p in headers.folder.rglob("*") if p.is_file())
        named = [str(headers.folder / n) for n in names if any(matches(n, pattern) for pattern in layout.sources)]
        return Linked((*named, *layout.libraries))
    objects, left_out = [], []
    for number, source in enumerate(_sources(headers.folder)):
        made = folder / f"source-{number}.o"
        why = _compiled(source, made, headers, standard, compiler)
        if why:
            left_out.append(f"{source.relative_to(headers.folder)} does not compile ({why}) and was not linked")
        else:
            objects.append(str(made))
    return Linked((*_archived(objects, folder, compiler), *layout.libraries), tuple(left_out))


def matches(name: str, pattern: str) -> bool:
    """Whether the file ``name`` fits ``pattern``, whose ``**/`` at the beginning stands for no folder, too."""
    return fnmatch.fnmatchcase(name, pattern) or fnmatch.fnmatchcase(name, pattern.removeprefix("**/"))


def is_code(layout: Layout, name: str) -> bool:
    """Whether the generated file ``name`` is a header or a source file by ``layout``."""
    sources = layout.sources if layout.sources is not None else tuple(f"**/*{suffix}" for suffix in SUFFIXES)
    return any(matches(name, pattern) for pattern in (*layout.headers, *sources))


def in_two_units(
    names: Sequence[str], headers: Headers, standard: str, compiler: Compiler, folder: Path, beside: Linked
) -> Compiled:
    """What the compiler and the linker say of a program of two translation units that include all of ``headers`` that have
    ``names``, one of them in the order of the names turned round. Raises ``NoCompiler``.
    """
    own = folder / "two-units"
    own.mkdir()
    second = own / "second.cpp"
    second.write_text("\n".join([*map(headers.include, names), ""]), encoding="utf-8")
    first = "\n".join([*map(headers.include, reversed(names)), "int main() { return 0; }", ""])
    words = (str(second), *beside.words)
    return compile_text(first, own, headers, standard, compiler, own / "program", words)


def _sources(folder: Path) -> Iterator[Path]:
    yield from sorted(p for p in folder.rglob("*") if p.suffix in SUFFIXES)


def _compiled(source: Path, made: Path, headers: Headers, standard: str, compiler: Compiler) -> str:
    """Make ``made`` of ``source``; why that cannot be done, nothing if it is done."""
    words = [*compiler.command, STANDARDS[standard], "-pedantic-errors", *headers.options, "-O0"]
    ended = run([*words, "-c", str(source), "-o", str(made)], made.parent, compiler)
    if ended.status == 0 and made.is_file():
        return ""
    first = next((f"line {e.line}: {e.message}" for e in read_errors(ended.errors)), "")
    return ended.problem or first or f"status {ended.status}"


def _archived(objects: list[str], folder: Path, compiler: Compiler) -> list[str]:
    """An archive of ``objects``, made where ``compiler`` runs; they themselves where none can be made."""
    archive = str(folder / "libsources.a")
    if not objects:
        return []
    try:
        is_made = run(["ar", "rcs", archive, *objects], folder, compiler).status == 0
    except NoCompiler:
        is_made = False
    return [archive] if is_made else objects
