"""What README and docs show: their text, tables, files and commands, and a shell that runs them."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

from files import ROOT, guide_files

import ucm_cts as package

FRAMEWORK = ROOT / "adapters" / "reference" / "cpp" / "framework"
PAGES = [*sorted(ROOT.glob("*.md")), FRAMEWORK / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
PACKAGE = Path(package.__file__).parent


def text_of(name: str) -> str:
    return (ROOT / name).read_text()


def column(page: str, pattern: str) -> list[Any]:
    """What ``pattern`` finds at the beginnings of table rows."""
    return re.findall(rf"(?m)^\| {pattern} \|", text_of(page))


def marked(page: str, marker: str) -> str:
    """The one code block that stands below ``<!-- marker -->``."""
    (block,) = re.findall(rf"(?ms)^<!-- {re.escape(marker)} -->\n```\w+\n(.*?)^```$", text_of(page))
    return str(block)


def write_files(page: str) -> None:
    """Every file that the page shows or takes for an example, under its name, into this folder."""
    for name, text in guide_files(ROOT / page).items():
        Path(name).write_text(text)


def prose(page: Path) -> str:
    """The page without its code blocks."""
    return re.sub(r"(?ms)^```.*?^```$", "", page.read_text())


def spans(page: Path) -> list[str]:
    """What stands between backquotes; lines may break there."""
    return [" ".join(span.split()) for span in re.findall(r"`([^`]+)`", prose(page))]


def commands(program: str) -> list[str]:
    """Every command line of ``program`` that any page shows."""
    found = []
    for page in PAGES:
        found += re.findall(rf"(?m)^\s*({re.escape(program)}.*)$", page.read_text())
        found += [span for span in spans(page) if span.startswith(program)]
    return found


def shell(command: str, **environment: str) -> str:
    """Run ``command`` in this folder as somebody would who has the environment activated; what it printed."""
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    done = subprocess.run(
        ["bash", "-euo", "pipefail", "-c", command],
        env={**os.environ, "PATH": path, **environment}, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, f"{command}\n{done.stdout[-3000:]}\n{done.stderr[-3000:]}"
    return done.stdout
