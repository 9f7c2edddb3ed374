"""Finds archives and has each of them verified in a process of its own, with limits: none can stop, slow or forge the others."""

from __future__ import annotations

import hashlib
import os
import resource
import signal
import stat
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from threading import Lock
from typing import NamedTuple

import msgspec

from ucm_cts.harness.certificates.problems import Problem
from ucm_cts.harness.certificates.verified import decoded
from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.publishing.certificate import Certificate, Fallen, Lie, settled
from ucm_cts.harness.publishing.remembering import Memory
from ucm_cts.harness.results.foreign import one_line

SUFFIX = ".ucmcert"

LARGEST_ARCHIVE = 64 << 20
"""Bytes an archive may have."""

LARGEST_ANSWER = 64 << 20
"""Bytes that verification may print."""

MOST = 20_000
"""The most archives of a site."""

STANDS, STANDS_OTHERWISE, FALLS = 0, 4, 1
"""How ``ucm-cts verify`` ends: the certificate stands and says conformant; it stands and says something else; it does not stand."""


@dataclass
class Verifier:
    """Verifies archives in processes of their own.

    ``command`` is followed by the path of an archive; it prints a ``Verified`` as JSON. ``seconds`` and ``memory`` (MiB)
    are for each process.
    """

    command: Sequence[str]
    seconds: float = 600.0
    memory: int = 4096
    _running: set[subprocess.Popen[bytes]] = field(default_factory=set)
    _lock: Lock = field(default_factory=Lock)
    _is_over: bool = False

    def __call__(self, path: Path, digest: str, file: str, size: int) -> Certificate | Fallen:
        """What the archive at ``path`` is worth, whatever happens."""
        with tempfile.TemporaryDirectory(prefix="ucm-cts-publish-", ignore_cleanup_errors=True) as place:
            folder = Path(place)
            with open(folder / "out", "w+b") as out, open(folder / "err", "w+b") as err:
                status = self._run(path, folder, out.fileno(), err.fileno())
                out.seek(0)
                err.seek(0)
                answer, complaint = out.read(LARGEST_ANSWER + 1), err.read(1 << 16).decode("utf-8", "replace")
        if status is None:
            return _fallen(file, digest, "time", f"verification did not end within {self.seconds:g} s")
        if status not in (STANDS, STANDS_OTHERWISE, FALLS) or not answer:
            why = f"signal {-status}" if status < 0 else f"exit status {status}"
            last = (complaint.strip().splitlines() or ["it printed nothing"])[-1].replace(str(path), file)
            return _fallen(file, digest, "verification", f"verification ended with {why}: {one_line(last, 300)}")
        try:
            if len(answer) > LARGEST_ANSWER:
                raise Lie("the verification prints too much")
            verified = decoded(answer)
            is_good = verified.verdict == "conformant" and not verified.is_delta
            if status != (FALLS if not verified.stands else STANDS if is_good else STANDS_OTHERWISE):
                raise Lie("its verification ends with another status than it prints")
            return settled(verified, digest, file, size)
        except (msgspec.MsgspecError, RecursionError, UnicodeDecodeError) as error:
            return _fallen(file, digest, "verification", f"verification printed no result: {one_line(str(error))}")
        except Lie as lie:
            return _fallen(file, digest, "verification", str(lie))

    def _run(self, path: Path, folder: Path, out: int, err: int) -> int | None:
        """The exit status; None if it did not end in time."""
        with self._lock:
            if self._is_over:
                return None
            process = subprocess.Popen(
                [*self.command, str(path)],
                stdin=subprocess.DEVNULL,
                stdout=out,
                stderr=err,
                cwd=folder,
                env={**os.environ, "TMPDIR": str(folder), "PYTHONSAFEPATH": "1", "NO_COLOR": "1"},
                start_new_session=True,
            )
            self._running.add(process)
        try:
            with suppress(ProcessLookupError):
                resource.prlimit(process.pid, resource.RLIMIT_AS, (self.memory << 20, self.memory << 20))
                resource.prlimit(process.pid, resource.RLIMIT_FSIZE, (4 * LARGEST_ANSWER, 4 * LARGEST_ANSWER))
                resource.prlimit(process.pid, resource.RLIMIT_CORE, (0, 0))
            return process.wait(self.seconds)
        except subprocess.TimeoutExpired:
            return None
        finally:
            _end(process)
            with self._lock:
                self._running.discard(process)

    def stop(self) -> None:
        """End every verification."""
        with self._lock:
            self._is_over = True
            for process in self._running:
                _end(process)


def verifying_command(trust: Path, *options: str) -> tuple[str, ...]:
    """The command that verifies an archive with the keys ``trust``."""
    return (sys.executable, "-m", "ucm_cts", "verify", "--json", "--trust", str(trust.absolute()), *options, "--")


class Collected(NamedTuple):
    """The archives of a folder: the certificates that stand, beginning with the oldest; what does not stand; and where the
    archive of each certificate that stands is, by its digest.
    """

    stand: list[Certificate]
    fall: list[Fallen]
    archives: dict[str, Path]


def collect(folder: Path, verifier: Verifier, memory: Memory, jobs: int, tell: Callable[[int, int], None]) -> Collected:
    """All archives below ``folder``, verified. An archive that is there twice counts once. ``tell`` hears how many are done,
    and of how many. Raises ``WrongUse``.
    """
    found = sorted(_archives(folder))
    if len(found) > MOST:
        raise WrongUse(f"'{folder}' has {len(found):,} archives; a site has at most {MOST:,}")
    seen: dict[str, Path] = {}
    lock = Lock()
    done = 0

    def one(path: Path) -> Certificate | Fallen | None:
        nonlocal done
        file = one_line(os.fsencode(path.relative_to(folder)).decode("utf-8", "replace"), 200)
        try:
            content = _content(path)
        except OSError as error:
            outcome: Certificate | Fallen | None = _fallen(file, "", "file", f"it cannot be read: {error.strerror}")
        except ValueError as error:
            outcome = _fallen(file, "", "file", str(error))
        else:
            digest = hashlib.sha256(content).hexdigest()
            with lock:
                is_new = digest not in seen
                seen.setdefault(digest, path)
            outcome = _verified(content, digest, file, verifier, memory) if is_new else None
        with lock:
            done += 1
            tell(done, len(found))
        return outcome

    with ThreadPoolExecutor(jobs) as pool:
        try:
            outcomes = list(pool.map(one, found))
        except BaseException:
            verifier.stop()
            pool.shutdown(cancel_futures=True)
            raise
    stand = [outcome for outcome in outcomes if isinstance(outcome, Certificate)]
    fall = [outcome for outcome in outcomes if isinstance(outcome, Fallen)]
    return Collected(
        sorted(stand, key=lambda one: one.age),
        sorted(fall, key=lambda one: (one.file, one.digest)),
        {one.digest: seen[one.digest] for one in stand},
    )


def _verified(content: bytes, digest: str, file: str, verifier: Verifier, memory: Memory) -> Certificate | Fallen:
    known = memory.of(digest)
    if known is not None:
        return msgspec.structs.replace(known, file=file)
    # the archive is verified under a name of ours: its own may be anything, and its content may change meanwhile
    with tempfile.NamedTemporaryFile(prefix="ucm-cts-", suffix=SUFFIX) as copy:
        copy.write(content)
        copy.flush()
        outcome = verifier(Path(copy.name), digest, file, len(content))
    if isinstance(outcome, Certificate):
        memory.keep(outcome)
    return outcome


def _archives(folder: Path) -> Iterator[Path]:
    """Everything below ``folder`` that is named like an archive. Links to folders are not followed. Raises ``WrongUse``."""

    def refuse(error: OSError) -> None:
        raise WrongUse(f"'{error.filename}' cannot be read: {error.strerror}") from None

    for place, folders, files in os.walk(folder, onerror=refuse):
        for name in [*files, *folders]:
            if name.endswith(SUFFIX):
                yield Path(place, name)


def _content(path: Path) -> bytes:
    """The bytes of the archive. Raises ``OSError``, and ``ValueError`` for what is no archive."""
    if path.is_symlink():
        raise ValueError("it is a link; put the archive itself there")
    handle = os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC)
    with os.fdopen(handle, "rb") as file:
        if not stat.S_ISREG(os.fstat(handle).st_mode):
            raise ValueError("it is no plain file")
        content = file.read(LARGEST_ARCHIVE + 1)
    if len(content) > LARGEST_ARCHIVE:
        raise ValueError(f"it has more than {LARGEST_ARCHIVE >> 20} MiB")
    return content


def _fallen(file: str, digest: str, check: str, detail: str) -> Fallen:
    return Fallen(file, digest, (Problem(check, detail),))


def _end(process: subprocess.Popen[bytes]) -> None:
    """End ``process`` and its group."""
    with suppress(ProcessLookupError, PermissionError):
        os.killpg(process.pid, signal.SIGKILL)
    with suppress(subprocess.TimeoutExpired):
        process.wait(10)
