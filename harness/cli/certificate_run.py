"""What ``certify`` and ``commit`` do around a run: collect what takes part in it, and write signed files."""

from __future__ import annotations

import os
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import NoReturn

from securesystemslib.signer import CryptoSigner

from ucm_cts.harness.certificates.certifying import Run, certificate, models_of, statement_member, waivers_member
from ucm_cts.harness.certificates.challenges import Answered, Commitment, answered, now, read_small
from ucm_cts.harness.certificates.contents import Settings, descriptors, digest
from ucm_cts.harness.certificates.judging import entry_of, judged_again
from ucm_cts.harness.certificates.keys import Trust, TrustedKey, signer_of
from ucm_cts.harness.certificates.problems import Unreadable
from ucm_cts.harness.certificates.subjects import subjects_of, subjects_of_toolchain
from ucm_cts.harness.certificates.suite_build import suite_digest
from ucm_cts.harness.certificates.toolchain_rejudging import why_not_judged
from ucm_cts.harness.certificates.verified import Subject
from ucm_cts.harness.certificates.verifying import Verifier
from ucm_cts.harness.cli.framework_run import FrameworkRun
from ucm_cts.harness.cli.options import leave_with
from ucm_cts.harness.cli.terminal import Output, ends_like_interrupts
from ucm_cts.harness.cli.toolchain_command import ToolChainRan, ToolChainRun, run_toolchain
from ucm_cts.harness.execution.driver import Driver, Limits
from ucm_cts.harness.execution.offers import LIMITS
from ucm_cts.harness.execution.recording import RecordingDriver, encoded
from ucm_cts.harness.exploring.in_runs import DRAWN_SCENARIOS
from ucm_cts.harness.hosting.locate import Endpoint, WrongUse, locate
from ucm_cts.harness.report.write import keep_report, report_folder
from ucm_cts.harness.results.foreign import one_line
from ucm_cts.harness.results.known_failures import KnownFailure, known_today
from ucm_cts.harness.results.statement import Statement
from ucm_cts.harness.results.values import FrameworkReport
from ucm_cts.harness.statement.files import check_subject, stated_by
from ucm_cts.harness.toolchains import recorded_form
from ucm_cts.harness.toolchains.campaign import TASKS
from ucm_cts.harness.toolchains.commands.description import read_toolchain


@dataclass(frozen=True)
class Wanted:
    """What a user wants of a certificate. ``witness``: an auditor signs."""

    key: Path
    artifacts: tuple[Path, ...]
    out: Path
    challenge: Path | None
    witness: bool


class CertificateKeeper:
    """Makes a certificate of a run. Everything that can be wrong is checked before the run. Raises ``WrongUse``."""

    def __init__(self, wanted: Wanted, profile: str, systematic: int) -> None:
        self._record = b""
        self._wanted = wanted
        self._systematic = systematic
        self._signer = signer_of(wanted.key)
        check_new(wanted.out)
        subjects_of("", wanted.artifacts, ()) if wanted.artifacts else None
        self._challenge = b""
        self._answer: Answered | None = None
        self._subjects: tuple[Subject, ...] = ()
        if wanted.challenge is not None:
            self._challenge = read_small(wanted.challenge, "a challenge of 'ucm-cts challenge'")
            try:
                self._answer = answered(self._challenge)
            except Unreadable as wrong:
                raise WrongUse(f"'{wanted.challenge}': {wrong}") from None
            if self._answer.commitment.profile != profile:
                raise WrongUse(
                    f"the challenge is for profile '{one_line(self._answer.commitment.profile, 40)}'; give it with --profile"
                )

    @property
    def seed(self) -> int | None:
        """The seed that the challenge gives; None without one."""
        return self._answer.seed if self._answer is not None else None

    def driver(self, endpoint: Endpoint, seed: int, limits: Limits) -> Driver:
        """A driver that records the run."""
        return RecordingDriver(endpoint, seed, limits)

    def begin(self, driver: Driver, statement: Statement, known: tuple[KnownFailure, ...]) -> None:
        """The run can begin: does it keep the commitment? Raises ``WrongUse``."""
        models_of(statement)
        subjects = subjects_of(driver.adapter_file, self._wanted.artifacts, ())
        if self._answer is None:
            return
        made = self._answer.commitment
        identity = driver.identity
        ours = _commitment(
            identity.product, identity.version, made.profile, subjects, statement, known, self._systematic
        )
        for name in ("product", "version", "statement", "waivers", "suite", "systematic", "subjects"):
            if getattr(made, name) != getattr(ours, name):
                raise WrongUse(
                    f"the vendor committed to another {name} than this run would have; restore it, or commit anew: ucm-cts commit"
                )

    def measured(self, driver: Driver) -> None:
        """The run has ended, and its hosts are still there."""
        assert isinstance(driver, RecordingDriver)
        self._record = encoded(driver.record)
        self._subjects = subjects_of(driver.adapter_file, self._wanted.artifacts, driver.loaded_files())

    def finish(self, report: FrameworkReport, wanted: FrameworkRun, known: tuple[KnownFailure, ...]) -> str:
        """Write the certificate of ``report``. Returns the line to print."""
        if report.incomplete:
            return _INCOMPLETE
        run = Run(
            report=entry_of(report),
            record=self._record,
            statement=report.statement,
            waivers=known,
            subjects=self._subjects,
            settings=Settings(
                wanted.limits.seconds,
                wanted.limits.memory,
                wanted.limits.incident_seconds,
                wanted.systematic,
                report.effort.measures.get(DRAWN_SCENARIOS, 0),
            ),
            assurance="witnessed"
            if self._wanted.witness
            else "challenged"
            if self._answer is not None
            else "self-declared",
            challenge=self._challenge,
        )
        return _written(certificate(run, [self._signer]), self._signer, self._wanted.out)


@dataclass(frozen=True)
class Committing:
    """What a vendor commits to: the arguments of ``ucm-cts commit``."""

    adapter: str
    profile: str
    artifacts: tuple[Path, ...]
    ics: Path | None
    known_failures: Path | None
    systematic: int

    def commitment(self) -> Commitment:
        """The commitment, as of now. Raises ``WrongUse``, ``DocumentError`` and ``HostUnavailable``."""
        endpoint = locate(self.adapter)
        known = known_today(self.known_failures)
        statement = stated_by(self.ics, self.adapter)
        with ends_like_interrupts(), Driver(endpoint, 0, LIMITS) as driver:
            identity = driver.identity
            check_subject(statement, identity, self.profile)
            subjects = subjects_of(driver.adapter_file, self.artifacts, ())
        return _commitment(
            identity.product, identity.version, self.profile, subjects, statement, known, self.systematic
        )


def certify_toolchain_run(wanted: Wanted, run: ToolChainRun) -> NoReturn:
    """Run a tool chain, write report and certificate, and end. Raises ``WrongUse`` and ``DocumentError``."""
    signer = signer_of(wanted.key)
    check_new(wanted.out)
    console = Output()
    with ends_like_interrupts() as interrupts, interrupts.held(), report_folder(run.out) as folder:
        toolchain = read_toolchain(run.path)
        task = TASKS[run.profile]
        described = toolchain.command_for(task)
        why = why_not_judged(described, task) if described is not None else ""
        if why:
            raise WrongUse(f"nobody could verify the certificate: {why}")
        subjects = subjects_of_toolchain(toolchain, task, wanted.artifacts)
        ran = run_toolchain(run, console, interrupts)
        saved = keep_report(ran.report, folder)
        record, problem = _record_of(ran)
        if problem:
            console.say(problem)
        else:
            made = Run(
                report=entry_of(ran.report),
                record=record,
                statement=ran.plan.statement,
                waivers=tuple(ran.known),
                subjects=subjects,
                settings=Settings(toolchain.seconds, toolchain.memory, 0.0, 0, 0),
                assurance="witnessed" if wanted.witness else "self-declared",
            )
            console.say(_written(certificate(made, [signer]), signer, wanted.out))
        leave_with(console, ran.report, saved, ran.known, run.everything)


def _record_of(ran: ToolChainRan) -> tuple[bytes, str]:
    """The record of a run on a tool chain, or why no certificate can be made of it."""
    if ran.report.incomplete:
        return b"", _INCOMPLETE
    try:
        return recorded_form.encoded(ran.record()), ""
    except recorded_form.RecordError as problem:
        return b"", f"no certificate is made: {problem}"


_INCOMPLETE = "no certificate is made of an incomplete run; run it again"


def _written(content: bytes, signer: CryptoSigner, out: Path) -> str:
    """Write a certificate that stands. Returns the line about it. Raises if it does not stand although the run was just made."""
    own = Trust({signer.public_key.keyid: TrustedKey("own", signer.public_key)})
    verified = Verifier(own, judged_again).verify(content)
    if verified.problems:
        told = "; ".join(f"{problem.check}: {problem.detail}" for problem in verified.problems[:3])
        raise RuntimeError(f"the certificate would not stand, and is not written ({told}); the report is kept")
    write_new(out, content)
    return f"certificate {out} ({len(content):,} bytes); verify it: ucm-cts verify {out} --trust KEYS"


def _commitment(
    product: str,
    version: str,
    profile: str,
    subjects: tuple[Subject, ...],
    statement: Statement,
    known: tuple[KnownFailure, ...],
    systematic: int,
) -> Commitment:
    return Commitment(
        product=one_line(product),
        version=one_line(version),
        profile=profile,
        subjects=descriptors({subject.name: subject.sha256 for subject in subjects}),
        statement=digest(statement_member(statement)),
        waivers=digest(waivers_member(known)),
        suite=suite_digest(),
        systematic=systematic,
        made=now(),
    )


def check_new(path: Path) -> None:
    """Raise ``WrongUse`` unless a file can be made at ``path``, where there is none."""
    if os.path.lexists(path):
        raise WrongUse(f"'{path}' is there already, and is never written over; move it away, or choose another --out")
    try:
        tempfile.TemporaryFile(dir=path.parent).close()
    except OSError as error:
        raise WrongUse(f"'{path}' cannot be written: {error.strerror}; choose another --out") from None


def write_new(path: Path, content: bytes) -> None:
    """Write a new file, whole or not at all. Raises ``WrongUse`` if one came there meanwhile."""
    handle, temporary = tempfile.mkstemp(prefix=f".{path.name[:50]}.", dir=path.parent)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(content)
        os.chmod(temporary, 0o644)
        os.link(temporary, path)
    except OSError as error:
        raise WrongUse(f"'{path}' cannot be written: {error.strerror}; choose another --out") from None
    finally:
        Path(temporary).unlink(missing_ok=True)
