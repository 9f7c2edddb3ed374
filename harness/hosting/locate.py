"""From the text that names an adapter to the endpoint behind which it is found.

Nothing is imported here but what is bundled: what a package publishes under a short name is known from its metadata or, if that
is not enough, from a process in a sandbox (``published_names``). An adapter that breaks when it is loaded breaks a host.
"""

from __future__ import annotations

import difflib
import importlib.machinery
import importlib.util
import os
import sys
from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from importlib.metadata import EntryPoint, entry_points
from pathlib import Path
from typing import Literal
from urllib.parse import urlsplit

from ucm_cts.adapters.sdk.python.loading import current_name
from ucm_cts.harness.hosting.compiled_parts import COMPILED, HOW_TO_COMPILE
from ucm_cts.harness.hosting.published_names import Meaning, NoMeaning, meaning_of
from ucm_cts.harness.hosting.virtual_time import why_not

GROUP = "ucm_cts.adapters"
"""The entry point group in which packages publish short names of adapters."""

STATEMENTS = "ucm_cts.statements"
"""The entry point group in which they publish paths of their vendors' statements, under the same names."""

FORMS = "a short name, package.module:Class, package.module, a path, tcp://HOST:PORT or unix:/PATH"

LONGEST_SOCKET = 107
"""The bytes that the system takes for the path of a socket."""

EndpointKind = Literal["python", "executable", "tcp", "unix"]


class WrongUse(Exception):
    """A wrong request of the user; the message says what is wrong and what to try."""


@dataclass(frozen=True)
class Endpoint:
    """Where an adapter is found.

    ``text``: as the user wrote it.
    ``kind``: how it is reached.
    ``target``: ``python``: a class, a module with ``answer``, or the path of an extension module; ``executable``: an absolute path;
    ``tcp``: ``HOST:PORT``; ``unix``: a path.
    ``in_process``: load it into the harness process, for debuggers.
    ``sandbox``: start it in a sandbox, where there are sandboxes.
    ``hidden``: files and folders that it must not see there.
    ``virtual_time``: serve it in virtual time, in which waits take no time; for Python adapters and executables.
    """

    text: str
    kind: EndpointKind
    target: str
    in_process: bool = False
    sandbox: bool = True
    hidden: tuple[str, ...] = ()
    virtual_time: bool = False


def published_statement(text: str, sandbox: bool = True) -> Path | None:
    """The statement that goes with the short name ``text``, if one is published. Raises ``WrongUse``."""
    entry = _published(STATEMENTS).get(text)
    if entry is None:
        return None
    meaning = _meaning_of(entry, sandbox)
    if meaning.path is None:
        raise WrongUse(f"'{entry.value}' is to be the path of a statement, and is a {meaning.type}")
    return Path(meaning.path)


def locate(
    text: str,
    in_process: bool = False,
    *,
    sandbox: bool = True,
    hidden: Iterable[str | Path] = (),
    virtual_time: bool = False,
) -> Endpoint:
    """The endpoint that ``text`` names. Raises ``WrongUse``."""
    published = _published(GROUP)
    if not text:
        raise WrongUse(
            f"no ADAPTER is named: which framework is meant? {_what_there_is(text, published)}. "
            "docs/adapter-python.md, adapter-cpp.md and adapter-java.md say how to write one for your framework"
        )
    endpoint = _follow(published[text], sandbox) if text in published else _parse(text, published)
    if in_process and endpoint.kind != "python":
        raise WrongUse(
            f"'{text}' cannot run in the harness process: that takes a Python adapter or an extension module"
        )
    if virtual_time and (problem := why_not(endpoint.kind, endpoint.target, in_process)):
        raise WrongUse(f"'{text}' cannot run in virtual time: {problem}")
    places = tuple(map(str, hidden))
    return replace(
        endpoint, text=text, in_process=in_process, sandbox=sandbox, hidden=places, virtual_time=virtual_time
    )


def namesakes(endpoint: Endpoint, file: str) -> Iterator[str]:
    """Other files on the search path that would be loaded for ``endpoint`` if ``file`` were not there.

    The current directory comes before ``PYTHONPATH``, so that a file there may be loaded by mistake.
    """
    if endpoint.kind != "python" or os.sep in endpoint.target or not file:
        return
    top = endpoint.target.partition(":")[0].partition(".")[0]
    if top == __name__.partition(".")[0]:
        return
    seen = {os.path.realpath(file)}
    for place in dict.fromkeys([os.getcwd(), *sys.path]):
        spec = importlib.machinery.PathFinder.find_spec(top, [place or os.getcwd()])
        found = os.path.realpath(spec.origin) if spec is not None and spec.origin else ""
        package = os.path.dirname(found)
        is_ours = found in seen or (
            os.path.basename(found).startswith("__init__.") and file.startswith(package + os.sep)
        )
        if found and os.path.isfile(found) and not is_ours:
            seen.add(found)
            yield found


def file_named(endpoint: Endpoint) -> str:
    """The file that ``endpoint`` names, which hosts load; of a module that is not there before it is loaded, its package's.

    Nothing is loaded for it, and a product is not asked, which could name the file of another. Empty for an address.
    """
    if endpoint.kind not in ("python", "executable"):
        return ""
    if os.path.isabs(endpoint.target):
        return endpoint.target
    package, *modules = endpoint.target.partition(":")[0].split(".")
    file, spec = "", _spec_of(package)
    while spec is not None:
        file = spec.origin if spec.origin and os.path.isfile(spec.origin) else file
        inside = list(spec.submodule_search_locations or ())
        spec = importlib.machinery.PathFinder.find_spec(modules.pop(0), inside) if modules else None
    return file


def _published(group: str) -> dict[str, EntryPoint]:
    published: dict[str, EntryPoint] = {}
    for entry in entry_points(group=group):
        known = published.setdefault(entry.name, entry)
        if known.value != entry.value:
            raise WrongUse(f"'{entry.name}' is published twice, as {known.value} and as {entry.value}; uninstall one")
    return published


def _follow(entry: EntryPoint, sandbox: bool) -> Endpoint:
    """Classes and modules are loaded by the host; for other texts the file system decides which endpoint they name."""
    if not entry.attr:
        return Endpoint(entry.name, "python", entry.value)
    path = _meaning_of(entry, sandbox).path
    if path is not None:
        return _parse(path, {})
    return Endpoint(entry.name, "python", f"{entry.module}:{entry.attr}")


def _meaning_of(entry: EntryPoint, sandbox: bool) -> Meaning:
    try:
        return meaning_of(entry.module, entry.attr, sandbox)
    except NoMeaning as problem:
        raise WrongUse(f"'{entry.name}' stands for {entry.value}, which fails: {problem}") from None


def _parse(text: str, published: Mapping[str, EntryPoint]) -> Endpoint:
    if text.startswith("tcp:"):
        return Endpoint(text, "tcp", _address(text))
    if text.startswith("unix:"):
        if not text.removeprefix("unix:"):
            raise WrongUse(f"'{text}' names no socket; write unix:/PATH")
        socket = os.path.abspath(text.removeprefix("unix:"))
        if len(os.fsencode(socket)) > LONGEST_SOCKET:
            raise WrongUse(f"the path of a socket has at most {LONGEST_SOCKET} bytes; choose another for '{text}'")
        return Endpoint(text, "unix", socket)
    path = Path(text)
    if os.sep in text or os.path.isfile(path):
        return _parse_path(text, path)
    module, colon, name = text.partition(":")
    if not all(part.isidentifier() for part in module.split(".")) or (colon and not name.isidentifier()):
        raise WrongUse(f"'{text}' names no adapter. {_what_there_is(text, published)}")
    if not _is_there(module.partition(".")[0]):
        missing = f": there is no module {module.partition('.')[0]}" if colon or "." in module else ""
        raise WrongUse(f"'{text}' names no adapter{missing}. {_what_there_is(text, published)}")
    return Endpoint(text, "python", current_name(text))


def _address(text: str) -> str:
    try:
        place = urlsplit(text)
        host, port = place.hostname, place.port
    except ValueError:
        host = port = None
    if not host or not port:
        raise WrongUse(f"'{text}' is no address; write tcp://HOST:PORT, for instance tcp://127.0.0.1:4000")
    return f"{host}:{port}"


def _parse_path(text: str, path: Path) -> Endpoint:
    if path.parent == COMPILED and not os.path.isfile(path):
        raise WrongUse(f"'{path.name}' is a compiled part of ucm-cts, and this installation has none: {HOW_TO_COMPILE}")
    if not os.path.isfile(path):  # also of a name that is too long to ask for
        raise WrongUse(
            f"there is no file '{text}'" if not os.path.exists(path) else f"'{text}' is no file; name the adapter in it"
        )
    if path.suffix in (".so", ".pyd"):
        return Endpoint(text, "python", str(path.resolve()))
    if path.suffix == ".py":
        raise WrongUse(f"'{text}' is a Python file; name the adapter's class: {path.stem}:Class")
    if not os.access(path, os.X_OK):
        raise WrongUse(f"'{text}' is not executable; an adapter is an executable or an extension module (.so)")
    return Endpoint(text, "executable", str(path.resolve()))


def _is_there(module: str) -> bool:
    return _spec_of(module) is not None or module in sys.modules


def _spec_of(package: str) -> importlib.machinery.ModuleSpec | None:
    """Where the top-level ``package`` is found, also that of an editable installation."""
    found = importlib.machinery.PathFinder.find_spec(package, [os.getcwd(), *sys.path])
    with suppress(ValueError, ImportError):
        found = found or importlib.util.find_spec(package)
    return found


def _what_there_is(text: str, published: Mapping[str, EntryPoint]) -> str:
    close = difflib.get_close_matches(text, published, 1)
    hint = f"Did you mean '{close[0]}'? " if close else ""
    names = ", ".join(sorted(published)) or "none: is ucm-cts installed in this environment?"
    return f"{hint}An adapter is {FORMS}. Short names here: {names}"
