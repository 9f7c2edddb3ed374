"""The results of comparing generated files with a mapping."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Difference:
    """Something that is missing, wrong or unexpected: ``element`` is the model's, by its qualified name, and ``line_in_model``
    where it stands; ``file`` and ``line`` are the place in the vendor's file, what is around it if it is missing. Lines are 0 and
    names empty where there are none.
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
class Comparison:
    """How often each requirement was exercised, and what broke it. ``readings`` are the values of options that were met,
    ``unjudged`` says why requirements were not exercised, or not everywhere. ``remarks`` are for the report's effort.
    """

    exercised: Mapping[str, int]
    differences: tuple[Difference, ...]
    readings: Mapping[str, frozenset[str]] = field(default_factory=dict)
    unjudged: Mapping[str, str] = field(default_factory=dict)
    remarks: tuple[str, ...] = ()
