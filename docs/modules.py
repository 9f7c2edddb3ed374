"""Prints the modules of the project with the first line of their docstrings: ``python docs/modules.py [FOLDER ...]``."""

from __future__ import annotations

import ast
import sys
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parent.parent
ROOMS = ("suite", "reference_models", "harness", "adapters")


def modules(folders: list[str]) -> Iterator[tuple[str, str]]:
    """The path and the purpose of each Python module below ``folders``; a package stands for its folder."""
    for path in sorted(p for folder in folders for p in (ROOT / folder).rglob("*.py")):
        docstring = ast.get_docstring(ast.parse(path.read_text())) or ""
        name = path.relative_to(ROOT).as_posix().replace("__init__.py", "")
        yield name, docstring.partition("\n")[0]


if __name__ == "__main__":
    for name, purpose in modules(sys.argv[1:] or list(ROOMS)):
        print(f"{name:<60} {purpose}")
