"""Compares the files generated from a model with what clause 13 asks for."""

from __future__ import annotations

import functools
from collections.abc import Mapping

from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.harness.toolchains.cpp.compiling import LAYOUT, Compiler, Layout
from ucm_cts.harness.toolchains.cpp.linking import matches
from ucm_cts.harness.toolchains.cpp.probes.running import check_files
from ucm_cts.harness.toolchains.differences import Comparison
from ucm_cts.reference_models.mapping.cpp.expected import ExpectedCpp, Standard
from ucm_cts.reference_models.mapping.cpp.mapping import expected_cpp


def compare(
    model: Model,
    files: Mapping[str, str],
    standard: Standard,
    readings: Mapping[str, str],
    compiler: Compiler,
    layout: Layout = LAYOUT,
) -> Comparison:
    """Hold ``files``, texts by name, against what ``model`` becomes in C++.

    ``layout`` says which of them are headers, where headers are searched, and what is linked. Raises ``NoCompiler``.
    """
    headers = tuple(name for name in sorted(files) if any(matches(name, pattern) for pattern in layout.headers))
    expected = expected_cpp(model, standard, readings)
    return _compared(expected, tuple(sorted(files.items())), headers, compiler, layout)


@functools.lru_cache(maxsize=64)
def _compared(
    expected: ExpectedCpp,
    files: tuple[tuple[str, str], ...],
    headers: tuple[str, ...],
    compiler: Compiler,
    layout: Layout,
) -> Comparison:
    """The same files are compiled once: most models come out alike from tool chains that differ in one thing."""
    return check_files(expected, dict(files), headers, compiler, layout)
