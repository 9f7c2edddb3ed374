"""What takes part in a run is found, however it is loaded."""

from __future__ import annotations

import hashlib
from pathlib import Path

import pytest

from ucm_cts.adapters.contract.messages import Run, Traced
from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.harness.certificates.packages import packages_of
from ucm_cts.harness.certificates.subjects import subjects_of
from ucm_cts.harness.hosting import hosts
from ucm_cts.harness.hosting.hosts import Hosts
from ucm_cts.harness.hosting.locate import locate

ADAPTER = """
import importlib, importlib.util, pathlib
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter
importlib.import_module("".join(["pro", "duct.core"]))

class Mine(ReferenceAdapter):
    def create_runtime(self, implementations):
        spec = importlib.util.spec_from_file_location("late", pathlib.Path(__file__).parent / "plugins" / "late.py")
        import sys
        sys.modules["late"] = module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        return super().create_runtime(implementations)
"""


def adapter(here: Path) -> str:
    for name in ("product/__init__.py", "product/core.py", "plugins/late.py"):
        (here / name).parent.mkdir(exist_ok=True)
        (here / name).write_text(f"# {name}\n")
    (here / "mine.py").write_text(ADAPTER)
    return "mine:Mine"


def named(here: Path, text: str) -> dict[str, str]:
    """The subjects of a run on the adapter ``text``, each with its digest."""
    with Hosts(locate(text)) as there:
        (answer,) = there.run([Run(0, Scenario({}, ()))])
        assert isinstance(answer.reply, Traced)
        return {
            subject.name: subject.sha256
            for subject in subjects_of(str(Path("mine.py").resolve()), (), there.loaded_files())
        }


def test_modules_that_no_statement_imports_are_named(here: Path) -> None:
    first = named(here, adapter(here))
    assert {"adapter/mine.py", "package/mine", "package/product", "package/late"} <= set(first)
    assert "package/ucm_cts.adapters.reference.python" in first
    assert any(name.startswith("library/libc.so") for name in first)
    ours_or_python = {"package/ucm_cts", "package/json", "package/os", "package/host"}
    assert not ours_or_python & set(first)
    (here / "product" / "core.py").write_text("changed = True\n")
    changed = named(here, "mine:Mine")
    assert {name for name in first if first[name] != changed.get(name)} == {"package/product"}


def test_a_host_that_does_not_say_what_it_has_loaded_costs_nothing_else(
    here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(hosts, "ASKED_FOR_MODULES", b"not a question\n")
    found = named(here, adapter(here))
    assert {"adapter/mine.py", "package/mine"} <= set(found)
    assert "package/late" not in found


def test_the_same_name_twice_gets_a_number(tmp_path: Path) -> None:
    for folder in ("a", "b"):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "plugin.py").write_text(folder)
    files = [str(tmp_path / folder / "plugin.py") for folder in ("a", "b")]
    found = {subject.name: subject.sha256 for subject in packages_of("", [*files, "/gone.py"])}
    assert set(found) == {"package/plugin", "package/plugin (2)"}
    assert found["package/plugin"] == hashlib.sha256(b"plugin.py\x001\x00a").hexdigest()
