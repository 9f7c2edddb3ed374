"""Imports between rooms and between modules go one way, as docs/design.md says; imports for types only count as well."""

from __future__ import annotations

import ast
import functools
import re
from collections.abc import Mapping
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest
from files import ROOT

import ucm_cts

PACKAGE = Path(ucm_cts.__file__).parent
ALLOWED = {
    "adapters": ("adapters",),
    "reference_models": ("reference_models", "adapters.contract"),
    "suite": (),
    "harness": ("harness", "suite", "reference_models", "adapters", "ucm_cts"),
}
IMPURE = {"os", "sys", "time", "threading", "subprocess", "socket", "pathlib", "random", "io", "asyncio", "datetime"}


def module_of(path: Path) -> str:
    return ".".join(path.relative_to(PACKAGE).with_suffix("").parts).removesuffix(".__init__")


def imported(path: Path, modules: Mapping[str, Path]) -> frozenset[str]:
    """What ``path`` imports anywhere in it; modules of ours without ``ucm_cts.``.

    ``from package import module`` imports the package, whose ``__init__`` runs, and the module.
    """
    found: set[str] = set()
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            found |= {alias.name.removeprefix("ucm_cts.") for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert not node.level, f"{path}: relative import"
            module = f"{node.module}".removeprefix("ucm_cts.")
            names = {f"{module}.{alias.name}".removeprefix("ucm_cts.") for alias in node.names}
            found |= {module, *(names & modules.keys())}
    return frozenset(found)


@functools.cache
def imports() -> Mapping[str, frozenset[str]]:
    """The imports of each module of the rooms."""
    paths = {module_of(path): path for room in ALLOWED for path in sorted((PACKAGE / room).rglob("*.py"))}
    return {module: imported(path, paths) for module, path in paths.items()}


def is_in(module: str, folder: str) -> bool:
    return module == folder or module.startswith(f"{folder}.")


@pytest.mark.parametrize("room", ALLOWED)
def test_rooms_import_only_permitted_rooms(room: str) -> None:
    own = {module: names for module, names in imports().items() if is_in(module, room)}
    assert own
    for module, names in own.items():
        for name in names:
            is_ours = name.partition(".")[0] in {*ALLOWED, "ucm_cts"}
            assert not is_ours or any(is_in(name, allowed) for allowed in ALLOWED[room]), f"{module} imports {name}"


def test_rooms_of_the_harness_are_in_the_order_of_the_design_page() -> None:
    section = (ROOT / "docs" / "design.md").read_text().partition("## Order of rooms")[2].partition("\n## ")[0]
    order = re.findall(r"(?m)^\d+\. `(\w+)`", section)
    rooms = {module.split(".")[1] for module in imports() if module.startswith("harness.")}
    assert sorted(order) == sorted(rooms)
    for module, names in imports().items():
        for name in names if module.startswith("harness.") else ():
            if name.startswith("harness."):
                room, other = module.split(".")[1], name.split(".")[1]
                assert order.index(other) <= order.index(room), f"{module} imports {name}"


@pytest.mark.parametrize("room", ALLOWED)
def test_modules_do_not_import_each_other_in_a_circle(room: str) -> None:
    graph = {module: names & imports().keys() for module, names in imports().items() if is_in(module, room)}
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        pytest.fail(" imports ".join(reversed(error.args[1])))


def test_reference_models_are_pure() -> None:
    for module, names in imports().items():
        if is_in(module, "reference_models"):
            assert not {name.partition(".")[0] for name in names} & IMPURE, module


def test_the_reference_framework_does_not_know_the_sdk() -> None:
    own, contract = "adapters.reference.python", "adapters.contract"
    allowed = {contract, *(f"{contract}.{model}" for model in ("programming_model", "scenario", "data_types"))}
    for name in ("framework", "connectors", "container_services", "policies", "members", "execution"):
        ours = {n for n in imports()[f"{own}.{name}"] if n.partition(".")[0] in {*ALLOWED, "ucm_cts"}}
        assert {n for n in ours if not is_in(n, own)} <= allowed
