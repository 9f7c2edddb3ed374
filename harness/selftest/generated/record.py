"""What is known of generated mutants: a file with a line each, written as soon as it is known, and the list of equivalents."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import msgspec

from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.catalogue.documents import DocumentError, read
from ucm_cts.harness.selftest.generated.mutants import GeneratedMutant
from ucm_cts.harness.selftest.generated.trial import Outcome


class Result(Value, frozen=True):
    """One mutant and what became of it."""

    mutant: GeneratedMutant
    outcome: Outcome


class Equivalent(Value, frozen=True):
    """Mutants that are frameworks as conformant as the original, and why: no clause tells the two apart.

    Each of ``mutants`` is a ``GeneratedMutant.key``.
    """

    reason: str
    mutants: tuple[str, ...]


def read_results(path: Path) -> dict[str, Result]:
    """What the file at ``path`` holds, by key; the last word counts. Raises ``DocumentError``."""
    results: dict[str, Result] = {}
    if not path.exists():
        return results
    decoder = msgspec.json.Decoder(Result)
    for number, line in enumerate(path.read_bytes().splitlines(), 1):
        try:
            result = decoder.decode(line)
        except msgspec.DecodeError as error:
            raise DocumentError(path, number, f"is no result of a generated mutant: {error}; remove the line") from None
        results[result.mutant.key] = result
    return results


def append(path: Path, result: Result) -> None:
    """Keep ``result``, so that a run that is broken off goes on after it."""
    with path.open("ab") as file:
        file.write(msgspec.json.encode(result) + b"\n")


def read_equivalents(path: Path) -> Mapping[str, str]:
    """The reasons by key. Raises ``DocumentError``, also for a key that is there twice."""
    reasons: dict[str, str] = {}
    for entry in read(path, list[Equivalent]):
        for key in entry.mutants:
            if key in reasons:
                raise DocumentError(path, None, f"'{key}' is there twice; keep one")
            reasons[key] = " ".join(entry.reason.split())
    return reasons
