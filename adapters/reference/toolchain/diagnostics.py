"""What the tool chain has to say against a model, a line each."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Diagnostic:
    """``message`` names the element and the remedy; ``requirement`` is empty where the model could not even be read."""

    file: str
    line: int
    message: str
    requirement: str = ""
    clause: str = ""

    def __str__(self) -> str:
        clause = self.clause or self.requirement.removeprefix("R-").rpartition("-")[0]
        rule = ", ".join(filter(None, (self.requirement, f"clause {clause}" if clause else "")))
        return f"{self.file}:{self.line}: error: {self.message}{f' [{rule}]' if rule else ''}"


class CannotBeMapped(Exception):
    """A legal model of which a generator can make nothing valid; the message names the element and the remedy."""

    def __init__(self, line: int, message: str, clause: str) -> None:
        """``line`` is that of the element."""
        super().__init__(message)
        self.line = line
        self.clause = clause
