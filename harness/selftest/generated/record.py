"""The record of generated mutants: a file with one line each, written at once, and the list of equivalents."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import msgspec

from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.catalogue.documents import DocumentError, read
from ucm_cts.harness.selftest.generated.mutants import GeneratedMutant
from ucm_cts.harness.selftest.generated.trial import Fate, Outcome


class Result(Value, frozen=True):
    """One mutant and its fate."""

    mutant: GeneratedMutant
    outcome: Outcome


class Equivalent(Value, frozen=True):
    """Mutants that are frameworks as conformant as the original, and why: no clause distinguishes the two.

    Each of ``mutants`` is a ``GeneratedMutant.key``.
    """

    reason: str
    mutants: tuple[str, ...]


class Line(Value, frozen=True):
    """One line of the file of results: ``mutant`` is a ``GeneratedMutant.digest``, the other fields are those of ``Outcome``."""

    mutant: str
    fate: Fate
    by: str = ""


def read_results(path: Path) -> dict[str, Outcome]:
    """The outcomes in the file at ``path``, by digest; the last line of a mutant counts. Raises ``DocumentError``."""
    results: dict[str, Outcome] = {}
    if not path.exists():
        return results
    decoder = msgspec.json.Decoder(Line)
    for number, text in enumerate(path.read_bytes().splitlines(), 1):
        try:
            line = decoder.decode(text)
        except msgspec.DecodeError as error:
            raise DocumentError(path, number, f"is no result of a generated mutant: {error}; remove the line") from None
        results[line.mutant] = Outcome(line.fate, line.by)
    return results


def append(path: Path, mutant: GeneratedMutant, outcome: Outcome) -> None:
    """Add a line to the file at ``path``, so that an interrupted run continues after ``mutant``."""
    with path.open("ab") as file:
        file.write(msgspec.json.encode(Line(mutant.digest, outcome.fate, outcome.by)) + b"\n")


def read_equivalents(path: Path) -> Mapping[str, str]:
    """The reasons by key. Raises ``DocumentError``, also for a key that is there twice."""
    reasons: dict[str, str] = {}
    for entry in read(path, list[Equivalent]):
        for key in entry.mutants:
            if key in reasons:
                raise DocumentError(path, None, f"'{key}' is there twice; keep one")
            reasons[key] = " ".join(entry.reason.split())
    return reasons
