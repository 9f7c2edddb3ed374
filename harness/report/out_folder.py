"""Writes results into the folder that a user names (``--out``), replaces what earlier commands wrote there, and touches nothing else.

A manifest in the folder names the files that commands wrote, with digests. A file is a command's own if the manifest names it
and its content is unchanged. Links are not followed, and one command at a time works in a folder.
"""

from __future__ import annotations

import errno
import fcntl
import fnmatch
import hashlib
import os
import secrets
import stat
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Self

import msgspec

from ucm_cts.harness.hosting.locate import WrongUse

MANIFEST = "ucm-cts-manifest.json"
"""The file that names what commands wrote."""

LARGEST_MANIFEST = 64 * 1024 * 1024
"""Bytes a manifest may have."""

_REMEDY = "move it away, or choose another --out"


class Manifest(msgspec.Struct, frozen=True):
    """``files``: the SHA-256 digest of each file that a command wrote, by its name relative to the folder.

    ``before``: while files are replaced, the digests of the old ones.
    """

    files: dict[str, str]
    before: dict[str, str] = {}

    def holds(self, name: str, digest: str) -> bool:
        """Did a command write the file ``name`` with that content?"""
        return bool(digest) and digest in (self.files.get(name), self.before.get(name))


@dataclass(frozen=True)
class Copy:
    """A file that is copied: its content must have the SHA-256 ``digest``."""

    path: Path
    digest: str

    def content(self) -> bytes:
        """The bytes. Raises ``OSError``, also if they have changed."""
        content = self.path.read_bytes()
        if hashlib.sha256(content).hexdigest() != self.digest:
            raise OSError(errno.ESTALE, "it was changed meanwhile", str(self.path))
        return content


class OutFolder:
    """A folder for results, open and locked in a ``with`` statement. Raises ``WrongUse`` if it cannot be used."""

    def __init__(self, path: Path, names: Sequence[str], folders: Sequence[str] = ()) -> None:
        """``names`` are patterns of the files that may be written, relative, at most one folder deep; other names are
        never touched. ``folders`` are made in any case.
        """
        self.path = path
        self._names = names
        self._folders = folders
        self._root = -1
        self._is_new = False

    def __enter__(self) -> Self:
        try:
            self._open()
            self._lock()
            self._check()
            self._probe()
        except (OSError, ValueError) as error:
            self.close()
            raise WrongUse(
                f"the report cannot be written to '{self.path}': {_why(error)}; choose another --out"
            ) from None
        except WrongUse:
            self.close()
            raise
        return self

    def __exit__(self, *error: object) -> None:
        self.close()

    def close(self) -> None:
        """Unlock the folder; if it was made for this command and stayed empty, remove it."""
        if self._root < 0:
            return
        if self._is_new and self._is_here():
            with suppress(OSError):
                os.rmdir(self.path)
        with suppress(OSError):
            fcntl.flock(self._root, fcntl.LOCK_UN)  # a process that was forked meanwhile may hold the folder open
        os.close(self._root)
        self._root = -1

    def save(self, files: Mapping[str, bytes | Copy], instead_of: Sequence[str] = ()) -> None:
        """Write ``files``, by their relative names, and remove own files that match ``instead_of`` and are not among them.

        All files are written beside the old ones first, and then renamed. Raises ``OSError``; nothing is replaced then.
        """
        wrong = [name for name in files if not self._matches(name)]
        if wrong:
            raise ValueError(f"'{wrong[0]}' is none of the files that this command writes")
        if not self._is_here():
            os.close(self._root)
            self._open()
            self._lock()
        for folder in {*self._folders, *(_parts(name)[0] for name in files)} - {""}:
            with suppress(FileExistsError):
                os.mkdir(folder, dir_fd=self._root)
        known = self._manifest()
        own = {name for name in known.files if self._matches(name) and known.holds(name, self._digest(name))}
        for name in files:
            if name not in own and self._is_there(name):
                raise FileExistsError(errno.EEXIST, "is there, and not of a run", str(self.path / name))
        new = {
            name: content.digest if isinstance(content, Copy) else hashlib.sha256(content).hexdigest()
            for name, content in files.items()
        }
        stale = {name for name in own - new.keys() if _fits(name, instead_of)}
        kept = {name for name in known.files if name in own - stale or not self._matches(name)}
        during = Manifest(known.files | new, known.files)
        after = Manifest({name: known.files[name] for name in kept} | new)
        with self._staged([*files.values(), _encoded(during), _encoded(after)]) as (staged, names):
            *ready, before_all, after_all = names
            # the manifest comes first: whatever ends this process in between, the next command knows old and new files
            os.rename(before_all, MANIFEST, src_dir_fd=staged, dst_dir_fd=self._root)
            for source, name in zip(ready, files, strict=True):
                with self._holder(name) as (holder, base):
                    os.rename(source, base, src_dir_fd=staged, dst_dir_fd=holder)
            for name in stale:
                with suppress(OSError), self._holder(name) as (holder, base):
                    os.unlink(base, dir_fd=holder)
            os.rename(after_all, MANIFEST, src_dir_fd=staged, dst_dir_fd=self._root)
        for folder in {_parts(name)[0] for name in stale} - {"", *self._folders}:
            with suppress(OSError):
                os.rmdir(folder, dir_fd=self._root)

    def read(self, pattern: str) -> dict[str, bytes]:
        """The own files that match ``pattern``, by their names."""
        found = {}
        known = self._manifest()
        for name in sorted(known.files):
            content = self._content(name) if _fits(name, [pattern]) and self._matches(name) else None
            if content is not None and known.holds(name, hashlib.sha256(content).hexdigest()):
                found[name] = content
        return found

    def _open(self) -> None:
        self._root = -1
        if self.path.is_symlink():
            target = os.path.realpath(self.path)
            raise WrongUse(f"'{self.path}' is a link; name the folder itself: --out '{target}'")
        try:
            self.path.mkdir(parents=True)
            self._is_new = True
        except FileExistsError:
            if not self.path.is_dir():
                raise NotADirectoryError(errno.ENOTDIR, "it is no folder") from None
        self._root = os.open(self.path, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW)

    def _lock(self) -> None:
        try:
            fcntl.flock(self._root, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            self._is_new = False
            raise WrongUse(f"another run writes to '{self.path}'; wait for its end, or choose another --out") from None
        except OSError:
            pass  # a file system without locks

    def _is_here(self) -> bool:
        """Whether the folder is still at its path."""
        with suppress(OSError):
            return os.path.samestat(os.fstat(self._root), os.lstat(self.path))
        return False

    def _check(self) -> None:
        """Raises ``WrongUse`` if a name that may be written is taken by something that no command wrote."""
        known = self._manifest()
        for entry in sorted(os.listdir(self._root)):
            kind = os.lstat(entry, dir_fd=self._root).st_mode
            if entry == MANIFEST or _fits(entry, self._names):
                self._refuse_foreign(entry, kind, known)
            elif entry in {_parts(name)[0] for name in self._names}:
                if not stat.S_ISDIR(kind):
                    what = "a link" if stat.S_ISLNK(kind) else "no folder"
                    raise WrongUse(f"'{self.path / entry}' is {what}; {_REMEDY}")
                with self._folder(entry) as folder:
                    for below in sorted(os.listdir(folder)):
                        if _fits(f"{entry}/{below}", self._names):
                            self._refuse_foreign(f"{entry}/{below}", os.lstat(below, dir_fd=folder).st_mode, known)

    def _refuse_foreign(self, name: str, kind: int, known: Manifest) -> None:
        place = f"'{self.path / name}'"
        if not stat.S_ISREG(kind):
            raise WrongUse(f"{place} is {'a link' if stat.S_ISLNK(kind) else 'no file'}; {_REMEDY}")
        if name == MANIFEST:
            if not known.files and self._content(MANIFEST) != _encoded(Manifest({})):
                raise WrongUse(f"{place} is no manifest of a run; {_REMEDY}")
        elif name not in known.files:
            raise WrongUse(f"{place} is there, and no run wrote it; {_REMEDY}")
        elif not known.holds(name, self._digest(name)):
            raise WrongUse(f"{place} was changed after a run wrote it; {_REMEDY}")

    def _probe(self) -> None:
        """Raises ``OSError`` if the folder, or one of those in it, takes no files."""
        with self._staged([b"\0"]):
            pass
        for name in {_parts(name)[0] for name in self._names} - {""}:
            with suppress(FileNotFoundError), self._folder(name) as folder:
                probe = _hidden()
                os.close(os.open(probe, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600, dir_fd=folder))
                os.unlink(probe, dir_fd=folder)

    def _manifest(self) -> Manifest:
        """The manifest; an empty one if there is none, or none that can be read."""
        content = self._content(MANIFEST, LARGEST_MANIFEST)
        with suppress(msgspec.DecodeError, RecursionError):
            return msgspec.json.decode(content, type=Manifest) if content is not None else Manifest({})
        return Manifest({})

    def _matches(self, name: str) -> bool:
        """May ``name`` be touched?"""
        parts = name.split("/")
        return len(parts) <= 2 and not {"", ".", ".."} & {*parts} and _fits(name, self._names)

    def _is_there(self, name: str) -> bool:
        with suppress(FileNotFoundError), self._holder(name) as (folder, base):
            os.lstat(base, dir_fd=folder)
            return True
        return False

    def _digest(self, name: str) -> str:
        content = self._content(name)
        return hashlib.sha256(content).hexdigest() if content is not None else ""

    def _content(self, name: str, most: int = -1) -> bytes | None:
        """What is in the file ``name``; None if it is no plain file, or cannot be read."""
        flags = os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK
        with (
            suppress(OSError),
            self._holder(name) as (folder, base),
            os.fdopen(os.open(base, flags, dir_fd=folder), "rb") as file,
        ):
            return file.read(most) if stat.S_ISREG(os.fstat(file.fileno()).st_mode) else None
        return None

    @contextmanager
    def _holder(self, name: str) -> Iterator[tuple[int, str]]:
        """The open folder that ``name`` is in, and its name there."""
        folder, base = _parts(name)
        if not folder:
            yield self._root, base
            return
        with self._folder(folder) as handle:
            yield handle, base

    @contextmanager
    def _folder(self, name: str) -> Iterator[int]:
        handle = os.open(name, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW, dir_fd=self._root)
        try:
            yield handle
        finally:
            os.close(handle)

    @contextmanager
    def _staged(self, contents: Sequence[bytes | Copy]) -> Iterator[tuple[int, list[str]]]:
        """A hidden folder with ``contents`` in files, and their names; it is removed in the end."""
        hidden = _hidden()
        os.mkdir(hidden, 0o700, dir_fd=self._root)
        names = [str(number) for number in range(len(contents))]
        try:
            with self._folder(hidden) as folder:
                try:
                    for name, content in zip(names, contents, strict=True):
                        handle = os.open(name, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o644, dir_fd=folder)
                        with os.fdopen(handle, "wb") as file:
                            file.write(content.content() if isinstance(content, Copy) else content)
                    yield folder, names
                finally:
                    for name in names:
                        with suppress(OSError):
                            os.unlink(name, dir_fd=folder)
        finally:
            with suppress(OSError):
                os.rmdir(hidden, dir_fd=self._root)


def _parts(name: str) -> tuple[str, str]:
    folder, _, base = name.rpartition("/")
    return folder, base


def _fits(name: str, patterns: Sequence[str]) -> bool:
    return any(fnmatch.fnmatchcase(name, p) and name.count("/") == p.count("/") for p in patterns)


def _hidden() -> str:
    return f".ucm-cts-{secrets.token_hex(8)}"


def _encoded(manifest: Manifest) -> bytes:
    return msgspec.json.format(msgspec.json.encode(manifest, order="sorted"), indent=1) + b"\n"


def _why(error: Exception) -> str:
    """What went wrong, in words."""
    return getattr(error, "strerror", None) or str(error)
