"""The source distribution holds all sources once and builds; the wheel that needs no compiler certifies adapters in Python, and
says in one line what it lacks for other things.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tarfile
import tomllib
import zipfile
from pathlib import Path, PurePosixPath

import pytest
from files import ROOT

from ucm_cts.harness.hosting.extras import EXTRAS

PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]


def built(kind: str, sources: Path, out: Path, **environment: str) -> Path:
    """What the build backend makes of ``sources``: the archive of the ``kind`` ``sdist`` or ``wheel``."""
    out.mkdir()
    script = f"from scikit_build_core.build import build_{kind} as build; build({str(out)!r})"
    command = [sys.executable, "-c", script]
    subprocess.run(command, cwd=sources, env={**os.environ, **environment}, check=True, capture_output=True)
    (archive,) = out.iterdir()
    return archive


@pytest.fixture(scope="module")
def sdist(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return built("sdist", ROOT, tmp_path_factory.mktemp("sources") / "sdist")


@pytest.fixture(scope="module")
def members(sdist: Path) -> list[tarfile.TarInfo]:
    """What is in the archive."""
    with tarfile.open(sdist) as tar:
        return tar.getmembers()


@pytest.fixture(scope="module")
def unpacked(sdist: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("unpacked")
    with tarfile.open(sdist) as tar:
        tar.extractall(folder)
    (sources,) = folder.iterdir()
    return sources


@pytest.fixture(scope="module")
def wheel(unpacked: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The wheel without compiled parts, made from the source distribution."""
    return built("wheel", unpacked, tmp_path_factory.mktemp("wheels") / "pure", UCM_CTS_COMPILED="0")


@pytest.fixture(scope="module")
def bare(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with that wheel's ``ucm_cts``, and modules of the extras that cannot be imported, as if they were not there."""
    folder = tmp_path_factory.mktemp("bare")
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(folder)
    names = ["pelix", *(module for modules in EXTRAS.values() for module in modules)]
    (folder / "sitecustomize.py").write_text(
        f"import sys\n"
        f"class Absent:\n"
        f"    def find_spec(self, name, path=None, target=None):\n"
        f"        if name.partition('.')[0] in {names!r}:\n"
        f"            raise ModuleNotFoundError(f'No module named {{name!r}}', name=name)\n"
        f"sys.meta_path[:] = [Absent(), *(f for f in sys.meta_path if 'editable' not in type(f).__module__)]\n"
    )
    return folder


def in_bare(bare: Path, here: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    """``ucm-cts arguments...`` as it is installed from that wheel, without any extra."""
    environment = {**os.environ, "PYTHONPATH": f"{bare}{os.pathsep}{os.environ['PYTHONPATH']}"}
    command = [sys.executable, "-m", "ucm_cts", *arguments]
    return subprocess.run(command, cwd=here, env=environment, capture_output=True, text=True, check=False)


def test_it_holds_sources_only(members: list[tarfile.TarInfo]) -> None:
    assert all(member.isfile() or member.isdir() for member in members), "a link would hold something twice"
    tops = {PurePosixPath(member.name).parts[1] for member in members}
    assert {"adapters", "harness", "reference_models", "suite", "src", "CMakeLists.txt", "pyproject.toml"} <= tops
    assert {"LICENSE", "AUTHORS.md", "CHANGELOG.md", "CONTRIBUTING.md", "README.md"} <= tops
    assert not tops & {"build", "dev", "dist", "reports", "results", ".ci"}
    assert not [m.name for m in members if Path(m.name).suffix in (".html", ".o", ".pyc", ".so")]


def test_it_holds_nothing_twice(members: list[tarfile.TarInfo]) -> None:
    names = [member.name for member in members]
    assert len(names) == len(set(names))
    for module in ("catalogue/requirements.py", "model/life_cycle.py", "contract/messages.py", "ucm_cts/__main__.py"):
        assert sum(name.endswith(f"/{module}") for name in names) == 1, module


def test_it_has_every_file_that_is_compiled(unpacked: Path) -> None:
    named = re.findall(r"(?m)^\s+(?:\w+ )?(adapters/[\w./]+\.(?:cpp|cmake|in))", (ROOT / "CMakeLists.txt").read_text())
    assert len(named) > 20
    assert [name for name in named if not (unpacked / name).is_file()] == []


def test_wheel_of_it_has_the_whole_package_and_no_doubles(unpacked: Path, wheel: Path) -> None:
    assert wheel.name.endswith("-py3-none-any.whl")
    with zipfile.ZipFile(wheel) as archive:
        names = archive.namelist()
        metadata = archive.read(next(name for name in names if name.endswith("/METADATA"))).decode()
    assert len(names) == len(set(names))
    held = {name.removeprefix("ucm_cts/") for name in names}
    modules = {
        str(path.relative_to(unpacked))
        for room in ("adapters", "harness", "suite")
        for path in (unpacked / room).rglob("*.py")
    }
    assert modules - held == set()
    assert any(name.endswith("/licenses/LICENSE") for name in names)
    assert "License-Expression: Apache-2.0" in metadata
    assert {f"Provides-Extra: {extra}" for extra in EXTRAS} <= set(metadata.splitlines())


def test_extras_are_those_that_modules_are_known_of() -> None:
    """Each extra of ``EXTRAS`` has as many packages as modules, and none of them is in the core."""
    for extra, modules in EXTRAS.items():
        assert len(PROJECT["optional-dependencies"][extra]) == len(modules)
        assert not set(PROJECT["optional-dependencies"][extra]) & set(PROJECT["dependencies"])


@pytest.mark.usefixtures("here")
class TestBare:
    """The wheel without compiled parts and without extras."""

    def test_is_what_is_tested(self, bare: Path, here: Path) -> None:
        command = [sys.executable, "-c", "import ucm_cts; print(ucm_cts.__file__)"]
        printed = subprocess.run(
            command, cwd=here, env={**os.environ, "PYTHONPATH": str(bare)}, capture_output=True, text=True, check=True
        )
        assert Path(printed.stdout.strip()).is_relative_to(bare)

    def test_certifies_an_adapter_in_python(self, bare: Path, here: Path) -> None:
        run = in_bare(bare, here, "run", "reference-py", "-k", "R-11.2.2.1-13")
        assert (run.returncode, run.stderr) == (0, "")
        assert (here / "ucm-cts-report" / "report.html").is_file()

    @pytest.mark.parametrize("arguments", [("explain", "R-11.2.2.1-13"), ("ics", "reference-py"), ("--help",)])
    def test_does_what_needs_no_extra(self, bare: Path, here: Path, arguments: tuple[str, ...]) -> None:
        run = in_bare(bare, here, *arguments)
        assert (run.returncode, run.stderr) == (0, "")

    @pytest.mark.parametrize(
        ("arguments", "remedy"),
        [
            (("run", "--toolchain", "chain.toml"), r"pip install 'ucm-cts\[toolchain\]'"),
            (("selftest", "--toolchains", "--list"), r"pip install 'ucm-cts\[toolchain\]'"),
            (("verify", "acme.ucmcert", "--trust", "keys"), r"pip install 'ucm-cts\[certificates\]'"),
            (("compare", "--baseline", "a.ucmcert", "b.ucmcert"), r"pip install 'ucm-cts\[certificates\]'"),
            (("ics", "--toolchain", "chain.toml"), r"pip install 'ucm-cts\[toolchain\]'"),
            (("run", "ipopo"), r"pip install 'ucm-cts\[ipopo\]'"),
            (("history",), r"pip install 'ucm-cts\[history\]'"),
            (("run", "reference-cpp"), "install a C[+][+] compiler, cmake and nlohmann-json3-dev"),
            (("--cmakedir",), "install a C[+][+] compiler, cmake and nlohmann-json3-dev"),
        ],
    )
    def test_says_in_one_line_what_it_lacks(
        self, bare: Path, here: Path, arguments: tuple[str, ...], remedy: str
    ) -> None:
        (here / "chain.toml").write_text((ROOT / "adapters" / "reference" / "toolchain" / "toolchain.toml").read_text())
        run = in_bare(bare, here, *arguments)
        assert (run.returncode, run.stdout) == (2, "")
        assert re.fullmatch(f"ucm-cts: .*{remedy}.*\n", run.stderr)


@pytest.mark.slow
def test_it_installs_where_there_is_no_compiler(unpacked: Path, tmp_path: Path) -> None:
    """Without UCM_CTS_COMPILED, too; with 1 the installation fails. pip fetches nothing: what a build needs is here."""
    out = tmp_path / "wheels"
    environment = {
        **{name: value for name, value in os.environ.items() if name not in ("CXX", "UCM_CTS_COMPILED")},
        "CXX": str(tmp_path / "no-compiler"),
    }
    subprocess.run([*PIP, "-w", out, unpacked], env=environment, check=True, capture_output=True)
    (wheel,) = out.iterdir()
    assert wheel.name.endswith("-none-any.whl")
    asked = subprocess.run(
        [*PIP, "-w", out, unpacked],
        env={**environment, "UCM_CTS_COMPILED": "1"},
        check=False,
        capture_output=True,
        text=True,
    )
    assert asked.returncode
    assert "no-compiler" in asked.stdout + asked.stderr


PIP = [sys.executable, "-m", "pip", "wheel", "--no-deps", "--no-build-isolation"]
