"""Tool chains that pass values of one kind of type in one direction in a wrong way."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal

from ucm_cts.adapters.contract.value import Value
from ucm_cts.adapters.mutants.toolchain.rewriting import BOTH, CPP11, Wrong, register, table

_TYPE = r"(::passing_application::passing::\w+)"

_HOW = {"by_value": r"\2", "by_reference": r"\2&", "by_constant_reference": r"const \2&", "by_pointer": r"\2*"}

IN_BOTH = frozenset({"list", "record_alias", "boolean", "text"})
"""Kinds that are passed in a wrong way to either standard; both are judged by the same code."""


class Passed(Value, frozen=True):
    """Mutants that pass values in one ``direction``; ``kinds`` says how each kind of type is passed."""

    direction: Literal["in", "out", "inout", "returned"]
    requirement: str
    kinds: dict[str, str]
    parameter: str = ""

    def mutants(self) -> Iterator[tuple[str, Wrong]]:
        """Each mutant with its name."""
        for kind, how in self.kinds.items():
            name = f"{self.direction}_{kind}_{how}" if self.parameter else f"{kind}_{self.direction}_{how}"
            tasks = BOTH if kind in IN_BOTH else CPP11
            yield name, Wrong(breaks=self.requirement, edits=self._edits(kind, _HOW[how]), tasks=tasks)

    def _edits(self, kind: str, how: str) -> dict[str, str]:
        if not self.parameter:
            return {rf"(virtual ){_TYPE} pass_{kind}\(": rf"\1{how} pass_{kind}("}
        before = rf"( pass_{kind}\((?:[^\n]*, )?)(?:const )?"
        return {rf"{before}{_TYPE}&? {self.parameter}\b": rf"\1{how} {self.parameter}"}


for _passed in table("mappings/passing.yaml", list[Passed]):
    register("passing", dict(_passed.mutants()))
