"""Verifies a certificate: who signed it, whether it is whole, and whether its record shows what it says.

All problems are told at once. Needed are the keys of the verifier's own and this suite: neither network nor product.
"""

from __future__ import annotations

import datetime
import tempfile
import unicodedata
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Literal, Protocol

import msgspec

import ucm_cts
from ucm_cts.harness.catalogue.documents import DocumentError
from ucm_cts.harness.catalogue.profiles import PARTS, PROFILES, TOOLCHAIN_PROFILES
from ucm_cts.harness.catalogue.requirements import load_interpretations, requirements_of
from ucm_cts.harness.certificates import archive
from ucm_cts.harness.certificates.comparing import ON_THE_SIGNERS_WORD, differences, inconsistencies
from ucm_cts.harness.certificates.contents import CATALOGUE_FILES, SUITE_FILES, Claims, digest
from ucm_cts.harness.certificates.degrees import Assured, assured
from ucm_cts.harness.certificates.keys import NOBODY, Trust, TrustedKey
from ucm_cts.harness.certificates.problems import Problem, Unreadable
from ucm_cts.harness.certificates.reading import Contents, read_certificate
from ucm_cts.harness.certificates.suite_build import catalogue_digest, specification, suite_digest
from ucm_cts.harness.certificates.times import wrong_times
from ucm_cts.harness.certificates.verified import Change, Subject, Uncovered, Verified, Waiver
from ucm_cts.harness.purposes.systematic.purposes import MOST_EXTRA
from ucm_cts.harness.report.json_report import ReportEntry, StatementEntry
from ucm_cts.harness.results.foreign import one_line
from ucm_cts.harness.results.statement import Statement

SuiteChoice = Literal["same", "newer"]

MOST_DRAWN = 100_000
"""How many scenarios a run may have drawn."""

_DAY = 86_400


class Rederived(Protocol):
    """What judging a record again gives."""

    @property
    def report(self) -> ReportEntry: ...

    @property
    def problems(self) -> tuple[Problem, ...]: ...

    @property
    def unshown(self) -> tuple[str, ...]:
        """What the record says and no trace shows, as clauses that begin with "that"."""


Judge = Callable[[Contents, Statement, bool], Rederived]
"""Judges the record of a certificate, with the statement and where its models are; True for the rules of another suite."""


@dataclass(frozen=True)
class Shown:
    """What the record of a certificate shows. ``report``: derived again; None if it could not be. ``changes``: by the rules of another
    suite. ``problems``: of the record, and where the report says something else. ``unshown``: as in ``Rederived``.
    """

    report: ReportEntry | None = None
    changes: tuple[Change, ...] = ()
    problems: tuple[Problem, ...] = ()
    unshown: tuple[str, ...] = ()


@dataclass(frozen=True)
class Verifier:
    """What a verifier relies on. ``auditors`` is empty if no auditor's keys were given."""

    trust: Trust
    judge: Judge
    auditors: Trust = NOBODY
    suite: SuiteChoice = "same"
    today: datetime.datetime | None = None

    def verify(self, data: bytes) -> Verified:
        """Everything that is wrong with the certificate ``data``, and what it says."""
        contents = read_certificate(data, self.suite == "newer")
        problems = list(contents.problems)
        claims = contents.claims
        if contents.signed is None or claims is None or contents.envelope is None:
            return _nothing(contents.digest, problems)
        signers, others = self._signers(contents, claims)
        replaced = list(_digests(contents))
        contents.is_vouched_for = bool(signers) and not replaced  # what was put in later, nobody has signed
        problems += others
        problems += replaced
        problems += inconsistencies(contents.signed, contents.report, contents.environment)
        problems += _statement(contents)
        settings = list(_settings(contents))
        problems += settings
        problems += wrong_times(contents, claims, self.today or datetime.datetime.now(datetime.UTC))
        mismatch = list(_suite(contents, claims))
        is_delta = bool(mismatch) and self.suite == "newer"
        problems += () if is_delta else mismatch
        degree = assured(contents, claims, signers, self.trust, self.auditors)
        problems += degree.problems
        shown = Shown() if settings else self._judged(contents, claims, is_delta, bool(mismatch))
        problems += shown.problems
        return self._verified(contents, claims, signers, degree, shown, problems, is_delta)

    def _signers(self, contents: Contents, claims: Claims) -> tuple[tuple[TrustedKey, ...], list[Problem]]:
        assert contents.envelope is not None
        known = Trust({**self.auditors.keys, **self.trust.keys})
        signed, problems = contents.envelope.who(known, "the signed statement")
        wrong = list(problems)
        if not contents.envelope.signatures:
            wrong.append(Problem("signature", "the certificate is not signed at all"))
        elif not signed and not problems:
            ids = ", ".join(id_[:16] for id_ in contents.envelope.signatures)
            where = f" in '{self.trust.source}'" if self.trust.source else ""
            wrong.append(
                Problem(
                    "key", f"none of the keys that you trust{where} signed it; it names the keys {one_line(ids, 200)}"
                )
            )
        good = []
        for key in signed:
            if key.rule.lost:
                wrong.append(
                    Problem(
                        "lost key",
                        f"key '{key.name}' was lost on {key.rule.lost}: who found it can sign with any date; ask for a certificate with a new key",
                    )
                )
            elif not key.vouches_for(claims.product):
                wrong.append(
                    Problem(
                        "key of another product",
                        f"key '{key.name}' vouches for {', '.join(key.rule.products) or 'nothing'}, and the certificate is of '{one_line(claims.product, 80)}'",
                    )
                )
            else:
                good.append(key)
        return tuple(good), wrong

    def _strangers(self, contents: Contents) -> Iterator[str]:
        """Signatures that say nothing to this verifier."""
        assert contents.envelope is not None
        known = {*self.trust.keys, *self.auditors.keys}
        unknown = [id_ for id_ in contents.envelope.signatures if id_ not in known]
        if unknown and len(unknown) < len(contents.envelope.signatures):
            yield f"{len(unknown)} of its signatures are of keys that you do not trust: anybody can add one, and they were not checked"

    def _judged(self, contents: Contents, claims: Claims, is_delta: bool, is_other_suite: bool) -> Shown:
        """What the record shows, and what is wrong with it and with the report."""
        said, statement = contents.report, contents.statement
        if contents.record is None or said is None or statement is None or contents.waivers is None:
            return Shown()
        if contents.environment is None or claims.profile not in PROFILES or (is_other_suite and not is_delta):
            return Shown()
        with tempfile.TemporaryDirectory(prefix="ucm-cts-verify-") as folder:
            for name, text in contents.models.items():
                (Path(folder) / name).write_text(text, encoding="utf-8", errors="surrogatepass")
            unpacked = msgspec.structs.replace(statement, folder=folder, models=tuple(contents.models))
            try:
                found = self.judge(contents, unpacked, is_delta)
            except Unreadable as wrong:
                return Shown(problems=wrong.problems)
            except DocumentError as error:  # of a model: nothing else is read
                told = one_line(str(error).replace(f"{folder}/", ""), 300)
                return Shown(problems=(Problem("models", f"a model of the certificate cannot be used: {told}"),))
        word = {name: getattr(said, name) for name in ON_THE_SIGNERS_WORD}
        times = {entry.id: entry.seconds for entry in said.requirements}
        shown = msgspec.structs.replace(
            found.report,
            **word,
            statement=said.statement,
            requirements=tuple(
                msgspec.structs.replace(entry, seconds=times.get(entry.id, 0.0)) for entry in found.report.requirements
            ),
        )
        if is_delta:
            return Shown(shown, _changes(said, shown), found.problems)
        if found.problems:  # what is shown may be of a part of the run
            return Shown(shown, problems=found.problems)
        return Shown(shown, problems=tuple(differences(said, shown)), unshown=found.unshown)

    def _verified(
        self,
        contents: Contents,
        claims: Claims,
        signers: tuple[TrustedKey, ...],
        degree: Assured,
        shown: Shown,
        problems: list[Problem],
        is_delta: bool,
    ) -> Verified:
        assert contents.signed is not None
        report = shown.report
        return Verified(
            digest=contents.digest,
            product=one_line(claims.product),
            version=one_line(claims.version),
            profile=one_line(claims.profile),
            verdict=report.verdict if report is not None else claims.verdict,
            assurance=degree.assurance,
            signers=tuple(key.name for key in signers),
            issued=one_line(claims.issued),
            suite_version=one_line(claims.suite_version),
            specification=one_line(claims.specification),
            isolation=one_line(claims.isolation),
            report=report,
            uncovered=_uncovered(contents, report or contents.report),
            problems=tuple(dict.fromkeys(problems)),
            subjects=tuple(
                Subject(one_line(one.name), one_line(one.digest.get("sha256", ""))) for one in contents.signed.subject
            ),
            word=(*_on_the_word(contents, claims, degree), *shown.unshown),
            judged_by=f"{ucm_cts.__version__}, build {suite_digest()[:12]}" if is_delta else "",
            changes=shown.changes,
            challenges=degree.number,
            remarks=(*degree.remarks, *_look_alikes(claims), *self._strangers(contents)),
        )


def _nothing(archive_digest: str, problems: list[Problem]) -> Verified:
    """Of a certificate that cannot be read."""
    return Verified(
        archive_digest, "", "", "", "inconclusive", "self-declared", (), "", "", "", "", problems=tuple(problems)
    )


def _digests(contents: Contents) -> Iterator[Problem]:
    """Members that are not those that were signed."""
    assert contents.signed is not None
    signed = {one.name: one.digest for one in contents.signed.predicate.configuration}
    if len(signed) != len(contents.signed.predicate.configuration):
        yield Problem("digest", "the signed statement names a member twice")
    for name, content in contents.members.items():
        if name == archive.ENVELOPE:
            continue
        if name not in signed:
            yield Problem("digest", f"'{name}' is in the archive, and was not signed")
        elif signed[name] != {"sha256": digest(content)}:
            yield Problem("digest", f"'{name}' is not the one that was signed: it was changed or replaced")
    for name in signed:
        if name not in contents.members and name not in (SUITE_FILES, CATALOGUE_FILES):
            yield Problem("digest", f"'{one_line(name, 60)}' was signed, and is not in the archive")
    environment = contents.environment
    if environment is not None:
        for name, value in ((SUITE_FILES, environment.suite), (CATALOGUE_FILES, environment.catalogue)):
            if signed.get(name) != {"sha256": value}:
                yield Problem("digest", f"the signed digest of the {name} is not the one of the environment")
    names = [one.name for one in contents.signed.subject]
    if not names:
        yield Problem("subjects", "the certificate names nothing that took part in the run")
    if len(set(names)) != len(names):
        yield Problem("subjects", "the certificate names a subject twice")
    for one in contents.signed.subject:
        if set(one.digest) != {"sha256"} or not _is_sha256(one.digest["sha256"]):
            yield Problem("subjects", f"the digest of '{one_line(one.name, 60)}' is no SHA-256")


def _is_sha256(text: str) -> bool:
    return len(text) == 64 and set(text) <= set("0123456789abcdef")


def _statement(contents: Contents) -> Iterator[Problem]:
    """What does not fit between statement, models, report and claims."""
    statement, report, claims = contents.statement, contents.report, contents.claims
    if statement is None or claims is None:
        return
    if report is not None and report.statement != StatementEntry.of(statement):
        yield Problem("statement", "the report is of another statement than the one in the certificate")
    for what in ("product", "version"):
        stated, said = getattr(statement, what), getattr(claims, what)
        if stated and one_line(stated) != one_line(said):
            yield Problem(
                "statement",
                f"the statement is about {what} '{one_line(stated, 80)}', and the certificate about '{one_line(said, 80)}'",
            )
    if claims.profile not in PROFILES:
        yield Problem("claims", f"there is no profile '{one_line(claims.profile, 40)}'")
    elif claims.profile not in statement.profiles:
        yield Problem("statement", f"the statement does not claim profile '{claims.profile}'")
    if bool(statement.models) != (archive.MODELS in contents.members):
        yield Problem(
            "models",
            "the statement declares models, and the certificate has none"
            if statement.models
            else "the certificate has models that the statement does not declare",
        )


def _settings(contents: Contents) -> Iterator[Problem]:
    """Options that no run can have: nothing is derived from them."""
    if contents.environment is None:
        return
    given = contents.environment.settings
    for name, value, least, most in (
        ("timeout", given.timeout, 0.1, _DAY),
        ("memory", given.memory, 16, 1 << 24),
        ("incident time", given.incident_time, 0, _DAY),
        ("systematic", given.systematic, 0, MOST_EXTRA),
        ("drawn", given.drawn, 0, MOST_DRAWN),
    ):
        if not least <= value <= most:
            yield Problem("settings", f"the run had {name} = {value}; it can be from {least} to {most}")


def _look_alikes(claims: Claims) -> Iterator[str]:
    """Names that mix alphabets: letters that look alike may name somebody else."""
    for what, name in (("product", claims.product), ("version", claims.version)):
        odd = sorted({letter for letter in name if letter.isalpha() and not _is_latin(letter)})
        if odd and any(letter.isalpha() and _is_latin(letter) for letter in name):
            named = ", ".join(f"U+{ord(letter):04X} {unicodedata.name(letter, '')}".strip() for letter in odd[:3])
            yield f"the {what} mixes alphabets, and may look like that of somebody else: {named}"


def _is_latin(letter: str) -> bool:
    return unicodedata.name(letter, "").startswith("LATIN ")


def _suite(contents: Contents, claims: Claims) -> Iterator[Problem]:
    """What differs between the suite of the certificate and this one."""
    environment = contents.environment
    if claims.specification != specification():
        yield Problem(
            "specification",
            f"it is about '{one_line(claims.specification, 120)}', and this suite about '{specification()}'",
        )
    if environment is None:
        return
    remedy = "verify it with that one, or judge it by today's rules: --suite newer"
    if claims.suite_version != ucm_cts.__version__:
        yield Problem(
            "suite",
            f"it was made with ucm-cts {one_line(claims.suite_version, 40)}, and this is {ucm_cts.__version__}; {remedy}",
        )
    elif environment.suite != suite_digest():
        yield Problem(
            "suite",
            f"it was made with build {one_line(environment.suite)[:12]} of ucm-cts {ucm_cts.__version__}, and this is build {suite_digest()[:12]}; {remedy}",
        )
    elif environment.catalogue != catalogue_digest():
        yield Problem(
            "suite",
            f"its catalogue is not the one of this build of ucm-cts {ucm_cts.__version__}; one of them was changed",
        )


def _changes(said: ReportEntry, shown: ReportEntry) -> tuple[Change, ...]:
    old, new = ({entry.id: str(entry.verdict) for entry in report.requirements} for report in (said, shown))
    ids = [*new, *(id_ for id_ in old if id_ not in new)]
    return tuple(
        Change(one_line(id_, 40), old.get(id_, ""), new.get(id_, "")) for id_ in ids if old.get(id_) != new.get(id_)
    )


def _uncovered(contents: Contents, report: ReportEntry | None) -> Uncovered:
    if report is None or report.profile not in PARTS:
        return Uncovered()
    parts = PARTS[report.profile]
    statement = contents.statement
    options = [option for i in load_interpretations() if i.profile in parts for option in i.options]
    return Uncovered(
        untestable=tuple(r.id for r in requirements_of(report.profile) if r.untestable),
        not_applicable=tuple(entry.id for entry in report.requirements if entry.verdict == "not applicable"),
        waivers=tuple(Waiver(w.requirement, one_line(w.reason), w.expires) for w in contents.waivers or ()),
        undeclared=tuple(o for o in options if statement is not None and statement.readings.get(o) == "observed"),
    )


def _on_the_word(contents: Contents, claims: Claims, degree: Assured) -> Iterator[str]:
    """What rests on the signer's word."""
    is_toolchain = claims.profile in TOOLCHAIN_PROFILES
    if degree.assurance != "witnessed":
        yield "that the product ran at all: who forges every time and every event of a record carefully cannot be seen; a witnessed certificate is the answer"
        yield "that product and version are those named, that the files named are those that ran, and that no others took part"
        processes = "how long calls took" if is_toolchain else "clock gaps, contention, and what hosts' processes held"
        yield f"isolation ({one_line(claims.isolation, 20)}), warnings, the machine, {processes}"
        yield "the dates"
        if not is_toolchain and contents.environment is not None:
            drawn = contents.environment.settings.drawn
            shown = f"no more than {drawn} scenarios were drawn" if drawn else "no scenario was drawn"
            yield f"that {shown}: a run may have been cut before one that failed"
    if degree.assurance == "self-declared":
        yield "that the seed was not chosen: the vendor may have run often and kept the best run"
    if degree.assurance == "challenged":
        yield "how often it ran with the auditor's seed: what fails now and then may have been run until it passed"
    yield "that the adapter passes on what the product does (docs/honesty.md says what an auditor checks)"
