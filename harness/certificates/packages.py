"""Which Python code an adapter brings along: found by its import statements, without running any of it."""

from __future__ import annotations

import ast
import functools
import hashlib
import importlib.machinery
import importlib.metadata
import itertools
import os
import re
import sys
import sysconfig
from collections.abc import Iterable, Iterator
from pathlib import Path

import ucm_cts
from ucm_cts.harness.certificates.verified import Subject
from ucm_cts.harness.results.foreign import one_line

_OURS = Path(ucm_cts.__file__).parent
_SUITE = ("harness", "suite", "reference_models", "adapters.contract", "adapters.sdk")
"""What the digest of the suite has; it is no part of a product."""

_INSTALLED = ("site-packages", "dist-packages")
_DEPTH = 4
"""How many parts the name of a bundled adapter's package has, as ``ucm_cts.adapters.reference.python``."""

_CODE = (".py", ".so", ".pyd")
MOST_FILES = 20_000


def packages_of(adapter_file: str, loaded: Iterable[str] = ()) -> tuple[Subject, ...]:
    """A digest of each Python package, or module, that the adapter in ``adapter_file`` imports, and of its own.

    Packages that those need are found by what their distributions require. ``loaded``: the files of further modules, whose packages are
    added. Python's own library is not among them.
    """
    places = _imported_places(adapter_file)
    for file in map(Path, loaded):
        place = _package_around(file)
        if place is None or any(known in (file, *file.parents) for known in places.values()):
            continue
        base = place.stem if place.is_file() else place.name
        name = base
        for number in itertools.count(2):
            if name not in places:
                break
            name = f"{base} ({number})"
        places[name] = place
    return tuple(Subject(f"package/{one_line(name)}", _digest_of(place)) for name, place in sorted(places.items()))


def _package_around(file: Path) -> Path | None:
    """The outermost package that has the module in ``file``, or ``file``; None if it is of Python's own library or of the suite."""
    if not file.is_file():
        return None
    for library in {Path(sysconfig.get_path(name)) for name in ("stdlib", "platstdlib")}:
        if file.is_relative_to(library) and file.relative_to(library).parts[0] not in _INSTALLED:
            return None
    if file.is_relative_to(_OURS):
        parts = file.relative_to(_OURS.parent).with_suffix("").parts
        bundled = _package_in(".".join(parts)) if parts[-1] != "__init__" or len(parts) > _DEPTH else ""
        return _place_of(bundled, file.parent) if bundled else None
    place = file
    while (place.parent / "__init__.py").is_file():
        place = place.parent
    return place


def _imported_places(adapter_file: str) -> dict[str, Path]:
    """The packages that the adapter imports by statements, each with its place."""
    places: dict[str, Path] = {}
    if not os.path.isfile(adapter_file) or not (adapter_file.endswith(".py") or _is_script(Path(adapter_file))):
        return places
    own = _own(Path(adapter_file))
    places[own.stem if own.is_file() else own.name] = own
    waiting = list(_imported(own))
    seen: set[str] = set()
    while waiting:
        name = waiting.pop()
        if name in seen:
            continue
        seen.add(name)
        place = _place_of(name, Path(adapter_file).parent)
        if place is None or own in (place, *place.parents):
            continue
        places.setdefault(name, place)
        waiting += _needed_by(name)
    return places


def _is_script(file: Path) -> bool:
    """Is it a program in Python, as installers write them?"""
    try:
        with open(file, "rb") as stream:
            return re.match(rb"#!.*\bpython", stream.readline(300)) is not None
    except OSError:
        return False


def _own(file: Path) -> Path:
    """The package that has the adapter, or the adapter's file."""
    return file.parent if (file.parent / "__init__.py").is_file() else file


def _imported(place: Path) -> Iterator[str]:
    """The packages that the code at ``place`` imports: top-level names, and folders of bundled adapters."""
    for file in _files(place):
        if file.suffix != ".py" and file != place:
            continue
        try:
            tree = ast.parse(file.read_bytes())
        except (OSError, ValueError, SyntaxError, RecursionError):
            continue
        for node in ast.walk(tree):
            names = [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
            if isinstance(node, ast.ImportFrom) and node.module and not node.level:
                names = [node.module]
            yield from filter(None, map(_package_in, names))


def _package_in(name: str) -> str:
    top, _, rest = name.partition(".")
    if top != "ucm_cts":
        return top
    if not rest.startswith("adapters.") or rest.startswith(_SUITE):
        return ""
    return ".".join(name.split(".")[:_DEPTH])


def _place_of(name: str, beside: Path) -> Path | None:
    """The folder or file of the package ``name``; None for Python's own, and for what is not there."""
    if name.startswith("ucm_cts."):
        place = _OURS.joinpath(*name.split(".")[1:])
        return place if place.is_dir() else place.with_suffix(".py") if place.with_suffix(".py").is_file() else None
    if name in sys.stdlib_module_names:
        return None
    spec = importlib.machinery.PathFinder.find_spec(name, [str(beside), os.getcwd(), *sys.path])
    if spec is None:
        return None
    if spec.submodule_search_locations:
        return Path(next(iter(spec.submodule_search_locations)))
    return Path(spec.origin) if spec.origin and os.path.isfile(spec.origin) else None


def _needed_by(name: str) -> Iterator[str]:
    """The packages of the distributions that the one of the package ``name`` requires in any case."""
    if "." in name:
        return
    owners = _distributions().get(name, ())
    for owner in owners:
        for line in importlib.metadata.requires(owner) or ():
            required = re.match(r"[A-Za-z0-9._-]+", line)
            if required and "extra ==" not in line:
                known = required[0].lower().replace("_", "-")
                yield from (
                    top
                    for top, them in _distributions().items()
                    if known in (o.lower().replace("_", "-") for o in them)
                )


@functools.cache
def _distributions() -> dict[str, list[str]]:
    """The distributions of each top-level package that is installed."""
    return {top: list(owners) for top, owners in importlib.metadata.packages_distributions().items()}


def _digest_of(place: Path) -> str:
    """The digest of the names and contents of all code at ``place``."""
    whole = hashlib.sha256()
    for file in _files(place):
        try:
            content = file.read_bytes()
        except OSError:
            continue
        name = file.relative_to(place).as_posix() if place.is_dir() else file.name
        whole.update(f"{name}\0{len(content)}\0".encode(errors="surrogateescape"))
        whole.update(content)
    return whole.hexdigest()


def _files(place: Path) -> list[Path]:
    if place.is_file():
        return [place]
    return sorted(p for p in place.rglob("*") if p.suffix in _CODE and p.is_file())[:MOST_FILES]
