"""What comparing IDL came to."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ucm_cts.reference_models.idl.declarations import Place


@dataclass(frozen=True)
class Difference:
    """Something that is missing, wrong or unexpected: ``element`` is the model's, by its qualified name, and ``line_in_model`` where
    it stands; ``file`` and ``line`` are the place in the vendor's IDL, the module around what is missing. Lines are 0 and names
    empty where there are none.
    """

    requirement: str
    rule: str
    element: str
    line_in_model: int
    expected: str
    observed: str
    file: str = ""
    line: int = 0

    def __str__(self) -> str:
        place = f"{self.file}:{self.line}: " if self.file else ""
        of = f" for {self.element} (line {self.line_in_model} of the model)" if self.element else ""
        return f"{place}expected {self.expected}{of}, observed {self.observed} [{self.requirement}]"


@dataclass(frozen=True)
class Wrong:
    """What a check found: ``requirement`` is that of the fact unless another one is broken instead."""

    expected: str
    observed: str
    place: Place
    requirement: str = ""


@dataclass(frozen=True)
class IdlComparison:
    """How often each requirement was looked at, and what broke it. ``readings`` are the values of options that were met."""

    exercised: Mapping[str, int]
    differences: tuple[Difference, ...]
    readings: Mapping[str, frozenset[str]]


class NotExercised(Exception):
    """There is nothing to look at: what a fact is about is not there, and another fact tells."""
