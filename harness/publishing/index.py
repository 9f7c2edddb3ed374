"""``index.json``: the site for programs, with ``index.schema.json``, which is made of the same types."""

from __future__ import annotations

import msgspec

import ucm_cts
from ucm_cts.adapters.contract.json_schema import schema_of
from ucm_cts.harness.certificates.problems import Problem
from ucm_cts.harness.certificates.verified import Assurance
from ucm_cts.harness.publishing.certificate import Certificate, Fallen
from ucm_cts.harness.publishing.site import Site
from ucm_cts.harness.report.order import count
from ucm_cts.harness.results.foreign import clean
from ucm_cts.harness.results.values import Overall

SCHEMA_VERSION = 2
SCHEMA_FILE = "index.schema.json"
SCHEMA_ID = f"urn:ucm-cts:schema:certificates:{SCHEMA_VERSION}"
"""The ``$id`` of the schema, the same for all sites of this version of it."""


class CertificateEntry(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A certificate that stands. ``archive`` is the archive's name as it was found, ``digest`` its SHA-256; the last fields are files of the site, ``download``
    the archive itself.

    ``judged_by`` is not empty if the rules of another suite than that of the run were applied: then it certifies nothing.
    """

    digest: str
    archive: str
    product: str
    version: str
    profile: str
    verdict: Overall
    assurance: Assurance
    signers: tuple[str, ...]
    issued: str
    specification: str
    suite_version: str
    judged_by: str
    requirements: dict[str, int]
    page: str
    download: str
    earl: str
    badge: str


class FallenEntry(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """An archive that does not stand, and why. ``digest`` is empty if it cannot be read."""

    digest: str
    archive: str
    problems: tuple[Problem, ...]
    badge: str


class Index(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The whole of ``index.json``. Certificates begin with the oldest."""

    schema: str = msgspec.field(name="$schema")
    schema_version: int
    suite_version: str
    certificates: tuple[CertificateEntry, ...]
    fallen: tuple[FallenEntry, ...]


def index(site: Site) -> bytes:
    """``index.json``."""
    whole = Index(
        SCHEMA_FILE,
        SCHEMA_VERSION,
        ucm_cts.__version__,
        tuple(map(_certificate, site.certificates)),
        tuple(map(_fallen, site.fallen)),
    )
    return msgspec.json.format(msgspec.json.encode(whole), indent=1) + b"\n"


def schema() -> bytes:
    """``index.schema.json``."""
    made = {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "$id": SCHEMA_ID,
        "title": "Published UCM certificates",
        **schema_of(Index),
    }
    return msgspec.json.format(msgspec.json.encode(made), indent=1) + b"\n"


def _certificate(one: Certificate) -> CertificateEntry:
    return CertificateEntry(
        one.digest,
        clean(one.file, 200),
        clean(one.product, 200),
        clean(one.version, 200),
        one.profile,
        one.verdict,
        one.assurance,
        tuple(clean(name, 200) for name in one.signers),
        one.issued,
        clean(one.specification, 200),
        clean(one.suite_version, 200),
        clean(one.judged_by, 200),
        {verdict: number for verdict, number in count(one.result.requirements).items() if number},
        one.page,
        one.archive,
        f"certificates/{one.digest}.jsonld",
        f"badges/{one.digest}.svg",
    )


def _fallen(one: Fallen) -> FallenEntry:
    problems = tuple(Problem(clean(p.check, 80), clean(p.detail, 400)) for p in one.problems)
    return FallenEntry(one.digest, clean(one.file, 200), problems, f"badges/{one.digest}.svg" if one.digest else "")
