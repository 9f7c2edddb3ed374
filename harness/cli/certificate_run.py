"""What ``certify`` and ``commit`` do around a run: collect what takes part in it, and write signed files."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import NoReturn

from securesystemslib.signer import CryptoSigner

from ucm_cts.harness.certificates.certifying import Run, certificate, models_of, statement_member, waivers_member
from ucm_cts.harness.certificates.challenges import Answered, Commitment, answered, now, read_small
from ucm_cts.harness.certificates.contents import Settings, descriptors, digest
from ucm_cts.harness.certificates.judging import judged_again
from ucm_cts.harness.certificates.keys import Trust, TrustedKey, signer_of
from ucm_cts.harness.certificates.problems import Unreadable
from ucm_cts.harness.certificates.subjects import subjects_of, subjects_of_toolchain
from ucm_cts.harness.certificates.suite_build import suite_digest
from ucm_cts.harness.certificates.toolchain_rejudging import why_not_judged
from ucm_cts.harness.certificates.verified import Assurance, Subject
from ucm_cts.harness.certificates.verifying import Verifier
from ucm_cts.harness.cli.framework_run import FrameworkRun
from ucm_cts.harness.cli.options import leave_with
from ucm_cts.harness.cli.terminal import Output, ends_like_interrupts
from ucm_cts.harness.cli.toolchain_command import (
    ToolChainRan,
    ToolChainRun,
    prepare,
    run_toolchain,
    stated_of_toolchain,
)
from ucm_cts.harness.execution.driver import Driver, Limits
from ucm_cts.harness.execution.offers import LIMITS
from ucm_cts.harness.execution.recording import RecordingDriver, encoded
from ucm_cts.harness.exploring.in_runs import DRAWN_SCENARIOS
from ucm_cts.harness.hosting.locate import Endpoint, WrongUse, locate
from ucm_cts.harness.report.json_report import entry_of
from ucm_cts.harness.report.write import keep_report, report_folder
from ucm_cts.harness.results.foreign import one_line
from ucm_cts.harness.results.known_failures import KnownFailure, known_today
from ucm_cts.harness.results.statement import Statement
from ucm_cts.harness.results.values import FrameworkReport
from ucm_cts.harness.statement.files import Identity, check_subject, stated_by
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
        self._task = _Task.of(wanted, profile)
        self._subjects: tuple[Subject, ...] = ()

    @property
    def seed(self) -> int | None:
        """The seed that the challenge gives; None without one."""
        return self._task.seed

    def driver(self, endpoint: Endpoint, seed: int, limits: Limits) -> Driver:
        """A driver that records the run."""
        return RecordingDriver(endpoint, seed, limits)

    def begin(self, driver: Driver, statement: Statement, known: tuple[KnownFailure, ...]) -> None:
        """The run can begin: does it keep the commitment? Raises ``WrongUse``."""
        models_of(statement)
        subjects = subjects_of(driver.adapter_file, self._wanted.artifacts, ())
        self._task.check(driver.identity, subjects, statement, known, self._systematic)

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
            assurance=self._task.assurance,
            challenge=self._task.challenge,
        )
        return _written(certificate(run, [self._signer]), self._signer, self._wanted.out)


@dataclass(frozen=True)
class Committing:
    """What a vendor commits to: the arguments of ``ucm-cts commit``. ``hidden``: what hosts must not see."""

    adapter: str
    toolchain: Path | None
    profile: str
    artifacts: tuple[Path, ...]
    ics: Path | None
    known_failures: Path | None
    systematic: int
    sandbox: bool
    hidden: tuple[Path, ...]

    def commitment(self) -> Commitment:
        """The commitment, as of now. Raises ``WrongUse``, ``DocumentError`` and ``HostUnavailable``."""
        known = known_today(self.known_failures)
        if self.toolchain is not None:
            return self._to_toolchain(self.toolchain, known)
        endpoint = locate(self.adapter, sandbox=self.sandbox, hidden=self.hidden)
        statement = stated_by(self.ics, self.adapter, self.sandbox)
        with ends_like_interrupts(), Driver(endpoint, 0, LIMITS) as driver:
            identity = driver.identity
            check_subject(statement, identity, self.profile)
            subjects = subjects_of(driver.adapter_file, self.artifacts, ())
        return _commitment(identity, self.profile, subjects, statement, known, self.systematic)

    def _to_toolchain(self, path: Path, known: Sequence[KnownFailure]) -> Commitment:
        toolchain = read_toolchain(path)
        if toolchain.command_for(TASKS[self.profile]) is None:
            raise WrongUse(
                f"{path} does not say how '{TASKS[self.profile]}' is done, which profile '{self.profile}' needs"
            )
        statement = stated_of_toolchain(self.ics, toolchain, self.profile)
        subjects = subjects_of_toolchain(toolchain, TASKS[self.profile], self.artifacts)
        return _commitment(toolchain, self.profile, subjects, statement, known, 0)


@dataclass(frozen=True)
class _Task:
    """What an auditor asked for, or did himself: the content of the ``challenge`` in ``file`` and the ``answer`` to it, if there is one."""

    file: Path | None = None
    challenge: bytes = b""
    answer: Answered | None = None
    is_witness: bool = False

    @classmethod
    def of(cls, wanted: Wanted, profile: str) -> _Task:
        """What ``wanted`` says, for a run of ``profile``. Raises ``WrongUse``."""
        if wanted.challenge is None:
            return cls(is_witness=wanted.witness)
        content = read_small(wanted.challenge, "a challenge of 'ucm-cts challenge'")
        try:
            answer = answered(content)
        except Unreadable as wrong:
            raise WrongUse(f"'{wanted.challenge}': {wrong}") from None
        if answer.commitment.profile != profile:
            raise WrongUse(
                f"the challenge is for profile '{one_line(answer.commitment.profile, 40)}'; give it with --profile"
            )
        return cls(wanted.challenge, content, answer)

    @property
    def seed(self) -> int | None:
        return self.answer.seed if self.answer is not None else None

    @property
    def assurance(self) -> Assurance:
        if self.is_witness:
            return "witnessed"
        return "challenged" if self.answer is not None else "self-declared"

    def check(
        self,
        identity: Identity,
        subjects: tuple[Subject, ...],
        statement: Statement,
        known: Sequence[KnownFailure],
        systematic: int,
    ) -> None:
        """Raise ``WrongUse`` if a run of this would not keep the commitment."""
        if self.answer is None:
            return
        made = self.answer.commitment
        ours = _commitment(identity, made.profile, subjects, statement, known, systematic)
        for problem in unlike(made, ours):
            raise WrongUse(f"'{self.file}': {problem}; or commit anew: ucm-cts commit")


def certify_toolchain_run(wanted: Wanted, run: ToolChainRun) -> NoReturn:
    """Run a tool chain, write report and certificate, and end. Raises ``WrongUse`` and ``DocumentError``."""
    signer = signer_of(wanted.key)
    check_new(wanted.out)
    asked = _Task.of(wanted, run.profile)
    if asked.seed is not None:
        run = replace(run, seed=asked.seed)
    console = Output()
    with ends_like_interrupts() as interrupts, interrupts.held(), report_folder(run.out) as folder:
        prepared = prepare(run)
        toolchain, task = prepared.toolchain, TASKS[run.profile]
        described = toolchain.command_for(task)
        why = why_not_judged(described, task) if described is not None else ""
        if why:
            raise WrongUse(f"nobody could verify the certificate: {why}")
        subjects = subjects_of_toolchain(toolchain, task, wanted.artifacts)
        asked.check(toolchain, subjects, prepared.statement, prepared.known, 0)
        ran = run_toolchain(prepared, console, interrupts)
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
                assurance=asked.assurance,
                challenge=asked.challenge,
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
    identity: Identity,
    profile: str,
    subjects: tuple[Subject, ...],
    statement: Statement,
    known: Sequence[KnownFailure],
    systematic: int,
) -> Commitment:
    return Commitment(
        product=one_line(identity.product),
        version=one_line(identity.version),
        profile=profile,
        subjects=descriptors({subject.name: subject.sha256 for subject in subjects}),
        statement=digest(statement_member(statement)),
        waivers=digest(waivers_member(known)),
        suite=suite_digest(),
        systematic=systematic,
        made=now(),
    )


def unlike(made: Commitment, ours: Commitment) -> Iterator[str]:
    """What this run would have otherwise than the vendor committed to, each with its remedy."""
    for what in ("product", "version"):
        said, found = getattr(made, what), getattr(ours, what)
        if said != found:
            yield f"the vendor committed to {what} '{one_line(said, 60)}', and this is '{one_line(found, 60)}'; name the adapter of that one"
    for differ, what, remedy in (
        (made.statement != ours.statement, "another statement", "give the same file with --ics"),
        (made.waivers != ours.waivers, "other known failures", "give the same file with --known-failures"),
        (made.suite != ours.suite, "another build of ucm-cts", "run that one"),
        (made.systematic != ours.systematic, f"--systematic {made.systematic}", "give the same"),
    ):
        if differ:
            yield f"the vendor committed to {what}; {remedy}"
    committed, there = ({one.name: one.digest for one in of.subjects} for of in (made, ours))
    for name in committed:
        if name not in there:
            yield f"the vendor committed to '{one_line(name, 80)}', which takes no part in this run; name it with --artifact"
        elif there[name] != committed[name]:
            yield f"'{one_line(name, 80)}' is not the file that the vendor committed to: it was changed since; restore it"
    for name in there:
        if name not in committed:
            yield f"'{one_line(name, 80)}' takes part in this run, and the vendor did not commit to it; leave it out"


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
