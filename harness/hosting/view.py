"""What a sandbox sees of the file system: all of it, read-only, but for hidden places and for a scratch folder.

Home folders, temporary folders, ``/run``, the harness, and reports are hidden. What a host needs to be loaded is shown again: its own
folder, the current folder, Python's search path and installation, and what variables such as ``PATH`` name.
"""

from __future__ import annotations

import importlib.metadata
import json
import os
import pwd
import re
import sys
import tempfile
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import cache
from pathlib import Path
from urllib.parse import unquote, urlsplit

MANIFEST = "ucm-cts-manifest.json"
"""The file that each folder with a report has."""

_OF_THE_HARNESS = ("harness", "suite", "reference_models")
_SECRET_FILES = ("/etc/shadow", "/etc/gshadow", "/etc/shadow-", "/etc/gshadow-", "/etc/sudoers")
_SECRET_FOLDERS = ("/etc/ssl/private", "/etc/sudoers.d", "/var/lib/docker", "/var/spool/cron")
_OF_RUN = ("/run/systemd/resolve", "/run/current-system", "/run/opengl-driver", "/run/wrappers")
_OF_HOME = (
    *(".local/lib", ".local/bin", ".local/share/uv/python", ".m2/repository", ".gradle/caches", ".jdks"),
    *(".sdkman/candidates", ".julia", ".juliaup", ".cargo/bin", ".rustup/toolchains", ".cache/gstreamer-1.0"),
)
"""What run-time systems keep in a home folder and cannot do without."""

_PROJECT_FILES = frozenset(
    (
        *(".git", ".hg", ".svn", "pyproject.toml", "setup.py", "CMakeLists.txt", "meson.build", "Makefile", "pom.xml"),
        *("build.gradle", "build.gradle.kts", "Cargo.toml", "Project.toml", "package.json", "go.mod"),
    )
)
"""What the folder of a project has, which may use anything else in it."""

_NAMES_PLACES = re.compile(r"PATH$|_HOME$|_DIRS?$|_PREFIX$|_ROOT$|^(LD_PRELOAD|VIRTUAL_ENV|JULIA_PROJECT)$")
_NAMES_NONE = re.compile(r"^(TMPDIR|XDG_RUNTIME_DIR|GNUPG.*|SSH_.*|PYTEST_.*|KUBE.*|DOCKER_.*)$")
_SECRET_NAMES = re.compile(
    r"TOKEN|SECRET|PASSW|CREDENTIAL|PRIVATE_KEY|^SSH_|^GPG_|^DBUS_|^PYTEST_|^SUDO_|^HYPOTHESIS_|^_$"
)
_ABSENT = re.compile(
    r"No such file|cannot open|not found|Permission denied|Read-only file system|Operation not permitted", re.IGNORECASE
)
_PATH_IN_TEXT = re.compile(r"/[^\s'\":;,()]+")

_MOST_ENTRIES = 500
"""A current folder with more entries is shown as it is, and nothing can be written there."""

_MOST_LINKS = 40


@dataclass(frozen=True)
class View:
    """What one sandbox sees. ``mounts`` are arguments of bwrap, ``hidden`` the places that are empty in it."""

    mounts: tuple[str, ...]
    hidden: tuple[str, ...]
    shown: tuple[str, ...]

    def writing(self, folder: str | Path) -> View:
        """The same, and what is written in ``folder`` stays."""
        real = os.path.realpath(folder)
        return replace(self, mounts=(*self.mounts, "--bind", real, real), shown=(*self.shown, real))

    def without_network(self) -> View:
        """The same, and no network."""
        return replace(self, mounts=("--unshare-net", *self.mounts))

    def hides(self, path: str) -> bool:
        """Whether ``path``, which is there outside, is not there inside."""
        real = os.path.realpath(path)
        within = max((len(place) for place in self.hidden if is_below(real, place)), default=0)
        again = max((len(place) for place in self.shown if is_below(real, place)), default=0)
        return within > again

    def hint(self, text: str) -> str:
        """Why the sandbox may be the reason for what ``text`` says; empty if nothing says so."""
        if "bwrap: " in text:
            return "bubblewrap could not make the sandbox; --no-sandbox does without"
        paths = dict.fromkeys(found.rstrip(".") for found in _PATH_IN_TEXT.findall(text))
        missed = [path for path in paths if os.path.lexists(path) and self.hides(path)]
        if missed:
            return f"the sandbox hides {', '.join(missed[:3])} from the adapter; {REMEDY}"
        if _ABSENT.search(text):
            return f"the adapter ran in a sandbox, where {', '.join(self.hidden[:4])} and others are empty and most else is read-only; {REMEDY}"
        return ""


REMEDY = "move it beside the adapter, name its folder in PATH, PYTHONPATH or LD_LIBRARY_PATH, or use --no-sandbox"


@dataclass
class _Mounts:
    """Mounts by the place where they appear; made in the order of depth, so that inner ones lie upon outer ones."""

    made: dict[str, tuple[str, ...]] = field(default_factory=dict)

    def empty(self, place: str, mebibytes: int) -> None:
        self.made[place] = ("--size", str(mebibytes << 20), "--tmpfs", place)

    def show(self, place: str) -> None:
        self.made.setdefault(place, ("--ro-bind-try", place, place))

    def blank(self, file: str) -> None:
        self.made[file] = ("--ro-bind", os.devnull, file)

    def link(self, place: str, target: str) -> None:
        self.made.setdefault(place, ("--symlink", target, place))

    def arguments(self) -> Iterator[str]:
        for place in sorted(self.made, key=lambda one: (one.count("/"), one)):
            yield from self.made[place]


def view_of(
    needed: Iterable[str | Path],
    *,
    hidden: Iterable[str | Path] = (),
    folder: str | Path | None = None,
    mebibytes: int = 1024,
) -> View:
    """The view of a host.

    ``needed``: files and folders that it cannot do without, such as the adapter's.
    ``hidden``: what it must not see besides, such as the folder of the report.
    ``folder``: its current folder, where it can write, and nothing stays; the current one of this process if None.
    ``mebibytes``: how much it may write in temporary folders.
    """
    here = os.path.realpath(folder or os.getcwd())
    places = _hidden_places()
    mounts = _Mounts()
    for place in places:
        mounts.empty(place, mebibytes)
    wanted = _Wanted(places)
    for path in needed:
        wanted.add(path, _project_of)
    wanted.add(here, _marked_project_of)
    for path in (*_of_python(), *_of_environment(os.environ), *_of_homes(places)):
        wanted.add(path)
    unseen = {os.path.realpath(path) for path in (*hidden, *_reports_in(here))}
    if here in unseen:
        unseen = {*unseen, *_files_of_a_report(here)} - {here}
    for link in _overlay(here, mounts, unseen, places) if here != "/" else ():
        wanted.add(link)
    wanted.mount(mounts, here)
    covered: list[str] = []
    for real in (*unseen, *_of_the_harness(), *_SECRET_FOLDERS):
        if os.path.isdir(real) and not any(is_below(path, real) for path in (*wanted.all, here)):
            mounts.empty(real, 1)
            covered.append(real)
        elif os.path.isfile(real):
            mounts.blank(real)
    for file in map(os.path.realpath, _SECRET_FILES):
        if os.access(file, os.R_OK):
            mounts.blank(file)
    return View(tuple(mounts.arguments()), (*places, *covered), tuple(sorted({*wanted.shown, here})))


class _Wanted:
    """What must be seen although it lies in a hidden place."""

    def __init__(self, places: tuple[str, ...]) -> None:
        self._places = places
        self._links: dict[str, str] = {}
        self.all: set[str] = set()
        self.shown: set[str] = set()

    def add(self, path: str | Path, whole: Callable[[str, str], str] = lambda real, _: real) -> None:
        """Show ``path``, and the ``whole`` that it is part of; that gets the real path and the hidden place around it."""
        real = _followed(os.path.abspath(path), self._places, self._links)
        above = _innermost(real, self._places)
        self.all.add(real)
        if above is not None and os.path.exists(real):
            self.shown.add(whole(real, above))

    def mount(self, mounts: _Mounts, here: str) -> None:
        """Add all of it to ``mounts``. Links in the current folder ``here``, and in what is shown, are there already."""
        for real in sorted(self.shown):
            mounts.show(real)
        for link, target in self._links.items():
            if os.path.dirname(link) != here and not any(is_below(link, real) for real in self.shown):
                mounts.link(link, target)


def _project_of(real: str, above: str) -> str:
    """The project that ``real`` belongs to; if nothing says which that is, the folder on the top level of ``above``."""
    marked = _marked_project_of(real, above)
    if marked != real:
        return marked
    top = real[len(above) :].lstrip("/").partition("/")[0]
    return real if top.startswith(".") else os.path.join(above, top)


def _marked_project_of(real: str, above: str) -> str:
    """The outermost folder around ``real``, within the hidden place ``above``, that is a project; ``real`` if none is."""
    found, folder = real, real
    while folder != above and is_below(folder, above):
        with suppress(OSError):
            if _PROJECT_FILES.intersection(os.listdir(folder)):
                found = folder
        folder = os.path.dirname(folder)
    return found


def clean_environment(given: Mapping[str, str]) -> dict[str, str]:
    """``given`` without what names a secret or tells of the harness."""
    return {name: value for name, value in given.items() if not _SECRET_NAMES.search(name)}


def is_below(path: str, place: str) -> bool:
    """Whether ``path`` is ``place`` or lies in it."""
    return path == place or path.startswith(place.rstrip("/") + "/")


def _overlay(here: str, mounts: _Mounts, unseen: set[str], places: tuple[str, ...]) -> Iterator[str]:
    """Let everything in the folder ``here`` be seen, and other files be written, which nobody keeps.

    Yields the links in it. Hidden entries of a home folder stay hidden.
    """
    try:
        entries = list(os.scandir(here))
    except OSError:
        return
    if len(entries) > _MOST_ENTRIES:
        mounts.show(here)
        return
    mounts.empty(here, 256)
    for entry in entries:
        is_private = here in places and entry.name.startswith(".")
        if entry.path in unseen or is_private or entry.path in mounts.made:
            continue
        if entry.is_symlink():
            with suppress(OSError):
                mounts.link(entry.path, os.readlink(entry.path))
                yield entry.path
        else:
            mounts.show(entry.path)


def _reports_in(folder: str) -> Iterator[str]:
    """The folders with reports in ``folder`` and in its folder ``reports``; the files of a report in ``folder`` itself."""
    if os.path.isfile(os.path.join(folder, MANIFEST)):
        yield from _files_of_a_report(folder)
    for place in (folder, os.path.join(folder, "reports")):
        with suppress(OSError):
            for entry in os.scandir(place):
                if entry.is_dir() and os.path.isfile(os.path.join(entry.path, MANIFEST)):
                    yield entry.path


def _files_of_a_report(folder: str) -> Iterator[str]:
    for name in (MANIFEST, "report.json", "report.html", "junit.xml", "failures", "runs"):
        yield os.path.join(folder, name)


@cache
def _hidden_places() -> tuple[str, ...]:
    homes = {os.path.expanduser("~"), "/root", "/home"}
    with suppress(KeyError):
        homes.add(pwd.getpwuid(os.getuid()).pw_dir)
    wanted = {*homes, "/tmp", "/var/tmp", tempfile.gettempdir(), "/run"}
    real = {os.path.realpath(place) for place in wanted}
    return tuple(sorted(place for place in real if os.path.isdir(place) and place.strip("/") not in _NEVER_HIDDEN))


_NEVER_HIDDEN = frozenset(("", "usr", "bin", "lib", "etc", "proc", "dev", "sys", "opt", "var"))


def _innermost(path: str, places: Iterable[str]) -> str | None:
    """The innermost of ``places`` that ``path`` lies in, but is not itself."""
    return max((place for place in places if path != place and is_below(path, place)), key=len, default=None)


def _followed(path: str, places: tuple[str, ...], links: dict[str, str]) -> str:
    """``path`` without links. Those that lie in hidden ``places`` are added to ``links``: they must be there, too."""
    done = "/"
    waiting = path.split("/")[::-1]
    followed = 0
    while waiting:
        part = waiting.pop()
        if part in ("", "."):
            continue
        if part == "..":
            done = os.path.dirname(done)
            continue
        one = os.path.join(done, part)
        try:
            target = os.readlink(one)
        except OSError:
            done = one
            continue
        followed += 1
        if followed > _MOST_LINKS:
            return path
        if _innermost(one, places) is not None:
            links[one] = target
        waiting += target.split("/")[::-1]
        if target.startswith("/"):
            done = "/"
    return done


def _of_python() -> Iterator[str]:
    yield from (sys.prefix, sys.base_prefix, sys.exec_prefix, sys.base_exec_prefix)
    yield sys.executable
    yield from filter(None, sys.path)
    yield from _editable()


@cache
def _editable() -> tuple[str, ...]:
    """The folders of projects that were installed to be edited."""
    found = []
    for distribution in importlib.metadata.distributions():
        with suppress(OSError, ValueError, AttributeError, TypeError):
            said = json.loads(distribution.read_text("direct_url.json") or "{}")
            place = urlsplit(said.get("url", ""))
            if said.get("dir_info", {}).get("editable") and place.scheme == "file":
                found.append(unquote(place.path))
    return tuple(found)


def _of_environment(environment: Mapping[str, str]) -> Iterator[str]:
    for name, value in environment.items():
        if _NAMES_PLACES.search(name) and not _NAMES_NONE.search(name) and not _SECRET_NAMES.search(name):
            for place in filter(None, value.split(os.pathsep)):
                yield place
                prefix, folder = os.path.split(place.rstrip("/"))
                if folder in ("bin", "sbin") and not os.path.basename(prefix).startswith("."):
                    yield prefix  # what is installed beside its programs; a place that is hidden itself stays hidden


def _of_homes(places: tuple[str, ...]) -> Iterator[str]:
    yield from _OF_RUN
    home = os.path.realpath(os.path.expanduser("~"))
    if home in places:
        yield from (os.path.join(home, name) for name in _OF_HOME)


def _of_the_harness() -> Iterator[str]:
    """The folders of this package that no adapter needs."""
    package = Path(__file__).resolve().parents[2]
    yield from (str(package / name) for name in _OF_THE_HARNESS if (package / name).is_dir())
