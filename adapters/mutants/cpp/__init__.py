"""Native mutants: frameworks derived from the C++ reference framework that are wrong in one point each.

They are one executable; the environment variable ``UCM_CTS_MUTANT`` names the mutant. The framework itself
has no wrong code: the executable is the framework's adapter as it is, linked with other ``Parts``.
"""

from __future__ import annotations

import json
import os
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import msgspec

from ucm_cts.adapters.contract.value import Value

COMMAND = Path(__file__).parents[2] / "bin" / "reference-cpp-mutants"
"""The executable; an installed ucm-cts has it."""

VARIABLE = "UCM_CTS_MUTANT"


class NativeMutant(Value, frozen=True):
    """A native mutant as the executable describes it: which ``requirements`` it must fail (of a rare defect, one of them),
    which it may fail ``also``, the ``clauses`` whose test purposes must detect it, and what its vendor declares.
    """

    name: Annotated[str, msgspec.Meta(min_length=1)]
    lie: str
    requirements: tuple[str, ...]
    clauses: tuple[str, ...]
    also: tuple[str, ...] = ()
    is_rare: bool = False
    readings: dict[str, str] = {}


def native_mutants(command: Path = COMMAND) -> dict[str, NativeMutant]:
    """All native mutants by name. Raises ``OSError`` if the executable is not there."""
    listed = subprocess.run([command], env={**os.environ, VARIABLE: "list"}, capture_output=True, text=True, check=True)
    found = (msgspec.convert(json.loads(line), NativeMutant) for line in listed.stdout.splitlines())
    return {mutant.name: mutant for mutant in found}


@contextmanager
def being(name: str) -> Iterator[None]:
    """Hosts that are started meanwhile are the mutant ``name``."""
    before = os.environ.get(VARIABLE)
    os.environ[VARIABLE] = name
    try:
        yield
    finally:
        if before is None:
            del os.environ[VARIABLE]
        else:
            os.environ[VARIABLE] = before
