"""Reads a certificate: every member strictly, with all that is wrong told at once. Nothing is believed yet."""

from __future__ import annotations

import datetime
import math
import os
import re
import stat
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import TypeVar

import msgspec

from ucm_cts.harness.catalogue.documents import without_waiting
from ucm_cts.harness.catalogue.profiles import PROFILES
from ucm_cts.harness.catalogue.requirements import load_options, load_requirements
from ucm_cts.harness.certificates import archive
from ucm_cts.harness.certificates.challenges import Answered, answered
from ucm_cts.harness.certificates.contents import (
    FORMAT,
    PAYLOAD_TYPE,
    PREDICATE_TYPE,
    STATEMENT_TYPE,
    Claims,
    Environment,
    SignedStatement,
    digest,
)
from ucm_cts.harness.certificates.envelopes import Opened, decoded, opened
from ucm_cts.harness.certificates.problems import Problem, Unreadable, unreadable
from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.report.json_report import SCHEMA_VERSION, ReportEntry
from ucm_cts.harness.results.foreign import one_line
from ucm_cts.harness.results.known_failures import KnownFailure
from ucm_cts.harness.results.statement import IXIT, Statement, default_statement

T = TypeVar("T")


class _Versioned(msgspec.Struct):
    schema_version: int = SCHEMA_VERSION


_MODEL_NAME = re.compile(r"[A-Za-z0-9_][A-Za-z0-9_.-]{0,99}\.xml")
"""Names of model files that are written to a folder: no folders, nothing hidden."""


@dataclass
class Contents:
    """A certificate as it was read; a member is None if it could not be read. ``problems`` say why.

    ``is_vouched_for``: whether a verifier found out that somebody signed it whom the verifier trusts.
    """

    digest: str
    members: dict[str, bytes] = field(default_factory=dict)
    envelope: Opened | None = None
    signed: SignedStatement | None = None
    report: ReportEntry | None = None
    statement: Statement | None = None
    models: dict[str, str] = field(default_factory=dict)
    waivers: tuple[KnownFailure, ...] | None = None
    environment: Environment | None = None
    challenge: Answered | None = None
    record: bytes | None = None
    problems: list[Problem] = field(default_factory=list)
    is_vouched_for: bool = False

    @property
    def claims(self) -> Claims | None:
        """What the signer says; None if it could not be read."""
        return self.signed.predicate.ucm if self.signed is not None else None


def content_of(path: Path) -> bytes:
    """The bytes of the certificate at ``path``. Raises ``WrongUse`` if there is no such file."""
    try:
        with open(path, "rb", opener=without_waiting) as stream:
            if not stat.S_ISREG(os.fstat(stream.fileno()).st_mode):
                raise WrongUse(f"'{path}' is no plain file; name a certificate")
            return stream.read(archive.LARGEST_ARCHIVE + 1)
    except (OSError, ValueError) as error:
        raise WrongUse(f"'{path}' cannot be read: {getattr(error, 'strerror', None) or error}") from None


def read_certificate(data: bytes, is_delta: bool = False) -> Contents:
    """What the certificate ``data`` holds. With ``is_delta`` it may be of a suite that had other options and requirements."""
    contents = Contents(digest(data))
    try:
        contents.members = archive.read(data)
    except Unreadable as wrong:
        contents.problems += wrong.problems
        return contents

    def take(name: str, read: Callable[[bytes], T]) -> T | None:
        try:
            return read(contents.members[name])
        except Unreadable as wrong:
            contents.problems += wrong.problems
            return None

    contents.envelope = take(archive.ENVELOPE, lambda c: opened(c, "envelope", f"'{archive.ENVELOPE}'"))
    if contents.envelope is not None:
        envelope = contents.envelope
        contents.signed = take(archive.ENVELOPE, lambda _: _signed_statement(envelope))
    contents.report = take(archive.REPORT, _report)
    contents.environment = take(
        archive.ENVIRONMENT, lambda c: decoded(c, Environment, "environment", f"'{archive.ENVIRONMENT}'")
    )
    contents.statement = take(archive.STATEMENT, lambda c: _statement(c, is_delta))
    contents.waivers = take(archive.WAIVERS, lambda c: _waivers(c, is_delta))
    if archive.MODELS in contents.members:
        contents.models = take(archive.MODELS, _models) or {}
    if archive.CHALLENGE in contents.members:
        contents.challenge = take(archive.CHALLENGE, answered)
    contents.record = take(archive.RECORD, archive.unpacked)
    return contents


def _signed_statement(envelope: Opened) -> SignedStatement:
    if envelope.kind != PAYLOAD_TYPE:
        raise unreadable(
            "envelope", f"the envelope is of '{one_line(envelope.kind, 60)}', and not of an in-toto statement"
        )
    try:
        loose = msgspec.json.decode(envelope.payload, type=dict)
    except (msgspec.MsgspecError, UnicodeDecodeError, RecursionError):
        loose = {}
    for key, expected in (("_type", STATEMENT_TYPE), ("predicateType", PREDICATE_TYPE)):
        if loose.get(key, expected) != expected:
            raise unreadable(
                "envelope", f"the statement's {key} is '{one_line(str(loose[key]), 80)}', and not {expected}"
            )
    predicate = loose.get("predicate")
    ucm = predicate.get("ucm") if isinstance(predicate, dict) else None
    version = ucm.get("format") if isinstance(ucm, dict) else None
    if isinstance(version, int) and version != FORMAT:
        remedy = "install a newer ucm-cts" if version > FORMAT else "verify it with the ucm-cts that made it"
        raise unreadable("format", f"the certificate has format {version}, and this ucm-cts reads {FORMAT}: {remedy}")
    return decoded(envelope.payload, SignedStatement, "envelope", "the signed statement")


def _report(content: bytes) -> ReportEntry:
    try:
        version = msgspec.json.decode(content, type=_Versioned).schema_version
    except (msgspec.MsgspecError, UnicodeDecodeError, RecursionError):
        version = SCHEMA_VERSION  # what is wrong is told below
    if version != SCHEMA_VERSION:
        remedy = "verify it with the ucm-cts that made it"
        raise unreadable(
            "format",
            f"'{archive.REPORT}' has schema version {version}, and this ucm-cts reads {SCHEMA_VERSION}: {remedy}",
        )
    return decoded(content, ReportEntry, "report", f"'{archive.REPORT}'", indent=2)


def _statement(content: bytes, is_delta: bool) -> Statement:
    statement = decoded(content, Statement, "statement", f"'{archive.STATEMENT}'")
    problems = [
        Problem("statement", f"the vendor's statement {wrong}")
        for wrong in (*_wrong_in(statement), *(() if is_delta else _misfits(statement)))
    ]
    if problems:
        raise Unreadable(*problems)
    return statement


def _wrong_in(statement: Statement) -> Iterator[str]:
    """What no statement can hold."""
    options = load_options()
    for option, value in statement.readings.items():
        if option in options and value not in options[option]:
            yield f"declares {one_line(option, 60)} = {one_line(value, 60)}, which is no reading of it"
    for name, amount in statement.ixit.items():
        if name in IXIT and not (math.isfinite(amount) and IXIT[name].least <= amount <= IXIT[name].greatest):
            yield f"declares {name} = {amount}, which is no quantity from {IXIT[name].least:g} to {IXIT[name].greatest:g}"
    for profile in statement.profiles:
        if profile not in PROFILES:
            yield f"claims profile '{one_line(profile, 40)}', which there is not"


def _misfits(statement: Statement) -> Iterator[str]:
    """What a statement of this suite holds and this one does not, and the other way round."""
    default = default_statement()
    for what, there, known in (
        ("capability", statement.capabilities, default.capabilities),
        ("reading", statement.readings, default.readings),
        ("quantity", statement.ixit, default.ixit),
    ):
        for name in known:
            if name not in there:
                yield f"lacks the {what} {name}, which every statement has"
        for name in there:
            if name not in known:
                yield f"has the {what} '{one_line(name, 60)}', which there is not"


def _waivers(content: bytes, is_delta: bool) -> tuple[KnownFailure, ...]:
    waivers = decoded(content, tuple[KnownFailure, ...], "waiver", f"'{archive.WAIVERS}'")
    ids = {requirement.id for requirement in load_requirements()}
    problems = []
    for waiver in waivers:
        if waiver.requirement not in ids and not is_delta:
            problems.append(
                Problem("waiver", f"a waiver is of '{one_line(waiver.requirement, 40)}', which is no requirement")
            )
        if day_of(waiver.expires) is None:
            problems.append(
                Problem(
                    "waiver",
                    f"the waiver of {one_line(waiver.requirement, 40)} expires on '{one_line(waiver.expires, 40)}', which is no date",
                )
            )
    if problems:
        raise Unreadable(*problems)
    return waivers


def _models(content: bytes) -> dict[str, str]:
    models = decoded(content, dict[str, str], "models", f"'{archive.MODELS}'")
    wrong = [name for name in models if not _MODEL_NAME.fullmatch(name)]
    if wrong:
        raise Unreadable(
            *(Problem("models", f"'{one_line(name, 80)}' is no name of a model that may be unpacked") for name in wrong)
        )
    return models


def is_model_name(name: str) -> bool:
    """May a model file have this name in a certificate?"""
    return _MODEL_NAME.fullmatch(name) is not None


def day_of(text: str) -> datetime.date | None:
    """The date in ``text``; None if there is none."""
    try:
        return datetime.date.fromisoformat(text)
    except ValueError:
        return None


def moment_of(text: str) -> datetime.datetime | None:
    """The moment in ``text``, which names its zone; None if there is none."""
    try:
        moment = datetime.datetime.fromisoformat(text)
    except ValueError:
        return None
    return moment if moment.tzinfo is not None else None
