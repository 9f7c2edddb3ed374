"""Why a text is not IDL, and where."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Problem:
    """Why a text is not IDL, and where; lines and columns are counted from 1."""

    file: str
    line: int
    column: int
    text: str

    def __str__(self) -> str:
        return f"{self.file}:{self.line}:{self.column}: {self.text}"


class NotIdl(Exception):
    """A text that is not IDL; ``problem`` says why."""

    def __init__(self, problem: Problem) -> None:
        super().__init__(str(problem))
        self.problem = problem


def problem_at(text: str, at: int, file: str, message: str) -> Problem:
    """The problem that is ``message`` of the character of ``text`` at index ``at``."""
    return Problem(file, text.count("\n", 0, at) + 1, at - (text.rfind("\n", 0, at) + 1) + 1, message)
