"""What verification finds out about a certificate: the value that ``ucm-cts verify --json`` prints and ``publish`` reads."""

from __future__ import annotations

from typing import Literal

import msgspec

from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.certificates.problems import Problem
from ucm_cts.harness.report.json_report import ReportEntry
from ucm_cts.harness.results.values import Overall

Assurance = Literal["self-declared", "challenged", "witnessed"]
"""Who chose the seed, and who ran: the vendor did both; an auditor drew the seed after a commitment; an auditor ran."""


class Subject(Value, frozen=True):
    """Something that took part in the run: the adapter, an artefact, a library or a module. ``sha256`` is hexadecimal."""

    name: str
    sha256: str


class Waiver(Value, frozen=True):
    """A failure that the signer declares as known. ``expires`` is the last day on which it counts, ISO 8601."""

    requirement: str
    reason: str
    expires: str


class Uncovered(Value, frozen=True):
    """What a certificate does not cover.

    ``untestable``: the requirements of the profile that no run can decide, by id.
    ``not_applicable``: those that the vendor's statement leaves out, by id.
    ``waivers``: the failures declared as known.
    ``undeclared``: the options of the specification whose reading the vendor does not declare.
    """

    untestable: tuple[str, ...] = ()
    not_applicable: tuple[str, ...] = ()
    waivers: tuple[Waiver, ...] = ()
    undeclared: tuple[str, ...] = ()


class Change(Value, frozen=True):
    """A requirement that the rules of another suite judge otherwise than the certificate says; ``new`` is empty if it is gone."""

    requirement: str
    old: str
    new: str


class Verified(Value, frozen=True):
    """A certificate after verification. It stands if there are no ``problems``.

    ``digest``: the SHA-256 of the archive, hexadecimal.
    ``signers``: the names of the trusted keys that signed it; empty if none of them did.
    ``issued``: when it was signed, ISO 8601.
    ``suite_version``: the suite that ran; ``judged_by``: the suite whose rules judged the record, empty if it is the same.
    ``specification``: the specification and its version.
    ``isolation``: how the product was kept apart from the harness, as the signer says.
    ``report``: the report, derived again from the record; None if it could not be derived.
    ``subjects``: what took part in the run.
    ``changes``: what the rules of that suite judge otherwise than the certificate says.
    ``challenges``: how many challenges the auditor had given for this product by then; 0 without a challenge.
    ``remarks``: what a reader should know although the certificate stands, a sentence each.
    ``word``: what rests on the signer's word and no record can show, a sentence each.
    """

    digest: str
    product: str
    version: str
    profile: str
    verdict: Overall
    assurance: Assurance
    signers: tuple[str, ...]
    issued: str
    suite_version: str
    specification: str
    isolation: str
    report: ReportEntry | None = None
    uncovered: Uncovered = Uncovered()
    problems: tuple[Problem, ...] = ()
    subjects: tuple[Subject, ...] = ()
    word: tuple[str, ...] = ()
    judged_by: str = ""
    changes: tuple[Change, ...] = ()
    challenges: int = 0
    remarks: tuple[str, ...] = ()

    @property
    def stands(self) -> bool:
        """Nothing is wrong with it."""
        return not self.problems

    @property
    def is_delta(self) -> bool:
        """Were the rules of another suite applied than those of the run?"""
        return bool(self.judged_by)


def encoded(verified: Verified) -> bytes:
    """``verified`` as JSON, ending with a newline."""
    return msgspec.json.encode(verified) + b"\n"


def decoded(data: bytes) -> Verified:
    """What ``encoded`` wrote. Raises ``msgspec.MsgspecError``."""
    return msgspec.json.decode(data, type=Verified)
