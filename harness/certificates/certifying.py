"""Makes certificates: puts what a run gave, and what took part in it, into a signed archive."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import msgspec
from securesystemslib.signer import CryptoSigner

import ucm_cts
from ucm_cts.harness.certificates import archive
from ucm_cts.harness.certificates.challenges import now
from ucm_cts.harness.certificates.contents import (
    CATALOGUE_FILES,
    FORMAT,
    PAYLOAD_TYPE,
    SUITE_FILES,
    Claims,
    Environment,
    Settings,
    digest,
    statement_of,
)
from ucm_cts.harness.certificates.envelopes import encoded, signed
from ucm_cts.harness.certificates.reading import is_model_name
from ucm_cts.harness.certificates.suite_build import catalogue_digest, machine, specification, suite_digest
from ucm_cts.harness.certificates.verified import Assurance, Subject
from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.report.json_report import ReportEntry
from ucm_cts.harness.results.known_failures import KnownFailure
from ucm_cts.harness.results.statement import Statement


@dataclass(frozen=True)
class Run:
    """A complete run, with what it was of. ``record``: encoded, not compressed. ``challenge``: its file, empty without one."""

    report: ReportEntry
    record: bytes
    statement: Statement
    waivers: Sequence[KnownFailure]
    subjects: Sequence[Subject]
    settings: Settings
    assurance: Assurance = "self-declared"
    challenge: bytes = b""


def certificate(run: Run, signers: Sequence[CryptoSigner]) -> bytes:
    """The signed archive of ``run``. Raises ``WrongUse`` if ``run`` is not complete, or has models that cannot be kept."""
    report = msgspec.json.decode(msgspec.json.encode(run.report), type=ReportEntry)
    if report.incomplete:
        raise WrongUse(f"the run is incomplete ({report.incomplete}): no certificate is made of it; run it again")
    environment = Environment(
        specification=specification(),
        suite_version=ucm_cts.__version__,
        suite=suite_digest(),
        catalogue=catalogue_digest(),
        isolation=report.isolation,
        machine=machine(),
        settings=run.settings,
    )
    members = {
        archive.REPORT: encoded(report, indent=2),
        archive.STATEMENT: statement_member(run.statement),
        archive.WAIVERS: waivers_member(run.waivers),
        archive.ENVIRONMENT: encoded(environment),
        archive.RECORD: archive.packed(run.record),
    }
    models = models_of(run.statement)
    if models:
        members[archive.MODELS] = encoded(models)
    if run.challenge:
        members[archive.CHALLENGE] = run.challenge
    claims = Claims(
        format=FORMAT,
        product=report.product,
        version=report.version,
        profile=report.profile,
        verdict=report.verdict,
        assurance=run.assurance,
        issued=now(),
        seed=report.seed,
        suite_version=report.suite_version,
        specification=specification(),
        isolation=report.isolation,
    )
    return sealed(members, claims, run.subjects, environment, report, signers)


def sealed(
    members: dict[str, bytes],
    claims: Claims,
    subjects: Sequence[Subject],
    environment: Environment,
    report: ReportEntry,
    signers: Sequence[CryptoSigner],
) -> bytes:
    """The archive of ``members`` with the signed statement about them."""
    digests = {name: digest(members[name]) for name in archive.LARGEST if name in members}
    digests |= {SUITE_FILES: environment.suite, CATALOGUE_FILES: environment.catalogue}
    statement = statement_of(claims, subjects, digests, report.requirements)
    return archive.written({**members, archive.ENVELOPE: signed(encoded(statement), PAYLOAD_TYPE, signers)})


def statement_member(statement: Statement) -> bytes:
    """``statement.json``: the statement without the folder it was read from."""
    whole = msgspec.json.encode(msgspec.structs.replace(statement, folder="."))
    return encoded(msgspec.json.decode(whole, type=Statement))  # as a reader writes it: all quantities are fractions


def waivers_member(waivers: Sequence[KnownFailure]) -> bytes:
    """``waivers.json``."""
    return encoded(tuple(waivers))


def models_of(statement: Statement) -> dict[str, str]:
    """The vendor's own models, by the names of their files. Raises ``WrongUse``."""
    models: dict[str, str] = {}
    for path in statement.model_paths:
        for file in sorted(path.rglob("*.xml")) if path.is_dir() else (path,):
            if not is_model_name(file.name) or file.name in models:
                why = "is the name of two files" if file.name in models else "cannot be kept in a certificate"
                raise WrongUse(f"'{Path(file).name}', a model of the statement, {why}; rename it")
            try:
                models[file.name] = file.read_text(encoding="utf-8")
            except (OSError, ValueError) as error:
                raise WrongUse(f"'{file}', a model of the statement, cannot be read: {error}") from None
    return models
