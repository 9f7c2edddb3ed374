"""Digests of everything that took part in a run: the adapter, the artefacts that are named, libraries and modules."""

from __future__ import annotations

import hashlib
import os
import shutil
import stat
from collections.abc import Iterable
from pathlib import Path

from ucm_cts.harness.catalogue.documents import without_waiting
from ucm_cts.harness.certificates.packages import packages_of
from ucm_cts.harness.certificates.verified import Subject
from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.results.foreign import one_line
from ucm_cts.harness.toolchains.commands.description import Task, ToolChain

_CHUNK = 1 << 20


def subjects_of(adapter_file: str, artifacts: Iterable[Path], loaded: Iterable[str]) -> tuple[Subject, ...]:
    """The adapter's file, the ``artifacts`` that the vendor names, and the files that hosts had ``loaded``, each once.

    Raises ``WrongUse`` for artefacts that cannot be read, and if nothing is there that a digest could be made of.
    """
    found: dict[str, Subject] = {}
    for path in artifacts:
        _add(found, "artifact", path, _digest(path))
    if adapter_file:
        _add(found, "adapter", Path(adapter_file), _digest(Path(adapter_file)))
    loaded = frozenset(loaded)
    modules = sorted(file for file in loaded if file.endswith(".py"))
    found |= {package.name: package for package in packages_of(adapter_file, modules)}
    for file in sorted(loaded.difference(modules)):
        try:
            _add(found, "library", Path(file), _digest(Path(file)))
        except WrongUse:
            continue  # it is gone; what can be read is told
    if not found:
        raise WrongUse(
            "nothing is here that a certificate could be of: the adapter is on another machine; name the product's files with --artifact"
        )
    return tuple(found.values())


def subjects_of_toolchain(toolchain: ToolChain, task: Task, artifacts: Iterable[Path]) -> tuple[Subject, ...]:
    """The description of ``toolchain``, the programs and files that its command for ``task`` names, their Python packages, and the
    ``artifacts`` that the vendor names. Raises ``WrongUse``.
    """
    found: dict[str, Subject] = {}
    for path in artifacts:
        _add(found, "artifact", path, _digest(path))
    description = Path(toolchain.folder) / toolchain.source
    _add(found, "description", description, _digest(description))
    described = toolchain.command_for(task)
    for word in described.command if described is not None else ():
        program = shutil.which(word) or os.path.join(toolchain.folder, word)
        if os.path.isfile(program):
            _add(found, "program", Path(program), _digest(Path(program)))
            found |= {package.name: package for package in packages_of(program)}
    return tuple(found.values())


def _add(found: dict[str, Subject], kind: str, path: Path, sha256: str) -> None:
    """Enter the file under its name; files with one name and other contents get a number."""
    if any(
        subject.sha256 == sha256 and subject.name.partition("/")[2] == one_line(path.name) for subject in found.values()
    ):
        return
    name, number = f"{kind}/{one_line(path.name)}", 1
    while name in found:
        number += 1
        name = f"{kind}/{one_line(path.name)} ({number})"
    found[name] = Subject(name, sha256)


def _digest(path: Path) -> str:
    """The SHA-256 of a file. Raises ``WrongUse``."""
    whole = hashlib.sha256()
    try:
        with open(path, "rb", opener=without_waiting) as stream:
            if not stat.S_ISREG(os.fstat(stream.fileno()).st_mode):
                raise WrongUse(f"'{path}' is no plain file; name the files of the product one by one")
            while chunk := stream.read(_CHUNK):
                whole.update(chunk)
    except (OSError, ValueError) as error:
        raise WrongUse(f"'{path}' cannot be read: {getattr(error, 'strerror', None) or error}") from None
    return whole.hexdigest()
