"""The source distribution: all sources once, and nothing that is made of them."""

from __future__ import annotations

import subprocess
import sys
import tarfile
from pathlib import Path, PurePosixPath

import pytest
from files import ROOT


@pytest.fixture(scope="module")
def members(tmp_path_factory: pytest.TempPathFactory) -> list[tarfile.TarInfo]:
    """What is in the archive."""
    out = tmp_path_factory.mktemp("sdist")
    script = f"from scikit_build_core.build import build_sdist; build_sdist({str(out)!r})"
    subprocess.run([sys.executable, "-c", script], cwd=ROOT, check=True, capture_output=True)
    (archive,) = out.iterdir()
    with tarfile.open(archive) as tar:
        return tar.getmembers()


def test_it_holds_sources_only(members: list[tarfile.TarInfo]) -> None:
    assert all(member.isfile() or member.isdir() for member in members), "a link would hold something twice"
    tops = {PurePosixPath(member.name).parts[1] for member in members}
    assert {"adapters", "harness", "reference_models", "suite", "src", "CMakeLists.txt", "pyproject.toml"} <= tops
    assert not tops & {"build", "dev", "dist", "reports", "results"}
    assert not [m.name for m in members if Path(m.name).suffix in (".html", ".o", ".pyc", ".so")]


def test_it_holds_nothing_twice(members: list[tarfile.TarInfo]) -> None:
    names = [member.name for member in members]
    assert len(names) == len(set(names))
    for module in ("catalogue/requirements.py", "model/life_cycle.py", "contract/messages.py", "ucm_cts/__main__.py"):
        assert sum(name.endswith(f"/{module}") for name in names) == 1, module
