"""Which suite this is, and on what machine: the specification, digests of the installed files, versions of tools."""

from __future__ import annotations

import functools
import hashlib
import importlib.metadata
import platform
import shutil
import subprocess
from collections.abc import Iterable, Iterator
from pathlib import Path

import ucm_cts
from ucm_cts.harness.catalogue.specification import load_specification
from ucm_cts.harness.certificates.contents import Machine
from ucm_cts.harness.results.foreign import one_line

_ROOT = Path(ucm_cts.__file__).parent
_ROOMS = (
    *("catalogue", "models", "purposes", "results", "hosting", "statement"),
    *("execution", "exploring", "toolchains", "certificates"),
)
"""The rooms of the harness that make scenarios, run, record, judge and verify: those down to ``certificates``, but for ``history``."""
_DERIVING = ("json_report.py", "order.py", "scope.py", "report.schema.json")
"""What derives ``report.json``; the rest of that room writes pages."""
_JUDGING = (
    *("suite", "reference_models", "adapters/contract", "adapters/sdk/python"),
    *(f"harness/{room}" for room in _ROOMS),
    *(f"harness/report/{name}" for name in _DERIVING),
)
_CATALOGUE = (
    "suite/specification.yaml",
    "suite/requirements",
    "suite/interpretations",
    "suite/capabilities.yaml",
    "suite/life_cycle.yaml",
)
_OURS = (".py", ".yaml", ".json", ".xml", ".xsd", ".lark")
"""Code and data. Templates and stylesheets write text for people."""
_SECONDS = 10


@functools.cache
def specification() -> str:
    """The specification that the catalogue was made of: its name, and the beginning of the digest of its text."""
    known = load_specification()
    return f"{known.name}, text {known.sha256[:12]}"


@functools.cache
def suite_digest() -> str:
    """The digest of all installed files that can change a verdict; compiled parts differ and are not among them.

    Command line, pages, publishing, history, self-tests and bench are left out: a new stylesheet makes no new suite.
    """
    return _digest_of(_JUDGING)


@functools.cache
def bundled_digest() -> str:
    """The digest of the same files and of all bundled frameworks, mutants and variants, with what tries them out."""
    return _digest_of(dict.fromkeys((*_JUDGING, "adapters", "harness/selftest")))


def suite_files() -> tuple[Path, ...]:
    """The files that ``suite_digest`` is made of, in their order."""
    return tuple(_files_of(_JUDGING))


@functools.cache
def catalogue_digest() -> str:
    """The digest of the requirements, the readings and the life-cycle table."""
    return _digest_of(_CATALOGUE)


def _digest_of(places: Iterable[str]) -> str:
    whole = hashlib.sha256()
    for file in _files_of(places):
        content = file.read_bytes()
        whole.update(f"{file.relative_to(_ROOT).as_posix()}\0{len(content)}\0".encode())
        whole.update(content)
    return whole.hexdigest()


def _files_of(places: Iterable[str]) -> Iterator[Path]:
    for place in places:
        start = _ROOT / place
        yield from [start] if start.is_file() else sorted(p for p in start.rglob("*") if p.suffix in _OURS)


@functools.cache
def machine() -> Machine:
    """This machine, and the versions of the tools on it."""
    return Machine(
        system=one_line(f"{_distribution()} {platform.system()} {platform.release()}".strip()),
        processor=one_line(f"{_processor()} {platform.machine()}".strip()),
        python=one_line(f"{platform.python_implementation()} {platform.python_version()}"),
        compiler=_said_by("g++", "--version"),
        omniidl=_said_by("omniidl", "-V"),
        libclang=_version_of("libclang"),
    )


def _distribution() -> str:
    try:
        return platform.freedesktop_os_release().get("PRETTY_NAME", "")
    except OSError:
        return ""


def _processor() -> str:
    try:
        with open("/proc/cpuinfo", encoding="utf-8", errors="replace") as file:
            return next((line.partition(":")[2].strip() for line in file if line.startswith("model name")), "")
    except OSError:
        return ""


def _version_of(package: str) -> str:
    try:
        return importlib.metadata.version(package)
    except importlib.metadata.PackageNotFoundError:
        return ""


def _said_by(program: str, option: str) -> str:
    """The first line that ``program`` prints about itself; empty if it is not there."""
    path = shutil.which(program)
    if path is None:
        return ""
    try:
        ended = subprocess.run(
            [path, option], check=False, capture_output=True, timeout=_SECONDS, stdin=subprocess.DEVNULL
        )
    except (OSError, subprocess.SubprocessError):
        return ""
    text = (ended.stdout or ended.stderr).decode(errors="replace").strip()
    return one_line(text.splitlines()[0], 120) if text else ""
