"""The units of a campaign plan: what one worker does at a time, as values with a content address.

A unit says all that decides its result, and nothing else: the digest of the suite, that of the product, its settings, the seed and the
part. Its address is the digest of that. So a result that is kept under an address is never asked for again, and never taken for another.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Sequence

import msgspec

from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.execution.confirmation import timed_requirements
from ucm_cts.harness.purposes.scripts import TestPurpose
from ucm_cts.harness.results.known_failures import KnownFailure
from ucm_cts.harness.selftest.generated.mutants import GeneratedMutant
from ucm_cts.harness.selftest.trials import Thoroughness


class PlannedRun(Value, frozen=True):
    """All that decides what one run on a framework measures.

    ``suite``, ``product``, ``stated``: digests of the suite, of the product's files, and of its statement.
    ``adapter``: as on the command line; a path is relative to the folder of the plan.
    ``statement``: the path of the statement, relative too; empty for the one that is published with the adapter, or the default.
    ``artifacts``: paths of files that belong to the product, relative too.
    ``select``: what ``-k`` selects; empty for the whole profile.
    ``systematic``, ``virtual_time``, ``sandbox``, ``timeout``, ``memory``, ``incident_time``: as the options of ``ucm-cts run``.
    """

    suite: str
    product: str
    stated: str
    adapter: str
    statement: str
    artifacts: tuple[str, ...]
    profile: str
    seed: int
    select: str
    systematic: int
    virtual_time: bool
    sandbox: bool
    timeout: float
    memory: int
    incident_time: float


class Slice(Value, frozen=True, tag="slice"):
    """The test purposes of ``run`` from place ``first`` up to, and without, place ``end``; ``timed``: some depend on time."""

    run: PlannedRun
    first: int
    end: int
    timed: bool


class Conclusion(Value, frozen=True, tag="conclusion"):
    """The end of ``run``: what its ``parts`` showed is joined, confirmed and shortened, and becomes the report.

    ``known``: the known failures. ``lost``: parts that gave no result; the report is incomplete then.
    """

    run: PlannedRun
    parts: tuple[Slice, ...]
    known: tuple[KnownFailure, ...] = ()
    lost: tuple[Slice, ...] = ()
    timed: bool = True


class Trial(Value, frozen=True, tag="trial"):
    """The trial of the bundled mutant or variant ``name``.

    ``suite``: the digest of the suite and of all bundled subjects. ``executable``: that of the compiled mutants, for one of them.
    """

    suite: str
    name: str
    how: Thoroughness
    executable: str
    timed: bool


class GeneratedTrial(Value, frozen=True, tag="generated"):
    """The trial of a generated mutant of the Python reference framework."""

    suite: str
    mutant: GeneratedMutant
    seed: int
    timed: bool = True


Unit = Slice | Conclusion | Trial | GeneratedTrial

_decoder: msgspec.json.Decoder[Unit] = msgspec.json.Decoder(Unit)


def encoded(unit: Unit) -> bytes:
    """``unit`` as it travels."""
    return msgspec.json.encode(unit, order="deterministic")


def decoded(data: bytes) -> Unit:
    """The unit that was ``encoded``."""
    return _decoder.decode(data)


def address(unit: Unit) -> str:
    """The content address of ``unit``: SHA-256, hexadecimal."""
    return hashlib.sha256(encoded(unit)).hexdigest()


def slices(run: PlannedRun, purposes: Sequence[TestPurpose], scenarios: int) -> tuple[Slice, ...]:
    """``run`` cut into parts of about so many ``scenarios``; a purpose is never cut."""
    return tuple(
        Slice(run, first, end, not run.virtual_time and any(map(_is_timed, purposes[first:end])))
        for first, end in _ranges([len(purpose.scenarios) for purpose in purposes], scenarios)
    )


def _ranges(lengths: Sequence[int], most: int) -> Iterator[tuple[int, int]]:
    """Neighbours, as many as have at most ``most`` together; one that has more is alone."""
    first = together = 0
    for place, length in enumerate(lengths):
        if place > first and together + length > most:
            yield first, place
            first, together = place, 0
        together += length
    if lengths:
        yield first, len(lengths)


def _is_timed(purpose: TestPurpose) -> bool:
    return not timed_requirements().isdisjoint(purpose.requirements)
