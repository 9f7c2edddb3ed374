"""What the tool chain does with a model, without files or processes: values in, values out."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from importlib import import_module
from pathlib import Path

from ucm_cts.adapters.contract.metamodel.modules import Model
from ucm_cts.adapters.contract.metamodel.reading import Reading, Source, read_model
from ucm_cts.adapters.reference.toolchain.checking import RULES, Plans, Rule, check
from ucm_cts.adapters.reference.toolchain.diagnostics import CannotBeMapped, Diagnostic

Generator = Callable[[Model], Mapping[str, str]]
"""Makes files, by their paths, of a well-formed model."""


@dataclass(frozen=True)
class Program:
    """A tool chain: how it reads, which rules it knows, and what it generates for each task."""

    read: Callable[[Source, str], Reading]
    rules: Mapping[str, Rule]
    generators: Mapping[str, Generator] = field(default_factory=dict)
    _plans: Plans = field(init=False, repr=False, compare=False, default_factory=dict)

    def check(self, text: Source, file: str) -> tuple[Model | None, list[Diagnostic]]:
        """The model in ``text``, and what is wrong with it; ``file`` is what diagnostics call it."""
        reading = self.read(text, file)
        diagnostics = [Diagnostic(file, p.line, p.message, clause=p.clause) for p in reading.problems]
        if reading.model is None or diagnostics:
            return None, diagnostics
        diagnostics = check(reading.model, file, self.rules, self._plans)
        return (None if diagnostics else reading.model), diagnostics

    def generate(self, task: str, text: Source, file: str) -> tuple[Mapping[str, str], list[Diagnostic]]:
        """The files that ``task`` makes of the model in ``text``; none if something is wrong with it, or nothing valid can be made of it."""
        model, diagnostics = self.check(text, file)
        if model is None:
            return {}, diagnostics
        try:
            return self.generators[task](model), diagnostics
        except CannotBeMapped as problem:
            return {}, [Diagnostic(file, problem.line, str(problem), clause=problem.clause)]


def all_rules() -> Mapping[str, Rule]:
    """The rules of all modules in ``rules``."""
    here = Path(__file__).parent
    for path in sorted(here.glob("rules/**/*.py")):
        import_module(".".join(("ucm_cts.adapters.reference.toolchain", *path.relative_to(here).with_suffix("").parts)))
    return RULES


def reference() -> Program:
    """The reference tool chain."""
    return Program(read_model, all_rules(), {task: _loaded_when_used(*place) for task, place in _GENERATORS.items()})


_GENERATORS = {
    "idl": ("idl.generator", "generate"),
    "cpp11": ("cpp.generator", "generate_cpp11"),
    "cpp03": ("cpp.generator", "generate_cpp03"),
    "lwucm": ("cpp.lwucm_glue", "generate_lwucm"),
}


def _loaded_when_used(module: str, function: str) -> Generator:
    """A generator that costs nothing until it is wanted: a check is to begin at once."""

    def generate(model: Model) -> Mapping[str, str]:
        found: Generator = getattr(import_module(f"ucm_cts.adapters.reference.toolchain.{module}"), function)
        return found(model)

    return generate
