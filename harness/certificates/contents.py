"""What a certificate says: the types of its members, and the in-toto statement that is signed."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Mapping
from typing import Literal

import msgspec

from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.certificates.verified import Assurance, Subject
from ucm_cts.harness.report.json_report import RequirementEntry
from ucm_cts.harness.results.values import Overall

STATEMENT_TYPE = "https://in-toto.io/Statement/v1"
PREDICATE_TYPE = "https://in-toto.io/attestation/test-result/v0.1"
PAYLOAD_TYPE = "application/vnd.in-toto+json"

FORMAT = 1
"""The version of the format of certificates."""

SUITE_FILES, CATALOGUE_FILES = "suite", "catalogue"
"""The names under which the digests of the suite's files, and of its requirements and readings, are signed."""


class Descriptor(Value, frozen=True):
    """An in-toto resource descriptor: a name, and digests by algorithm."""

    name: str
    digest: dict[str, str]


class Claims(Value, frozen=True):
    """What is said beyond in-toto's test result.

    ``assurance``: what the signer claims; a verifier finds out whether it is so.
    ``issued``: when it was signed, ISO 8601 in UTC.
    """

    format: int
    product: str
    version: str
    profile: str
    verdict: Overall
    assurance: Assurance
    issued: str
    seed: int
    suite_version: str
    specification: str
    isolation: str


class Predicate(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """in-toto's test result v0.1. A result that is not conformant, or inconclusive, is ``FAILED``."""

    result: Literal["PASSED", "FAILED"]
    configuration: tuple[Descriptor, ...]
    passedTests: tuple[str, ...]  # these are in-toto's names
    warnedTests: tuple[str, ...]
    failedTests: tuple[str, ...]
    ucm: Claims


class SignedStatement(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """in-toto's Statement v1, of which the envelope's payload is the JSON."""

    type_: str = msgspec.field(name="_type")
    subject: tuple[Descriptor, ...]
    predicateType: str
    predicate: Predicate


class Machine(Value, frozen=True):
    """Where a run took place; each text is empty if it is not known."""

    system: str
    processor: str
    python: str
    compiler: str
    omniidl: str
    libclang: str


class Settings(Value, frozen=True):
    """The options of the run, which decide what is run: seconds a scenario may take, MiB a host may use, seconds for incidents,
    additional states of systematic suites, and how many scenarios were drawn.
    """

    timeout: float
    memory: int
    incident_time: float
    systematic: int
    drawn: int


class Environment(Value, frozen=True):
    """``environment.json``: the suite's build, the machine and the options of the run."""

    specification: str
    suite_version: str
    suite: str
    """The digest of the suite's installed files."""
    catalogue: str
    """The digest of its requirements and readings."""
    isolation: str
    machine: Machine
    settings: Settings


def digest(content: bytes) -> str:
    """SHA-256, hexadecimal."""
    return hashlib.sha256(content).hexdigest()


def descriptors(digests: Mapping[str, str]) -> tuple[Descriptor, ...]:
    """A descriptor for each of ``digests``, in their order."""
    return tuple(Descriptor(name, {"sha256": value}) for name, value in digests.items())


def statement_of(
    claims: Claims,
    subjects: Iterable[Subject],
    configuration: Mapping[str, str],
    requirements: Iterable[RequirementEntry],
) -> SignedStatement:
    """The statement to sign. ``configuration`` has the digests of everything else, by name."""
    passed, warned, failed = tests_of(requirements)
    return SignedStatement(
        type_=STATEMENT_TYPE,
        subject=descriptors({subject.name: subject.sha256 for subject in subjects}),
        predicateType=PREDICATE_TYPE,
        predicate=Predicate(result_of(claims.verdict), descriptors(configuration), passed, warned, failed, claims),
    )


def result_of(verdict: Overall) -> Literal["PASSED", "FAILED"]:
    """in-toto's word for ``verdict``."""
    return "PASSED" if verdict == "conformant" else "FAILED"


def tests_of(
    requirements: Iterable[RequirementEntry],
) -> tuple[tuple[str, ...], tuple[str, ...], tuple[str, ...]]:
    """The ids of the requirements that passed, that gave no verdict or are recommendations not followed, and that failed."""
    passed, warned, failed = [], [], []
    for entry in requirements:
        if entry.verdict == "pass":
            passed.append(entry.id)
        elif entry.verdict == "fail" and entry.decides:
            failed.append(entry.id)
        elif entry.verdict != "not applicable":
            warned.append(entry.id)
    return tuple(passed), tuple(warned), tuple(failed)
