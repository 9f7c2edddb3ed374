"""Who imports whom: an adapter can never know the expected answer, and the reference models do nothing but think."""

from __future__ import annotations

import ast
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

import ucm_cts

PACKAGE = Path(ucm_cts.__file__).parent
ALLOWED = {
    "adapters": {"adapters"},
    "reference_models": {"reference_models", "adapters.contract"},
    "suite": set(),
    "harness": {"harness", "suite", "reference_models", "adapters", ""},
}
IMPURE = {"os", "sys", "time", "threading", "subprocess", "socket", "pathlib", "random", "io", "asyncio", "datetime"}


def sources(room: str) -> list[Path]:
    return sorted(p for p in (PACKAGE / room).rglob("*.py"))


def imported(path: Path) -> Iterator[str]:
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert not node.level, f"{path}: relative import"
            yield f"{node.module}"


@pytest.mark.parametrize("room", ALLOWED)
def test_imports_go_one_way(room: str) -> None:
    assert sources(room)
    for path in sources(room):
        for module in imported(path):
            if module.split(".")[0] == "ucm_cts":
                inner = module.removeprefix("ucm_cts").lstrip(".")
                fits = any(inner == a or inner.startswith(f"{a}.") for a in ALLOWED[room])
                assert fits, f"{path.relative_to(PACKAGE)} imports {module}"


def test_reference_models_are_pure() -> None:
    for path in sources("reference_models"):
        impure = {m.split(".")[0] for m in imported(path)} & IMPURE
        assert not impure, f"{path.name} imports {impure}"


def test_the_reference_framework_does_not_know_the_sdk() -> None:
    own = "ucm_cts.adapters.reference.python"
    for name in ("framework", "policies", "container_services", "connectors"):
        path = PACKAGE / "adapters" / "reference" / "python" / f"{name}.py"
        inner = {m for m in imported(path) if m.startswith("ucm_cts") and not m.startswith(own)}
        assert inner <= {
            f"ucm_cts.adapters.contract.{model}" for model in ("programming_model", "scenario", "data_types")
        }


def test_properties_have_one_order_whichever_module_is_imported_first() -> None:
    told = "from ucm_cts.reference_models.properties.table import PROPERTIES; print(*PROPERTIES)"
    orders = {
        subprocess.run(
            [sys.executable, "-c", f"{first}; import ucm_cts.reference_models.monitor; {told}"],
            capture_output=True,
            text=True,
            check=True,
        ).stdout
        for first in (
            "pass",
            "import ucm_cts.reference_models.properties.values, ucm_cts.reference_models.properties.trace",
        )
    }
    assert len(orders) == 1
