"""Which Python code an adapter brings along: found by its import statements, without running any of it."""

from __future__ import annotations

import ast
import functools
import hashlib
import importlib.machinery
import importlib.metadata
import os
import re
import sys
from collections.abc import Iterator
from pathlib import Path

import ucm_cts
from ucm_cts.harness.certificates.verified import Subject
from ucm_cts.harness.results.foreign import one_line

_OURS = Path(ucm_cts.__file__).parent
_SUITE = ("harness", "suite", "reference_models", "adapters.contract", "adapters.sdk")
"""What the digest of the suite has; it is no part of a product."""

_CODE = (".py", ".so", ".pyd")
MOST_FILES = 20_000


def packages_of(adapter_file: str) -> tuple[Subject, ...]:
    """A digest of each Python package, or module, that the adapter in ``adapter_file`` imports, and of its own.

    Packages that those need are found by what their distributions require. Python's own library is not among them.
    """
    if not os.path.isfile(adapter_file) or not (adapter_file.endswith(".py") or _is_script(Path(adapter_file))):
        return ()
    places: dict[str, Path] = {}
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
    return tuple(Subject(f"package/{one_line(name)}", _digest_of(place)) for name, place in sorted(places.items()))


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
    return ".".join(name.split(".")[:4])


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
