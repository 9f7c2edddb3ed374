"""Makes certificates, and forges them: as a stranger does, who has no key, and as a lying vendor, who signs again."""

from __future__ import annotations

import functools
import io
import stat
import tempfile
import zipfile
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import msgspec
from securesystemslib.signer import CryptoSigner

import ucm_cts
from ucm_cts.harness.catalogue.profiles import PARTS
from ucm_cts.harness.catalogue.requirements import load_requirements
from ucm_cts.harness.catalogue.specification import load_specification
from ucm_cts.harness.certificates import archive
from ucm_cts.harness.certificates.certifying import Run, certificate, sealed, statement_member, waivers_member
from ucm_cts.harness.certificates.challenges import CHALLENGE_TYPE, Challenge, Challenged, Commitment, committed
from ucm_cts.harness.certificates.contents import Claims, Environment, Settings, descriptors, digest
from ucm_cts.harness.certificates.envelopes import encoded, opened, signed
from ucm_cts.harness.certificates.keys import NOBODY, Rule, Trust, TrustedKey
from ucm_cts.harness.certificates.problems import Problem
from ucm_cts.harness.certificates.reading import Contents, read_certificate
from ucm_cts.harness.certificates.suite_build import suite_digest
from ucm_cts.harness.certificates.verified import Subject, Verified
from ucm_cts.harness.certificates.verifying import SuiteChoice, Verifier
from ucm_cts.harness.report.json_report import FindingEntry, ReportEntry, RequirementEntry, StatementEntry
from ucm_cts.harness.report.scope import Scope
from ucm_cts.harness.results.known_failures import KnownFailure
from ucm_cts.harness.results.statement import Statement, default_statement

Members = dict[str, bytes]


@functools.cache
def key_of(name: str) -> CryptoSigner:
    """The key of the vendor, auditor or stranger ``name``: a new one in each run of the tests."""
    return CryptoSigner.generate_ed25519()


def trust(*names: str, **rules: Rule) -> Trust:
    """A verifier who relies on the keys of ``names``, under ``rules``."""
    keys = {}
    for name in names:
        public = key_of(name).public_key
        keys[public.keyid] = TrustedKey(name, public, rules.get(name, Rule()))
    return Trust(keys, "keys")


@dataclass(frozen=True)
class FakeJudged:
    """What a record says of itself, in place of scenarios and traces."""

    report: ReportEntry
    problems: tuple[Problem, ...] = ()
    unshown: tuple[str, ...] = ()


def fake_judge(contents: Contents, statement: Statement, is_delta: bool) -> FakeJudged:
    """Takes the record for a report: tests of everything around records need no run."""
    assert contents.record is not None
    return FakeJudged(msgspec.json.decode(contents.record, type=ReportEntry))


def made_report(**changes: Any) -> ReportEntry:
    """The report of a product that passes everything in profile container, with ``changes``."""
    requirements = tuple(
        RequirementEntry(r.id, r.clause, r.title, r.level, "pass", 3, "", (), "", True, r.derived)
        for r in load_requirements()
        if r.profile in PARTS["container"] and not (r.untestable or r.pending)
    )
    fields: dict[str, Any] = {
        "product": "Acme UCM",
        "version": "1.2",
        "profile": "container",
        "verdict": "conformant",
        "requirements": requirements,
        "incidents": (),
        "transitions": (),
        "adapter": "acme:Adapter",
        "suite_version": ucm_cts.__version__,
        "seed": 7,
        "started": "2026-11-01T10:00:00+00:00",
        "seconds": 1.5,
        "scenarios": 700,
        "events": 9_000,
        "statement": StatementEntry.of(default_statement()),
        "readings": {},
        "measures": {},
        "seconds_by_clause": {},
        "runs": 1,
        "scope": Scope(load_specification(), "container", len(requirements), 0, 0),
    }
    return ReportEntry(**{**fields, **changes})


def failing(report: ReportEntry, id_: str, waived: str = "") -> ReportEntry:
    """``report`` with a failure of the requirement ``id_``."""
    finding = FindingEntry("rule", "a start", "no start", 1, waived, "", "some scenario", (), "failures/x.json")
    requirements = tuple(
        msgspec.structs.replace(entry, verdict="fail", findings=(finding,)) if entry.id == id_ else entry
        for entry in report.requirements
    )
    return msgspec.structs.replace(report, verdict="not conformant", requirements=requirements)


ADAPTER = Subject("adapter/acme.py", "a" * 64)
LIBRARY = Subject("artifact/libacme.so", "b" * 64)
SETTINGS = Settings(5.0, 1024, 60.0, 0, 40)


def run_of(report: ReportEntry, **changes: Any) -> Run:
    """A run whose record is its report."""
    fields: dict[str, Any] = {
        "report": report,
        "record": msgspec.json.encode(report),
        "statement": default_statement(),
        "waivers": (),
        "subjects": (ADAPTER, LIBRARY),
        "settings": SETTINGS,
    }
    return Run(**{**fields, **changes})


def commitment_to(report: ReportEntry, **changes: Any) -> Commitment:
    """What a vendor commits to before ``report``."""
    fields: dict[str, Any] = {
        "product": report.product,
        "version": report.version,
        "profile": report.profile,
        "subjects": descriptors({ADAPTER.name: ADAPTER.sha256, LIBRARY.name: LIBRARY.sha256}),
        "statement": digest(statement_member(default_statement())),
        "waivers": digest(waivers_member(())),
        "suite": suite_digest(),
        "systematic": 0,
        "made": "2026-10-30T10:00:00+00:00",
    }
    return Commitment(**{**fields, **changes})


def challenge_to(made: Commitment, vendor: str = "acme", auditor: str = "tuev", **changes: Any) -> bytes:
    """The file of an auditor's answer to the commitment ``made``, with ``changes`` of the answer."""
    envelope = committed(made, [key_of(vendor)])
    fields: dict[str, Any] = {
        "commitment": digest(envelope),
        "nonce": "5a" * 32,
        "number": 1,
        "issued": "2026-10-31T10:00:00+00:00",
    }
    answer = Challenge(**{**fields, **changes})
    return encoded(Challenged(envelope.decode(), signed(encoded(answer), CHALLENGE_TYPE, [key_of(auditor)]).decode()))


@dataclass
class Forger:
    """A certificate taken apart, to be put together again otherwise."""

    members: Members
    claims: Claims
    subjects: list[Subject]
    signer: str = "acme"
    others: dict[str, bytes] = field(default_factory=dict)

    def change(self, name: str, change: Callable[[Any], Any]) -> None:
        """Replace the JSON of the member ``name`` by what ``change`` makes of it, in the form that certificates have."""
        value = change(msgspec.json.decode(self.members[name]))
        indent = 2 if name == archive.REPORT else 1
        self.members[name] = msgspec.json.format(msgspec.json.encode(value), indent=indent) + b"\n"

    def report(self, **changes: Any) -> None:
        """Change fields of the report, and what is claimed of it."""
        self.members[archive.REPORT] = encoded(msgspec.structs.replace(self.said, **changes), indent=2)
        claimed = {name: value for name, value in changes.items() if name in Claims.__struct_fields__}
        self.claims = msgspec.structs.replace(self.claims, **claimed)

    @property
    def said(self) -> ReportEntry:
        """The report as it is now."""
        return msgspec.json.decode(self.members[archive.REPORT], type=ReportEntry)

    def requirement(self, id_: str, **changes: Any) -> None:
        """Change one requirement of the report."""
        entries = tuple(
            msgspec.structs.replace(entry, **changes) if entry.id == id_ else entry for entry in self.said.requirements
        )
        self.members[archive.REPORT] = encoded(msgspec.structs.replace(self.said, requirements=entries), indent=2)

    def record(self, content: bytes) -> None:
        """Put another record in."""
        self.members[archive.RECORD] = archive.packed(content)

    def resigned(self) -> bytes:
        """The archive, signed again with everything that was changed: the work of a vendor who lies."""
        environment = msgspec.json.decode(self.members[archive.ENVIRONMENT], type=Environment)
        members = {name: content for name, content in self.members.items() if name != archive.ENVELOPE}
        return sealed(members, self.claims, self.subjects, environment, self.said, [key_of(self.signer)])

    def unsigned(self) -> bytes:
        """The archive with the old signature: the work of a stranger."""
        return archive.written(self.members)

    def signed_statement(self, change: Callable[[Any], Any], kind: str = "application/vnd.in-toto+json") -> bytes:
        """The archive with a ``change`` of the signed statement, signed again."""
        statement = msgspec.json.decode(opened(self.members[archive.ENVELOPE], "", "").payload)
        payload = msgspec.json.format(msgspec.json.encode(change(statement)), indent=1) + b"\n"
        envelope = signed(payload, kind, [key_of(self.signer)])
        return archive.written({**self.members, archive.ENVELOPE: envelope})

    def envelope(self, change: Callable[[Any], Any]) -> bytes:
        """The archive with a ``change`` of the envelope's JSON."""
        self.change(archive.ENVELOPE, change)
        return self.unsigned()


def forger_of(data: bytes) -> Forger:
    """Takes a certificate apart."""
    contents = read_certificate(data)
    assert contents.signed is not None
    assert not contents.problems
    subjects = [Subject(one.name, one.digest["sha256"]) for one in contents.signed.subject]
    return Forger(dict(contents.members), contents.signed.predicate.ucm, subjects)


def verify(
    data: bytes,
    *names: str,
    auditors: Trust = NOBODY,
    suite: SuiteChoice = "same",
    judge: Any = fake_judge,
    **rules: Rule,
) -> Verified:
    """What a verifier finds who relies on the keys of ``names``, or of acme."""
    return Verifier(trust(*(names or ("acme",)), **rules), judge, auditors, suite).verify(data)


def zipped(
    members: Mapping[str, bytes], change: Callable[[zipfile.ZipInfo], None] | None = None, **options: Any
) -> bytes:
    """An archive as another program writes it; ``change`` is applied to the entry of each member."""
    target = io.BytesIO()
    with zipfile.ZipFile(target, "w", **options) as made:
        for name, content in members.items():
            info = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
            info.create_system, info.external_attr = 3, (stat.S_IFREG | 0o644) << 16
            info.compress_type = options.get("compression", zipfile.ZIP_STORED)
            if change is not None:
                change(info)
            made.writestr(info, content)
    return target.getvalue()


def ordered(members: Mapping[str, bytes]) -> Members:
    """The members in the order of certificates."""
    return {name: members[name] for name in archive.LARGEST if name in members}


@functools.cache
def intact(kind: str = "plain") -> bytes:
    """An intact certificate of some kind, signed by acme, or by the auditor if it is witnessed."""
    report = made_report()
    first = report.requirements[0].id
    match kind:
        case "failing":
            report = failing(report, first)
        case "waived":
            report = failing(report, first, "is being mended")
            waiver = KnownFailure(first, "no *", "is being mended", "2099-12-31")
            return certificate(run_of(report, waivers=(waiver,)), [key_of("acme")])
        case "inconclusive":
            report = msgspec.structs.replace(report, verdict="inconclusive")
        case "challenged":
            answer = challenge_to(commitment_to(report))
            report = msgspec.structs.replace(report, seed=seed_of(answer))
            return certificate(run_of(report, assurance="challenged", challenge=answer), [key_of("acme")])
        case "witnessed":
            return certificate(run_of(report, assurance="witnessed"), [key_of("tuev")])
        case "with models":
            with tempfile.TemporaryDirectory() as folder:
                (Path(folder) / "core.xml").write_text("<a/>")
                statement = msgspec.structs.replace(default_statement(), models=("core.xml",), folder=folder)
                report = made_report(statement=StatementEntry.of(statement))
                return certificate(run_of(report, statement=statement), [key_of("acme")])
        case "twice signed":
            return certificate(run_of(report), [key_of("acme"), key_of("lab")])
    return certificate(run_of(report), [key_of("acme")])


def seed_of(answer: bytes) -> int:
    """The seed that a challenge gives."""
    from ucm_cts.harness.certificates.challenges import answered

    return answered(answer).seed


INTACT = ("plain", "failing", "waived", "inconclusive", "challenged", "witnessed", "with models", "twice signed")
