"""What is wrong with a certificate."""

from __future__ import annotations

from ucm_cts.adapters.contract.value import Value


class Problem(Value, frozen=True):
    """One reason why a certificate does not stand.

    ``check``: a fixed word for each way of failing: ``signature``, ``digest``, ``record``, ``verdict``, ``report``, ...
    ``detail``: what is wrong, where, and what to do, on one line.
    """

    check: str
    detail: str


class Unreadable(Exception):
    """Something of a certificate cannot be read, so that nothing that rests on it can be checked."""

    def __init__(self, *problems: Problem) -> None:
        super().__init__("; ".join(problem.detail for problem in problems))
        self.problems = problems


def unreadable(check: str, detail: str) -> Unreadable:
    """The error with one problem."""
    return Unreadable(Problem(check, detail))
