"""Mutated Python frameworks: leaves out mutants that are the same program, and puts one where a host finds it."""

from __future__ import annotations

import ast
import builtins
import keyword
import os
import re
import shutil
import sys
import warnings
from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

from ucm_cts.adapters.reference import python as reference_py
from ucm_cts.harness.selftest.generated import mutants

RULES = ("universal", "python")
CONCERNED = {
    "framework.py": ("11", "12.10"),
    "members.py": ("11", "12.10"),
    "policies.py": ("10.1.3",),
    "execution.py": ("10.1.3",),
    "container_services.py": ("10.1.4",),
    "connectors.py": ("10.1.1", "10.1.2", "10.1.5", "10.1.6"),
}
"""The sources that are mutated, and the clauses that each is about."""

EQUIVALENTS = Path(__file__).parent / "equivalent-python.yaml"
"""Equivalent mutants, with reasons."""

HOME = Path(reference_py.__file__).parent

_NAME = re.compile(r"[A-Za-z_]\w*")
_WORDS = {*keyword.kwlist, *dir(builtins)}
_PACKAGE = "mutated_reference_py"


def candidates() -> tuple[list[mutants.GeneratedMutant], Counter[str]]:
    """The mutants that are other programs than the framework and than each other, and how many there are of the rest."""
    kept: list[mutants.GeneratedMutant] = []
    census: Counter[str] = Counter()
    for file in CONCERNED:
        lines = (HOME / file).read_text(encoding="utf-8").splitlines(keepends=True)
        names = set(_NAME.findall("".join(lines)))
        blocks = _blocks(lines)
        seen = {(block, meaning(_part(lines, block))): mutants.SAME for block in blocks}
        for mutant in mutants.generate(HOME / file, RULES):
            census[mutants.GENERATED] += 1
            block = next((one for one in blocks if one[0] <= mutant.number <= one[1]), None)
            if block is None:
                census[mutants.SAME] += 1
                continue
            text = mutant.source(lines).splitlines(keepends=True)
            means = block, meaning(_part(text, (block[0], block[1] + len(text) - len(lines))))
            if means[1] is None:
                census[mutants.NO_PROGRAM] += 1
            elif means in seen:
                census[seen[means]] += 1
            elif set(_NAME.findall(mutant.becomes)) - names - _WORDS:
                census[mutants.NONSENSE] += 1
            else:
                seen[means] = mutants.DUPLICATE
                kept.append(mutant)
    return kept, census


def _blocks(lines: Sequence[str]) -> list[tuple[int, int]]:
    """First and last line of each statement of the module; parsing one of them is quicker than parsing all."""
    found: list[tuple[int, int]] = []
    for node in ast.parse("".join(lines)).body:
        first = min([node.lineno, *(one.lineno for one in getattr(node, "decorator_list", ()))])
        found.append((first, node.end_lineno or first))
    return found


def _part(lines: Sequence[str], block: tuple[int, int]) -> str:
    return "".join(lines[block[0] - 1 : block[1]])


def meaning(source: str) -> str | None:
    """What is left of ``source`` for a run: no annotations, no comments, no docstrings, no words of messages.

    None if it is not Python. Messages of exceptions do not count: no clause is about them.
    """
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            compile(source, "mutant", "exec")
            tree = ast.parse(source)
        except (SyntaxError, ValueError):
            return None
    return ast.dump(_Bare().visit(tree))


class _Bare(ast.NodeTransformer):
    """Removes the parts that make no difference when the program runs."""

    def visit_Module(self, node: ast.Module) -> ast.AST:
        return self._without_texts(node)

    def visit_ClassDef(self, node: ast.ClassDef) -> ast.AST:
        return self._without_texts(node)

    def visit_FunctionDef(self, node: ast.FunctionDef) -> ast.AST:
        node.returns = None
        return self._without_texts(node)

    def visit_arg(self, node: ast.arg) -> ast.AST:
        node.annotation = None
        return node

    def visit_AnnAssign(self, node: ast.AnnAssign) -> ast.AST:
        self.generic_visit(node)
        node.annotation = ast.Constant(0)
        return node

    def visit_Raise(self, node: ast.Raise) -> ast.AST:
        for constant in ast.walk(node):
            if isinstance(constant, ast.Constant) and isinstance(constant.value, str):
                constant.value = ""
        return self.generic_visit(node)

    def _without_texts(self, node: ast.Module | ast.ClassDef | ast.FunctionDef) -> ast.AST:
        self.generic_visit(node)
        kept = [s for s in node.body if not (isinstance(s, ast.Expr) and isinstance(s.value, ast.Constant))]
        node.body = [s for s in kept if not isinstance(s, ast.Pass)] or [ast.Pass()]
        return node


@contextmanager
def python_endpoint(mutant: mutants.GeneratedMutant | None) -> Iterator[str]:
    """The adapter of the framework with ``mutant`` in it, or of the framework as it is, while in the ``with`` statement."""
    with TemporaryDirectory(prefix="mutant-") as folder:
        package = Path(folder) / _PACKAGE
        package.mkdir()
        for path in HOME.glob("*.py"):
            lines = path.read_text(encoding="utf-8").splitlines(keepends=True)
            text = mutant.source(lines) if mutant and mutant.file == path.name else "".join(lines)
            (package / path.name).write_text(
                text.replace("ucm_cts.adapters.reference.python", _PACKAGE), encoding="utf-8"
            )
        shutil.copy(HOME / "ics.toml", package)
        before = os.environ.get("PYTHONPATH")
        os.environ["PYTHONPATH"] = os.pathsep.join(filter(None, (folder, before)))
        sys.path.insert(0, folder)
        try:
            yield f"{_PACKAGE}.adapter:ReferenceAdapter"
        finally:
            sys.path.remove(folder)
            if before is None:
                del os.environ["PYTHONPATH"]
            else:
                os.environ["PYTHONPATH"] = before
