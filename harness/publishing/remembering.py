"""Remembers certificates that stand, so that a site with many of them is made again quickly (``publish --remember``).

An entry is for one archive, one set of keys and one build of the suite: its key is a digest of all three. What fell is verified
anew each time, and so is what holds for a time only (waivers). Whoever can write the file could make anything stand, so a file
that others can write, or that somebody else owns, is refused.
"""

from __future__ import annotations

import gzip
import hashlib
import io
import os
import stat
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from threading import Lock
from typing import Self

import msgspec

from ucm_cts.harness.certificates.suite_build import suite_digest
from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.publishing.certificate import Certificate
from ucm_cts.harness.report.write import write_whole

LARGEST = 512 << 20
"""Bytes that the memory may have once it is unpacked."""

_OTHERS = stat.S_IWGRP | stat.S_IWOTH


class _Kept(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    schema_version: int
    entries: dict[str, Certificate]


@dataclass
class Memory:
    """What earlier runs found out. ``circumstances``: a digest of keys, suite and options; empty: nothing is remembered."""

    circumstances: str = ""
    entries: dict[str, Certificate] = field(default_factory=dict)
    used: dict[str, Certificate] = field(default_factory=dict)
    _lock: Lock = field(default_factory=Lock)

    @classmethod
    def read(cls, path: Path, circumstances: str) -> Self:
        """What the file at ``path`` remembers; nothing if it is not there. Raises ``WrongUse``."""
        try:
            handle = os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC)
        except FileNotFoundError:
            return cls(circumstances)
        except OSError as error:
            raise WrongUse(f"'{path}' cannot be read: {error.strerror}; name another file to --remember") from None
        with os.fdopen(handle, "rb") as file:
            found = os.fstat(handle)
            if not stat.S_ISREG(found.st_mode):
                raise WrongUse(f"'{path}' is no plain file; name another one to --remember")
            if found.st_uid != os.geteuid() or found.st_mode & _OTHERS:
                raise WrongUse(f"others can write '{path}', and could make anything stand; chmod 600, or remove it")
            try:
                with gzip.GzipFile(fileobj=file) as unpacked:
                    kept = msgspec.json.decode(unpacked.read(LARGEST), type=_Kept)
            except (OSError, EOFError, msgspec.MsgspecError, RecursionError, UnicodeDecodeError):
                raise WrongUse(f"'{path}' is no memory of this command; name another file, or remove it") from None
        return cls(circumstances, kept.entries)

    def of(self, digest: str) -> Certificate | None:
        """What is known of the archive with ``digest``, if anything is."""
        key = self._key(digest)
        found = self.entries.get(key) if self.circumstances else None
        if found is None or found.digest != digest:
            return None
        with self._lock:
            self.used[key] = found
        return found

    def keep(self, certificate: Certificate) -> None:
        """Remember that it stands."""
        if self.circumstances and not certificate.uncovered.waivers:
            with self._lock:
                self.used[self._key(certificate.digest)] = certificate

    def write(self, path: Path) -> None:
        """Write what this run needed. Raises ``WrongUse``."""
        packed = io.BytesIO()
        with gzip.GzipFile(fileobj=packed, mode="wb", mtime=0) as file:
            file.write(msgspec.json.encode(_Kept(1, self.used), order="sorted"))
        try:
            write_whole(path, packed.getvalue(), 0o600)
        except OSError as error:
            raise WrongUse(f"'{path}' cannot be written: {error.strerror}; name another file to --remember") from None

    def _key(self, digest: str) -> str:
        return hashlib.sha256(f"{self.circumstances} {digest}".encode()).hexdigest()


def circumstances(keys: Sequence[Path], options: Sequence[str]) -> str:
    """A digest of everything beside an archive that decides whether it stands. Raises ``WrongUse``."""
    parts = [suite_digest(), *options]
    for place in keys:
        try:
            for path in [place] if place.is_file() else sorted(p for p in place.rglob("*") if p.is_file()):
                parts.append(os.path.relpath(path, place))
                parts.append(hashlib.sha256(path.read_bytes()).hexdigest())
        except OSError as error:
            raise WrongUse(f"the keys in '{place}' cannot be read: {error.strerror}") from None
        parts.append("")
    return hashlib.sha256(msgspec.json.encode([os.fsencode(part).hex() for part in parts])).hexdigest()
