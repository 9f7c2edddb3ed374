"""A certificate as the site shows it: what verification found out, cut down to what pages need."""

from __future__ import annotations

import datetime
import hashlib
import re

from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.catalogue.profiles import PROFILES
from ucm_cts.harness.certificates.problems import Problem
from ucm_cts.harness.certificates.verified import Assurance, Change, Subject, Uncovered, Verified
from ucm_cts.harness.report.published import PublishedResult, published
from ucm_cts.harness.results.foreign import one_line
from ucm_cts.harness.results.tally import overall
from ucm_cts.harness.results.values import Overall

LONGEST_NAME = 80
"""Characters of a product's name that pages show."""

_DIGEST = re.compile(r"[0-9a-f]{64}")
_ID = re.compile(r"R-\d{1,4}(\.\d{1,4}){0,8}-\d{1,4}")


class Lie(Exception):
    """What verification printed contradicts itself, or is of another file."""


class Certificate(Value, frozen=True):
    """A certificate that stands. ``file`` is the name of its archive, ``size`` the archive's bytes; ``issued`` is in UTC.

    ``extent``: what the run did, in words. The other fields are those of ``Verified``.
    """

    digest: str
    file: str
    size: int
    product: str
    version: str
    profile: str
    verdict: Overall
    assurance: Assurance
    signers: tuple[str, ...]
    issued: str
    suite_version: str
    judged_by: str
    specification: str
    isolation: str
    uncovered: Uncovered
    subjects: tuple[Subject, ...]
    word: tuple[str, ...]
    result: PublishedResult
    extent: str
    changes: tuple[Change, ...] = ()
    challenges: int = 0
    remarks: tuple[str, ...] = ()

    @property
    def is_delta(self) -> bool:
        """Were the rules of another suite applied than those of the run?"""
        return bool(self.judged_by)

    @property
    def owner(self) -> tuple[str, tuple[str, ...]]:
        """Product and signers: certificates of one name by different keys are never mixed."""
        return self.product, self.signers

    @property
    def age(self) -> tuple[str, str]:
        """Sorts certificates from the oldest to the newest."""
        return self.issued, self.digest

    @property
    def page(self) -> str:
        """The name of its page."""
        return f"certificates/{self.digest}.html"

    @property
    def archive(self) -> str:
        """The name of its archive in the site."""
        return f"certificates/{self.digest}.ucmcert"

    @property
    def name(self) -> str:
        """Product and version on one line."""
        return one_line(f"{self.product} {self.version}".strip(), LONGEST_NAME)


class Fallen(Value, frozen=True):
    """A file that is no certificate that stands, and why. ``says``: what it says it is of; nobody vouches for that."""

    file: str
    digest: str
    problems: tuple[Problem, ...]
    says: str = ""


def settled(verified: Verified, digest: str, file: str, size: int) -> Certificate | Fallen:
    """What the site says of the archive with ``digest``. Raises ``Lie`` if ``verified`` cannot be the truth about it."""
    if verified.digest != digest:
        raise Lie("the verification is of another archive")
    if verified.problems:
        says = f"{verified.product} {verified.version}, {verified.profile}" if verified.product else ""
        return Fallen(file, digest, verified.problems, one_line(says, 2 * LONGEST_NAME))
    report = verified.report
    if report is None:
        raise Lie("it is to stand, and has no report")
    if verified.profile not in PROFILES:
        raise Lie(f"it is of no profile: {one_line(verified.profile, 40)}")
    same = ("product", "version", "profile", "verdict", "suite_version")
    differs = [name for name in same if getattr(verified, name) != getattr(report, name)]
    if differs:
        raise Lie(f"certificate and report differ in {', '.join(differs)}")
    outside = (*verified.uncovered.untestable, *verified.uncovered.not_applicable)
    named = (
        *(entry.id for entry in report.requirements),
        *outside,
        *(w.requirement for w in verified.uncovered.waivers),
    )
    if not all(map(_ID.fullmatch, named)):
        raise Lie("it names requirements that are none")
    if report.verdict != overall(report.requirements, report.incidents, report.incomplete):
        raise Lie("its verdict does not follow from its results")
    if not verified.signers:
        raise Lie("it is to stand, and no trusted key signed it")
    if not all(_DIGEST.fullmatch(subject.sha256) for subject in verified.subjects):
        raise Lie("the digest of a subject is none")
    unit = "scenarios" if report.scenarios else "models"
    number = report.scenarios or report.measures.get("legal models", 0) + report.measures.get("broken models", 0)
    return Certificate(
        digest=digest,
        file=file,
        size=size,
        product=verified.product,
        version=verified.version,
        profile=verified.profile,
        verdict=verified.verdict,
        assurance=verified.assurance,
        signers=tuple(sorted(verified.signers)),
        issued=_in_utc(verified.issued),
        suite_version=verified.suite_version,
        judged_by=verified.judged_by,
        specification=verified.specification,
        isolation=verified.isolation,
        uncovered=verified.uncovered,
        subjects=verified.subjects,
        word=verified.word,
        result=published(report),
        extent=f"{number:,} {unit}, seed {report.seed}" if number else f"seed {report.seed}",
        changes=verified.changes,
        challenges=verified.challenges,
        remarks=verified.remarks,
    )


def _in_utc(time: str) -> str:
    """``time`` in UTC, to the second. Raises ``Lie``."""
    try:
        moment = datetime.datetime.fromisoformat(time)
        if moment.tzinfo is None:
            raise ValueError
        return moment.astimezone(datetime.UTC).strftime("%Y-%m-%dT%H:%M:%SZ")
    except (ValueError, OverflowError):
        raise Lie(f"'{one_line(time, 40)}' is no time at which it was issued") from None


def file_name(text: str, *more: str) -> str:
    """A name for files of what ``text`` names: safe in paths and links, and of no other text (or of other ``more``)."""
    slug = re.sub(r"[^a-z0-9]+", "-", text[:200].lower()).strip("-")[:40].strip("-") or "product"
    whole = "\0".join((text, *more)).encode("utf-8", "surrogatepass")
    return f"{slug}-{hashlib.sha256(whole).hexdigest()[:10]}"
