"""Mutated C++ frameworks: each recompiles one translation unit of lwucm and links the host executable anew."""

from __future__ import annotations

import hashlib
import shutil
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from ucm_cts.harness.selftest.generated.mutants import GeneratedMutant, generate

RULES = ("universal", "c_like", "cpp")

_EXECUTION = ("10.1.3",)
_VALUES = ("10.1.1",)
_CONNECTORS = ("10.1.2", "10.1.5", "10.1.6", "10.1.1")
CONCERNED = {
    **dict.fromkeys(("execution.cpp", "executor.cpp", "monitor.cpp", "self_execution.cpp"), _EXECUTION),
    **dict.fromkeys(("policies.cpp", "interception.cpp"), ("10.1.3", "10.1.4")),
    **dict.fromkeys(("marshalling.cpp", "types.cpp", "value.cpp", "interfaces.cpp"), _VALUES),
    **dict.fromkeys(("inbox.cpp", "link_impl.cpp", "message_connector.cpp", "service_connector.cpp"), _CONNECTORS),
    "container_services.cpp": ("10.1.4",),
}
"""The clauses that a source is about, where these are not those of the life cycle."""

EQUIVALENTS = Path(__file__).parent / "equivalent-cpp.yaml"
"""Those that survive rightly, and why."""

_FLAGS = ("-std=c++11", "-O1", "-pthread", "-w")
_COMPILE_SECONDS = 300


class DoesNotCompile(Exception):
    """A source is not C++; the text is the first error."""


@dataclass(frozen=True)
class CppFramework:
    """lwucm in the source tree at ``root``; ``folder`` holds what is compiled once."""

    root: Path
    folder: Path
    compiler: str = "g++"

    @property
    def sources(self) -> Path:
        """The folder of the framework's translation units."""
        return self.root / "adapters" / "reference" / "cpp" / "framework" / "src"

    def prepare(self) -> None:
        """Compile everything that has not been. Raises ``DoesNotCompile``."""
        self.folder.mkdir(parents=True, exist_ok=True)
        adapter = self.root / "adapters" / "reference" / "cpp" / "adapter.cpp"
        for path in (adapter, *self.files()):
            made = self._object(path.name)
            if not made.exists():
                self._compile(path.parent, path.name, made)

    def files(self) -> list[Path]:
        """The translation units that are mutated."""
        return sorted(self.sources.rglob("*.cpp"), key=lambda path: path.name)

    def candidates(self) -> Iterator[GeneratedMutant]:
        """Everything that the tool makes of them."""
        for path in self.files():
            yield from generate(path, RULES)

    def compile(self, mutant: GeneratedMutant, folder: Path) -> Path:
        """The mutant's object file, made in ``folder``. Raises ``DoesNotCompile``."""
        path = next(self.sources.rglob(mutant.file))
        original = path.read_text(encoding="utf-8").splitlines(keepends=True)
        (folder / mutant.file).write_text(mutant.source(original), encoding="utf-8")
        made = folder / f"{mutant.file}.o"
        self._compile(folder, mutant.file, made)
        return made

    def is_same(self, file: str, made: Path) -> bool:
        """Does the compiler make the same object of a mutant of ``file`` as of the original?"""
        return digest(made) == digest(self._object(file))

    @contextmanager
    def endpoint(self, file: str, made: Path | None) -> Iterator[str]:
        """The path of a host with ``made`` in place of ``file``'s object, while in the ``with`` statement."""
        with TemporaryDirectory(prefix="mutant-") as folder:
            objects = [self._object(path.name) for path in self.files() if made is None or path.name != file]
            host = Path(folder) / "reference-cpp"
            self._run([self._object("adapter.cpp"), *objects, *([made] if made else []), "-o", host, "-rdynamic"])
            yield str(host)

    def _object(self, name: str) -> Path:
        return self.folder / f"{name}.o"

    def _compile(self, folder: Path, name: str, made: Path) -> None:
        includes = (
            self.sources,
            self.sources.parent / "include",
            self.root / "adapters" / "reference" / "cpp",
            self.root / "adapters" / "sdk" / "cpp" / "include",
        )
        source = folder / name
        with TemporaryDirectory(prefix="unit-") as alone:  # the object must not name the folder of its source
            shutil.copy(source, Path(alone) / name)
            options = [f"-I{path}" for path in includes]
            self._run(["-c", name, "-o", made.absolute(), *options], Path(alone))

    def _run(self, arguments: list[str | Path], folder: Path | None = None) -> None:
        command = [self.compiler, *_FLAGS, *map(str, arguments)]
        try:
            done = subprocess.run(
                command, cwd=folder, capture_output=True, text=True, check=False, timeout=_COMPILE_SECONDS
            )
        except subprocess.TimeoutExpired:
            raise DoesNotCompile(f"the compiler did not end within {_COMPILE_SECONDS} s") from None
        if done.returncode:
            errors = [line for line in done.stderr.splitlines() if "error" in line or "undefined" in line]
            raise DoesNotCompile(errors[0] if errors else done.stderr.strip()[-200:])


def digest(made: Path) -> str:
    """What an object file holds, in short."""
    return hashlib.sha256(made.read_bytes()).hexdigest()
