"""The Java builds of the tests."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import pytest
from cpp_builds import run
from files import ROOT, SUPPORT, guide_files

GUIDE = ROOT / "docs" / "adapter-java.md"
SOURCES = SUPPORT / "java"


class JavaBuilds:
    """A copy of adapters/ built by Maven, and beside it what the guide and tests/support/java show, built by the compiler alone."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.adapters = folder / "adapters"
        leave = shutil.ignore_patterns("target")
        for name in ("sdk/java", "integrations/julia"):
            shutil.copytree(ROOT / "adapters" / name, self.adapters / name, ignore=leave)
        shutil.copy(ROOT / "adapters" / "pom.xml", self.adapters)
        quickly = {**os.environ, "MAVEN_OPTS": "-XX:TieredStopAtLevel=1 -XX:+UseSerialGC"}
        try:
            run(["mvn", "-q", "-o", "-f", "adapters", "package"], cwd=folder, env=quickly)
        except AssertionError:  # what it takes is not all there yet
            run(["mvn", "-q", "-f", "adapters", "package"], cwd=folder, env=quickly)
        self.julia = self.adapters / "integrations" / "julia" / "julia-adapter"
        shutil.copytree(self.adapters / "integrations" / "julia" / "target" / "lib", folder / "lib")
        for name, text in guide_files(GUIDE).items():
            (folder / name).write_text(text)
        (folder / "beans-adapter").chmod(0o755)
        sources = [*folder.glob("*.java"), *SOURCES.glob("*.java")]
        run(
            ["javac", "-Xlint:all", "-Werror", "--release", "17", "-cp", "lib/*", "-d", "classes", *sources], cwd=folder
        )

    def program(self, name: str) -> Path:
        """An executable for the adapter ``name`` of tests/support/java, like that of the guide."""
        path = self.folder / name
        script = (self.folder / "beans-adapter").read_text().replace("BeansAdapter", name)
        path.write_text(script.replace("classes:lib/*", f"{self.folder}/classes:{self.folder}/lib/*"))
        path.chmod(0o755)
        return path


@pytest.fixture(scope="module")
def java(tmp_path_factory: pytest.TempPathFactory) -> JavaBuilds:
    """Skips where there is no Java compiler or no Maven."""
    if not (shutil.which("javac") and shutil.which("mvn")):
        pytest.skip("needs a Java development kit and Maven")
    return JavaBuilds(tmp_path_factory.mktemp("java"))
