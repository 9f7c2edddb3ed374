"""From a model and the files that were made of it to what they come to under clause 13."""

from __future__ import annotations

import fnmatch
import functools
from collections.abc import Mapping, Sequence

from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.harness.toolchains.cpp.compiling import Compiler
from ucm_cts.harness.toolchains.cpp.probes import check_files
from ucm_cts.harness.toolchains.differences import Comparison
from ucm_cts.reference_models.cpp.expected import ExpectedCpp, Standard
from ucm_cts.reference_models.cpp.mapping import expected_cpp

HEADERS = ("**/*.h", "**/*.hh", "**/*.hpp", "**/*.hxx")


def compare(
    model: Model,
    files: Mapping[str, str],
    standard: Standard,
    readings: Mapping[str, str],
    compiler: Compiler,
    include: Sequence[str] = (".",),
    patterns: Sequence[str] = HEADERS,
) -> Comparison:
    """Hold ``files``, texts by name, against what ``model`` becomes in C++.

    ``patterns`` say which of them are headers, ``include`` in which folders among them headers are looked for. Raises
    ``NoCompiler``.
    """
    headers = tuple(name for name in sorted(files) if any(_matches(name, pattern) for pattern in patterns))
    expected = expected_cpp(model, standard, readings)
    return _compared(expected, tuple(sorted(files.items())), headers, compiler, tuple(include))


@functools.lru_cache(maxsize=64)
def _compared(
    expected: ExpectedCpp,
    files: tuple[tuple[str, str], ...],
    headers: tuple[str, ...],
    compiler: Compiler,
    include: tuple[str, ...],
) -> Comparison:
    """The same files are compiled once: most models come out alike from tool chains that differ in one thing."""
    return check_files(expected, dict(files), headers, compiler, include)


def _matches(name: str, pattern: str) -> bool:
    return fnmatch.fnmatchcase(name, pattern) or fnmatch.fnmatchcase(name, pattern.removeprefix("**/"))
